//! The planner: a search from start to goal within the run's budget.

use planner_api::{CellsView, Plan, PlanError, Planner, Problem, Run, SettingError, Status, View};

use crate::Settings;
use crate::graph::Graph;
use crate::method::Method;
use crate::search::Search;

/// A*, Dijkstra or Theta* on a cell grid.
///
/// An iteration expands a node; an evaluation generates a successor. Collision
/// checks are the cell–shape tests of the occupancy, the segments tested for sight
/// and those of the path. The cost is the path's length in scene units. A path
/// that the search has reached when the budget ends is returned even if not proved
/// to be the shortest. Observers of Dijkstra's algorithm see every cell's distance, +∞
/// for cells never reached. `NotFound` means that there is no way on this grid: a gap
/// through which the robot's centre has less than about two cells to pass may be closed
/// on it, and a finer grid may open it. A deadline is overshot by the building of the grid at most.
#[derive(Debug, Clone)]
pub struct GridSearch {
    settings: Settings,
    method: Method,
    graph: Graph,
    search: Search,
    chain: Vec<usize>,
}

impl GridSearch {
    /// The A* algorithm (Hart, Nilsson & Raphael 1968) with the octile distance.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn astar(settings: Settings) -> Result<Self, SettingError> {
        Self::new(settings, Method::AStar)
    }

    /// Dijkstra's algorithm (1959).
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn dijkstra(settings: Settings) -> Result<Self, SettingError> {
        Self::new(settings, Method::Dijkstra)
    }

    /// Basic Theta* (Nash, Daniel, Koenig & Felner 2007).
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn theta_star(settings: Settings) -> Result<Self, SettingError> {
        Self::new(settings, Method::ThetaStar)
    }

    fn new(settings: Settings, method: Method) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, method, graph: Graph::new(), search: Search::new(method), chain: Vec::new() })
    }

    fn stage(&self) -> &'static str {
        match self.method {
            Method::AStar => "astar",
            Method::Dijkstra => "dijkstra",
            Method::ThetaStar => "theta-star",
        }
    }

    fn report(&self, run: &mut Run<'_>, plan: &Plan) {
        let cells = self.graph.grid.len();
        let reached = &self.search.reached;
        run.report(self.stage(), plan.cost, || {
            View::Cells(CellsView {
                grid: &self.graph.grid,
                blocked: &self.graph.blocked,
                states: &reached.states()[..cells],
                values: if self.method == Method::Dijkstra { &reached.distances()[..cells] } else { &[] },
                quantity: "distance",
                borders: &[],
                path: &plan.path,
            })
        });
    }

    /// Searches until the goal is closed; whether it was.
    fn search(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> bool {
        self.search.begin(&self.graph);
        self.report(run, plan);
        let goal = self.graph.goal();
        while let Some(node) = self.search.next() {
            if node == goal {
                return true;
            }
            if !run.allows(self.graph.most_successors(node)) {
                return false;
            }
            let checks = &mut run.spent.collision_checks;
            let generated = self.search.expand(&self.graph, problem.world, node, checks);
            run.spent.iterations += 1;
            run.spent.evaluations += generated;
            if self.search.reached.distance(goal) < plan.cost {
                plan.cost = self.search.reached.distance(goal);
                self.search.reached.write_chain(goal, &mut self.chain);
                let cells = &self.chain[1..self.chain.len() - 1];
                self.graph.grid.write_path(problem.start, cells, problem.goal, &mut plan.path);
            }
            self.report(run, plan);
        }
        false
    }
}

impl Planner for GridSearch {
    /// # Errors
    /// [`PlanError::GridTooCoarse`] where an end sees no free cell.
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let mut closed = false;
        // The start has at least one successor.
        if run.allows(1) {
            self.graph.rebuild(problem, self.settings.cells, &mut run.spent.collision_checks)?;
            closed = self.search(problem, run, plan);
            run.spent.collision_checks += plan.path.len().saturating_sub(1) as u64;
        }
        plan.counters = run.spent;
        Ok(match closed {
            true if problem.world.path_free(&plan.path) => Status::Solved,
            false if run.stopped() => Status::BudgetSpent,
            _ => Status::NotFound,
        })
    }
}
