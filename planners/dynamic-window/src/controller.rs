//! The controller.

use std::f64::consts::{PI, TAU};

use env_model::motion::{Limits, State, Trajectory, bang_bang, change_velocity, stop};
use env_model::{Vector, geometry};
use planner_api::{ControlError, Controller, Outcome, Run, SettingError, Situation};

use crate::DynamicWindowSettings;
use crate::danger::first_contact;

/// The dynamic window approach; see the crate. Remembers nothing from call to call but its buffers.
///
/// The answer is the motion to the chosen velocity and from there to a stop ([`Outcome::Partial`]), or the fastest
/// motion to the goal. Candidates are examined in the order of what they can reach at best, until none that is left
/// can be better.
#[derive(Debug, Clone)]
pub struct DynamicWindow {
    settings: DynamicWindowSettings,
    candidates: Vec<Candidate>,
    trial: Trajectory,
}

#[derive(Debug, Clone, Copy)]
struct Candidate {
    velocity: Vector,
    /// α·heading + γ·velocity.
    worth: f64,
    /// Its number in the order of sampling, in which equals stay.
    number: usize,
}

/// The best so far: an admissible candidate before any other, then the greater value.
#[derive(Debug, Clone, Copy)]
struct Best {
    velocity: Vector,
    admissible: bool,
    /// G, or where it is not admissible the time of contact.
    value: f64,
}

impl DynamicWindow {
    /// A controller with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: DynamicWindowSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, candidates: Vec::new(), trial: Trajectory::default() })
    }

    /// Fills the window: no change, braking, and rings of changes, the first direction towards the goal. A robot that is
    /// too fast has no choice but to brake down to its limit.
    fn sample(&mut self, situation: &Situation<'_>) {
        let Situation { state, goal, limits, period, .. } = *situation;
        let change = limits.acceleration * self.settings.interval.max(period);
        let (v, to) = (state.velocity, goal - state.position);
        let speed = v.norm();
        self.candidates.clear();
        let mut consider = |w: Vector| {
            let w = if w.norm() > limits.speed { w * (limits.speed / w.norm()) } else { w };
            let worth = worth(&self.settings, situation, w);
            let number = self.candidates.len();
            self.candidates.push(Candidate { velocity: w, worth, number });
        };
        consider(v);
        if speed > limits.speed {
            return;
        }
        consider(if speed > change { v * (1.0 - change / speed) } else { Vector::zeros() });
        let begin = libm::atan2(to.y, to.x);
        for i in 0..self.settings.directions {
            let angle = begin + TAU * i as f64 / self.settings.directions as f64;
            let direction = Vector::new(libm::cos(angle), libm::sin(angle));
            for ring in 1..=self.settings.rings {
                consider(v + direction * (change * ring as f64 / self.settings.rings as f64));
            }
        }
        self.candidates.sort_unstable_by(|a, b| b.worth.total_cmp(&a.worth).then(a.number.cmp(&b.number)));
    }

    /// The best velocity of the window.
    fn choose(&mut self, situation: &Situation<'_>, run: &mut Run<'_>) -> Vector {
        let Situation { state, limits, horizon, .. } = *situation;
        let mut best: Option<Best> = None;
        for i in 0..self.candidates.len() {
            let Candidate { velocity, worth, .. } = self.candidates[i];
            if best.is_some_and(|b| b.admissible && b.value >= worth + self.settings.clearance) {
                break;
            }
            run.spent.evaluations += 1;
            let margin = self.settings.margin;
            let danger = |trial: &Trajectory, until| first_contact(trial, situation, margin, until);
            ramp(state, velocity, limits, &mut self.trial);
            stop(&mut self.trial, limits);
            let contact = danger(&self.trial, self.trial.duration());
            let admissible = contact.is_none();
            let value = contact.unwrap_or_else(|| {
                ramp(state, velocity, limits, &mut self.trial);
                let clearance = danger(&self.trial, horizon).map_or(1.0, |t| t / horizon);
                worth + self.settings.clearance * clearance
            });
            if best.is_none_or(|b| (admissible, value) > (b.admissible, b.value)) {
                best = Some(Best { velocity, admissible, value });
            }
        }
        best.map_or(state.velocity, |b| b.velocity)
    }
}

/// α·heading + γ·velocity of `w`.
fn worth(settings: &DynamicWindowSettings, situation: &Situation<'_>, w: Vector) -> f64 {
    let Situation { state, goal, limits, .. } = *situation;
    let time = (w - state.velocity).norm() / limits.acceleration;
    let to = goal - (state.position + (state.velocity + w) * (0.5 * time));
    let (distance, speed) = (to.norm(), w.norm());
    let heading = if speed > 0.0 && distance > 0.0 {
        1.0 - libm::atan2(geometry::cross(w, to), w.dot(&to)).abs() / PI
    } else {
        0.0
    };
    let wanted = limits.speed.min((2.0 * limits.acceleration * distance).sqrt());
    settings.heading * heading + settings.velocity * (1.0 - (speed - wanted).abs() / limits.speed)
}

/// From `state` to `velocity` as fast as possible, into `out`.
fn ramp(state: State, velocity: Vector, limits: Limits, out: &mut Trajectory) {
    out.begin(state);
    change_velocity(out, velocity, limits);
}

impl Controller for DynamicWindow {
    fn control(
        &mut self,
        situation: &Situation<'_>,
        run: &mut Run<'_>,
        trajectory: &mut Trajectory,
    ) -> Result<Outcome, ControlError> {
        let Situation { state, goal, limits, horizon, .. } = *situation;
        bang_bang(state, goal, limits, trajectory);
        run.spent.evaluations += 1;
        if first_contact(trajectory, situation, self.settings.margin, horizon).is_none() {
            return Ok(Outcome::Arrives);
        }
        self.sample(situation);
        let velocity = self.choose(situation, run);
        ramp(state, velocity, limits, trajectory);
        stop(trajectory, limits);
        Ok(Outcome::Partial)
    }
}
