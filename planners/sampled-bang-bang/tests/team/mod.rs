//! A small closed loop, robots that plan one after the other and follow their trajectories exactly, and what every
//! controller must keep.
#![allow(dead_code, reason = "each test binary uses a part")]

use env_model::motion::contact::meets;
use env_model::motion::{Limits, Mover, Path, Side, State, Trajectory, bang_bang, brake};
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
            let p = Vector::new(angle.cos(), angle.sin()) * radius;
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
pub fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * share) as usize]
}

/// A crowd of 21 round a robot in motion: ten mates with trajectories and eleven that drift.
pub struct Crowd {
    mates: Vec<(Point, Trajectory)>,
    others: Vec<State>,
    state: State,
    goal: Point,
}

impl Crowd {
    pub fn new(seed: u64) -> Self {
        let mut word = seed;
        let mut uniform = || (splitmix64(&mut word) >> 11) as f64 / (1u64 << 53) as f64;
        let mut point = || Point::new(8.0 * uniform() - 4.0, 6.0 * uniform() - 3.0);
        let mates = (0..10).map(|_| {
            let (from, to, mut way) = (point(), point(), Trajectory::default());
            bang_bang(State::at_rest(from), to, limits(), &mut way);
            way.advance(0.4);
            (way.start().position, way)
        });
        let mates = mates.collect();
        let others = (0..11).map(|_| State { position: point(), velocity: point().coords * 0.4 }).collect();
        let state = State { position: point(), velocity: point().coords * 0.5 };
        Self { mates, others, state, goal: point() }
    }

