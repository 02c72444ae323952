//! Every play begins legally, repeats, and runs.

use env_model::Point;
use env_model::motion::{Limits, Mover, Path, Side, Trajectory, bang_bang, contact};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use strategy::league::ROBOT_RADIUS;
use strategy::plays::{Setup, play};
use strategy::roles::Role;
use strategy::rules::{Ball, Command, Rules};
use strategy::{CallBudget, Dealing, Formation, League, PlayKind, Record, Settings, Simulation, Task, View, simulate};

const PLAYS: [PlayKind; 6] = [
    PlayKind::CircleSwap,
    PlayKind::Crossing,
    PlayKind::Positions,
    PlayKind::Attack,
    PlayKind::Formation,
    PlayKind::BallPlacement,
];

fn settings(play: PlayKind, robots: usize, opponents: usize) -> Settings {
    Settings { play, robots, opponents, ..Settings::default() }
}

/// How it begins, where it ends, and the roles.
fn begin(settings: &Settings, seed: u64) -> (Setup, Vec<Point>, Vec<Role>) {
    let mut play = play(settings.play);
    let setup = play.setup(settings, &mut ChaCha8Rng::seed_from_u64(seed)).unwrap();
    let mut tasks = vec![Task::new(Point::origin(), Limits::new(3.0, 3.0).unwrap()); settings.robots];
    let view = View { time: 0.0, own: &setup.own, opponents: &setup.opponents, ball: setup.ball };
    play.direct(&view, &mut tasks);
    let roles = tasks.iter().map(|task| task.role).collect();
    (setup, play.goals().to_vec(), roles)
}

fn nearest(points: &[Point]) -> f64 {
    let pairs = points.iter().enumerate().flat_map(|(i, p)| points[..i].iter().map(move |q| (p - q).norm()));
    pairs.fold(f64::INFINITY, f64::min)
}

/// Everything that holds of every beginning.
fn check(settings: &Settings, seed: u64) {
    let (setup, goals, roles) = begin(settings, seed);
    let what = format!("{:?} {} {} {seed}", settings.play, settings.robots, settings.opponents);
    let command = settings.command();
    let ball = setup.ball.map(|ball| Ball { at: ball.position, target: setup.placement });
    let rules = Rules::new(settings.league, command, ball).unwrap();
    let all: Vec<Point> = setup.own.iter().chain(&setup.opponents).map(|state| state.position).collect();
    assert_eq!((setup.own.len(), setup.opponents.len()), (settings.robots, settings.opponents), "{what}");
    assert_eq!((goals.len(), roles.len()), (settings.robots, settings.robots), "{what}");
    assert!(nearest(&all) > 2.0 * ROBOT_RADIUS, "{what}: starts are {} apart", nearest(&all));
    assert!(nearest(&goals) > 2.0 * ROBOT_RADIUS, "{what}: goals are {} apart", nearest(&goals));
    let half = settings.league.half_size();
    for p in all.iter().chain(&goals) {
        let inside = (0..2).all(|axis| p[axis].abs() <= half[axis] - ROBOT_RADIUS);
        assert!(inside, "{what}: {p} is not inside of the lines");
    }
    for (goal, role) in goals.iter().zip(&roles) {
        assert_eq!(rules.legal(*role, *goal), *goal, "{what}: the goal {goal} of {role:?} is not legal");
    }
    for (state, role) in setup.own.iter().zip(&roles) {
        // Who has to leave the ball's way begins in it.
        let legal = settings.play == PlayKind::BallPlacement || rules.allows(*role, *state);
        assert!(legal, "{what}: {role:?} begins at {}", state.position);
    }
}

#[test]
fn all_numbers_of_robots_begin_legally() {
    for play in PLAYS {
        for robots in 1..=16 {
            for opponents in 0..=16 {
                check(&settings(play, robots, opponents), (robots * 17 + opponents) as u64);
            }
        }
    }
}

#[test]
fn many_seeds_begin_legally() {
    for play in PLAYS {
        for seed in 0..100 {
            check(&settings(play, 8, 6), seed);
            check(&Settings { jitter: 1.0, ..settings(play, 11, 11) }, seed);
            let stop = Settings { command: Some(Command::Stop), ..settings(play, 6, 6) };
            if !matches!(play, PlayKind::Formation | PlayKind::BallPlacement) {
                check(&stop, seed);
            }
            check(&Settings { league: League::DivisionB, ..settings(play, 6, 6) }, seed);
        }
    }
}

