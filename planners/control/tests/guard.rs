//! Whatever the world and the controller, the answer is safe and says what it is.

use env_model::motion::{Limits, Mover, Path, Side, State, Trajectory, bang_bang, brake, contact};
use env_model::scene::Field;
use env_model::{Obstacle, Point, Scene, Shape, Vector, World};
use planner_api::{ControlError, Controller, Outcome, PlanError, Run, Situation};
use planner_control::{Answer, Guard, Safety, nearest_free};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn between(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.random::<f64>()
}

fn point(rng: &mut ChaCha8Rng, half: f64) -> Point {
    Point::new(between(rng, -half, half), between(rng, -half, half))
}

/// A crowded square of ±3 m; sometimes without a field.
fn world(rng: &mut ChaCha8Rng) -> World {
    let n = rng.random_range(0..14);
    let obstacles = (0..n).map(|_| {
        let (a, b) = (point(rng, 3.0), point(rng, 3.0));
        match rng.random_range(0..3) {
            0 => Obstacle::disc(a, between(rng, 0.05, 0.8)),
            1 => Shape::Capsule { from: a.into(), to: (a + (b - a) * 0.3).into(), radius: between(rng, 0.05, 0.4) }
                .into(),
            _ => {
                let [p, q, r] = [Vector::new(0.0, 0.0), Vector::new(0.9, 0.1), Vector::new(0.2, 0.7)].map(|d| a + d);
                Shape::Polygon(vec![p.into(), q.into(), r.into()]).into()
            }
        }
    });
    let scene = Scene {
        name: "crowd".into(),
        unit: "m".into(),
        robot_radius: 0.09,
        start: [-3.0, -3.0],
        goal: [3.0, 3.0],
        obstacles: obstacles.collect(),
        field: rng.random_bool(0.8).then_some(Field { min: [-3.2, -3.2], max: [3.2, 3.2] }),
    };
    World::new(&scene).unwrap()
}

fn movers(rng: &mut ChaCha8Rng) -> Vec<Mover<'static>> {
    let one = |rng: &mut ChaCha8Rng| {
        let velocity = point(rng, 2.0).coords;
        Mover::disc(point(rng, 3.0), 0.18, Path::Velocity(velocity), Side::Opponent).with_margin(0.05)
    };
    (0..rng.random_range(0..8)).map(|_| one(rng)).collect()
}

/// Says anything.
struct Fool(ChaCha8Rng);

impl Controller for Fool {
    fn control(
        &mut self,
        situation: &Situation<'_>,
        _: &mut Run<'_>,
        trajectory: &mut Trajectory,
    ) -> Result<Outcome, ControlError> {
        bang_bang(situation.state, point(&mut self.0, 4.0), situation.limits, trajectory);
        match self.0.random_range(0..4) {
            0 => Ok(Outcome::Arrives),
            1 => Ok(Outcome::Partial),
            2 => Ok(Outcome::NotFound),
            _ => Err(PlanError::Unsupported("no".into()).into()),
        }
    }
}

#[test]
fn every_answer_is_safe_or_says_that_it_is_not() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let limits = Limits::new(3.0, 3.0).unwrap();
    let mut seen = [0; 5];
    for case in 0..1500 {
        let (world, movers) = (world(&mut rng), movers(&mut rng));
        let state = State { position: point(&mut rng, 3.5), velocity: point(&mut rng, 2.0).coords };
        let goal = point(&mut rng, 4.0);
        let situation = Situation::new(&world, &movers, state, goal, limits, 2.0, 1.0 / 60.0).unwrap();
        let brakes = rng.random_bool(0.5);
        let mut guard = Guard::new(Box::new(Fool(ChaCha8Rng::seed_from_u64(case)))).with_emergency_brake(brakes);
        let mut answer = Answer::default();
        let failed = guard.answer(&situation, &mut Run::new(1), &mut answer).is_err();
        let Answer { trajectory, safety, goal: led, contact } = &answer;
        seen[*safety as usize] += 1;
        assert_eq!(trajectory.start(), state, "{case}");
        let peaks = trajectory.peaks();
        assert!(peaks.speed <= 3.0 * (1.0 + 1e-9) && peaks.acceleration <= 3.0 * (1.0 + 1e-9), "{case}: {peaks:?}");
        let inside =
            !world.point_free(state.position) || movers.iter().any(|m| m.shape.point_clearance(state.position) < 0.0);
        match safety {
            Safety::Escape => {
                assert!(inside && world.point_free(*led), "{case}");
                assert!(movers.iter().all(|m| m.shape.point_clearance(*led) >= 0.0), "{case}");
                assert_eq!(trajectory.end(), State::at_rest(*led));
            }
            Safety::Brake => {
                assert_eq!(trajectory.end().velocity, Vector::zeros());
                let way = (trajectory.end().position - state.position).norm();
                assert!((way - limits.braking_distance(state.velocity.norm())).abs() < 1e-9, "{case}");
            }
            Safety::Adapted => assert!(!world.point_free(goal) && world.point_free(*led), "{case}"),
            Safety::Ok | Safety::Partial => assert!(!inside && !failed, "{case}"),
        }
        assert!(!failed || *safety == Safety::Brake, "{case}: an error is answered with the brakes");
        // The contact reported is where clearance is lost: nothing before, something soon after.
        let clearance = |t: f64| {
            let p = trajectory.state(t).position;
            movers
                .iter()
                .map(|m| m.shape.point_clearance(p - m.displacement(t)))
                .fold(world.point_clearance(p), f64::min)
        };
        let until = contact.map_or(2.0, |c| c.time);
        for i in 0..400 {
            let t = until * f64::from(i) / 400.0;
            // Rounding, and the slack of half a nanometre or so that worlds allow.
            assert!(t >= until || clearance(t) > -1e-8, "{case}: {} at {t} before {until}", clearance(t));
        }
        if let Some(contact) = contact {
            let after = (1..=20).map(|i| clearance(contact.time + 1e-4 * f64::from(i * i)));
            assert!(after.fold(f64::INFINITY, f64::min) < 0.0, "{case}: nothing at {contact:?}");
        }
    }
    assert!(seen.iter().all(|n| *n > 20), "every kind of answer came up: {seen:?}");
}

