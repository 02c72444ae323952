//! Empirical distribution of the effort until gap targets are reached.
//!
//! Hansen et al., *COCO*, Optim. Methods Softw. 36 (2021) 114–144.

use minijinja::Value;

use super::axis::Axis;
use super::data_table::{figure as cell, planner_row, table};
use super::evidence::Evidence;
use super::language::Strings;
use super::lines::{self, BOTTOM, Chart, Join, Line, TOP, decades, places};
use super::{chart, effort};
use crate::analysis::Effort;
use crate::analysis::targets::{Ecdf, ecdf, targets};
use crate::format;

/// Places along the axis at which curves are drawn.
const SAMPLES: usize = 200;

/// The figure by `effort`; `None` where no optimum is known or nothing was reached.
pub fn figure(evidence: &Evidence<'_>, kind: Effort, t: &Strings) -> Option<Value> {
    let [low, high] = evidence.range(kind)?;
    let targets = targets();
    let curves: Vec<Ecdf> =
        (0..evidence.results.planners.len()).map(|p| ecdf(&evidence.curves, p, None, &targets, kind)).collect();
    let runs = curves.iter().map(|c| c.pairs).max().unwrap_or(0) / targets.len();
    let ticks = places(low, high, SAMPLES);
    let lines: Vec<Line<'_>> = curves
        .iter()
        .enumerate()
        .filter(|(_, c)| !c.steps.is_empty())
        .map(|(index, c)| Line {
            label: evidence.label(index),
            index,
            points: ticks.iter().map(|x| [*x, c.at(*x)]).collect(),
            ends: Vec::new(),
        })
        .collect();
    let columns = decades(low, high);
    let rows = curves.iter().enumerate().filter(|(_, c)| c.pairs > 0).map(|(i, c)| {
        let cells = columns.iter().map(|x| cell(format::percent(c.at(x * (1.0 + 1e-9))))).collect();
        planner_row(evidence.label(i), i, cells)
    });
    let id = effort::id("ecdf", kind);
    let heads: Vec<String> = columns.iter().map(|x| effort::number(kind)(*x)).collect();
    let heads: Vec<&str> = [t.get("head_planner")].into_iter().chain(heads.iter().map(String::as_str)).collect();
    let data = table(&format!("{id}-data"), t.get("ecdf_table"), &heads, rows.collect());
    let mut text = vec![
        t.fill("ecdf_text", &[("targets", &targets.len().to_string()), ("runs", &t.plural(runs, "runs_one", "runs"))]),
        t.get("targets_when").to_owned(),
    ];
    text.extend(evidence.unlike(&|p| !curves[p].steps.is_empty(), "curve_absent", t));
    let text = text.join(t.get("sentence_gap"));
    let x = Axis::log(low, high, chart::LEFT, chart::RIGHT);
    let y = Axis::linear(0.0, 1.0, BOTTOM, TOP);
    let chart = Chart {
        id: &id,
        title: t.get(effort::key(kind, ["ecdf_title_evaluations", "ecdf_title_time"])),
        text: &text,
        x: (x, t.get(effort::key(kind, ["effort_evaluations", "effort_time"])), &effort::tick(kind)),
        y: (y, t.get("ecdf_y"), &format::percent),
        join: Join::Steps,
    };
    lines::figure(&chart, &lines, data)
}
