//! The evidence: values of every planner in blocks that belong together.
//!
//! With one scene its repeats are the blocks: a repeat has the same seed for every planner. With several scenes the
//! scenes are the blocks and a planner's value is its median over the repeats, +∞ where half of them failed: repeats in
//! one scene are no independent evidence about scenes.

use super::grid::Grid;
use super::summary::counted_gap;
use crate::results::RunRecord;
use crate::statistics::median;

/// Differences below this are rounding: gaps are compared in whole multiples of it, and one of 0 is at the optimum.
const RESOLUTION: f64 = 1e-9;

/// What is compared; less is better, and a run without a valid path is +∞ in each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// length/optimum − 1; of a simulation, arrival over least time, less 1.
    Gap,
    /// Length in multiples of the scene's optimum or, where that is not known, of the least valid length in it; the
    /// loss of a behaviour as it is.
    Length,
    /// Wall time, µs.
    Time,
}

/// What the blocks are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// The repeats of the only scene.
    Repeats,
    /// Several scenes.
    Scenes,
}

/// The measure of quality: the gap where every optimum is known, and of simulations; else the length.
pub fn quality(grid: &Grid<'_>) -> Measure {
    let known = grid.scenes.iter().all(|s| s.simulation.is_some() || s.optimum.length.is_some());
    if known { Measure::Gap } else { Measure::Length }
}

/// The values of every planner.
pub struct Blocks {
    /// What the blocks are.
    pub over: Over,
    /// For each planner its value in each block, where it has runs there.
    pub values: Vec<Vec<Option<f64>>>,
    /// Planners whose repeats are all alike, so that their number is no evidence; none where scenes are the blocks.
    pub settled: Vec<bool>,
}

impl Blocks {
    /// Values of `measure`.
    pub fn new(grid: &Grid<'_>, measure: Measure) -> Self {
        if grid.scenes.len() == 1 { Self::of_repeats(grid, measure) } else { Self::of_scenes(grid, measure) }
    }

    fn of_repeats(grid: &Grid<'_>, measure: Measure) -> Self {
        let all: Vec<Vec<f64>> = values_in(grid, 0, measure);
        let runs = |p: usize| grid.runs(p, 0);
        let mut repeats: Vec<u32> = (0..all.len()).flat_map(|p| runs(p).iter().map(|r| r.repeat)).collect();
        repeats.sort_unstable();
        repeats.dedup();
        let column = |p: usize| {
            let mut column = vec![None; repeats.len()];
            for (run, value) in runs(p).iter().zip(&all[p]) {
                column[repeats.partition_point(|r| *r < run.repeat)] = Some(*value);
            }
            column
        };
        let settled = all.iter().map(|v| v.windows(2).all(|w| w[0] == w[1])).collect();
        Self { over: Over::Repeats, values: (0..all.len()).map(column).collect(), settled }
    }

    fn of_scenes(grid: &Grid<'_>, measure: Measure) -> Self {
        let mut values = vec![Vec::with_capacity(grid.scenes.len()); grid.planners.len()];
        for scene in 0..grid.scenes.len() {
            for (column, runs) in values.iter_mut().zip(values_in(grid, scene, measure)) {
                column.push(median(&runs));
            }
        }
        Self { over: Over::Scenes, values, settled: vec![false; grid.planners.len()] }
    }

    /// The values of two planners in the blocks that both have.
    pub fn both(&self, a: usize, b: usize) -> (Vec<f64>, Vec<f64>) {
        self.values[a].iter().zip(&self.values[b]).filter_map(|(a, b)| a.zip(*b)).unzip()
    }
}

/// The values of every planner's runs in one scene, in the order of the grid's cells.
pub fn values_in(grid: &Grid<'_>, scene: usize, measure: Measure) -> Vec<Vec<f64>> {
    let planners = 0..grid.planners.len();
    let valid = |r: &&RunRecord| if r.valid { r.length } else { None };
    let shortest = || {
        let lengths = planners.clone().flat_map(|p| grid.runs(p, scene)).filter_map(valid);
        lengths.fold(f64::INFINITY, f64::min)
    };
    let reference = grid.scenes[scene].optimum.length.unwrap_or_else(shortest);
    let value = |run: &&RunRecord| match (measure, valid(run)) {
        (_, None) => f64::INFINITY,
        (Measure::Time, _) => run.time_us,
        // A loss has a scale of its own, and may be 0.
        (Measure::Length, Some(loss)) if run.tuning.is_some() => rounded(loss),
        (Measure::Length, Some(length)) => rounded(length / reference),
        (Measure::Gap, Some(_)) => rounded(counted_gap(run, reference)),
    };
    planners.clone().map(|p| grid.runs(p, scene).iter().map(value).collect()).collect()
}

/// The nearest multiple of the resolution.
pub fn rounded(value: f64) -> f64 {
    (value / RESOLUTION).round() * RESOLUTION
}

#[cfg(test)]
mod tests {
    use super::super::testing::{one_scene, results, run};
    use super::*;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn repeats_of_one_scene() {
        let mut results = one_scene(&[("a", &[1.0, INF, 1e-9]), ("b", &[2.0, 2.0, 2.0])]);
        results.runs.remove(4);
        let grid = Grid::new(&results);
        assert_eq!(quality(&grid), Measure::Gap);
        let blocks = Blocks::new(&grid, Measure::Gap);
        assert_eq!(blocks.over, Over::Repeats);
        // 10⁻¹¹ is no gap; 1 % and 2 % are whole multiples of the resolution but for one rounding.
        let near = |v: Option<f64>, e: f64| v == Some(e) || v.is_some_and(|v| (v - e).abs() < 1e-15);
        let [a, b] = &blocks.values[..] else { panic!() };
        assert!(near(a[0], 0.01) && near(a[1], INF) && near(a[2], 0.0), "{a:?}");
        assert!(near(b[0], 0.02) && b[1].is_none() && near(b[2], 0.02), "{b:?}");
        assert_eq!(blocks.settled, [false, true]);
        assert_eq!(blocks.both(0, 1).0.len(), 2);
    }

    #[test]
    fn scenes_are_the_blocks_where_there_are_several() {
        let lengths = [("s", "a", [11.0, 12.0, INF]), ("t", "a", [20.0, INF, INF]), ("s", "b", [10.5, 10.5, 10.5])];
        let runs = lengths.iter().flat_map(|(s, p, l)| (0..).zip(l).map(|(i, l)| run(s, p, i, *l))).collect();
        let results = results(&["a", "b"], &[("s", Some(10.0)), ("t", None)], runs);
        let grid = Grid::new(&results);
        assert_eq!(quality(&grid), Measure::Length);
        let blocks = Blocks::new(&grid, Measure::Length);
        assert_eq!(blocks.over, Over::Scenes);
        let a: Vec<f64> = blocks.values[0].iter().map(|v| v.unwrap()).collect();
        // 1e-15: a few roundings of the quotient.
        assert!((a[0] - 1.2).abs() < 1e-15 && a[1] == INF, "{a:?}");
        assert_eq!(blocks.values[1][1], None, "b has no runs in t");
        assert_eq!(blocks.settled, [false, false]);
    }
}
