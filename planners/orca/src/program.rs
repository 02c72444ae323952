//! Linear programmes over half-planes of velocities, as RVO2's Agent.cc solves them (its linearProgram1, 2 and 3).
//!
//! Half-planes are added one at a time (de Berg et al., *Computational Geometry*, ch. 4): an optimum that the next one
//! forbids moves onto its border, where the programme has one dimension. Expected linear, at worst quadratic in their
//! number. The region is the lens of reachable velocities instead of RVO2's disc of permitted speeds.

use env_model::Vector;
use env_model::geometry::cross;

use crate::reach::{Objective, Reach};

/// Sine below which two borders count as parallel.
const PARALLEL: f64 = 1e-10;

/// A half-plane of permitted velocities: what lies to the left of its border.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfPlane {
    /// On the border.
    pub point: Vector,
    /// Along the border, a unit vector.
    pub direction: Vector,
}

impl HalfPlane {
    /// How far `v` lies outside, in units of speed; negative inside.
    pub fn violation(&self, v: Vector) -> f64 {
        cross(self.direction, self.point - v)
    }
}

/// The best velocity on the border of `planes[i]` that all before it permit, if there is one.
fn on_border(planes: &[HalfPlane], i: usize, reach: &Reach, objective: Objective) -> Option<Vector> {
    let HalfPlane { point, direction } = planes[i];
    let (mut low, mut high) = reach.chord(point, direction)?;
    for other in &planes[..i] {
        let sine = cross(direction, other.direction);
        let offset = cross(other.direction, point - other.point);
        if sine.abs() <= PARALLEL {
            if offset < 0.0 {
                return None;
            }
            continue;
        }
        let t = offset / sine;
        (low, high) = if sine > 0.0 { (low, high.min(t)) } else { (low.max(t), high) };
        if low > high {
            return None;
        }
    }
    Some(match objective {
        Objective::Nearest(w) => point + direction * direction.dot(&(w - point)).clamp(low, high),
        Objective::Furthest(d) if d.dot(&direction) > 0.0 => point + direction * high,
        Objective::Furthest(_) => point + direction * low,
    })
}

/// The best reachable velocity in all `planes`; where there is none, the best in those before the first one that leaves
/// nothing, and which one that is.
pub fn solve(planes: &[HalfPlane], reach: &Reach, objective: Objective) -> (Vector, Option<usize>) {
    let mut best = reach.best(objective);
    for (i, plane) in planes.iter().enumerate() {
        if plane.violation(best) > 0.0 {
            match on_border(planes, i, reach, objective) {
                Some(v) => best = v,
                None => return (best, Some(i)),
            }
        }
    }
    (best, None)
}

/// The velocity whose greatest violation of the half-planes from `hard` on is least, those before being kept: the
/// linear programme in three dimensions that takes over when `planes[failed]` left nothing, and `best` before it.
/// `buffer` is for its own use.
pub fn least_violation(
    planes: &[HalfPlane],
    hard: usize,
    failed: usize,
    reach: &Reach,
    mut best: Vector,
    buffer: &mut Vec<HalfPlane>,
) -> Vector {
    let mut most = 0.0;
    for (i, plane) in planes.iter().enumerate().skip(failed) {
        if plane.violation(best) <= most {
            continue;
        }
        buffer.clear();
        buffer.extend_from_slice(&planes[..hard]);
        // Where a half-plane before is violated no more than this one.
        for other in &planes[hard..i] {
            let sine = cross(plane.direction, other.direction);
            let point = if sine.abs() > PARALLEL {
                plane.point + plane.direction * (cross(other.direction, plane.point - other.point) / sine)
            } else if plane.direction.dot(&other.direction) > 0.0 {
                continue;
            } else {
                (plane.point + other.point) * 0.5
            };
            buffer.push(HalfPlane { point, direction: (other.direction - plane.direction).normalize() });
        }
        let inwards = Vector::new(-plane.direction.y, plane.direction.x);
        // The best so far is feasible by construction; where rounding denies it, it stays.
        if let (v, None) = solve(buffer, reach, Objective::Furthest(inwards)) {
            best = v;
        }
        most = plane.violation(best);
    }
    best
}

#[cfg(test)]
mod tests {
    use env_model::motion::Limits;

    use super::*;

    /// Permits v·(cos, sin) ≥ d.
    fn beyond(angle: f64, d: f64) -> HalfPlane {
        let n = Vector::new(angle.cos(), angle.sin());
        HalfPlane { point: n * d, direction: Vector::new(n.y, -n.x) }
    }

    fn wide() -> Reach {
        Reach::new(Vector::zeros(), Limits::new(1.0, 100.0).unwrap(), 1.0)
    }

    #[test]
    fn hand_worked_programmes() {
        use std::f64::consts::PI;
        let none = solve(&[], &wide(), Objective::Nearest(Vector::new(2.0, 0.0)));
        assert_eq!(none, (Vector::new(1.0, 0.0), None));
        // x ≤ ½ and y ≥ ¼.
        let (v, failed) =
            solve(&[beyond(PI, -0.5), beyond(0.5 * PI, 0.25)], &wide(), Objective::Nearest(Vector::new(2.0, 0.0)));
        assert!((v - Vector::new(0.5, 0.25)).norm() < 1e-15 && failed.is_none(), "{v}");
        // x ≥ ½ and x ≤ −¼: nothing; the least violation lies halfway, 3/8 each.
        let planes = [beyond(0.0, 0.5), beyond(PI, 0.25)];
        let (best, failed) = solve(&planes, &wide(), Objective::Nearest(Vector::zeros()));
        assert_eq!(failed, Some(1));
        let v = least_violation(&planes, 0, 1, &wide(), best, &mut Vec::new());
        assert!((v.x - 0.125).abs() < 1e-15, "{v}");
        // With the first one hard it is kept.
        let v = least_violation(&planes, 1, 1, &wide(), best, &mut Vec::new());
        assert!((v.x - 0.5).abs() < 1e-15, "{v}");
    }

    #[test]
    fn the_fallback_finds_the_least_violation() {
        let mut state = 7;
        let mut draw = || planner_api::seed::splitmix64(&mut state) as f64 / 2f64.powi(64);
        let mut infeasible = 0;
        for _ in 0..300 {
            let planes: Vec<_> = (0..5).map(|_| beyond(draw() * 6.283, draw() - 0.2)).collect();
            let reach = wide();
            let (best, failed) = solve(&planes, &reach, Objective::Nearest(Vector::zeros()));
            let worst = |v: Vector| planes.iter().map(|p| p.violation(v)).fold(f64::NEG_INFINITY, f64::max);
            let grid = (0..40_000)
                .map(|k| Vector::new(f64::from(k % 200) - 99.5, f64::from(k / 200) - 99.5) / 99.5)
                .filter(|v| v.norm() <= 1.0);
            let least = grid.map(worst).fold(f64::INFINITY, f64::min);
            let Some(failed) = failed else {
                assert!(worst(best) < 1e-12, "{}", worst(best));
                continue;
            };
            infeasible += 1;
            let v = least_violation(&planes, 0, failed, &reach, best, &mut Vec::new());
            // The grid's best is never better than the optimum.
            assert!(worst(v) <= least + 1e-12 && v.norm() <= 1.0 + 1e-12, "{} {least}", worst(v));
        }
        assert!(infeasible > 50, "{infeasible}");
    }
}
