//! Settings of the genetic algorithm.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

use super::genes::GENES;

/// How parameters are written as a chromosome.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coding {
    /// Ten bits a gene; one-point crossover and flips of bits (Holland 1975, Goldberg 1989).
    #[default]
    Binary,
    /// Real numbers; blend crossover (BLX-α, Eshelman & Schaffer 1993) and Gaussian mutation.
    Real,
}

/// Who becomes a parent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Selection {
    /// P = F/ΣF (Holland 1975).
    #[default]
    Roulette,
    /// The fitter of two drawn at random (Goldberg & Deb 1991).
    Tournament,
}

/// Settings of [`tune`](crate::tune). The thesis's numbers are lost: the defaults are those usual at its time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Tuning {
    /// `"binary"` or `"real"`. Default `"binary"`.
    pub coding: Coding,
    /// `"roulette"` or `"tournament"`. Default `"roulette"`.
    pub selection: Selection,
    /// Individuals, 2 … 1000. Default 30.
    pub population: usize,
    /// Generations bred after the initial one, 0 … 10⁴. Default 25.
    pub generations: u64,
    /// The fittest that survive unchanged, 0 … population − 1. Default 1.
    pub elites: usize,
    /// Probability that two parents are crossed, else their children are copies; 0 … 1. Default 0.8.
    pub crossover: f64,
    /// Expected mutations of a child, 0 … 11: each of its bits or genes mutates with this divided by their number.
    /// Default 1 (rate 1/n: Mühlenbein 1992).
    pub mutation: f64,
    /// α of blend crossover, 0 … 2; real coding only. Default 0.5.
    pub blend: f64,
    /// Standard deviation of a mutation, in units of its gene's range, above 0, at most 1; real coding only. Default
    /// 0.1.
    pub deviation: f64,
    /// Whether every generation plays new scenarios. Default false: the same ones, of which the fittest's fitness
    /// never falls.
    pub redraw: bool,
}

impl Default for Tuning {
    fn default() -> Self {
        Self {
            coding: Coding::Binary,
            selection: Selection::Roulette,
            population: 30,
            generations: 25,
            elites: 1,
            crossover: 0.8,
            mutation: 1.0,
            blend: 0.5,
            deviation: 0.1,
            redraw: false,
        }
    }
}

impl Tuning {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        let within = |key, value: f64, low: f64, high: f64, expected| {
            SettingError::check((low..=high).contains(&value), key, value, expected)
        };
        let Self { population, generations, elites, .. } = *self;
        SettingError::check((2..=1000).contains(&population), "population", population, "2 to 1000")?;
        SettingError::check(generations <= 10_000, "generations", generations, "0 to 10000")?;
        SettingError::check(elites < population, "elites", elites, "0 to population - 1")?;
        within("crossover", self.crossover, 0.0, 1.0, "0 to 1")?;
        within("mutation", self.mutation, 0.0, GENES as f64, "0 to 11, the number of genes")?;
        within("blend", self.blend, 0.0, 2.0, "0 to 2")?;
        let deviation = self.deviation;
        SettingError::check(deviation > 0.0 && deviation <= 1.0, "deviation", deviation, "above 0, at most 1")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_settings_are_errors_by_name() {
        type Spoil = fn(&mut Tuning);
        let cases: [(&str, Spoil); 9] = [
            ("population", |t| t.population = 1),
            ("population", |t| t.population = usize::MAX),
            ("generations", |t| t.generations = 10_001),
            ("elites", |t| t.elites = 30),
            ("crossover", |t| t.crossover = 1.1),
            ("mutation", |t| t.mutation = f64::NAN),
            ("mutation", |t| t.mutation = 12.0),
            ("blend", |t| t.blend = -0.1),
            ("deviation", |t| t.deviation = 0.0),
        ];
        assert_eq!(Tuning::default().validate(), Ok(()));
        for (key, spoil) in cases {
            let mut tuning = Tuning::default();
            spoil(&mut tuning);
            assert_eq!(tuning.validate().unwrap_err().key, key);
        }
    }
}
