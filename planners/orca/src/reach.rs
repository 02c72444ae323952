//! The velocities that a robot can have one period from now: a lens of two discs.

use env_model::Vector;
use env_model::motion::Limits;

/// What a linear programme seeks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Objective {
    /// The velocity nearest to this one.
    Nearest(Vector),
    /// The velocity furthest in this direction, a unit vector.
    Furthest(Vector),
}

/// {w : ‖w − v‖ ≤ a Δt, ‖w‖ ≤ s}.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Centres and radii.
    discs: [(Vector, f64); 2],
}

impl Reach {
    /// From velocity `v` in `period` seconds. A robot that is too fast can at least be slower.
    pub fn new(v: Vector, limits: Limits, period: f64) -> Self {
        let change = limits.acceleration * period;
        Self { discs: [(v, change), (Vector::zeros(), limits.speed.max(v.norm() - change))] }
    }

    /// The reachable velocity that serves `objective` best.
    pub fn best(&self, objective: Objective) -> Vector {
        let mut wanted = self.discs.map(|(c, r)| match objective {
            Objective::Nearest(w) if (w - c).norm_squared() <= r * r => w,
            Objective::Nearest(w) => c + (w - c).normalize() * r,
            Objective::Furthest(d) => c + d * r,
        });
        if let Objective::Nearest(w) = objective
            && wanted == [w, w]
        {
            return w;
        }
        // The optimum over one disc is that over the lens where it lies in the other; else it is a tip of the lens.
        for (i, w) in wanted.iter().enumerate() {
            let (c, r) = self.discs[1 - i];
            if (w - c).norm_squared() <= r * r {
                return *w;
            }
        }
        wanted = self.tips();
        let better = match objective {
            Objective::Nearest(w) => (wanted[1] - w).norm_squared() < (wanted[0] - w).norm_squared(),
            Objective::Furthest(d) => d.dot(&wanted[1]) > d.dot(&wanted[0]),
        };
        wanted[usize::from(better)]
    }

    /// Where the two circles meet; the nearest that there is to it where they only touch.
    fn tips(&self) -> [Vector; 2] {
        let [(c, r), (_, s)] = self.discs;
        let d = c.norm();
        let axis = if d > 0.0 { c / d } else { Vector::x() };
        let along = if d > 0.0 { 0.5 * (d * d + s * s - r * r) / d } else { s };
        let along = along.clamp(-s, s);
        let across = Vector::new(-axis.y, axis.x) * ((s - along) * (s + along)).sqrt();
        [axis * along + across, axis * along - across]
    }

    /// The parameters t for which `point` + t `direction` (a unit vector) is reachable; `None` where none is.
    pub fn chord(&self, point: Vector, direction: Vector) -> Option<(f64, f64)> {
        let mut chord = (f64::NEG_INFINITY, f64::INFINITY);
        for (c, r) in self.discs {
            let to = point - c;
            let middle = -to.dot(&direction);
            let squared = middle * middle + r * r - to.norm_squared();
            if squared < 0.0 {
                return None;
            }
            let half = squared.sqrt();
            chord = (chord.0.max(middle - half), chord.1.min(middle + half));
        }
        (chord.0 <= chord.1).then_some(chord)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn optima_lie_in_the_lens_and_none_is_better() {
        let limits = Limits::new(3.0, 3.0).unwrap();
        for v in [Vector::zeros(), Vector::new(2.8, 0.0), Vector::new(0.0, -3.0), Vector::new(2.0, 2.4)] {
            let reach = Reach::new(v, limits, 0.2);
            let inside = |w: Vector| reach.discs.iter().all(|(c, r)| (w - c).norm() <= r * (1.0 + 1e-12) + 1e-12);
            for i in 0..40 {
                let angle = f64::from(i) * 0.157;
                let d = Vector::new(angle.cos(), angle.sin());
                let target = d * 0.17 * f64::from(i);
                let (near, far) = (reach.best(Objective::Nearest(target)), reach.best(Objective::Furthest(d)));
                assert!(inside(near) && inside(far), "{v} {target}");
                // A grid over the reachable square as the oracle; the 1e-9 is rounding, many times over.
                for k in 0..1600 {
                    let w = v + Vector::new(f64::from(k % 40) - 19.5, f64::from(k / 40) - 19.5) * (0.6 / 19.5);
                    if reach.discs.iter().all(|(c, r)| (w - c).norm() <= *r) {
                        assert!((near - target).norm() <= (w - target).norm() + 1e-9, "{v} {target} {w}");
                        assert!(d.dot(&far) >= d.dot(&w) - 1e-9, "{v} {d} {w}");
                    }
                }
            }
        }
    }
}
