//! When moving things meet: discs against parry's shape cast (acceptance), everything else against conservative
//! advancement on parry's distances.
//!
//! An oracle's answer for shapes grown by a band must come no later, and for shapes shrunk by it no earlier, than ours.

mod common;

use common::{Draw, field, point_oracle};
use env_model::motion::contact::{meets, nearest};
use env_model::motion::{Mover, Path, Piece, Side, State, Touched, Trajectory, first_contact, least_clearance};
use env_model::{Obstacle, Point, Shape, Vector, World};
use parry2d_f64::math::{Pose, Vector as ParryVector};
use parry2d_f64::query::{ShapeCastOptions, cast_shapes};
use parry2d_f64::shape::Ball;

/// Metres on a field of 15 m diagonal.
const BAND: f64 = 1e-9;
/// Seconds.
const HORIZON: f64 = 10.0;

fn cast(p: Point, v: Vector, r: f64, q: Point, w: Vector, s: f64) -> Option<f64> {
    let pose = |p: Point| Pose::translation(p.x, p.y);
    let velocity = |v: Vector| ParryVector::new(v.x, v.y);
    let options = ShapeCastOptions { max_time_of_impact: HORIZON, ..ShapeCastOptions::default() };
    cast_shapes(&pose(p), velocity(v), &Ball::new(r), &pose(q), velocity(w), &Ball::new(s), options)
        .unwrap()
        .map(|hit| hit.time_of_impact)
}

/// Two discs on a field, with their velocities.
fn pair(draw: &mut Draw, mode: usize) -> (Point, Vector, f64, Point, Vector, f64) {
    let on_field = |draw: &mut Draw| Point::new(draw.between(-6.0, 6.0), draw.between(-4.5, 4.5));
    let speed = |draw: &mut Draw| draw.between(0.0, 4.0);
    let (p, q) = (on_field(draw), on_field(draw));
    let (r, s) = (draw.log(0.02, 0.5), draw.log(0.02, 0.5));
    let w = draw.direction() * speed(draw);
    let apart = (q - p).norm();
    let towards = (q - p) / apart;
    let across = Vector::new(-towards.y, towards.x);
    match mode {
        // Any.
        0 => (p, draw.direction() * speed(draw), r, q, w, s),
        // At each other, passing at some fraction of the radii.
        1 | 2 => {
            let miss = (draw.between(-1.3, 1.3) * (r + s) / apart).clamp(-0.9, 0.9);
            let heading = towards * (1.0 - miss * miss).sqrt() + across * miss;
            (p, w + heading * draw.log(1e-2, 6.0), r, q, w, s)
        }
        // Grazing, by a tiny distance on either side.
        3 => {
            let miss = (r + s + draw.sign() * draw.log(1e-13, 1e-2)) / apart;
            if miss.abs() >= 1.0 {
                return pair(draw, 0);
            }
            let heading = towards * (1.0 - miss * miss).sqrt() + across * miss;
            (p, w + heading * speed(draw), r, q, w, s)
        }
        // From a tiny distance on either side of touching, in any direction.
        _ => {
            let q = p + towards * (r + s + draw.sign() * draw.log(1e-13, 1e-2));
            (p, draw.direction() * speed(draw), r, q, w, s)
        }
    }
}

