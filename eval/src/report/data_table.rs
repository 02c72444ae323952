//! Tables of evidence, in the shape that the template's `data` macro reads.

use minijinja::{Value, context};

use super::palette;
use crate::format;

/// A number, and what sorting reads.
pub fn number(shown: impl Into<String>, key: f64) -> Value {
    context! { shown => shown.into(), key => format::sort_key(key), kind => "num" }
}

/// A number in a table that does not sort.
pub fn figure(shown: impl Into<String>) -> Value {
    context! { shown => shown.into(), key => "", kind => "num" }
}

/// Words.
pub fn words(shown: impl Into<String>) -> Value {
    context! { shown => shown.into(), key => "", kind => "text" }
}

/// A value with its interval below it.
pub fn with_interval(value: f64, interval: Option<[f64; 2]>, format: &dyn Fn(f64) -> String) -> Value {
    let small = interval.map(|[low, high]| format!("[{}, {}]", format(low), format(high)));
    context! { shown => format(value), key => format::sort_key(value), kind => "num", small }
}

/// A row that is about the planner `index`.
pub fn planner_row(label: &str, index: usize, cells: Vec<Value>) -> Value {
    context! { label, swatch => swatch(index), cells }
}

/// A row that is about something else.
pub fn row(cells: Vec<Value>) -> Value {
    context! { cells }
}

/// The key of planner `index`, as markup.
pub fn swatch(index: usize) -> Value {
    Value::from_safe_string(palette::swatch(index))
}

/// A table; `id` is unique in the page. The first head is about the rows' names.
pub fn table(id: &str, caption: &str, heads: &[&str], rows: Vec<Value>) -> Value {
    context! { id, caption, heads => heads.iter().copied().map(Value::from).collect::<Vec<_>>(), rows }
}
