//! Settings.

use std::f64::consts::{FRAC_PI_4, PI};

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of [`QuantumGa`](crate::QuantumGa).
///
/// `population`·`columns`·`bits`, the qubits of all individuals, is at most 10⁷. A
/// qubit takes 16 bytes, its bit in the two strings kept 2 more: 180 MB at most. An
/// observer of the state costs 16 bytes a turning point besides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct QuantumGaSettings {
    /// Columns m between start and goal, 1 … 1000. Default 6, a reading: with the swarm's
    /// 20 (Lu & Sun 2012) the bits settle long before the heights agree: in that paper's
    /// scene (`lu-sun-2012`, medians of 30 seeds) paths are 32 % longer than the
    /// optimum, with 6 columns 3 %.
    pub columns: usize,
    /// Bits a column, 1 … 32; 2ᵏ heights on [−L/4, L/4]. Default 6, a reading.
    pub bits: u32,
    /// Individuals, 1 … 100 000. Default 10 (Han & Kim 2002, QEA).
    pub population: usize,
    /// Generations, 1 … 10⁹. Default 400, the swarm's iterations (Han & Kim: 1000).
    pub generations: u64,
    /// |Δθ| of the rotation gate, radians, above 0, at most π/4. Default 0.01 π (Han & Kim 2002).
    pub rotation: f64,
    /// Generations from one global migration to the next, 1 … 10⁹. Default 100 (Han & Kim 2002).
    pub global_migration: u64,
    /// Individuals that share their best after every generation (local migration),
    /// 1 … 100 000. Default 2, a fifth of the population.
    pub group: usize,
}

/// Qubits of all individuals, so that a run fits into memory.
const MOST_QUBITS: usize = 10_000_000;

impl Default for QuantumGaSettings {
    fn default() -> Self {
        Self {
            columns: 6,
            bits: 6,
            population: 10,
            generations: 400,
            rotation: 0.01 * PI,
            global_migration: 100,
            group: 2,
        }
    }
}

impl QuantumGaSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        let long = 1..=1_000_000_000;
        let (turn, period) = (self.rotation, self.global_migration);
        SettingError::check((1..=1000).contains(&self.columns), "columns", self.columns, "1 to 1000")?;
        SettingError::check((1..=32).contains(&self.bits), "bits", self.bits, "1 to 32")?;
        SettingError::check((1..=100_000).contains(&self.population), "population", self.population, "1 to 100000")?;
        SettingError::check(
            self.population.saturating_mul(self.columns).saturating_mul(self.bits as usize) <= MOST_QUBITS,
            "population",
            format_args!("{} beside columns = {} and bits = {}", self.population, self.columns, self.bits),
            "population·columns·bits of at most 10000000",
        )?;
        SettingError::check(long.contains(&self.generations), "generations", self.generations, "1 to 1000000000")?;
        SettingError::check(turn > 0.0 && turn <= FRAC_PI_4, "rotation", turn, "above 0, at most π/4")?;
        SettingError::check(long.contains(&period), "global_migration", period, "1 to 1000000000")?;
        SettingError::check((1..=100_000).contains(&self.group), "group", self.group, "1 to 100000")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_settings_are_errors_by_name() {
        type Change = fn(&mut QuantumGaSettings);
        let cases: [(&str, Change); 9] = [
            ("columns", |s| s.columns = 0),
            ("bits", |s| s.bits = 0),
            ("bits", |s| s.bits = 33),
            ("population", |s| s.population = 0),
            ("generations", |s| s.generations = 0),
            ("rotation", |s| s.rotation = -0.1),
            ("rotation", |s| s.rotation = f64::NAN),
            ("global_migration", |s| s.global_migration = 0),
            ("group", |s| s.group = 0),
        ];
        for (key, change) in cases {
            let mut settings = QuantumGaSettings::default();
            change(&mut settings);
            assert_eq!(crate::QuantumGa::new(settings).unwrap_err().key, key);
        }
    }

    #[test]
    fn more_qubits_than_fit_into_memory_are_an_error() {
        let of = |population, columns, bits| {
            QuantumGaSettings { population, columns, bits, ..QuantumGaSettings::default() }.validate()
        };
        assert_eq!(of(100_000, 10, 10), Ok(()));
        assert_eq!(
            of(100_000, 1000, 32).unwrap_err().to_string(),
            "population = 100000 beside columns = 1000 and bits = 32; expected population·columns·bits of at most 10000000"
        );
        assert_eq!(of(100_000, 10, 11).unwrap_err().key, "population");
    }
}
