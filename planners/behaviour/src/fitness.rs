//! How good parameters are: the mean over scenarios of the mean over robots of
//!
//! F = Σ wₖ fₖ / Σ wₖ, between 0 and 1, of
//!
//! - path: f = |SG| / way for one that arrives, ½ max(0, 1 − d/|SG|) for one that ends at distance d of its goal;
//! - avoidance: f = 1 − mean over time of clip((S − c)/(S − M), 0, 1), c the clearance of the nearest thing, S and M the
//!   protocol's; × 0.1 after a collision;
//! - formation: f = 1 − mean over time of the distance to the slot in spacings, at most 1;
//! - arrival: f = 1 − t/T for one that arrives after t of T seconds, else 0.
//!
//! The thesis has the first two in words; the formulas are ours.

use planner_api::SettingError;

use crate::episode::{Episode, Robot};
use crate::parameters::Parameters;
use crate::protocol::{Charge, Protocol, Weights};
use crate::scenario::{Scenario, Set};

/// What a collision leaves of the fitness that it is charged to.
const COLLISION: f64 = 0.1;

/// How parameters do on a set of scenarios.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitness {
    /// The mean over scenarios.
    pub mean: f64,
    /// Each scenario's.
    pub each: Vec<f64>,
    /// Share of robots that arrive.
    pub arrived: f64,
    /// Share of robots that collide before they arrive.
    pub collided: f64,
}

/// The fitness of `parameters` on the scenarios of `seed`: its training set, or the held-out one.
///
/// # Errors
/// A setting or parameter out of its range.
pub fn fitness(protocol: &Protocol, parameters: &Parameters, set: Set, seed: u64) -> Result<Fitness, SettingError> {
    protocol.validate()?;
    parameters.validate()?;
    let count = match set {
        Set::Training => protocol.training,
        Set::HeldOut => protocol.held_out,
    };
    let mut episode = Episode::default();
    let (mut each, mut arrived, mut collided) = (Vec::with_capacity(count), 0, 0);
    for index in 0..count as u64 {
        let scenario = Scenario::draw(protocol, set, index, seed);
        let robots = episode.play(protocol, &scenario, parameters);
        arrived += robots.iter().filter(|r| r.arrived).count();
        collided += robots.iter().filter(|r| r.collided).count();
        each.push(of_team(protocol, &scenario, robots));
    }
    let share = |of: usize| of as f64 / (count * protocol.robots) as f64;
    let mean = each.iter().sum::<f64>() / count as f64;
    Ok(Fitness { mean, each, arrived: share(arrived), collided: share(collided) })
}

/// The mean fitness over `scenarios`.
pub fn mean(protocol: &Protocol, scenarios: &[Scenario], parameters: &Parameters, episode: &mut Episode) -> f64 {
    let each = scenarios.iter().map(|s| of_team(protocol, s, episode.play(protocol, s, parameters)));
    each.sum::<f64>() / scenarios.len() as f64
}

fn of_team(protocol: &Protocol, scenario: &Scenario, robots: &[Robot]) -> f64 {
    let each = robots.iter().zip(scenario.starts.iter().zip(&scenario.goals));
    let each = each
        .map(|(robot, (start, goal))| of_robot(protocol, robot, (goal - start).norm(), (goal - robot.position).norm()));
    each.sum::<f64>() / robots.len() as f64
}

/// The fitness of a robot whose goal was `distance` away at first and is `left` away at last.
fn of_robot(protocol: &Protocol, robot: &Robot, distance: f64, left: f64) -> f64 {
    let mean = |sum: f64| sum / robot.steps.max(1) as f64;
    // The rest of the way counts as well, else one that stops short of its goal would be better than straight.
    let path = if robot.arrived { distance / (robot.travelled + left) } else { 0.5 * (1.0 - left / distance).max(0.0) };
    let [on_avoidance, on_all] = match (robot.collided, protocol.collision) {
        (false, _) => [1.0, 1.0],
        (true, Charge::Avoidance) => [COLLISION, 1.0],
        (true, Charge::Whole) => [1.0, COLLISION],
    };
    let avoidance = (1.0 - mean(robot.danger)) * on_avoidance;
    let formation = 1.0 - mean(robot.astray);
    let arrival = if robot.arrived { 1.0 - robot.steps as f64 / protocol.steps as f64 } else { 0.0 };
    let w: Weights = protocol.weights;
    let sum = w.path * path + w.avoidance * avoidance + w.formation * formation + w.arrival * arrival;
    on_all * sum / (w.path + w.avoidance + w.formation + w.arrival)
}

#[cfg(test)]
mod tests {
    use env_model::{Point, Vector};

    use super::*;

    fn robot() -> Robot {
        Robot {
            position: Point::origin(),
            velocity: Vector::zeros(),
            travelled: 4.9,
            steps: 40,
            danger: 10.0,
            astray: 4.0,
            arrived: true,
            collided: false,
        }
    }

    #[test]
    fn every_part_by_hand() {
        let one = |path, avoidance, formation, arrival| Protocol {
            weights: Weights { path, avoidance, formation, arrival },
            ..Protocol::default()
        };
        let of = |protocol: &Protocol, robot: &Robot| of_robot(protocol, robot, 4.0, 0.1);
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} for {b}: a few roundings");
        near(of(&one(2.0, 0.0, 0.0, 0.0), &robot()), 4.0 / 5.0);
        near(of(&one(0.0, 2.0, 0.0, 0.0), &robot()), 0.75);
        near(of(&one(0.0, 0.0, 2.0, 0.0), &robot()), 0.9);
        near(of(&one(0.0, 0.0, 0.0, 2.0), &robot()), 0.75);
        near(of(&one(0.5, 0.5, 0.0, 0.0), &robot()), 0.775);
        let collided = Robot { collided: true, ..robot() };
        near(of(&one(0.5, 0.5, 0.0, 0.0), &collided), 0.5 * 0.8 + 0.5 * 0.075);
        near(of(&Protocol { collision: Charge::Whole, ..one(0.5, 0.5, 0.0, 0.0) }, &collided), 0.0775);
        let lost = Robot { arrived: false, ..robot() };
        near(of_robot(&one(1.0, 0.0, 0.0, 0.0), &lost, 4.0, 1.0), 0.375);
        near(of_robot(&one(1.0, 0.0, 0.0, 0.0), &lost, 4.0, 5.0), 0.0);
        near(of(&one(0.0, 0.0, 0.0, 1.0), &lost), 0.0);
    }

    #[test]
    fn an_empty_field_is_almost_perfect() {
        let protocol = Protocol { robots: 1, opponents: 0, obstacles: 0, held_out: 5, ..Protocol::default() };
        let parameters = Parameters { noise_gain: 0.0, ..Parameters::default() };
        let all = fitness(&protocol, &parameters, Set::HeldOut, 4).unwrap();
        assert!((all.mean - 1.0).abs() < 1e-12 && all.each.len() == 5, "rounding of some 60 steps: {all:?}");
        assert_eq!((all.arrived, all.collided), (1.0, 0.0));
    }

    #[test]
    fn hostile_input_is_a_typed_error() {
        let bad = Parameters { goal_gain: f64::NAN, ..Parameters::default() };
        assert_eq!(fitness(&Protocol::default(), &bad, Set::HeldOut, 1).unwrap_err().key, "goal_gain");
        let bad = Protocol { steps: 0, ..Protocol::default() };
        assert_eq!(fitness(&bad, &Parameters::default(), Set::HeldOut, 1).unwrap_err().key, "steps");
    }
}
