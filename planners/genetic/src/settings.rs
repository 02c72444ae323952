//! Settings of both planners.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

use crate::{CellsPassed, GridFitness};

/// Genes of all individuals, so that a run fits into memory.
pub(crate) const MOST_GENES: usize = 20_000_000;

/// Settings of [`GridGa`](crate::GridGa). The thesis names the operators but,
/// as far as it is preserved, no numbers but a population of 100 (§4.4, "the
/// classic value"); where a default is not marked as the thesis's or another
/// work's, it is a reading.
///
/// `population`·(`most_turns` + 2), the genes of all individuals, is at most
/// 2·10⁷. There is room for all of them in two generations at 4 bytes each: 160 MB at
/// most. An observer of the state costs 16 bytes a gene besides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GridGaSettings {
    /// Cells along the longer side of the world's extent, 2 … 1000. Default 40. The
    /// thesis makes them "so large that the robot can move freely in one".
    pub cells: usize,
    /// Individuals, 2 … 100 000. Default 100 (§4.4).
    pub population: usize,
    /// Limit of generations, 1 … 10⁹. Default 100.
    pub generations: u64,
    /// Generations after which the run ends when the best or the mean fitness has
    /// not improved (§4.4 (5)), 1 … 10⁹. Default 30. The mean, which the thesis wants
    /// "basically" unchanged, must beat its record by a thousandth.
    pub stall: u64,
    /// How the damaged formula of the fitness is mended: `"root"` (default) or `"plain"`.
    pub fitness: GridFitness,
    /// What n of the fitness counts: cells `"traversed"` (default) or `"genes"`.
    pub cells_passed: CellsPassed,
    /// Factor on the fitness of a path that collides, above 0, at most 1. Default
    /// 0.1, by analogy with §4.4.
    pub infeasible: f64,
    /// Turning points of an initial path, at most: drawn uniformly from 1 up to this.
    /// 1 … 1000. Default 6.
    pub initial_turns: usize,
    /// Turning points of any path, at most; `initial_turns` … 10 000. Default 60.
    pub most_turns: usize,
    /// Rates by the fitness of those concerned (Srinivas & Patnaik 1994) instead of
    /// the fixed `crossover` and `mutation`. Default true.
    pub adaptive: bool,
    /// Adaptive: crossover of parents whose better one is of mean fitness, 0 … 1.
    /// Default 1 (Srinivas & Patnaik). Not read when `adaptive` is false.
    pub k1: f64,
    /// Adaptive: mutation of an individual of mean fitness, 0 … 1. Default 0.5
    /// (Srinivas & Patnaik). Whatever k2, even 0, every individual mutates at a rate of
    /// at least 0.005, as theirs do (§III). Not read when `adaptive` is false.
    pub k2: f64,
    /// Adaptive: crossover below mean fitness, 0 … 1. Default 1 (Srinivas & Patnaik).
    /// Not read when `adaptive` is false.
    pub k3: f64,
    /// Adaptive: mutation below mean fitness, 0 … 1. Default 0.5 (Srinivas & Patnaik);
    /// at least 0.005 like `k2`. Not read when `adaptive` is false.
    pub k4: f64,
    /// Fixed rate of crossover a pair, 0 … 1. Default 0.8. Not read when `adaptive`
    /// is true, as it is by default.
    pub crossover: f64,
    /// Fixed rate of mutation an individual, 0 … 1; 0 is none at all. Default 0.1. Not
    /// read when `adaptive` is true, as it is by default.
    pub mutation: f64,
    /// Radius of mutation in the first generation as a share of the grid's longer
    /// side, 0 … 1; it shrinks to one cell. Default 0.5.
    pub mutation_radius: f64,
    /// Rate at which individuals undergo insertion, 0 … 1. Default 1.
    pub insertion: f64,
    /// Rate at which insertion lengthens a path that crosses no obstacle, 0 … 1. Default 0.05.
    pub insertion_elsewhere: f64,
    /// Whether deletion cuts loops. Default true.
    pub deletion: bool,
    /// Rate at which individuals are smoothed, 0 … 1; 0 is the thesis's algorithm
    /// without the operator of the work that it cites. Default 0.2.
    pub smoothing: f64,
}

