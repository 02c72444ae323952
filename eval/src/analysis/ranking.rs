//! All planners at once: mean ranks and which of them differ.

use super::blocks::{Blocks, Measure, Over};
use super::grid::Grid;
use crate::statistics::friedman::{Friedman, friedman};
use crate::statistics::nemenyi::critical_difference;

/// Level of the critical difference.
pub const ALPHA: f64 = 0.05;

/// What a critical-difference diagram shows (Demšar 2006).
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    /// What is compared.
    pub measure: Measure,
    /// What the blocks are.
    pub over: Over,
    /// Blocks left out because a planner has no runs in them.
    pub incomplete: usize,
    /// Friedman's test; its mean ranks are in the grid's order.
    pub test: Friedman,
    /// Nemenyi's critical difference of two mean ranks.
    pub critical: f64,
    /// The planners from the best mean rank to the worst.
    pub order: Vec<usize>,
    /// First and last place in `order` of each largest group of two or more planners that the critical difference
    /// does not tell apart.
    pub groups: Vec<[usize; 2]>,
}

/// Ranks the planners in blocks where all have runs; `None` for fewer than two planners or such blocks, or where
/// the repeats of every planner are all alike.
pub fn rank(grid: &Grid<'_>, measure: Measure) -> Option<Ranking> {
    let blocks = Blocks::new(grid, measure);
    // A lone scene in which nothing varies is one observation, however often repeated.
    if blocks.over == Over::Repeats && blocks.settled.iter().all(|s| *s) {
        return None;
    }
    let all = blocks.values.first().map_or(0, Vec::len);
    let row = |i: usize| blocks.values.iter().map(|column| column[i]).collect::<Option<Vec<f64>>>();
    let complete: Vec<Vec<f64>> = (0..all).filter_map(row).collect();
    let test = friedman(&complete)?;
    let mut order: Vec<usize> = (0..grid.planners.len()).collect();
    order.sort_by(|&a, &b| test.mean_ranks[a].total_cmp(&test.mean_ranks[b]));
    let critical = critical_difference(order.len(), complete.len(), ALPHA)?;
    let sorted: Vec<f64> = order.iter().map(|&p| test.mean_ranks[p]).collect();
    let incomplete = all - complete.len();
    Some(Ranking { measure, over: blocks.over, incomplete, test, critical, order, groups: groups(&sorted, critical) })
}

/// The largest runs of sorted mean ranks that lie within the critical difference.
fn groups(sorted: &[f64], critical: f64) -> Vec<[usize; 2]> {
    let mut out: Vec<[usize; 2]> = Vec::new();
    for first in 0..sorted.len() {
        let last = sorted.partition_point(|r| r - sorted[first] < critical) - 1;
        if last > first && out.last().is_none_or(|g| last > g[1]) {
            out.push([first, last]);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::testing::one_scene;
    use super::*;

    #[test]
    fn groups_are_the_largest() {
        assert_eq!(groups(&[1.0, 2.0, 2.5, 4.0, 4.2], 1.6), [[0, 2], [2, 3], [3, 4]]);
        assert_eq!(groups(&[1.0, 1.0, 3.0], 0.5), [[0, 1]]);
        assert_eq!(groups(&[1.0, 2.0], 1.0), [[0, 1]; 0], "a difference of the critical one is one");
        assert!(groups(&[], 1.0).is_empty());
    }

    #[test]
    fn the_diagram() {
        let inf = f64::INFINITY;
        let column = |shift: f64| (0..12).map(|i| shift + 0.01 * f64::from(i)).collect::<Vec<f64>>();
        let (mut worst, best, middle) = (column(3.0), column(1.0), column(2.0));
        worst[3] = inf;
        let results = one_scene(&[("worst", &worst), ("best", &best), ("middle", &middle)]);
        let ranking = rank(&Grid::new(&results), Measure::Gap).unwrap();
        assert_eq!(ranking.order, [1, 2, 0]);
        assert_eq!(ranking.test.mean_ranks, [3.0, 1.0, 2.0]);
        // 2.3437·√(3·4/(6·12)) = 0.957 < 1: all differ.
        assert!((ranking.critical - 0.9568).abs() < 1e-4 && ranking.groups.is_empty(), "{ranking:?}");
        let shorter = one_scene(&[("worst", &worst), ("best", &best[..10]), ("middle", &middle)]);
        let ranking = rank(&Grid::new(&shorter), Measure::Gap).unwrap();
        assert_eq!((ranking.incomplete, ranking.test.blocks), (2, 10));
        assert_eq!(ranking.groups, [[0, 1], [1, 2]]);
    }

    #[test]
    fn repetition_is_no_evidence() {
        let results = one_scene(&[("a", &[1.0; 30]), ("b", &[2.0; 30])]);
        assert_eq!(rank(&Grid::new(&results), Measure::Gap), None);
        assert_eq!(rank(&Grid::new(&one_scene(&[])), Measure::Gap), None);
    }
}
