//! Settings of ORCA. Times in seconds, lengths and speeds relative, so that one set serves any unit.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of [`Orca`](crate::Orca).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OrcaSettings {
    /// τ, for which new velocities are free of movers, in seconds, > 0, at most 100; never more than the situation's
    /// prediction horizon. It must be longer than braking takes. Default 2: twice the second in which a robot of 3 m/s
    /// and 3 m/s² stops (van den Berg et al. leave τ to the application; RVO2's Circle example has 10 s for agents
    /// without inertia).
    pub time_horizon: f64,
    /// Distance kept beyond contact besides the mover's own margin, as a fraction of the distance of contact (the sum
    /// of both radii), 0 … 10. Default 0.05, ours: velocities do not jump, as the paper assumes, and what the ramps
    /// cost must fit in.
    pub margin: f64,
    /// The share of u that a robot takes over when the mover is a mate, above 0, at most 1. Default ½ (van den Berg et
    /// al. 2011, eq. 6); of all others it is 1.
    pub mates_share: f64,
    /// Greatest length of the random vector that is added to the preferred velocity, as a fraction of the speed limit,
    /// 0 … 1: it breaks the deadlocks of symmetry. Default 0.05, ours. RVO2's Circle example has 5e-5 (0.0001 at a speed
    /// of 2), which robots with inertia that stand in a ring for symmetry's sake do not notice: 8 of them on a circle of
    /// 2 m that is exact, or but for a millimetre, need 0.02.
    pub perturbation: f64,
}

impl Default for OrcaSettings {
    fn default() -> Self {
        Self { time_horizon: 2.0, margin: 0.05, mates_share: 0.5, perturbation: 0.05 }
    }
}

impl OrcaSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        let Self { time_horizon: tau, margin, mates_share: share, perturbation } = *self;
        SettingError::check(tau > 0.0 && tau <= 100.0, "time_horizon", tau, "above 0, at most 100")?;
        SettingError::check((0.0..=10.0).contains(&margin), "margin", margin, "0 to 10")?;
        SettingError::check(share > 0.0 && share <= 1.0, "mates_share", share, "above 0, at most 1")?;
        SettingError::check((0.0..=1.0).contains(&perturbation), "perturbation", perturbation, "0 to 1")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_settings_are_errors_by_name() {
        type Spoil = fn(&mut OrcaSettings);
        let cases: [(&str, Spoil); 7] = [
            ("time_horizon", |s| s.time_horizon = 0.0),
            ("time_horizon", |s| s.time_horizon = f64::NAN),
            ("margin", |s| s.margin = -0.1),
            ("mates_share", |s| s.mates_share = 0.0),
            ("mates_share", |s| s.mates_share = 1.5),
            ("perturbation", |s| s.perturbation = f64::INFINITY),
            ("perturbation", |s| s.perturbation = -1e-9),
        ];
        assert_eq!(OrcaSettings::default().validate(), Ok(()));
        for (key, spoil) in cases {
            let mut settings = OrcaSettings::default();
            spoil(&mut settings);
            assert_eq!(settings.validate().unwrap_err().key, key);
        }
    }
}
