//! The runs by planner and scene.

use std::collections::BTreeMap;

use crate::results::{PlannerInfo, Results, RunRecord, SceneResult, SceneSet};

/// The runs of one set of scenes by planner and scene, each cell sorted by repeat.
pub struct Grid<'a> {
    /// The planners, in the comparison file's order.
    pub planners: &'a [PlannerInfo],
    /// The scenes of the set, in the comparison file's order.
    pub scenes: Vec<&'a SceneResult>,
    cells: Vec<Vec<&'a RunRecord>>,
}

impl<'a> Grid<'a> {
    /// The test scenes, which are the evidence.
    pub fn new(results: &'a Results) -> Self {
        Self::of_set(results, SceneSet::Test)
    }

    /// The scenes of a set.
    pub fn of_set(results: &'a Results, set: SceneSet) -> Self {
        let scenes: Vec<&SceneResult> = results.scenes.iter().filter(|s| s.set == set).collect();
        let columns: BTreeMap<&str, usize> = results.planners.iter().map(|p| p.label.as_str()).zip(0..).collect();
        let rows: BTreeMap<&str, usize> = scenes.iter().map(|s| s.scene.name.as_str()).zip(0..).collect();
        let mut cells = vec![Vec::new(); columns.len() * scenes.len()];
        for run in &results.runs {
            if let (Some(p), Some(s)) = (columns.get(run.planner.as_str()), rows.get(run.scene.as_str())) {
                cells[p * scenes.len() + s].push(run);
            }
        }
        for cell in &mut cells {
            cell.sort_by_key(|run: &&RunRecord| run.repeat);
        }
        Self { planners: &results.planners, scenes, cells }
    }

    /// The same planners in one scene alone, for what is said of that scene.
    pub fn only(&self, scene: usize) -> Self {
        let cells = (0..self.planners.len()).map(|p| self.runs(p, scene).to_vec()).collect();
        Self { planners: self.planners, scenes: vec![self.scenes[scene]], cells }
    }

    /// The runs of one planner in one scene, sorted by repeat.
    pub fn runs(&self, planner: usize, scene: usize) -> &[&'a RunRecord] {
        &self.cells[planner * self.scenes.len() + scene]
    }

    /// The runs of one planner in one scene or (`None`) in all of them.
    pub fn runs_in(&self, planner: usize, scene: Option<usize>) -> impl Iterator<Item = &'a RunRecord> {
        let scenes = scene.map_or(0..self.scenes.len(), |s| s..s + 1);
        scenes.flat_map(move |s| self.runs(planner, s).iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{results, run};
    use super::*;

    #[test]
    fn tuning_scenes_are_no_evidence() {
        let cells = [("t", "b"), ("s", "a"), ("u", "b"), ("s", "b")];
        let runs = cells.iter().flat_map(|(s, p)| [1, 0].map(|i| run(s, p, i, 11.0))).collect();
        let mut results = results(&["b", "a"], &[("u", None), ("t", None), ("s", None)], runs);
        results.scenes[1].set = SceneSet::Tuning;
        let shape = |grid: &Grid<'_>| -> Vec<(String, usize)> {
            let one =
                |s: usize| (grid.scenes[s].scene.name.clone(), grid.runs(0, s).len() + 10 * grid.runs(1, s).len());
            (0..grid.scenes.len()).map(one).collect()
        };
        let test = Grid::new(&results);
        assert_eq!(shape(&test), [("u".into(), 2), ("s".into(), 22)]);
        assert_eq!(shape(&Grid::of_set(&results, SceneSet::Tuning)), [("t".into(), 2)]);
        assert_eq!(shape(&test.only(1)), [("s".into(), 22)]);
        assert_eq!(test.runs(1, 1).iter().map(|r| r.repeat).collect::<Vec<_>>(), [0, 1]);
        assert_eq!((test.runs_in(0, None).count(), test.runs_in(0, Some(1)).count()), (4, 2));
    }
}
