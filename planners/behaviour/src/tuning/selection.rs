//! Selection of parents.

use super::Selection;
use crate::dice::Dice;

/// Draws parents from a generation.
#[derive(Debug, Clone, Default)]
pub struct Selector {
    /// Where each sector of the roulette wheel ends.
    ends: Vec<f64>,
}

impl Selector {
    /// Sets the wheel up for `fitness`, values ≥ 0.
    pub fn set(&mut self, fitness: &[f64]) {
        self.ends.clear();
        self.ends.extend(fitness.iter().scan(0.0, |sum, f| {
            *sum += f;
            Some(*sum)
        }));
    }

    /// The index of a parent among `fitness`, for which the wheel was set.
    pub fn pick(&self, selection: Selection, fitness: &[f64], dice: &mut Dice) -> usize {
        let n = fitness.len();
        match selection {
            Selection::Roulette => {
                let pointer = dice.unit() * self.ends[n - 1];
                // Rounding may put the pointer on the very end of the wheel; without any fitness it is there.
                self.ends.partition_point(|end| *end <= pointer).min(n - 1)
            }
            Selection::Tournament => {
                let (a, b) = (dice.below(n), dice.below(n));
                if fitness[b] > fitness[a] { b } else { a }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(selection: Selection, fitness: &[f64], shares: &[f64]) {
        let (mut selector, mut dice) = (Selector::default(), Dice::new(3, 0));
        selector.set(fitness);
        let mut counts = vec![0.0; fitness.len()];
        let n = 20_000;
        (0..n).for_each(|_| counts[selector.pick(selection, fitness, &mut dice)] += 1.0);
        for (count, share) in counts.into_iter().zip(shares) {
            // Binomial: five standard deviations are missed once in two million.
            let n = f64::from(n);
            assert!((count - n * share).abs() <= 5.0 * (n * share * (1.0 - share)).sqrt(), "{count} for {share}");
        }
    }

    #[test]
    fn roulette_by_share_of_fitness() {
        shares(Selection::Roulette, &[1.0, 0.0, 3.0, 4.0], &[0.125, 0.0, 0.375, 0.5]);
    }

    #[test]
    fn tournaments_by_rank() {
        // The best of four wins unless two others meet: 1 − (3/4)².
        shares(Selection::Tournament, &[1.0, 0.0, 3.0, 4.0], &[3.0 / 16.0, 1.0 / 16.0, 5.0 / 16.0, 7.0 / 16.0]);
    }
}