#[test]
fn discs_of_constant_velocity_agree_with_parry() {
    const PAIRS: usize = 150_000;
    let mut draw = Draw::new(2026);
    let (mut contacts, mut free, mut in_band, mut disagreements) = (0, 0, 0, 0);
    // Of time, as the way at the relative speed: of all that are decided, and of those that meet at 45° or steeper.
    let (mut worst, mut worst_steep) = (0.0f64, 0.0f64);
    for case in 0..PAIRS {
        let (p, v, r, q, w, s) = pair(&mut draw, case % 5);
        let robot = Trajectory::new(State { position: p, velocity: v });
        let mover = Mover::disc(q, r + s, Path::Velocity(w), Side::Opponent);
        let ours = meets(&robot, &mover, 0.0, HORIZON);
        let (grown, exact, shrunk) =
            (cast(p, v, r + BAND, q, w, s), cast(p, v, r, q, w, s), cast(p, v, r - BAND, q, w, s));
        let agrees = match (ours, grown, shrunk) {
            (None, None, _) => true,
            (None, Some(_), shrunk) => shrunk.is_none(),
            // Rounding of a time of ten seconds.
            (Some(t), Some(early), late) => early <= t + 1e-13 && late.is_none_or(|late| t <= late + 1e-13),
            (Some(_), None, _) => false,
        };
        disagreements += usize::from(!agrees);
        match (grown, shrunk) {
            (None, _) => free += 1,
            (Some(_), Some(_)) => contacts += 1,
            (Some(_), None) => in_band += 1,
        }
        if let (Some(t), Some(expected), Some(_)) = (ours, exact, shrunk) {
            let error = (t - expected).abs() * (v - w).norm();
            worst = worst.max(error);
            let apart = (p + v * t) - (q + w * t);
            if (v - w).dot(&apart).abs() > 0.7 * (v - w).norm() * apart.norm() {
                worst_steep = worst_steep.max(error);
            }
        }
        if !agrees {
            println!("case {case}: {ours:?}, parry {exact:?}, {grown:?} grown, {shrunk:?} shrunk");
        }
    }
    println!(
        "{PAIRS} pairs: {contacts} meet, {free} do not, {in_band} within the band of {BAND} m; {disagreements} \
        disagreements; worst error of time × relative speed {worst:.1e} m, {worst_steep:.1e} m where they meet at \
        45° or steeper"
    );
    assert_eq!(disagreements, 0);
    assert!(contacts + free >= 100_000 && contacts > 40_000 && free > 40_000);
    // Grazing multiplies the band by up to √(2r/band); steep contacts multiply it by √2 at most.
    assert!(worst_steep <= BAND, "{worst_steep}");
}

/// A motion of a few pieces, mostly gentle.
fn motion(draw: &mut Draw, from: Point) -> Trajectory {
    let mut motion = Trajectory::new(State { position: from, velocity: draw.direction() * draw.between(0.0, 3.0) });
    for _ in 0..draw.below(5) {
        let acceleration = if draw.below(4) == 0 { Vector::zeros() } else { draw.direction() * draw.between(0.0, 5.0) };
        motion.push(draw.between(0.05, 1.0), acceleration);
    }
    motion
}

/// When the distance first comes down to `level`, by steps that cannot overlook it: distances change by `rate` at most.
fn advance(distance: impl Fn(f64) -> f64, rate: f64, level: f64, until: f64) -> Option<f64> {
    let mut t = 0.0;
    while t <= until {
        let above = distance(t) - level;
        // A tenth of the band; it ends the geometric approach.
        if above <= 0.1 * BAND {
            return Some(t);
        }
        t += above / rate.max(1e-12);
    }
    None
}

/// Greatest speed of one motion seen from the other.
fn rate(a: &Trajectory, b: Option<&Trajectory>, w: Vector) -> f64 {
    a.peaks().speed + b.map_or(w.norm(), |b| b.peaks().speed)
}

