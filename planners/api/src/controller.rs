//! Robots in motion: the contract of controllers, which are called every frame.

use env_model::motion::{Limits, MotionError, Mover, State, Trajectory};
use env_model::{Point, World};

use crate::{PlanError, Run};

/// What one robot faces now. Borrowed.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct Situation<'a> {
    /// What stands still, and the field, compiled for this robot's radius.
    pub world: &'a World,
    /// What moves, grown by this robot's radius; the robot itself is not among it.
    pub movers: &'a [Mover<'a>],
    /// Where the robot is and how it moves.
    pub state: State,
    /// Where it is to stand.
    pub goal: Point,
    /// What it can do.
    pub limits: Limits,
    /// So far the motion of movers is predicted, in seconds, > 0: later nobody knows where they are.
    pub horizon: f64,
    /// Seconds until the next call, > 0: the time for which an answer is certain to be followed.
    pub period: f64,
}

impl<'a> Situation<'a> {
    /// Checks that all numbers are usable; says nothing of collisions.
    ///
    /// # Errors
    /// [`ControlError::Motion`] names what is not finite, or not positive.
    #[allow(clippy::too_many_arguments, reason = "each is a field, and none has a default")]
    pub fn new(
        world: &'a World,
        movers: &'a [Mover<'a>],
        state: State,
        goal: Point,
        limits: Limits,
        horizon: f64,
        period: f64,
    ) -> Result<Self, ControlError> {
        state.finite()?;
        MotionError::finite("goal", goal.coords)?;
        Limits::new(limits.speed, limits.acceleration)?;
        MotionError::positive("prediction horizon", horizon)?;
        MotionError::positive("period", period)?;
        for (i, mover) in movers.iter().enumerate() {
            mover.check().map_err(|error| ControlError::Mover { index: i, error })?;
        }
        Ok(Self { world, movers, state, goal, limits, horizon, period })
    }
}

/// What a controller thinks of its trajectory. Whether it touches anything is for others to say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It leads to the goal.
    Arrives,
    /// It leads part of the way, or a controller of the next moment alone (velocities, forces) has no more to say.
    Partial,
    /// Nothing was found; the trajectory is not to be followed.
    NotFound,
}

/// Why a controller could not begin.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ControlError {
    /// The robot's own numbers.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A mover's numbers.
    #[error("mover {index}: {error}")]
    Mover {
        /// Which one, counted from 0.
        index: usize,
        /// What is wrong with it.
        error: MotionError,
    },
    /// The planner within.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

/// A controller of one robot: from what it faces now to how it moves from now on.
///
/// It is called every frame; of each answer only the first [`Situation::period`] is followed for certain. Start and
/// goal are free of what stands still, `planner-control`'s guard sees to that; movers may be nearer than their margin.
/// The same calls in the same order, with the same seeds and *count* budgets, give the same trajectories, bit for bit.
pub trait Controller: Send {
    /// Writes the robot's motion from now on into `trajectory`, whose buffer is reused.
    ///
    /// Keeps the robot's limits to 1e-9 relative; a robot above its speed limit brakes down to it.
    ///
    /// # Errors
    /// [`ControlError`] for input that it cannot treat; failing to find a way is [`Outcome::NotFound`].
    fn control(
        &mut self,
        situation: &Situation<'_>,
        run: &mut Run<'_>,
        trajectory: &mut Trajectory,
    ) -> Result<Outcome, ControlError>;

    /// Forgets what it remembers of earlier frames.
    fn reset(&mut self) {}
}
