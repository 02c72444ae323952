//! The loop of a genetic algorithm (Fang 2009, fig. 4.1): draw, evaluate, then
//! select, breed, evaluate until the generations are up or nothing improves.

use env_model::{CellGrid, Point};
use planner_api::{Candidates, Detail, Plan, PopulationView, Problem, Run, Status, View};

use crate::dice::Dice;
use crate::population::{Gene, Population};
use crate::rates::Level;
use crate::roulette::Roulette;

/// By this much a mean fitness must beat its record to count as an improvement.
const MEAN_IMPROVEMENT: f64 = 1e-3;

/// What tells one genetic planner from another.
pub trait Species {
    /// Fills an empty chromosome at random.
    fn draw(&mut self, genes: &mut Vec<Gene>, dice: &mut Dice);
    /// Turns copies of two parents into their children.
    fn breed(&mut self, children: &mut [Vec<Gene>; 2], parents: &Parents, dice: &mut Dice);
    /// Fitness ≥ 0; larger is better.
    fn fitness(&mut self, genes: &[Gene]) -> f64;
    /// The cost to report, in scene units where it can be; falls as `fitness` rises, finite.
    fn cost(&self, fitness: f64) -> f64;
    /// Whether the cost of `genes` is but a penalty on a path that collides; asked for observers only.
    fn penalised(&self, _genes: &[Gene]) -> bool {
        false
    }
    /// Appends the path, both ends exact.
    fn write_path(&self, genes: &[Gene], path: &mut Vec<Point>);
    /// The cells that the genes number, if they do.
    fn grid(&self) -> Option<&CellGrid>;
    /// Tests of a segment against the world so far.
    fn checks(&self) -> u64;
}

/// Who breeds, and when.
#[derive(Debug, Clone, Copy)]
pub struct Parents {
    /// Fitness of either parent.
    pub fitness: [f64; 2],
    /// The population's mean and best.
    pub level: Level,
    /// The generation that they belong to, from 0.
    pub generation: u64,
}

/// Sizes and limits of the loop.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// Individuals.
    pub population: usize,
    /// Genes of a chromosome, at most.
    pub genes: usize,
    /// Generations, at most.
    pub generations: u64,
    /// Generations without improvement that end the run.
    pub stall: u64,
}

/// Buffers of the loop, kept from run to run.
#[derive(Debug, Clone, Default)]
pub struct Evolution {
    population: Population,
    next: Population,
    children: [Vec<Gene>; 2],
    roulette: Roulette,
    paths: Candidates,
}

impl Evolution {
    /// Evolves `species`; leaves the fittest path, its cost and the work in `plan`.
    ///
    /// The fittest individual survives unchanged (one elite), so the best cost never rises.
    pub fn run<S: Species>(
        &mut self,
        stage: &'static str,
        species: &mut S,
        limits: &Limits,
        problem: &Problem<'_>,
        run: &mut Run<'_>,
        plan: &mut Plan,
    ) -> Status {
        let mut dice = Dice::new(run.seed);
        self.population.prepare(limits.population, limits.genes);
        self.next.prepare(limits.population, limits.genes);
        for child in &mut self.children {
            child.clear();
            child.reserve_exact(limits.genes);
        }
        for genes in &mut self.population.genes {
            if !run.allows_setup(1) {
                break;
            }
            species.draw(genes, &mut dice);
            self.population.fitness.push(species.fitness(genes));
            run.spent.evaluations += 1;
        }
        let mut stagnation = Stagnation::default();
        let mut generation = 0;
        if let Some(best) = self.population.best() {
            self.show(stage, species, best, run, plan);
            let work = (limits.population - 1) as u64;
            while generation < limits.generations
                && stagnation.after(&self.population) < limits.stall
                && run.allows(work)
                && self.generate(species, generation, &mut dice, run)
            {
                std::mem::swap(&mut self.population, &mut self.next);
                generation += 1;
                run.spent.iterations += 1;
                let best = self.population.best().expect("a population is never empty");
                self.show(stage, species, best, run, plan);
            }
            let best = self.population.best().expect("a population is never empty");
            plan.path.clear();
            species.write_path(&self.population.genes[best], &mut plan.path);
            plan.cost = species.cost(self.population.fitness[best]);
            run.spent.collision_checks += plan.path.len() as u64 - 1;
        }
        run.spent.collision_checks += species.checks();
        plan.counters = run.spent;
        match run.stopped() {
            true => Status::BudgetSpent,
            false if problem.world.path_free(&plan.path) => Status::Solved,
            false => Status::NotFound,
        }
    }

    /// Fills `next`, counting what it evaluates; false when time is up.
    fn generate<S: Species>(&mut self, species: &mut S, generation: u64, dice: &mut Dice, run: &mut Run<'_>) -> bool {
        let Self { population, next, children, roulette, .. } = self;
        let elite = population.best().expect("a population is never empty");
        let level = Level { mean: population.mean(), max: population.fitness[elite] };
        roulette.set(&population.fitness);
        let size = next.genes.len();
        next.fitness.clear();
        next.genes[0].clone_from(&population.genes[elite]);
        next.fitness.push(population.fitness[elite]);
        while next.fitness.len() < size {
            if !run.in_time() {
                return false;
            }
            let parents = [roulette.spin(dice), roulette.spin(dice)];
            for (child, parent) in children.iter_mut().zip(parents) {
                child.clone_from(&population.genes[parent]);
            }
            let parents = Parents { fitness: parents.map(|i| population.fitness[i]), level, generation };
            species.breed(children, &parents, dice);
            for child in children.iter().take(size - next.fitness.len()) {
                let place = next.fitness.len();
                next.genes[place].clone_from(child);
                next.fitness.push(species.fitness(child));
                run.spent.evaluations += 1;
            }
        }
        true
    }

