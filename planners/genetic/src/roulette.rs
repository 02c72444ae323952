//! Roulette-wheel selection (Fang 2009, §4.5.5; fig. 4.3): P(xᵢ) = F(xᵢ)/Σⱼ F(xⱼ).

use crate::dice::Dice;

/// A wheel whose sectors are as wide as the fitness.
#[derive(Debug, Clone, Default)]
pub struct Roulette {
    /// Where each sector ends.
    ends: Vec<f64>,
}

impl Roulette {
    /// Sets the wheel up for `fitness`, n > 0 values ≥ 0.
    pub fn set(&mut self, fitness: &[f64]) {
        self.ends.clear();
        let mut sum = 0.0;
        self.ends.extend(fitness.iter().map(|f| {
            sum += f;
            sum
        }));
    }

    /// The individual under the pointer. Where all fitness is 0, any one.
    pub fn spin(&self, dice: &mut Dice) -> usize {
        let (n, total) = (self.ends.len(), self.ends[self.ends.len() - 1]);
        if total <= 0.0 {
            return dice.below(n);
        }
        let pointer = dice.unit() * total;
        // Rounding may put the pointer on the very end of the wheel.
        self.ends.partition_point(|end| *end <= pointer).min(n - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(fitness: &[f64], spins: u32) -> Vec<u32> {
        let (mut wheel, mut dice) = (Roulette::default(), Dice::new(3));
        wheel.set(fitness);
        let mut counts = vec![0; fitness.len()];
        for _ in 0..spins {
            counts[wheel.spin(&mut dice)] += 1;
        }
        counts
    }

    #[test]
    fn frequencies_are_the_shares_of_fitness() {
        let spins = 20_000;
        let fitness = [1.0, 0.0, 3.0, 4.0];
        for (count, share) in counts(&fitness, spins).into_iter().zip(fitness.map(|f| f / 8.0)) {
            // Binomial: five standard deviations are missed once in two million.
            let n = f64::from(spins);
            let bound = 5.0 * (n * share * (1.0 - share)).sqrt();
            assert!((f64::from(count) - n * share).abs() <= bound, "{count} for a share of {share}");
        }
    }

    #[test]
    fn without_any_fitness_everyone_has_a_chance() {
        assert!(counts(&[0.0; 3], 300).iter().all(|c| *c > 50));
    }
}