/// Does as it is told.
struct Says<F>(F);

impl<F: FnMut(&Situation<'_>, &mut Trajectory) + Send> Controller for Says<F> {
    fn control(&mut self, s: &Situation<'_>, _: &mut Run<'_>, t: &mut Trajectory) -> Result<Outcome, ControlError> {
        (self.0)(s, t);
        Ok(Outcome::Arrives)
    }
}

#[test]
fn what_cannot_be_driven_is_answered_with_the_brakes() {
    let scene = Scene {
        name: "open".into(),
        unit: "m".into(),
        robot_radius: 0.09,
        start: [-1.0, 0.0],
        goal: [1.0, 0.0],
        field: None,
        obstacles: vec![],
    };
    let world = World::new(&scene).unwrap();
    let limits = Limits::new(3.0, 3.0).unwrap();
    let ask = |speed: f64, says: fn(&Situation<'_>, &mut Trajectory)| {
        let state = State { position: Point::new(-1.0, 0.5), velocity: Vector::new(speed, 0.0) };
        let goal = Point::new(1.0, 0.0);
        let situation = Situation::new(&world, &[], state, goal, limits, 2.0, 1.0 / 60.0).unwrap();
        let mut answer = Answer::default();
        Guard::new(Box::new(Says(says))).answer(&situation, &mut Run::new(1), &mut answer).unwrap();
        if answer.safety == Safety::Brake {
            let mut stop = Trajectory::default();
            brake(state, limits, &mut stop);
            assert_eq!(answer.trajectory, stop);
        }
        answer.safety
    };
    let faults: [fn(&Situation<'_>, &mut Trajectory); 10] = [
        |s, t| {
            t.begin(s.state);
            t.push(1.0, Vector::new(f64::NAN, 0.0));
        },
        |s, t| {
            t.begin(s.state);
            t.push(f64::INFINITY, Vector::zeros());
        },
        |s, t| {
            t.begin(s.state);
            t.end_at(State::at_rest(Point::new(f64::INFINITY, 0.0)));
        },
        |_, t| t.begin(State::at_rest(Point::new(50.0, 50.0))),
        |s, t| bang_bang(State { position: s.state.position + Vector::x() * 1e-6, ..s.state }, s.goal, s.limits, t),
        |s, t| bang_bang(State { velocity: s.state.velocity + Vector::y() * 1e-6, ..s.state }, s.goal, s.limits, t),
        |s, t| bang_bang(s.state, s.goal, Limits::new(3.0, 3.0 * (1.0 + 1e-5)).unwrap(), t),
        // A second at 3 m/s² and a little from rest, and so too fast in the end.
        |s, t| {
            brake(s.state, s.limits, t);
            t.push(1.0 + 1e-5, Vector::x() * 3.0);
        },
        // Slower, and then faster again.
        |s, t| {
            t.begin(s.state);
            t.push(0.2, s.state.velocity.normalize() * -3.0);
            t.push(0.9, s.state.velocity.normalize() * 3.0);
        },
        |s, t| {
            t.begin(s.state);
            t.push(1e-3, Vector::new(1e6, 0.0));
        },
    ];
    for (i, says) in faults.into_iter().enumerate() {
        for speed in [1.0, 3.5] {
            assert_eq!(ask(speed, says), Safety::Brake, "{i} at {speed}");
        }
    }
    for speed in [0.0, 3.0, 3.5] {
        assert_eq!(ask(speed, |s, t| bang_bang(s.state, s.goal, s.limits, t)), Safety::Ok, "{speed}");
    }
}

#[test]
fn the_nearest_free_point_is_the_nearest() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let (mut moved, mut none) = (0, 0);
    for case in 0..300 {
        let (world, movers) = (world(&mut rng), movers(&mut rng));
        let p = point(&mut rng, 3.6);
        let free = |q: Point| world.point_free(q) && movers.iter().all(|m| m.shape.point_clearance(q) >= 0.0);
        let Some(q) = nearest_free(&world, &movers, p) else {
            none += 1;
            continue;
        };
        assert!(free(q), "{case}");
        if free(p) {
            assert_eq!(p, q);
            continue;
        }
        moved += 1;
        let distance = (q - p).norm();
        // No point of a fine fan is free and nearer by more than the ε by which one stays outside.
        for ring in 1..40 {
            for i in 0..120 {
                let angle = std::f64::consts::TAU * f64::from(i) / 120.0;
                let r = distance * (1.0 - 1e-6) * f64::from(ring) / 40.0;
                let nearer = p + Vector::new(angle.cos(), angle.sin()) * r;
                assert!(!free(nearer), "{case}: {nearer} is nearer to {p} than {q}");
            }
        }
    }
    assert!(moved > 60 && none == 0, "{moved} {none}");
}

