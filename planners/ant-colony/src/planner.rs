//! The colony's loop: walk, evaporate, lay.

use planner_api::{CellsView, Detail, Plan, PlanError, Planner, Problem, Run, SettingError, Status, View};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::Settings;
use crate::map::Map;
use crate::tour::{Loops, lay, length};
use crate::trails::Trails;
use crate::walk::{End, Walker};

/// Ant System (Dorigo, Maniezzo & Colorni 1996) for paths on a cell grid.
///
/// An iteration sends m ants; an evaluation is one ant's tour, finished or not.
/// Collision checks are the cell–shape tests of the occupancy and the segments of
/// the path: moves between free cells need none. The cost is the best tour's
/// length in scene units. Where an end is joined to several cells, the ants are
/// shared out over them. When one that may step back finds no way, there is none on this
/// grid, and the colony stops. A gap through which the robot's centre has less than
/// about two cells to pass may be closed on the grid, and so the answer `NotFound`; a
/// finer grid may open it. A deadline is overshot by one ant, or the building of
/// the grid, at most.
#[derive(Debug, Clone)]
pub struct AntColony {
    settings: Settings,
    map: Map,
    trails: Trails,
    walker: Walker,
    loops: Loops,
    /// Tours of an iteration, one after the other, and where each ends, with its length.
    tours: Vec<u32>,
    ends: Vec<(usize, f64)>,
    tour: Vec<u32>,
    best: Vec<u32>,
    cells: Vec<usize>,
    shown: Vec<f64>,
}

impl AntColony {
    /// A planner with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: Settings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self {
            settings,
            map: Map::new(),
            trails: Trails::default(),
            walker: Walker::default(),
            loops: Loops::default(),
            tours: Vec::new(),
            ends: Vec::new(),
            tour: Vec::new(),
            best: Vec::new(),
            cells: Vec::new(),
            shown: Vec::new(),
        })
    }

    fn begin(&mut self, problem: &Problem<'_>, run: &mut Run<'_>) -> Result<(), PlanError> {
        let Settings { cells, beta, alpha, initial_trail, .. } = self.settings;
        self.map.rebuild(problem, cells, beta, &mut run.spent.collision_checks)?;
        let cells = self.map.grid.len();
        self.trails.reset(cells, initial_trail, alpha);
        self.walker.reset(cells);
        self.loops.reset(cells);
        self.best.clear();
        Ok(())
    }

    fn report(&mut self, run: &mut Run<'_>, plan: &Plan) {
        if run.detail() == Detail::State {
            self.trails.write_strongest(&self.map.moves, &mut self.shown);
        }
        run.report("ant-colony", plan.cost, || {
            View::Cells(CellsView {
                grid: &self.map.grid,
                blocked: &self.map.blocked,
                states: &[],
                values: &self.shown,
                quantity: "pheromone",
                borders: &[],
                path: &plan.path,
            })
        });
    }

    /// Sends the ants, keeps their tours and the best of all; whether there may be a way.
    fn send(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, rng: &mut ChaCha8Rng, plan: &mut Plan) -> bool {
        self.tours.clear();
        self.ends.clear();
        let mut dead = 0;
        for ant in 0..self.settings.ants {
            if !run.in_time() {
                break;
            }
            let (entry, first) = self.map.entries[ant % self.map.entries.len()];
            let walk = (&self.map, &self.trails);
            let end = self.walker.walk(walk, entry, self.settings.dead_end, rng, &mut self.tour);
            run.spent.evaluations += 1;
            if end == End::Arrived {
                self.loops.cut(&self.map, &mut self.tour);
                let length = length(&self.map, first, &self.tour);
                self.tours.extend_from_slice(&self.tour);
                self.ends.push((self.tours.len(), length));
                if length < plan.cost {
                    plan.cost = length;
                    self.best.clone_from(&self.tour);
                    self.cells.clear();
                    self.cells.extend(self.best.iter().map(|cell| *cell as usize));
                    self.map.grid.write_path(problem.start, &self.cells, problem.goal, &mut plan.path);
                }
            }
            dead += usize::from(end == End::Exhausted);
        }
        // The ants are shared out over the entries: one from each has looked everywhere.
        !self.best.is_empty() || dead < self.map.entries.len()
    }

    /// Evaporates the trails and lays those of the iteration and of the elitists.
    fn lay(&mut self, best: f64) {
        let Settings { rho, q, elitists, alpha, .. } = self.settings;
        let size = self.map.grid.size();
        self.trails.evaporate(rho);
        let mut begin = 0;
        for &(end, length) in &self.ends {
            lay(&self.map, &self.tours[begin..end], &mut self.trails, q * size / length);
            begin = end;
        }
        lay(&self.map, &self.best, &mut self.trails, elitists * q * size / best);
        self.trails.raise(alpha);
    }
}

impl Planner for AntColony {
    /// # Errors
    /// [`PlanError::GridTooCoarse`] where an end sees no free cell.
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let ants = self.settings.ants as u64;
        if run.allows(ants) {
            self.begin(problem, run)?;
            self.report(run, plan);
            let mut rng = ChaCha8Rng::seed_from_u64(run.seed);
            for _ in 0..self.settings.iterations {
                if !run.allows(ants) {
                    break;
                }
                let hope = self.send(problem, run, &mut rng, plan);
                self.lay(plan.cost);
                run.spent.iterations += 1;
                self.report(run, plan);
                if !hope {
                    break;
                }
            }
            run.spent.collision_checks += plan.path.len().saturating_sub(1) as u64;
        }
        plan.counters = run.spent;
        Ok(match run.stopped() {
            true => Status::BudgetSpent,
            false if !plan.path.is_empty() && problem.world.path_free(&plan.path) => Status::Solved,
            false => Status::NotFound,
        })
    }
}
