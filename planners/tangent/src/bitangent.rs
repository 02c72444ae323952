//! Common tangents of oriented circles, without trigonometry.
//!
//! A path with unit heading u touches the circle (c, ρ) at p = c − ρ u⊥, where
//! (x, y)⊥ = (−y, x): ρ > 0 is passed counter-clockwise (centre on the left),
//! ρ < 0 clockwise. From (cᵢ, ρᵢ) to (cⱼ, ρⱼ), with D = cⱼ − cᵢ and
//! k = ρⱼ − ρᵢ, exactly one line touches both in their senses:
//!
//! D = ℓ u + k u⊥,  ℓ = √(|D|² − k²),  u = (ℓ D − k D⊥)/|D|².
//!
//! Equal signs give the external tangents, unequal ones the internal.

use std::f64::consts::{PI, TAU};

use env_model::geometry::cross;
use env_model::{Point, Vector};

/// A turn this much less than a whole one is none: rounding of the headings,
/// in radians. A path that turns back so little cuts 1e-22 r into its disc.
pub(crate) const NO_TURN: f64 = 1e-11;

/// v turned left by a right angle.
pub(crate) fn perp(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

/// A circle with a sense of rotation.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OrientedCircle {
    /// Its centre.
    pub centre: Point,
    /// Signed radius: positive counter-clockwise.
    pub rho: f64,
}

impl OrientedCircle {
    /// Where a path with unit heading `u` touches it.
    pub fn touch(&self, u: Vector) -> Point {
        self.centre - perp(u) * self.rho
    }

    /// Angle in [0, 2π) from heading `from` to heading `to` in its sense; 0 for a point.
    pub fn turn(&self, from: Vector, to: Vector) -> f64 {
        if self.rho == 0.0 {
            return 0.0;
        }
        let angle = libm::atan2(cross(from, to) * self.rho.signum(), from.dot(&to));
        let angle = if angle < 0.0 { angle + TAU } else { angle };
        if angle > TAU - NO_TURN { 0.0 } else { angle }
    }

    /// A lower bound of [`OrientedCircle::turn`] without trigonometry: with
    /// t = tan(φ/2) = sin φ/(1 + cos φ) ≤ 1, the series of the arc tangent
    /// brackets φ = 2 atan t between two terms and three. For cos φ < 0 take
    /// the complement, tan((π − φ)/2) = sin φ/(1 − cos φ).
    pub fn turn_at_least(&self, from: Vector, to: Vector) -> f64 {
        if self.rho == 0.0 {
            return 0.0;
        }
        let sin = cross(from, to) * self.rho.signum();
        let cos = from.dot(&to);
        let below = |t: f64| 2.0 * (t - t * t * t / 3.0);
        let above = |t: f64| 2.0 * t * (1.0 - t * t * (1.0 / 3.0 - 0.2 * t * t));
        match (sin >= 0.0, cos >= 0.0) {
            (true, true) => below(sin / (1.0 + cos)),
            (true, false) => PI - above(sin / (1.0 - cos)),
            (false, true) if -sin < 2.0 * NO_TURN => 0.0,
            (false, true) => TAU - above(-sin / (1.0 + cos)),
            (false, false) => PI + below(-sin / (1.0 - cos)),
        }
    }
}

/// The straight piece between two oriented circles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bitangent {
    /// u, unit length.
    pub heading: Vector,
    /// ℓ.
    pub length: f64,
}

impl Bitangent {
    /// The tangent from one circle to the other; `None` when one contains the
    /// other, or they overlap and the senses differ, by more than `tolerance`.
    pub fn between(from: &OrientedCircle, to: &OrientedCircle, tolerance: f64) -> Option<Self> {
        let d = to.centre - from.centre;
        let k = to.rho - from.rho;
        let d2 = d.norm_squared();
        let l2 = d2 - k * k;
        if l2 > 0.0 {
            let length = l2.sqrt();
            return Some(Self { heading: (d * length - perp(d) * k) / d2, length });
        }
        // Touching circles: |D| = |k| up to rounding.
        let distance = d2.sqrt();
        (d2 > 0.0 && k.abs() - distance <= tolerance)
            .then(|| Self { heading: perp(d) * (-k.signum() / distance), length: 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(x: f64, y: f64, rho: f64) -> OrientedCircle {
        OrientedCircle { centre: Point::new(x, y), rho }
    }

    #[test]
    fn the_four_tangents_touch_both_circles() {
        for (r, s) in [(2.0, 1.0), (-2.0, 1.0), (2.0, -1.0), (-2.0, -1.0), (0.0, 1.5), (1.0, 0.0)] {
            let (a, b) = (circle(1.0, -2.0, r), circle(4.0, 3.0, s));
            let t = Bitangent::between(&a, &b, 0.0).unwrap();
            let (p, q) = (a.touch(t.heading), b.touch(t.heading));
            // A dozen operations on numbers below 10, each rounded by 1e-16.
            assert!((q - p - t.heading * t.length).norm() < 1e-14);
            assert!((t.heading.norm() - 1.0).abs() < 1e-15);
            assert!(((p - a.centre).norm() - r.abs()).abs() < 1e-14 && ((q - b.centre).norm() - s.abs()).abs() < 1e-14);
        }
    }

    #[test]
    fn nested_and_overlapping_circles_have_fewer_tangents() {
        let a = circle(0.0, 0.0, 2.0);
        assert!(Bitangent::between(&a, &circle(0.5, 0.0, 1.0), 1e-12).is_none(), "nested");
        assert!(Bitangent::between(&a, &circle(2.0, 0.0, -1.0), 1e-12).is_none(), "overlapping, inner");
        assert!(Bitangent::between(&a, &circle(2.0, 0.0, 1.0), 1e-12).is_some(), "overlapping, outer");
        let touching = Bitangent::between(&a, &circle(3.0, 0.0, -1.0), 1e-12).unwrap();
        assert_eq!((touching.length, touching.heading), (0.0, Vector::new(0.0, 1.0)));
        assert!(Bitangent::between(&a, &a, 1e-12).is_none(), "the same circle");
    }

    #[test]
    fn turns_follow_the_sense() {
        let (east, north) = (Vector::new(1.0, 0.0), Vector::new(0.0, 1.0));
        let quarter = TAU / 4.0;
        assert_eq!(circle(0.0, 0.0, 1.0).turn(east, north), quarter);
        assert_eq!(circle(0.0, 0.0, -1.0).turn(east, north), 3.0 * quarter);
        assert_eq!(circle(0.0, 0.0, 0.0).turn(east, north), 0.0);
        let back = Vector::new(1.0, -1e-12);
        assert_eq!(circle(0.0, 0.0, 1.0).turn(east, back), 0.0, "rounding is no turn");
    }

    #[test]
    fn the_bound_of_a_turn_is_close_and_never_above() {
        let circle = circle(0.0, 0.0, 1.0);
        for i in 0..1000 {
            let angle = TAU * f64::from(i) / 1000.0;
            let (a, b) = (Vector::new(0.6, 0.8), libm::sincos(angle));
            let b = a * b.1 + perp(a) * b.0;
            let (turn, bound) = (circle.turn(a, b), circle.turn_at_least(a, b));
            // Rounding of the angles, then the next term of the series at t = 1: 2(1/5 − 0).
            assert!(bound <= turn + 1e-15 && bound >= turn - 0.4, "{angle}: {bound} for {turn}");
        }
    }
}
