//! Strips of dots: one dot a run, a box from quartile to quartile, a bar at the
//! median, and failures apart on the +∞ side.

use std::fmt::Write as _;

use minijinja::{Value, context};

use super::language::Strings;
use super::svg::escape;
use super::{axis::Axis, chart, palette};
use crate::statistics::quantile;

/// The values of one planner; +∞ for failures, except of times.
pub struct Row<'a> {
    /// Label of the planner.
    pub label: &'a str,
    /// Its place in the comparison.
    pub index: usize,
    /// One value a run.
    pub values: Vec<f64>,
    /// Runs without a valid path.
    pub failed: usize,
}

/// What a strip chart says besides its rows.
pub struct Kind<'a> {
    /// Unique in the page.
    pub id: &'a str,
    /// Heading.
    pub title: &'a str,
    /// Name of the axis, with the unit.
    pub axis: &'a str,
    /// The paragraph below.
    pub text: &'a str,
    /// How values are written.
    pub number: fn(f64) -> String,
    /// Values below this are drawn on the edge of a logarithmic axis.
    pub floor: f64,
}

const ROW: f64 = 56.0;
const TOP: f64 = 14.0;
/// Where dots end and failures begin.
const SPLIT: f64 = 556.0;
const FROM: f64 = 24.0;

/// The figure: chart, paragraph and table; `None` without any row that has values.
pub fn figure(rows: &[Row<'_>], kind: &Kind<'_>, t: &Strings) -> Option<Value> {
    let rows: Vec<&Row<'_>> = rows.iter().filter(|r| !r.values.is_empty()).collect();
    if rows.is_empty() {
        return None;
    }
    let every = rows.iter().flat_map(|r| r.values.iter().copied());
    // Failures alone still make a chart: their column says what there is to say.
    let axis = Axis::fitting(every.clone(), 20.0, kind.floor, FROM, SPLIT - 14.0).unwrap_or(Axis::linear(
        0.0,
        1.0,
        FROM,
        SPLIT - 14.0,
    ));
    let blank = every.clone().all(f64::is_infinite);
    let failures = every.clone().any(f64::is_infinite);
    let bottom = TOP + ROW * rows.len() as f64 + if failures { 14.0 } else { 0.0 };
    let top = if failures { TOP + 14.0 } else { TOP };
    let mut svg = chart::open(kind.id, bottom + 58.0, kind.title, kind.text);
    if !blank {
        svg += &chart::x_grid(&axis, top, bottom, &kind.number);
    }
    if failures {
        let _ = write!(
            svg,
            r#"<path class="grid" d="M{SPLIT} {top:.1}V{bottom:.1}"/><text class="tick middle" x="{:.1}" y="{:.1}">{}</text>"#,
            (SPLIT + chart::WIDTH) / 2.0,
            bottom + 22.0,
            escape(t.get("strip_failed"))
        );
    }
    let _ = write!(
        svg,
        r#"<text class="axis end" x="{:.1}" y="{:.1}">{}</text>"#,
        SPLIT - 14.0,
        bottom + 48.0,
        escape(kind.axis)
    );
    for (place, row) in rows.iter().enumerate() {
        svg += &draw(row, top + ROW * place as f64, &axis, kind, t);
    }
    svg += "</svg>";
    let table: Vec<Value> = rows
        .iter()
        .map(|row| {
            let cells: Vec<String> =
                [0.0, 0.25, 0.5, 0.75, 1.0].iter().filter_map(|q| quantile(&row.values, *q)).map(kind.number).collect();
            context! {
                label => row.label, swatch => Value::from_safe_string(palette::swatch(row.index)),
                cells, failed => row.failed, runs => row.values.len(),
            }
        })
        .collect();
    Some(context! { svg => Value::from_safe_string(svg), title => kind.title, text => kind.text, table })
}

fn draw(row: &Row<'_>, top: f64, axis: &Axis, kind: &Kind<'_>, t: &Strings) -> String {
    let middle = top + 37.0;
    let i = row.index;
    let median = quantile(&row.values, 0.5).unwrap_or(f64::INFINITY);
    let mut out = format!(
        r#"<g data-series="{i}"><path class="grid" d="M{FROM} {middle:.1}H{:.1}"/>{}<text class="row" x="{}" y="{:.1}">{}</text><text class="row end" x="{:.1}" y="{:.1}">{}</text>"#,
        SPLIT - 14.0,
        palette::marker(i, FROM + 5.0, top + 15.0),
        FROM + 18.0,
        top + 20.0,
        escape(row.label),
        SPLIT - 14.0,
        top + 20.0,
        escape(&t.fill("strip_median", &[("value", &(kind.number)(median))]))
    );
    let quartile = |q| quantile(&row.values, q).unwrap_or(f64::INFINITY);
    let (low, high) = (quartile(0.25), quartile(0.75));
    if low.is_finite() {
        let (x0, x1) = (axis.at(low), if high.is_finite() { axis.at(high) } else { SPLIT });
        let _ = write!(
            out,
            r#"<rect class="box fill {}" x="{:.1}" y="{:.1}" width="{:.1}" height="20" rx="3"/>"#,
            palette::colour(i),
            x0 - 1.0,
            middle - 10.0,
            (x1 - x0).max(0.0) + 2.0
        );
    }
    let mut dots = String::new();
    for (k, v) in row.values.iter().enumerate().filter(|(_, v)| v.is_finite()) {
        // The golden ratio's multiples spread any number of dots evenly.
        let jitter = ((k as f64 * 0.618_033_988_75).fract() - 0.5) * 14.0;
        let _ = write!(dots, "M{:.1} {:.1}h0", axis.at(*v), middle + jitter);
    }
    if !dots.is_empty() {
        let _ = write!(out, r#"<path class="dots line {}" d="{dots}"/>"#, palette::colour(i));
    }
    if median.is_finite() {
        let _ = write!(out, r#"<path class="median" d="M{:.1} {:.1}v24"/>"#, axis.at(median), middle - 12.0);
    }
    let failed = row.values.iter().filter(|v| v.is_infinite()).count();
    if failed > 0 {
        let _ = write!(
            out,
            r#"<path class="cross" d="M{:.1} {:.1}l10 10m0-10l-10 10"/><text class="row warn" x="{:.1}" y="{:.1}">{}</text>"#,
            SPLIT + 16.0,
            middle - 5.0,
            SPLIT + 36.0,
            middle + 5.5,
            escape(&format!("{failed}/{}", row.values.len()))
        );
    }
    out + "</g>"
}
