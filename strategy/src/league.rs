//! The Small Size League's numbers (rules of 2026), in metres.

use env_model::scene::Field;
use serde::{Deserialize, Serialize};

/// A robot's radius.
pub const ROBOT_RADIUS: f64 = 0.09;
/// A ball's radius.
pub const BALL_RADIUS: f64 = 0.0215;

/// Which division's field.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum League {
    /// 12 × 9 m, 11 robots.
    #[default]
    DivisionA,
    /// 9 × 6 m, 6 robots.
    DivisionB,
}

impl League {
    /// Half the field's length and half its width.
    pub fn half_size(self) -> [f64; 2] {
        match self {
            Self::DivisionA => [6.0, 4.5],
            Self::DivisionB => [4.5, 3.0],
        }
    }

    /// Depth and width of a defence area.
    pub fn defence_area(self) -> [f64; 2] {
        match self {
            Self::DivisionA => [1.8, 3.6],
            Self::DivisionB => [1.0, 2.0],
        }
    }

    /// The field, its middle at the origin, the own goal at −x. Robots may leave the lines by the boundary's 0.3 m.
    pub fn field(self) -> Field {
        let [x, y] = self.half_size().map(|half| half + 0.3);
        Field { min: [-x, -y], max: [x, y] }
    }
}
