//! Where discs come from: a plain slice, or the broad phase of a world.

use env_model::{Aabb, Core, Inflated, Point, Vector, World};

/// A set of discs in coordinates relative to the start, which keeps scenes far
/// from the origin accurate. An index may be no disc.
pub(crate) trait Discs {
    /// One more than the greatest index.
    fn len(&self) -> usize;
    /// Centre and radius > 0; `None` when the obstacle is not a disc or nothing is left of it.
    fn disc(&self, index: usize) -> Option<(Point, f64)>;
    /// Visits at least every disc that the segment `a b` enters.
    fn along(&self, a: Point, b: Point, visit: impl FnMut(usize));
    /// Visits at least every disc that overlaps the disc of `radius` at `centre`.
    fn around(&self, centre: Point, radius: f64, visit: impl FnMut(usize));
}

/// Discs in a slice; every query visits all.
pub(crate) struct Listed<'a> {
    /// Centres and radii.
    pub discs: &'a [(Point, f64)],
    /// The start.
    pub origin: Vector,
}

impl Discs for Listed<'_> {
    fn len(&self) -> usize {
        self.discs.len()
    }

    fn disc(&self, index: usize) -> Option<(Point, f64)> {
        let (c, r) = self.discs[index];
        (r > 0.0).then(|| (c - self.origin, r))
    }

    fn along(&self, _: Point, _: Point, visit: impl FnMut(usize)) {
        (0..self.len()).for_each(visit);
    }

    fn around(&self, _: Point, _: f64, visit: impl FnMut(usize)) {
        (0..self.len()).for_each(visit);
    }
}

/// The discs of a world, each radius less `shrink`, or less yet where the start
/// or goal lies deeper within the slack that a problem's ends are granted.
pub(crate) struct Shrunk<'a> {
    /// The world.
    pub world: &'a World,
    /// What to take off every radius.
    pub shrink: f64,
    /// The start.
    pub origin: Vector,
    /// The goal, relative to the start.
    pub goal: Point,
}

impl Discs for Shrunk<'_> {
    fn len(&self) -> usize {
        self.world.obstacles().len()
    }

    fn disc(&self, index: usize) -> Option<(Point, f64)> {
        let (c, r) = as_disc(&self.world.obstacles()[index])?;
        let (c, r) = (c - self.origin, r - self.shrink);
        let end2 = c.coords.norm_squared().min((c - self.goal).norm_squared());
        let r = if r > 0.0 && end2 < r * r { end2.sqrt() } else { r };
        (r > 0.0).then_some((c, r))
    }

    fn along(&self, a: Point, b: Point, visit: impl FnMut(usize)) {
        self.world.for_each_along(a + self.origin, b + self.origin, visit);
    }

    fn around(&self, centre: Point, radius: f64, visit: impl FnMut(usize)) {
        let centre = centre + self.origin;
        self.world.for_each_overlapping(&Aabb { min: centre, max: centre }.inflated(radius), visit);
    }
}

/// Centre and radius when the obstacle is a disc, be it spelt as a capsule without length.
pub(crate) fn as_disc(obstacle: &Inflated) -> Option<(Point, f64)> {
    match obstacle.core {
        Core::Segment(a, b) if a == b => Some((a, obstacle.radius)),
        _ => obstacle.as_disc(),
    }
}
