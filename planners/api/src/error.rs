//! Errors: bad input and bad settings. Failing to find a path is a status, not an error.

/// Why a planner could not begin.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// Start or goal is not finite.
    #[error("{end} ({x}, {y}) is not finite")]
    NotFinite {
        /// "start" or "goal".
        end: &'static str,
        /// Its x.
        x: f64,
        /// Its y.
        y: f64,
    },
    /// Start or goal in an obstacle.
    #[error("{end} ({x:.3}, {y:.3}) is {depth:.4} inside obstacle {obstacle}; expected a free point")]
    InsideObstacle {
        /// "start" or "goal".
        end: &'static str,
        /// Its x.
        x: f64,
        /// Its y.
        y: f64,
        /// How deep, robot radius included.
        depth: f64,
        /// Index of the obstacle, counted from 0.
        obstacle: usize,
    },
    /// Start or goal outside the field.
    #[error("{end} ({x:.3}, {y:.3}) leaves the field by {depth:.4}; expected a point inside")]
    OutsideField {
        /// "start" or "goal".
        end: &'static str,
        /// Its x.
        x: f64,
        /// Its y.
        y: f64,
        /// How far the robot's disc reaches over the border.
        depth: f64,
    },
    /// Start and goal coincide.
    #[error("start and goal are the same point ({x}, {y})")]
    StartIsGoal {
        /// Their x.
        x: f64,
        /// Their y.
        y: f64,
    },
    /// Start or goal has no free cell in straight reach.
    #[error(
        "{key} = {value}: the grid is coarser than the gaps: {end} ({x:.3}, {y:.3}) sees no free cell of side {size:.4} \
        within three cells; expected a finer grid"
    )]
    GridTooCoarse {
        /// The setting that decides the cells' size.
        key: &'static str,
        /// Its value.
        value: usize,
        /// The cells' side, in scene units.
        size: f64,
        /// "start" or "goal".
        end: &'static str,
        /// Its x.
        x: f64,
        /// Its y.
        y: f64,
    },
    /// The planner cannot treat this kind of world.
    #[error("{0}")]
    Unsupported(String),
}

/// A setting outside its range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key} = {value}; expected {expected}")]
pub struct SettingError {
    /// The setting's name, as in TOML.
    pub key: &'static str,
    /// What it is.
    pub value: String,
    /// What it may be.
    pub expected: &'static str,
}

impl SettingError {
    /// `key = value; expected …`, unless `ok`.
    pub fn check(
        ok: bool,
        key: &'static str,
        value: impl std::fmt::Display,
        expected: &'static str,
    ) -> Result<(), Self> {
        if ok { Ok(()) } else { Err(Self { key, value: value.to_string(), expected }) }
    }
}
