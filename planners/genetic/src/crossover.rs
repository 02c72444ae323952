//! One-point crossover (Fang 2009, §4.4 and §4.5.5).

use crate::dice::Dice;
use crate::population::Gene;

/// Crossover of paths of different lengths: each parent is cut behind a turning
/// point of its own, start and goal excepted, and the tails are exchanged.
/// `spare` is a buffer. Nothing happens where a parent has no turning point or a
/// child would have more than `most` genes.
pub fn exchange_tails(a: &mut Vec<Gene>, b: &mut Vec<Gene>, most: usize, spare: &mut Vec<Gene>, dice: &mut Dice) {
    if a.len() < 3 || b.len() < 3 {
        return;
    }
    let (i, j) = (1 + dice.below(a.len() - 2), 1 + dice.below(b.len() - 2));
    join_tails(a, i + 1, b, j + 1, most, spare);
}

/// Exchanges what follows the first `i` genes of `a` and the first `j` of `b`.
fn join_tails(a: &mut Vec<Gene>, i: usize, b: &mut Vec<Gene>, j: usize, most: usize, spare: &mut Vec<Gene>) {
    if i + b.len() - j > most || j + a.len() - i > most {
        return;
    }
    spare.clear();
    spare.extend_from_slice(&a[i..]);
    a.truncate(i);
    a.extend_from_slice(&b[j..]);
    b.truncate(j);
    b.extend_from_slice(spare);
}

/// Crossover of chromosomes of one length: what lies right of one place is exchanged.
pub fn exchange_right(a: &mut [Gene], b: &mut [Gene], dice: &mut Dice) {
    if a.len() > 1 {
        let cut = 1 + dice.below(a.len() - 1);
        a[cut..].swap_with_slice(&mut b[cut..]);
    }
}

/// Zeroes every vertex that the chromosome has named before (Fang 2009, §4.4: no
/// vertex twice). `seen` is a buffer; vertices are numbered 1 … n.
pub fn drop_repeats(genes: &mut [Gene], vertices: usize, seen: &mut Vec<bool>) {
    seen.clear();
    seen.resize(vertices + 1, false);
    for gene in genes {
        let repeated = std::mem::replace(&mut seen[*gene as usize], true);
        if repeated {
            *gene = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_change_places() {
        let (mut a, mut b) = (vec![1, 2, 3, 9], vec![1, 7, 9]);
        join_tails(&mut a, 2, &mut b, 2, 8, &mut Vec::new());
        assert_eq!((a, b), (vec![1, 2, 9], vec![1, 7, 3, 9]));
        let (mut a, mut b) = (vec![1, 2, 3, 4, 9], vec![1, 5, 6, 7, 9]);
        join_tails(&mut a, 4, &mut b, 2, 6, &mut Vec::new());
        assert_eq!((a, b), (vec![1, 2, 3, 4, 9], vec![1, 5, 6, 7, 9]), "seven genes would be too many");
    }

    #[test]
    fn children_keep_the_ends_and_all_genes() {
        let mut dice = Dice::new(5);
        for _ in 0..50 {
            let (mut a, mut b) = (vec![0, 11, 12, 13, 14, 99], vec![0, 21, 22, 99]);
            exchange_tails(&mut a, &mut b, 20, &mut Vec::new(), &mut dice);
            assert!(a[0] == 0 && b[0] == 0 && a[a.len() - 1] == 99 && b[b.len() - 1] == 99);
            assert!(a[1] == 11 && b[1] == 21, "the first turning point stays");
            let mut inner = [&a[1..a.len() - 1], &b[1..b.len() - 1]].concat();
            inner.sort_unstable();
            assert_eq!(inner, [11, 12, 13, 14, 21, 22]);
        }
        let (mut a, mut b) = (vec![0, 99], vec![0, 21, 22, 99]);
        exchange_tails(&mut a, &mut b, 20, &mut Vec::new(), &mut dice);
        assert_eq!((a.len(), b.len()), (2, 4), "no turning point, no crossover");
    }

    #[test]
    fn the_right_parts_change_places() {
        let mut dice = Dice::new(2);
        for _ in 0..20 {
            let (mut a, mut b) = ([1, 2, 3, 4], [5, 6, 7, 8]);
            exchange_right(&mut a, &mut b, &mut dice);
            assert!(a[0] == 1 && a[3] == 8 && b[0] == 5 && b[3] == 4);
            assert!((0..4).all(|i| a[i].abs_diff(b[i]) == 4), "each gene keeps its place");
        }
    }

    #[test]
    fn later_repeats_become_zero() {
        let mut genes = [3, 0, 1, 3, 0, 2, 1];
        drop_repeats(&mut genes, 3, &mut Vec::new());
        assert_eq!(genes, [3, 0, 1, 0, 0, 2, 0]);
    }
}
