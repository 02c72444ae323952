//! The gap of a run against its effort.
//!
//! How good a run was is the judge's word on its final path: one that is not valid was never any good. When it
//! became so good is read off the planner's own progress, where its cost is a length (of no valid run the final
//! cost, or the last of its progress where a run tells none, differs from the length by more than 10⁻⁵ of it);
//! otherwise, and at the latest, it did when the run ended. Runs that did not live to tell their evaluations are
//! charged as in [`super::spent`].

use super::grid::Grid;
use super::spent::Evaluations;
use crate::results::RunRecord;

/// A valid path's cost that differs from its length by more than this share is not a length: arcs stored as
/// polylines differ from the arc's length by up to 10⁻⁶, sums by their rounding.
const OTHER: f64 = 1e-5;

/// What a planner spends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effort {
    /// Evaluations of its own objective.
    Evaluations,
    /// Wall time, µs.
    Time,
}

/// A run's gap from some effort on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Step {
    pub evaluations: f64,
    pub time_us: f64,
    /// length/optimum − 1; the length itself where no optimum is known.
    pub gap: f64,
}

impl Step {
    /// The effort from which on the gap holds.
    pub fn at(&self, effort: Effort) -> f64 {
        match effort {
            Effort::Evaluations => self.evaluations,
            Effort::Time => self.time_us,
        }
    }
}

/// One run: its course and what it spent in all.
pub(crate) struct Course {
    /// Ever smaller gaps; none for a run without a valid path.
    pub steps: Vec<Step>,
    /// What was spent at the run's end.
    pub end: Step,
}

/// The courses of all runs in scenes whose optimum is known.
pub struct Curves {
    scenes: usize,
    planners: usize,
    /// Cells as in the grid; none of the scenes without optimum.
    cells: Vec<Vec<Course>>,
    with_optimum: Vec<usize>,
    /// For each planner whether the evaluations of all its runs are known.
    counted: Vec<bool>,
    charged: Vec<bool>,
}

impl Curves {
    /// Reads every run's progress.
    pub fn new(grid: &Grid<'_>) -> Self {
        let (planners, scenes) = (grid.planners.len(), grid.scenes.len());
        let mut cells = Vec::with_capacity(planners * scenes);
        let (mut counted, mut charged) = (Vec::with_capacity(planners), Vec::with_capacity(planners));
        for planner in 0..planners {
            let lengths = grid.runs_in(planner, None).all(cost_is_length);
            let spent = Evaluations::of(&grid.planners[planner], grid.runs_in(planner, None));
            counted.push(grid.runs_in(planner, None).all(|run| spent.spent(run).is_some()));
            let valid = || grid.runs_in(planner, None).filter(|r| r.valid);
            charged.push(valid().next().is_some() && (!lengths || valid().all(|r| r.progress.is_empty())));
            for (s, scene) in grid.scenes.iter().enumerate() {
                let runs = if scene.optimum.length.is_some() { grid.runs(planner, s) } else { &[] };
                let course = |run: &&RunRecord| Course::new(run, spent.spent(run), scene.optimum.length, lengths);
                cells.push(runs.iter().map(course).collect());
            }
        }
        let with_optimum = (0..scenes).filter(|s| grid.scenes[*s].optimum.length.is_some()).collect();
        Self { scenes, planners, cells, with_optimum, counted, charged }
    }

    /// The scenes whose optimum is known: no other enters.
    pub fn scenes(&self) -> &[usize] {
        &self.with_optimum
    }

    /// Whether of no valid run of this planner is known when it became good, so that each is charged in full.
    pub fn charged(&self, planner: usize) -> bool {
        self.charged[planner]
    }

    /// Planners of the grid.
    pub(super) fn planners(&self) -> usize {
        self.planners
    }

    /// Whether it is known how much of `effort` every run of the planner took.
    pub(super) fn known(&self, planner: usize, effort: Effort) -> bool {
        effort == Effort::Time || self.counted[planner]
    }

    /// The runs of one planner in one scene or (`None`) in all with an optimum.
    pub(super) fn of(&self, planner: usize, scene: Option<usize>) -> impl Iterator<Item = &Course> {
        let scenes = scene.map_or(0..self.scenes, |s| s..s + 1);
        scenes.flat_map(move |s| &self.cells[planner * self.scenes + s])
    }
}

/// Whether nothing speaks against the planner's cost being the path's length.
pub(crate) fn cost_is_length(run: &RunRecord) -> bool {
    // Where the final cost is left out, the last improvement is of the final path.
    let cost = run.cost.or_else(|| run.progress.last().map(|p| p.cost));
    match (run.valid, cost, run.length) {
        (true, Some(cost), Some(length)) => (cost - length).abs() <= OTHER * length.abs(),
        _ => true,
    }
}

impl Course {
    /// Of a run in a scene of that optimum, charged `spent` evaluations, whose planner's costs are `lengths` or are not.
    pub fn new(run: &RunRecord, spent: Option<f64>, optimum: Option<f64>, lengths: bool) -> Self {
        let evaluations = spent.unwrap_or(run.evaluations as f64);
        let end = Step { evaluations, time_us: run.time_us, gap: f64::INFINITY };
        let Some(length) = run.length.filter(|_| run.valid) else { return Self { steps: Vec::new(), end } };
        let value = |length: f64| optimum.map_or(length, |optimum| (length / optimum - 1.0).max(0.0));
        let gap = value(length);
        let mut steps: Vec<Step> = Vec::new();
        for p in run.progress.iter().filter(|p| lengths && p.cost.is_finite()) {
            let step = Step {
                evaluations: end.evaluations.min(p.evaluations as f64),
                time_us: end.time_us.min(p.time_us),
                gap: gap.max(value(p.cost)),
            };
            if steps.last().is_none_or(|last| step.gap < last.gap) {
                steps.push(step);
            }
        }
        if steps.last().is_none_or(|last| gap < last.gap) {
            steps.push(Step { gap, ..end });
        }
        Self { steps, end }
    }
}
