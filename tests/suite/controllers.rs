//! The contract of `planner_api::Controller`, kept by every name in the catalogue.

use env_model::motion::{Limits, Mover, Path, Side, State, Trajectory, bang_bang};
use env_model::scene::{Field, Shape};
use env_model::{Core, Inflated, Obstacle, Point, Polygon, Scene, Vector, World};
use planner_api::{Budget, ControlError, Controller, Outcome, Run, Situation};
use planner_catalogue::{build_controller_str, controller_names, controllers};

const RADIUS: f64 = 0.09;
const PERIOD: f64 = 1.0 / 60.0;
const HORIZON: f64 = 2.0;
/// The contract's tolerance, relative.
const TOLERANCE: f64 = 1e-9;

/// Enough for most answers, and an end to what would search for seconds.
const BUDGET: Budget = Budget { iterations: Some(2000), evaluations: Some(2000), deadline: None };

fn build(name: &str) -> Box<dyn Controller> {
    build_controller_str(name, "").unwrap_or_else(|e| panic!("{name}: {e}")).controller
}

fn limits() -> Limits {
    Limits::new(3.0, 3.0).unwrap()
}

fn at(x: f64, y: f64, vx: f64, vy: f64) -> State {
    State { position: Point::new(x, y), velocity: Vector::new(vx, vy) }
}

/// A field of division B with `obstacles`.
fn field(obstacles: Vec<Obstacle>) -> World {
    World::new(&Scene {
        name: "field".into(),
        unit: "m".into(),
        robot_radius: RADIUS,
        start: [-4.0, 0.0],
        goal: [4.0, 0.0],
        field: Some(Field { min: [-4.5, -3.0], max: [4.5, 3.0] }),
        obstacles,
    })
    .unwrap()
}

/// Discs, a capsule and polygons, one of them not convex.
fn cluttered() -> World {
    let disc = |x: f64, y: f64| Obstacle::disc(Point::new(x, y), 0.3);
    let capsule = Shape::Capsule { from: [-1.0, -2.0], to: [-1.0, -0.6], radius: 0.1 };
    let corner = Shape::Polygon(vec![[1.0, -1.5], [2.0, -1.5], [2.0, 0.2], [1.8, 0.2], [1.8, -1.3], [1.0, -1.3]]);
    let triangle = Shape::Polygon(vec![[-0.5, 1.0], [0.5, 1.2], [0.0, 2.0]]);
    field(vec![disc(0.0, 0.1), disc(-2.0, 1.5), disc(2.5, 1.5), capsule.into(), corner.into(), triangle.into()])
}

fn robot(state: State, side: Side) -> Mover<'static> {
    Mover::disc(state.position, 2.0 * RADIUS, Path::Velocity(state.velocity), side).with_margin(0.03)
}

/// What a controller faces, and what to call it.
struct Case<'a> {
    name: &'static str,
    situation: Situation<'a>,
}

