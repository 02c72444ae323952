//! Fitness of a path of cells (Fang 2009, §4.5.4).
//!
//! The thesis's formula is damaged in print: `f = 1/((1 + 1/?(n−1))·D)` with n "the
//! number of cells that the individual passes" and D the sum of the straight
//! distances between neighbouring numbers. Both ways to mend it, and both ways to
//! read "passes", are settings.
//!
//! Whichever way, the factor 1 + 1/… falls as n grows: of two paths of equal
//! length the one through *more* cells is fitter. With n cells traversed the
//! effect is slight, well below 1 % a cell on a grid of 40. With n genes it is
//! large: the straight line, n = 2, has the worst factor of all, 2, and a third
//! gene pays for a detour of 17 % (root) or a third (plain).

use serde::{Deserialize, Serialize};

use crate::cells::Cells;
use crate::population::Gene;

/// How the printed formula is mended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GridFitness {
    /// f = 1/((1 + 1/√(n − 1))·D).
    Root,
    /// f = 1/((1 + 1/(n − 1))·D).
    Plain,
}

/// What n, "the number of cells that the individual passes", counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CellsPassed {
    /// The cells that the straight lines between the genes' centres run through.
    Traversed,
    /// The genes of the chromosome.
    Genes,
}

impl GridFitness {
    /// 1/f = (1 + 1/√(n − 1))·D or (1 + 1/(n − 1))·D. A path within one cell counts as n = 2.
    pub fn cost(self, n: usize, length: f64) -> f64 {
        let more = (n.max(2) - 1) as f64;
        let factor = match self {
            Self::Root => 1.0 + 1.0 / more.sqrt(),
            Self::Plain => 1.0 + 1.0 / more,
        };
        factor * length
    }
}

impl CellsPassed {
    /// n of a chromosome.
    pub fn count(self, genes: &[Gene], cells: &Cells<'_>) -> usize {
        match self {
            Self::Genes => genes.len(),
            Self::Traversed => 1 + genes.windows(2).map(|w| entered(cells, w[0], w[1])).sum::<usize>(),
        }
    }
}

/// Cells that the straight line from centre to centre enters.
///
/// It crosses |Δc| + |Δr| grid lines and enters a cell at each, but passes through
/// a corner where it crosses two at once. With g = gcd(|Δc|, |Δr|) that is where
/// both |Δc|/g and |Δr|/g are odd, g times; elsewhere never.
fn entered(cells: &Cells<'_>, from: Gene, to: Gene) -> usize {
    let (a, b) = (cells.grid.position(from as usize), cells.grid.position(to as usize));
    let (dc, dr) = (a.0.abs_diff(b.0), a.1.abs_diff(b.1));
    let g = gcd(dc, dr);
    let corners = if g > 0 && (dc / g) % 2 == 1 && (dr / g) % 2 == 1 { g } else { 0 };
    dc + dr - corners
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::tests::with_bar;

    #[test]
    fn both_readings_by_hand() {
        assert_eq!(GridFitness::Root.cost(5, 12.0), 18.0, "(1 + 1/2)·12");
        assert_eq!(GridFitness::Plain.cost(5, 12.0), 15.0, "(1 + 1/4)·12");
        assert_eq!(GridFitness::Root.cost(2, 12.0), 24.0);
        assert_eq!(GridFitness::Plain.cost(1, 12.0), 24.0, "start and goal in one cell");
        // More cells at equal length: fitter.
        assert!(GridFitness::Root.cost(10, 1.0) < GridFitness::Root.cost(9, 1.0));
    }

    #[test]
    fn cells_on_the_way_agree_with_dense_samples() {
        with_bar(|cells| {
            for to in 0..cells.grid.len() {
                let (a, b) = (cells.grid.centre(21), cells.grid.centre(to));
                let mut passed = std::collections::BTreeSet::new();
                // Cell sides are 1: samples 1/1000 apart or less miss only cells that the line
                // enters by less; on this grid of 10 × 6 it enters each by 1/18 or more.
                for k in 0..=10_000 {
                    let p = a + (b - a) * (f64::from(k) / 10_000.0);
                    // A sample on a corner or a border belongs to no cell alone.
                    let inside = |v: f64| (v - v.round()).abs() > 1e-9;
                    if inside(p.x) && inside(p.y) {
                        passed.insert(cells.grid.cell_at(p));
                    }
                }
                assert_eq!(entered(cells, 21, to as Gene) + 1, passed.len(), "to {:?}", cells.grid.position(to));
            }
            let genes = [0, 22, 59];
            assert_eq!(CellsPassed::Genes.count(&genes, cells), 3);
            // Two diagonal steps, then (2, 2) to (9, 5): 7 + 3 grid lines, two of them at once in the corner (6, 4).
            assert_eq!(CellsPassed::Traversed.count(&genes, cells), 1 + 2 + (7 + 3 - 1));
        });
    }
}
