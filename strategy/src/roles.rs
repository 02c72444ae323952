//! Roles of robots, and who takes which.

use env_model::Point;
use serde::{Deserialize, Serialize};

/// What a robot is, as far as plays and rules tell robots apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Anybody.
    #[default]
    Field,
    /// The only one who may be in the own defence area.
    Keeper,
    /// Stands before the own defence area.
    Defender,
    /// Free before the opposing defence area.
    Attacker,
    /// Who kicks or places the ball, and so may be near it.
    Taker,
}

impl Role {
    /// All, in the order of the worlds that rules compile.
    pub const ALL: [Self; 5] = [Self::Field, Self::Keeper, Self::Defender, Self::Attacker, Self::Taker];
}

/// By how much a new assignment must be better to be taken, of the sum of squared distances: robots do not change
/// places for a trifle, and back again.
const HYSTERESIS: f64 = 0.2;

/// Which robot goes to which spot.
#[derive(Debug, Clone, Default)]
pub struct Assignment {
    spots: Vec<usize>,
}

impl Assignment {
    /// The spot of each robot: that of least Σ d², but the one before unless the new one is better by a fifth.
    ///
    /// # Panics
    /// Unless there are as many spots as robots.
    pub fn update(&mut self, robots: &[Point], spots: &[Point]) -> &[usize] {
        assert_eq!(robots.len(), spots.len(), "as many spots as robots");
        let cost = |i: usize, j: usize| (robots[i] - spots[j]).norm_squared();
        let best = assign(robots.len(), cost);
        let sum = |spots: &[usize]| -> f64 { spots.iter().enumerate().map(|(i, j)| cost(i, *j)).sum() };
        if self.spots.len() != best.len() || sum(&best) < (1.0 - HYSTERESIS) * sum(&self.spots) {
            self.spots = best;
        }
        &self.spots
    }
}

/// The column of each row such that Σ cost(row, column) is least, of n rows and columns. Costs must be finite. O(n³).
///
/// Shortest augmenting paths with dual potentials (Kuhn 1955, doi:10.1002/nav.3800020109; Jonker & Volgenant 1987,
/// doi:10.1007/BF02278710).
pub fn assign(n: usize, cost: impl Fn(usize, usize) -> f64) -> Vec<usize> {
    // Row and column n are where paths begin.
    let (mut of_rows, mut of_columns) = (vec![0.0; n + 1], vec![0.0; n + 1]);
    let mut row_of = vec![n; n + 1];
    for row in 0..n {
        row_of[n] = row;
        let mut column = n;
        let (mut least, mut from, mut seen) = (vec![f64::INFINITY; n], vec![n; n], vec![false; n + 1]);
        while row_of[column] != n {
            seen[column] = true;
            let (at, mut next, mut delta) = (row_of[column], n, f64::INFINITY);
            for j in (0..n).filter(|j| !seen[*j]) {
                let reduced = cost(at, j) - of_rows[at] - of_columns[j];
                if reduced < least[j] {
                    (least[j], from[j]) = (reduced, column);
                }
                if least[j] < delta {
                    (delta, next) = (least[j], j);
                }
            }
            for j in 0..=n {
                if seen[j] {
                    of_rows[row_of[j]] += delta;
                    of_columns[j] -= delta;
                } else {
                    least[j] -= delta;
                }
            }
            column = next;
        }
        while column != n {
            let before = from[column];
            row_of[column] = row_of[before];
            column = before;
        }
    }
    let mut columns = vec![0; n];
    for j in 0..n {
        columns[row_of[j]] = j;
    }
    columns
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::draw;

    /// The least sum over all permutations.
    fn brute_force(costs: &[Vec<f64>], row: usize, taken: &mut [bool]) -> f64 {
        if row == costs.len() {
            return 0.0;
        }
        let mut best = f64::INFINITY;
        for j in 0..costs.len() {
            if !std::mem::replace(&mut taken[j], true) {
                best = best.min(costs[row][j] + brute_force(costs, row + 1, taken));
                taken[j] = false;
            }
        }
        best
    }

    #[test]
    fn assignments_are_optimal() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for n in 0..=6 {
            for _ in 0..50 {
                let costs: Vec<Vec<f64>> =
                    (0..n).map(|_| (0..n).map(|_| draw::between(&mut rng, -5.0, 10.0)).collect()).collect();
                let columns = assign(n, |i, j| costs[i][j]);
                let sum: f64 = columns.iter().enumerate().map(|(i, j)| costs[i][*j]).sum();
                let mut sorted = columns.clone();
                sorted.sort_unstable();
                assert_eq!(sorted, (0..n).collect::<Vec<_>>(), "a permutation");
                // Six sums of numbers up to 10: rounding is far below.
                assert!((sum - brute_force(&costs, 0, &mut vec![false; n])).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn by_hand() {
        // The nearest spot of both is −1: 1 + 16 in their order, 4 + 1 crossed.
        let (robots, spots) = ([0.0, -2.0], [-1.0, 2.0]);
        let columns = assign(2, |i, j| (robots[i] - spots[j]) * (robots[i] - spots[j]));
        assert_eq!(columns, [1, 0]);
    }

    #[test]
    fn a_trifle_changes_nothing() {
        let at = |x: f64| Point::new(x, 0.0);
        let spots = [Point::new(0.0, 1.0), Point::new(1.0, 1.0)];
        let mut assignment = Assignment::default();
        assert_eq!(assignment.update(&[at(0.4), at(0.6)], &spots), [0, 1]);
        // Now crossed by a little: 2 + 0.36 + 0.36 against 2 + 0.16 + 0.16 is better by 15 %.
        assert_eq!(assignment.update(&[at(0.6), at(0.4)], &spots), [0, 1]);
        assert_eq!(assignment.update(&[at(1.0), at(0.0)], &spots), [1, 0], "by a half");
    }
}
