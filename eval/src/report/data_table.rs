//! Tables of evidence, in the shape that the template's `data` macro reads.

use minijinja::{Value, context};

use super::palette;
use crate::format;

/// A number, and what sorting reads.
pub fn number(shown: impl Into<String>, key: f64) -> Value {
    context! { shown => shown.into(), key => format::sort_key(key), kind => "num", small => "" }
}

/// A number in a table that does not sort.
pub fn figure(shown: impl Into<String>) -> Value {
    context! { shown => shown.into(), key => "", kind => "num", small => "" }
}

/// Words.
pub fn words(shown: impl Into<String>) -> Value {
    context! { shown => shown.into(), key => "", kind => "text", small => "" }
}

/// A value with its interval below it.
pub fn with_interval(value: f64, interval: Option<[f64; 2]>, format: &dyn Fn(f64) -> String) -> Value {
    // Where nothing varies there is no interval worth a line.
    let ends = interval.map(|ends| ends.map(format)).filter(|[low, high]| low != high);
    let small = ends.map(|[low, high]| format!("[{low}, {high}]")).unwrap_or_default();
    context! { shown => format(value), key => format::sort_key(value), kind => "num", small }
}

/// A row that is about the planner `index`.
pub fn planner_row(label: &str, index: usize, cells: Vec<Value>) -> Value {
    context! { label, swatch => swatch(index), cells }
}

/// A row that is about something else.
pub fn row(cells: Vec<Value>) -> Value {
    context! { cells, label => "" }
}

/// The key of planner `index`, as markup.
pub fn swatch(index: usize) -> Value {
    Value::from_safe_string(palette::swatch(index))
}

/// A table; `id` is unique in the page. Heads stand over the cells of the rows, the first over their names.
pub fn table(id: &str, caption: &str, heads: &[&str], rows: Vec<Value>) -> Value {
    let cells = rows.first().and_then(|row| row.get_attr("cells").ok());
    let named = rows.first().and_then(|row| row.get_attr("label").ok()).is_some_and(|label| label.is_true());
    let kind = |column: usize| {
        let cell = cells.as_ref()?.get_item_by_index(column.checked_sub(usize::from(named))?).ok()?;
        cell.get_attr("kind").ok()
    };
    let head = |(column, words): (usize, &&str)| {
        let kind = kind(column).filter(|_| column > 0).unwrap_or_else(|| Value::from("who"));
        context! { words => *words, kind }
    };
    let heads: Vec<Value> = heads.iter().enumerate().map(head).collect();
    context! { id, caption, heads, rows }
}
