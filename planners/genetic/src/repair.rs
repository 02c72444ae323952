//! What the thesis adds to the usual operators (Fang 2009, §4.5.5 (4)): insertion,
//! deletion, and the smoothing of a work that it cites.

use crate::cells::Cells;
use crate::dice::Dice;
use crate::population::Gene;

/// Inserts a turning point. A path that crosses obstacles gets a free cell between
/// the ends of one of its crossing segments, drawn from a square round the
/// segment's middle that just holds it; any other, with probability `elsewhere`,
/// any free cell anywhere. One of `most` genes gets no longer.
///
/// That a free path is touched rarely is the thesis's "unequal probability"; the
/// square is a reading. `crossing` is a buffer.
pub fn insert(
    genes: &mut Vec<Gene>,
    cells: &mut Cells<'_>,
    elsewhere: f64,
    most: usize,
    crossing: &mut Vec<usize>,
    dice: &mut Dice,
) {
    if genes.len() >= most {
        return;
    }
    crossing.clear();
    for i in 1..genes.len() {
        if !cells.sees(genes, i - 1, i) {
            crossing.push(i);
        }
    }
    if crossing.is_empty() {
        if dice.chance(elsewhere) {
            genes.insert(1 + dice.below(genes.len() - 1), cells.draw(dice));
        }
        return;
    }
    let at = crossing[dice.below(crossing.len())];
    let (a, b) = (cells.grid.position(genes[at - 1] as usize), cells.grid.position(genes[at] as usize));
    let radius = a.0.abs_diff(b.0).max(a.1.abs_diff(b.1)) / 2 + 1;
    if let Some(cell) = cells.draw_near(((a.0 + b.0) / 2, (a.1 + b.1) / 2), radius, dice) {
        genes.insert(at, cell);
    }
}

/// Cuts the loops: of two equal cells and what lies between them one remains.
/// The first and the last gene stay even where start and goal share a cell.
pub fn cut_loops(genes: &mut Vec<Gene>) {
    let mut i = 0;
    while i + 1 < genes.len() {
        let last = genes.len() - 1;
        let again = (i + 1..=last).rev().find(|&j| genes[j] == genes[i] && (i, j) != (0, last));
        match again {
            Some(j) if j == last => {
                genes.drain(i..j);
            }
            Some(j) => {
                genes.drain(i + 1..=j);
                i += 1;
            }
            None => i += 1,
        }
    }
}

/// Drops every turning point b of …, a, b, c, … whose neighbours see each other.
pub fn smooth(genes: &mut Vec<Gene>, cells: &mut Cells<'_>) {
    let mut i = 1;
    while i + 1 < genes.len() {
        if cells.sees(genes, i - 1, i + 1) {
            genes.remove(i);
        } else {
            i += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::tests::with_bar;

    #[test]
    fn a_crossing_segment_gets_a_free_cell_between_its_ends() {
        with_bar(|cells| {
            let mut dice = Dice::new(6);
            for _ in 0..100 {
                // Only 14–34, (4, 1) to (4, 3), crosses the bar.
                let mut genes = vec![0, 14, 34, 59];
                insert(&mut genes, cells, 0.0, 9, &mut Vec::new(), &mut dice);
                assert!(genes.len() == 5 && genes[1] == 14 && genes[3] == 34, "{genes:?}");
                let (column, row) = cells.grid.position(genes[2] as usize);
                assert!((2..=6).contains(&column) && row <= 4, "within two cells of the middle (4, 2)");
                assert!(row != 2 || !(3..=5).contains(&column), "free");
            }
        });
    }

    #[test]
    fn a_free_path_is_lengthened_as_rarely_as_told() {
        with_bar(|cells| {
            let mut dice = Dice::new(6);
            let mut longer = 0;
            for _ in 0..400 {
                let mut genes = vec![0, 7, 59];
                insert(&mut genes, cells, 0.25, 9, &mut Vec::new(), &mut dice);
                longer += genes.len() - 3;
            }
            // Binomial, n = 400, p = 1/4: standard deviation 8.7; five of them.
            assert!(longer.abs_diff(100) <= 43, "{longer}");
            let mut full = vec![0, 14, 34, 59];
            insert(&mut full, cells, 1.0, 4, &mut Vec::new(), &mut dice);
            assert_eq!(full.len(), 4);
        });
    }

    #[test]
    fn loops_are_cut() {
        let cut = |mut genes: Vec<Gene>| {
            cut_loops(&mut genes);
            genes
        };
        assert_eq!(cut(vec![0, 3, 4, 5, 3, 9]), [0, 3, 9]);
        assert_eq!(cut(vec![0, 3, 3, 3, 9]), [0, 3, 9]);
        assert_eq!(cut(vec![0, 3, 0, 4, 9]), [0, 4, 9], "back to the start");
        assert_eq!(cut(vec![0, 3, 9, 4, 9]), [0, 3, 9], "past the goal");
        assert_eq!(cut(vec![0, 3, 4, 3, 4, 9]), [0, 3, 4, 9]);
        assert_eq!(cut(vec![7, 7]), [7, 7], "start and goal in one cell");
        assert_eq!(cut(vec![7, 2, 7, 7]), [7, 7]);
        assert_eq!(cut(vec![0, 1, 2, 9]), [0, 1, 2, 9]);
    }

    #[test]
    fn a_point_between_two_that_see_each_other_goes() {
        with_bar(|cells| {
            // Along row 0, then up behind the bar: the corner at column 7 must stay.
            let mut genes = vec![0, 2, 5, 7, 38, 59];
            smooth(&mut genes, cells);
            assert_eq!(genes, [0, 7, 59]);
            let mut genes = vec![0, 14, 34, 59];
            smooth(&mut genes, cells);
            assert!(genes.len() >= 3, "the bar is still in the way: {genes:?}");
        });
    }
}
