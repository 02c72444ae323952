//! How parameters are judged: the world of the episodes, their number, and the weights of the fitness.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

use crate::formation::Formation;

/// What a collision costs a robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Charge {
    /// Nine tenths of its dynamic avoidance.
    #[default]
    Avoidance,
    /// Nine tenths of its whole fitness.
    Whole,
}

/// Weights of the parts of the fitness; only their proportions matter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Weights {
    /// Of the shortness of the path, 0 … 1000. Default 0.5.
    pub path: f64,
    /// Of dynamic avoidance, 0 … 1000. Default 0.5.
    pub avoidance: f64,
    /// Of keeping one's slot of the formation, 0 … 1000. Default 0: the thesis counts the first two.
    pub formation: f64,
    /// Of arriving soon, 0 … 1000. Default 0.
    pub arrival: f64,
}

impl Default for Weights {
    fn default() -> Self {
        Self { path: 0.5, avoidance: 0.5, formation: 0.0, arrival: 0.0 }
    }
}

/// The closed-loop world in which parameters are judged. A team crosses a field in formation, among discs that stand
/// and opponents that move with constant velocity and bounce off the field's border. Robots have the velocity that
/// they wish, as in Balch & Arkin's simulation, unless `acceleration` says otherwise. Opponents give no way, and what
/// collides goes on.
///
/// The control law is that of [`Behaviour`](crate::Behaviour), but for three things:
///
/// - the field's border bounds where things start and turns opponents only: it neither repels the team nor counts as a
///   collision, since formations start and end at the very border; to the controller it is an obstacle;
/// - robots keep no margins but those of the parameters; the controller keeps each mover's own margin besides;
/// - formations are kept up to the goal, which has a place for each; the controller, whose goal is its own alone, leaves
///   the formation at one spacing from it.
///
/// The numbers of the thesis's experiments are lost: the defaults are ours, a division B field of the Small Size
/// League (2026) and moderate speeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Protocol {
    /// Robots of the team, 1 … 16. Default 4.
    pub robots: usize,
    /// Opponents, 0 … 32. Default 8.
    pub opponents: usize,
    /// Discs that stand, 0 … 64. Default 8. Where the field has no room for one, there is one less.
    pub obstacles: usize,
    /// The team's formation. Default `"diamond"`.
    pub formation: Formation,
    /// Distance between neighbours of the formation, in metres, 0.3 … 2. Default 0.5.
    pub spacing: f64,
    /// Length and width of the field in metres, 2 … 20 each, and wide enough for the formation. Default 9 × 6.
    pub field: [f64; 2],
    /// Radius of every robot in metres, 0.01 … 0.14. Default 0.09.
    pub robot_radius: f64,
    /// Least and greatest radius of the discs in metres, 0.01 … 1. Default 0.1 and 0.3.
    pub obstacle_radius: [f64; 2],
    /// A robot's full speed in metres per second, above 0, at most 10. Default 2.
    pub speed: f64,
    /// Greatest acceleration in metres per second², above 0, at most 1000; absent: velocities change at once. Default
    /// absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<f64>,
    /// Greatest speed of an opponent in metres per second, 0 … 10; each has between a quarter of it and all. Default 1.5.
    pub opponent_speed: f64,
    /// Length of a step in seconds, 0.001 … 0.2. Default 0.05.
    pub step_s: f64,
    /// Steps at most, 1 … 2000. Default 160, 8 s.
    pub steps: usize,
    /// Distance of its goal at which a robot has arrived, in metres, 0.001 … 1. It then stands. Default 0.1.
    pub arrival: f64,
    /// Scenarios of one evaluation, 8 … 256. Default 8.
    pub training: usize,
    /// Held-out scenarios, 1 … 10⁵. Default 64.
    pub held_out: usize,
    /// Weights of the fitness.
    pub weights: Weights,
    /// What a collision costs: `"avoidance"` or `"whole"`. Default `"avoidance"`.
    pub collision: Charge,
    /// M of the fitness: at this clearance danger is 1, in metres, ≥ 0. Default 0.05. Like `danger_sphere` it stays as
    /// it is whatever parameters are judged.
    pub danger_margin: f64,
    /// S of the fitness: beyond this clearance there is no danger, in metres, above M, at most 5. Default 0.2.
    pub danger_sphere: f64,
}

impl Default for Protocol {
    fn default() -> Self {
        Self {
            robots: 4,
            opponents: 8,
            obstacles: 8,
            formation: Formation::Diamond,
            spacing: 0.5,
            field: [9.0, 6.0],
            robot_radius: 0.09,
            obstacle_radius: [0.1, 0.3],
            speed: 2.0,
            acceleration: None,
            opponent_speed: 1.5,
            step_s: 0.05,
            steps: 160,
            arrival: 0.1,
            training: 8,
            held_out: 64,
            weights: Weights::default(),
            collision: Charge::Avoidance,
            danger_margin: 0.05,
            danger_sphere: 0.2,
        }
    }
}

