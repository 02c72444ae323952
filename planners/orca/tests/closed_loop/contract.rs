//! What every reactive controller keeps, and what is measured of each.

use std::time::Instant;

use env_model::motion::{Limits, Mover, Path, Side, State, Trajectory};
use env_model::{Obstacle, Point, Scene, Vector, World, scene::Field};
use planner_api::{Controller, Run, Situation};

use super::{Draw, FRAME, HORIZON, RADIUS, circle_swap, crossing, limits, shares};

/// A division B pitch with four discs.
fn pitch() -> World {
    let discs = [[1.0, 1.0], [-1.0, 0.5], [0.0, -1.5], [3.0, 2.0]];
    World::new(&Scene {
        name: "pitch".into(),
        unit: "m".into(),
        robot_radius: RADIUS,
        start: [-4.0, 0.0],
        goal: [4.0, 0.0],
        field: Some(Field { min: [-4.5, -3.0], max: [4.5, 3.0] }),
        obstacles: discs.map(|c| Obstacle::disc(c.into(), 0.3)).to_vec(),
    })
    .unwrap()
}

fn at_random(draw: &mut Draw) -> Point {
    Point::new(8.8 * draw.next() - 4.4, 5.8 * draw.next() - 2.9)
}

fn velocity_at_random(draw: &mut Draw, most: f64) -> Vector {
    let angle = std::f64::consts::TAU * draw.next();
    Vector::new(libm::cos(angle), libm::sin(angle)) * (most * draw.next())
}

/// 10 mates and 11 opponents.
fn crowd(draw: &mut Draw) -> Vec<Mover<'static>> {
    (0..21)
        .map(|i| {
            let side = if i < 10 { Side::Mate } else { Side::Opponent };
            let velocity = velocity_at_random(draw, 2.0);
            Mover::disc(at_random(draw), 2.0 * RADIUS, Path::Velocity(velocity), side).with_margin(0.02)
        })
        .collect()
}

/// Situations among 21 movers: the answers' limits, repetition, buffers.
pub fn keeps_limits_repeats_and_allocates_nothing(make: &dyn Fn() -> Box<dyn Controller>) {
    let world = pitch();
    let (mut draw, limits) = (Draw(11), limits());
    let crowds: Vec<_> = (0..200).map(|_| (crowd(&mut draw), at_random(&mut draw), at_random(&mut draw))).collect();
    // One in four is faster than it may be.
    let states: Vec<_> = crowds
        .iter()
        .map(|(_, position, _)| State { position: *position, velocity: velocity_at_random(&mut draw, 4.0) })
        .collect();
    let situations: Vec<_> = crowds
        .iter()
        .zip(&states)
        .map(|((movers, _, goal), state)| {
            Situation::new(&world, movers, *state, *goal, limits, HORIZON, FRAME).unwrap()
        })
        .collect();
    let mut one = make();
    let mut first = Vec::new();
    let mut trajectory = Trajectory::default();
    for (seed, situation) in situations.iter().enumerate() {
        one.control(situation, &mut Run::new(seed as u64), &mut trajectory).unwrap();
        let peaks = trajectory.peaks();
        let speed = limits.speed.max(situation.state.velocity.norm());
        assert!(peaks.speed <= speed * (1.0 + 1e-9) && peaks.acceleration <= 3.0 * (1.0 + 1e-9), "{seed}: {peaks:?}");
        assert_eq!(trajectory.start(), situation.state, "{seed}");
        let excess = situation.state.velocity.norm() - limits.speed;
        if excess > 0.0 {
            // As hard as it can, until it is no longer too fast; 1e-9 is the contract's.
            let then = trajectory.state(FRAME).velocity.norm();
            assert!(then <= limits.speed + (excess - 3.0 * FRAME).max(0.0) + 1e-9, "{seed}: {excess} {then}");
        }
        first.push(trajectory.clone());
    }
    let count = allocation_counter::measure(|| {
        for (seed, situation) in situations.iter().enumerate() {
            one.control(situation, &mut Run::new(seed as u64), &mut trajectory).unwrap();
            assert_eq!(trajectory, first[seed], "the same call, the same bits");
        }
    });
    assert_eq!(count.count_total, 0);
}