/// Calls `check` with situations such as games have.
fn with_games(check: impl FnOnce(&[Case<'_>])) {
    let (open, clutter) = (field(vec![]), cluttered());
    let drift = [
        robot(at(-1.0, 0.4, 1.0, -0.5), Side::Opponent),
        robot(at(0.5, -0.5, -0.5, 1.0), Side::Opponent),
        robot(at(-3.0, 0.25, 0.0, 0.0), Side::Mate),
        robot(at(1.5, 0.0, -2.0, 0.0), Side::Mate),
        robot(at(2.8, 0.3, 0.0, -1.0), Side::Other),
    ];
    let ways = [(-1.0, 2.0, 1.0, -2.0), (1.5, 0.5, -3.0, 0.5), (3.0, 0.3, 3.0, 0.2)].map(|(x, y, to_x, to_y)| {
        let mut way = Trajectory::default();
        bang_bang(State::at_rest(Point::new(x, y)), Point::new(to_x, to_y), limits(), &mut way);
        way.advance(0.3);
        way
    });
    let known = ways.each_ref().map(|way| Mover { path: Path::Trajectory(way), ..robot(way.start(), Side::Mate) });
    let shape = |core: Core| Mover {
        shape: Inflated { core, radius: 0.2 },
        path: Path::Velocity(Vector::new(-0.3, 0.1)),
        margin: 0.05,
        side: Side::Other,
        braking: None,
    };
    let triangle = [[0.0, -0.6], [0.6, 0.0], [0.0, 0.6]].map(Point::from).to_vec();
    let shapes = [
        shape(Core::Segment(Point::new(-2.0, -0.5), Point::new(-2.0, 0.5))),
        shape(Core::Polygon(Polygon::new(triangle).unwrap())),
    ];
    let mut cases = Vec::new();
    let mut add = |name, world, movers, state, goal: [f64; 2]| {
        let situation = Situation::new(world, movers, state, goal.into(), limits(), HORIZON, PERIOD).unwrap();
        cases.push(Case { name, situation });
    };
    add("free", &open, &[], at(-3.5, 0.0, 0.0, 0.0), [3.5, 0.5]);
    add("free, at full speed away", &open, &[], at(0.0, 0.0, -3.0, 0.0), [3.5, 0.5]);
    add("cluttered", &clutter, &[], at(-3.5, 0.0, 0.0, 0.0), [3.5, 0.0]);
    add("cluttered, at full speed", &clutter, &[], at(-3.0, 0.0, 1.8, 2.4), [3.5, -0.5]);
    add("among movers", &open, &drift, at(-3.5, 0.0, 0.5, 0.1), [3.5, 0.0]);
    add("cluttered, among movers", &clutter, &drift, at(-3.5, 0.0, 2.0, 0.0), [3.5, 0.0]);
    add("movers with trajectories", &open, &known, at(-3.5, 0.5, 1.0, 0.0), [3.0, 0.5]);
    add("movers of every shape", &open, &shapes, at(-3.5, 0.0, 0.0, 0.0), [3.5, 0.0]);
    add("near the border", &open, &drift, at(-1.0, 2.9, 1.0, 0.0), [3.0, 2.9]);
    add("in a corner", &open, &drift, at(4.41, 2.91, 0.0, 0.0), [-4.41, -2.91]);
    add("towards a corner", &clutter, &[], at(4.0, 2.5, 1.0, 1.0), [4.41, 2.91]);
    add("at the goal", &open, &drift, at(0.5, 1.0, 0.0, 0.0), [0.5, 1.0]);
    add("through the goal", &open, &[], at(0.5, 1.0, 1.0, 1.0), [0.5, 1.0]);
    add("too fast", &open, &drift, at(-3.5, -0.5, 4.0, 1.0), [3.5, 0.0]);
    check(&cases);
}

/// What a controller answers; nothing to compare where it found nothing.
fn ask(controller: &mut dyn Controller, case: &Case<'_>, seed: u64) -> (Outcome, Option<Trajectory>) {
    let mut trajectory = Trajectory::default();
    let outcome = controller.control(&case.situation, &mut Run::new(seed).with_budget(BUDGET), &mut trajectory);
    let outcome = outcome.unwrap_or_else(|error| panic!("{}: {error}", case.name));
    (outcome, (outcome != Outcome::NotFound).then_some(trajectory))
}

/// It begins in the state, is finite, keeps the limits, and its pieces lead where it says that it ends.
fn check_motion(name: &str, situation: &Situation<'_>, trajectory: &Trajectory) {
    let Situation { state, limits, period, .. } = *situation;
    assert_eq!(trajectory.start(), state, "{name}");
    let end = trajectory.end();
    assert!(end.finite().is_ok() && trajectory.duration().is_finite(), "{name}: {trajectory:?}");
    let (peaks, speed) = (trajectory.peaks(), state.velocity.norm());
    assert!(peaks.speed <= limits.speed.max(speed) * (1.0 + TOLERANCE), "{name}: {peaks:?}");
    assert!(peaks.acceleration <= limits.acceleration * (1.0 + TOLERANCE), "{name}: {peaks:?}");
    let excess = speed - limits.speed;
    if excess > 0.0 {
        // As hard as it can, until it is no longer too fast.
        let most = limits.speed + (excess - limits.acceleration * period).max(0.0);
        let then = trajectory.state(period).velocity.norm();
        assert!(then <= most + speed * TOLERANCE, "{name}: {then} m/s after a period, {most} expected");
    }
}

#[test]
fn answers_begin_in_the_state_keep_the_limits_and_end_where_they_say() {
    with_games(|cases| {
        for kind in controller_names() {
            let mut controller = build(kind);
            let mut found = 0;
            for (seed, case) in cases.iter().enumerate() {
                let name = format!("{kind}, {}", case.name);
                let (outcome, trajectory) = ask(controller.as_mut(), case, seed as u64);
                let Some(trajectory) = trajectory else { continue };
                found += 1;
                check_motion(&name, &case.situation, &trajectory);
                if let Some(last) = trajectory.pieces().last() {
                    let (reached, end) = (last.state(last.duration), trajectory.end());
                    let gap = (reached.position - end.position).norm().max((reached.velocity - end.velocity).norm());
                    // Sums of a few hundred pieces; a micrometre is beyond any robot.
                    assert!(gap < 1e-6, "{name}: says that it ends {gap} from where it leads");
                }
                if outcome == Outcome::Arrives {
                    assert_eq!(trajectory.end().velocity, Vector::zeros(), "{name}");
                    let left = (trajectory.end().position - case.situation.goal).norm();
                    // On the goal but for the rounding of sums.
                    assert!(left <= TOLERANCE, "{name}: ends {left} from the goal");
                }
            }
            assert!(found >= 2, "{kind} answers but {found} situations");
        }
    });
}

#[test]
fn the_same_seed_gives_the_same_bits_again_after_reset_and_in_a_new_controller() {
    with_games(|cases| {
        for kind in controller_names() {
            let all = |controller: &mut dyn Controller| -> Vec<_> {
                cases.iter().enumerate().map(|(seed, case)| ask(controller, case, seed as u64)).collect()
            };
            let mut controller = build(kind);
            let first = all(controller.as_mut());
            controller.reset();
            let again = all(controller.as_mut());
            let new = all(build(kind).as_mut());
            for (i, case) in cases.iter().enumerate() {
                assert_eq!(first[i], again[i], "{kind}, {}: after reset", case.name);
                assert_eq!(first[i], new[i], "{kind}, {}: a new one", case.name);
            }
        }
    });
}

#[test]
fn controllers_of_their_own_allocate_nothing_in_steady_state() {
    with_games(|cases| {
        for kind in controllers() {
            let mut controller = build(kind.name);
            let mut trajectory = Trajectory::default();
            let mut round = || {
                controller.reset();
                // Looking ahead copies what moves, and of polygons their corners.
                let robots = |case: &&Case<'_>| case.situation.movers.iter().all(|m| m.shape.as_disc().is_some());
                for (seed, case) in cases.iter().filter(robots).enumerate() {
                    let mut run = Run::new(seed as u64).with_budget(BUDGET);
                    let _ = controller.control(&case.situation, &mut run, &mut trajectory).unwrap();
                }
            };
            round();
            assert_eq!(allocation_counter::measure(round).count_total, 0, "{}", kind.name);
        }
    });
}

#[test]
fn what_nobody_should_meet_is_answered_within_the_limits() {
    let world = field(vec![]);
    let still = |x: f64, y: f64| robot(at(x, y, 0.0, 0.0), Side::Mate);
    let huge = Mover { shape: Inflated { core: Core::Point(Point::origin()), radius: 50.0 }, ..still(0.0, 0.0) };
    let wide = Mover { margin: 1e3, ..still(1.0, 0.0) };
    let crowds = [
        vec![still(-1.0, -1.0), still(-1.0, -1.0)],
        vec![robot(at(-0.9, -1.0, -1e6, 0.0), Side::Opponent), robot(at(1e9, -1e9, 0.0, 1e-300), Side::Other)],
        vec![huge],
        vec![wide],
    ];
    let states = [at(-1.0, -1.0, 0.0, 0.0), at(-1.0, -1.0, -30.0, 40.0), at(1e6, -1e6, 0.0, 1e-300)];
    let goals = [[-1.0, -1.0], [-1.0 + 1e-12, -1.0], [2.0, 1.0], [99.0, 0.0]];
    let abilities = [(3.0, 3.0, HORIZON, PERIOD), (1e-3, 1e3, 1e-9, 1.0), (1e3, 1e-3, 60.0, PERIOD)];
    let mut trajectory = Trajectory::default();
    for kind in controller_names() {
        let mut controller = build(kind);
        for movers in &crowds {
            for (state, goal) in states.iter().flat_map(|state| goals.map(|goal| (*state, goal))) {
                for (speed, acceleration, horizon, period) in abilities {
                    let limits = Limits::new(speed, acceleration).unwrap();
                    let situation =
                        Situation::new(&world, movers, state, goal.into(), limits, horizon, period).unwrap();
                    let mut run = Run::new(1).with_budget(BUDGET);
                    // Start or goal in something is an error of a type; all else is a motion or none.
                    match controller.control(&situation, &mut run, &mut trajectory) {
                        Ok(Outcome::NotFound) | Err(ControlError::Plan(_)) => {}
                        Ok(_) => {
                            check_motion(
                                &format!("{kind}, {state:?} to {goal:?}, {limits:?}"),
                                &situation,
                                &trajectory,
                            );
                        }
                        Err(error) => panic!("{kind}, {state:?} to {goal:?}, {limits:?}: {error}"),
                    }
                }
            }
        }
    }
}

#[test]
fn hostile_numbers_are_typed_errors() {
    let world = field(vec![]);
    let (good, goal, none) = (at(0.0, 0.0, 0.0, 0.0), Point::new(1.0, 0.0), []);
    let motion =
        |state, goal, horizon, period| match Situation::new(&world, &none, state, goal, limits(), horizon, period) {
            Err(ControlError::Motion(error)) => error.to_string(),
            other => panic!("{other:?}"),
        };
    for (message, what) in [
        (motion(at(f64::NAN, 0.0, 0.0, 0.0), goal, 1.0, 1.0), "position"),
        (motion(at(0.0, f64::INFINITY, 0.0, 0.0), goal, 1.0, 1.0), "position"),
        (motion(at(0.0, 0.0, 0.0, f64::NAN), goal, 1.0, 1.0), "velocity"),
        (motion(good, Point::new(f64::NAN, 0.0), 1.0, 1.0), "goal"),
        (motion(good, goal, 0.0, 1.0), "prediction horizon"),
        (motion(good, goal, -1.0, 1.0), "prediction horizon"),
        (motion(good, goal, f64::NAN, 1.0), "prediction horizon"),
        (motion(good, goal, 1.0, 0.0), "period"),
        (motion(good, goal, 1.0, f64::INFINITY), "period"),
    ] {
        assert!(message.starts_with(what), "{what}: {message}");
    }
    for (speed, acceleration) in [(0.0, 1.0), (-1.0, 1.0), (f64::NAN, 1.0), (1.0, -1.0), (1.0, f64::INFINITY)] {
        assert!(Limits::new(speed, acceleration).is_err(), "{speed} {acceleration}");
    }
    let fine = robot(at(1.0, 1.0, 0.0, 0.0), Side::Mate);
    for (what, bad) in [
        ("velocity", robot(at(1.0, 1.0, f64::NAN, 0.0), Side::Mate)),
        ("shape", robot(at(f64::NAN, 1.0, 0.0, 0.0), Side::Mate)),
        ("radius", Mover::disc(Point::origin(), -1.0, Path::Velocity(Vector::zeros()), Side::Other)),
        ("margin", fine.clone().with_margin(f64::NAN)),
    ] {
        let movers = [fine.clone(), bad];
        match Situation::new(&world, &movers, good, goal, limits(), 1.0, 1.0) {
            Err(ControlError::Mover { index: 1, error }) => assert!(error.to_string().starts_with(what), "{error}"),
            other => panic!("{what}: {other:?}"),
        }
    }
}