impl Protocol {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        let count = |key, value: usize, low: usize, high: usize, expected| {
            SettingError::check((low..=high).contains(&value), key, value, expected)
        };
        let within = |key, value: f64, low: f64, high: f64, expected| {
            SettingError::check((low..=high).contains(&value), key, value, expected)
        };
        count("robots", self.robots, 1, 16, "1 to 16")?;
        count("opponents", self.opponents, 0, 32, "0 to 32")?;
        count("obstacles", self.obstacles, 0, 64, "0 to 64")?;
        count("steps", self.steps, 1, 2000, "1 to 2000")?;
        count("training", self.training, 8, 256, "8 to 256")?;
        count("held_out", self.held_out, 1, 100_000, "1 to 100000")?;
        within("spacing", self.spacing, 0.3, 2.0, "0.3 to 2")?;
        within("robot_radius", self.robot_radius, 0.01, 0.14, "0.01 to 0.14")?;
        let [least, greatest] = self.obstacle_radius;
        within("obstacle_radius", least, 0.01, 1.0, "two radii, each 0.01 to 1")?;
        within("obstacle_radius", greatest, least, 1.0, "two radii, the second not below the first, at most 1")?;
        SettingError::check(self.speed > 0.0 && self.speed <= 10.0, "speed", self.speed, "above 0, at most 10")?;
        if let Some(a) = self.acceleration {
            SettingError::check(a > 0.0 && a <= 1000.0, "acceleration", a, "above 0, at most 1000, or absent")?;
        }
        within("opponent_speed", self.opponent_speed, 0.0, 10.0, "0 to 10")?;
        within("step_s", self.step_s, 0.001, 0.2, "0.001 to 0.2")?;
        within("arrival", self.arrival, 0.001, 1.0, "0.001 to 1")?;
        let room = 2.0 * self.formation_reach();
        for (side, room) in self.field.into_iter().zip([4.0 * room, room]) {
            within("field", side, 2.0_f64.max(room), 20.0, "length and width, 2 to 20, with room for the formation")?;
        }
        let Weights { path, avoidance, formation, arrival } = self.weights;
        for (key, w) in [("path", path), ("avoidance", avoidance), ("formation", formation), ("arrival", arrival)] {
            within(key, w, 0.0, 1000.0, "0 to 1000")?;
        }
        let sum = path + avoidance + formation + arrival;
        SettingError::check(sum > 0.0, "weights", sum, "a sum above 0")?;
        let (m, s) = (self.danger_margin, self.danger_sphere);
        within("danger_margin", m, 0.0, 5.0, "0 to 5")?;
        SettingError::check(s > m && s <= 5.0, "danger_sphere", s, "above danger_margin, at most 5")
    }

    /// From the unit's centre to the outermost hull in formation, in metres.
    pub(crate) fn formation_reach(&self) -> f64 {
        let mut slots = Vec::new();
        self.formation.slots(self.robots, &mut slots);
        slots.iter().map(env_model::Vector::norm).fold(0.0, f64::max) * self.spacing + self.robot_radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_settings_are_errors_by_name() {
        type Spoil = fn(&mut Protocol);
        let cases: [(&str, Spoil); 22] = [
            ("robots", |p| p.robots = 0),
            ("robots", |p| p.robots = usize::MAX),
            ("opponents", |p| p.opponents = 33),
            ("obstacles", |p| p.obstacles = 65),
            ("steps", |p| p.steps = 0),
            ("training", |p| p.training = 7),
            ("held_out", |p| p.held_out = 0),
            ("spacing", |p| p.spacing = f64::NAN),
            ("robot_radius", |p| p.robot_radius = 0.0),
            ("obstacle_radius", |p| p.obstacle_radius = [0.3, 0.1]),
            ("speed", |p| p.speed = -1.0),
            ("speed", |p| p.speed = f64::INFINITY),
            ("acceleration", |p| p.acceleration = Some(0.0)),
            ("opponent_speed", |p| p.opponent_speed = -0.1),
            ("step_s", |p| p.step_s = 0.0),
            ("arrival", |p| p.arrival = f64::NAN),
            ("field", |p| p.field = [9.0, 0.5]),
            ("field", |p| (p.robots, p.formation, p.spacing) = (16, Formation::Line, 1.0)),
            ("path", |p| p.weights.path = -1.0),
            ("weights", |p| (p.weights.path, p.weights.avoidance) = (0.0, 0.0)),
            ("danger_margin", |p| p.danger_margin = -0.1),
            ("danger_sphere", |p| p.danger_sphere = 0.05),
        ];
        assert_eq!(Protocol::default().validate(), Ok(()));
        for (key, spoil) in cases {
            let mut protocol = Protocol::default();
            spoil(&mut protocol);
            let error = protocol.validate().unwrap_err();
            assert_eq!(error.key, key, "{error}");
        }
    }
}
