//! Settings of the sampled trajectories. Times are seconds, lengths relative to what the robot can do, so that one set
//! of values serves any unit of length.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of [`SampledBangBang`](crate::SampledBangBang).
///
/// The teams' papers give the method, not its numbers; these defaults are ours, for robots of 3 m/s and 3 m/s².
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SampledBangBangSettings {
    /// Directions of the stars of intermediate destinations, 0 … 64. Default 12.
    pub directions: usize,
    /// Distances of the star's points, each > 0, at most 100, in units of v²/a, the way that it takes to reach full
    /// speed and to stop from it. Default 0.15, 0.5.
    pub distances: Vec<f64>,
    /// When the robot turns from an intermediate destination to the goal, in seconds from now, each > 0, at most 60.
    /// Default 0.2, 0.5.
    pub switches: Vec<f64>,
    /// Distances of a second star, each > 0, at most 10, as shares of the way to the goal; the robot turns where it would
    /// begin to brake. It is tried while nothing is found that arrives: of what is much larger than v²/a, a goal area
    /// before a slow robot, the first one does not see round. Default 0.5, 1.
    pub far: Vec<f64>,
    /// Random intermediate destinations a frame, 0 … 10000, half of them near that of the frame before. Default 24.
    pub samples: usize,
    /// Shares of the speed limit at which the direct way is tried besides, each > 0, at most 1. Default 0.6, 0.3.
    pub slower: Vec<f64>,
    /// Seconds that another way must gain over the one of the frame before; 0 … 10. Default 0.1.
    pub hysteresis: f64,
}

impl Default for SampledBangBangSettings {
    fn default() -> Self {
        Self {
            directions: 12,
            distances: vec![0.15, 0.5],
            switches: vec![0.2, 0.5],
            far: vec![0.5, 1.0],
            samples: 24,
            slower: vec![0.6, 0.3],
            hysteresis: 0.1,
        }
    }
}

impl SampledBangBangSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        let each = |values: &[f64], key: &'static str, most: f64, expected: &'static str| {
            values.iter().try_for_each(|v| SettingError::check(*v > 0.0 && *v <= most, key, v, expected))
        };
        SettingError::check(self.directions <= 64, "directions", self.directions, "0 to 64")?;
        each(&self.distances, "distances", 100.0, "above 0, at most 100")?;
        each(&self.switches, "switches", 60.0, "above 0, at most 60")?;
        each(&self.far, "far", 10.0, "above 0, at most 10")?;
        SettingError::check(self.samples <= 10_000, "samples", self.samples, "0 to 10000")?;
        each(&self.slower, "slower", 1.0, "above 0, at most 1")?;
        let hysteresis = self.hysteresis;
        SettingError::check((0.0..=10.0).contains(&hysteresis), "hysteresis", hysteresis, "0 to 10")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_settings_are_errors_by_name() {
        type Spoil = fn(&mut SampledBangBangSettings);
        let cases: [(&str, Spoil); 8] = [
            ("directions", |s| s.directions = 65),
            ("distances", |s| s.distances[1] = 0.0),
            ("distances", |s| s.distances[0] = f64::NAN),
            ("switches", |s| s.switches[0] = -1.0),
            ("far", |s| s.far[1] = 10.1),
            ("samples", |s| s.samples = 10_001),
            ("slower", |s| s.slower[0] = 1.5),
            ("hysteresis", |s| s.hysteresis = f64::NAN),
        ];
        assert_eq!(SampledBangBangSettings::default().validate(), Ok(()));
        for (key, spoil) in cases {
            let mut settings = SampledBangBangSettings::default();
            spoil(&mut settings);
            assert_eq!(settings.validate().unwrap_err().key, key);
        }
    }
}
