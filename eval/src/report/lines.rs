//! Line charts of several planners: steps or straight pieces, a band or whiskers, and a marker at the end.

use std::fmt::Write as _;

use minijinja::{Value, context};

use super::axis::Axis;
use super::svg::escape;
use super::{chart, palette};

/// Where the plotting area begins.
pub const TOP: f64 = 34.0;
/// Where it ends.
pub const BOTTOM: f64 = 352.0;
const HEIGHT: f64 = 412.0;
/// With more planners bands and whiskers would hide each other: they are in the table alone.
pub const MOST_WITH_BANDS: usize = 8;

/// How points are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Join {
    /// A value holds until the next one.
    Steps,
    /// Straight pieces, with a marker at each point.
    Straight,
}

/// One planner's line.
pub struct Line<'a> {
    /// Label of the planner.
    pub label: &'a str,
    /// Its place in the comparison.
    pub index: usize,
    /// Finite points from left to right.
    pub points: Vec<[f64; 2]>,
    /// Lower and upper ends at the places of points; ends may be infinite, which is drawn on the edge.
    pub ends: Vec<(f64, [f64; 2])>,
}

/// What a chart says besides its lines.
pub struct Chart<'a> {
    /// Unique in the page.
    pub id: &'a str,
    /// Heading.
    pub title: &'a str,
    /// The paragraph below.
    pub text: &'a str,
    /// Horizontal axis, its name and numbers.
    pub x: (Axis, &'a str, &'a dyn Fn(f64) -> String),
    /// Vertical axis likewise.
    pub y: (Axis, &'a str, &'a dyn Fn(f64) -> String),
    /// How points are joined.
    pub join: Join,
}

/// The figure with its legend; `table` is the data behind it. `None` without any point.
pub fn figure(chart: &Chart<'_>, lines: &[Line<'_>], table: Value) -> Option<Value> {
    let lines: Vec<&Line<'_>> = lines.iter().filter(|l| !l.points.is_empty()).collect();
    if lines.is_empty() {
        return None;
    }
    let (x, x_name, x_number) = chart.x;
    let (y, y_name, y_number) = chart.y;
    let mut svg = chart::open(chart.id, HEIGHT, chart.title, chart.text);
    svg += &chart::x_grid(&x, TOP, BOTTOM, x_number);
    svg += &chart::y_grid(&y, 8, y_number);
    let _ = write!(
        svg,
        r#"<text class="axis" x="4" y="24">{}</text><text class="axis end" x="{}" y="{:.0}">{}</text>"#,
        escape(y_name),
        chart::RIGHT,
        HEIGHT - 10.0,
        escape(x_name)
    );
    let bands = lines.len() <= MOST_WITH_BANDS;
    for line in &lines {
        svg += &draw(line, chart.join, bands, &x, &y);
    }
    svg += "</svg>";
    let keys: Vec<Value> = lines
        .iter()
        .map(|l| context! { label => l.label, index => l.index, swatch => Value::from_safe_string(palette::swatch(l.index)) })
        .collect();
    Some(
        context! { id => chart.id, title => chart.title, svg => Value::from_safe_string(svg), text => chart.text, keys, table },
    )
}

