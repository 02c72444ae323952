//! Watching a planner at work.

use std::ops::ControlFlow;

use env_model::{Columns, Point};

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
    /// Best cost so far by the planner's own objective; never rises within a stage.
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
