//! What the tests of collision and motion share: seeded numbers, and distances by parry.

#![allow(dead_code, reason = "no test file uses all of it")]

use env_model::motion::{Limits, State, Trajectory, least_time};
use env_model::{Obstacle, Point, Polygon, Scene, Shape, Vector};
use parry2d_f64::math::Vector as ParryVector;
use parry2d_f64::query::PointQuery;
use parry2d_f64::shape::Segment;
use parry2d_f64::utils::point_in_poly2d;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Seeded numbers and shapes.
pub struct Draw(ChaCha8Rng);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.0.next_u64() % n as u64) as usize
    }

    /// Uniform in its logarithm.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.between(low.log10(), high.log10()))
    }

    pub fn sign(&mut self) -> f64 {
        [-1.0, 1.0][self.below(2)]
    }

    pub fn direction(&mut self) -> Vector {
        let angle = self.between(0.0, std::f64::consts::TAU);
        Vector::new(angle.cos(), angle.sin())
    }

    pub fn point(&mut self, centre: Point, half: f64) -> Point {
        centre + Vector::new(self.between(-half, half), self.between(-half, half))
    }

    /// Corners at rising angles round `centre`; convex when all are on one circle.
    pub fn polygon(&mut self, centre: Point, scale: f64, convex: bool) -> Vec<[f64; 2]> {
        loop {
            let n = 3 + self.below(8);
            let turn = self.between(0.0, std::f64::consts::TAU);
            let mut corners: Vec<[f64; 2]> = (0..n)
                .map(|i| {
                    let angle = turn + (i as f64 + self.between(0.0, 0.8)) * std::f64::consts::TAU / n as f64;
                    let radius = if convex { scale } else { scale * self.between(0.15, 1.0) };
                    (centre + Vector::new(angle.cos(), angle.sin()) * radius).into()
                })
                .collect();
            if self.below(2) == 0 {
                corners.reverse();
            }
            if Polygon::new(corners.iter().map(|c| (*c).into()).collect()).is_ok() {
                return corners;
            }
        }
    }

    pub fn shape(&mut self, kind: usize, centre: Point, scale: f64) -> Shape {
        match kind {
            0 => Shape::Disc { centre: centre.into(), radius: scale * self.between(0.01, 1.0) },
            1 => {
                let (from, to) = (self.point(centre, scale).into(), self.point(centre, scale).into());
                Shape::Capsule { from, to, radius: scale * self.between(0.01, 0.6) }
            }
            2 => Shape::Polygon(self.polygon(centre, scale, true)),
            _ => Shape::Polygon(self.polygon(centre, scale, false)),
        }
    }
}

pub fn pv(p: Point) -> ParryVector {
    ParryVector::new(p.x, p.y)
}

pub fn to_point(p: [f64; 2]) -> Point {
    p.into()
}

/// The corners of a shape's core (one for a disc, two for a capsule) and its own radius.
pub fn core(shape: &Shape) -> (Vec<Point>, f64) {
    match shape {
        Shape::Disc { centre, radius } => (vec![to_point(*centre)], *radius),
        Shape::Capsule { from, to, radius } => (vec![to_point(*from), to_point(*to)], *radius),
        Shape::Polygon(corners) => (corners.iter().map(|c| to_point(*c)).collect(), 0.0),
    }
}

pub fn point_segment(p: Point, a: Point, b: Point) -> f64 {
    let proj = Segment::new(pv(a), pv(b)).project_local_point(pv(p), true);
    (proj.point - pv(p)).length()
}

pub fn inside(p: Point, corners: &[Point]) -> bool {
    point_in_poly2d(pv(p), &corners.iter().map(|c| pv(*c)).collect::<Vec<_>>())
}

pub fn sides(corners: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    (0..corners.len()).map(move |i| (corners[i], corners[(i + 1) % corners.len()]))
}

/// Signed distance of a point to an inflated shape.
pub fn point_oracle(shape: &Shape, robot_radius: f64, p: Point) -> f64 {
    let (corners, radius) = core(shape);
    let d = match corners.as_slice() {
        [c] => (p - c).norm(),
        [c, d] => point_segment(p, *c, *d),
        _ => {
            let d = sides(&corners).map(|(c, e)| point_segment(p, c, e)).fold(f64::INFINITY, f64::min);
            if inside(p, &corners) { -d } else { d }
        }
    };
    d - radius - robot_radius
}

/// What robots of the league can do, and a little beyond.
pub fn limits(draw: &mut Draw) -> Limits {
    Limits::new(draw.log(0.3, 6.0), draw.log(0.5, 8.0)).unwrap()
}

/// A field of 12 × 9 m for a robot that is a point.
pub fn field(obstacles: Vec<Obstacle>) -> Scene {
    Scene {
        name: "field".into(),
        unit: "m".into(),
        robot_radius: 0.0,
        start: [-6.0, -4.5],
        goal: [6.0, 4.5],
        field: Some(env_model::scene::Field { min: [-6.0, -4.5], max: [6.0, 4.5] }),
        obstacles,
    }
}

/// Begins with `start`, ends at rest at `goal`, keeps its limits, has no gaps, and is no quicker than possible.
pub fn check_motion(motion: &Trajectory, start: State, goal: Point, limits: Limits, context: &str) {
    assert_eq!(motion.start().position, start.position, "{context}");
    assert!((motion.start().velocity - start.velocity).norm() <= 1e-12 * start.velocity.norm(), "{context}");
    assert_eq!(motion.end(), State::at_rest(goal), "{context}");
    let peaks = motion.peaks();
    // The acceptance: 1e-9 relative. A start above the limit brakes at once.
    let top = limits.speed.max(start.velocity.norm());
    assert!(peaks.speed <= top * (1.0 + 1e-9), "{peaks:?}, {context}");
    assert!(peaks.acceleration <= limits.acceleration * (1.0 + 1e-9), "{peaks:?}, {context}");
    // Gaps of position and velocity between the pieces, at field scale.
    let next = motion.pieces().iter().skip(1).map(|p| State { position: p.position, velocity: p.velocity });
    let mut braked = start.velocity.norm() <= limits.speed;
    for (i, (piece, next)) in motion.pieces().iter().zip(next.chain([motion.end()])).enumerate() {
        assert!(piece.duration > 0.0 && piece.duration.is_finite(), "{piece:?}, {context}");
        let end = piece.state(piece.duration);
        let gap = (end.position - next.position).norm().max((end.velocity - next.velocity).norm());
        assert!(gap <= 1e-9, "gap of {gap:e} after piece {i}, {context}");
        braked |= piece.velocity.norm() <= limits.speed * (1.0 + 1e-9);
        assert!(!braked || end.velocity.norm() <= limits.speed * (1.0 + 1e-9), "piece {i}, {context}");
    }
    let least = least_time(start, goal, limits);
    assert!(motion.duration() >= least * (1.0 - 1e-12), "{} below {least}, {context}", motion.duration());
}