#[test]
fn formations_begin_legally() {
    for formation in [Formation::Line, Formation::Column, Formation::Diamond, Formation::Wedge] {
        for robots in 1..=16 {
            check(&Settings { formation, ..settings(PlayKind::Formation, robots, 8) }, 1);
        }
    }
    let wide = Settings { spacing: 1.0, ..settings(PlayKind::Formation, 16, 0) };
    let error = play(wide.play).setup(&wide, &mut ChaCha8Rng::seed_from_u64(1)).unwrap_err();
    assert_eq!((error.key, error.value.as_str()), ("spacing", "1"));
}

#[test]
fn beginnings_repeat() {
    for play in PLAYS {
        let settings = settings(play, 8, 8);
        assert_eq!(begin(&settings, 5), begin(&settings, 5));
        assert_ne!(begin(&settings, 5).0, begin(&settings, 6).0);
    }
}

#[test]
fn crossings_meet_but_not_at_once() {
    let limits = Limits::new(3.0, 3.0).unwrap();
    let (mut aimed, mut meetings) = (0, 0);
    for seed in 0..50 {
        let (setup, goals, _) = begin(&settings(PlayKind::Crossing, 4, 6), seed);
        let ways: Vec<Trajectory> = setup
            .own
            .iter()
            .zip(&goals)
            .map(|(start, goal)| {
                let mut way = Trajectory::default();
                bang_bang(*start, *goal, limits, &mut way);
                way
            })
            .collect();
        for opponent in &setup.opponents {
            let path = Path::Velocity(opponent.velocity);
            let mover = Mover::disc(opponent.position, 2.0 * ROBOT_RADIUS, path, Side::Opponent);
            let first = |way: &Trajectory| contact::meets(way, &mover, 0.0, way.duration());
            let times: Vec<f64> = ways.iter().filter_map(first).collect();
            aimed += 1;
            meetings += usize::from(!times.is_empty());
            // Whatever robots do in the first half second, and however long they stand.
            for start in &setup.own {
                let still = contact::least_clearance(&Trajectory::new(*start), &mover, 0.5).1;
                assert!(still > 0.375, "seed {seed}: {still} m");
            }
            assert!(times.iter().all(|t| *t > 0.5), "seed {seed}: {times:?}");
        }
    }
    assert_eq!(meetings, aimed, "each crosses a robot's straight way");
}

fn run(settings: &Settings, planner: &str, seed: u64) -> Record {
    simulate(settings, (planner, ""), CallBudget::default(), seed, &|| 0.0).unwrap()
}

#[test]
fn every_play_runs() {
    for play in PLAYS {
        for planner in ["tangent", "straight-line"] {
            let settings = Settings { duration_s: 3.0, ..settings(play, 5, 5) };
            let record = run(&settings, planner, 1);
            assert_eq!(record.robots.len(), 5, "{play:?} {planner}");
            assert!(record.metrics.calls > 0);
            let travelled: f64 = record.robots.iter().map(|robot| robot.travelled).sum();
            assert!(travelled > 0.5, "{play:?} {planner}: nobody moves");
        }
    }
}

#[test]
fn all_arrive_where_nobody_is_in_the_way() {
    for play in PLAYS {
        let record = run(&settings(play, 1, 0), "tangent", 3);
        assert_eq!(record.metrics.arrived, 1, "{play:?}: {:?}", record.metrics);
        assert!(record.metrics.is_clean(), "{play:?}: {:?}", record.metrics);
    }
}

