//! The referee's commands, and what each asks of a team.

use serde::{Deserialize, Serialize};

/// What the referee commands. "Own" is the team that is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Command {
    /// No rules at all, only the field's border: for comparisons with and without.
    Off,
    /// All brake and stand.
    Halt,
    /// Slowly, away from the ball and the opposing defence area.
    Stop,
    /// The ball is in play.
    #[default]
    #[serde(alias = "normal-start", alias = "force-start")]
    Running,
    /// A direct free kick of the own team.
    DirectFreeOwn,
    /// A direct free kick of the opponents.
    DirectFreeOpponent,
    /// Kick-off of the own team: own half and outside of the centre circle, but for the taker.
    KickoffOwn,
    /// Kick-off of the opponents.
    KickoffOpponent,
    /// The own team places the ball: out of its way, but for the taker.
    BallPlacementOwn,
    /// The opponents place the ball.
    BallPlacementOpponent,
}

/// "Robot Stop Speed" (SSL rules 2026): in STOP robots are slower than this, in m/s.
pub const STOP_SPEED: f64 = 1.5;
/// How far below [`STOP_SPEED`] robots are told to stay, in m/s: the rule says slower, and wheels are not exact.
pub const STOP_ROOM: f64 = 0.05;

impl Command {
    /// The speed that the rules allow, in m/s; infinite where they say nothing.
    pub fn speed(self) -> f64 {
        if self == Self::Stop { STOP_SPEED } else { f64::INFINITY }
    }

    /// The speed that robots are given, in m/s.
    pub(crate) fn cap(self) -> f64 {
        self.speed() - STOP_ROOM
    }

    /// Whether anybody has to keep a distance from the ball.
    pub fn minds_ball(self) -> bool {
        !matches!(self, Self::Off | Self::Halt | Self::Running | Self::DirectFreeOwn)
    }
}
