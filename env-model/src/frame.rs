//! The 2012 local frame X'RY' and its perpendicular columns (Lu & Sun 2012, §2.1–2.2).

use crate::{Aabb, Inflated, Point, Vector};

/// Origin at the robot R, x' along RG (eq. 3 of the paper).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalFrame {
    origin: Point,
    /// (cos θ, sin θ).
    axis: Vector,
    length: f64,
}

impl LocalFrame {
    /// The frame of `start` → `goal`, which must differ.
    pub fn new(start: Point, goal: Point) -> Self {
        let d = goal - start;
        let length = d.norm();
        Self { origin: start, axis: d / length, length }
    }

    /// L = |RG|.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// World → local: (x', y').
    pub fn to_local(&self, p: Point) -> Point {
        let d = p - self.origin;
        Point::new(d.x * self.axis.x + d.y * self.axis.y, d.y * self.axis.x - d.x * self.axis.y)
    }

    /// Local → world.
    pub fn to_world(&self, p: Point) -> Point {
        let (c, s) = (self.axis.x, self.axis.y);
        self.origin + Vector::new(p.x * c - p.y * s, p.x * s + p.y * c)
    }

    /// An obstacle seen in the local frame.
    pub fn obstacle_to_local(&self, obstacle: &Inflated) -> Inflated {
        obstacle.mapped(|p| self.to_local(p))
    }

    /// The smallest box, in the local frame, round an obstacle. Allocates nothing.
    pub fn aabb_of(&self, obstacle: &Inflated) -> Aabb {
        obstacle.aabb_seen_by(|p| self.to_local(p))
    }
}

/// The search model of the 2012 paper: RG cut into m + 1 equal parts, a
/// perpendicular column on each of the m inner division points. A candidate is
/// the m heights (y'₁ … y'ₘ); the paper's search rectangle has |y'| ≤ L/4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Columns {
    frame: LocalFrame,
    start: Point,
    goal: Point,
    count: usize,
}

impl Columns {
    /// `count` = m ≥ 1 columns between two different points.
    pub fn new(start: Point, goal: Point, count: usize) -> Self {
        Self { frame: LocalFrame::new(start, goal), start, goal, count }
    }

    /// The local frame.
    pub fn frame(&self) -> &LocalFrame {
        &self.frame
    }

    /// m, the number of free heights.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Δ = L/(m + 1).
    pub fn spacing(&self) -> f64 {
        self.frame.length / (self.count + 1) as f64
    }

    /// H = L/4, half the width of the paper's rectangle.
    pub fn half_width(&self) -> f64 {
        0.25 * self.frame.length
    }

    /// x' of column `i`, 0 ≤ i ≤ m + 1; 0 is the start, m + 1 the goal.
    pub fn x(&self, i: usize) -> f64 {
        i as f64 * self.spacing()
    }

    /// The heights (lowest, highest) at which column `i` is inside `region`; empty when it passes by.
    pub fn inside(&self, i: usize, region: &Aabb) -> (f64, f64) {
        let foot = self.frame.to_world(Point::new(self.x(i), 0.0));
        let up = Vector::new(-self.frame.axis.y, self.frame.axis.x);
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for k in 0..2 {
            let (to_min, to_max) = (region.min[k] - foot[k], region.max[k] - foot[k]);
            if up[k] == 0.0 && (to_min > 0.0 || to_max < 0.0) {
                return (f64::INFINITY, f64::NEG_INFINITY);
            }
            if up[k] != 0.0 {
                let (u, v) = (to_min / up[k], to_max / up[k]);
                (low, high) = (low.max(u.min(v)), high.min(u.max(v)));
            }
        }
        (low, high)
    }

    /// Writes start, the m points at `heights`, goal into `path`: m + 2 points, the ends exact.
    pub fn write_path(&self, heights: &[f64], path: &mut Vec<Point>) {
        path.clear();
        self.append_path(heights, path);
    }

    /// Appends the same points to `path`.
    pub fn append_path(&self, heights: &[f64], path: &mut Vec<Point>) {
        debug_assert_eq!(heights.len(), self.count);
        path.push(self.start);
        path.extend(heights.iter().enumerate().map(|(i, &y)| self.frame.to_world(Point::new(self.x(i + 1), y))));
        path.push(self.goal);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_cross_a_box_between_its_sides() {
        let region = Aabb { min: Point::new(0.0, -1.0), max: Point::new(10.0, 3.0) };
        let level = Columns::new(Point::new(1.0, 0.0), Point::new(9.0, 0.0), 3);
        assert_eq!(level.inside(2, &region), (-1.0, 3.0));
        let upright = Columns::new(Point::new(4.0, -0.5), Point::new(4.0, 2.5), 2);
        assert_eq!(upright.inside(1, &region), (-6.0, 4.0), "y' points to the left of the way");
        let above = Columns::new(Point::new(1.0, 5.0), Point::new(1.0, 9.0), 1);
        let (low, high) = above.inside(1, &region);
        assert!(low > high, "the column passes by");
    }

    #[test]
    fn the_frame_is_a_rigid_motion_and_back() {
        let columns = Columns::new(Point::new(200.0, 150.0), Point::new(400.0, 260.0), 20);
        assert!((columns.frame().length() - 228.2542).abs() < 1e-4, "|RG| of the digest");
        let p = Point::new(240.0, 160.0);
        let q = columns.frame().to_local(p);
        assert!((columns.frame().to_world(q) - p).norm() < 1e-12);
        assert!(q.y < 0.0, "disc 0 lies right of RG");
        let mut path = Vec::new();
        columns.write_path(&[0.0; 20], &mut path);
        assert_eq!((path.len(), path[0], path[21]), (22, Point::new(200.0, 150.0), Point::new(400.0, 260.0)));
        assert!((crate::path_length(&path) - columns.frame().length()).abs() < 1e-10);
    }
}