#[test]
fn accelerated_motions_agree_with_conservative_advancement() {
    const CASES: usize = 4000;
    let mut draw = Draw::new(77);
    let (mut contacts, mut free, mut in_band) = ([0; 4], 0, 0);
    let mut worst_clearance = 0.0f64;
    for case in 0..CASES {
        let kind = case % 4;
        let centre = draw.point(Point::origin(), 3.0);
        let shape = draw.shape(kind, centre, 0.8);
        let robot_radius = draw.between(0.01, 0.2);
        let world =
            World::new(&env_model::Scene { robot_radius, field: None, ..field(vec![Obstacle::from(shape.clone())]) })
                .unwrap();
        let from = centre + draw.direction() * draw.between(0.3, 2.5);
        let mut robot = motion(&mut draw, from);
        if draw.below(4) > 0 {
            // Towards it at first.
            let velocity = (centre - from) * draw.between(0.2, 1.5) + draw.direction() * draw.between(0.0, 1.0);
            let pieces = robot.pieces().to_vec();
            robot.begin(State { position: from, velocity });
            pieces.iter().for_each(|piece| robot.push(piece.duration, piece.acceleration));
        }
        let (w, other) = (draw.direction() * draw.between(0.0, 2.0), motion(&mut draw, Point::new(1.0, 1.0)));
        let path = if draw.below(2) == 0 { Path::Velocity(w) } else { Path::Trajectory(&other) };
        let other = matches!(path, Path::Trajectory(_)).then_some(&other);
        let mover = Mover { shape: world.obstacles()[0].clone(), path, margin: 0.0, side: Side::Mate, braking: None };
        let until = draw.between(0.5, 3.0);
        let margin = if draw.below(2) == 0 { 0.0 } else { 0.1 };

        // Seen from the mover, written anew.
        let distance = |t: f64| {
            let seen = robot.state(t).position - other.map_or(w * t, |o| o.state(t).position - o.start().position);
            point_oracle(&shape, robot_radius + margin, seen)
        };
        let rate = rate(&robot, other, w);
        let (early, late) = (advance(distance, rate, BAND, until), advance(distance, rate, -BAND, until));
        let ours = meets(&robot, &mover, margin, until);
        let context = format!("case {case}: {ours:?}, oracle {early:?} to {late:?}, {shape:?}, {robot:?}, {mover:?}");
        match (early, late) {
            (None, _) => {
                assert_eq!(ours, None, "{context}");
                free += 1;
            }
            (Some(early), Some(late)) => {
                let t = ours.unwrap_or_else(|| panic!("{context}"));
                // Rounding of a time.
                assert!(early <= t + 1e-12 && t <= late + 1e-12, "{context}");
                contacts[kind] += 1;
            }
            (Some(early), None) => {
                assert!(ours.is_none_or(|t| early <= t + 1e-12), "{context}");
                in_band += 1;
            }
        }

        // The least clearance: no sample is below it, and some point reaches it.
        let (t, least) = least_clearance(&robot, &mover, until);
        let distance = |t: f64| distance(t) + margin;
        if least >= 0.0 {
            assert!((distance(t) - least).abs() <= BAND, "{least} at {t}, {context}");
            let samples = 300;
            let sampled = (0..=samples)
                .map(|i| distance(until * f64::from(i) / f64::from(samples)))
                .fold(f64::INFINITY, f64::min);
            let between = 0.5 * rate * until / f64::from(samples);
            worst_clearance = worst_clearance.max(least - sampled);
            assert!(least <= sampled + BAND && least >= sampled - between - BAND, "{least} {sampled}, {context}");
        }
    }
    println!(
        "{CASES} cases: {contacts:?} meet, {free} do not, {in_band} in the band; {worst_clearance:e} above a sample"
    );
    assert!(contacts.iter().all(|n| *n > CASES / 20) && free > CASES / 5);
}

