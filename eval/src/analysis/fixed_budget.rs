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
