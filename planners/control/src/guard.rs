//! Always a safe answer: escape, the nearest free goal, or the brakes; and when the first collision is due.

use std::f64::consts::PI;

use env_model::motion::{Contact, Trajectory, bang_bang, brake, first_contact};
use env_model::{Point, Vector};
use planner_api::seed::{splitmix64, unit};
use planner_api::{ControlError, Controller, Outcome, Run, Situation};

use crate::escape::nearest_accepted;
use crate::{Foresight, nearest_free};

/// So many ways out are tried where the nearest one is a mate's.
const WAYS_OUT: usize = 8;
/// How exactly a controller's motion must begin where the robot is, over its speed.
const BEGINNING: f64 = 1e-9;
/// By how much a controller's motion may exceed the limits: more than the contract's 1e-9, less than any robot notices.
const EXCESS: f64 = 1.0 + 1e-6;

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
    /// Nothing was found, or no motion that the robot can make, or a collision is due too soon: as hard as possible to a
    /// stop.
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

/// A controller whose answers are safe. It never judges by the controller's word: a motion that does not begin where the
/// robot is, is not finite, or exceeds the robot's limits is answered with the brakes, and what it reports of contact
/// is computed from the trajectory.
pub struct Guard {
    controller: Box<dyn Controller>,
    /// Whether it brakes while it still can stop in time.
    emergency_brake: bool,
    foresight: Foresight,
    stop: Trajectory,
}

impl Guard {
    /// Guards `controller`, which decides alone unless it finds nothing.
    pub fn new(controller: Box<dyn Controller>) -> Self {
        Self { controller, emergency_brake: false, foresight: Foresight::default(), stop: Trajectory::default() }
    }

    /// Whether to brake where the robot could no longer stop in time one period later: [`Guard::stop_in_time`] at the
    /// end of every answer.
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
            self.stop_in_time(situation, answer);
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
            if let Some(out) = nearest_accepted(world, movers, here, astray(goal - here, run.seed), |_| true) {
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
            _ if !can_be_driven(&answer.trajectory, situation) => Safety::Brake,
            Outcome::Partial => Safety::Partial,
            Outcome::Arrives if reachable != goal => Safety::Adapted,
            Outcome::Arrives => Safety::Ok,
        };
        Ok(())
    }

    /// Has the robot brake where it could not stop in time any more after following `answer` for one period, unless
    /// braking meets something sooner than going on does. See [`Foresight`] for what is avoided, and on what conditions
    /// teams that do so never collide.
    ///
    /// An escape is left to go on if it spares all mates but those that the robot overlaps; else the next nearest free
    /// points are tried, and if all ways out are mates', the robot waits.
    pub fn stop_in_time(&mut self, situation: &Situation<'_>, answer: &mut Answer) {
        if answer.safety == Safety::Brake {
            return;
        }
        self.foresight.begin(situation);
        if answer.safety == Safety::Escape {
            self.escape_among_mates(situation, answer);
            return;
        }
        if self.foresight.can_stop(situation, &answer.trajectory) {
            return;
        }
        let Situation { world, movers, state, limits, horizon, .. } = *situation;
        brake(state, limits, &mut self.stop);
        let time = |contact: Option<Contact>| contact.map_or(f64::INFINITY, |c| c.time);
        let contact = first_contact(&self.stop, world, movers, horizon);
        if time(contact) >= time(answer.contact) || self.foresight.can_stop(situation, &self.stop) {
            answer.trajectory.copy_from(&self.stop);
            (answer.contact, answer.safety) = (contact, Safety::Brake);
        }
    }
    /// Keeps an escape that spares mates, or finds another one, or has the robot brake.
    fn escape_among_mates(&mut self, situation: &Situation<'_>, answer: &mut Answer) {
        if self.foresight.spares_mates(situation, &answer.trajectory) {
            return;
        }
        let Situation { world, movers, state, limits, horizon, .. } = *situation;
        let here = state.position;
        let (mut tried, mut found) = (0, false);
        nearest_accepted(world, movers, here, direction(answer.goal - here), |out| {
            bang_bang(state, out, limits, &mut answer.trajectory);
            answer.goal = out;
            tried += 1;
            found = self.foresight.spares_mates(situation, &answer.trajectory);
            found || tried == WAYS_OUT
        });
        if !found {
            brake(state, limits, &mut answer.trajectory);
            answer.safety = Safety::Brake;
        }
        answer.contact = first_contact(&answer.trajectory, world, movers, horizon);
    }
}

/// The unit vector along `v`; along x where there is none.
fn direction(v: Vector) -> Vector {
    let length = v.norm();
    if length > 0.0 && length.is_finite() { v / length } else { Vector::x() }
}

/// Along `v`, up to a quarter of a turn aside as `seed` has it: two robots at one spot must not do the same.
fn astray(v: Vector, seed: u64) -> Vector {
    let mut state = seed;
    let uniform = unit(splitmix64(&mut state));
    let (angle, u) = ((uniform - 0.5) * PI, direction(v));
    let (cos, sin) = (libm::cos(angle), libm::sin(angle));
    Vector::new(u.x * cos - u.y * sin, u.x * sin + u.y * cos)
}

/// Whether it begins where the robot is, is finite, and keeps the limits; from above the speed limit it must only
/// become slower.
fn can_be_driven(trajectory: &Trajectory, situation: &Situation<'_>) -> bool {
    let Situation { world, state, limits, .. } = *situation;
    let (start, speed) = (trajectory.start(), state.velocity.norm().max(limits.speed));
    // Not "greater than", which NaN never is.
    let begins = (start.position - state.position).norm() <= world.epsilon()
        && (start.velocity - state.velocity).norm() <= BEGINNING * speed;
    if !begins || trajectory.check().is_err() {
        return false;
    }
    let mut allowed = speed;
    let pieces_keep = trajectory.pieces().iter().all(|piece| {
        // The square of the speed is a convex function of time.
        let end = piece.state(piece.duration).velocity.norm();
        let keeps = piece.velocity.norm().max(end) <= allowed * EXCESS;
        allowed = limits.speed.max(allowed.min(end));
        keeps && piece.acceleration.norm() <= limits.acceleration * EXCESS
    });
    pieces_keep && trajectory.end().velocity.norm() <= allowed * EXCESS
}
