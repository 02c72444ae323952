//! Settings of the three searches.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of [`GridSearch`](crate::GridSearch).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Cells along the longer side of the pitch, 1 … 2048. Default 120: on a pitch of
    /// 12 m a cell of 10 cm, about a robot's radius, which finds every gap that is
    /// wider than the robot by two diagonals of a cell, 0.28 m, and most narrower ones. The
    /// literature has no usual value. Memory: 30 bytes a cell and 24 for each entry of
    /// the open list; 0.5 MB at the default, below 400 MB at most.
    pub cells: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { cells: 120 }
    }
}

impl Settings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check((1..=2048).contains(&self.cells), "cells", self.cells, "1 to 2048")
    }
}
