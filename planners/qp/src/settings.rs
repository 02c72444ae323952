//! What the refinement optimises, over which model, and how exactly.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of [`Qp`](crate::Qp).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Where vertices may move. Default `"columns"`.
    pub model: Model,
    /// What becomes small. Default `"shorten"`.
    pub objective: Objective,
    /// How clarabel shortens; both reach the same length. Default `"reweighted-qp"`, three times faster.
    pub method: Method,
    /// Who solves the programmes. Default `"clarabel"`.
    pub solver: Solver,
    /// Which ways past the obstacles are tried in the column model. Default `"swarm"`.
    pub classes: Classes,
    /// Columns m of the column model, 1 … 10 000. Default: those of the path
    /// when its vertices lie on equidistant columns of start → goal, else 20
    /// (Lu & Sun 2012: dim = 22 with both ends).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub columns: Option<usize>,
    /// `smooth`: weight of ‖D₁p‖²/Δ (first differences), ≥ 0, no unit. Default 1.
    /// Δ = |goal − start|/segments, the spacing of the columns.
    pub w_length: f64,
    /// `smooth`: weight of ‖D₂p‖² (second differences), ≥ 0, per scene unit. Default 1.
    pub w_smooth: f64,
    /// `smooth`: weight of ‖p − p₀‖², p₀ the path before refinement, ≥ 0, per scene unit. Default 0.
    pub w_reference: f64,
    /// Most solves for one side class or one set of free vertices, 1 … 10 000. Default 100; on columns about 8
    /// are usual, with free vertices 2 to 50.
    pub max_rounds: usize,
    /// Relative change of the objective that counts as none, 1e-12 … 1e-2. Default 1e-9. With free vertices,
    /// where steps shrink slowly, 10⁴ times this. The structured solver ends at a duality gap of a tenth of it.
    pub tolerance: f64,
}

/// Where vertices may move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// On the perpendicular columns of start → goal (Lu & Sun 2012). For given
    /// sides of the obstacles the problem is convex and solved globally. Paths
    /// that are not monotone along start → goal, and free paths whose sides
    /// cannot be kept on the columns, are refined as `Free` instead.
    Columns,
    /// In the plane, the path's own vertices. Descends from the current path
    /// with a guarantee, without a claim of optimality. A colliding path is
    /// repaired on the columns first.
    Free,
}

/// What becomes small.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Objective {
    /// The length Σ‖pᵢ₊₁ − pᵢ‖.
    Shorten,
    /// `w_length`·‖D₁p‖²/Δ + `w_smooth`·‖D₂p‖² + `w_reference`·‖p − p₀‖².
    Smooth,
}

/// How the length is minimised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Quadratic programmes min Σ wᵢ‖pᵢ₊₁ − pᵢ‖² with wᵢ ← 1/‖pᵢ₊₁ − pᵢ‖: the length never rises from one to the next.
    ReweightedQp,
    /// The exact second-order cone programme min Σ tᵢ, ‖pᵢ₊₁ − pᵢ‖ ≤ tᵢ.
    Socp,
}

/// Who solves the programmes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// Clarabel, a general interior-point solver: rounds of programmes with cutting planes, `method` says which.
    Clarabel,
    /// An interior point of our own for heights on columns, with both objectives: banded Newton steps on the
    /// length itself and on the curved borders, one programme a side class. It covers `model = "columns"` with
    /// the default `method`; what that model leaves to free vertices (see [`Model::Columns`]) is solved by clarabel.
    Structured,
}

/// Which side classes are tried in the column model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Classes {
    /// Those of the path and of all candidates that its planner handed on, by
    /// a lower bound on their length, until the bound exceeds the best.
    /// `smooth` tries the others only when the path's own has no free path.
    Swarm,
    /// Only that of the path.
    Final,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            model: Model::Columns,
            objective: Objective::Shorten,
            method: Method::ReweightedQp,
            solver: Solver::Clarabel,
            classes: Classes::Swarm,
            columns: None,
            w_length: 1.0,
            w_smooth: 1.0,
            w_reference: 0.0,
            max_rounds: 100,
            tolerance: 1e-9,
        }
    }
}

impl Settings {
    /// Checks every range.
    ///
    /// # Errors
    /// [`SettingError`] with the setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        if let Some(m) = self.columns {
            SettingError::check((1..=10_000).contains(&m), "columns", m, "1 to 10000")?;
        }
        for (key, w) in [("w_length", self.w_length), ("w_smooth", self.w_smooth), ("w_reference", self.w_reference)] {
            SettingError::check(w.is_finite() && w >= 0.0, key, w, "a finite number of at least 0")?;
        }
        let sum = self.w_length + self.w_smooth + self.w_reference;
        SettingError::check(sum > 0.0, "w_length", self.w_length, "at least one of the three weights above 0")?;
        if self.solver == Solver::Structured {
            let covered = self.model == Model::Columns && self.method == Method::ReweightedQp;
            let expected = "\"clarabel\" with model = \"free\" or method = \"socp\"";
            SettingError::check(covered, "solver", "\"structured\"", expected)?;
        }
        SettingError::check((1..=10_000).contains(&self.max_rounds), "max_rounds", self.max_rounds, "1 to 10000")?;
        SettingError::check((1e-12..=1e-2).contains(&self.tolerance), "tolerance", self.tolerance, "1e-12 to 1e-2")
    }

    /// What must be undercut for a gain over `cost`.
    pub(crate) fn enough(&self, cost: f64) -> f64 {
        cost * (1.0 - self.tolerance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_words_in_toml() {
        let text = "model = \"free\"\nobjective = \"smooth\"\nmethod = \"socp\"\nsolver = \"clarabel\"\nclasses = \"final\"\ncolumns = 5\nw_smooth = 2.5";
        let settings: Settings = toml::from_str(text).unwrap();
        assert_eq!(
            settings,
            Settings {
                model: Model::Free,
                objective: Objective::Smooth,
                method: Method::Socp,
                classes: Classes::Final,
                columns: Some(5),
                w_smooth: 2.5,
                ..Settings::default()
            }
        );
        assert_eq!(toml::from_str::<Settings>("").unwrap(), Settings::default());
        let written = toml::to_string(&Settings::default()).unwrap();
        assert_eq!(toml::from_str::<Settings>(&written).unwrap(), Settings::default());
        assert!(written.contains("method = \"reweighted-qp\"") && !written.contains("columns ="), "{written}");
        assert!(toml::from_str::<Settings>("w_smoth = 1").is_err(), "unknown key");
    }

    #[test]
    fn ranges_are_checked() {
        let default = Settings::default;
        let bad = [
            ("columns", Settings { columns: Some(0), ..default() }),
            ("w_smooth", Settings { w_smooth: -1.0, ..default() }),
            ("w_reference", Settings { w_reference: f64::NAN, ..default() }),
            ("w_length", Settings { w_length: 0.0, w_smooth: 0.0, ..default() }),
            ("solver", Settings { solver: Solver::Structured, model: Model::Free, ..default() }),
            ("solver", Settings { solver: Solver::Structured, method: Method::Socp, ..default() }),
            ("max_rounds", Settings { max_rounds: 0, ..default() }),
            ("tolerance", Settings { tolerance: 0.0, ..default() }),
        ];
        for (key, settings) in bad {
            assert_eq!(settings.validate().unwrap_err().key, key);
        }
        assert_eq!(default().validate(), Ok(()));
    }
}
