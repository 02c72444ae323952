//! The size of the pitch from SSL-Vision's geometry.

use super::messages::{FieldLineSegment, GeometryFieldSize};
use crate::generate::ROBOT_RADIUS;
use crate::import::instant::Pitch;

/// Metres around the lines where the log does not say (Small Size League rules, §2.1).
const BOUNDARY: f64 = 0.3;

#[derive(Debug, Clone, Copy)]
pub(super) struct Geometry {
    pub pitch: Pitch,
    pub robot_radius: f64,
}

impl Geometry {
    /// Metres from millimetres. Length and width that are unset (or 0) are those of the
    /// touch and goal lines; `None` when there are none either.
    pub(super) fn new(size: &GeometryFieldSize) -> Option<Self> {
        let metres = |mm: Option<i32>| mm.filter(|mm| *mm > 0).map(|mm| f64::from(mm) / 1000.0);
        let pitch = Pitch {
            length: metres(size.field_length).or_else(|| extent(&size.field_lines, |p| p[0]))?,
            width: metres(size.field_width).or_else(|| extent(&size.field_lines, |p| p[1]))?,
            margin: metres(size.boundary_width).unwrap_or(BOUNDARY),
        };
        let robot_radius =
            size.max_robot_radius.filter(|mm| *mm > 0.0).map_or(ROBOT_RADIUS, |mm| f64::from(mm) / 1000.0);
        Some(Self { pitch, robot_radius })
    }
}

/// Metres between the outermost ends of the lines round the pitch, on one axis.
fn extent(lines: &[FieldLineSegment], axis: impl Fn([f32; 2]) -> f32) -> Option<f64> {
    let round_pitch = ["TopTouchLine", "BottomTouchLine", "LeftGoalLine", "RightGoalLine"];
    // Others may lie behind the goal lines, as the goals' own do.
    let round_pitch = |line: &&FieldLineSegment| round_pitch.contains(&line.name.as_deref().unwrap_or_default());
    let ends = lines.iter().filter(round_pitch).flat_map(|line| [&line.p1, &line.p2]).flatten();
    let (low, high) = ends
        .map(|p| axis([p.x.unwrap_or(0.0), p.y.unwrap_or(0.0)]))
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    (low < high).then(|| (f64::from(high) - f64::from(low)) / 1000.0)
}

#[cfg(test)]
mod tests {
    use super::super::messages::Vector2f;
    use super::*;

    fn line(name: &str, p1: [f32; 2], p2: [f32; 2]) -> FieldLineSegment {
        let point = |p: [f32; 2]| Some(Vector2f { x: Some(p[0]), y: Some(p[1]) });
        FieldLineSegment { name: Some(name.to_owned()), p1: point(p1), p2: point(p2) }
    }

    #[test]
    fn what_is_unset_comes_from_the_lines() {
        let mut size = GeometryFieldSize {
            field_lines: vec![
                line("LeftGoalLine", [-6000.0, -4500.0], [-6000.0, 4500.0]),
                line("RightGoalLine", [6000.0, -4500.0], [6000.0, 4500.0]),
                line("RightGoalDepthLine", [6180.0, -900.0], [6180.0, 900.0]),
            ],
            ..GeometryFieldSize::default()
        };
        let Geometry { pitch, robot_radius } = Geometry::new(&size).unwrap();
        assert_eq!((pitch.length, pitch.width, pitch.margin, robot_radius), (12.0, 9.0, 0.3, 0.09));
        size.field_length = Some(9000);
        size.boundary_width = Some(250);
        size.max_robot_radius = Some(85.0);
        let Geometry { pitch, robot_radius } = Geometry::new(&size).unwrap();
        assert_eq!((pitch.length, pitch.width, pitch.margin, robot_radius), (9.0, 9.0, 0.25, 0.085));
        size.field_lines.clear();
        assert!(Geometry::new(&size).is_none(), "no width");
    }
}
