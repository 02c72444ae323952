//! Pheromone on the edges between neighbouring cells, the same both ways.

/// Trails never fall below this share of the initial one, far too little to be
/// followed: so that none becomes zero and with it the choice undefined.
const LEAST: f64 = 1e-12;

#[derive(Debug, Clone, Default)]
pub(crate) struct Trails {
    /// τ, four edges a cell: those of its first four moves. The others belong to the neighbour.
    amounts: Vec<f64>,
    /// τ^α.
    powers: Vec<f64>,
    initial: f64,
}

/// The edge of move `k` from `from` to `to`.
pub(crate) fn edge(from: usize, k: usize, to: usize) -> usize {
    if k < 4 { 4 * from + k } else { 4 * to + k - 4 }
}

impl Trails {
    /// The same trail on every edge.
    pub fn reset(&mut self, cells: usize, initial: f64, alpha: f64) {
        self.initial = initial;
        for (values, value) in [(&mut self.amounts, initial), (&mut self.powers, libm::pow(initial, alpha))] {
            values.clear();
            values.resize(4 * cells, value);
        }
    }

    /// τ^α on an edge.
    pub fn power(&self, edge: usize) -> f64 {
        self.powers[edge]
    }

    /// τ ← (1 − ρ) τ (Dorigo et al. 1996, eq. 1).
    pub fn evaporate(&mut self, rho: f64) {
        let least = LEAST * self.initial;
        for amount in &mut self.amounts {
            *amount = (*amount * (1.0 - rho)).max(least);
        }
    }

    /// Lays `amount` on the edge.
    pub fn lay(&mut self, edge: usize, amount: f64) {
        self.amounts[edge] += amount;
    }

    /// Brings τ^α up to date.
    pub fn raise(&mut self, alpha: f64) {
        if alpha == 1.0 {
            self.powers.copy_from_slice(&self.amounts);
        } else {
            for (power, amount) in self.powers.iter_mut().zip(&self.amounts) {
                *power = libm::pow(*amount, alpha);
            }
        }
    }

    /// The strongest trail of every cell, over its moves.
    pub fn write_strongest(&self, moves: &[[u32; 8]], values: &mut Vec<f64>) {
        values.clear();
        values.extend(moves.iter().enumerate().map(|(cell, moves)| {
            let possible = moves.iter().enumerate().filter(|(_, to)| **to != crate::map::NONE);
            possible.map(|(k, to)| self.amounts[edge(cell, k, *to as usize)]).fold(0.0, f64::max)
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_is_the_same_from_both_ends() {
        // Cells 7 and 8 are neighbours: to the right is move 0, back is move 4. Likewise up-left, 3 and 7.
        assert_eq!(edge(7, 0, 8), edge(8, 4, 7));
        assert_eq!(edge(7, 3, 16), edge(16, 7, 7));
    }

    #[test]
    fn trails_evaporate_and_are_laid() {
        let mut trails = Trails::default();
        trails.reset(2, 8.0, 2.0);
        assert_eq!(trails.power(3), 64.0);
        trails.evaporate(0.75);
        trails.lay(3, 1.0);
        trails.raise(2.0);
        assert_eq!([trails.power(2), trails.power(3)], [4.0, 9.0]);
        for _ in 0..100 {
            trails.evaporate(1.0);
        }
        assert_eq!(trails.amounts[3], 8e-12, "never nothing");
    }
}
