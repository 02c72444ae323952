//! Always a safe answer: escape, the nearest free goal, or the brakes; and when the first collision is due.

use env_model::Point;
use env_model::motion::{Contact, Trajectory, bang_bang, brake, first_contact};
use planner_api::{ControlError, Controller, Outcome, Run, Situation};

use crate::{nearest_free, stop_in_time};

/// What kind of answer it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Safety {
    /// To the goal, as the controller found it.
    Ok,
    /// To another goal, because the one asked for is not free: the nearest free point.
    Adapted,
    /// Part of the way.
    Partial,
    /// Out of an obstacle that the robot is in.
    Escape,
    /// Nothing was found, or a collision is due too soon: as hard as possible to a stop.
    Brake,
}

impl Safety {
    /// Its name in records.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Adapted => "adapted",
            Self::Partial => "partial",
            Self::Escape => "escape",
            Self::Brake => "brake",
        }
    }
}

/// What a robot is to do from now on. Its buffers are reused.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The motion.
    pub trajectory: Trajectory,
    /// What kind of motion it is.
    pub safety: Safety,
    /// Where it leads, or was meant to: the goal asked for unless that is not free.
    pub goal: Point,
    /// The first collision on the way, as far as movers are predicted; `None` for a free one.
    pub contact: Option<Contact>,
}

impl Default for Answer {
    fn default() -> Self {
        Self { trajectory: Trajectory::default(), safety: Safety::Brake, goal: Point::origin(), contact: None }
    }
}

/// A controller whose answers are safe. It never judges by the controller's word: what it reports of contact is
/// computed from the trajectory.
pub struct Guard {
    controller: Box<dyn Controller>,
    /// Whether it brakes while it still can stop in time.
    emergency_brake: bool,
}

impl Guard {
    /// Guards `controller`, which decides alone unless it finds nothing.
    pub fn new(controller: Box<dyn Controller>) -> Self {
        Self { controller, emergency_brake: false }
    }

    /// Whether to brake where the robot could no longer stop in time one period later: see [`stop_in_time`].
    #[must_use]
    pub fn with_emergency_brake(self, emergency_brake: bool) -> Self {
        Self { emergency_brake, ..self }
    }

    /// Forgets what the controller remembers.
    pub fn reset(&mut self) {
        self.controller.reset();
    }

    /// What the robot is to do from now on.
    ///
    /// # Errors
    /// [`ControlError`] where the situation cannot be treated at all; then `answer` brakes.
    pub fn answer(
        &mut self,
        situation: &Situation<'_>,
        run: &mut Run<'_>,
        answer: &mut Answer,
    ) -> Result<(), ControlError> {
        let Situation { world, movers, state, goal, limits, horizon, .. } = *situation;
        answer.contact = None;
        answer.goal = goal;
        let result = self.decide(situation, run, answer);
        if answer.safety == Safety::Brake {
            brake(state, limits, &mut answer.trajectory);
        }
        answer.contact = first_contact(&answer.trajectory, world, movers, horizon);
        if self.emergency_brake {
            stop_in_time(situation, answer);
        }
        result
    }

    fn decide(
        &mut self,
        situation: &Situation<'_>,
        run: &mut Run<'_>,
        answer: &mut Answer,
    ) -> Result<(), ControlError> {
        let Situation { world, movers, state, goal, limits, .. } = *situation;
        answer.safety = Safety::Brake;
        let here = state.position;
        let stuck = !world.point_free(here) || movers.iter().any(|m| m.shape.point_clearance(here) < 0.0);
        if stuck {
            if let Some(out) = nearest_free(world, movers, here) {
                answer.safety = Safety::Escape;
                answer.goal = out;
                bang_bang(state, out, limits, &mut answer.trajectory);
            }
            return Ok(());
        }
        // Movers may leave the goal until the robot is there; what stands still will not.
        let Some(reachable) = nearest_free(world, &[], goal) else { return Ok(()) };
        answer.goal = reachable;
        let mut asked = *situation;
        asked.goal = reachable;
        answer.safety = match self.controller.control(&asked, run, &mut answer.trajectory)? {
            Outcome::NotFound => Safety::Brake,
            Outcome::Partial => Safety::Partial,
            Outcome::Arrives if reachable != goal => Safety::Adapted,
            Outcome::Arrives => Safety::Ok,
        };
        Ok(())
    }
}
