//! What the parameters of each planner are worth on held-out scenarios.

use minijinja::Value;

use super::super::data_table::{number, planner_row, table, with_interval};
use super::super::language::Strings;
use super::super::strip::{self, Row};
use super::{fitness, tunings};
use crate::format;
use crate::results::{Results, TuningRun};
use crate::statistics::median;
use crate::statistics::median_interval::median_interval;

/// One row a planner.
pub fn comparison(results: &Results, id: &str, t: &Strings) -> Value {
    let rows = (0..results.planners.len()).filter_map(|p| {
        let runs = tunings(results, p);
        let middle = |value: &dyn Fn(&TuningRun) -> Option<f64>, shown: &dyn Fn(f64) -> String| {
            let values: Vec<f64> = runs.iter().filter_map(|r| value(r)).collect();
            let interval = median_interval(&values).map(|i| [i.low, i.high]);
            median(&values).map_or_else(|| number(format::NONE, f64::INFINITY), |m| with_interval(m, interval, shown))
        };
        let cells = vec![
            number(format::count(runs.len() as f64), runs.len() as f64),
            middle(&|r| Some(r.held_out), &fitness),
            middle(&|r| r.training, &fitness),
            middle(&|r| Some(r.arrived), &format::percent),
            middle(&|r| Some(r.collided), &format::percent),
        ];
        (!runs.is_empty()).then(|| planner_row(&results.planners[p].label, p, cells))
    });
    let heads =
        ["head_planner", "strip_runs", "tuning_held_out", "tuning_training", "tuning_arrived", "tuning_collided"];
    table(id, t.get("table_caption"), &heads.map(|key| t.get(key)), rows.collect())
}

/// Held-out fitness, a dot a run.
pub fn spread(results: &Results, t: &Strings) -> Option<Value> {
    let rows: Vec<Row<'_>> = (0..results.planners.len())
        .map(|index| {
            let label = results.planners[index].label.as_str();
            let value = |r: &crate::results::RunRecord| r.tuning.as_ref().map_or(f64::INFINITY, |tuned| tuned.held_out);
            let values: Vec<f64> = results.runs_of(label, None).map(value).collect();
            let failed = values.iter().filter(|v| v.is_infinite()).count();
            Row { label, index, values, failed }
        })
        .collect();
    let (title, axis, text) = (t.get("held_out_title"), t.get("tuning_held_out"), t.get("held_out_text"));
    strip::figure(&rows, &strip::Kind { id: "held-out", title, axis, text, number: fitness, floor: 1e-3 }, t)
}
