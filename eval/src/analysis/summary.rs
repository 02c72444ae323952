//! The rows of the comparison table.

use super::spent::Evaluations;
use crate::results::{Results, RunRecord, SceneResult, SceneSet};
use crate::statistics::{median, quantile};

/// What the comparison table says of one planner, over one scene or all.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// The planner's label.
    pub planner: String,
    /// The scene, `None` for all test scenes together.
    pub scene: Option<String>,
    /// Runs made.
    pub runs: usize,
    /// Runs with a valid path.
    pub valid: usize,
    /// Median length, +∞ when half the runs or more failed.
    pub length_median: f64,
    /// Quartiles of the length, +∞ likewise.
    pub length_quartiles: [f64; 2],
    /// Shortest valid length; +∞ without one.
    pub length_best: f64,
    /// Median of length/optimum − 1, of simulations that of arrival over least time; `None` unless the optimum of
    /// every scene is known.
    pub gap_median: Option<f64>,
    /// Median wall time of all runs, µs.
    pub time_us_median: f64,
    /// Median number of evaluations of all runs. One that crashed, was stopped or ended in an error without telling
    /// counts with the planner's budget of them, else with the most of its runs, else with +∞.
    pub evaluations_median: f64,
    /// Median of the planner's own objective, as it counts it, +∞ for a run without a valid path; `None` where no run
    /// tells one.
    pub cost_median: Option<f64>,
}

/// A run's length as it counts in statistics: +∞ unless valid.
pub fn counted_length(run: &RunRecord) -> f64 {
    if run.valid { run.length.unwrap_or(f64::INFINITY) } else { f64::INFINITY }
}

/// A run's gap as it counts in statistics: +∞ unless valid, else at least 0. A simulation has its own least time;
/// any other run is held against its scene's `reference` length.
pub fn counted_gap(run: &RunRecord, reference: f64) -> f64 {
    let own = run.gap.filter(|_| run.moving.is_some() && run.valid);
    own.unwrap_or_else(|| counted_length(run) / reference - 1.0).max(0.0)
}

/// A run's own cost as it counts in statistics: +∞ unless valid.
pub(crate) fn counted_cost(run: &RunRecord) -> f64 {
    if run.valid { run.cost.unwrap_or(f64::INFINITY) } else { f64::INFINITY }
}

/// Summarises the runs of one planner in one scene, or (`None`) in all test scenes: then its medians and quartiles are
/// those of the scenes' medians, as in the tests, so that a scene counts as one however its runs vary. `None` when it
/// has no runs there.
///
/// Failures are +∞ in every median.
pub fn summarise(results: &Results, planner: &str, scene: Option<&str>) -> Option<Summary> {
    let info = results.planners.iter().find(|p| p.label == planner)?;
    let evaluations = Evaluations::of(info, results.runs_of(planner, None));
    let Some(scene) = scene else {
        let tests = results.scenes.iter().filter(|s| s.set == SceneSet::Test);
        let scenes: Vec<Summary> = tests.filter_map(|s| in_scene(results, planner, s, evaluations)).collect();
        return over_scenes(planner, &scenes);
    };
    in_scene(results, planner, results.scenes.iter().find(|s| s.scene.name == scene)?, evaluations)
}

fn in_scene(results: &Results, planner: &str, scene: &SceneResult, evaluations: Evaluations) -> Option<Summary> {
    let name = &scene.scene.name;
    let runs: Vec<&RunRecord> = results.runs_of(planner, Some(name)).collect();
    let of = |f: &dyn Fn(&RunRecord) -> f64| runs.iter().map(|r| f(r)).collect::<Vec<f64>>();
    let lengths = of(&counted_length);
    let gaps =
        (scene.simulation.is_some() || scene.optimum.length.is_some()).then(|| of(&|r| r.gap.unwrap_or(f64::INFINITY)));
    Some(Summary {
        planner: planner.to_owned(),
        scene: Some(name.clone()),
        runs: runs.len(),
        valid: runs.iter().filter(|r| r.valid).count(),
        length_median: median(&lengths)?,
        length_quartiles: [quantile(&lengths, 0.25)?, quantile(&lengths, 0.75)?],
        length_best: lengths.iter().copied().fold(f64::INFINITY, f64::min),
        gap_median: gaps.as_deref().and_then(median),
        time_us_median: median(&of(&|r| r.time_us))?,
        evaluations_median: median(&of(&|r| evaluations.spent(r).unwrap_or(f64::INFINITY)))?,
        cost_median: runs.iter().any(|r| r.cost.is_some()).then(|| median(&of(&counted_cost))).flatten(),
    })
}