    /// Calls `ask` with what the robot faces.
    pub fn face<T>(&self, world: &World, ask: impl FnOnce(&Situation<'_>) -> T) -> T {
        let mates =
            self.mates.iter().map(|(at, way)| Mover::disc(*at, 2.0 * RADIUS, Path::Trajectory(way), Side::Mate));
        let others = self.others.iter();
        let others = others.map(|o| Mover::disc(o.position, 2.0 * RADIUS, Path::Velocity(o.velocity), Side::Opponent));
        let movers: Vec<Mover<'_>> = mates.chain(others).map(|m| m.with_margin(MARGIN)).collect();
        ask(&Situation::new(world, &movers, self.state, self.goal, limits(), HORIZON, PERIOD).unwrap())
    }
}

/// Limits, repeatability, and no allocation once the buffers have grown, among crowds.
pub fn check_contract(new: impl Fn() -> Box<dyn Controller>) {
    let world = field();
    let crowds: Vec<Crowd> = (0..40).map(Crowd::new).collect();
    let (mut one, mut two) = (new(), new());
    let [mut a, mut b] = [Trajectory::default(), Trajectory::default()];
    for crowd in &crowds {
        crowd.face(&world, |situation| {
            let answers = [(&mut one, &mut a), (&mut two, &mut b)]
                .map(|(controller, out)| controller.control(situation, &mut Run::new(7), out).unwrap());
            assert_eq!((answers[0], &a), (answers[1], &b));
            let (peaks, limits) = (a.peaks(), limits());
            let start = situation.state.velocity.norm();
            // The contract's tolerance.
            assert!(peaks.speed <= limits.speed.max(start) * (1.0 + 1e-9), "{peaks:?}");
            assert!(peaks.acceleration <= limits.acceleration * (1.0 + 1e-9), "{peaks:?}");
            assert!((a.start().position - situation.state.position).norm() == 0.0);
            assert!((a.start().velocity - situation.state.velocity).norm() < 1e-12);
        });
    }
    let again = |controller: &mut Box<dyn Controller>, out: &mut Trajectory| {
        let counts = crowds.iter().map(|crowd| {
            crowd.face(&world, |situation| {
                let call = || drop(controller.control(situation, &mut Run::new(7), out));
                allocation_counter::measure(call).count_total
            })
        });
        counts.sum::<u64>()
    };
    again(&mut one, &mut a);
    assert_eq!(again(&mut one, &mut a), 0, "allocations");
}

/// Input that no one would wish for: any answer, but finite, within the limits and without a panic.
pub fn check_hostile(new: impl Fn() -> Box<dyn Controller>) {
    let world = field();
    let at = |x: f64, y: f64, vx: f64, vy: f64| State { position: Point::new(x, y), velocity: Vector::new(vx, vy) };
    let disc = |x: f64, y: f64, v: f64| {
        Mover::disc(Point::new(x, y), 2.0 * RADIUS, Path::Velocity(Vector::new(v, 0.0)), Side::Opponent)
    };
    let huge = Mover::disc(Point::new(0.0, 0.0), 50.0, Path::Velocity(Vector::zeros()), Side::Other);
    let wall = Mover {
        shape: env_model::Inflated {
            core: env_model::Core::Segment(Point::new(0.0, -1.0), Point::new(0.0, 1.0)),
            radius: RADIUS,
        },
        path: Path::Velocity(Vector::new(0.5, 0.0)),
        margin: 1e3,
        side: Side::Other,
        braking: None,
    };
    let movers = [
        vec![],
        vec![disc(0.0, 0.0, 0.0)],
        vec![disc(0.1, 0.0, -3.0), disc(0.1, 0.0, -3.0)],
        vec![disc(1.0, 0.0, -1e6), disc(3.0, 0.0, 0.0)],
        vec![huge],
        vec![wall],
    ];
    let states = [at(0.0, 0.0, 0.0, 0.0), at(0.0, 0.0, 9.0, -9.0), at(5.91, 4.41, 1.0, 1.0), at(1e6, -1e6, 0.0, 1.0)];
    let goals = [Point::new(0.0, 0.0), Point::new(3.0, 0.0), Point::new(40.0, 0.0)];
    let limits = [(3.0, 3.0), (1e-3, 1e3), (1e3, 1e-3)].map(|(v, a)| Limits::new(v, a).unwrap());
    let mut controller = new();
    let mut out = Trajectory::default();
    for movers in &movers {
        for state in states {
            for goal in goals {
                for (limits, [horizon, period]) in limits.iter().zip([[2.0, PERIOD], [1e-9, 1.0], [60.0, 1e-9]]) {
                    let situation = Situation::new(&world, movers, state, goal, *limits, horizon, period).unwrap();
                    let _ = controller.control(&situation, &mut Run::new(3), &mut out).unwrap();
                    let (peaks, end) = (out.peaks(), out.end().position);
                    assert!(end.x.is_finite() && end.y.is_finite() && out.duration().is_finite());
                    assert!(peaks.speed <= limits.speed.max(state.velocity.norm()) * (1.0 + 1e-9), "{peaks:?}");
                    assert!(peaks.acceleration <= limits.acceleration * (1.0 + 1e-9), "{peaks:?} {limits:?}");
                }
            }
        }
    }
}

/// Prints the time of a call among crowds: of each crowd the least of several, so that only the work counts.
pub fn measure(new: impl Fn() -> Box<dyn Controller>) {
    let world = field();
    let mut out = Trajectory::default();
    let mut times: Vec<f64> = (0..500)
        .map(|seed| {
            Crowd::new(seed).face(&world, |situation| {
                let call = |_| {
                    let mut controller = new();
                    let _ = controller.control(situation, &mut Run::new(7), &mut out);
                    let begin = std::time::Instant::now();
                    let _ = controller.control(situation, &mut Run::new(7), &mut out);
                    begin.elapsed().as_secs_f64() * 1e6
                };
                (0..5).map(call).fold(f64::INFINITY, f64::min)
            })
        })
        .collect();
    let [p50, p90, p99, most] = [0.5, 0.9, 0.99, 1.0].map(|share| quantile(&mut times, share));
    println!("among 21: {p50:.1} µs p50, {p90:.1} p90, {p99:.1} p99, {most:.1} most");
}
