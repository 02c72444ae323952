//! `ioh.csv` for `IOHanalyzer` (≥ 0.1.7), which maps columns of any CSV to evaluations, function value,
//! function, algorithm, dimension and run.
//!
//! The function is the scene, and its value is the gap, length/optimum − 1, or the length itself where
//! the optimum is not known. Wang, Vermetten, Ye, Doerr & Bäck, *`IOHanalyzer`* (2022),
//! [doi](https://doi.org/10.1145/3510426).

use std::collections::BTreeMap;

use super::csv::{cell, csv_text};
use crate::analysis::{Course, Step, cost_is_length};
use crate::results::Results;

/// The columns.
pub const COLUMNS: [&str; 7] =
    ["evaluations", "function_value", "function_id", "algorithm_id", "dimension", "run_id", "time_us"];

/// The value of a run without a valid path: no path is that long, and `IOHanalyzer` knows no infinity.
pub const FAILURE: f64 = 1e9;

/// One row for each improvement of a run, as the report's curves have them, and one for its end. Improvements are in
/// the planner's own cost, so they are told only of planners whose cost is the path's length in every valid run, and
/// none is better than the judge's verdict on the final path: a run without a valid path has one row, of value
/// [`FAILURE`].
pub fn csv(results: &Results) -> String {
    let optima: BTreeMap<&str, Option<f64>> =
        results.scenes.iter().map(|s| (s.scene.name.as_str(), s.optimum.length)).collect();
    let mut lengths: BTreeMap<&str, bool> = BTreeMap::new();
    for run in &results.runs {
        *lengths.entry(&run.planner).or_insert(true) &= cost_is_length(run);
    }
    let mut rows: Vec<[String; 7]> = Vec::new();
    for run in &results.runs {
        let optimum = optima.get(run.scene.as_str()).copied().flatten();
        let Course { mut steps, end } = Course::new(run, None, optimum, lengths[run.planner.as_str()]);
        let last = Step { gap: steps.last().map_or(FAILURE, |step| step.gap), ..end };
        if steps.last() != Some(&last) {
            steps.push(last);
        }
        rows.extend(steps.iter().map(|step| {
            let (function, algorithm, repeat) = (run.scene.clone(), run.planner.clone(), run.repeat.to_string());
            let [evaluations, value, time] = [step.evaluations, step.gap, step.time_us].map(|v| cell(Some(v)));
            [evaluations, value, function, algorithm, "2".to_owned(), repeat, time]
        }));
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
            // Its last improvement is told of a time after its end.
            RunRecord { evaluations: 25, ..valid(run("good", "b-scene", [12.5, 12.0, 11.0]), 11.0) },
            valid(run("good", "a-scene", [12.0, 11.5, 11.0]), 11.0), // no optimum
            valid(run("bad", "b-scene", [7.0, 6.0, 5.0]), 5.0),      // the cost is no length
            run("bad", "a-scene", [12.0, 11.0, 10.5]),               // not valid
        ];
        let expected = "\
evaluations,function_value,function_id,algorithm_id,dimension,run_id,time_us
10,0.25,b-scene,good,2,0,1
20,0.19999999999999996,b-scene,good,2,0,2
25,0.10000000000000009,b-scene,good,2,0,3
25,0.10000000000000009,b-scene,good,2,0,9
10,12,a-scene,good,2,0,1
20,11.5,a-scene,good,2,0,2
30,11,a-scene,good,2,0,3
50,11,a-scene,good,2,0,9
50,0.10000000000000009,b-scene,bad,2,0,9
50,1000000000,a-scene,bad,2,0,9
";
        assert_eq!(csv(&results), expected);
    }

    #[test]
    fn sixty_thousand_runs_are_a_matter_of_seconds() {
        let mut results = campaign(vec![entry("good", detour)]).empty_results(1);
        let run = |repeat| RunRecord::empty("a-scene", "good", repeat, 1);
        results.runs = (0..64_000).map(run).collect();
        let began = std::time::Instant::now();
        assert_eq!(csv(&results).lines().count(), 64_001);
        // Well under a second; looking at every run of the planner for each would take minutes.
        assert!(began.elapsed().as_secs() < 20, "{:?}", began.elapsed());
    }
}
