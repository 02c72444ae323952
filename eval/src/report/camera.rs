//! From scene units to picture units, and polylines as compact path data.
//!
//! Picture units have y down and a drawing area 500 wide; coordinates are rounded
//! to 0.1, so that a path of 20 points takes some 150 bytes, and text, strokes
//! and focus outlines have sane sizes whatever the scene's unit is.

use std::fmt::Write as _;

use env_model::{Aabb, Point, Scene, Vector};

/// Width of the drawing area.
pub(super) const WIDTH: f64 = 500.0;
/// Room left of it, for numbers.
pub(super) const LEFT: f64 = 48.0;
/// Room above it.
pub(super) const TOP: f64 = 12.0;
/// Room right of it.
pub(super) const RIGHT: f64 = 12.0;
/// Room below it, for numbers.
pub(super) const BOTTOM: f64 = 30.0;

/// A map from scene units to picture units.
#[derive(Debug, Clone, Copy)]
pub struct Camera {
    pub(super) region: Aabb,
    pub(super) scale: f64,
}

impl Camera {
    /// Sees the scene with its inflation, and of `paths` what lies at most a
    /// quarter of the scene's size outside.
    pub fn new<'a>(scene: &Scene, paths: impl Iterator<Item = &'a [Point]>) -> Self {
        let base = scene.aabb().inflated(scene.robot_radius);
        let base = base.inflated(0.02 * base.diagonal());
        let limit = base.inflated(0.25 * base.size().max());
        let mut region = base;
        for p in paths.flatten().filter(|p| p.x.is_finite() && p.y.is_finite()) {
            region = region.including(p.sup(&limit.min).inf(&limit.max));
        }
        region = region.inflated(0.02 * region.diagonal());
        // Neither a ribbon nor a tower.
        let size = region.size();
        let grow = Vector::new((0.9 * size.y - size.x).max(0.0), (0.4 * size.x - size.y).max(0.0)) * 0.5;
        let mut region = Aabb { min: region.min - grow, max: region.max + grow };
        let size = region.size();
        // A scene of a size beyond all measure is drawn somehow, but without NaN.
        if !(1e-200..1e200).contains(&size.x) || !(1e-200..1e200).contains(&size.y) {
            region = Aabb { min: Point::new(-1.0, -1.0), max: Point::new(1.0, 1.0) };
        }
        Self::of(region)
    }

    /// Sees `region` and nothing else.
    pub(super) fn of(region: Aabb) -> Self {
        Self { region, scale: WIDTH / region.size().x }
    }

    /// Height of the drawing area.
    pub(super) fn height(&self) -> f64 {
        self.region.size().y * self.scale
    }

    /// The picture coordinates of `p`.
    pub(super) fn map(&self, p: Point) -> (f64, f64) {
        // Far points would only bloat the file; the picture is clipped anyway.
        let far = 10.0 * WIDTH;
        let x = LEFT + ((p.x - self.region.min.x) * self.scale).clamp(-far, far);
        let y = TOP + ((self.region.max.y - p.y) * self.scale).clamp(-far, far);
        (x, y)
    }
}

/// Path data of a polyline in whole tenths, relative, without points that nobody could see.
pub fn polyline(camera: &Camera, points: &[Point]) -> String {
    let mapped: Vec<(f64, f64)> =
        points.iter().filter(|p| p.x.is_finite() && p.y.is_finite()).map(|p| camera.map(*p)).collect();
    let mut keep = vec![false; mapped.len()];
    if let (Some(first), Some(last)) = (keep.first().copied(), mapped.len().checked_sub(1)) {
        debug_assert!(!first);
        keep[0] = true;
        keep[last] = true;
        simplify(&mapped, &mut keep);
    }
    let mut out = String::new();
    let mut pen: Option<(i64, i64)> = None;
    for (x, y) in mapped.iter().zip(&keep).filter(|(_, k)| **k).map(|(p, _)| p) {
        let at = ((10.0 * x).round() as i64, (10.0 * y).round() as i64);
        match pen {
            None => {
                let _ = write!(out, "M{} {}l", tenth(at.0), tenth(at.1));
            }
            Some(old) => {
                let (dx, dy) = (tenth(at.0 - old.0), tenth(at.1 - old.1));
                let gap = if out.ends_with('l') || dx.starts_with('-') { "" } else { " " };
                let _ = write!(out, "{gap}{dx}{}{dy}", if dy.starts_with('-') { "" } else { " " });
            }
        }
        pen = Some(at);
    }
    if out.ends_with('l') {
        out += "0 0";
    }
    out
}

fn tenth(v: i64) -> String {
    let (sign, v) = (if v < 0 { "-" } else { "" }, v.abs());
    match (v / 10, v % 10) {
        (whole, 0) => format!("{sign}{whole}"),
        (0, part) => format!("{sign}.{part}"),
        (whole, part) => format!("{sign}{whole}.{part}"),
    }
}

/// Marks the points that a line within 0.06 picture units needs.
/// Douglas & Peucker, *Cartographica* 10 (1973) 112–122; a stack instead of recursion.
fn simplify(points: &[(f64, f64)], keep: &mut [bool]) {
    let mut spans = vec![(0, points.len() - 1)];
    while let Some((first, last)) = spans.pop() {
        let ((ax, ay), (bx, by)) = (points[first], points[last]);
        let (dx, dy) = (bx - ax, by - ay);
        let length2 = dx * dx + dy * dy;
        let distance2 = |(x, y): (f64, f64)| {
            let s = if length2 > 0.0 { (((x - ax) * dx + (y - ay) * dy) / length2).clamp(0.0, 1.0) } else { 0.0 };
            let (ex, ey) = (x - ax - s * dx, y - ay - s * dy);
            ex * ex + ey * ey
        };
        let farthest = (first + 1..last).max_by(|&i, &j| distance2(points[i]).total_cmp(&distance2(points[j])));
        if let Some(i) = farthest.filter(|&i| distance2(points[i]) > 0.06 * 0.06) {
            keep[i] = true;
            spans.push((first, i));
            spans.push((i, last));
        }
    }
}