    fn show<S: Species>(&mut self, stage: &'static str, species: &S, best: usize, run: &mut Run<'_>, plan: &mut Plan) {
        let Self { population, paths, .. } = self;
        if run.detail() == Detail::State {
            paths.clear();
            for genes in &population.genes[..population.fitness.len()] {
                paths.push_with(|points| species.write_path(genes, points));
            }
            plan.path.clear();
            species.write_path(&population.genes[best], &mut plan.path);
        }
        let watched = run.detail() != Detail::None;
        let penalised = watched && species.penalised(&population.genes[best]);
        let told = if penalised { f64::INFINITY } else { species.cost(population.fitness[best]) };
        run.report(stage, told, || {
            View::Population(PopulationView {
                paths,
                fitness: &population.fitness,
                grid: species.grid(),
                best: &plan.path,
            })
        });
    }
}

/// For how many generations best and mean have not improved (Fang 2009, §4.4 (5)).
#[derive(Debug, Clone, Copy, Default)]
struct Stagnation {
    best: f64,
    mean: f64,
    best_for: u64,
    mean_for: u64,
}

impl Stagnation {
    /// Counts this generation in; the longer of the two stagnations.
    fn after(&mut self, population: &Population) -> u64 {
        let best = population.best().map_or(0.0, |i| population.fitness[i]);
        let mean = population.mean();
        let count = |improved: bool, so_far: u64| if improved { 0 } else { so_far + 1 };
        self.best_for = count(best > self.best, self.best_for);
        self.mean_for = count(mean > self.mean * (1.0 + MEAN_IMPROVEMENT), self.mean_for);
        self.best = best.max(self.best);
        if self.mean_for == 0 {
            self.mean = mean;
        }
        self.best_for.max(self.mean_for)
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use env_model::{Scene, World};
    use planner_api::Budget;

    use super::*;

    /// One gene a chromosome, nothing to tell them apart. Breeds three pairs, then sleeps.
    struct Sleeper {
        until: Instant,
        pairs: u64,
        evaluated: u64,
    }

    impl Species for Sleeper {
        fn draw(&mut self, genes: &mut Vec<Gene>, _: &mut Dice) {
            genes.push(1);
        }

        fn breed(&mut self, _: &mut [Vec<Gene>; 2], _: &Parents, _: &mut Dice) {
            self.pairs += 1;
            if self.pairs == 3 {
                std::thread::sleep(self.until.saturating_duration_since(Instant::now()));
            }
        }

        fn fitness(&mut self, _: &[Gene]) -> f64 {
            self.evaluated += 1;
            1.0
        }

        fn cost(&self, fitness: f64) -> f64 {
            1.0 / fitness
        }

        fn write_path(&self, _: &[Gene], path: &mut Vec<Point>) {
            path.extend([Point::new(0.0, 0.0), Point::new(1.0, 0.0)]);
        }

        fn grid(&self) -> Option<&CellGrid> {
            None
        }

        /// Two an evaluation.
        fn checks(&self) -> u64 {
            2 * self.evaluated
        }
    }

    #[test]
    fn a_generation_cut_short_is_counted() {
        let world = World::new(&Scene {
            name: "open".into(),
            unit: "m".into(),
            robot_radius: 0.0,
            start: [0.0, 0.0],
            goal: [1.0, 0.0],
            field: None,
            obstacles: Vec::new(),
        })
        .unwrap();
        let problem = Problem::new(&world, Point::new(0.0, 0.0), Point::new(1.0, 0.0)).unwrap();
        let limits = Limits { population: 10, genes: 1, generations: 5, stall: 5 };
        // Long enough to get as far as the third pair on a busy machine.
        let deadline = Instant::now() + Duration::from_millis(400);
        let mut sleeper = Sleeper { until: deadline, pairs: 0, evaluated: 0 };
        let mut run = Run::new(1).with_budget(Budget { deadline: Some(deadline), ..Budget::default() });
        let mut plan = Plan::default();
        let status = Evolution::default().run("sleeper", &mut sleeper, &limits, &problem, &mut run, &mut plan);
        assert_eq!((status, plan.counters.iterations), (Status::BudgetSpent, 0));
        // Ten at first, two of each of three pairs; the path returned has one segment.
        assert_eq!((sleeper.evaluated, plan.counters.evaluations, plan.counters.collision_checks), (16, 16, 33));
    }

    #[test]
    fn stagnation_counts_generations_without_improvement() {
        let mut stagnation = Stagnation::default();
        let mut after =
            |fitness: [f64; 2]| stagnation.after(&Population { genes: Vec::new(), fitness: fitness.to_vec() });
        assert_eq!(after([1.0, 3.0]), 0, "anything is better than nothing");
        assert_eq!(after([2.0, 3.0]), 1, "the mean is better, the best is not");
        assert_eq!(after([1.0, 4.0]), 1, "the best is better, the mean is not");
        assert_eq!(after([1.0, 4.001]), 2, "so little is nothing to the mean");
        assert_eq!(after([1.02, 4.002]), 0, "now it is more than a thousandth");
    }
}