/// Inputs that nobody should meet give an answer that keeps the limits.
pub fn survives_hostile_input(make: &dyn Fn() -> Box<dyn Controller>) {
    let world = pitch();
    let here = Point::new(-1.0, -1.0);
    let velocities = [Vector::zeros(), Vector::new(3.0, 0.0), Vector::new(-30.0, 40.0), Vector::new(1e-300, 0.0)];
    let centres = [here, here + Vector::new(0.1, 0.0), here + Vector::new(0.18, 0.0), Point::new(1e9, -1e9)];
    let goals = [here, here + Vector::new(1e-12, 0.0), Point::new(1.0, 1.0), Point::new(99.0, 0.0)];
    let mut trajectory = Trajectory::default();
    let mut controller = make();
    for limits in [limits(), Limits::new(1e-3, 1e3).unwrap(), Limits::new(1e3, 1e-3).unwrap()] {
        for velocity in velocities {
            for centre in centres {
                for goal in goals {
                    for (theirs, horizon) in velocities.into_iter().zip([1e-9, 0.1, 3.0, 1e3]) {
                        let mover = Mover::disc(centre, 0.18, Path::Velocity(theirs), Side::Mate);
                        let movers = [mover.clone(), mover];
                        let state = State { position: here, velocity };
                        let situation = Situation::new(&world, &movers, state, goal, limits, horizon, FRAME).unwrap();
                        controller.control(&situation, &mut Run::new(1), &mut trajectory).unwrap();
                        let peaks = trajectory.peaks();
                        let speed = limits.speed.max(velocity.norm());
                        assert!(peaks.speed <= speed * (1.0 + 1e-9), "{situation:?} {peaks:?}");
                        assert!(peaks.acceleration <= limits.acceleration * (1.0 + 1e-9), "{situation:?} {peaks:?}");
                        let end = trajectory.end().position;
                        assert!(end.x.is_finite() && end.y.is_finite(), "{situation:?} {end}");
                    }
                }
            }
        }
    }
}

/// Prints shares and times.
pub fn measure(make: &dyn Fn() -> Box<dyn Controller>) {
    for (radius, jitter) in [(2.0, 0.0), (2.0, 0.05), (2.5, 0.1), (3.0, 0.1), (3.0, 0.3)] {
        let result = shares(100, |seed| circle_swap(make, 8, radius, jitter, seed));
        println!("circle of {radius} m, jitter {jitter}: free, arrived, time {result:.3?}");
    }
    for count in [4, 8, 12] {
        let result = shares(200, |seed| crossing(make, count, seed));
        println!("{count} crossing: free, arrived, time {result:.3?}");
    }
    let world = pitch();
    let mut draw = Draw(3);
    let mut controller = make();
    let mut trajectory = Trajectory::default();
    let mut times = Vec::new();
    for seed in 0..5000 {
        let movers = crowd(&mut draw);
        let state = State { position: at_random(&mut draw), velocity: velocity_at_random(&mut draw, 3.0) };
        let goal = at_random(&mut draw);
        let situation = Situation::new(&world, &movers, state, goal, limits(), HORIZON, FRAME).unwrap();
        // The least of three: what else the machine does is not the controller's.
        let mut least = f64::INFINITY;
        for _ in 0..3 {
            let begin = Instant::now();
            controller.control(&situation, &mut Run::new(seed), &mut trajectory).unwrap();
            least = least.min(begin.elapsed().as_secs_f64() * 1e6);
        }
        times.push(least);
    }
    times.sort_by(f64::total_cmp);
    let at = |q: f64| times[(q * times.len() as f64) as usize];
    println!("µs a call among 21 movers: median {:.1}, p99 {:.1}, max {:.1}", at(0.5), at(0.99), at(0.99999));
}
