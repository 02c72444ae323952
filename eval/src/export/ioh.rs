//! `ioh.csv` for `IOHanalyzer` (≥ 0.1.7), which maps columns of any CSV to evaluations, function value,
//! function, algorithm, dimension and run.
//!
//! The function is the scene, and its value is the gap, length/optimum − 1, or the length itself where
//! the optimum is not known. Wang, Vermetten, Ye, Doerr & Bäck, *`IOHanalyzer`* (2022),
//! [doi](https://doi.org/10.1145/3510426).

use super::csv::{cell, csv_text};
use crate::analysis::cost_is_length;
use crate::results::Results;

/// The columns.
pub const COLUMNS: [&str; 7] =
    ["evaluations", "function_value", "function_id", "algorithm_id", "dimension", "run_id", "time_us"];

/// The value of a run without a valid path: no path is that long, and `IOHanalyzer` knows no infinity.
pub const FAILURE: f64 = 1e9;

/// A cost that is below the optimum by a larger share is of no valid path; arcs stored as polylines come as near.
const BELOW: f64 = 1e-6;

/// One row for each improvement of a run, and one for its end, where the judge's verdict counts: a run without a
/// valid path has that row alone, of value [`FAILURE`]. Improvements are in the planner's own cost, so they are told
/// only of planners whose cost is the path's length in every valid run; costs below the optimum, of paths through obstacles, are left out.
pub fn csv(results: &Results) -> String {
    let mut rows: Vec<[String; 7]> = Vec::new();
    for run in &results.runs {
        let optimum = results.scenes.iter().find(|s| s.scene.name == run.scene).and_then(|s| s.optimum.length);
        let value = |length: f64| optimum.map_or(length, |optimum| length / optimum - 1.0);
        let row = |evaluations: u64, value: f64, time_us: f64| {
            let (evaluations, repeat) = (evaluations.to_string(), run.repeat.to_string());
            let (function, algorithm) = (run.scene.clone(), run.planner.clone());
            [evaluations, cell(Some(value)), function, algorithm, "2".to_owned(), repeat, cell(Some(time_us))]
        };
        let end = run.length.filter(|_| run.valid);
        if end.is_some() && results.runs_of(&run.planner, None).all(cost_is_length) {
            let possible = run.progress.iter().filter(|p| optimum.is_none_or(|o| p.cost >= o * (1.0 - BELOW)));
            rows.extend(possible.map(|p| row(p.evaluations, value(p.cost), p.time_us)));
        }
        rows.push(row(run.evaluations, end.map_or(FAILURE, value), run.time_us));
    }
    csv_text(&COLUMNS, rows.into_iter())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::{Optimum, Progress, RunRecord};
    use crate::testing::{campaign, detour, entry, nothing};

    #[test]
    fn improvements_are_gaps_and_failures_the_worst() {
        let campaign = campaign(vec![entry("good", detour), entry("bad", nothing)]);
        let mut results = campaign.empty_results(1);
        results.scenes[0].optimum = Optimum { length: Some(10.0), path: Vec::new(), reason: None };
        results.scenes[1].optimum.length = None;
        let progress = |costs: [f64; 3]| {
            let at = |(i, cost): (u32, f64)| Progress { evaluations: u64::from(10 * i), time_us: i.into(), cost };
            (1..).zip(costs).map(at).collect::<Vec<_>>()
        };
        let run = |planner: &str, scene: &str, costs| RunRecord {
            evaluations: 50,
            time_us: 9.0,
            progress: progress(costs),
            ..RunRecord::empty(scene, planner, 0, 1)
        };
        let valid = |run: RunRecord, cost| RunRecord { valid: true, length: Some(11.0), cost: Some(cost), ..run };
        results.runs = vec![
            valid(run("good", "b-scene", [5.0, 12.0, 11.0]), 11.0), // the first is of a path through an obstacle
            valid(run("good", "a-scene", [12.0, 11.5, 11.0]), 11.0), // no optimum
            valid(run("bad", "b-scene", [7.0, 6.0, 5.0]), 5.0),     // the cost is no length
            run("bad", "a-scene", [12.0, 11.0, 10.5]),              // not valid
        ];
        let expected = "\
evaluations,function_value,function_id,algorithm_id,dimension,run_id,time_us
20,0.19999999999999996,b-scene,good,2,0,2
30,0.10000000000000009,b-scene,good,2,0,3
50,0.10000000000000009,b-scene,good,2,0,9
10,12,a-scene,good,2,0,1
20,11.5,a-scene,good,2,0,2
30,11,a-scene,good,2,0,3
50,11,a-scene,good,2,0,9
50,0.10000000000000009,b-scene,bad,2,0,9
50,1000000000,a-scene,bad,2,0,9
";
        assert_eq!(csv(&results), expected);
    }
}
