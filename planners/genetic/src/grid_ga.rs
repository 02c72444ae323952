//! The genetic algorithm on numbered cells (Fang 2009, §4.5).
//!
//! A chromosome is a list of cell numbers, as long as it needs, from the start's
//! cell to the goal's. It stands for the path from the start through the centres
//! of the cells between to the goal; neighbouring genes need not be neighbouring
//! cells, the line between them is tested exactly. A generation selects by
//! roulette (one elite survives), exchanges tails, mutates, then mends: insertion,
//! deletion, smoothing.

use env_model::{CellGrid, Point};
use planner_api::{Plan, PlanError, Planner, Problem, Run, SettingError, Status};

use crate::cells::{CellBuffers, Cells};
use crate::crossover::exchange_tails;
use crate::dice::Dice;
use crate::evolution::{Evolution, Limits, Parents, Species};
use crate::mutation::{mutate_path, radius};
use crate::population::Gene;
use crate::repair::{cut_loops, insert, smooth};
use crate::settings::GridGaSettings;

/// Mutation of even the fittest (Srinivas & Patnaik 1994, §III): without it an
/// individual whose rates are 0 could only be copied.
const LEAST_MUTATION: f64 = 0.005;

/// Evolves lists of cells. The cost is 1/f, f the fitness of
/// [`GridFitness`](crate::GridFitness): in scene units, above the path's length, ten
/// times as much for a path that collides.
#[derive(Debug, Clone)]
pub struct GridGa {
    settings: GridGaSettings,
    cells: CellBuffers,
    spare: Vec<Gene>,
    crossing: Vec<usize>,
    evolution: Evolution,
}

impl GridGa {
    /// A planner with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: GridGaSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self {
            settings,
            cells: CellBuffers::default(),
            spare: Vec::new(),
            crossing: Vec::new(),
            evolution: Evolution::default(),
        })
    }
}

impl Planner for GridGa {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let settings = &self.settings;
        let limits = Limits {
            population: settings.population,
            genes: settings.most_turns + 2,
            generations: settings.generations,
            stall: settings.stall,
        };
        self.spare.reserve(limits.genes);
        self.crossing.reserve(limits.genes);
        let cells = Cells::new(problem, settings.cells, &mut self.cells)?;
        let mut paths = Paths { settings, cells, spare: &mut self.spare, crossing: &mut self.crossing };
        let status = self.evolution.run("grid-ga", &mut paths, &limits, problem, run, plan);
        if !plan.path.is_empty() {
            plan.terms.push(("length", env_model::path_length(&plan.path)));
        }
        Ok(status)
    }
}

/// Lists of cells as a species.
struct Paths<'p> {
    settings: &'p GridGaSettings,
    cells: Cells<'p>,
    spare: &'p mut Vec<Gene>,
    crossing: &'p mut Vec<usize>,
}

impl Paths<'_> {
    fn most(&self) -> usize {
        self.settings.most_turns + 2
    }

    fn crossover_rate(&self, parents: &Parents) -> f64 {
        let s = self.settings;
        let better = parents.fitness[0].max(parents.fitness[1]);
        if s.adaptive { parents.level.rate(s.k1, s.k3, better) } else { s.crossover }
    }

    /// By the fitness of the parent whose beginning the child has: its own is not
    /// known before it is complete.
    fn mutation_rate(&self, parents: &Parents, child: usize) -> f64 {
        let s = self.settings;
        if s.adaptive { parents.level.rate(s.k2, s.k4, parents.fitness[child]).max(LEAST_MUTATION) } else { s.mutation }
    }
}

impl Species for Paths<'_> {
    /// Start, one to `initial_turns` free cells anywhere, goal.
    fn draw(&mut self, genes: &mut Vec<Gene>, dice: &mut Dice) {
        let [start, goal] = self.cells.ends();
        let turns = 1 + dice.below(self.settings.initial_turns);
        genes.push(start);
        genes.extend((0..turns).map(|_| self.cells.draw(dice)));
        genes.push(goal);
    }

    fn breed(&mut self, children: &mut [Vec<Gene>; 2], parents: &Parents, dice: &mut Dice) {
        let s = self.settings;
        let most = self.most();
        let [a, b] = children;
        if dice.chance(self.crossover_rate(parents)) {
            exchange_tails(a, b, most, self.spare, dice);
        }
        let longer_side = self.cells.grid.columns().max(self.cells.grid.rows());
        let radius = radius(s.mutation_radius, longer_side, parents.generation, s.generations);
        for (i, child) in children.iter_mut().enumerate() {
            if dice.chance(self.mutation_rate(parents, i)) {
                mutate_path(child, &self.cells, radius, most, dice);
            }
            if dice.chance(s.insertion) {
                insert(child, &mut self.cells, s.insertion_elsewhere, most, self.crossing, dice);
            }
            if s.deletion {
                cut_loops(child);
            }
            if dice.chance(s.smoothing) {
                smooth(child, &mut self.cells);
            }
        }
    }

    fn fitness(&mut self, genes: &[Gene]) -> f64 {
        let s = self.settings;
        let cost = s.fitness.cost(s.cells_passed.count(genes, &self.cells), self.cells.length(genes));
        let free = (1..genes.len()).all(|i| self.cells.sees(genes, i - 1, i));
        (if free { 1.0 } else { s.infeasible }) / cost
    }

    fn cost(&self, fitness: f64) -> f64 {
        1.0 / fitness
    }

    fn write_path(&self, genes: &[Gene], path: &mut Vec<Point>) {
        self.cells.write_path(genes, path);
    }

    fn grid(&self) -> Option<&CellGrid> {
        Some(&self.cells.grid)
    }

    fn checks(&self) -> u64 {
        self.cells.checks
    }
}
