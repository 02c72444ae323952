//! What is simulated.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};
use toml::Table;

use crate::League;
use crate::rules::Command;

/// Which situation the robots are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlayKind {
    /// Robots on a circle change places with those opposite.
    #[default]
    CircleSwap,
    /// Robots cross the field among opponents that drift across.
    Crossing,
    /// Robots run to positions all over the field among opponents that drift.
    Positions,
    /// Attackers run to free positions round the opposing defence area while opponents block their lines to the goal.
    Attack,
    /// Robots hold a formation that moves up the field among opponents that drift.
    Formation,
    /// One robot places the ball; the others have to leave its way, or pass round it.
    BallPlacement,
}

/// Shapes of formations (Balch & Arkin 1998, doi:10.1109/70.736776), facing up the field.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Formation {
    /// Abreast.
    #[default]
    Line,
    /// One after the other.
    Column,
    /// A square on its corner.
    Diamond,
    /// A leader, the others behind on both sides.
    Wedge,
}

/// Who goes to which position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Dealing {
    /// As drawn: ways cross.
    #[default]
    Drawn,
    /// So that the sum of squared distances is least.
    Optimal,
}

/// How the robots of a team regard each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cooperation {
    /// Everyone alone: mates are predicted like opponents, with constant velocity.
    #[default]
    Independent,
    /// One after the other by priority: trajectories of this frame are known, and whoever comes later is avoided as if
    /// it braked now, so that it always can.
    Priority,
}

/// A change of planner during a simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Swap {
    /// From the first frame at or after this time on, in seconds.
    pub at_s: f64,
    /// The controller's kind.
    pub planner: String,
    /// Its settings.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    pub settings: Table,
}

/// A moving scene. Lengths in metres, times in seconds unless the key says otherwise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// The situation.
    pub play: PlayKind,
    /// What the referee commands all the time; default running, or ball-placement-own in that play.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub command: Option<Command>,
    /// How often goals are given out, 1 to 10000; default 1. More only in positions, circle-swap and crossing: new goals
    /// when all have arrived, or after `wave_s`.
    pub waves: usize,
    /// The longest time for one wave, > 0 s; default 10. Of no meaning with one wave.
    pub wave_s: f64,
    /// In the play positions, who goes where; default drawn.
    pub dealing: Dealing,
    /// In the play formation, its shape; default line.
    pub formation: Formation,
    /// In the play formation, distance between neighbours, 0.22 to 3 m; default 0.4.
    pub spacing: f64,
    /// Own robots, 1 to 16; default 8.
    pub robots: usize,
    /// Opponents, 0 to 16; default 0.
    pub opponents: usize,
    /// The field; default division-a.
    pub league: League,
    /// The longest that it lasts, > 0 to 3600 s; default 20.
    pub duration_s: f64,
    /// Frames per second, 1 to 1000 Hz; default 60.
    pub frame_rate: f64,
    /// Speed limit of every robot, > 0 m/s; default 3.
    pub speed: f64,
    /// Acceleration limit of every robot, > 0 m/s²; default 3.
    pub acceleration: f64,
    /// How far the motion of others is predicted, > 0 s; default 2.
    pub horizon_s: f64,
    /// Distance beyond contact that controllers are asked to keep, ≥ 0 m; default 0.03.
    pub margin: f64,
    /// From a picture to the robot's obeying, 0 to 1000 ms; default 0.
    pub latency_ms: f64,
    /// Standard deviation of positions as vision sees them, ≥ 0 m; default 0. Of own robots the wheels tell how they
    /// moved, and a filter joins both.
    pub position_noise: f64,
    /// Standard deviation of velocities as vision sees them, those of opponents, ≥ 0 m/s; default 0.
    pub velocity_noise: f64,
    /// Standard deviation of the acceleration that a robot makes of the one it needs, relative to it, drawn every
    /// frame, 0 to 1; default 0.
    pub actuation_noise: f64,
    /// How starts differ between seeds: greatest displacement, ≥ 0 m; default 0.1.
    pub jitter: f64,
    /// How the robots of the team regard each other; default independent.
    pub cooperation: Cooperation,
    /// Whether robots brake while they still can stop in time; default false: planners are compared, not brakes.
    pub emergency_brake: bool,
    /// By how much a new way must be quicker than the one under way, 0 to 1; default 0.
    pub hysteresis: f64,
    /// Other planners from some time on.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub swap: Vec<Swap>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            play: PlayKind::CircleSwap,
            command: None,
            waves: 1,
            wave_s: 10.0,
            dealing: Dealing::Drawn,
            formation: Formation::Line,
            spacing: 0.4,
            robots: 8,
            opponents: 0,
            league: League::DivisionA,
            duration_s: 20.0,
            frame_rate: 60.0,
            speed: 3.0,
            acceleration: 3.0,
            horizon_s: 2.0,
            margin: 0.03,
            latency_ms: 0.0,
            position_noise: 0.0,
            velocity_noise: 0.0,
            actuation_noise: 0.0,
            jitter: 0.1,
            cooperation: Cooperation::Independent,
            emergency_brake: false,
            hysteresis: 0.0,
            swap: Vec::new(),
        }
    }
}