fn draw(line: &Line<'_>, join: Join, bands: bool, x: &Axis, y: &Axis) -> String {
    let i = line.index;
    let mut out = format!(r#"<g data-series="{i}"><title>{}</title>"#, escape(line.label));
    let at = |p: &[f64; 2]| [x.at(p[0]), y.at(p[1])];
    let drawn: Vec<[f64; 2]> = line.points.iter().map(at).collect();
    match join {
        Join::Steps => {
            if bands && line.ends.len() > 1 {
                let side = |k: usize| line.ends.iter().map(move |(p, e)| [x.at(*p), y.at(e[k])]);
                let (upper, mut lower): (Vec<_>, Vec<_>) = (side(1).collect(), side(0).collect());
                let upper = steps(&upper, false);
                // Backwards along the same steps: what holds until the next place is drawn as its mirror.
                lower.reverse();
                let _ = write!(
                    out,
                    r#"<path class="band fill {}" d="M{upper}L{}z"/>"#,
                    palette::colour(i),
                    steps(&lower, true)
                );
            }
            let _ = write!(out, r#"<path class="{} curve" d="M{}"/>"#, palette::line(i), steps(&drawn, false));
        }
        Join::Straight => {
            if bands {
                let mut whiskers = String::new();
                for (p, [low, high]) in &line.ends {
                    let _ = write!(whiskers, "M{:.1} {:.1}V{:.1}", x.at(*p), y.at(*low), y.at(*high));
                }
                if !whiskers.is_empty() {
                    let _ = write!(out, r#"<path class="line {} whisker" d="{whiskers}"/>"#, palette::colour(i));
                }
            }
            let points: Vec<String> = drawn.iter().map(|[px, py]| format!("{px:.1} {py:.1}")).collect();
            let _ = write!(out, r#"<path class="{} curve" d="M{}"/>"#, palette::line(i), points.join("L"));
            let inner = drawn.split_last().map_or(&[][..], |(_, inner)| inner);
            out.extend(inner.iter().map(|[px, py]| palette::marker(i, *px, *py)));
        }
    }
    out.extend(drawn.last().map(|[px, py]| palette::marker(i, *px, *py)));
    out + "</g>"
}

/// Steps along the points, without those that change nothing one could see: each value holds to the right of its
/// place, also where `backwards` goes from right to left.
fn steps(points: &[[f64; 2]], backwards: bool) -> String {
    let mut out = String::new();
    let Some(([x, y], rest)) = points.split_first() else { return out };
    let _ = write!(out, "{x:.1} {y:.1}");
    let (mut pen, mut last) = (*y, *x);
    for [x, y] in rest {
        if (y - pen).abs() >= 0.05 {
            let corner = if backwards { last } else { *x };
            let _ = write!(out, "H{corner:.1}V{y:.1}");
            pen = *y;
        }
        last = *x;
    }
    let _ = write!(out, "H{last:.1}");
    out
}

/// About `n` places from `low` to `high`, evenly on a logarithmic axis.
pub fn places(low: f64, high: f64, n: usize) -> Vec<f64> {
    let axis = Axis::log_exact(low, high.max(low * (1.0 + 1e-9)), 0.0, 1.0);
    let mut places: Vec<f64> = (0..=n).map(|k| axis.value_at(k as f64 / n as f64)).collect();
    // Rounding may leave the last one just below what happens there.
    places.extend([high * (1.0 + 1e-9)]);
    places
}

/// Whole powers of ten from `low` to `high`, and `high`: where tables read curves.
pub fn decades(low: f64, high: f64) -> Vec<f64> {
    let first = low.log10().ceil() as i32;
    let mut places: Vec<f64> = (first..first + 18).map(|e| 10f64.powi(e)).take_while(|p| *p < 0.7 * high).collect();
    places.push(high);
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_go_back_along_their_own_steps() {
        assert_eq!(steps(&[[0.0, 5.0], [1.0, 5.0], [2.0, 3.0], [4.0, 3.0]], false), "0.0 5.0H2.0V3.0H4.0");
        assert_eq!(steps(&[[4.0, 3.0], [2.0, 3.0], [1.0, 5.0], [0.0, 5.0]], true), "4.0 3.0H2.0V5.0H0.0");
    }

    #[test]
    fn places_cover_both_ends() {
        let p = places(2.0, 2000.0, 10);
        assert_eq!(p[0], 2.0);
        assert!(p.last().is_some_and(|l| *l >= 2000.0));
        assert_eq!(decades(3.0, 5000.0), [10.0, 100.0, 1000.0, 5000.0]);
    }
}
