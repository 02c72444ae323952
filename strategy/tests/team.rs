//! Teams whose input is unusable, or changes: every robot has an answer that it can follow.

use env_model::motion::{Limits, State};
use env_model::{Point, Vector};
use planner_api::Budget;
use planner_control::{Answer, Guard, Safety};
use strategy::rules::{Command, Rules};
use strategy::{Cooperation, League, Origin, Task, Team, TeamError, TeamSettings, View};

const PERIOD: f64 = 1.0 / 60.0;
const SETTINGS: TeamSettings = TeamSettings {
    period: PERIOD,
    horizon: 2.0,
    margin: 0.03,
    cooperation: Cooperation::Priority,
    hysteresis: 0.0,
    emergency_brake: true,
};
const NAN: f64 = f64::NAN;

fn state(x: f64, y: f64, vx: f64, vy: f64) -> State {
    State { position: Point::new(x, y), velocity: Vector::new(vx, vy) }
}

fn limits() -> Limits {
    Limits::new(3.0, 3.0).unwrap()
}

fn task(x: f64, y: f64) -> Task {
    Task::new(Point::new(x, y), limits())
}

fn rules() -> Rules {
    Rules::new(League::DivisionA, Command::Running, None).unwrap()
}

fn team(settings: TeamSettings, robots: usize) -> Team {
    let guard = || Guard::new(planner_catalogue::build_controller_str("tangent", "").unwrap().controller);
    Team::new(settings, (0..robots).map(|_| guard()).collect()).unwrap()
}

/// One frame.
fn plan<'t>(team: &'t mut Team, own: &[State], opponents: &[State], tasks: &[Task]) -> &'t [Answer] {
    let view = View { time: 0.0, own, opponents, ball: None };
    team.plan(&view, tasks, rules().worlds(), 1, &Budget::default, &|| 0.0)
}

fn follow(own: &mut [State], team: &Team) {
    for (state, answer) in own.iter_mut().zip(team.answers()) {
        *state = answer.trajectory.state(PERIOD);
    }
}

/// Straight on to a stop in |v|/a seconds.
fn assert_brakes(answer: &Answer, from: State, acceleration: f64) {
    assert_eq!((answer.safety, answer.trajectory.start()), (Safety::Brake, from));
    let speed = from.velocity.norm();
    assert!((answer.trajectory.duration() - speed / acceleration).abs() < 1e-12);
    let way = from.velocity * (0.5 * speed / acceleration);
    // Rounding of a few additions of numbers below 10.
    assert!((answer.trajectory.end().position - (from.position + way)).norm() < 1e-12);
    assert_eq!(answer.goal, answer.trajectory.end().position);
}

#[test]
fn settings_out_of_range_are_named() {
    let wrong = [
        (TeamSettings { period: 0.0, ..SETTINGS }, "period = 0; expected a finite number above 0 s"),
        (TeamSettings { period: f64::INFINITY, ..SETTINGS }, "period = inf; expected a finite number above 0 s"),
        (TeamSettings { horizon: 0.0, ..SETTINGS }, "horizon = 0; expected a finite number above 0 s"),
        (TeamSettings { horizon: NAN, ..SETTINGS }, "horizon = NaN; expected a finite number above 0 s"),
        (TeamSettings { margin: -0.1, ..SETTINGS }, "margin = -0.1; expected a finite number, at least 0 m"),
        (TeamSettings { margin: NAN, ..SETTINGS }, "margin = NaN; expected a finite number, at least 0 m"),
        (TeamSettings { hysteresis: 1.1, ..SETTINGS }, "hysteresis = 1.1; expected 0 to 1"),
        (TeamSettings { hysteresis: NAN, ..SETTINGS }, "hysteresis = NaN; expected 0 to 1"),
    ];
    for (settings, message) in wrong {
        assert_eq!(Team::new(settings, Vec::new()).err().map(|e| e.to_string()).as_deref(), Some(message));
    }
}

