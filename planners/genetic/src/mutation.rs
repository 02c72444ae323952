//! Mutation (Fang 2009, §4.5.5 (3); §4.4).

use crate::cells::Cells;
use crate::dice::Dice;
use crate::population::Gene;

/// Changes a path of cells at one turning point, start and goal excepted: the
/// point is deleted, replaced or followed by a new one, each as likely. New
/// cells are free and at most `radius` rows and columns from the old one. A path
/// without turning points gets one near the middle of its straight line; one of
/// `most` genes gets no longer.
pub fn mutate_path(genes: &mut Vec<Gene>, cells: &Cells<'_>, radius: usize, most: usize, dice: &mut Dice) {
    let near = |at: (usize, usize), dice: &mut Dice| cells.draw_near(at, radius, dice);
    if genes.len() < 3 {
        let [a, b] = [genes[0], genes[1]].map(|gene| cells.grid.position(gene as usize));
        if let Some(cell) = near(((a.0 + b.0) / 2, (a.1 + b.1) / 2), dice) {
            genes.insert(1, cell);
        }
        return;
    }
    let at = 1 + dice.below(genes.len() - 2);
    let position = cells.grid.position(genes[at] as usize);
    match dice.below(3) {
        0 => {
            genes.remove(at);
        }
        1 => {
            if let Some(cell) = near(position, dice) {
                genes[at] = cell;
            }
        }
        _ => {
            if let Some(cell) = near(position, dice).filter(|_| genes.len() < most) {
                genes.insert(at + 1, cell);
            }
        }
    }
}

/// How far a new cell may be from the old one in generation `g` of `generations`:
/// `share`·(1 − g/G) of the grid's longer side, at least one cell. The thesis has
/// it shrink "as evolution proceeds"; that it does so evenly is a reading.
pub fn radius(share: f64, longer_side: usize, g: u64, generations: u64) -> usize {
    let left = 1.0 - g as f64 / generations as f64;
    ((share * longer_side as f64 * left).round() as usize).max(1)
}

/// Gives each gene, with probability `rate`, another value: 0 with probability
/// `zero`, else any of the vertices 1 … n. Repeats are left to be dropped.
pub fn mutate_vertices(genes: &mut [Gene], vertices: usize, rate: f64, zero: f64, dice: &mut Dice) {
    for gene in genes {
        if dice.chance(rate) {
            *gene = if dice.chance(zero) { 0 } else { 1 + dice.below(vertices) as Gene };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::tests::with_bar;

    #[test]
    fn one_turning_point_is_deleted_replaced_or_followed() {
        with_bar(|cells| {
            let mut dice = Dice::new(4);
            let mut kinds = [0; 3];
            for _ in 0..300 {
                // (2, 1), then (7, 4); the ends are (0, 0) and (9, 5).
                let old = vec![0, 12, 47, 59];
                let mut genes = old.clone();
                mutate_path(&mut genes, cells, 1, 8, &mut dice);
                assert!(genes[0] == 0 && genes[genes.len() - 1] == 59);
                kinds[genes.len() + 1 - old.len()] += 1;
                let new = genes.iter().filter(|g| !old.contains(g)).map(|g| cells.grid.position(*g as usize));
                for (column, row) in new {
                    let near = |c: usize, r: usize| column.abs_diff(c) <= 1 && row.abs_diff(r) <= 1;
                    assert!(near(2, 1) || near(7, 4), "({column}, {row})");
                }
            }
            // Binomial, n = 300, p = 1/3: standard deviation 8.2; five of them.
            assert!(kinds.iter().all(|k: &usize| k.abs_diff(100) <= 41), "{kinds:?}");
        });
    }

    #[test]
    fn a_straight_line_gets_a_turning_point_and_a_full_path_none() {
        with_bar(|cells| {
            let mut dice = Dice::new(4);
            let mut genes = vec![0, 59];
            mutate_path(&mut genes, cells, 1, 8, &mut dice);
            let (column, row) = cells.grid.position(genes[1] as usize);
            assert!(genes.len() == 3 && (3..=5).contains(&column) && (1..=3).contains(&row), "{genes:?}");
            for _ in 0..100 {
                let mut full = vec![0, 12, 47, 59];
                mutate_path(&mut full, cells, 1, 4, &mut dice);
                assert!(full.len() <= 4);
            }
        });
    }

    #[test]
    fn the_radius_shrinks_to_one_cell() {
        let at = |g| radius(0.5, 40, g, 100);
        assert_eq!([at(0), at(50), at(90), at(100)], [20, 10, 2, 1]);
    }

    #[test]
    fn vertices_change_at_the_rate() {
        let mut dice = Dice::new(8);
        let mut genes = vec![9; 10_000];
        mutate_vertices(&mut genes, 5, 0.3, 0.5, &mut dice);
        let count = |what: fn(Gene) -> bool| genes.iter().filter(|g| what(**g)).count();
        // Binomial, n = 10 000, p = 0.15: standard deviation 36; five of them.
        let (zeros, vertices) = (count(|g| g == 0), count(|g| (1..=5).contains(&g)));
        assert!(zeros.abs_diff(1500) <= 180 && vertices.abs_diff(1500) <= 180, "{zeros}, {vertices}");
        assert_eq!(zeros + vertices + count(|g| g == 9), genes.len());
    }
}
