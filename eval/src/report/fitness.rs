//! Best and mean fitness by generation, a panel for each planner that evolves a population.
//!
//! Fitness is the planner's own and larger is better; its scale differs from planner to planner,
//! so each panel has its own axis.

use std::fmt::Write as _;

use minijinja::{Value, context};

use super::language::Strings;
use super::svg::escape;
use super::{axis::Axis, chart, palette};
use crate::format;
use crate::snapshot::Snapshot;

/// Height of a panel, its heading included.
const PANEL: f64 = 190.0;
/// Room for the heading.
const HEAD: f64 = 34.0;
const TOP: f64 = 8.0;

/// The figure: panels, paragraph and table; `None` without populations. `place` is a planner's
/// place in the comparison.
pub fn figure(id: &str, snapshots: &[&Snapshot], place: impl Fn(&str) -> Option<usize>, t: &Strings) -> Option<Value> {
    let evolved: Vec<(&Snapshot, usize)> =
        snapshots.iter().filter(|s| !s.generations.is_empty()).filter_map(|s| Some((*s, place(&s.planner)?))).collect();
    if evolved.is_empty() {
        return None;
    }
    let most = evolved.iter().filter_map(|(s, _)| s.generations.last()).map(|g| g.0).max().unwrap_or(0).max(1) as f64;
    let x = Axis::linear(0.0, most, chart::LEFT, chart::RIGHT);
    let bottom = TOP + PANEL * evolved.len() as f64 - 14.0;
    let text = t.get("fitness_text").to_owned();
    let mut svg = chart::open(id, bottom + 58.0, t.get("fitness_title"), &text);
    svg += &chart::x_grid(&x, TOP + HEAD, bottom, &format::count);
    for (k, (snapshot, index)) in evolved.iter().enumerate() {
        svg += &panel(snapshot, *index, TOP + PANEL * k as f64, &x);
    }
    let _ = write!(
        svg,
        r#"<text class="axis end" x="{}" y="{:.1}">{}</text></svg>"#,
        chart::RIGHT,
        bottom + 48.0,
        escape(t.get("fitness_x"))
    );
    let columns = columns(most);
    let rows: Vec<Value> = evolved
        .iter()
        .map(|(s, index)| {
            let cells: Vec<String> = columns.iter().map(|c| at(s, *c)).collect();
            let seed = s.seed.to_string();
            context! { label => s.planner.as_str(), swatch => Value::from_safe_string(palette::swatch(*index)), cells, seed }
        })
        .collect();
    let columns: Vec<String> = columns.into_iter().map(|c| format::count(c as f64)).collect();
    Some(context! { svg => Value::from_safe_string(svg), text, rows, columns })
}

fn panel(snapshot: &Snapshot, index: usize, top: f64, x: &Axis) -> String {
    let (upper, lower) = (top + HEAD, top + PANEL - 14.0);
    let values = || snapshot.generations.iter().flat_map(|(_, best, mean)| [*best, *mean]);
    let (lo, hi) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let pad = 0.05 * (hi - lo);
    let y = Axis::linear(lo - pad, hi + pad, lower, upper);
    let mut out = format!(
        r#"<g data-series="{index}">{}<text class="row" x="{}" y="{:.1}">{}</text>"#,
        palette::marker(index, 12.0, top + 15.0),
        24.0,
        top + 20.0,
        escape(&snapshot.planner)
    );
    out += &chart::y_grid(&y, 5, &|v| format::significant(v, 4));
    let colour = palette::colour(index);
    let line = |value: &dyn Fn(&(u64, f64, f64)) -> f64| {
        let points: Vec<String> =
            snapshot.generations.iter().map(|g| format!("{:.1} {:.1}", x.at(g.0 as f64), y.at(value(g)))).collect();
        // A lone generation is a dot.
        format!("M{}{}", points.join("L"), if points.len() == 1 { "h.1" } else { "" })
    };
    let _ = write!(
        out,
        r#"<path class="line {colour} mean" d="{}"/><path class="line {colour} best" d="{}"/></g>"#,
        line(&|g| g.2),
        line(&|g| g.1)
    );
    out
}

/// Generations at which the table reads the curves: powers of ten and the end.
fn columns(most: f64) -> Vec<u64> {
    let mut columns = vec![0];
    columns.extend((0..18).map(|e| 10_u64.pow(e)).take_while(|g| (*g as f64) < 0.7 * most));
    columns.push(most as u64);
    columns
}

/// "best / mean" of the last generation up to `generation`.
fn at(snapshot: &Snapshot, generation: u64) -> String {
    let known = snapshot.generations.partition_point(|g| g.0 <= generation);
    known.checked_sub(1).map_or(format::NONE.to_owned(), |i| {
        let (_, best, mean) = snapshot.generations[i];
        format!("{} / {}", format::significant(best, 4), format::significant(mean, 4))
    })
}