impl Settings {
    /// Checks every range.
    ///
    /// # Errors
    /// [`SettingError`] names key, value and range.
    pub fn validate(&self) -> Result<(), SettingError> {
        let within =
            |key, value: f64, ok: bool, expected| SettingError::check(ok && value.is_finite(), key, value, expected);
        SettingError::check((1..=16).contains(&self.robots), "robots", self.robots, "1 to 16")?;
        SettingError::check(self.opponents <= 16, "opponents", self.opponents, "0 to 16")?;
        let s = self;
        within("duration_s", s.duration_s, s.duration_s > 0.0 && s.duration_s <= 3600.0, "above 0, at most 3600 s")?;
        within("frame_rate", s.frame_rate, (1.0..=1000.0).contains(&s.frame_rate), "1 to 1000 Hz")?;
        within("speed", s.speed, s.speed > 0.0 && s.speed <= 100.0, "above 0, at most 100 m/s")?;
        within(
            "acceleration",
            s.acceleration,
            s.acceleration > 0.0 && s.acceleration <= 1000.0,
            "above 0, at most 1000 m/s²",
        )?;
        within("horizon_s", s.horizon_s, s.horizon_s > 0.0 && s.horizon_s <= 60.0, "above 0, at most 60 s")?;
        within("margin", s.margin, (0.0..=1.0).contains(&s.margin), "0 to 1 m")?;
        within("latency_ms", s.latency_ms, (0.0..=1000.0).contains(&s.latency_ms), "0 to 1000 ms")?;
        within("position_noise", s.position_noise, (0.0..=1.0).contains(&s.position_noise), "0 to 1 m")?;
        within("velocity_noise", s.velocity_noise, (0.0..=10.0).contains(&s.velocity_noise), "0 to 10 m/s")?;
        within("actuation_noise", s.actuation_noise, (0.0..=1.0).contains(&s.actuation_noise), "0 to 1")?;
        within("jitter", s.jitter, (0.0..=1.0).contains(&s.jitter), "0 to 1 m")?;
        within("hysteresis", s.hysteresis, (0.0..=1.0).contains(&s.hysteresis), "0 to 1")?;
        SettingError::check((1..=10_000).contains(&s.waves), "waves", s.waves, "1 to 10000")?;
        let repeats = matches!(s.play, PlayKind::Positions | PlayKind::CircleSwap | PlayKind::Crossing);
        SettingError::check(repeats || s.waves == 1, "waves", s.waves, "1 in a play with one goal for each robot")?;
        within("wave_s", s.wave_s, s.wave_s > 0.0 && s.wave_s <= 3600.0, "above 0, at most 3600 s")?;
        within("spacing", s.spacing, (0.22..=3.0).contains(&s.spacing), "0.22 to 3 m")?;
        for swap in &s.swap {
            within("swap.at_s", swap.at_s, swap.at_s >= 0.0, "at least 0 s")?;
        }
        Ok(())
    }

    /// What the referee commands.
    pub fn command(&self) -> Command {
        self.command.unwrap_or(match self.play {
            PlayKind::BallPlacement => Command::BallPlacementOwn,
            _ => Command::Running,
        })
    }

    /// Seconds between two frames.
    pub fn period(&self) -> f64 {
        1.0 / self.frame_rate
    }
}
