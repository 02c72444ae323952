//! The report of behaviour control: how its parameters were tuned, which they are, and what they are worth.

pub mod answers;
pub mod generations;
pub mod parameters;
pub mod tables;

use crate::results::{Results, RunRecord, TuningRun};
use crate::statistics::quantile;

/// Style rules of its figures.
pub const CSS: &str = include_str!("tuning.css");

/// The tunings of one planner, run by run.
fn tunings(results: &Results, planner: usize) -> Vec<&TuningRun> {
    results.runs_of(&results.planners[planner].label, None).filter_map(|r: &RunRecord| r.tuning.as_ref()).collect()
}

/// Whether the planner's parameters were searched, not given.
fn is_tuned(runs: &[&TuningRun]) -> bool {
    runs.iter().any(|run| !run.generations.is_empty())
}

/// Median and quartiles; `None` without values.
fn middle(values: &[f64]) -> Option<[f64; 3]> {
    Some([quantile(values, 0.5)?, quantile(values, 0.25)?, quantile(values, 0.75)?])
}

/// A fitness, four significant digits.
fn fitness(value: f64) -> String {
    crate::format::significant(value, 4)
}

#[cfg(test)]
mod tests;
