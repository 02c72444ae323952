//! The report of moving scenes: pictures that can be set in motion, and what runs come to.

mod animation;
pub mod answers;
pub mod compute;
mod events;
mod labels;
mod legend;
mod runs;
pub mod scene;
mod stage;
pub mod tables;
mod tracks;

use crate::results::{Moving, RunRecord};
use crate::statistics::median;
use crate::statistics::median_interval::median_interval;

/// Style rules of its figures.
pub const CSS: &str = include_str!("moving.css");
/// What sets its pictures in motion.
pub const SCRIPT: &str = include_str!("player.js");

/// A planner's runs, scene by scene.
pub type ByScene<'a> = Vec<Vec<&'a RunRecord>>;

/// A planner's median of `value`, and its interval: over runs in one scene, over scenes of their medians in several;
/// scenes and runs without a value are left out. `None` without any.
fn typical(by_scene: &ByScene<'_>, value: &dyn Fn(&RunRecord) -> Option<f64>) -> Option<(f64, Option<[f64; 2]>)> {
    let in_scene = |runs: &Vec<&RunRecord>| runs.iter().filter_map(|r| value(r)).collect::<Vec<f64>>();
    let values = match by_scene.as_slice() {
        [one] => in_scene(one),
        several => several.iter().filter_map(|runs| median(&in_scene(runs))).collect(),
    };
    Some((median(&values)?, median_interval(&values).map(|i| [i.low, i.high])))
}

/// Time of arrival over the least time; +∞ unless all arrived, nobody touched anybody and no rule was broken.
fn counted_ratio(run: &RunRecord) -> f64 {
    run.gap.filter(|_| run.valid).map_or(f64::INFINITY, |gap| 1.0 + gap)
}

/// What a simulation's run came to; `None` of one that ended in an error.
fn moving(run: &RunRecord) -> Option<&Moving> {
    run.moving.as_ref()
}

/// A ratio with its sign.
fn times(ratio: f64) -> String {
    if ratio.is_finite() {
        format!("{}\u{a0}×", crate::format::significant(ratio, 3))
    } else {
        crate::format::INFINITE.to_owned()
    }
}

/// Seconds to three digits.
fn seconds(s: f64) -> String {
    if s.is_finite() {
        format!("{}\u{a0}s", crate::format::significant(s, 3))
    } else {
        crate::format::INFINITE.to_owned()
    }
}

/// Metres as whole millimetres.
fn millimetres(metres: f64) -> String {
    format!("{}\u{a0}mm", crate::format::significant((1000.0 * metres).round(), 6))
}

#[cfg(test)]
mod tests;
