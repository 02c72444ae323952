//! `wall`: rows of defenders across the straight line, too close to pass between.
//!
//! Neighbours of a row are nearer than the sum of their inflated radii, r₁ + r₂ + 2 r,
//! so every point between them is inside one of the two. The straight line crosses
//! the middle half of every row.

use super::ROBOT_RADIUS;
use super::crowd::{Crowd, LARGE_RADIUS};
use super::draw::Draw;
use crate::{Point, Scene, Vector};

/// Obstacles for each row, roughly; half of them stand in it.
const OBSTACLES_PER_ROW: usize = 10;
/// Rows keep at least this far apart along the line, m.
const ROW_SPACING: f64 = 1.0;
/// Share of defenders that are given a margin of 0.1 m.
const LARGE_SHARE: f64 = 0.25;
/// Neighbours stand at no more than this share of the distance at which a gap would open.
const TIGHTEST_GAP: f64 = 0.85;

pub(super) fn draw(draw: &mut Draw, count: usize) -> Option<Scene> {
    let mut crowd = Crowd::new(draw, count);
    let line = crowd.goal - crowd.start;
    let (from, to) = (0.2, 0.8);
    let most_rows = ((to - from) * line.norm() / ROW_SPACING) as usize;
    let rows = (count / OBSTACLES_PER_ROW).clamp(1, most_rows);
    for row in 0..rows {
        // One row in each of equal stretches of the line, in the middle 70 % of its stretch.
        let stretch = (to - from) / rows as f64;
        let along = from + stretch * (row as f64 + draw.between(0.15, 0.85));
        let size = (4 + draw.below(3)).min(count - crowd.len());
        let at = crowd.start + line * along;
        place_row(draw, &mut crowd, at, line, size)?;
    }
    crowd.scatter(draw, count)?;
    Some(crowd.into_scene())
}

/// Places `size` defenders side by side so that `at` lies in the middle half of their row.
fn place_row(draw: &mut Draw, crowd: &mut Crowd, at: Point, line: Vector, size: usize) -> Option<()> {
    let tilt = draw.between(-0.35, 0.35);
    let direction = (Vector::new(-line.y, line.x) + line * tilt).normalize();
    let mut row = Vec::with_capacity(size);
    let mut length = 0.0;
    let mut previous: Option<f64> = None;
    for _ in 0..size {
        let radius = if draw.chance(LARGE_SHARE) { LARGE_RADIUS } else { ROBOT_RADIUS };
        if let Some(previous) = previous {
            let opening = previous + radius + 2.0 * ROBOT_RADIUS;
            length += draw.between(2.0 * ROBOT_RADIUS + 0.01, TIGHTEST_GAP * opening);
        }
        row.push((length, radius));
        previous = Some(radius);
    }
    let crossing = length * draw.between(0.25, 0.75);
    row.into_iter().all(|(s, radius)| crowd.try_add(at + direction * (s - crossing), radius)).then_some(())
}
