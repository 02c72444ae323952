//! How the two kinds of effort are named and numbered.

use crate::analysis::Effort;
use crate::format;

/// An id of the figure `what` by this effort.
pub fn id(what: &str, effort: Effort) -> String {
    format!("{what}-{}", key(effort, ["evaluations", "time"]))
}

/// The one of two that belongs to `effort`, evaluations first.
pub fn key(effort: Effort, [evaluations, time]: [&'static str; 2]) -> &'static str {
    match effort {
        Effort::Evaluations => evaluations,
        Effort::Time => time,
    }
}

/// How its values are written.
pub fn number(effort: Effort) -> fn(f64) -> String {
    match effort {
        Effort::Evaluations => |v| format::significant(v, 3),
        Effort::Time => format::time,
    }
}

/// How they are written at an axis: large counts as powers of ten.
pub fn tick(effort: Effort) -> fn(f64) -> String {
    match effort {
        Effort::Evaluations => |v| format::power(v).unwrap_or_else(|| format::count(v)),
        Effort::Time => format::time,
    }
}
