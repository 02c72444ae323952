//! The rows of the comparison table.

use crate::results::{Results, RunRecord, SceneSet};
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
    /// Median of length/optimum − 1; `None` unless the optimum of every scene is known.
    pub gap_median: Option<f64>,
    /// Median wall time of all runs, µs.
    pub time_us_median: f64,
    /// Median number of evaluations of all runs.
    pub evaluations_median: f64,
    /// Median of the planner's own objective, as it counts it, +∞ for a run without a valid path; `None` where no run
    /// tells one.
    pub cost_median: Option<f64>,
}

/// A run's length as it counts in statistics: +∞ unless valid.
pub fn counted_length(run: &RunRecord) -> f64 {
    if run.valid { run.length.unwrap_or(f64::INFINITY) } else { f64::INFINITY }
}

/// A run's own cost as it counts in statistics: +∞ unless valid.
fn counted_cost(run: &RunRecord) -> f64 {
    if run.valid { run.cost.unwrap_or(f64::INFINITY) } else { f64::INFINITY }
}

/// Summarises the runs of one planner in one scene, or (`None`) in all test scenes. `None` when it has no runs there.
///
/// Failures are +∞ in every median.
pub fn summarise(results: &Results, planner: &str, scene: Option<&str>) -> Option<Summary> {
    let tuning = |name: &str| results.scenes.iter().any(|s| s.scene.name == name && s.set == SceneSet::Tuning);
    let counts = |r: &&RunRecord| scene.is_some() || !tuning(&r.scene);
    let runs: Vec<&RunRecord> = results.runs_of(planner, scene).filter(counts).collect();
    let of = |f: &dyn Fn(&RunRecord) -> f64| runs.iter().map(|r| f(r)).collect::<Vec<f64>>();
    let lengths = of(&counted_length);
    // A median over the easier part of the scenes would drop the failures in the others.
    let known = |name: &str| results.scenes.iter().any(|s| s.scene.name == name && s.optimum.length.is_some());
    let gaps = runs.iter().all(|r| known(&r.scene)).then(|| of(&|r| r.gap.unwrap_or(f64::INFINITY)));
    Some(Summary {
        planner: planner.to_owned(),
        scene: scene.map(str::to_owned),
        runs: runs.len(),
        valid: runs.iter().filter(|r| r.valid).count(),
        length_median: median(&lengths)?,
        length_quartiles: [quantile(&lengths, 0.25)?, quantile(&lengths, 0.75)?],
        length_best: lengths.iter().copied().fold(f64::INFINITY, f64::min),
        gap_median: gaps.as_deref().and_then(median),
        time_us_median: median(&of(&|r| r.time_us))?,
        evaluations_median: median(&of(&|r| r.evaluations as f64))?,
        cost_median: runs.iter().any(|r| r.cost.is_some()).then(|| median(&of(&counted_cost))).flatten(),
    })
}

#[cfg(test)]
mod tests {
    use super::super::testing::{results, run};
    use super::*;

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
}
