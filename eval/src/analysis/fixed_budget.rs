//! How good planners are after a given effort.

use super::curves::{Course, Curves, Effort};
use crate::statistics::median;
use crate::statistics::median_interval::{MedianInterval, median_interval};

/// The gap after some effort.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// The effort.
    pub at: f64,
    /// Median gap; +∞ where half of the runs or more had no valid path by then.
    pub median: f64,
    /// 95 % order-statistic interval of that median; `None` for fewer than six values.
    pub interval: Option<MedianInterval>,
}

/// Gap of `course` after effort x: +∞ before its first path, its last one's from the run's end on.
fn gap_at(course: &Course, x: f64, effort: Effort) -> f64 {
    let done = course.steps.partition_point(|s| s.at(effort) <= x);
    done.checked_sub(1).map_or(f64::INFINITY, |i| course.steps[i].gap)
}

/// The median gap of one planner after each effort of `places`: over runs in one scene, or (`None`) over scenes of
/// each scene's median over runs. Empty where it has no runs in a scene with a known optimum.
pub fn fixed_budget(
    curves: &Curves,
    planner: usize,
    scene: Option<usize>,
    effort: Effort,
    places: &[f64],
) -> Vec<Band> {
    let gaps =
        |scene: usize, x: f64| -> Vec<f64> { curves.of(planner, Some(scene)).map(|c| gap_at(c, x, effort)).collect() };
    let values = |x: f64| match (scene, curves.scenes()) {
        (Some(scene), _) | (None, &[scene]) => gaps(scene, x),
        (None, scenes) => scenes.iter().filter_map(|s| median(&gaps(*s, x))).collect(),
    };
    let band = |&at: &f64| {
        let values = values(at);
        Some(Band { at, median: median(&values)?, interval: median_interval(&values) })
    };
    places.iter().filter_map(band).collect()
}

#[cfg(test)]
mod tests {
    use super::super::grid::Grid;
    use super::super::testing::{progress, results, run};
    use super::*;
    use crate::results::RunRecord;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn failures_are_never_good() {
        let curve = || progress([(10, 100.0, 20.0), (50, 500.0, 12.0)]);
        let of =
            |scene: &str, repeat: u32, length: f64| RunRecord { progress: curve(), ..run(scene, "a", repeat, length) };
        let mut runs: Vec<RunRecord> = (0..7).map(|i| of("s", i, if i < 3 { INF } else { 12.0 })).collect();
        runs.extend((0..3).map(|i| of("t", i, INF)));
        let results = results(&["a"], &[("s", Some(10.0)), ("t", Some(10.0))], runs);
        let curves = Curves::new(&Grid::new(&results));
        let bands = fixed_budget(&curves, 0, Some(0), Effort::Evaluations, &[9.0, 10.0, 49.0, 50.0, 1e6]);
        let medians: Vec<f64> = bands.iter().map(|b| b.median).collect();
        // 12/10 − 1 is 0.2 but for one rounding.
        assert_eq!(medians[..3], [INF, 1.0, 1.0]);
        assert!(medians[3..].iter().all(|m| (m - 0.2).abs() < 1e-15), "{medians:?}");
        // The least and the greatest of seven; three of these failed.
        let interval = bands[4].interval.unwrap();
        assert!((interval.low - 0.2).abs() < 1e-15 && interval.high == INF);
        let all = fixed_budget(&curves, 0, None, Effort::Time, &[1e6]);
        assert_eq!((all[0].median, all[0].interval), (INF, None), "one of two scenes failed");
    }
}
