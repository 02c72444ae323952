//! Every run of one planner in one moving scene, as a table.

use minijinja::Value;

use super::super::data_table::{number, row, table, words};
use super::super::language::Strings;
use super::{millimetres, moving, seconds, times};
use crate::format;
use crate::results::RunRecord;

/// The table.
pub fn runs(runs: &[&RunRecord], id: &str, t: &Strings) -> Value {
    let count = |n: u32| number(n.to_string(), f64::from(n));
    let optional = |v: Option<f64>, shown: &dyn Fn(f64) -> String| {
        number(v.map_or(format::NONE.to_owned(), shown), v.unwrap_or(f64::INFINITY))
    };
    let line = |r: &&RunRecord| {
        let m = moving(r).map(|m| (m.metrics, m.compute));
        let counted = |value: &dyn Fn(&strategy::Metrics) -> u32| {
            m.as_ref().map_or_else(|| words(format::NONE), |(m, _)| count(value(m)))
        };
        row(vec![
            words(r.repeat.to_string()),
            number(r.seed.to_string(), r.seed as f64),
            words(t.get(if r.valid { "yes" } else { "no" })),
            m.as_ref().map_or_else(
                || words(format::NONE),
                |(m, _)| number(format!("{}/{}", m.arrived, m.robots), m.arrived as f64),
            ),
            counted(&|m| m.collisions),
            counted(&|m| m.violations),
            counted(&|m| m.fouls),
            optional(m.as_ref().and_then(|(m, _)| m.arrival_s), &seconds),
            optional(m.as_ref().and_then(|(m, _)| m.time_ratio()), &times),
            optional(m.as_ref().and_then(|(m, _)| m.least_clearance), &millimetres),
            optional(m.as_ref().map(|(_, c)| c.frame_us[3]), &format::time),
        ])
    };
    let heads = [
        "run_repeat",
        "run_seed",
        "run_valid",
        "moving_arrived",
        "moving_run_collisions",
        "moving_run_violations",
        "moving_run_fouls",
        "moving_run_arrival",
        "moving_run_ratio",
        "run_clearance",
        "moving_run_frame",
    ]
    .map(|key| t.get(key));
    table(id, t.get("run_table"), &heads, runs.iter().map(line).collect())
}
