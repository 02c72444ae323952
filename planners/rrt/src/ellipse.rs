//! The informed set: where a path shorter than the best one may pass.
//!
//! {x : ‖x − start‖ + ‖x − goal‖ ≤ c}, an ellipse with its foci at start and goal,
//! b = ‖goal − start‖ apart: semi-axes c/2 and √(c² − b²)/2.
//!
//! Gammell, Srinivasa & Barfoot, "Informed RRT*", IROS 2014, 2997–3004, §V
//! (doi 10.1109/IROS.2014.6942976).

use std::f64::consts::PI;

use env_model::{Point, Vector};

use crate::sampler::Sampler;

/// The ellipses with foci at start and goal; they differ in c.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ellipse {
    start: Point,
    goal: Point,
    shortest: f64,
}

impl Ellipse {
    /// Start and goal differ.
    pub fn new(start: Point, goal: Point) -> Self {
        Self { start, goal, shortest: (goal - start).norm() }
    }

    /// Semi-axes along and across the line from start to goal.
    fn semi_axes(&self, cost: f64) -> (f64, f64) {
        // c² − b² as a product: no cancellation when the ellipse is thin.
        let across = (cost - self.shortest).max(0.0) * (cost + self.shortest);
        (0.5 * cost, 0.5 * across.sqrt())
    }

    pub fn area(&self, cost: f64) -> f64 {
        let (along, across) = self.semi_axes(cost);
        PI * along * across
    }

    pub fn contains(&self, p: Point, cost: f64) -> bool {
        (p - self.start).norm() + (p - self.goal).norm() <= cost
    }

    /// Uniform in the ellipse of paths no longer than `cost`: the unit disc, stretched, turned, moved.
    pub fn sample(&self, cost: f64, sampler: &mut Sampler) -> Point {
        let (along, across) = self.semi_axes(cost);
        let unit = sampler.in_disc();
        let axis = (self.goal - self.start) / self.shortest;
        let centre = self.start + (self.goal - self.start) * 0.5;
        centre + axis * (along * unit.x) + Vector::new(-axis.y, axis.x) * (across * unit.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_lie_inside_and_fill_the_ellipse_evenly() {
        // Foci 3-4-5 apart; c = 13 gives semi-axes 6.5 and √(169 − 25)/2 = 6.
        let (start, goal) = (Point::new(1.0, 2.0), Point::new(4.0, 6.0));
        let ellipse = Ellipse::new(start, goal);
        assert_eq!(ellipse.semi_axes(13.0), (6.5, 6.0));
        // Two products, each rounded once.
        assert!((ellipse.area(13.0) / (PI * 39.0) - 1.0).abs() < 1e-15);
        for cost in [5.000_000_1, 5.1, 7.0, 13.0] {
            let (along, across) = ellipse.semi_axes(cost);
            let mut sampler = Sampler::new(3);
            let (n, mut squares) = (20_000, [0.0; 2]);
            for _ in 0..n {
                let p = ellipse.sample(cost, &mut sampler);
                let sum = (p - start).norm() + (p - goal).norm();
                // Coordinates below 16 carry rounding errors of about 1e-15 each.
                assert!(sum <= cost + 1e-14, "{sum} > {cost}");
                let d = p - Point::new(2.5, 4.0);
                let (u, v) = (d.dot(&Vector::new(0.6, 0.8)) / along, d.dot(&Vector::new(-0.8, 0.6)) / across);
                squares[0] += u * u / f64::from(n);
                squares[1] += v * v / f64::from(n);
            }
            // A uniform unit disc has E[u²] = 1/4 and Var[u²] = 1/8 − 1/16 = 1/16: a standard error
            // of 0.25/√20000 = 0.0018. Five of them.
            for mean in squares {
                assert!((mean - 0.25).abs() < 0.009, "{mean}");
            }
        }
    }
}