#[test]
fn a_robot_whose_task_is_unusable_brakes_where_it_is() {
    let from = state(2.0, 1.0, 2.0, 0.0);
    let mut slow = task(-2.0, 1.0);
    slow.limits.acceleration = -1.0;
    let mut fast = task(-2.0, 1.0);
    fast.limits.speed = NAN;
    // Those without limits brake at 1 m/s² before they were told any.
    let wrong = [
        (task(NAN, 1.0), 3.0, "goal (NaN, 1) is not finite"),
        (slow, 1.0, "acceleration limit = -1; expected a finite number above 0"),
        (fast, 1.0, "speed limit = NaN; expected a finite number above 0"),
        (Task { world: 9, ..task(-2.0, 1.0) }, 3.0, "world 9; expected one of 5, counted from 0"),
    ];
    for (wrong, acceleration, message) in wrong {
        let mut team = team(SETTINGS, 1);
        assert_brakes(&plan(&mut team, &[from], &[], &[wrong])[0], from, acceleration);
        assert_eq!(team.errors.iter().map(|(i, e)| (*i, e.to_string())).collect::<Vec<_>>(), [(0, message.into())]);
        assert_eq!((&team.origins[..], team.call_times.len()), (&[Origin::Error][..], 0));
        // Once it was told what it can do, that counts.
        let before = plan(&mut team, &[from], &[], &[task(4.0, 1.0)])[0].safety;
        assert_eq!((before, &team.origins[..], team.call_times.len()), (Safety::Ok, &[Origin::Controller][..], 1));
        assert_brakes(&plan(&mut team, &[from], &[], &[wrong])[0], from, 3.0);
    }
}

#[test]
fn a_contact_of_braking_is_told_though_the_task_is_unusable() {
    // A robot that stands 0.3 m ahead is met 0.12 m on: 2t − 1.5t² = 0.12.
    let own = [state(2.0, 1.0, 2.0, 0.0), state(2.3, 1.0, 0.0, 0.0)];
    let mut team = team(SETTINGS, 2);
    let contact = plan(&mut team, &own, &[], &[task(NAN, 1.0), task(2.3, 1.0)])[0].contact.unwrap();
    assert!((contact.time - (2.0 - (4.0 - 6.0 * 0.12f64).sqrt()) / 3.0).abs() < 1e-9, "{contact:?}");
}

#[test]
fn a_mate_without_usable_limits_is_still_in_the_way() {
    let own = [state(2.0, 1.0, 2.0, 0.0), state(2.3, 1.0, 0.0, 0.0)];
    let mut tasks = [task(4.0, 1.0), task(2.3, 1.0)];
    tasks[1].limits.acceleration = NAN;
    let mut team = team(SETTINGS, 2);
    assert!(plan(&mut team, &own, &[], &tasks)[0].contact.is_some(), "0.12 m are too few to stop or to turn");
    assert_eq!(team.errors.len(), 1);
}

#[test]
fn lists_of_another_length_are_errors_of_single_robots() {
    let own = [state(2.0, 1.0, 2.0, 0.0), state(0.0, 1.0, 0.0, 1.0)];
    let tasks = [task(-2.0, 1.0), task(0.0, 2.0)];
    let mut fewer = team(SETTINGS, 2);
    assert_brakes(&plan(&mut fewer, &own, &[], &tasks[..1])[1], own[1], 1.0);
    assert_eq!(fewer.errors, [(1, TeamError::NoTask { tasks: 1, robots: 2 })]);
    let then = fewer.answers()[1].trajectory.state(PERIOD);
    // Not seen: where it was ordered to be.
    let answer = &plan(&mut fewer, &own[..1], &[], &tasks)[1];
    assert_eq!((answer.trajectory.start(), answer.safety), (then, Safety::Brake));
    assert_eq!(fewer.errors, [(1, TeamError::NoPose { poses: 1, robots: 2 })]);
    let mut more = team(SETTINGS, 1);
    assert_eq!(plan(&mut more, &own, &[], &tasks)[0].safety, Safety::Ok);
    assert_eq!(more.errors, [(1, TeamError::NoRobot { robots: 1 })]);
}

#[test]
fn a_robot_never_seen_stands_nobody_knows_where() {
    let mut team = team(SETTINGS, 2);
    let own = [state(NAN, 1.0, 2.0, 0.0), state(1.0, 1.0, 0.0, 0.0)];
    for _ in 0..2 {
        let answers = plan(&mut team, &own, &[], &[task(0.0, 1.0), task(3.0, 1.0)]);
        let State { position, velocity } = answers[0].trajectory.state(PERIOD);
        assert!(position.x.is_nan() && velocity == Vector::zeros());
        assert_eq!((answers[0].safety, answers[0].contact), (Safety::Brake, None));
        assert_eq!(answers[1].safety, Safety::Ok, "mates go on");
    }
}

#[test]
fn a_robot_that_is_lost_brakes_from_where_it_was_ordered_to_be() {
    let mut team = team(SETTINGS, 1);
    let mut own = [state(-2.0, 0.5, 0.0, 0.0)];
    for _ in 0..30 {
        plan(&mut team, &own, &[], &[task(2.0, 0.5)]);
        follow(&mut own, &team);
    }
    let lost = state(NAN, NAN, 0.0, 0.0);
    assert_brakes(&plan(&mut team, &[lost], &[], &[task(2.0, 0.5)])[0], own[0], 3.0);
    for _ in 0..60 {
        follow(&mut own, &team);
        let answer = &plan(&mut team, &[lost], &[], &[task(2.0, 0.5)])[0];
        // Whatever was ordered goes on: rounding apart.
        let start = answer.trajectory.start();
        assert!((start.position - own[0].position).norm() < 1e-12 && (start.velocity - own[0].velocity).norm() < 1e-9);
    }
    assert_eq!(own[0].velocity, Vector::zeros());
}

