//! Robots on a circle change places with those opposite: everybody's way leads through the middle.
//!
//! The usual test of reciprocal collision avoidance (van den Berg, Guy, Lin & Manocha 2011).

use std::f64::consts::TAU;

use env_model::Point;
use env_model::motion::State;
use rand_chacha::ChaCha8Rng;

use super::{Play, Setup, on_circle};
use crate::{Settings, Task, View, draw};

/// Radius of the circle as part of the half width of the field.
const RADIUS: f64 = 0.6;

/// The play.
#[derive(Debug, Default)]
pub struct CircleSwap {
    goals: Vec<Point>,
}

impl Play for CircleSwap {
    fn setup(&mut self, settings: &Settings, rng: &mut ChaCha8Rng) -> Setup {
        let radius = RADIUS * settings.league.half_size()[1];
        let n = settings.robots;
        let place = |i: usize| on_circle(radius, TAU * i as f64 / n as f64);
        let starts: Vec<Point> = (0..n).map(|i| place(i) + draw::in_disc(rng, settings.jitter)).collect();
        self.goals = starts.iter().map(|start| Point::from(-start.coords)).collect();
        let drifters = (0..settings.opponents).map(|i| {
            // Round the outside, towards the middle of the field and beyond.
            let angle = TAU * (i as f64 + 0.5) / settings.opponents as f64;
            let aim = draw::in_disc(rng, 0.5 * radius);
            let from = on_circle(1.3 * radius, angle);
            State { position: from, velocity: (Point::from(aim) - from).normalize() * 0.5 * settings.speed }
        });
        Setup {
            opponents: drifters.collect(),
            own: starts.into_iter().map(State::at_rest).collect(),
            ball: None,
            goals: self.goals.clone(),
        }
    }

    fn direct(&mut self, _view: &View<'_>, tasks: &mut [Task]) {
        for (task, goal) in tasks.iter_mut().zip(&self.goals) {
            task.goal = *goal;
        }
    }
}
