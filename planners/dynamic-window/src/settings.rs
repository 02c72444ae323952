//! Settings of the dynamic window.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of [`DynamicWindow`](crate::DynamicWindow).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DynamicWindowSettings {
    /// In which the window's velocities are reached, in seconds, > 0, at most 10; never less than the period between
    /// two calls. Default 0.25 (the paper's interval between two commands).
    pub interval: f64,
    /// α, the weight of the heading, 0 … 10⁶. Default 2 (Fox et al. 1997).
    pub heading: f64,
    /// β, the weight of the clearance, 0 … 10⁶. Default 0.2 (Fox et al. 1997).
    pub clearance: f64,
    /// γ, the weight of the speed, 0 … 10⁶. Default 0.2 (Fox et al. 1997).
    pub velocity: f64,
    /// Directions of change sampled, 1 … 360. Default 16, ours.
    pub directions: usize,
    /// Sizes of change sampled in each direction, 1 … 100. Default 3, ours.
    pub rings: usize,
    /// Distance kept beyond contact besides the mover's own margin, as a fraction of the distance of contact, 0 … 10.
    /// Default 0.05, ours.
    pub margin: f64,
}

impl Default for DynamicWindowSettings {
    fn default() -> Self {
        Self { interval: 0.25, heading: 2.0, clearance: 0.2, velocity: 0.2, directions: 16, rings: 3, margin: 0.05 }
    }
}

impl DynamicWindowSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        let interval = self.interval;
        SettingError::check(interval > 0.0 && interval <= 10.0, "interval", interval, "above 0, at most 10")?;
        let weights = [("heading", self.heading), ("clearance", self.clearance), ("velocity", self.velocity)];
        for (key, weight) in weights {
            SettingError::check((0.0..=1e6).contains(&weight), key, weight, "0 to 1e6")?;
        }
        SettingError::check((1..=360).contains(&self.directions), "directions", self.directions, "1 to 360")?;
        SettingError::check((1..=100).contains(&self.rings), "rings", self.rings, "1 to 100")?;
        SettingError::check((0.0..=10.0).contains(&self.margin), "margin", self.margin, "0 to 10")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_settings_are_errors_by_name() {
        type Spoil = fn(&mut DynamicWindowSettings);
        let cases: [(&str, Spoil); 8] = [
            ("interval", |s| s.interval = 0.0),
            ("interval", |s| s.interval = f64::NAN),
            ("heading", |s| s.heading = -1.0),
            ("clearance", |s| s.clearance = f64::INFINITY),
            ("velocity", |s| s.velocity = f64::NAN),
            ("directions", |s| s.directions = 0),
            ("rings", |s| s.rings = 101),
            ("margin", |s| s.margin = -0.1),
        ];
        assert_eq!(DynamicWindowSettings::default().validate(), Ok(()));
        for (key, spoil) in cases {
            let mut settings = DynamicWindowSettings::default();
            spoil(&mut settings);
            assert_eq!(settings.validate().unwrap_err().key, key);
        }
    }
}
