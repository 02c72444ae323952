//! Repulsion from obstacles and robots (Balch & Arkin 1998, avoid-static-obstacle and avoid-robot).

use env_model::Vector;

/// What a repulsion within the margin M is: the source says infinite. Against it no other behaviour counts.
pub const VERY_LARGE: f64 = 1e4;

/// The strength at distance `d`: 0 beyond `sphere` (S), (S − d)/(S − M) down to `margin` (M), [`VERY_LARGE`] within.
pub fn repulsion(d: f64, margin: f64, sphere: f64) -> f64 {
    if d > sphere {
        0.0
    } else if d > margin {
        (sphere - d) / (sphere - margin)
    } else {
        VERY_LARGE
    }
}

/// The sum of several repulsions, no longer than the longest of them: three robots in a row repel like one.
#[derive(Debug, Clone, Copy, Default)]
pub struct Repulsions {
    sum: Vector,
    largest: f64,
}

impl Repulsions {
    /// Adds one of `strength` ≥ 0 along the unit vector `away`.
    pub fn add(&mut self, strength: f64, away: Vector) {
        self.sum += away * strength;
        self.largest = self.largest.max(strength);
    }

    /// Whether nothing repels.
    pub fn is_empty(&self) -> bool {
        self.largest == 0.0
    }

    /// The capped sum.
    pub fn total(&self) -> Vector {
        let length = self.sum.norm();
        if length > self.largest { self.sum * (self.largest / length) } else { self.sum }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_zone_by_hand() {
        assert_eq!(repulsion(5.01, 1.0, 5.0), 0.0);
        assert_eq!(repulsion(5.0, 1.0, 5.0), 0.0);
        assert_eq!(repulsion(2.0, 1.0, 5.0), 0.75);
        assert_eq!(repulsion(1.0, 1.0, 5.0), VERY_LARGE);
        assert_eq!(repulsion(-0.5, 1.0, 5.0), VERY_LARGE, "penetration");
    }

    #[test]
    fn the_sum_is_capped_at_the_longest() {
        let (x, y) = (Vector::x(), Vector::y());
        let sum = |terms: &[(f64, Vector)]| {
            let mut all = Repulsions::default();
            terms.iter().for_each(|(strength, away)| all.add(*strength, *away));
            all.total()
        };
        assert_eq!(sum(&[]), Vector::zeros());
        assert_eq!(sum(&[(0.5, x), (0.25, x)]), x * 0.5, "0.75 along x, cut to 0.5");
        assert_eq!(sum(&[(0.5, x), (0.5, -x)]), Vector::zeros());
        // (0.6, 0.8) has length 1, above 0.8.
        assert!((sum(&[(0.6, x), (0.8, y)]) - Vector::new(0.48, 0.64)).norm() < 1e-15);
        assert_eq!(sum(&[(1.0, x), (0.5, -x)]), x * 0.5, "what is shorter stays");
    }
}