impl Default for GridGaSettings {
    fn default() -> Self {
        Self {
            cells: 40,
            population: 100,
            generations: 100,
            stall: 30,
            fitness: GridFitness::Root,
            cells_passed: CellsPassed::Traversed,
            infeasible: 0.1,
            initial_turns: 6,
            most_turns: 60,
            adaptive: true,
            k1: 1.0,
            k2: 0.5,
            k3: 1.0,
            k4: 0.5,
            crossover: 0.8,
            mutation: 0.1,
            mutation_radius: 0.5,
            insertion: 1.0,
            insertion_elsewhere: 0.05,
            deletion: true,
            smoothing: 0.2,
        }
    }
}

impl GridGaSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        whole("cells", self.cells, 2, 1000, "2 to 1000")?;
        loop_limits(self.population, self.generations, self.stall)?;
        let infeasible = self.infeasible;
        SettingError::check(infeasible > 0.0 && infeasible <= 1.0, "infeasible", infeasible, "above 0, at most 1")?;
        whole("initial_turns", self.initial_turns, 1, 1000, "1 to 1000")?;
        whole("most_turns", self.most_turns, self.initial_turns, 10_000, "initial_turns to 10000")?;
        SettingError::check(
            self.population.saturating_mul(self.most_turns + 2) <= MOST_GENES,
            "population",
            format_args!("{} beside most_turns = {}", self.population, self.most_turns),
            "population·(most_turns + 2) of at most 20000000",
        )?;
        probability("k1", self.k1)?;
        probability("k2", self.k2)?;
        probability("k3", self.k3)?;
        probability("k4", self.k4)?;
        probability("crossover", self.crossover)?;
        probability("mutation", self.mutation)?;
        probability("mutation_radius", self.mutation_radius)?;
        probability("insertion", self.insertion)?;
        probability("insertion_elsewhere", self.insertion_elsewhere)?;
        probability("smoothing", self.smoothing)
    }
}

/// What [`VertexGa`](crate::VertexGa) holds to be fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VertexFitness {
    /// P = vertices visited / path length, the thesis's. It rewards *visiting
    /// vertices*, not short paths; the straight line, which visits none, has none.
    Visits,
    /// P = 1 / path length.
    Length,
}

/// Settings of [`VertexGa`](crate::VertexGa). Defaults that are not marked as the
/// thesis's are readings.
///
/// `population` times the number of vertices, which only the world decides, is at
/// most 2·10⁷, else planning ends with an error. There is room for all genes in two
/// generations at 4 bytes each: 160 MB at most. An observer of the state costs 16
/// bytes a gene besides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct VertexGaSettings {
    /// What is fit: `"visits"` (default, the thesis's) or `"length"`.
    pub fitness: VertexFitness,
    /// Corners of the polygon round a disc, and of both ends of a capsule together,
    /// 3 … 64. Default 8. The thesis knows polygons only.
    pub corners: usize,
    /// Individuals, 2 … 100 000. Default 100 (§4.4).
    pub population: usize,
    /// Limit of generations, 1 … 10⁹. Default 100.
    pub generations: u64,
    /// Generations without improvement of the best or the mean fitness that end the
    /// run, 1 … 10⁹. Default 30; see [`GridGaSettings::stall`].
    pub stall: u64,
    /// Probability that a gene is drawn as 0, no vertex, 0 … 1. Default 0.5 (§4.4).
    pub zero: f64,
    /// Rate of crossover a pair, 0 … 1. Default 0.8.
    pub crossover: f64,
    /// Rate of mutation a gene, 0 … 1. Default 0.02.
    pub mutation: f64,
}

impl Default for VertexGaSettings {
    fn default() -> Self {
        Self {
            fitness: VertexFitness::Visits,
            corners: 8,
            population: 100,
            generations: 100,
            stall: 30,
            zero: 0.5,
            crossover: 0.8,
            mutation: 0.02,
        }
    }
}