#[test]
fn first_contact_with_the_world_agrees_with_conservative_advancement() {
    let mut draw = Draw::new(5);
    let (mut border, mut obstacle, mut mover_first, mut free) = (0, 0, 0, 0);
    for case in 0..1500 {
        let shapes: Vec<Shape> = (0..draw.below(6))
            .map(|k| {
                let centre = draw.point(Point::origin(), 5.0);
                draw.shape(k % 4, centre, 0.5)
            })
            .collect();
        let scene =
            env_model::Scene { robot_radius: 0.09, ..field(shapes.iter().cloned().map(Obstacle::from).collect()) };
        let world = World::new(&scene).unwrap();
        let from = draw.point(Point::origin(), 4.0);
        let robot = motion(&mut draw, from);
        let (q, w) = (draw.point(Point::origin(), 4.0), draw.direction() * 2.0);
        let movers = [Mover::disc(q, 0.18, Path::Velocity(w), Side::Opponent)];
        let distances = |t: f64| {
            let p = robot.state(t).position;
            let inside = (p.x + 5.91).min(5.91 - p.x).min(p.y + 4.41).min(4.41 - p.y);
            let obstacles = shapes.iter().map(|s| point_oracle(s, 0.09, p)).fold(f64::INFINITY, f64::min);
            [inside, obstacles, (p - (q + w * t)).norm() - 0.18]
        };
        let distance = |t: f64| distances(t).into_iter().fold(f64::INFINITY, f64::min);
        let rate = rate(&robot, None, w);
        // The world's slack is 7.5e-9 m: of a diagonal of 15 m, 1e-9, half.
        let band = world.slack() + BAND;
        let (early, late) = (advance(distance, rate, BAND, 4.0), advance(distance, rate, -band, 4.0));
        let ours = first_contact(&robot, &world, &movers, 4.0);
        let context = format!("case {case}: {ours:?}, oracle {early:?} to {late:?}");
        match (early, late) {
            (None, _) => {
                assert_eq!(ours, None, "{context}");
                free += 1;
            }
            (Some(early), late) => {
                assert!(ours.is_some() || late.is_none(), "{context}");
                let Some(contact) = ours else { continue };
                assert!(early <= contact.time + 1e-12, "{context}");
                assert!(late.is_none_or(|late| contact.time <= late + 1e-12), "{context}");
                let [inside, obstacles, moving] = distances(contact.time);
                let (d, count) = match contact.with {
                    Touched::Border => (inside, &mut border),
                    Touched::Obstacle(_) => (obstacles, &mut obstacle),
                    Touched::Mover(_) => (moving, &mut mover_first),
                };
                *count += 1;
                assert!(d <= BAND, "{d} from what it touches, {context}");
            }
        }
    }
    println!("{border} leave the field, {obstacle} hit an obstacle, {mover_first} the mover, {free} nothing");
    assert!(border > 100 && obstacle > 100 && mover_first > 30 && free > 100);
}

#[test]
fn touching_is_no_contact_and_entering_is() {
    let at = |x: f64, v: f64| Trajectory::new(State { position: Point::new(x, 0.3), velocity: Vector::new(v, 0.0) });
    // Sums of radii and positions that are not exact in binary.
    let mut draw = Draw::new(1);
    for (centre, radius) in (0..500).map(|_| (draw.between(-6.0, 6.0), draw.between(0.02, 1.0))) {
        let mover = Mover::disc(Point::new(centre, 0.3), radius, Path::Velocity(Vector::zeros()), Side::Other);
        let side = centre + radius;
        assert_eq!(meets(&at(side, 0.0), &mover, 0.0, 5.0), None, "rests beside {centre}");
        assert_eq!(meets(&at(side, 1.0), &mover, 0.0, 5.0), None, "leaves {centre}");
        let t = meets(&at(side, -1.0), &mover, 0.0, 5.0).expect("enters");
        // A few roundings of coordinates below 8.
        assert!(t < 1e-14, "{t}");
        assert_eq!(meets(&at(side - 1e-9, 1.0), &mover, 0.0, 5.0), Some(0.0), "starts 1e-9 m inside {centre}");
    }
}

#[test]
fn a_piece_that_brakes_into_touch_stays_outside() {
    // Stops exactly at the border of the disc, from 1 m/s at 1 m/s² on 0.5 m.
    let disc = env_model::Inflated { core: env_model::Core::Point(Point::new(2.0, 0.0)), radius: 0.5 };
    let piece = Piece {
        duration: 1.0,
        position: Point::new(1.0, 0.0),
        velocity: Vector::new(1.0, 0.0),
        acceleration: Vector::new(-1.0, 0.0),
    };
    assert_eq!(nearest(&piece, &disc).1, 0.0);
    assert_eq!(env_model::motion::contact::enters(&piece, &disc, 0.0), None);
    let faster = Piece { velocity: Vector::new(1.0 + 1e-9, 0.0), ..piece };
    assert!(env_model::motion::contact::enters(&faster, &disc, 0.0).is_some_and(|t| t > 0.99));
}