#[test]
fn brakes_put_off_what_is_due() {
    let world = World::new(&Scene {
        name: "wall".into(),
        unit: "m".into(),
        robot_radius: 0.09,
        start: [-3.0, 0.0],
        goal: [3.0, 0.0],
        field: None,
        obstacles: vec![Obstacle::disc(Point::new(1.0, 0.0), 0.3)],
    })
    .unwrap();
    let limits = Limits::new(3.0, 3.0).unwrap();
    // 0.51 m before contact. 1.7 m/s stop within 0.48 m, after another sixtieth of a second's acceleration not; 1.5 m/s
    // can be braked a period later too; 2 m/s need 0.67 m.
    let at = |speed: f64| State { position: Point::new(0.1, 0.0), velocity: Vector::new(speed, 0.0) };
    let ask = |speed: f64, brake: bool| {
        let situation = Situation::new(&world, &[], at(speed), Point::new(2.0, 0.0), limits, 2.0, 0.016).unwrap();
        let mut answer = Answer::default();
        Guard::new(Box::new(Says(|s: &Situation<'_>, t: &mut Trajectory| bang_bang(s.state, s.goal, s.limits, t))))
            .with_emergency_brake(brake)
            .answer(&situation, &mut Run::new(1), &mut answer)
            .unwrap();
        answer
    };
    assert_eq!(ask(1.5, true).safety, Safety::Ok);
    let unbraked = ask(1.7, false);
    assert_eq!(unbraked.safety, Safety::Ok);
    // 0.51 = 1.7t + 1.5t²
    let expected = ((1.7f64 * 1.7 + 4.0 * 1.5 * 0.51).sqrt() - 1.7) / 3.0;
    assert!((unbraked.contact.unwrap().time - expected).abs() < 1e-7, "{:?}", unbraked.contact);
    let braked = ask(1.7, true);
    assert_eq!((braked.safety, braked.contact), (Safety::Brake, None));
    let late = ask(2.0, true);
    assert_eq!(late.safety, Safety::Brake);
    assert!(late.contact.unwrap().time > ask(2.0, false).contact.unwrap().time, "later is better");
}

#[test]
fn an_answer_without_a_free_goal_is_to_brake() {
    // The disc fills the field.
    let scene = Scene {
        name: "full".into(),
        unit: "m".into(),
        robot_radius: 0.09,
        start: [-1.0, 0.0],
        goal: [1.0, 0.0],
        field: Some(Field { min: [-1.0, -1.0], max: [1.0, 1.0] }),
        obstacles: vec![Obstacle::disc(Point::origin(), 2.0)],
    };
    let world = World::new(&scene).unwrap();
    assert_eq!(nearest_free(&world, &[], Point::new(0.1, 0.2)), None);
    let limits = Limits::new(3.0, 3.0).unwrap();
    let state = State { position: Point::new(0.1, 0.2), velocity: Vector::new(1.0, 0.0) };
    let situation = Situation::new(&world, &[], state, Point::new(0.5, 0.0), limits, 1.0, 0.016).unwrap();
    let mut answer = Answer::default();
    Guard::new(Box::new(Fool(ChaCha8Rng::seed_from_u64(1)))).answer(&situation, &mut Run::new(1), &mut answer).unwrap();
    assert_eq!((answer.safety, answer.contact.map(|c| c.time)), (Safety::Brake, Some(0.0)));
    assert_eq!(contact::enters(&answer.trajectory.pieces()[0], &world.obstacles()[0], 0.0), Some(0.0));
}
