//! Mates: those at one spot part, and nobody escapes through another one.

use env_model::motion::{Limits, Mover, Path, Side, State, Trajectory, bang_bang, brake, least_clearance};
use env_model::scene::Field;
use env_model::{Obstacle, Point, Scene, Shape, Vector, World};
use planner_api::{ControlError, Controller, Outcome, Run, Situation};
use planner_control::{Answer, Foresight, Guard, Safety, nearest_free};

const CONTACT: f64 = 0.18;
const PERIOD: f64 = 1.0 / 60.0;

fn world(obstacles: Vec<Obstacle>) -> World {
    World::new(&Scene {
        name: "pitch".into(),
        unit: "m".into(),
        robot_radius: 0.09,
        start: [-3.0, 0.0],
        goal: [3.0, 0.0],
        field: Some(Field { min: [-4.8, -3.3], max: [4.8, 3.3] }),
        obstacles,
    })
    .unwrap()
}

fn limits(acceleration: f64) -> Limits {
    Limits::new(3.0, acceleration).unwrap()
}

struct Straight;

impl Controller for Straight {
    fn control(&mut self, s: &Situation<'_>, _: &mut Run<'_>, t: &mut Trajectory) -> Result<Outcome, ControlError> {
        bang_bang(s.state, s.goal, s.limits, t);
        Ok(Outcome::Arrives)
    }
}

/// A team of robots that plan one after the other.
struct Robots {
    states: Vec<State>,
    goals: Vec<Point>,
    accelerations: Vec<f64>,
    guards: Vec<Guard>,
}

impl Robots {
    fn new(robots: &[(State, Point, f64)]) -> Self {
        Self {
            states: robots.iter().map(|r| r.0).collect(),
            goals: robots.iter().map(|r| r.1).collect(),
            accelerations: robots.iter().map(|r| r.2).collect(),
            guards: robots.iter().map(|_| Guard::new(Box::new(Straight)).with_emergency_brake(true)).collect(),
        }
    }

    /// One frame: mates by their trajectories (`knows`), or by their velocities. The seeds are by `seed` and robot. The
    /// least clearance of two in the frame.
    fn step(&mut self, world: &World, knows: bool, seed: impl Fn(usize) -> u64) -> f64 {
        let n = self.states.len();
        let mut ways = vec![Trajectory::default(); n];
        for (i, way) in ways.iter_mut().enumerate() {
            brake(self.states[i], limits(self.accelerations[i]), way);
        }
        for i in 0..n {
            let mates = (0..n).filter(|j| *j != i).map(|j| {
                let path = if knows { Path::Trajectory(&ways[j]) } else { Path::Velocity(self.states[j].velocity) };
                Mover::disc(self.states[j].position, CONTACT, path, Side::Mate).with_braking(self.accelerations[j])
            });
            let mates: Vec<_> = mates.collect();
            let (state, own) = (self.states[i], limits(self.accelerations[i]));
            let situation = Situation::new(world, &mates, state, self.goals[i], own, 2.0, PERIOD).unwrap();
            let mut answer = Answer::default();
            self.guards[i].answer(&situation, &mut Run::new(seed(i)), &mut answer).unwrap();
            ways[i] = answer.trajectory;
        }
        let mut least = f64::INFINITY;
        for i in 0..n {
            for j in 0..i {
                let mate = Mover::disc(self.states[j].position, CONTACT, Path::Trajectory(&ways[j]), Side::Mate);
                least = least.min(least_clearance(&ways[i], &mate, PERIOD).1);
            }
        }
        for (state, way) in self.states.iter_mut().zip(&ways) {
            *state = way.state(PERIOD);
        }
        least
    }
}

