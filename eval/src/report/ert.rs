//! Expected running times to gap targets. Auger & Hansen, *CEC* 2005.

use minijinja::{Value, context};

use super::axis::Axis;
use super::data_table::{planner_row, table};
use super::evidence::Evidence;
use super::language::Strings;
use super::lines::{self, BOTTOM, Chart, Join, Line, TOP};
use super::{chart, effort};
use crate::analysis::Effort;
use crate::analysis::targets::{Ert, RESAMPLES, SHOWN, ert};
use crate::format;

/// The figure by `kind` of effort with its table; `None` where no target was reached.
pub fn figure(evidence: &Evidence<'_>, kind: Effort, t: &Strings) -> Option<Value> {
    let times = ert(&evidence.curves, None, &SHOWN, kind);
    let number = effort::number(kind);
    let positive = |e: &Ert| e.value > 0.0 && e.value.is_finite();
    let lines: Vec<Line<'_>> = times
        .iter()
        .enumerate()
        .map(|(index, row)| {
            let known: Vec<(f64, &Ert)> = SHOWN.iter().copied().zip(row).filter(|(_, e)| positive(e)).collect();
            Line {
                label: evidence.label(index),
                index,
                points: known.iter().map(|(target, e)| [*target, e.value]).collect(),
                ends: known.iter().filter_map(|(target, e)| Some((*target, e.interval?))).collect(),
            }
        })
        .collect();
    let values = || lines.iter().flat_map(|l| &l.points).map(|p| p[1]);
    let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max));
    if low > high {
        return None;
    }
    let rows = times.iter().enumerate().filter(|(_, row)| row[0].runs > 0).map(|(i, row)| {
        let cell = |e: &Ert| {
            let interval = e.interval.map(|[low, high]| format!("[{}, {}]", number(low), number(high)));
            let reached = format!("{}/{}", e.reached, e.runs);
            let small = interval.map_or(reached.clone(), |interval| format!("{interval} · {reached}"));
            context! { shown => number(e.value), key => format::sort_key(e.value), kind => "num", small }
        };
        planner_row(evidence.label(i), i, row.iter().map(cell).collect())
    });
    let id = effort::id("ert", kind);
    let heads: Vec<String> = SHOWN.iter().map(|target| format!("≤ {}", format::percent(*target))).collect();
    let heads: Vec<&str> = [t.get("head_planner")].into_iter().chain(heads.iter().map(String::as_str)).collect();
    let data = table(&format!("{id}-data"), t.get("ert_table"), &heads, rows.collect());
    let mut text = vec![t.fill("ert_text", &[("resamples", &RESAMPLES.to_string())]), t.get("targets_when").to_owned()];
    text.extend(evidence.unlike(&|p| !lines[p].points.is_empty(), "curve_absent", t));
    let text = text.join(t.get("sentence_gap"));
    // The hardest target is on the right.
    let x = Axis::log_exact(SHOWN[SHOWN.len() - 1], SHOWN[0], chart::RIGHT - 14.0, chart::LEFT + 14.0);
    let y = Axis::log(low, high, BOTTOM, TOP);
    let chart = Chart {
        id: &id,
        title: t.get(effort::key(kind, ["ert_title_evaluations", "ert_title_time"])),
        text: &text,
        x: (x, t.get("ert_x"), &format::percent),
        y: (y, t.get(effort::key(kind, ["effort_evaluations", "effort_time"])), &effort::tick(kind)),
        join: Join::Straight,
    };
    lines::figure(&chart, &lines, data)
}