impl VertexGaSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        whole("corners", self.corners, 3, 64, "3 to 64")?;
        loop_limits(self.population, self.generations, self.stall)?;
        probability("zero", self.zero)?;
        probability("crossover", self.crossover)?;
        probability("mutation", self.mutation)
    }
}

fn loop_limits(population: usize, generations: u64, stall: u64) -> Result<(), SettingError> {
    whole("population", population, 2, 100_000, "2 to 100000")?;
    let long = 1..=1_000_000_000;
    SettingError::check(long.contains(&generations), "generations", generations, "1 to 1000000000")?;
    SettingError::check(long.contains(&stall), "stall", stall, "1 to 1000000000")
}

fn whole(
    key: &'static str,
    value: usize,
    least: usize,
    most: usize,
    expected: &'static str,
) -> Result<(), SettingError> {
    SettingError::check((least..=most).contains(&value), key, value, expected)
}

/// NaN is in no range.
fn probability(key: &'static str, value: f64) -> Result<(), SettingError> {
    SettingError::check((0.0..=1.0).contains(&value), key, value, "0 to 1")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_valid() {
        assert_eq!(GridGaSettings::default().validate(), Ok(()));
        assert_eq!(VertexGaSettings::default().validate(), Ok(()));
    }

    #[test]
    fn bad_grid_settings_are_errors_by_name() {
        type Change = fn(&mut GridGaSettings);
        let cases: [(&str, Change); 20] = [
            ("cells", |s| s.cells = 1),
            ("population", |s| s.population = 0),
            ("generations", |s| s.generations = 0),
            ("stall", |s| s.stall = 0),
            ("infeasible", |s| s.infeasible = 0.0),
            ("infeasible", |s| s.infeasible = f64::NAN),
            ("initial_turns", |s| s.initial_turns = 0),
            ("most_turns", |s| s.most_turns = s.initial_turns - 1),
            ("k1", |s| s.k1 = -0.1),
            ("k2", |s| s.k2 = 1.5),
            ("k3", |s| s.k3 = f64::NAN),
            ("k4", |s| s.k4 = f64::INFINITY),
            ("crossover", |s| s.crossover = 1.01),
            ("mutation", |s| s.mutation = -1.0),
            ("mutation_radius", |s| s.mutation_radius = 2.0),
            ("mutation_radius", |s| s.mutation_radius = f64::NAN),
            ("insertion", |s| s.insertion = 1.1),
            ("insertion_elsewhere", |s| s.insertion_elsewhere = -0.5),
            ("smoothing", |s| s.smoothing = 1.1),
            ("smoothing", |s| s.smoothing = f64::NAN),
        ];
        for (key, change) in cases {
            let mut settings = GridGaSettings::default();
            change(&mut settings);
            assert_eq!(crate::GridGa::new(settings).unwrap_err().key, key);
        }
    }

    #[test]
    fn more_genes_than_fit_into_memory_are_an_error() {
        let of =
            |population, most_turns| GridGaSettings { population, most_turns, ..GridGaSettings::default() }.validate();
        assert_eq!((of(100_000, 198), of(1999, 10_000)), (Ok(()), Ok(())));
        assert_eq!(
            of(100_000, 10_000).unwrap_err().to_string(),
            "population = 100000 beside most_turns = 10000; expected population·(most_turns + 2) of at most 20000000"
        );
        assert_eq!(of(100_000, 199).unwrap_err().key, "population");
    }

    #[test]
    fn bad_vertex_settings_are_errors_by_name() {
        type Change = fn(&mut VertexGaSettings);
        let cases: [(&str, Change); 7] = [
            ("corners", |s| s.corners = 2),
            ("population", |s| s.population = 1),
            ("generations", |s| s.generations = 0),
            ("stall", |s| s.stall = 0),
            ("zero", |s| s.zero = 1.2),
            ("crossover", |s| s.crossover = -0.2),
            ("mutation", |s| s.mutation = f64::NAN),
        ];
        for (key, change) in cases {
            let mut settings = VertexGaSettings::default();
            change(&mut settings);
            assert_eq!(crate::VertexGa::new(settings).unwrap_err().key, key);
        }
    }
}