#[test]
fn two_at_one_spot_part() {
    let (open, spot) = (world(vec![]), State::at_rest(Point::new(0.3, 0.1)));
    let cornered = State::at_rest(Point::new(-4.7, -3.2));
    let (east, north) = (Point::new(2.0, 0.1), Point::new(0.3, 2.0));
    for knows in [true, false] {
        // The same goal with seeds of their own, and the same seeds with goals of their own.
        for (at, goals, own_seeds) in
            [(spot, [east, east], true), (spot, [east, north], false), (cornered, [cornered.position; 2], true)]
        {
            let mut robots = Robots::new(&[(at, goals[0], 3.0), (at, goals[1], 3.0)]);
            let apart = |robots: &Robots| (robots.states[0].position - robots.states[1].position).norm() >= CONTACT;
            // Half of 0.18 m from rest each, or all of it: within 0.5 s at 3 m/s², and as much again for a bad beginning.
            let parted = (0..60).position(|frame| {
                robots.step(&open, knows, |i| 2 * frame + if own_seeds { i as u64 } else { 0 });
                apart(&robots)
            });
            assert!(parted.is_some(), "{knows} {goals:?} {own_seeds}: {:?}", robots.states);
            for frame in 60..240 {
                let clearance = robots.step(&open, true, |i| 2 * frame + i as u64);
                assert!(clearance > -1e-9, "together again: {clearance}");
            }
        }
    }
}

#[test]
fn escapes_spare_mates() {
    // Both are in a keep-out zone and leave it downwards, the mate standing in the way of the first one, or crossing it.
    let zone = world(vec![Shape::Polygon(vec![[-2.0, 0.0], [2.0, 0.0], [2.0, 3.0], [-2.0, 3.0]]).into()]);
    let state = State::at_rest(Point::new(0.0, 0.5));
    for (at, velocity) in [(Point::new(0.0, 0.2), Vector::zeros()), (Point::new(-0.5, 0.2), Vector::new(1.5, 0.0))] {
        let mut stop = Trajectory::default();
        brake(State { position: at, velocity }, limits(3.0), &mut stop);
        let mate = [Mover::disc(at, CONTACT, Path::Trajectory(&stop), Side::Mate)];
        let situation = Situation::new(&zone, &mate, state, Point::new(0.0, -2.0), limits(3.0), 2.0, PERIOD).unwrap();
        let ask = |brakes: bool| {
            let mut answer = Answer::default();
            let mut guard = Guard::new(Box::new(Straight)).with_emergency_brake(brakes);
            guard.answer(&situation, &mut Run::new(1), &mut answer).unwrap();
            let (_, clearance) = least_clearance(&answer.trajectory, &mate[0], 2.0);
            (answer.safety, clearance)
        };
        let (careless, careful) = (ask(false), ask(true));
        assert!(careless.0 == Safety::Escape && careless.1 < 0.0, "the case is one: {careless:?}");
        assert!(careful.1 >= 0.0, "{careful:?}");
    }
}

#[test]
fn a_crowd_leaves_a_zone_without_contact() {
    let zone = world(vec![Obstacle::disc(Point::new(0.0, 0.0), 0.8)]);
    let robots: Vec<_> = (0..8)
        .map(|i| {
            let (x, y) = (f64::from(i % 3) * 0.25 - 0.3, f64::from(i / 3) * 0.25 - 0.2);
            let velocity = Vector::new(0.3 * f64::from(i % 2), 0.2);
            (State { position: Point::new(x, y), velocity }, Point::new(2.0 - x, -y), 3.0)
        })
        .collect();
    let mut robots = Robots::new(&robots);
    for frame in 0..300 {
        let clearance = robots.step(&zone, true, |i| 8 * frame + i as u64);
        // Rounding of positions of a metre.
        assert!(clearance > -1e-9, "{frame}: {clearance}");
    }
    for (i, state) in robots.states.iter().enumerate() {
        assert!(zone.point_free(state.position), "{i} is still inside: {state:?}");
    }
}