/// The least distance between robot 0, which runs from −2 to 2 m, and somebody at `other` who is lost for these frames.
fn least_clearance(lost: std::ops::Range<usize>, mut other: State, mate: bool) -> f64 {
    let mut own = vec![state(-2.0, 0.0, 0.0, 0.0)];
    let mut tasks = vec![task(2.0, 0.0)];
    if mate {
        own.push(other);
        tasks.push(task(other.position.x, other.position.y));
    }
    let mut team = team(SETTINGS, own.len());
    let mut least = f64::INFINITY;
    for frame in 0..300 {
        let (mut seen, mut opponent) = (own.clone(), other);
        if lost.contains(&frame) {
            (seen.last_mut().unwrap().position.x, opponent.position.x) = (NAN, NAN);
        }
        let (seen, opponents) =
            if mate { (&seen[..], [].as_slice()) } else { (&own[..], std::slice::from_ref(&opponent)) };
        plan(&mut team, seen, opponents, &tasks);
        follow(&mut own, &team);
        other.position += other.velocity * PERIOD;
        let there = if mate { own[1] } else { other };
        least = least.min((own[0].position - there.position).norm() - 0.18);
    }
    least
}

#[test]
fn who_is_lost_in_the_way_is_not_touched() {
    let standing = state(0.0, 0.0, 0.0, 0.0);
    for frames in [0, 1, 15, 60, 240] {
        let least = least_clearance(40..40 + frames, standing, true);
        assert!(least > 0.0, "mate, {frames} frames: {least}");
    }
    for frames in [0, 1, 15, 60] {
        for other in [standing, state(0.0, -0.4, 0.0, 0.3)] {
            let least = least_clearance(40..40 + frames, other, false);
            assert!(least > 0.0, "opponent, {frames} frames: {least}");
        }
    }
    assert!(least_clearance(1..300, standing, false) < 0.0, "an opponent is forgotten after a second");
}

#[test]
fn a_lowered_speed_limit_is_kept_at_once_whatever_the_hysteresis() {
    // 3 − 1.45 m/s at 3 m/s²: 0.517 s, 31.0 frames, and one for rounding.
    for hysteresis in [0.0, 0.1, 1.0] {
        let mut own = [state(-3.5, 0.0, 0.0, 0.0)];
        let mut team = team(TeamSettings { hysteresis, ..SETTINGS }, 1);
        for frame in 0..200 {
            let limits = Limits::new(if frame < 65 { 3.0 } else { 1.45 }, 3.0).unwrap();
            plan(&mut team, &own, &[], &[Task { limits, ..task(3.5, 0.0) }]);
            follow(&mut own, &team);
            assert!(frame != 64 || own[0].velocity.norm() > 2.99, "it was above");
            let speed = own[0].velocity.norm();
            assert!(frame < 65 + 32 || speed <= 1.45 * (1.0 + 1e-6), "{hysteresis}, frame {frame}: {speed} m/s");
        }
    }
}

#[test]
fn a_way_that_is_kept_says_where_it_leads() {
    // A goal that creeps away by 4 mm a frame is followed though each step is less than what makes a goal another.
    let mut team = team(TeamSettings { hysteresis: 1.0, ..SETTINGS }, 1);
    let mut own = [state(-2.0, 0.5, 0.0, 0.0)];
    let mut kept = 0;
    for frame in 0..120 {
        let goal = task(1.0 + 0.004 * f64::from(frame), 0.5);
        let answer = &plan(&mut team, &own, &[], &[goal])[0];
        // Where a trajectory ends is said exactly.
        assert_eq!((answer.trajectory.end().position, answer.contact), (answer.goal, None));
        assert!((answer.goal - goal.goal).norm() <= 0.01, "frame {frame}: {} mm behind", frame * 4);
        kept += u32::from(answer.goal != goal.goal);
        follow(&mut own, &team);
    }
    assert!(kept > 30, "ways are kept: {kept}");
}

#[test]
fn a_halt_is_nobodys_answer() {
    let from = state(2.0, 1.0, 2.0, 0.0);
    let mut team = team(SETTINGS, 1);
    assert_brakes(&plan(&mut team, &[from], &[], &[Task { halt: true, ..task(0.0, 1.0) }])[0], from, 3.0);
    assert_eq!((&team.origins[..], team.call_times.len(), team.errors.len()), (&[Origin::Halt][..], 0, 0));
}
