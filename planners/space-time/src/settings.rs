//! Settings of planning in space and time.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of [`Sipp`](crate::Sipp).
///
/// The paper leaves cells and speed to the application; these defaults are ours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SippSettings {
    /// Cells along the longer side of the field, 2 … 400. Default 48: 0.25 m on a division A field.
    pub cells: usize,
    /// The speed of moves from cell to cell, as a share of the robot's limit, 0 < share ≤ 1. Default 0.5, the mean
    /// speed of a motion that reaches the limit and stops at once: starting and stopping are in the cost.
    pub cruise: f64,
}

impl Default for SippSettings {
    fn default() -> Self {
        Self { cells: 48, cruise: 0.5 }
    }
}

impl SippSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check((2..=400).contains(&self.cells), "cells", self.cells, "2 to 400")?;
        let cruise = self.cruise;
        SettingError::check(cruise > 0.0 && cruise <= 1.0, "cruise", cruise, "above 0, at most 1")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_settings_are_errors_by_name() {
        let settings = |cells, cruise| SippSettings { cells, cruise }.validate().map_err(|e| e.key);
        assert_eq!(settings(48, 0.5), Ok(()));
        assert_eq!(settings(1, 0.5), Err("cells"));
        assert_eq!(settings(401, 0.5), Err("cells"));
        assert_eq!(settings(48, 0.0), Err("cruise"));
        assert_eq!(settings(48, f64::NAN), Err("cruise"));
    }
}
