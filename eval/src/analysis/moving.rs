//! What moving scenes come to, over the repeats of one planner.

use crate::results::{Moving, Results, SceneSet};
use crate::statistics::median;

/// One planner over the simulations of one scene, or of all test scenes. Shares and rates are pooled: sums over all
/// its simulations.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingSummary {
    /// The planner's label.
    pub planner: String,
    /// Runs made, those that ended in an error included.
    pub runs: usize,
    /// Runs in which all arrived and nobody touched anybody or broke a rule.
    pub clean: usize,
    /// Share of robots that arrived.
    pub arrived: f64,
    /// Collisions a simulated minute.
    pub collisions_per_minute: f64,
    /// Crash fouls a simulated minute.
    pub fouls_per_minute: f64,
    /// Breaches of rules a simulated minute: zones and borders entered, speeds exceeded.
    pub violations_per_minute: f64,
    /// Median over runs of arrival over least time; +∞ where half of them are not clean.
    pub time_ratio: f64,
    /// Mean switches a second and robot, by simulated time.
    pub switches_per_s: f64,
    /// Medians over runs of the call's median and 99 %, and the longest call of all, µs.
    pub call_us: [f64; 3],
    /// Frames that took too long.
    pub misses: u64,
}

/// Sums up the simulations of `planner`; `None` where it has none.
pub fn summarise_moving(results: &Results, planner: &str, scene: Option<&str>) -> Option<MovingSummary> {
    let counts = |name: &str| match scene {
        Some(scene) => scene == name,
        None => results.scenes.iter().any(|s| s.scene.name == name && s.set == SceneSet::Test),
    };
    let runs: Vec<_> = results.runs_of(planner, None).filter(|r| counts(&r.scene)).collect();
    let moving: Vec<&Moving> = runs.iter().filter_map(|r| r.moving.as_ref()).collect();
    let sum = |of: &dyn Fn(&Moving) -> f64| moving.iter().map(|m| of(m)).sum::<f64>();
    let seconds = sum(&|m| m.metrics.duration_s);
    let ratio = |r: &&crate::results::RunRecord| r.gap.filter(|_| r.valid).map_or(f64::INFINITY, |gap| 1.0 + gap);
    let ratios: Vec<f64> = runs.iter().map(ratio).collect();
    let typical = |k: usize| median(&moving.iter().map(|m| m.compute.call_us[k]).collect::<Vec<f64>>());
    Some(MovingSummary {
        planner: planner.to_owned(),
        runs: runs.len(),
        clean: runs.iter().filter(|r| r.valid).count(),
        arrived: sum(&|m| m.metrics.arrived as f64) / sum(&|m| m.metrics.robots as f64),
        collisions_per_minute: sum(&|m| f64::from(m.metrics.collisions)) * 60.0 / seconds,
        fouls_per_minute: sum(&|m| f64::from(m.metrics.fouls)) * 60.0 / seconds,
        violations_per_minute: sum(&|m| f64::from(m.metrics.violations)) * 60.0 / seconds,
        time_ratio: median(&ratios)?,
        switches_per_s: sum(&|m| m.metrics.switches_per_s * m.metrics.duration_s) / seconds,
        call_us: [typical(0)?, typical(1)?, moving.iter().map(|m| m.compute.call_us[3]).fold(0.0, f64::max)],
        misses: moving.iter().map(|m| m.compute.misses).sum(),
    })
}