#[test]
fn waves_follow_each_other() {
    let settings = Settings { waves: 3, duration_s: 60.0, ..settings(PlayKind::Positions, 2, 0) };
    let record = run(&settings, "tangent", 1);
    assert_eq!((record.robots.len(), record.metrics.robots, record.metrics.arrived), (6, 6, 6));
    for robot in 0..2 {
        for wave in 1..3 {
            let [before, now] = [wave - 1, wave].map(|w| &record.robots[2 * w + robot]);
            let gap = (Point::from(before.goal) - Point::from(now.start)).norm();
            assert!(gap <= 0.03, "it begins where it arrived");
            assert!(now.goal != before.goal);
            assert!(now.arrival_s.unwrap() >= now.least_s * (1.0 - 1e-12), "{now:?}");
        }
    }
    let longest = |wave: &[strategy::RobotRecord]| wave.iter().filter_map(|r| r.arrival_s).fold(0.0, f64::max);
    let sum: f64 = record.robots.chunks(2).map(longest).sum();
    // A wave ends with the frame in which the last one is at its goal; its arrival counts the last centimetres, 3 of
    // them at 3 m/s² and 10 cm/s in the wrong direction take a quarter of a second.
    let over = sum - record.metrics.duration_s;
    assert!((-3.0 / 60.0..0.75).contains(&over), "{sum} {}", record.metrics.duration_s);

    let hurried = Settings { wave_s: 1.0, duration_s: 3.5, waves: 100, ..settings };
    let record = run(&hurried, "tangent", 1);
    assert_eq!(record.robots.len(), 6, "three waves had their time, the fourth was cut short");
    let attack = Settings { waves: 2, play: PlayKind::Attack, ..Settings::default() };
    assert_eq!(attack.validate().unwrap_err().key, "waves");
}

#[test]
fn dealt_positions_are_nearer() {
    let sum = |dealing| {
        let (setup, goals, _) = begin(&Settings { dealing, ..settings(PlayKind::Positions, 11, 0) }, 2);
        setup.own.iter().zip(goals).map(|(state, goal)| (state.position - goal).norm_squared()).sum::<f64>()
    };
    assert!(sum(Dealing::Optimal) < 0.6 * sum(Dealing::Drawn));
}

#[test]
fn a_formation_is_held() {
    for formation in [Formation::Line, Formation::Column, Formation::Diamond, Formation::Wedge] {
        let quiet = Settings { formation, jitter: 0.0, spacing: 0.6, ..settings(PlayKind::Formation, 5, 0) };
        let metrics = run(&quiet, "tangent", 1).metrics;
        assert!(metrics.is_clean(), "{formation:?}: {metrics:?}");
        // Three frames at 0.75 m/s: who follows is never further behind.
        let error = metrics.formation_error.unwrap();
        assert!(error < 0.04, "{formation:?}: {error}");
    }
    assert_eq!(run(&settings(PlayKind::Positions, 1, 0), "tangent", 1).metrics.formation_error, None);
}

#[test]
fn the_ball_is_placed() {
    let settings = settings(PlayKind::BallPlacement, 4, 0);
    let record = run(&settings, "tangent", 4);
    let (setup, _, roles) = begin(&settings, 4);
    assert_eq!(roles[0], Role::Taker);
    let ball = Point::from(*record.trace.frames.last().unwrap().last().unwrap());
    // As far as the taker is from its goal when it has arrived.
    assert!((ball - setup.placement.unwrap()).norm() <= 0.02, "{:?}", record.metrics);
    assert_eq!(record.metrics.arrived, 4, "{:?}", record.metrics);
    assert!(record.metrics.violation_s > 0.0, "two began in its way");
    assert_eq!(record.metrics.violations, 0, "nobody entered it: {:?}", record.metrics);
    assert_eq!(record.trace.bodies.last().unwrap().side, "ball");
}

#[test]
fn opponents_block_the_lines_to_goal() {
    let settings = Settings { duration_s: 6.0, ..settings(PlayKind::Attack, 3, 3) };
    let mut simulation = Simulation::new(&settings, ("tangent", ""), CallBudget::default(), 1).unwrap();
    // Until all attackers stand, and long enough for blockers to catch up.
    for _ in 0..360 {
        simulation.step(&|| 0.0).unwrap();
    }
    let places: Vec<Point> = simulation.bodies().iter().map(|body| body.state.position).collect();
    let goal = Point::new(6.0, 0.0);
    let off = |blocker: &Point| {
        let line = |attacker: &Point| env_model::geometry::point_segment_distance(*blocker, *attacker, goal);
        places[..3].iter().map(line).fold(f64::INFINITY, f64::min)
    };
    for blocker in &places[3..] {
        assert!(off(blocker) < ROBOT_RADIUS, "{blocker} blocks no line: {}", off(blocker));
    }
}
