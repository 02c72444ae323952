//! One ant's walk from an entry to an exit.

use planner_api::seed::unit;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::DeadEnd;
use crate::map::{Map, NONE};
use crate::trails::{Trails, edge};

/// The tabu lists of ants that walk one after the other.
#[derive(Debug, Clone, Default)]
pub(crate) struct Walker {
    /// The last ant that was in each cell.
    visitor: Vec<u32>,
    ant: u32,
}

/// How a walk ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    /// At the goal.
    Arrived,
    /// In a dead end.
    Died,
    /// It has been in every cell that moves lead to: there is no way on this grid.
    Exhausted,
}

impl Walker {
    pub fn reset(&mut self, cells: usize) {
        self.visitor.clear();
        self.visitor.resize(cells, 0);
        self.ant = 0;
    }

    /// Walks from `entry`; writes the cells in order, no cell twice.
    pub fn walk(
        &mut self,
        (map, trails): (&Map, &Trails),
        entry: usize,
        dead_end: DeadEnd,
        rng: &mut ChaCha8Rng,
        tour: &mut Vec<u32>,
    ) -> End {
        self.ant += 1;
        tour.clear();
        tour.push(entry as u32);
        self.visitor[entry] = self.ant;
        while let Some(&at) = tour.last() {
            let at = at as usize;
            if map.exit(at).is_some() {
                return End::Arrived;
            }
            let mut weights = [0.0; 8];
            for (k, to) in map.moves[at].into_iter().enumerate() {
                if to != NONE && self.visitor[to as usize] != self.ant {
                    let to = to as usize;
                    // Never zero, so that a way is taken where there is one.
                    weights[k] = (trails.power(edge(at, k, to)) * map.nearness[to]).max(f64::MIN_POSITIVE);
                }
            }
            match choose(&weights, rng) {
                Some(k) => {
                    let to = map.moves[at][k];
                    self.visitor[to as usize] = self.ant;
                    tour.push(to);
                }
                None if dead_end == DeadEnd::Die => return End::Died,
                None => {
                    tour.pop();
                }
            }
        }
        End::Exhausted
    }
}

/// Roulette: k with probability wₖ/Σw; `None` where all are zero. One choice draws no number.
fn choose(weights: &[f64; 8], rng: &mut ChaCha8Rng) -> Option<usize> {
    let last = weights.iter().rposition(|w| *w > 0.0)?;
    if weights[..last].iter().all(|w| *w == 0.0) {
        return Some(last);
    }
    // 53 bits of a word, in [0, 1): the same on every platform.
    let uniform = unit(rng.random());
    let mut left = uniform * weights.iter().sum::<f64>();
    // By rounding the sum may not be used up: the last one takes what remains.
    let chosen = weights[..last].iter().position(|w| {
        left -= w;
        left < 0.0
    });
    Some(chosen.unwrap_or(last))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    #[test]
    fn roulette_follows_the_weights() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        assert_eq!(choose(&[0.0; 8], &mut rng), None);
        assert_eq!(choose(&[0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0], &mut rng), Some(2));
        let weights = [0.0, 1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 5.0];
        let mut counts = [0_u32; 8];
        for _ in 0..80_000 {
            counts[choose(&weights, &mut rng).unwrap()] += 1;
        }
        for (count, weight) in counts.into_iter().zip(weights) {
            // Five standard deviations of a binomial with n = 80 000.
            let deviation = (10_000.0 * weight * (1.0 - weight / 8.0)).sqrt();
            assert!((f64::from(count) - 10_000.0 * weight).abs() <= 5.0 * deviation, "{counts:?}");
        }
    }
}
