//! What charts share: the frame, grid lines and numbers.

use std::fmt::Write as _;

use super::axis::Axis;
use super::svg::escape;

/// Width of a chart in picture units.
pub const WIDTH: f64 = 720.0;
/// Left border of the plotting area: room for numbers.
pub const LEFT: f64 = 92.0;
/// Right border of the plotting area.
pub const RIGHT: f64 = 682.0;

/// Opens a chart of the given height with its accessible name; `id` is unique in the page.
pub fn open(id: &str, height: f64, title: &str, desc: &str) -> String {
    format!(
        r#"<svg class="fig chart" viewBox="0 0 {WIDTH} {height:.0}" role="img" aria-labelledby="{id}-t {id}-d"><title id="{id}-t">{}</title><desc id="{id}-d">{}</desc>"#,
        escape(title),
        escape(desc)
    )
}

/// Vertical grid lines from `top` to `bottom`, numbers below.
pub fn x_grid(axis: &Axis, top: f64, bottom: f64, number: &dyn Fn(f64) -> String) -> String {
    let mut out = String::new();
    for v in axis.ticks(5) {
        let x = axis.at(v);
        // A number in the middle under the picture's edge would be cut off.
        let (anchor, at) = if x < 50.0 { ("", 3.0) } else { ("middle ", x) };
        let _ = write!(
            out,
            r#"<path class="grid" d="M{x:.1} {top:.1}V{bottom:.1}"/><text class="{anchor}tick" x="{at:.1}" y="{:.1}">{}</text>"#,
            bottom + 22.0,
            escape(&number(v))
        );
    }
    out
}

/// Horizontal grid lines across the plotting area, about `count` of them, numbers on the left.
pub fn y_grid(axis: &Axis, count: usize, number: &dyn Fn(f64) -> String) -> String {
    let mut out = String::new();
    for v in axis.ticks(count) {
        let y = axis.at(v);
        let _ = write!(
            out,
            r#"<path class="grid" d="M{LEFT} {y:.1}H{RIGHT}"/><text class="end tick" x="{:.1}" y="{:.1}">{}</text>"#,
            LEFT - 10.0,
            y + 5.0,
            escape(&number(v))
        );
    }
    out
}
