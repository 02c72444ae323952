//! Own robots run the length of the field while opponents drift across their ways with constant velocity.

use env_model::motion::State;
use env_model::{Point, Vector};
use rand_chacha::ChaCha8Rng;

use super::{Play, Setup};
use crate::{Settings, Task, View, draw};

/// The play.
#[derive(Debug, Default)]
pub struct Crossing {
    goals: Vec<Point>,
}

impl Play for Crossing {
    fn setup(&mut self, settings: &Settings, rng: &mut ChaCha8Rng) -> Setup {
        let [x, y] = settings.league.half_size();
        let n = settings.robots;
        let lane = |i: usize| if n == 1 { 0.0 } else { y * (1.2 * i as f64 / (n - 1) as f64 - 0.6) };
        let starts: Vec<Point> =
            (0..n).map(|i| Point::new(-0.8 * x, lane(i)) + draw::in_disc(rng, settings.jitter)).collect();
        self.goals = starts.iter().map(|s| Point::new(-s.x, -s.y)).collect();
        let opponents = (0..settings.opponents).map(|_| {
            let position = Point::new(draw::between(rng, -0.55 * x, 0.7 * x), draw::between(rng, -0.9 * y, 0.9 * y));
            // Mostly across.
            let across = draw::between(rng, 0.2, 0.6) * settings.speed;
            let sign = if position.y > 0.0 { -1.0 } else { 1.0 };
            State { position, velocity: Vector::new(draw::between(rng, -0.2, 0.2) * settings.speed, sign * across) }
        });
        Setup {
            opponents: opponents.collect(),
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
