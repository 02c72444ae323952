//! What planners whose objective is length with a penalty tell observers.

use env_model::{Point, path_length};

/// Sums of the same lengths in another order differ by their rounding; a penalty worth its name is far above it.
const ROUNDING: f64 = 1e-9;

/// The least cost that was a path's length and not a penalty: +∞ until there is one.
///
/// A penalty of thousands of metres says nothing about how far from the optimum a planner is; it has no path yet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told(f64);

impl Default for Told {
    fn default() -> Self {
        Self(f64::INFINITY)
    }
}

impl Told {
    /// Takes note of the planner's best `path`, which costs `cost`.
    pub fn improve(&mut self, cost: f64, path: &[Point]) {
        if cost < self.0 && cost <= path_length(path) * (1.0 + ROUNDING) {
            self.0 = cost;
        }
    }

    /// The cost to tell.
    pub fn cost(self) -> f64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn penalties_are_not_told() {
        let path = [Point::new(0.0, 0.0), Point::new(3.0, 4.0)];
        let mut told = Told::default();
        told.improve(5000.0, &path);
        assert_eq!(told.cost(), f64::INFINITY);
        told.improve(5.0 + 1e-15, &path);
        assert_eq!(told.cost(), 5.0 + 1e-15);
        told.improve(4.0, &path[..1]);
        assert_eq!(told.cost(), 5.0 + 1e-15, "cheaper, but no length");
    }
}
