//! Obstacles that move.

use super::{MotionError, Trajectory};
use crate::{Core, Inflated, Point, Vector};

/// Whose a moving obstacle is: who gives way, and how far it can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// A robot of one's own team, which plans as we do.
    Mate,
    /// A robot that does not give way to us.
    Opponent,
    /// Anything else (the ball, a referee's foot).
    Other,
}

/// How an obstacle is expected to move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Path<'a> {
    /// With constant velocity, perhaps none, in units per second.
    Velocity(Vector),
    /// As this trajectory does: displaced by what it is displaced since time 0.
    Trajectory(&'a Trajectory),
}

/// An obstacle in motion, as seen by one robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Mover<'a> {
    /// Its shape now, grown by the radius of the robot that sees it, as a world's obstacles are: contact is where
    /// that robot's centre enters it.
    pub shape: Inflated,
    /// Where it goes.
    pub path: Path<'a>,
    /// Distance beyond contact that plans should keep, in scene units, ≥ 0. Contact itself knows no margin.
    pub margin: f64,
    /// Whose it is.
    pub side: Side,
    /// How hard it can brake, in units per second², > 0; `None` where nobody knows: as hard as the robot that sees it.
    pub braking: Option<f64>,
}

impl<'a> Mover<'a> {
    /// A disc: robots and balls. `radius` is the sum of both radii.
    pub fn disc(centre: Point, radius: f64, path: Path<'a>, side: Side) -> Self {
        Self { shape: Inflated { core: Core::Point(centre), radius }, path, margin: 0.0, side, braking: None }
    }

    /// The same with a margin.
    #[must_use]
    pub fn with_margin(self, margin: f64) -> Self {
        Self { margin, ..self }
    }

    /// The same with a known braking deceleration.
    #[must_use]
    pub fn with_braking(self, braking: f64) -> Self {
        Self { braking: Some(braking), ..self }
    }

    /// Checks that its numbers are usable: shape, margin, braking, and all of its path. A disc has a radius above 0.
    ///
    /// # Errors
    /// [`MotionError`] names what is not.
    pub fn check(&self) -> Result<(), MotionError> {
        match self.shape.core {
            Core::Point(_) => MotionError::positive("radius", self.shape.radius)?,
            _ => MotionError::not_negative("radius", self.shape.radius)?,
        };
        MotionError::not_negative("margin", self.margin)?;
        if let Some(braking) = self.braking {
            MotionError::positive("braking", braking)?;
        }
        let aabb = self.shape.aabb();
        MotionError::finite("shape", aabb.min.coords)?;
        MotionError::finite("shape", aabb.max.coords)?;
        match self.path {
            Path::Velocity(velocity) => MotionError::finite("velocity", velocity).map(|_| ()),
            Path::Trajectory(trajectory) => trajectory.check(),
        }
    }

    /// Its velocity now.
    pub fn velocity(&self) -> Vector {
        match self.path {
            Path::Velocity(v) => v,
            Path::Trajectory(trajectory) => trajectory.start().velocity,
        }
    }

    /// How far it will have moved in `t` seconds.
    pub fn displacement(&self, t: f64) -> Vector {
        match self.path {
            Path::Velocity(v) => v * t,
            Path::Trajectory(trajectory) => trajectory.state(t).position - trajectory.start().position,
        }
    }
}
