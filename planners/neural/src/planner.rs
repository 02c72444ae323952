//! Sweeps to the steady state, then a climb from the start.

use env_model::{CellGrid, path_length};
use planner_api::{CellsView, Plan, PlanError, Planner, Problem, Run, SettingError, Status, View};

use crate::{Network, NeuralSettings};

/// Lets the network settle, then climbs its activity from start to goal.
///
/// An iteration is a sweep over all neurons; each neuron's update is an
/// evaluation, so a budget of evaluations smaller than the grid allows no sweep.
/// When the budget ends the sweeps the climb is tried on what there is. The cost
/// is the path's length, +∞ until the climb. `NotFound` means that on this
/// grid the start feels nothing of the goal (or that activity has saturated).
/// A gap through which the robot's centre has less than about two cells to pass may be
/// closed on it; a finer grid may open it.
#[derive(Debug, Clone)]
pub struct Neural {
    settings: NeuralSettings,
    network: Network,
    /// Where the path leaves the grid for the goal, with distances; likewise for the start.
    exits: Vec<(usize, f64)>,
    entries: Vec<(usize, f64)>,
}

impl Neural {
    /// A planner with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: NeuralSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, network: Network::default(), exits: Vec::new(), entries: Vec::new() })
    }

    /// Lays the network and joins start and goal to it. Left half done when the run's time is over.
    fn set_up(&mut self, problem: &Problem<'_>, grid: &CellGrid, run: &mut Run<'_>) -> Result<(), PlanError> {
        let tests = self.network.lay(problem.world, grid, &self.settings, || run.in_time());
        run.spent.collision_checks += tests;
        if run.stopped() {
            return Ok(());
        }
        let checks = &mut run.spent.collision_checks;
        let joints = [&mut self.entries, &mut self.exits];
        problem.join(grid, self.network.blocked(), ("cells", self.settings.cells), joints, checks)?;
        for (cell, _) in &self.exits {
            self.network.excite(*cell, &self.settings);
        }
        Ok(())
    }

    /// Writes the climb from the start's most active cell into `plan`; leaves
    /// the path empty where it ends short of the goal.
    fn climb(&self, problem: &Problem<'_>, grid: &CellGrid, run: &mut Run<'_>, plan: &mut Plan) {
        let activity = self.network.activity();
        let more_active = |a: usize, b: usize| if activity[b] > activity[a] { b } else { a };
        let entry = self.entries.iter().map(|(cell, _)| *cell).reduce(more_active);
        plan.path.push(problem.start);
        let mut at = entry;
        while let Some(cell) = at {
            push(plan, grid.centre(cell));
            if self.exits.iter().any(|(exit, _)| *exit == cell) {
                push(plan, problem.goal);
                break;
            }
            at = self.network.uphill(cell);
        }
        run.spent.collision_checks += plan.path.len() as u64 - 1;
        if at.is_some() && problem.world.path_free(&plan.path) {
            plan.cost = path_length(&plan.path);
        } else {
            plan.path.clear();
        }
    }

    fn report(&self, grid: &CellGrid, run: &mut Run<'_>, plan: &Plan) {
        run.report("neural", plan.cost, || {
            View::Cells(CellsView {
                grid,
                blocked: self.network.blocked(),
                states: &[],
                values: self.network.activity(),
                quantity: "activity",
                borders: &[],
                path: &plan.path,
            })
        });
    }
}

/// Appends a point that differs from the last.
fn push(plan: &mut Plan, p: env_model::Point) {
    if plan.path.last() != Some(&p) {
        plan.path.push(p);
    }
}

impl Planner for Neural {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let grid = CellGrid::along_longer_side(&problem.world.extent(), self.settings.cells);
        self.set_up(problem, &grid, run)?;
        if run.stopped() {
            plan.counters = run.spent;
            return Ok(Status::BudgetSpent);
        }
        self.report(&grid, run, plan);
        let mut change = f64::INFINITY;
        let mut sweeps = 0;
        while change > self.settings.tolerance && sweeps < self.settings.sweeps && run.allows(self.network.len() as u64)
        {
            change = self.network.sweep(sweeps % 2 == 0, &self.settings);
            sweeps += 1;
            run.spent.iterations += 1;
            run.spent.evaluations += self.network.len() as u64;
            self.report(&grid, run, plan);
        }
        self.climb(problem, &grid, run, plan);
        self.report(&grid, run, plan);
        plan.counters = run.spent;
        Ok(match () {
            () if run.stopped() => Status::BudgetSpent,
            () if plan.path.is_empty() => Status::NotFound,
            () => Status::Solved,
        })
    }
}
