//! The planner: search, widening, path.

use std::f64::consts::SQRT_2;

use planner_api::{Plan, PlanError, Planner, Problem, Run, SettingError, Status, View};

use crate::cost::Cost;
use crate::estimate::Estimate;
use crate::map::Map;
use crate::search::{Search, Terrain};
use crate::space::Space;
use crate::{SearchSpace, Settings};

/// A* over influence regions and risk.
///
/// The player on the ball, q, is the start. Defenders are the obstacles whose label
/// begins with "opponent", or all of them if there is none such (a reading: the
/// paper's pitch tells sides apart, a scene need not); they stand at the centre of
/// a disc, the middle of a capsule's axis or of a polygon's box. Levels are
/// taken at the cells' centres from [`env_model::influence::level`], which is what
/// the regions of [`env_model::Partition`] have; their borders are drawn for observers.
///
/// The path runs from the start through the centres of its cells to the goal.
/// Costs are those of the cells alone, as in the paper; only where an end's own
/// cell is blocked or out of sight does the straight leg to a cell nearby count in L.
///
/// `Plan::cost` is g = a·L + b·W; `Plan::terms` are `length`, L in units of `dis` a
/// cell, and `risk`, W. An iteration is the expansion of a cell, a reopened one anew;
/// an evaluation is a successor generated, or a cell where the path may start.
/// Draws no random numbers.
///
/// `NotFound` means that there is no way on this grid, or with soft obstacles that
/// the path collides. A gap through which the robot's centre has less than about two
/// cells to pass may be closed on the grid, and a finer grid may open it. A deadline
/// interrupts the risk map and the search; the rest of the setting up (occupancy,
/// joints of the ends, for each rectangle its cells and estimates) is not interrupted.
#[derive(Debug, Clone)]
pub struct InfluenceAstar {
    settings: Settings,
    map: Map,
    barred: Vec<bool>,
    estimate: Estimate,
    search: Search,
    /// The cells of the best path.
    cells: Vec<usize>,
}

impl InfluenceAstar {
    /// A planner with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: Settings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self {
            map: Map::new(),
            barred: Vec::new(),
            estimate: Estimate::new(settings.heuristic),
            search: Search::default(),
            cells: Vec::new(),
            settings,
        })
    }

    /// Searches `space`; writes `plan` whenever a path is cheaper than `best`.
    fn search(&mut self, space: &Space, best: &mut Cost, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) {
        let Self { settings, map, barred, estimate, search, cells } = self;
        let starts = map.ends.starts.len() as u64;
        if !run.allows_setup(starts) {
            return;
        }
        barred.clear();
        barred.extend((0..map.grid.len()).map(|cell| map.blocked[cell] || !space.contains(map.grid.position(cell))));
        estimate.prepare(map, barred);
        let terrain = Terrain { map, barred, estimate };

        search.begin(&terrain);
        run.spent.evaluations += starts;
        run.report(STAGE, plan.cost, || View::Cells(map.view(search, &plan.path)));
        while let Some(cell) = search.next(&terrain) {
            let successors = search.look_round(&terrain, cell);
            if !run.allows(successors) {
                return;
            }
            search.expand(&terrain, cell);
            run.spent.iterations += 1;
            run.spent.evaluations += successors;
            if search.goal_cost() < *best {
                *best = search.goal_cost();
                search.trace(cells);
                write(settings, map, cells, problem, plan);
            }
            run.report(STAGE, plan.cost, || View::Cells(map.view(search, &plan.path)));
        }
    }

    /// Whether a wider rectangle is worth a search, after one that improved the
    /// best cost from `before` to `best`.
    fn widens(&self, before: Cost, best: Cost, plan: &Plan) -> bool {
        if best == Cost::UNREACHED {
            return true;
        }
        let risk = plan.terms.iter().find(|term| term.0 == RISK).map_or(0.0, |term| term.1);
        let gain = before.objective.saturating_sub(best.objective) as f64;
        risk > self.settings.theta * self.cells.len() as f64
            && (before == Cost::UNREACHED || gain > self.settings.eta * before.objective as f64)
    }
}

const STAGE: &str = "influence-astar";
const RISK: &str = "risk";

impl Planner for InfluenceAstar {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        self.map.prepare(&self.settings, problem, run)?;
        if run.stopped() {
            plan.counters = run.spent;
            return Ok(Status::BudgetSpent);
        }
        let grid = self.map.grid;
        let whole = Space::whole(&grid);
        let ends = &self.map.ends;
        let mut space = match self.settings.search_space {
            SearchSpace::Pitch => whole,
            SearchSpace::Rectangle => {
                let own = [grid.cell_at(problem.start), ends.goal_cell];
                Space::round(&grid, ends.starts.iter().chain(&ends.goals).map(|joint| joint.cell).chain(own))
            }
        };
        let mut best = Cost::UNREACHED;
        loop {
            let before = best;
            self.search(&space, &mut best, problem, run, plan);
            if run.stopped() || space == whole || !self.widens(before, best, plan) {
                break;
            }
            space = space.widened(&grid, self.settings.widening);
        }

        run.spent.collision_checks += plan.path.len().saturating_sub(1) as u64;
        let free = !plan.path.is_empty() && problem.world.path_free(&plan.path);
        plan.counters = run.spent;
        Ok(match (run.stopped(), free) {
            (true, _) => Status::BudgetSpent,
            (false, true) => Status::Solved,
            (false, false) => Status::NotFound,
        })
    }
}

/// Writes the path through `cells`, its cost and terms.
fn write(settings: &Settings, map: &Map, cells: &[usize], problem: &Problem<'_>, plan: &mut Plan) {
    let grid = &map.grid;
    plan.path.clear();
    plan.path.push(problem.start);
    let inner = cells.iter().map(|cell| grid.centre(*cell)).filter(|p| *p != problem.start && *p != problem.goal);
    plan.path.extend(inner);
    plan.path.push(problem.goal);

    let diagonal = |w: &&[usize]| {
        let (a, b) = (grid.position(w[0]), grid.position(w[1]));
        a.0 != b.0 && a.1 != b.1
    };
    let diagonals = cells.windows(2).filter(diagonal).count();
    let straights = cells.len() - 1 - diagonals;
    let leg =
        |joints: &[crate::map::Joint], end: usize| joints.iter().find(|j| j.cell == end).map_or(0.0, |j| j.length);
    let legs = leg(&map.ends.starts, cells[0]) + leg(&map.ends.goals, cells[cells.len() - 1]);
    let length = settings.dis * (straights as f64 + SQRT_2 * diagonals as f64) + legs;
    let risk: f64 = cells.iter().map(|cell| map.risk.values()[*cell]).sum();
    // Costs are compared in quanta; among paths that those cannot tell apart,
    // rounding must not let the best cost rise.
    plan.cost = plan.cost.min(settings.a * length + settings.b * risk);
    plan.terms.clear();
    plan.terms.extend([("length", length), (RISK, risk)]);
}
