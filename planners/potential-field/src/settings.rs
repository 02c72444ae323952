//! Settings of the potential field. Lengths are relative to the scene, so one
//! set of values serves centimetres and metres, a corner of the pitch and all of it.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Which repulsive potential an obstacle has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Repulsion {
    /// ½ η (1/ρ − 1)² (Khatib 1986, FIRAS).
    #[default]
    Khatib,
    /// The same times (min(d, d\*)/d\*)²: it vanishes at the goal, which is then
    /// always a minimum (Ge & Cui 2000, n = 2). Capped where the attraction is,
    /// else obstacles would repel the more, the farther the goal is.
    GeCui,
}

/// Settings of [`PotentialField`](crate::PotentialField).
///
/// Khatib gives no values for mobile robots. These defaults are ours: the reach
/// is about half a metre on a division B pitch and 15 cm in the scene of Lu &
/// Sun (2012), there a little less than an obstacle's radius. Only the ratio of
/// the gains matters to the path.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PotentialFieldSettings {
    /// ρ0, beyond which an obstacle repels nothing, as a fraction of the
    /// diagonal of the world's extent; 0 < ρ0 ≤ 1. Default 0.05.
    pub influence: f64,
    /// ξ, dimensionless, > 0. Default 1.
    pub attraction_gain: f64,
    /// d\*, where the well turns from parabola to cone, in units of ρ0, > 0. Default 1.
    pub conic_distance: f64,
    /// `"khatib"` or `"ge-cui"`. Default `"khatib"`.
    pub repulsion: Repulsion,
    /// η, dimensionless, ≥ 0; see the crate for its units. Default 0.1,
    /// with which repulsion balances the pull of a far goal at ρ = 0.39 ρ0.
    pub repulsion_gain: f64,
    /// Length of a step, as a fraction of the extent's diagonal; 0 < step ≤ 0.1.
    /// The goal is reached when it is one free step away. Default 0.002.
    pub step: f64,
    /// Steps at most, 1 … 10⁶. Default 5000, ten diagonals.
    pub steps: u64,
    /// Steps over which progress is measured, 2 … 10⁶. Default 100.
    pub window: usize,
    /// The robot is stuck when the last `window` steps took it no farther than
    /// this fraction of their length; 0 ≤ fraction < 1. Default 0.02: two
    /// steps, the amplitude of an oscillation round a minimum.
    pub progress: f64,
}

impl Default for PotentialFieldSettings {
    fn default() -> Self {
        Self {
            influence: 0.05,
            attraction_gain: 1.0,
            conic_distance: 1.0,
            repulsion: Repulsion::Khatib,
            repulsion_gain: 0.1,
            step: 0.002,
            steps: 5000,
            window: 100,
            progress: 0.02,
        }
    }
}

impl PotentialFieldSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        // Gains up to 10⁹ cannot overflow: the force on a border is 10⁹ times the gain.
        const GAIN: f64 = 1e9;
        let positive = |v: f64| v > 0.0 && v <= GAIN;
        let (xi, eta) = (self.attraction_gain, self.repulsion_gain);
        let rho = self.influence;
        SettingError::check(rho > 0.0 && rho <= 1.0, "influence", rho, "above 0, at most 1")?;
        SettingError::check(positive(xi), "attraction_gain", xi, "above 0, at most 1e9")?;
        let conic = self.conic_distance;
        SettingError::check(positive(conic), "conic_distance", conic, "above 0, at most 1e9")?;
        SettingError::check((0.0..=GAIN).contains(&eta), "repulsion_gain", eta, "0 to 1e9")?;
        SettingError::check(self.step > 0.0 && self.step <= 0.1, "step", self.step, "above 0, at most 0.1")?;
        SettingError::check((1..=1_000_000).contains(&self.steps), "steps", self.steps, "1 to 1000000")?;
        SettingError::check((2..=1_000_000).contains(&self.window), "window", self.window, "2 to 1000000")?;
        let progress = self.progress;
        SettingError::check((0.0..1.0).contains(&progress), "progress", progress, "0 to below 1")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_settings_are_errors_by_name() {
        type Spoil = fn(&mut PotentialFieldSettings);
        let cases: [(&str, Spoil); 15] = [
            ("influence", |s| s.influence = 0.0),
            ("influence", |s| s.influence = f64::NAN),
            ("influence", |s| s.influence = 1.5),
            ("attraction_gain", |s| s.attraction_gain = 0.0),
            ("attraction_gain", |s| s.attraction_gain = f64::INFINITY),
            ("conic_distance", |s| s.conic_distance = -1.0),
            ("repulsion_gain", |s| s.repulsion_gain = -0.1),
            ("repulsion_gain", |s| s.repulsion_gain = f64::NAN),
            ("step", |s| s.step = 0.0),
            ("step", |s| s.step = 0.2),
            ("steps", |s| s.steps = 0),
            ("window", |s| s.window = 1),
            ("progress", |s| s.progress = 1.0),
            ("progress", |s| s.progress = -0.1),
            ("progress", |s| s.progress = f64::NAN),
        ];
        assert_eq!(PotentialFieldSettings::default().validate(), Ok(()));
        for (key, spoil) in cases {
            let mut settings = PotentialFieldSettings::default();
            spoil(&mut settings);
            assert_eq!(settings.validate().unwrap_err().key, key);
        }
    }
}
