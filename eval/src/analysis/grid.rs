//! The runs by planner and scene.

use std::collections::BTreeMap;

use crate::results::{PlannerInfo, Results, RunRecord, SceneResult, SceneSet};

/// The runs of the scenes that count, by planner and scene, each cell sorted by repeat.
pub struct Grid<'a> {
    /// The planners, in the comparison file's order.
    pub planners: &'a [PlannerInfo],
    /// The scenes that count, in the comparison file's order.
    pub scenes: Vec<&'a SceneResult>,
    cells: Vec<Vec<&'a RunRecord>>,
}

impl<'a> Grid<'a> {
    /// Sorts the runs of `results`.
    pub fn new(results: &'a Results) -> Self {
        let scenes: Vec<&SceneResult> = results.scenes.iter().filter(|s| s.set == SceneSet::Test).collect();
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
