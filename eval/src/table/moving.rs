//! Moving scenes, and tunings of behaviour control.

use super::framed;
use crate::analysis::{MovingSummary, summarise_moving};
use crate::format;
use crate::results::{Results, RunRecord, TuningRun};
use crate::statistics::median;

/// What the figures of [`simulations`] are.
pub const LEGEND: &str = "Clean: all arrived, nobody touched anybody or broke a rule. Over bound: median of mean arrival over least \
    time, ∞ where half the runs are not clean.\nRates and shares over all simulated time. Call: medians of the runs' \
    median and 99 %, and the longest of all. Late: frames that took too long.\n";

/// The simulations of every planner, in one scene or all.
pub fn simulations(results: &Results, scene: Option<&str>) -> String {
    let header = [
        "planner",
        "clean",
        "arrived",
        "collisions/min",
        "fouls/min",
        "breaches/min",
        "over bound",
        "switches/s",
        "call p50",
        "p99",
        "max",
        "late",
    ];
    let rows = results.planners.iter().filter_map(|p| summarise_moving(results, &p.label, scene));
    framed(&header, rows.map(|s| row(&s).to_vec()))
}

fn row(s: &MovingSummary) -> [String; 12] {
    let over = match s.time_ratio - 1.0 {
        over if over.is_infinite() => "∞".to_owned(),
        over if over < 0.0 => format::percent(over),
        over => format!("+{}", format::percent(over)),
    };
    let [p50, p99, max] = s.call_us.map(format::time);
    [
        s.planner.clone(),
        format!("{}/{}", s.clean, s.runs),
        format::percent(s.arrived),
        format::significant(s.collisions_per_minute, 3),
        format::significant(s.fouls_per_minute, 3),
        format::significant(s.violations_per_minute, 3),
        over,
        format::significant(s.switches_per_s, 3),
        p50,
        p99,
        max,
        s.misses.to_string(),
    ]
}

/// The fitness of every planner.
pub fn tunings(results: &Results) -> String {
    let header = ["planner", "runs", "held-out fitness", "worst", "best", "training", "arrived", "collided", "time"];
    let rows = results.planners.iter().map(|planner| {
        let runs: Vec<&RunRecord> = results.runs_of(&planner.label, None).collect();
        let middle = |of: &dyn Fn(&TuningRun) -> Option<f64>| {
            median(&runs.iter().filter_map(|r| r.tuning.as_ref().and_then(of)).collect::<Vec<f64>>())
        };
        let told = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |v| format::significant(v, 4));
        let share = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), format::percent);
        let held: Vec<f64> = runs.iter().filter_map(|r| r.tuning.as_ref().map(|t| t.held_out)).collect();
        vec![
            planner.label.clone(),
            runs.len().to_string(),
            told(median(&held)),
            told(held.iter().copied().reduce(f64::min)),
            told(held.iter().copied().reduce(f64::max)),
            told(middle(&|t| t.training)),
            share(middle(&|t| Some(t.arrived))),
            share(middle(&|t| Some(t.collided))),
            median(&runs.iter().map(|r| r.time_us).collect::<Vec<f64>>()).map_or_else(|| "–".to_owned(), format::time),
        ]
    });
    framed(&header, rows)
}
