//! The loop: draw, evaluate, then select, breed, evaluate.

use planner_api::{Run, SettingError, View};

use super::binary::Binary;
use super::coding::Chromosome;
use super::genes::decode;
use super::real::Real;
use super::selection::Selector;
use super::{Coding, Tuning};
use crate::dice::Dice;
use crate::episode::Episode;
use crate::fitness::{self, fitness};
use crate::parameters::Parameters;
use crate::protocol::Protocol;
use crate::scenario::{Scenario, Set, TUNING_STREAM};

/// The fitness of a generation on its training scenarios.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Generation {
    /// The fittest individual's.
    pub maximum: f64,
    /// The mean over individuals.
    pub mean: f64,
}

/// What tuning has come to.
#[derive(Debug, Clone, PartialEq)]
pub struct Tuned {
    /// Every generation, that of number 0 drawn at random. Empty where the budget allowed none.
    pub generations: Vec<Generation>,
    /// The fittest individual, judged by training; the published parameters where there was no generation.
    pub parameters: Parameters,
    /// Individuals evaluated, each on all training scenarios.
    pub evaluations: u64,
}

/// Tunes parameters by a genetic algorithm; all randomness is `run.seed`'s.
///
/// With the same scenarios in every generation and an elite, the maximum never falls. Each generation is an iteration
/// of the run's budget, each individual an evaluation; a generation that time cuts short does not count. Reports
/// progress with cost 1 − maximum.
///
/// # Errors
/// A setting out of its range.
pub fn tune(protocol: &Protocol, tuning: &Tuning, run: &mut Run<'_>) -> Result<Tuned, SettingError> {
    protocol.validate()?;
    tuning.validate()?;
    Ok(match tuning.coding {
        Coding::Binary => Evolution::<Binary>::new(protocol, tuning, run.seed).run(run),
        Coding::Real => Evolution::<Real>::new(protocol, tuning, run.seed).run(run),
    })
}

struct Evolution<'a, C> {
    protocol: &'a Protocol,
    tuning: &'a Tuning,
    seed: u64,
    dice: Dice,
    scenarios: Vec<Scenario>,
    episode: Episode,
    selector: Selector,
    /// Descending by fitness once evaluated.
    population: Vec<Individual<C>>,
    fitness: Vec<f64>,
}

#[derive(Debug, Clone, Copy)]
struct Individual<C> {
    chromosome: C,
    /// On the scenarios in play; `None` where they have not met.
    fitness: Option<f64>,
}

impl<'a, C: Chromosome> Evolution<'a, C> {
    fn new(protocol: &'a Protocol, tuning: &'a Tuning, seed: u64) -> Self {
        let mut dice = Dice::new(seed, TUNING_STREAM);
        let population =
            (0..tuning.population).map(|_| Individual { chromosome: C::draw(&mut dice), fitness: None }).collect();
        Self {
            protocol,
            tuning,
            seed,
            dice,
            scenarios: Vec::with_capacity(protocol.training),
            episode: Episode::default(),
            selector: Selector::default(),
            population,
            fitness: Vec::with_capacity(tuning.population),
        }
    }

    fn run(mut self, run: &mut Run<'_>) -> Tuned {
        let mut tuned = Tuned { generations: Vec::new(), parameters: Parameters::default(), evaluations: 0 };
        // The fittest of all generations that played the same scenarios.
        let mut record = f64::NEG_INFINITY;
        for generation in 0..=self.tuning.generations {
            if generation > 0 {
                self.breed();
            }
            if generation == 0 || self.tuning.redraw {
                self.draw_scenarios(generation);
                record = f64::NEG_INFINITY;
            }
            let work = self.population.iter().filter(|i| i.fitness.is_none()).count() as u64;
            let allowed = if generation == 0 { run.allows_setup(work) } else { run.allows(work) };
            if !allowed || !self.evaluate(run, &mut tuned.evaluations) {
                break;
            }
            run.spent.iterations += u64::from(generation > 0);
            let maximum = self.fitness[0];
            if maximum > record {
                record = maximum;
                tuned.parameters = decode(&self.population[0].chromosome.genes());
            }
            let mean = self.fitness.iter().sum::<f64>() / self.fitness.len() as f64;
            tuned.generations.push(Generation { maximum, mean });
            run.report("behaviour tuning", 1.0 - maximum, || View::Progress);
        }
        tuned
    }

    fn draw_scenarios(&mut self, generation: u64) {
        let count = self.protocol.training as u64;
        let indices = generation * count..(generation + 1) * count;
        self.scenarios.clear();
        self.scenarios.extend(indices.map(|i| Scenario::draw(self.protocol, Set::Training, i, self.seed)));
        self.population.iter_mut().for_each(|individual| individual.fitness = None);
    }

