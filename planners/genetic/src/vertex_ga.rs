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
use crate::settings::{MOST_GENES, VertexFitness, VertexGaSettings};
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
    /// Those of one obstacle.
    polygon: Vec<Point>,
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
            polygon: Vec::new(),
            seen: Vec::new(),
            unused: Vec::new(),
            evolution: Evolution::default(),
        })
    }
}

impl Planner for VertexGa {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let Self { settings, vertices, polygon, .. } = self;
        let checks = number_vertices(problem.world, settings.corners, || run.in_time(), vertices, polygon);
        let (population, n) = (settings.population, vertices.len());
        if population.saturating_mul(n) > MOST_GENES {
            return Err(PlanError::Unsupported(format!(
                "population = {population} beside {n} vertices; expected population·vertices of at most {MOST_GENES}"
            )));
        }
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

    fn penalised(&self, genes: &[Gene]) -> bool {
        !self.every_segment(genes, |a, b| self.problem.world.segment_free(a, b))
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

#[cfg(test)]
mod tests {
    use env_model::{Scene, Shape, World};

    use super::*;

    /// A square of side 2 between start and goal, 1 from each.
    fn square(fitness: VertexFitness, seed: u64) -> (Plan, Status) {
        let world = World::new(&Scene {
            name: "square".into(),
            unit: "m".into(),
            robot_radius: 0.0,
            start: [-2.0, 0.0],
            goal: [2.0, 0.0],
            field: None,
            obstacles: vec![Shape::Polygon(vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]).into()],
        })
        .unwrap();
        let problem = Problem::new(&world, Point::new(-2.0, 0.0), Point::new(2.0, 0.0)).unwrap();
        let settings = VertexGaSettings { fitness, ..VertexGaSettings::default() };
        VertexGa::new(settings).unwrap().plan(&problem, &mut Run::new(seed)).unwrap()
    }

    /// ε = 4.5e-9 of gap at each of four vertices.
    const CLOSE: f64 = 1e-7;

    #[test]
    fn the_faithful_fitness_rewards_visits() {
        // The shortest way visits two vertices: 2/(2 + 2√2) = 0.414. Three are worth 3/(4 + 2√2)
        // = 0.439, once round 4/(6 + 2√2) = 0.453.
        let cost = |visits: f64| (2.0 * visits - 2.0 + 2.0 * std::f64::consts::SQRT_2) / visits;
        let mut rounds = 0;
        for seed in 0..20 {
            let (plan, status) = square(VertexFitness::Visits, seed);
            let visits = plan.path.len() - 2;
            assert!(status == Status::Solved && visits >= 3, "seed {seed}: {visits} vertices");
            assert!((plan.cost - cost(visits as f64)).abs() < CLOSE, "seed {seed}: {}", plan.cost);
            rounds += usize::from(visits == 4);
        }
        // Measured: 16; a population may settle on three.
        assert!(rounds >= 12, "{rounds} of 20");
    }

    #[test]
    fn with_length_as_fitness_the_shortest_way_wins() {
        for seed in 0..10 {
            let (plan, status) = square(VertexFitness::Length, seed);
            assert_eq!((status, plan.path.len()), (Status::Solved, 4));
            assert!((plan.cost - (2.0 + 2.0 * std::f64::consts::SQRT_2)).abs() < CLOSE, "seed {seed}");
        }
    }

    #[test]
    fn more_genes_than_fit_into_memory_are_an_error() {
        // 40 discs apart, 8 corners each: 320 vertices.
        let disc = |i: i32| Shape::Disc { centre: [2.0 * f64::from(i), 0.0], radius: 0.5 }.into();
        let ends = [Point::new(-2.0, 0.0), Point::new(81.0, 0.0)];
        let world = World::new(&Scene {
            name: "discs".into(),
            unit: "m".into(),
            robot_radius: 0.0,
            start: ends[0].into(),
            goal: ends[1].into(),
            field: None,
            obstacles: (0..40).map(disc).collect(),
        })
        .unwrap();
        let problem = Problem::new(&world, ends[0], ends[1]).unwrap();
        let plan = |population| {
            let settings = VertexGaSettings { population, ..VertexGaSettings::default() };
            let none = planner_api::Budget { evaluations: Some(0), ..planner_api::Budget::default() };
            VertexGa::new(settings).unwrap().plan(&problem, &mut Run::new(1).with_budget(none))
        };
        // 62 500 · 320 = 2·10⁷.
        assert!(matches!(plan(100), Ok((_, Status::BudgetSpent))));
        assert_eq!(
            plan(62_501).unwrap_err().to_string(),
            "population = 62501 beside 320 vertices; expected population·vertices of at most 20000000"
        );
    }

    #[test]
    fn fitness_by_hand() {
        let world = World::new(&Scene {
            name: "open".into(),
            unit: "m".into(),
            robot_radius: 0.0,
            start: [0.0, 0.0],
            goal: [4.0, 0.0],
            field: None,
            obstacles: vec![Shape::Disc { centre: [2.0, 0.0], radius: 1.0 }.into()],
        })
        .unwrap();
        let problem = Problem::new(&world, Point::new(0.0, 0.0), Point::new(4.0, 0.0)).unwrap();
        let vertices = [Point::new(2.0, 3.0), Point::new(2.0, -3.0)];
        let mut settings = VertexGaSettings::default();
        for (fitness, visits) in [(VertexFitness::Visits, 1.0), (VertexFitness::Length, 0.0)] {
            settings.fitness = fitness;
            let (seen, unused) = (&mut Vec::new(), &mut Vec::new());
            let mut tours =
                Tours { settings: &settings, problem: &problem, vertices: &vertices, seen, unused, checks: 0 };
            let merit = |v: f64| if visits > 0.0 { v } else { 1.0 };
            let up = 2.0 * 13.0_f64.sqrt();
            let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-14, "{found}, {expected}");
            close(tours.fitness(&[0, 1]), 10.0 * merit(1.0) / up);
            close(tours.fitness(&[0, 0]), 0.1 * merit(0.0) / 4.0);
            close(tours.fitness(&[2, 1]), 0.1 * merit(2.0) / (up + 6.0));
            // The dearest of all paths through vertices is cheaper than one that visits none.
            assert!(tours.cost(0.0) > tours.cost(0.1 / (up + 6.0)) && tours.cost(0.0).is_finite());
        }
    }

