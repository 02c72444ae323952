//! Adaptive rates of crossover and mutation.
//!
//! Srinivas & Patnaik, "Adaptive probabilities of crossover and mutation in genetic
//! algorithms", *IEEE Trans. Systems, Man and Cybernetics* 24(4), 1994, 656–667:
//! Pc = k1 (fmax − f')/(fmax − favg) for f' ≥ favg, else k3, f' the larger fitness of
//! the two parents; Pm = k2 (fmax − f)/(fmax − favg) for f ≥ favg, else k4. The
//! fittest individual is spared, those below average are broken up.

/// What an individual's fitness is measured against.
#[derive(Debug, Clone, Copy)]
pub struct Level {
    /// favg of the population.
    pub mean: f64,
    /// fmax of the population.
    pub max: f64,
}

impl Level {
    /// `fit`·(fmax − f)/(fmax − favg) for f ≥ favg, else `unfit`. Where all are
    /// equally fit (fmax = favg, a quotient 0/0) the rate is `unfit`: the
    /// population has converged, and nothing would be lost by a change.
    pub fn rate(self, fit: f64, unfit: f64, fitness: f64) -> f64 {
        if fitness < self.mean || self.max <= self.mean {
            unfit
        } else {
            fit * (self.max - fitness) / (self.max - self.mean)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_fall_from_k_at_the_mean_to_zero_at_the_best() {
        let level = Level { mean: 2.0, max: 6.0 };
        assert_eq!(level.rate(1.0, 0.9, 2.0), 1.0, "at the mean");
        assert_eq!(level.rate(1.0, 0.9, 3.0), 0.75);
        assert_eq!(level.rate(0.5, 0.5, 5.0), 0.125);
        assert_eq!(level.rate(1.0, 1.0, 6.0), 0.0, "the best");
        assert_eq!(level.rate(1.0, 0.9, 1.9), 0.9, "below the mean");
    }

    #[test]
    fn equal_fitness_divides_by_nothing() {
        let level = Level { mean: 2.0, max: 2.0 };
        assert_eq!(level.rate(1.0, 0.7, 2.0), 0.7);
        // A mean that rounding has lifted above the maximum.
        let level = Level { mean: 2.000_000_000_000_1, max: 2.0 };
        assert_eq!(level.rate(1.0, 0.7, 2.0), 0.7);
    }
}
