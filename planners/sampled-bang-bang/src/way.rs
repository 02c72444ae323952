//! The ways that are tried: what they are, how good they are.

use env_model::Point;
use env_model::motion::axis;
use env_model::motion::{Limits, State};

/// A motion that a few numbers tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Way {
    /// To the goal with this share of the speed limit.
    Direct(f64),
    /// Towards `via`, and from the time `switch` on to the goal.
    Through {
        /// The intermediate destination.
        via: Point,
        /// Seconds from now.
        switch: f64,
    },
    /// To this point, and stay.
    Rest(Point),
}

impl Way {
    /// The same motion, seen `period` seconds later.
    pub fn later(self, period: f64) -> Self {
        match self {
            Self::Through { switch, .. } if switch <= period => Self::Direct(1.0),
            Self::Through { via, switch } => Self::Through { via, switch: switch - period },
            other => other,
        }
    }
}

/// What a way is worth; the less, the better.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub enum Worth {
    /// Free, and at the goal after these seconds.
    Arrives(f64),
    /// Free, but to somewhere else: when the robot could be at the goal if it were free to go on from there.
    Rests(f64),
    /// Free, as [`Worth::Arrives`], but the robot could not stop in time if an opponent did anything unforeseen.
    Dares(f64),
    /// Touches something after these seconds, negated; the robot could stop before.
    Touches(f64),
    /// The same, and it might be too late for stopping.
    Risks(f64),
}

impl Worth {
    /// Better by `seconds`, for what was chosen before.
    #[must_use]
    pub fn favoured(self, seconds: f64) -> Self {
        match self {
            Self::Arrives(t) => Self::Arrives(t - seconds),
            Self::Rests(t) => Self::Rests(t - seconds),
            Self::Dares(t) => Self::Dares(t - seconds),
            Self::Touches(t) => Self::Touches(t - seconds),
            Self::Risks(t) => Self::Risks(t - seconds),
        }
    }
}

/// Less than any motion within `limits` needs from `state` to rest at `goal`, in seconds: along the line to the goal
/// and across.
pub fn at_least(state: State, goal: Point, limits: Limits) -> f64 {
    let d = goal - state.position;
    let length = d.norm();
    if length == 0.0 {
        return state.velocity.norm() / limits.acceleration;
    }
    let (n, v) = (d / length, state.velocity);
    let time = |d: f64, v: f64| axis::time(d, v, limits.speed, limits.acceleration);
    time(length, n.dot(&v)).max(time(0.0, n.x * v.y - n.y * v.x))
}
