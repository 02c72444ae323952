//! Simulated omnidirectional robots.

use env_model::Vector;
use env_model::motion::{Limits, State, Trajectory};
use rand::Rng;

use crate::draw;
use crate::orders::Orders;

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

    /// Moves as `run` says for `period` seconds.
    pub fn run(&mut self, run: &Trajectory, period: f64) {
        self.motion.copy_from(run);
        self.state = self.motion.state(period);
    }

    /// Moves from `time` on for `period` seconds exactly as ordered; before the first order as it moves already.
    pub(crate) fn follow(&mut self, orders: &Orders, time: f64, period: f64) {
        let mut parts = orders.between(time, time + period);
        if let (Some((order, begin, _)), None) = (parts.next(), parts.next())
            && orders.at(time).is_some()
        {
            // One order for the whole frame: its very numbers.
            self.motion.copy_from(order);
            self.motion.advance(begin);
        } else {
            self.motion.begin(self.state);
            let ordered: f64 = orders.between(time, time + period).map(|(_, _, duration)| duration).sum();
            self.motion.push(period - ordered, Vector::zeros());
            let mut part = Trajectory::default();
            for (order, begin, duration) in orders.between(time, time + period) {
                let until = self.motion.duration() + duration;
                part.copy_from(order);
                part.advance(begin);
                self.motion.append(&part, duration);
                self.motion.push(until - self.motion.duration(), Vector::zeros());
            }
        }
        self.state = self.motion.state(period);
    }

    /// Moves from `time` on for `period` seconds, tracking the velocities ordered, within its limits, with accelerations
    /// that are wrong by the relative standard deviation `noise`.
    pub(crate) fn track(&mut self, orders: &Orders, time: f64, period: f64, noise: f64, rng: &mut impl Rng) {
        self.motion.begin(self.state);
        let step = period / SUBSTEPS as f64;
        let gain = 1.0 + noise * draw::normal(rng);
        for i in 1..=SUBSTEPS {
            let then = time + step * i as f64;
            let now = self.motion.end().velocity;
            let wanted = orders.at(then).map_or(now, |(order, t)| order.state(t).velocity);
            let mut change = (wanted - now) * (gain / step);
            let size = change.norm();
            if size > self.limits.acceleration {
                change *= self.limits.acceleration / size;
            }
            // A speed is a convex function of the velocity: where both ends keep the limit, so does all between.
            let speed = (now + change * step).norm();
            if speed > self.limits.speed.max(now.norm()) {
                change = (wanted - now) / step;
                let size = change.norm();
                change *= (self.limits.acceleration / size).min(1.0);
            }
            self.motion.push(step, change);
        }
        self.state = self.motion.end();
    }
}
