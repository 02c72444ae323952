//! How long controllers take: one robot's call and all robots of a frame, against the frame.

use std::fmt::Write as _;

use minijinja::{Value, context};
use strategy::Compute;

use super::super::axis::Axis;
use super::super::data_table::{number, planner_row, table};
use super::super::language::Strings;
use super::super::svg::escape;
use super::super::{chart, palette};
use super::{ByScene, moving};
use crate::format;
use crate::results::{Results, RunRecord};
use crate::statistics::median;

/// For reference where scenes differ in their frame rates: a frame at 60 Hz, 16.7 ms, in microseconds, less a little for
/// the rest of a team's program.
const REFERENCE_US: f64 = 16_000.0;

const ROW: f64 = 74.0;
const TOP: f64 = 34.0;
/// Room for the names of the two bars.
const LEFT: f64 = 142.0;

/// One planner's times.
struct Row<'a> {
    label: &'a str,
    index: usize,
    /// Median over runs of 50, 99 and 99.9 % of one robot's calls, and the greatest of all.
    call: [f64; 4],
    /// Likewise of frames.
    frame: [f64; 4],
    misses: u64,
}

fn over_runs(runs: &[&RunRecord], of: &dyn Fn(&Compute) -> [f64; 4]) -> Option<[f64; 4]> {
    let all: Vec<[f64; 4]> = runs.iter().filter_map(|r| Some(of(&moving(r)?.compute))).collect();
    let column = |k: usize| all.iter().map(|c| c[k]).collect::<Vec<f64>>();
    let greatest = column(3).into_iter().fold(0.0, f64::max);
    Some([median(&column(0))?, median(&column(1))?, median(&column(2))?, greatest])
}

/// The frame rate of all scenes, in Hz; `None` where they differ or it is not known.
fn frame_rate(results: &Results) -> Option<f64> {
    let mut rates = results.scenes.iter().map(|s| s.simulation.as_ref().map(|s| s.frame_rate));
    let first = rates.next()??;
    rates.all(|rate| rate == Some(first)).then_some(first)
}

/// The figure; `None` without any run that ended.
pub fn figure(results: &Results, by_planner: &[ByScene<'_>], id: &str, t: &Strings) -> Option<Value> {
    let row = |(index, scenes): (usize, &ByScene<'_>)| {
        let runs: Vec<&RunRecord> = scenes.iter().flatten().copied().collect();
        Some(Row {
            label: &results.planners[index].label,
            index,
            call: over_runs(&runs, &|c| c.call_us)?,
            frame: over_runs(&runs, &|c| c.frame_us)?,
            misses: runs.iter().filter_map(|r| moving(r)).map(|m| m.compute.misses).sum(),
        })
    };
    let rows: Vec<Row<'_>> = by_planner.iter().enumerate().filter_map(row).collect();
    if rows.is_empty() {
        return None;
    }
    let rate = frame_rate(results);
    let line_us = rate.map_or(REFERENCE_US, |rate| 1e6 / rate);
    let every = || rows.iter().flat_map(|r| r.call.into_iter().chain(r.frame)).filter(|v| *v > 0.0);
    let low = every().fold(line_us / 10.0, f64::min);
    let axis = Axis::log(low / 1.3, 1.3 * every().fold(line_us, f64::max), LEFT, chart::RIGHT);
    let bottom = TOP + ROW * rows.len() as f64;
    let line = match rate {
        Some(rate) => {
            t.fill("compute_period", &[("time", &format::time(line_us)), ("rate", &format::significant(rate, 3))])
        }
        None => t.fill("compute_reference", &[("time", &format::time(line_us))]),
    };
    let text = [t.get("compute_text"), &line].join(t.get("sentence_gap"));
    let (title, text) = (t.get("compute_title"), text.as_str());
    let mut svg = chart::open(id, bottom + 58.0, title, text);
    svg += &chart::x_grid(&axis, TOP, bottom, &format::time);
    let deadline = axis.at(line_us);
    let _ = write!(
        svg,
        r#"<path class="deadline" d="M{deadline:.1} {TOP}V{bottom:.1}"/><text class="middle warn" x="{deadline:.1}" y="{:.1}">{}</text><text class="axis end" x="{}" y="{:.1}">{}</text>"#,
        TOP - 10.0,
        escape(&format::time(line_us)),
        chart::RIGHT,
        bottom + 48.0,
        escape(t.get("compute_axis"))
    );
    for (place, row) in rows.iter().enumerate() {
        svg += &draw(row, TOP + ROW * place as f64, &axis, t);
    }
    svg += "</svg>";
    Some(context! {
        id, title, text, svg => Value::from_safe_string(svg), keys => Vec::<Value>::new(), table => data(&rows, id, t),
    })
}

fn draw(row: &Row<'_>, top: f64, axis: &Axis, t: &Strings) -> String {
    let i = row.index;
    let mut out = format!(
        r#"<g data-series="{i}">{}<text class="row" x="24" y="{:.1}">{}</text>"#,
        palette::marker(i, 11.0, top + 15.0),
        top + 20.0,
        escape(row.label)
    );
    let bars = [(row.call, "range", 39.0, "compute_call"), (row.frame, "range frame", 61.0, "compute_frame")];
    for ([p50, p99, p999, most], class, down, name) in bars {
        let y = top + down;
        let [x0, x1, x2, x3] = [p50, p99, p999, most].map(|v| axis.at(v.max(1e-9)));
        let _ = write!(
            out,
            r#"<text class="tick end" x="{:.1}" y="{:.1}">{}</text><path class="line {class} {}" d="M{x0:.1} {y:.1}H{:.1}"/><path class="stop" d="M{x0:.1} {:.1}v16M{x1:.1} {:.1}v10M{x2:.1} {:.1}v10"/>"#,
            LEFT - 10.0,
            y + 5.0,
            escape(t.get(name)),
            palette::colour(i),
            x3.max(x0 + 1.0),
            y - 8.0,
            y - 5.0,
            y - 5.0
        );
        out += &palette::marker(i, x3, y);
    }
    out + "</g>"
}

fn data(rows: &[Row<'_>], id: &str, t: &Strings) -> Value {
    let heads: Vec<String> = ["compute_call", "compute_frame"]
        .iter()
        .flat_map(|key| ["50\u{a0}%", "99\u{a0}%", "99.9\u{a0}%", "max"].map(|q| (*key, q)))
        .map(|(key, q)| format!("{}: {}", t.get(key), if q == "max" { t.get("compute_max") } else { q }))
        .collect();
    let first = [t.get("head_planner")];
    let heads: Vec<&str> =
        first.into_iter().chain(heads.iter().map(String::as_str)).chain([t.get("moving_misses")]).collect();
    let cells = |row: &Row<'_>| -> Vec<Value> {
        let times = row.call.into_iter().chain(row.frame).map(|us| number(format::time(us), us));
        times.chain([number(format::count(row.misses as f64), row.misses as f64)]).collect()
    };
    let rows = rows.iter().map(|r| planner_row(r.label, r.index, cells(r))).collect();
    table(&format!("{id}-data"), t.get("compute_table"), &heads, rows)
}