fn over_scenes(planner: &str, scenes: &[Summary]) -> Option<Summary> {
    let of = |f: &dyn Fn(&Summary) -> f64| scenes.iter().map(f).collect::<Vec<f64>>();
    // A median over the easier part of the scenes would drop the failures in the others.
    let all = |f: &dyn Fn(&Summary) -> Option<f64>| scenes.iter().map(f).collect::<Option<Vec<f64>>>();
    let lengths = of(&|s| s.length_median);
    Some(Summary {
        planner: planner.to_owned(),
        scene: None,
        runs: scenes.iter().map(|s| s.runs).sum(),
        valid: scenes.iter().map(|s| s.valid).sum(),
        length_median: median(&lengths)?,
        length_quartiles: [quantile(&lengths, 0.25)?, quantile(&lengths, 0.75)?],
        length_best: scenes.iter().map(|s| s.length_best).fold(f64::INFINITY, f64::min),
        gap_median: all(&|s| s.gap_median).as_deref().and_then(median),
        time_us_median: median(&of(&|s| s.time_us_median))?,
        evaluations_median: median(&of(&|s| s.evaluations_median))?,
        cost_median: all(&|s| s.cost_median).as_deref().and_then(median),
    })
}

#[cfg(test)]
mod tests {
    use super::super::testing::{results, run};
    use super::*;
    use crate::results::RunStatus;

    #[test]
    fn tuning_scenes_stand_alone() {
        let runs = vec![run("s", "a", 0, 11.0), run("t", "a", 0, f64::INFINITY)];
        let mut results = results(&["a"], &[("s", Some(10.0)), ("t", None)], runs);
        results.scenes[1].set = SceneSet::Tuning;
        let all = summarise(&results, "a", None).unwrap();
        assert_eq!((all.runs, all.length_median), (1, 11.0));
        let tuning = summarise(&results, "a", Some("t")).unwrap();
        assert_eq!((tuning.runs, tuning.length_median, tuning.gap_median), (1, f64::INFINITY, None));
    }

    #[test]
    fn crashes_count_with_evaluations() {
        let gone =
            |repeat| RunRecord { status: RunStatus::Crashed, evaluations: 0, ..run("s", "a", repeat, f64::INFINITY) };
        let scenes = [("s", Some(10.0))];
        let of = |runs| summarise(&results(&["a"], &scenes, runs), "a", None).unwrap().evaluations_median;
        assert_eq!(of(vec![run("s", "a", 0, 11.0), gone(1), gone(2)]), 100.0);
        assert_eq!(of(vec![gone(0), gone(1)]), f64::INFINITY);
    }

    #[test]
    fn every_scene_counts_once() {
        // In "s" the runs vary widely, in "t" little: pooled, the median would be 5.25 %.
        let gaps = [("s", [10.1, 10.1, 20.0]), ("t", [10.5, 10.55, 10.6]), ("u", [10.3, 10.3, f64::INFINITY])];
        let runs = gaps.iter().flat_map(|(scene, lengths)| (0..3).map(|k| run(scene, "a", k, lengths[k as usize])));
        let gap = |r: RunRecord| RunRecord { gap: r.length.map(|l| l / 10.0 - 1.0), ..r };
        let results = results(&["a"], &gaps.map(|(scene, _)| (scene, Some(10.0))), runs.map(gap).collect());
        let all = summarise(&results, "a", None).unwrap();
        assert_eq!((all.runs, all.valid, all.length_best, all.length_median), (9, 8, 10.1, 10.3));
        assert_eq!(all.gap_median, Some(10.3 / 10.0 - 1.0), "the middle of 1, 3 and 5.5 %");
    }
}
