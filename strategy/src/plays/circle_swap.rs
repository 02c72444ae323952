//! Robots on a circle change places with those opposite: everybody's way leads through the middle.
//!
//! The usual test of reciprocal collision avoidance (van den Berg, Guy, Lin & Manocha 2011). In the next wave they
//! change back.

use std::f64::consts::TAU;

use env_model::Point;
use env_model::motion::State;
use planner_api::SettingError;
use rand_chacha::ChaCha8Rng;

use super::placing::Placing;
use super::{Play, Setup, middle_ball, on_circle};
use crate::{Settings, draw};

/// Radius of the circle as part of the half width of the field.
const RADIUS: f64 = 0.6;

/// The play.
#[derive(Debug, Default)]
pub struct CircleSwap {
    goals: Vec<Point>,
}

impl Play for CircleSwap {
    fn setup(&mut self, settings: &Settings, rng: &mut ChaCha8Rng) -> Result<Setup, SettingError> {
        let radius = RADIUS * settings.league.half_size()[1];
        let (n, m) = (settings.robots, settings.opponents);
        let ball = middle_ball(settings);
        let mut placing = Placing::new(settings, ball.map(|ball| ball.position));
        let mut own = Vec::new();
        for i in 0..n {
            let nominal = on_circle(radius, TAU * i as f64 / n as f64);
            own.push(State::at_rest(placing.near("robots", n, nominal, settings.jitter, rng)?));
        }
        self.goals = own.iter().map(|start| Point::from(-start.position.coords)).collect();
        let mut opponents = Vec::new();
        for i in 0..m {
            // Round the outside, towards the middle of the field and beyond.
            let angle = TAU * (i as f64 + 0.5) / m as f64;
            let aim = Point::from(draw::in_disc(rng, 0.5 * radius));
            let position = placing.near("opponents", m, on_circle(1.3 * radius, angle), 0.0, rng)?;
            opponents.push(State { position, velocity: (aim - position).normalize() * 0.5 * settings.speed });
        }
        Ok(Setup { own, opponents, ball, placement: None })
    }

    fn goals(&self) -> &[Point] {
        &self.goals
    }

    fn next_wave(&mut self) {
        for goal in &mut self.goals {
            *goal = Point::from(-goal.coords);
        }
    }
}
