//! How good planners are after a given effort: median gaps with their intervals.

use minijinja::Value;

use super::axis::Axis;
use super::data_table::{planner_row, table, with_interval};
use super::evidence::Evidence;
use super::language::Strings;
use super::lines::{self, BOTTOM, Chart, Join, Line, TOP, decades, places};
use super::{chart, effort};
use crate::analysis::Effort;
use crate::analysis::fixed_budget::{Band, fixed_budget};
use crate::format;

/// Places along the axis at which curves are drawn.
const SAMPLES: usize = 120;
/// Gaps below this are drawn on the edge of the axis.
const FLOOR: f64 = 1e-8;

/// The figure by `kind` of effort; `None` where no optimum is known or nothing was found.
pub fn figure(evidence: &Evidence<'_>, kind: Effort, t: &Strings) -> Option<Value> {
    let [low, high] = evidence.range(kind)?;
    let ticks = places(low, high, SAMPLES);
    let at = |planner: usize, places: &[f64]| fixed_budget(&evidence.curves, planner, None, kind, places);
    let planners = || 0..evidence.results.planners.len();
    let curves: Vec<Vec<Band>> = planners().map(|p| at(p, &ticks)).collect();
    let lines: Vec<Line<'_>> = curves
        .iter()
        .enumerate()
        .map(|(index, bands)| {
            let known = || bands.iter().filter(|b| b.median.is_finite());
            Line {
                label: evidence.label(index),
                index,
                points: known().map(|b| [b.at, b.median]).collect(),
                ends: known().filter_map(|b| b.interval.map(|i| (b.at, [i.low, i.high]))).collect(),
            }
        })
        .collect();
    let y = Axis::fitting(lines.iter().flat_map(|l| &l.points).map(|p| p[1]), 10.0, FLOOR, BOTTOM, TOP)?;
    let columns = decades(low, high);
    let rows = planners().filter(|p| !curves[*p].is_empty()).map(|p| {
        // A little later, so that rounding leaves nothing just before its own place.
        let later: Vec<f64> = columns.iter().map(|x| x * (1.0 + 1e-9)).collect();
        let cell = |b: &Band| with_interval(b.median, b.interval.map(|i| [i.low, i.high]), &format::percent);
        planner_row(evidence.label(p), p, at(p, &later).iter().map(cell).collect())
    });
    let id = effort::id("fixed", kind);
    let heads: Vec<String> = columns.iter().map(|x| effort::number(kind)(*x)).collect();
    let heads: Vec<&str> = [t.get("head_planner")].into_iter().chain(heads.iter().map(String::as_str)).collect();
    let data = table(&format!("{id}-data"), t.get("fixed_table"), &heads, rows.collect());
    let over = if evidence.curves.scenes().len() == 1 { "over_runs" } else { "over_scenes" };
    let many = lines.iter().filter(|l| !l.points.is_empty()).count() > lines::MOST_WITH_BANDS;
    let bands = t.get(if many { "fixed_no_bands" } else { "fixed_bands" });
    let mut text = [t.get("fixed_text"), t.get(over), bands, t.get("targets_when")].map(str::to_owned).to_vec();
    text.extend(evidence.unlike(&|p| !lines[p].points.is_empty(), "curve_absent_fixed", t));
    let text = text.join(t.get("sentence_gap"));
    let chart = Chart {
        id: &id,
        title: t.get(effort::key(kind, ["fixed_title_evaluations", "fixed_title_time"])),
        text: &text,
        x: (
            Axis::log(low, high, chart::LEFT, chart::RIGHT),
            t.get(effort::key(kind, ["effort_evaluations", "effort_time"])),
            &effort::tick(kind),
        ),
        y: (y, t.get("fixed_y"), &format::percent_tick),
        join: Join::Steps,
    };
    lines::figure(&chart, &lines, data)
}
