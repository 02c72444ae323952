//! Simulated omnidirectional robots.

use env_model::motion::{Limits, State, Trajectory};
use rand::Rng;

use crate::draw;

/// Steps of a frame in which a robot that does not follow exactly changes its acceleration.
const SUBSTEPS: usize = 4;

/// A robot as it truly moves.
#[derive(Debug, Clone)]
pub struct Body {
    /// Where it is.
    pub state: State,
    /// What it can do.
    pub limits: Limits,
    /// Its motion during the last frame.
    pub motion: Trajectory,
}

impl Body {
    /// A robot at rest.
    pub fn new(state: State, limits: Limits) -> Self {
        Self { state, limits, motion: Trajectory::new(state) }
    }

    /// Moves for `period` seconds exactly as `trajectory` says from `from` on.
    pub fn follow(&mut self, trajectory: &Trajectory, from: f64, period: f64) {
        self.motion.copy_from(trajectory);
        self.motion.advance(from);
        self.state = self.motion.state(period);
    }

    /// Moves for `period` seconds, tracking the velocities of `trajectory` from `from` on with an error of the relative
    /// standard deviation `noise`, within its limits.
    pub fn track(&mut self, trajectory: &Trajectory, from: f64, period: f64, noise: f64, rng: &mut impl Rng) {
        self.motion.begin(self.state);
        let step = period / SUBSTEPS as f64;
        let gain = 1.0 + noise * draw::normal(rng);
        for i in 1..=SUBSTEPS {
            let mut wanted = trajectory.state(from + step * i as f64).velocity * gain;
            let speed = wanted.norm();
            if speed > self.limits.speed {
                wanted *= self.limits.speed / speed;
            }
            let mut change = (wanted - self.motion.end().velocity) / step;
            let size = change.norm();
            if size > self.limits.acceleration {
                change *= self.limits.acceleration / size;
            }
            self.motion.push(step, change);
        }
        self.state = self.motion.end();
    }
}
