//! The parameters of the behaviours.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Parameters of the four behaviours, noise and swirl. Gains weigh the behaviours' vectors; a sum of length 1 is full
/// speed. Distances to obstacles and robots are clearances, from hull to hull.
///
/// The default is what Balch & Arkin (1998) published for four vehicles in metres, lengths × 0.01: a vehicle's spacing
/// of 50 m becomes 0.5 m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Parameters {
    /// Weight of move-to-goal, 0 … 1000. Default 0.8.
    pub goal_gain: f64,
    /// Weight of avoid-static-obstacle, 0 … 1000. Default 1.5.
    pub obstacle_gain: f64,
    /// M, the clearance of an obstacle within which nothing else counts, scene units, 0 … 1000. Default 0.05 (5 m).
    pub obstacle_margin: f64,
    /// S, the clearance beyond which an obstacle does not matter, scene units, above M, at most 1000. Default 0.5
    /// (50 m).
    pub obstacle_sphere: f64,
    /// Weight of avoid-robot, own and opposing, 0 … 1000. Default 2.
    pub robot_gain: f64,
    /// M of robots, scene units, 0 … 1000. Default 0.05 (5 m).
    pub robot_margin: f64,
    /// S of robots, scene units, above M, at most 1000. Default 0.2 (20 m).
    pub robot_sphere: f64,
    /// Weight of keep-formation, 0 … 1000. Default 1.
    pub formation_gain: f64,
    /// Distance of one's slot at which it no longer attracts, scene units, 0 … 1000. Default 0.
    pub formation_dead: f64,
    /// Distance of one's slot from which it attracts in full, scene units, above the dead zone, at most 1000. Default
    /// 0.25 (25 m).
    pub formation_control: f64,
    /// Weight of noise, 0 … 1000. Default 0.1.
    pub noise_gain: f64,
    /// Steps for which a random heading is held, 1 … 10⁶. Default 6.
    pub noise_steps: u64,
    /// Weight of the swirl round what repels, 0 … 1000. Default 0: the source has none.
    pub swirl_gain: f64,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            goal_gain: 0.8,
            obstacle_gain: 1.5,
            obstacle_margin: 0.05,
            obstacle_sphere: 0.5,
            robot_gain: 2.0,
            robot_margin: 0.05,
            robot_sphere: 0.2,
            formation_gain: 1.0,
            formation_dead: 0.0,
            formation_control: 0.25,
            noise_gain: 0.1,
            noise_steps: 6,
            swirl_gain: 0.0,
        }
    }
}

impl Parameters {
    /// Checks every range.
    ///
    /// # Errors
    /// The parameter, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        let lengths_above = [
            ("obstacle_sphere", self.obstacle_margin, self.obstacle_sphere),
            ("robot_sphere", self.robot_margin, self.robot_sphere),
            ("formation_control", self.formation_dead, self.formation_control),
        ];
        for (key, value) in self.named() {
            if !lengths_above.iter().any(|(above, ..)| *above == key) && key != "noise_steps" {
                SettingError::check((0.0..=1000.0).contains(&value), key, value, "0 to 1000")?;
            }
        }
        for (key, inner, outer) in lengths_above {
            let expected = "above the margin or dead zone inside it, at most 1000";
            SettingError::check(outer > inner && outer <= 1000.0, key, outer, expected)?;
        }
        let steps = self.noise_steps;
        SettingError::check((1..=1_000_000).contains(&steps), "noise_steps", steps, "1 to 1000000")
    }

    /// All of them by name, for tables.
    pub fn named(&self) -> [(&'static str, f64); 13] {
        [
            ("goal_gain", self.goal_gain),
            ("obstacle_gain", self.obstacle_gain),
            ("obstacle_margin", self.obstacle_margin),
            ("obstacle_sphere", self.obstacle_sphere),
            ("robot_gain", self.robot_gain),
            ("robot_margin", self.robot_margin),
            ("robot_sphere", self.robot_sphere),
            ("formation_gain", self.formation_gain),
            ("formation_dead", self.formation_dead),
            ("formation_control", self.formation_control),
            ("noise_gain", self.noise_gain),
            ("noise_steps", self.noise_steps as f64),
            ("swirl_gain", self.swirl_gain),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_parameters_are_errors_by_name() {
        type Spoil = fn(&mut Parameters);
        let cases: [(&str, Spoil); 9] = [
            ("goal_gain", |p| p.goal_gain = -0.1),
            ("obstacle_gain", |p| p.obstacle_gain = f64::NAN),
            ("obstacle_margin", |p| p.obstacle_margin = f64::INFINITY),
            ("obstacle_sphere", |p| p.obstacle_sphere = 0.05),
            ("robot_sphere", |p| p.robot_margin = 0.2),
            ("robot_sphere", |p| p.robot_sphere = f64::NAN),
            ("formation_control", |p| p.formation_control = 0.0),
            ("noise_steps", |p| p.noise_steps = 0),
            ("swirl_gain", |p| p.swirl_gain = 1001.0),
        ];
        assert_eq!(Parameters::default().validate(), Ok(()));
        for (key, spoil) in cases {
            let mut parameters = Parameters::default();
            spoil(&mut parameters);
            let error = parameters.validate().unwrap_err();
            assert_eq!(error.key, key);
            assert!(error.to_string().contains("expected"), "{error}");
        }
    }
}