#[test]
fn mates_brake_with_their_own_deceleration() {
    let open = world(vec![]);
    // 1 m/s east; the mate, 0.36 m from contact, comes west at 1 m/s. The robot stops in 0.167 m, the mate after a period
    // of 0.017 m in 0.167 m at 3 m/s², in 0.5 m at 1 m/s² and in 0.025 m at 20 m/s².
    let state = State { position: Point::origin(), velocity: Vector::x() };
    let stops = |braking: Option<f64>| {
        let mut way = Trajectory::default();
        bang_bang(
            State { position: Point::origin(), velocity: -Vector::x() },
            Point::new(-2.0, 0.0),
            limits(1.0),
            &mut way,
        );
        let disc = Mover::disc(Point::new(0.36 + CONTACT, 0.0), CONTACT, Path::Trajectory(&way), Side::Mate);
        let mate = [Mover { braking, ..disc }];
        let situation = Situation::new(&open, &mate, state, Point::new(2.0, 0.0), limits(3.0), 2.0, PERIOD).unwrap();
        let mut ahead = Trajectory::default();
        brake(state, limits(3.0), &mut ahead);
        let mut foresight = Foresight::default();
        foresight.begin(&situation);
        foresight.can_stop(&situation, &ahead)
    };
    assert_eq!([None, Some(3.0), Some(1.0), Some(20.0)].map(stops), [true, true, false, true]);
}

#[test]
fn unequal_decelerations_do_not_collide() {
    let open = world(vec![]);
    for k in 0..6 {
        let robot = |i: usize| {
            let angle = std::f64::consts::TAU * (i as f64 + 0.02 * (k * (i + 1)) as f64) / 4.0;
            let at = Point::new(2.0 * angle.cos(), 2.0 * angle.sin());
            (State::at_rest(at), Point::new(-at.x, -at.y), if i % 2 == 0 { 4.0 } else { 1.5 })
        };
        let mut robots = Robots::new(&[robot(0), robot(1), robot(2), robot(3)]);
        for frame in 0..240 {
            let clearance = robots.step(&open, true, |i| 8 * frame + i as u64);
            assert!(clearance > -1e-9, "{k} {frame}: {clearance}");
        }
    }
}

#[test]
fn a_search_from_any_distance_ends() {
    let disc = [Mover::disc(Point::origin(), CONTACT, Path::Velocity(Vector::zeros()), Side::Other)];
    for far in [1e6, 1e150, 1e200, 1e308, f64::INFINITY, f64::NAN] {
        let out = nearest_free(&world(vec![]), &disc, Point::new(far, 0.0));
        assert!(out.is_some() || far > 1e6 || far.is_nan(), "{far}");
    }
}

#[test]
fn movers_far_from_the_world_are_left() {
    // A wall of 100 m round p, in a world of 6 m without a field.
    let world = World::new(&Scene {
        name: "small".into(),
        unit: "m".into(),
        robot_radius: 0.09,
        start: [-3.0, 0.0],
        goal: [3.0, 0.0],
        field: None,
        obstacles: vec![],
    })
    .unwrap();
    let still = Path::Velocity(Vector::zeros());
    // A chain of discs, each overlapping the next.
    let chain: Vec<_> = (0..100)
        .map(|i| Mover::disc(Point::new(f64::from(i) * 0.5, 0.0), 1.0, still, Side::Other))
        .chain((1..80).map(|i| Mover::disc(Point::new(f64::from(i) * -0.5, 0.0), 1.0, still, Side::Other)))
        .collect();
    let sideways = nearest_free(&world, &chain, Point::new(5.25, 0.0)).unwrap();
    // Where two neighbours' circles cross.
    let expected = (1.0f64 - 0.25 * 0.25).sqrt();
    assert!((sideways - Point::new(5.25, sideways.y)).norm() < 1e-6 && (sideways.y.abs() - expected).abs() < 1e-6);
    let slab =
        env_model::Polygon::new([[-60.0, -60.0], [90.0, -60.0], [90.0, 70.0], [-60.0, 70.0]].map(Point::from).to_vec());
    let core = env_model::Core::Polygon(slab.unwrap());
    let slab = [Mover { shape: env_model::Inflated { core, radius: 0.09 }, ..chain[0].clone() }];
    let out = nearest_free(&world, &slab, Point::new(0.0, 0.0)).unwrap();
    assert!((out.coords.norm() - 60.09).abs() < 1e-6, "{out}");
}
