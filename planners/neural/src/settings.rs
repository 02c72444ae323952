//! Settings of the shunting network.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of [`Neural`](crate::Neural); rates, activities and inputs are
/// numbers without unit. The network's defaults are those of Yang & Meng (2000, 2001).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct NeuralSettings {
    /// Cells along the longer side of the world's extent, 2 … 400. Default 100,
    /// ours: cells of 9 cm on a division B pitch.
    pub cells: usize,
    /// A, passive decay rate, > 0. Above `upper`·`coupling`·6.83 activity has no
    /// local maximum but the goal. Default 10.
    pub decay: f64,
    /// B, the most that activity can be, > 0. Default 1.
    pub upper: f64,
    /// D, minus the least that activity can be, ≥ 0. Default 1.
    pub lower: f64,
    /// μ, weight between neighbours one cell apart, > 0. Default 1.
    pub coupling: f64,
    /// E, input at the goal and, negated, at obstacles, > 0. Default 100.
    pub input: f64,
    /// Sweeps over all neurons at most, 1 … 10⁶. Default 1000. They end earlier
    /// where the state is steady: after about 125 for 100 cells among robots.
    pub sweeps: u64,
    /// The state is steady when a sweep changed no activity by more than this
    /// fraction of its value, 0 to 0.1. Default 10⁻⁶: neighbours' activities
    /// differ by far more, unless the ways through them are equally good.
    pub tolerance: f64,
}

impl Default for NeuralSettings {
    fn default() -> Self {
        Self {
            cells: 100,
            decay: 10.0,
            upper: 1.0,
            lower: 1.0,
            coupling: 1.0,
            input: 100.0,
            sweeps: 1000,
            tolerance: 1e-6,
        }
    }
}

impl NeuralSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check((2..=400).contains(&self.cells), "cells", self.cells, "2 to 400")?;
        for (key, value) in
            [("decay", self.decay), ("upper", self.upper), ("coupling", self.coupling), ("input", self.input)]
        {
            SettingError::check((1e-9..=1e9).contains(&value), key, value, "1e-9 to 1e9")?;
        }
        SettingError::check((0.0..=1e9).contains(&self.lower), "lower", self.lower, "0 to 1e9")?;
        SettingError::check((1..=1_000_000).contains(&self.sweeps), "sweeps", self.sweeps, "1 to 1000000")?;
        SettingError::check((0.0..=0.1).contains(&self.tolerance), "tolerance", self.tolerance, "0 to 0.1")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_settings_are_errors_by_name() {
        type Spoil = fn(&mut NeuralSettings);
        let cases: [(&str, Spoil); 13] = [
            ("cells", |s| s.cells = 1),
            ("cells", |s| s.cells = 401),
            ("decay", |s| s.decay = 0.0),
            ("decay", |s| s.decay = f64::NAN),
            ("upper", |s| s.upper = -1.0),
            ("lower", |s| s.lower = -1.0),
            ("coupling", |s| s.coupling = 0.0),
            ("input", |s| s.input = f64::INFINITY),
            ("input", |s| s.input = 0.0),
            ("sweeps", |s| s.sweeps = 0),
            ("tolerance", |s| s.tolerance = -1e-9),
            ("tolerance", |s| s.tolerance = 1.0),
            ("tolerance", |s| s.tolerance = f64::NAN),
        ];
        assert_eq!(NeuralSettings::default().validate(), Ok(()));
        for (key, spoil) in cases {
            let mut settings = NeuralSettings::default();
            spoil(&mut settings);
            assert_eq!(settings.validate().unwrap_err().key, key);
        }
    }
}
