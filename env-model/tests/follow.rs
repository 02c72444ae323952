//! Timed paths and the motions without a path: they keep their limits, join up, end where they must, stay free, and are
//! never quicker than possible.

mod common;

use common::{Draw, check_motion, field, limits};
use env_model::motion::{Follower, Limits, State, Trajectory, brake, first_contact, least_time};
use env_model::{Obstacle, Point, Scene, World};

/// A world of `count` discs on a field of 12 × 9 m, the robot's radius included.
fn world(draw: &mut Draw, count: usize) -> World {
    let obstacles = (0..count)
        .map(|_| Obstacle::disc(Point::new(draw.between(-6.0, 6.0), draw.between(-4.5, 4.5)), draw.between(0.05, 0.5)))
        .collect();
    World::new(&field(obstacles)).unwrap()
}

fn free_point(draw: &mut Draw, world: &World) -> Point {
    loop {
        let p = Point::new(draw.between(-6.0, 6.0), draw.between(-4.5, 4.5));
        if world.point_clearance(p) > 0.0 {
            return p;
        }
    }
}

/// A free path of random points and steps, some of them short, straight on or back.
fn free_path(draw: &mut Draw, world: &World) -> Vec<Point> {
    let mut path = vec![free_point(draw, world)];
    for _ in 0..draw.below(12) {
        let last = path[path.len() - 1];
        let next = match draw.below(6) {
            0 => last,
            1 if path.len() > 1 => last + (last - path[path.len() - 2]) * draw.between(0.1, 2.0),
            2 if path.len() > 1 => last - (last - path[path.len() - 2]) * draw.between(0.1, 1.0),
            3 => last + draw.direction() * draw.log(1e-6, 0.3),
            _ => last + draw.direction() * draw.between(0.1, 5.0),
        };
        if world.segment_free(last, next) {
            path.push(next);
        }
    }
    path
}

/// The clearance of dense samples of the motion; ε is the world's tolerance.
fn assert_free(motion: &Trajectory, world: &World, context: &str) {
    assert_eq!(first_contact(motion, world, &[], motion.duration() + 1.0), None, "{context}");
    for piece in motion.pieces() {
        for i in 0..=20 {
            let p = piece.state(piece.duration * f64::from(i) / 20.0).position;
            assert!(world.point_clearance(p) >= -world.epsilon(), "{p} {}, {context}", world.point_clearance(p));
        }
    }
}

#[test]
fn paths_from_rest() {
    let mut draw = Draw::new(1);
    let mut follower = Follower::default();
    let mut motion = Trajectory::default();
    for case in 0..3000 {
        let count = draw.below(30);
        let world = world(&mut draw, count);
        let limits = limits(&mut draw);
        let path = free_path(&mut draw, &world);
        let (start, goal) = (State::at_rest(path[0]), path[path.len() - 1]);
        follower.follow(&path, start, limits, &world, &mut motion);
        let context = format!("case {case}: {path:?}, {limits:?}");
        check_motion(&motion, start, goal, limits, &context);
        assert_free(&motion, &world, &context);
    }
}

#[test]
fn a_straight_path_from_rest_takes_the_least_time() {
    let mut draw = Draw::new(2);
    let world = world(&mut draw, 0);
    let mut motion = Trajectory::default();
    for _ in 0..2000 {
        let limits = limits(&mut draw);
        let (a, b) = (free_point(&mut draw, &world), free_point(&mut draw, &world));
        let mut shares: Vec<f64> = (0..draw.below(5)).map(|_| draw.between(0.0, 1.0)).collect();
        shares.sort_by(f64::total_cmp);
        let path: Vec<Point> = [a].into_iter().chain(shares.iter().map(|s| a + (b - a) * *s)).chain([b]).collect();
        Follower::default().follow(&path, State::at_rest(a), limits, &world, &mut motion);
        let least = least_time(State::at_rest(a), b, limits);
        // Points between are off the line by their rounding, and turn by about that over their distances.
        let band = if shares.is_empty() { 1e-12 } else { 1e-6 };
        assert!((motion.duration() - least).abs() <= band * least, "{} {least} {path:?}", motion.duration());
    }
}

#[test]
fn paths_from_a_moving_start() {
    let mut draw = Draw::new(3);
    let mut follower = Follower::default();
    let mut motion = Trajectory::default();
    let (mut held, mut doomed) = (0, 0);
    for case in 0..4000 {
        let count = draw.below(20);
        let world = world(&mut draw, count);
        let limits = limits(&mut draw);
        let path = free_path(&mut draw, &world);
        let speed = limits.speed * if case % 8 == 0 { draw.between(1.0, 2.0) } else { draw.between(0.0, 1.0) };
        let start = State { position: path[0], velocity: draw.direction() * speed };
        let goal = path[path.len() - 1];
        follower.follow(&path, start, limits, &world, &mut motion);
        let context = format!("case {case}: {path:?}, {start:?}, {limits:?}");
        check_motion(&motion, start, goal, limits, &context);
        let mut stop = Trajectory::default();
        brake(start, limits, &mut stop);
        if first_contact(&stop, &world, &[], stop.duration()).is_none() {
            held += 1;
            assert_free(&motion, &world, &context);
        } else {
            doomed += 1;
        }
    }
    println!("{held} could stop, {doomed} could not");
    assert!(held > 1500 && doomed > 100);
}

#[test]
fn round_a_disc_that_the_path_touches_it_does_not_stop() {
    let radius = 0.6;
    let scene = Scene { obstacles: vec![Obstacle::disc(Point::origin(), radius)], ..field(vec![]) };
    let world = World::new(&scene).unwrap();
    let limits = Limits::new(3.0, 3.0).unwrap();
    for sides in [3, 8, 50] {
        // Half a turn round the disc by sides that touch it, with straight ways of 2 m before and after.
        let step = std::f64::consts::PI / f64::from(sides);
        let corner = radius / (0.5 * step).cos();
        let mut path = vec![Point::new(radius, -2.0)];
        path.extend((0..sides).map(|i| {
            let angle = (f64::from(i) + 0.5) * step;
            Point::new(corner * angle.cos(), corner * angle.sin())
        }));
        path.push(Point::new(-radius, -2.0));
        assert!(world.path_free(&path));
        let mut motion = Trajectory::default();
        let start = State::at_rest(path[0]);
        Follower::default().follow(&path, start, limits, &world, &mut motion);
        let context = format!("{sides} sides");
        check_motion(&motion, start, path[path.len() - 1], limits, &context);
        assert_free(&motion, &world, &context);
        // On the arc itself √(ar) is possible, reached and left on the straight ways.
        let round = (limits.acceleration * radius).sqrt();
        let straight = {
            let top = (limits.acceleration * 2.0 + 0.5 * round * round).sqrt().min(limits.speed);
            let ways = (top * top - 0.5 * round * round) / limits.acceleration;
            (2.0 * top - round) / limits.acceleration + (2.0 - ways).max(0.0) / top
        };
        let best = 2.0 * straight + std::f64::consts::PI * radius / round;
        println!("{sides} sides: {:.4} s, along the arc {best:.4} s", motion.duration());
        assert!(motion.duration() < 1.05 * best, "{} {best}", motion.duration());
    }
}