    /// Evaluates whom the scenarios in play have not met, and sorts; false when time is up.
    fn evaluate(&mut self, run: &mut Run<'_>, evaluations: &mut u64) -> bool {
        let Self { protocol, scenarios, episode, population, .. } = self;
        for individual in population.iter_mut().filter(|i| i.fitness.is_none()) {
            if !run.in_time() {
                return false;
            }
            let parameters = decode(&individual.chromosome.genes());
            individual.fitness = Some(fitness::mean(protocol, scenarios, &parameters, episode));
            run.spent.evaluations += 1;
            *evaluations += 1;
        }
        let of = |individual: &Individual<C>| individual.fitness.unwrap_or(0.0);
        // Stable: of equals the older one stays in front.
        self.population.sort_by(|a, b| of(b).total_cmp(&of(a)));
        self.fitness.clear();
        self.fitness.extend(self.population.iter().map(of));
        true
    }

    /// Replaces all but the elite by children.
    fn breed(&mut self) {
        let Self { tuning, dice, selector, population, fitness, .. } = self;
        selector.set(fitness);
        let size = population.len();
        let mut next = population[..tuning.elites].to_vec();
        while next.len() < size {
            let parents = [(); 2].map(|()| population[selector.pick(tuning.selection, fitness, dice)].chromosome);
            let children = if dice.chance(tuning.crossover) { C::cross(parents, tuning, dice) } else { parents };
            for child in children.into_iter().take(size - next.len()) {
                next.push(Individual { chromosome: child.mutate(tuning, dice), fitness: None });
            }
        }
        *population = next;
    }
}

#[cfg(test)]
mod tests {
    use planner_api::Budget;

    use super::*;
    use crate::Selection;

    fn small() -> (Protocol, Tuning) {
        let protocol = Protocol { robots: 2, opponents: 2, obstacles: 2, steps: 80, ..Protocol::default() };
        (protocol, Tuning { population: 8, generations: 6, ..Tuning::default() })
    }

    #[test]
    fn the_fittest_is_never_lost_and_the_seed_decides() {
        let (protocol, tuning) = small();
        for coding in [Coding::Binary, Coding::Real] {
            let tuning = Tuning { coding, ..tuning.clone() };
            let run = |seed| tune(&protocol, &tuning, &mut Run::new(seed)).unwrap();
            let tuned = run(5);
            assert_eq!(tuned.generations.len(), 7);
            assert_eq!(tuned.evaluations, 8 + 6 * 7, "the elite is known");
            assert!(tuned.generations.windows(2).all(|g| g[1].maximum >= g[0].maximum), "{tuned:?}");
            assert!(tuned.generations.iter().all(|g| g.mean <= g.maximum && g.mean > 0.0));
            assert_eq!(tuned.parameters.validate(), Ok(()));
            // What it says of the best is what that scores on the training set of the seed.
            let again = fitness(&protocol, &tuned.parameters, Set::Training, 5).unwrap();
            assert_eq!(again.mean, tuned.generations[6].maximum);
            assert_eq!(run(5), tuned);
            assert_ne!(run(6).parameters, tuned.parameters);
        }
    }

    #[test]
    fn new_scenarios_every_generation() {
        let (protocol, tuning) = small();
        let tuning = Tuning { redraw: true, selection: Selection::Tournament, ..tuning };
        let tuned = tune(&protocol, &tuning, &mut Run::new(5)).unwrap();
        assert_eq!(tuned.evaluations, 8 * 7, "the elite is evaluated again");
    }

    #[test]
    fn budgets_are_kept() {
        let (protocol, tuning) = small();
        let run = |budget| tune(&protocol, &tuning, &mut Run::new(5).with_budget(budget)).unwrap();
        let none = run(Budget { evaluations: Some(7), ..Budget::default() });
        assert_eq!((none.generations.len(), none.parameters), (0, Parameters::default()));
        let two = run(Budget { iterations: Some(2), ..Budget::default() });
        assert_eq!((two.generations.len(), two.evaluations), (3, 8 + 14));
        let whole = tune(&protocol, &tuning, &mut Run::new(5)).unwrap();
        assert_eq!(two.generations, whole.generations[..3]);
    }

    #[test]
    fn hostile_settings_are_typed_errors() {
        let (protocol, tuning) = small();
        let bad = Tuning { population: 0, ..tuning.clone() };
        assert_eq!(tune(&protocol, &bad, &mut Run::new(1)).unwrap_err().key, "population");
        let bad = Protocol { training: 3, ..protocol };
        assert_eq!(tune(&bad, &tuning, &mut Run::new(1)).unwrap_err().key, "training");
    }
}
