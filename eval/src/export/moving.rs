//! `simulations.csv` and `traces.jsonl` of moving scenes; `tuning.csv` and `parameters.csv` of behaviour control.

use super::csv::{cell, csv_text};
use crate::metrics::MOVING;
use crate::results::{Results, RunRecord};

/// The columns of `simulations.csv`: run, then every metric of [`MOVING`].
pub fn simulation_columns() -> Vec<&'static str> {
    let run = ["scene", "planner", "repeat", "seed", "status", "clean"];
    run.into_iter().chain(MOVING.iter().map(|m| m.metric.name)).collect()
}

/// `simulations.csv`: one row a run, sorted like `runs.csv`; a run that ended in an error has no metrics. Only the
/// columns from `call_p50_us` on differ between machines.
pub fn simulations_csv(results: &Results) -> String {
    let row = |r: &RunRecord| {
        let mut row = vec![
            r.scene.clone(),
            r.planner.clone(),
            r.repeat.to_string(),
            r.seed.to_string(),
            r.status.name().to_owned(),
            r.valid.to_string(),
        ];
        row.extend(MOVING.iter().map(|m| cell(r.moving.as_ref().and_then(m.value))));
        row
    };
    csv_text(&simulation_columns(), results.runs.iter().map(row))
}

/// `traces.jsonl`: who was where when, one simulation a line.
pub fn traces_jsonl(results: &Results) -> String {
    let line = |trace| serde_json::to_string(trace).expect("plain data") + "\n";
    results.traces.iter().map(line).collect()
}

/// `tuning.csv`: greatest and mean training fitness of every generation of every run.
pub fn tuning_csv(results: &Results) -> String {
    let of_run = |r: &RunRecord| -> Vec<[String; 6]> {
        let generations = r.tuning.iter().flat_map(|t| t.generations.iter().enumerate());
        let row = |(number, g): (usize, &crate::results::GenerationRecord)| {
            [
                r.planner.clone(),
                r.repeat.to_string(),
                r.seed.to_string(),
                number.to_string(),
                g.max.to_string(),
                g.mean.to_string(),
            ]
        };
        generations.map(row).collect()
    };
    let columns = ["planner", "repeat", "seed", "generation", "max", "mean"];
    csv_text(&columns, results.runs.iter().flat_map(of_run))
}

/// `parameters.csv`: one row a run, its fitness and every parameter.
pub fn parameters_csv(results: &Results) -> String {
    let tuned = || results.runs.iter().filter_map(|r| r.tuning.as_ref().map(|t| (r, t)));
    let names = tuned().next().map(|(_, t)| t.parameters.iter().map(|(name, _)| name.as_str()).collect());
    let names: Vec<&str> = names.unwrap_or_default();
    let mut columns = vec!["planner", "repeat", "seed", "training", "held_out", "arrived", "collided"];
    columns.extend(&names);
    let rows = tuned().map(|(r, t)| {
        let mut row = vec![r.planner.clone(), r.repeat.to_string(), r.seed.to_string(), cell(t.training)];
        row.extend([t.held_out, t.arrived, t.collided].map(|v| v.to_string()));
        row.extend(t.parameters.iter().map(|(_, value)| value.to_string()));
        row
    });
    csv_text(&columns, rows)
}
