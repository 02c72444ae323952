//! Settings of the ant colony.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// What an ant does that has visited every cell around it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DeadEnd {
    /// It steps back until it can go on; the cells it leaves stay tabu.
    Retreat,
    /// Its tour counts for nothing.
    Die,
}

/// Settings of [`AntColony`](crate::AntColony).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Cells along the longer side of the pitch, 1 … 512. Default 40: 0.3 m on a pitch of
    /// 12 m; studies of paths on grids use 20 to 50. Memory: 120 bytes a cell.
    pub cells: usize,
    /// Ants m, 1 … 10 000. Default 30 (1996: as many as cities, 30 in its main example).
    pub ants: usize,
    /// Iterations, each of m tours; 1 … 10⁶. Default 50, after which the tours of a
    /// pitch change little. (1996: up to 5000.)
    pub iterations: u64,
    /// Weight α of the trail, 0 … 20. Default 1 (1996, §IV).
    pub alpha: f64,
    /// Weight β of the goal's nearness, 0 … 20. Default 5 (1996, §IV).
    pub beta: f64,
    /// Share ρ of a trail that evaporates in an iteration, above 0, at most 1. Default 0.5 (1996, §IV).
    pub rho: f64,
    /// Trail Q that an ant lays on a tour of length 1, in cell sides; above 0, at most 10⁹.
    /// Default 100 (1996, §IV).
    pub q: f64,
    /// Trail c on every edge at the beginning, above 0, at most 10⁹. Default 10.
    /// (1996: "a small positive constant".)
    pub initial_trail: f64,
    /// Elitist ants e, which lay trails on the best tour so far; 0 … 10 000. Default 8
    /// (1996, §V); 0 is the Ant System without elitists.
    pub elitists: f64,
    /// `"retreat"` or `"die"`. Default `"retreat"`, with which every ant arrives.
    pub dead_end: DeadEnd,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            cells: 40,
            ants: 30,
            iterations: 50,
            alpha: 1.0,
            beta: 5.0,
            rho: 0.5,
            q: 100.0,
            initial_trail: 10.0,
            elitists: 8.0,
            dead_end: DeadEnd::Retreat,
        }
    }
}

impl Settings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check((1..=512).contains(&self.cells), "cells", self.cells, "1 to 512")?;
        SettingError::check((1..=10_000).contains(&self.ants), "ants", self.ants, "1 to 10000")?;
        SettingError::check((1..=1_000_000).contains(&self.iterations), "iterations", self.iterations, "1 to 1000000")?;
        for (key, weight) in [("alpha", self.alpha), ("beta", self.beta)] {
            SettingError::check((0.0..=20.0).contains(&weight), key, weight, "0 to 20")?;
        }
        SettingError::check(self.rho > 0.0 && self.rho <= 1.0, "rho", self.rho, "above 0, at most 1")?;
        for (key, trail) in [("q", self.q), ("initial_trail", self.initial_trail)] {
            SettingError::check(trail > 0.0 && trail <= 1e9, key, trail, "above 0, at most 1000000000")?;
        }
        SettingError::check((0.0..=10_000.0).contains(&self.elitists), "elitists", self.elitists, "0 to 10000")
    }
}
