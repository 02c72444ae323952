//! Own robots run the length of the field while opponents drift across their ways with constant velocity.
//!
//! Each opponent is aimed at the way of one robot: were the robot to run straight, both would be at one point at one
//! time. In the next wave the robots run back; opponents then are where they are.

use env_model::motion::{Limits, State, Trajectory, bang_bang};
use env_model::{Point, Vector};
use planner_api::SettingError;
use rand_chacha::ChaCha8Rng;

use super::placing::{APART, Placing};
use super::{Play, Setup, limits, middle_ball};
use crate::{Settings, draw};

/// Where lanes begin, as parts of half the field's length and half its width.
const BEGIN: [f64; 2] = [0.6, 0.6];
/// No opponent comes near to a start so soon, in seconds.
const GRACE: f64 = 0.5;
/// Draws of an opponent before it is put anywhere.
const TRIES: usize = 200;

/// The play.
#[derive(Debug, Default)]
pub struct Crossing {
    goals: Vec<Point>,
}

impl Play for Crossing {
    fn setup(&mut self, settings: &Settings, rng: &mut ChaCha8Rng) -> Result<Setup, SettingError> {
        let [x, y] = settings.league.half_size();
        let (n, m) = (settings.robots, settings.opponents);
        let ball = middle_ball(settings);
        let mut placing = Placing::new(settings, ball.map(|ball| ball.position));
        let mut own = Vec::new();
        for i in 0..n {
            let lane = if n == 1 { 0.0 } else { 2.0 * i as f64 / (n - 1) as f64 - 1.0 };
            let nominal = Point::new(-BEGIN[0] * x, BEGIN[1] * y * lane);
            own.push(State::at_rest(placing.near("robots", n, nominal, settings.jitter, rng)?));
        }
        self.goals = own.iter().map(|start| Point::from(-start.position.coords)).collect();
        let limits = limits(settings, 1.0, 1.0);
        let mut way = Trajectory::default();
        let mut opponents = Vec::new();
        for i in 0..m {
            let robot = i % n;
            bang_bang(own[robot], self.goals[robot], limits, &mut way);
            let aimed = (0..TRIES).map(|_| aimed(&way, settings.speed, rng));
            let found = aimed.into_iter().find(|drifter| {
                placing.legal(drifter.position) && placing.apart(drifter.position) && is_clear(*drifter, &own, limits)
            });
            let drifter = match found {
                Some(drifter) => drifter,
                None => anywhere(&mut placing, settings, &own, limits, rng)?,
            };
            placing.take(drifter.position);
            opponents.push(drifter);
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

/// An opponent that meets who goes `way` in the middle two thirds of it.
fn aimed(way: &Trajectory, speed: f64, rng: &mut ChaCha8Rng) -> State {
    let when = draw::between(rng, 1.0 / 6.0, 5.0 / 6.0) * way.duration();
    // Mostly across, from either side.
    let across = draw::between(rng, 0.2, 0.6) * speed;
    let sign = if draw::uniform(rng) < 0.5 { -1.0 } else { 1.0 };
    let velocity = Vector::new(draw::between(rng, -0.2, 0.2) * speed, sign * across);
    State { position: way.state(when).position - velocity * when, velocity }
}

/// Whether nobody who stands at a start, or runs from it, is met within the grace.
fn is_clear(drifter: State, own: &[State], limits: Limits) -> bool {
    let reach = (0.5 * limits.acceleration * GRACE * GRACE).min(limits.speed * GRACE);
    let end = drifter.position + drifter.velocity * GRACE;
    let near = |p: Point| env_model::geometry::point_segment_distance(p, drifter.position, end);
    own.iter().all(|robot| near(robot.position) >= APART + reach)
}

/// An opponent that drifts across somewhere, where none can be aimed.
fn anywhere(
    placing: &mut Placing,
    settings: &Settings,
    own: &[State],
    limits: Limits,
    rng: &mut ChaCha8Rng,
) -> Result<State, SettingError> {
    let [x, y] = settings.league.half_size();
    let drift = |position: Point| {
        let speed = 0.2 * settings.speed;
        State { position, velocity: Vector::new(0.0, if position.y > 0.0 { -speed } else { speed }) }
    };
    for _ in 0..TRIES {
        let p = Point::new(draw::between(rng, -0.5 * x, x), draw::between(rng, -y, y));
        if placing.legal(p) && placing.apart(p) && is_clear(drift(p), own, limits) {
            return Ok(drift(p));
        }
    }
    Err(SettingError {
        key: "opponents",
        value: settings.opponents.to_string(),
        expected: "fewer, or slower, so that none is upon a robot within the first half second",
    })
}