    #[test]
    fn chromosomes_name_no_vertex_twice_and_half_are_zero() {
        let world = World::new(&Scene {
            name: "none".into(),
            unit: "m".into(),
            robot_radius: 0.0,
            start: [0.0, 0.0],
            goal: [4.0, 0.0],
            field: None,
            obstacles: Vec::new(),
        })
        .unwrap();
        let problem = Problem::new(&world, Point::new(0.0, 0.0), Point::new(4.0, 0.0)).unwrap();
        let (settings, vertices) = (VertexGaSettings::default(), vec![Point::new(1.0, 1.0); 50]);
        let (seen, unused) = (&mut Vec::new(), &mut Vec::new());
        let mut tours = Tours { settings: &settings, problem: &problem, vertices: &vertices, seen, unused, checks: 0 };
        let mut dice = Dice::new(1);
        let mut zeros = 0;
        let parents = Parents { fitness: [1.0; 2], level: crate::rates::Level { mean: 1.0, max: 1.0 }, generation: 0 };
        for _ in 0..100 {
            let mut children = [Vec::new(), Vec::new()];
            for child in &mut children {
                tours.draw(child, &mut dice);
                zeros += child.iter().filter(|g| **g == 0).count();
            }
            tours.breed(&mut children, &parents, &mut dice);
            for child in children {
                let mut named: Vec<Gene> = child.into_iter().filter(|g| *g != 0).collect();
                let count = named.len();
                named.sort_unstable();
                named.dedup();
                assert!(named.len() == count && named.iter().all(|g| (1..=50).contains(g)));
            }
        }
        // Binomial, n = 10 000, p = 1/2: standard deviation 50; five of them.
        assert!(zeros.abs_diff(5000) <= 250, "{zeros}");
    }
}
