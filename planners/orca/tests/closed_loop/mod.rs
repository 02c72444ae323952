//! Robots that drive among each other, each following its own trajectory exactly for one frame at a time.

pub mod contract;

use std::f64::consts::TAU;

use env_model::motion::{Limits, Mover, Path, Side, State, Trajectory, contact};
use env_model::{Point, Scene, Vector, World};
use planner_api::seed::splitmix64;
use planner_api::{Controller, Run, Situation};

/// Radius of a robot of the Small Size League, in metres.
pub const RADIUS: f64 = 0.09;
/// Seconds a frame.
pub const FRAME: f64 = 1.0 / 60.0;
/// The prediction's horizon, in seconds.
pub const HORIZON: f64 = 3.0;

/// 3 m/s and 3 m/s².
pub fn limits() -> Limits {
    Limits::new(3.0, 3.0).unwrap()
}

/// An empty world without a field.
pub fn empty_world() -> World {
    World::new(&Scene {
        name: "empty".into(),
        unit: "m".into(),
        robot_radius: RADIUS,
        start: [0.0, 0.0],
        goal: [1.0, 0.0],
        field: None,
        obstacles: Vec::new(),
    })
    .unwrap()
}

/// A seeded stream of numbers in [0, 1).
pub struct Draw(pub u64);

impl Draw {
    /// The next one.
    pub fn next(&mut self) -> f64 {
        (splitmix64(&mut self.0) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// What became of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// Pairs that touched, counted once a pair.
    pub collisions: usize,
    /// Whether all robots came to stand within a centimetre of their goals.
    pub arrived: bool,
    /// Seconds until then, or until the end.
    pub time: f64,
    /// Sum of the final positions' coordinates, to compare runs bit for bit.
    pub digest: f64,
}

/// Mates that drive to `goals` among `opponents` of constant velocity, for `seconds` at most.
pub fn drive(
    make: &dyn Fn() -> Box<dyn Controller>,
    starts: &[Point],
    goals: &[Point],
    opponents: &[State],
    seconds: f64,
    seed: u64,
) -> Outcome {
    let (world, limits) = (empty_world(), limits());
    let mut controllers: Vec<_> = starts.iter().map(|_| make()).collect();
    let mut states: Vec<State> = starts.iter().map(|p| State::at_rest(*p)).collect();
    let mut trajectories = vec![Trajectory::default(); starts.len()];
    let mut others = opponents.to_vec();
    let mut touched = std::collections::BTreeSet::new();
    let mut outcome = Outcome::default();
    let disc = |s: &State, side| Mover::disc(s.position, 2.0 * RADIUS, Path::Velocity(s.velocity), side);
    for frame in 0..(seconds / FRAME) as u64 {
        for (i, trajectory) in trajectories.iter_mut().enumerate() {
            let mates = states.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, s)| disc(s, Side::Mate));
            let movers: Vec<_> = mates.chain(others.iter().map(|s| disc(s, Side::Opponent))).collect();
            let situation = Situation::new(&world, &movers, states[i], goals[i], limits, HORIZON, FRAME).unwrap();
            let mut run = Run::new(seed ^ (frame << 8) ^ i as u64);
            controllers[i].control(&situation, &mut run, trajectory).unwrap();
            let peaks = trajectory.peaks();
            assert!(peaks.acceleration <= limits.acceleration * (1.0 + 1e-9), "{peaks:?}");
            assert!(peaks.speed <= limits.speed * (1.0 + 1e-9), "{peaks:?}");
        }
        for (i, trajectory) in trajectories.iter().enumerate() {
            for (j, other) in trajectories.iter().enumerate().skip(i + 1) {
                let mover = Mover::disc(states[j].position, 2.0 * RADIUS, Path::Trajectory(other), Side::Mate);
                if contact::meets(trajectory, &mover, 0.0, FRAME).is_some() {
                    touched.insert((i, j));
                }
            }
            for (j, other) in others.iter().enumerate() {
                if contact::meets(trajectory, &disc(other, Side::Opponent), 0.0, FRAME).is_some() {
                    touched.insert((i, starts.len() + j));
                }
            }
        }
        for (state, trajectory) in states.iter_mut().zip(&trajectories) {
            *state = trajectory.state(FRAME);
        }
        others.iter_mut().for_each(|s| s.position += s.velocity * FRAME);
        outcome.time = FRAME * (frame + 1) as f64;
        outcome.arrived =
            states.iter().zip(goals).all(|(s, g)| (s.position - g).norm() < 0.01 && s.velocity.norm() < 0.05);
        if outcome.arrived {
            break;
        }
    }
    outcome.collisions = touched.len();
    outcome.digest = states.iter().map(|s| s.position.x + s.position.y).sum();
    outcome
}

/// `count` robots on a circle of `radius` metres that change places across it; starts and goals are shifted by up to
/// `jitter` metres in each coordinate.
pub fn circle_swap(
    make: &dyn Fn() -> Box<dyn Controller>,
    count: usize,
    radius: f64,
    jitter: f64,
    seed: u64,
) -> Outcome {
    let mut draw = Draw(seed);
    let mut on_circle = |k: usize| {
        let angle = TAU * k as f64 / count as f64;
        let shift = Vector::new(draw.next() - 0.5, draw.next() - 0.5) * (2.0 * jitter);
        Point::origin() + Vector::new(libm::cos(angle), libm::sin(angle)) * radius + shift
    };
    let starts: Vec<_> = (0..count).map(&mut on_circle).collect();
    let goals: Vec<_> = (0..count).map(|k| on_circle(k + count / 2)).collect();
    drive(make, &starts, &goals, &[], 20.0, seed)
}

/// One robot that drives 6 m through a line of `count` opponents, which cross its way at 1 to 2 m/s, half of them from
/// either side, and give no way.
pub fn crossing(make: &dyn Fn() -> Box<dyn Controller>, count: usize, seed: u64) -> Outcome {
    let mut draw = Draw(seed);
    let opponents: Vec<_> = (0..count)
        .map(|k| {
            let up = if k % 2 == 0 { 1.0 } else { -1.0 };
            let x = -2.0 + 4.0 * (k as f64 + draw.next()) / count as f64;
            let position = Point::new(x, -up * (0.5 + 3.0 * draw.next()));
            State { position, velocity: Vector::new(0.0, up * (1.0 + draw.next())) }
        })
        .collect();
    drive(make, &[Point::new(-3.0, 0.0)], &[Point::new(3.0, 0.0)], &opponents, 20.0, seed)
}

/// Shares of 0 collisions and of arrival over seeds 0 … `seeds`, and the mean time of those that arrived.
pub fn shares(seeds: u64, mut scene: impl FnMut(u64) -> Outcome) -> (f64, f64, f64) {
    let outcomes: Vec<_> = (0..seeds).map(&mut scene).collect();
    let share = |n: usize| n as f64 / outcomes.len() as f64;
    let arrived: Vec<_> = outcomes.iter().filter(|o| o.arrived).collect();
    let time = arrived.iter().map(|o| o.time).sum::<f64>() / arrived.len().max(1) as f64;
    (share(outcomes.iter().filter(|o| o.collisions == 0).count()), share(arrived.len()), time)
}
