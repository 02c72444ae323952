//! Settings of the controller.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

use crate::formation::Formation;
use crate::parameters::Parameters;

/// Settings of [`Behaviour`](crate::Behaviour).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct BehaviourSettings {
    /// The behaviours' parameters. Default: Balch & Arkin's (1998), lengths × 0.01.
    pub parameters: Parameters,
    /// `"line"`, `"column"`, `"diamond"` or `"wedge"`; absent: keep-formation is off. Default absent, for targets of
    /// their own hold a team together as well.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub formation: Option<Formation>,
    /// Distance between neighbours of the formation, in scene units, above 0, at most 1000. Default 0.5.
    pub spacing: f64,
}

impl Default for BehaviourSettings {
    fn default() -> Self {
        Self { parameters: Parameters::default(), formation: None, spacing: 0.5 }
    }
}

impl BehaviourSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        self.parameters.validate()?;
        let spacing = self.spacing;
        SettingError::check(spacing > 0.0 && spacing <= 1000.0, "spacing", spacing, "above 0, at most 1000")
    }
}
