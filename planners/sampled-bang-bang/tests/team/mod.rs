//! A small closed loop: robots that plan one after the other and follow their trajectories exactly.

use env_model::motion::contact::meets;
use env_model::motion::{Limits, Mover, Path, Side, State, Trajectory, brake};
use env_model::scene::Field;
use env_model::{Point, Scene, Vector, World};
use planner_api::seed::splitmix64;
use planner_api::{Controller, Run, Situation};

pub const RADIUS: f64 = 0.09;
pub const PERIOD: f64 = 1.0 / 60.0;
pub const HORIZON: f64 = 2.0;
pub const MARGIN: f64 = 0.02;

/// What robots know of each other.
#[derive(Clone, Copy, PartialEq)]
pub enum Knowledge {
    /// The new trajectories of those before, the braking of those after.
    Team,
    /// Positions and velocities.
    Independent,
}

#[derive(Debug, Default, Clone)]
pub struct Outcome {
    pub arrived: bool,
    pub collisions: usize,
    pub seconds: f64,
    pub microseconds: Vec<f64>,
}

pub fn limits() -> Limits {
    Limits::new(3.0, 3.0).unwrap()
}

/// An empty division A field.
pub fn field() -> World {
    World::new(&Scene {
        name: "field".into(),
        unit: "m".into(),
        robot_radius: RADIUS,
        start: [-1.0, 0.0],
        goal: [1.0, 0.0],
        field: Some(Field { min: [-6.0, -4.5], max: [6.0, 4.5] }),
        obstacles: vec![],
    })
    .unwrap()
}

/// `n` robots on a circle of 2 to 3 m radius, jittered, each with the goal opposite.
pub fn circle(n: usize, seed: u64) -> Vec<(State, Point)> {
    let mut word = seed;
    let mut uniform = || (splitmix64(&mut word) >> 11) as f64 / (1u64 << 53) as f64;
    let radius = 2.0 + uniform();
    (0..n)
        .map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / n as f64;
            let p = Vector::new(libm::cos(angle), libm::sin(angle)) * radius;
            let jitter = Vector::new(uniform() - 0.5, uniform() - 0.5) * 0.2;
            (State::at_rest(Point::from(p + jitter)), Point::from(-p))
        })
        .collect()
}

/// Drives everybody until all stand at their goals, `most` seconds at the longest. `after` sees every answer.
pub fn drive(
    controllers: &mut [Box<dyn Controller>],
    starts: &[(State, Point)],
    knowledge: Knowledge,
    seed: u64,
    most: f64,
    mut after: impl FnMut(usize, &Situation<'_>, &Trajectory),
) -> Outcome {
    let (world, limits) = (field(), limits());
    let n = starts.len();
    let mut states: Vec<State> = starts.iter().map(|s| s.0).collect();
    let mut plans = vec![Trajectory::default(); n];
    let mut outcome = Outcome::default();
    let mut touching = vec![false; n * n];
    let mut frame = 0;
    while outcome.seconds < most {
        for (plan, state) in plans.iter_mut().zip(&states) {
            brake(*state, limits, plan);
        }
        for i in 0..n {
            let movers: Vec<Mover<'_>> = (0..n)
                .filter(|j| *j != i)
                .map(|j| {
                    let path = match knowledge {
                        Knowledge::Team => Path::Trajectory(&plans[j]),
                        Knowledge::Independent => Path::Velocity(states[j].velocity),
                    };
                    Mover::disc(states[j].position, 2.0 * RADIUS, path, Side::Mate).with_margin(MARGIN)
                })
                .collect();
            let situation = Situation::new(&world, &movers, states[i], starts[i].1, limits, HORIZON, PERIOD).unwrap();
            let mut answer = Trajectory::default();
            let mut run = Run::new(seed.wrapping_mul(1000).wrapping_add(frame * 16 + i as u64));
            let begin = std::time::Instant::now();
            controllers[i].control(&situation, &mut run, &mut answer).unwrap();
            outcome.microseconds.push(begin.elapsed().as_secs_f64() * 1e6);
            after(i, &situation, &answer);
            plans[i] = answer;
        }
        for i in 0..n {
            for j in 0..i {
                let other = Mover::disc(states[j].position, 2.0 * RADIUS, Path::Trajectory(&plans[j]), Side::Mate);
                let now = meets(&plans[i], &other, 0.0, PERIOD).is_some();
                outcome.collisions += usize::from(now && !touching[i * n + j]);
                touching[i * n + j] = now;
            }
        }
        for (state, plan) in states.iter_mut().zip(&plans) {
            *state = plan.state(PERIOD);
        }
        outcome.seconds += PERIOD;
        frame += 1;
        let there = |s: &State, goal: Point| (s.position - goal).norm() < 1e-3 && s.velocity.norm() < 1e-3;
        if states.iter().zip(starts).all(|(s, (_, goal))| there(s, *goal)) {
            outcome.arrived = true;
            break;
        }
    }
    outcome
}

/// The value below which a share of the sorted `values` lies.
#[allow(dead_code)]
pub fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * share) as usize]
}
