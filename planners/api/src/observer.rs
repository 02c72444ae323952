//! Watching a planner at work.

use std::ops::ControlFlow;

use env_model::{CellGrid, Columns, Point, Vector};

use crate::Candidates;

/// How much an observer wants to see.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// Nothing: planners skip the call.
    None,
    /// Counters and best cost; [`View::Progress`] suffices.
    Progress,
    /// The planner's state as well.
    State,
}

/// Gets a frame after initialisation and after every iteration.
pub trait Observer {
    /// What the frames should hold; asked once a run.
    fn detail(&self) -> Detail {
        Detail::State
    }

    /// Sees a frame; `Break` ends the run like a spent budget.
    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()>;
}

/// Observes nothing and costs nothing.
impl Observer for () {
    fn detail(&self) -> Detail {
        Detail::None
    }

    fn frame(&mut self, _: &Frame<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// The state of a run after an iteration.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// Which stage of a composition: `"pso"`, `"qp"`, ….
    pub stage: &'static str,
    /// Iterations so far; 0 is the state after initialisation.
    pub iteration: u64,
    /// Evaluations so far.
    pub evaluations: u64,
    /// Best cost so far by the planner's own objective; never rises within a stage. +∞ while that is only a penalty
    /// on a path that collides: see [`Told`](crate::Told).
    pub best_cost: f64,
    /// The planner's state.
    pub view: View<'a>,
}

/// A view of a planner's state.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub enum View<'a> {
    /// No more than the counters.
    Progress,
    /// The best path so far.
    Path(&'a [Point]),
    /// A particle swarm in the column model.
    Swarm(SwarmView<'a>),
    /// A search, an activity or a trail on cells.
    Cells(CellsView<'a>),
    /// Trees of points.
    Trees(&'a [TreeView<'a>]),
    /// A population of candidate paths.
    Population(PopulationView<'a>),
    /// A field of forces and the way that the robot took through it.
    Forces(ForcesView<'a>),
}

/// What a planner on a cell grid knows. Slices over cells hold one entry a
/// cell, in the grid's numbering, or are empty where the planner has no such thing.
#[derive(Debug, Clone, Copy)]
pub struct CellsView<'a> {
    /// The grid.
    pub grid: &'a CellGrid,
    /// Cells that cannot be entered.
    pub blocked: &'a [bool],
    /// What the search has done with each cell.
    pub states: &'a [CellState],
    /// A number for each cell: risk, activity, pheromone; drawn as heat.
    pub values: &'a [f64],
    /// What `values` are: `"risk"`, `"activity"`, `"pheromone"`; a key for translations.
    pub quantity: &'static str,
    /// Borders between regions, as segments in scene units.
    pub borders: &'a [(Point, Point)],
    /// The best path so far; empty without one.
    pub path: &'a [Point],
}

/// What a search has done with a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CellState {
    /// Never reached, or outside the search space.
    #[default]
    Untouched,
    /// Reached, waiting to be expanded.
    Open,
    /// Expanded.
    Closed,
}

/// A tree: node i hangs on node `parents[i]`; a root is its own parent.
#[derive(Debug, Clone, Copy)]
pub struct TreeView<'a> {
    /// The nodes, in scene units.
    pub nodes: &'a [Point],
    /// Their parents, as indices into `nodes`.
    pub parents: &'a [u32],
}

/// A population of n individuals.
#[derive(Debug, Clone, Copy)]
pub struct PopulationView<'a> {
    /// The paths that they stand for, n; they may collide.
    pub paths: &'a Candidates,
    /// Their fitness, n; larger is better.
    pub fitness: &'a [f64],
    /// The cells that the chromosomes number; `None` for other encodings.
    pub grid: Option<&'a CellGrid>,
    /// The best path so far.
    pub best: &'a [Point],
}

/// A force field, sampled for observers, and the robot's way in it.
#[derive(Debug, Clone, Copy)]
pub struct ForcesView<'a> {
    /// Where the field is sampled: the cells' centres.
    pub grid: &'a CellGrid,
    /// The force at each cell's centre, zero inside obstacles.
    pub forces: &'a [Vector],
    /// Where the robot has been, ends included.
    pub trail: &'a [Point],
    /// Where it got stuck, if it did.
    pub stuck: Option<Point>,
}

/// A swarm of n particles with m heights each, in the local frame of `columns`.
/// Matrices are row-major, n × m: one particle after the other.
#[derive(Debug, Clone, Copy)]
pub struct SwarmView<'a> {
    /// The search model; m = `columns.count()`.
    pub columns: &'a Columns,
    /// Heights y', n × m, scene units.
    pub positions: &'a [f64],
    /// Velocities, n × m, scene units an iteration.
    pub velocities: &'a [f64],
    /// Personal best heights, n × m.
    pub personal_bests: &'a [f64],
    /// Their costs, n.
    pub personal_costs: &'a [f64],
    /// Global best heights, m.
    pub global_best: &'a [f64],
    /// Its cost.
    pub global_cost: f64,
}
