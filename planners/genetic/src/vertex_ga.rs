//! The genetic algorithm on the obstacles' vertices (Fang 2009, §4.4).
//!
//! The n vertices are numbered; a chromosome has n genes, each 0 or a vertex, no
//! vertex twice. Its path visits the vertices in the order of the genes. With P the
//! number of vertices visited per length, a path that is free has fitness 10 P, any
//! other 0.1 P: it is *visiting vertices* that is rewarded, not shortness. The
//! setting `fitness = "length"` takes P = 1/length instead.
//!
//! Half of all genes name a vertex, so a path begins with about n/2 turns. Among
//! many obstacles such paths hardly ever become free, and the planner fails.

use env_model::{CellGrid, Point};
use planner_api::{Plan, PlanError, Planner, Problem, Run, SettingError, Status};

use crate::crossover::{drop_repeats, exchange_right};
use crate::dice::Dice;
use crate::evolution::{Evolution, Limits, Parents, Species};
use crate::mutation::mutate_vertices;
use crate::population::Gene;
use crate::settings::{VertexFitness, VertexGaSettings};
use crate::vertices::number_vertices;

/// Factors of P (Fang 2009, §4.4 (3)).
const FREE: f64 = 10.0;
const COLLIDING: f64 = 0.1;

/// Evolves sequences of vertices.
///
/// The cost is 10/fitness: the length of a free path, a hundred times that of a
/// colliding one; with `fitness = "visits"` divided by the number of vertices. There
/// a path that visits none has no fitness, and a cost above all others'.
#[derive(Debug, Clone)]
pub struct VertexGa {
    settings: VertexGaSettings,
    vertices: Vec<Point>,
    seen: Vec<bool>,
    unused: Vec<Gene>,
    evolution: Evolution,
}

impl VertexGa {
    /// A planner with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: VertexGaSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self {
            settings,
            vertices: Vec::new(),
            seen: Vec::new(),
            unused: Vec::new(),
            evolution: Evolution::default(),
        })
    }
}

impl Planner for VertexGa {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let settings = &self.settings;
        let checks = number_vertices(problem.world, settings.corners, &mut self.vertices);
        let limits = Limits {
            population: settings.population,
            genes: self.vertices.len(),
            generations: settings.generations,
            stall: settings.stall,
        };
        let mut tours = Tours {
            settings,
            problem,
            vertices: &self.vertices,
            seen: &mut self.seen,
            unused: &mut self.unused,
            checks,
        };
        let status = self.evolution.run("vertex-ga", &mut tours, &limits, problem, run, plan);
        if !plan.path.is_empty() {
            plan.terms.push(("length", env_model::path_length(&plan.path)));
        }
        Ok(status)
    }
}

/// Sequences of vertices as a species.
struct Tours<'p> {
    settings: &'p VertexGaSettings,
    problem: &'p Problem<'p>,
    vertices: &'p [Point],
    seen: &'p mut Vec<bool>,
    unused: &'p mut Vec<Gene>,
    checks: u64,
}

impl Tours<'_> {
    /// Calls `visit` with the segments of the path, in order, while it returns true.
    fn every_segment(&self, genes: &[Gene], mut visit: impl FnMut(Point, Point) -> bool) -> bool {
        let Self { problem, vertices, .. } = *self;
        let mut at = problem.start;
        let stops = genes.iter().filter(|g| **g != 0).map(|g| vertices[*g as usize - 1]);
        stops.chain([problem.goal]).all(|next| visit(std::mem::replace(&mut at, next), next))
    }
}

impl Species for Tours<'_> {
    /// Each gene is 0 with probability `zero`, else any vertex not yet named.
    fn draw(&mut self, genes: &mut Vec<Gene>, dice: &mut Dice) {
        let n = self.vertices.len();
        self.unused.clear();
        self.unused.extend(1..=n as Gene);
        for _ in 0..n {
            let zero = dice.chance(self.settings.zero);
            genes.push(if zero { 0 } else { self.unused.swap_remove(dice.below(self.unused.len())) });
        }
    }

    fn breed(&mut self, children: &mut [Vec<Gene>; 2], _: &Parents, dice: &mut Dice) {
        let VertexGaSettings { crossover, mutation, zero, .. } = *self.settings;
        let [a, b] = children;
        if dice.chance(crossover) {
            exchange_right(a, b, dice);
        }
        for child in children {
            mutate_vertices(child, self.vertices.len(), mutation, zero, dice);
            drop_repeats(child, self.vertices.len(), self.seen);
        }
    }

    fn fitness(&mut self, genes: &[Gene]) -> f64 {
        let (mut length, mut checks) = (0.0, 0);
        self.every_segment(genes, |a, b| {
            length += (b - a).norm();
            true
        });
        let free = self.every_segment(genes, |a, b| {
            checks += 1;
            self.problem.world.segment_free(a, b)
        });
        self.checks += checks;
        let merit = match self.settings.fitness {
            VertexFitness::Visits => genes.iter().filter(|g| **g != 0).count() as f64,
            VertexFitness::Length => 1.0,
        };
        (if free { FREE } else { COLLIDING }) * merit / length
    }

    fn cost(&self, fitness: f64) -> f64 {
        if fitness > 0.0 {
            return FREE / fitness;
        }
        // No path through vertices is longer than n + 1 diagonals of the world.
        let ends = [self.problem.start, self.problem.goal];
        let diagonal = env_model::Aabb::of_points(self.vertices.iter().chain(&ends)).diagonal();
        FREE / COLLIDING * diagonal * (self.vertices.len() + 2) as f64
    }

    fn write_path(&self, genes: &[Gene], path: &mut Vec<Point>) {
        path.push(self.problem.start);
        self.every_segment(genes, |_, next| {
            path.push(next);
            true
        });
    }

    fn grid(&self) -> Option<&CellGrid> {
        None
    }

    fn checks(&self) -> u64 {
        self.checks
    }
}
