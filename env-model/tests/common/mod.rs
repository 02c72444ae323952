//! What the tests of motion share.

#![allow(dead_code, reason = "no test file uses all of it")]

use env_model::motion::{Limits, State, Trajectory, least_time};
use env_model::{Obstacle, Point, Scene, Vector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Seeded numbers.
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

    pub fn direction(&mut self) -> Vector {
        let angle = self.between(0.0, std::f64::consts::TAU);
        Vector::new(angle.cos(), angle.sin())
    }

    /// A point of a field of 12 × 9 m.
    pub fn point(&mut self) -> Point {
        Point::new(self.between(-6.0, 6.0), self.between(-4.5, 4.5))
    }
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
