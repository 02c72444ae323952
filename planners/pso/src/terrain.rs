//! The obstacles as a swarm in the column model meets them.
//!
//! Everything that depends only on column or strip is worked out once a call:
//! which discs can touch which strip, and which heights of a column lie in a
//! disc. A segment collides with a disc iff its distance from the centre is
//! below r (the paper's §2.3), that is iff one end lies in the disc (an
//! interval test on its column) or the foot of the perpendicular lies inside
//! the segment and nearer than r.

use env_model::{Aabb, Columns, Core, Inflated, LocalFrame, Point, World};

use crate::choices::Bounds;

/// A disc that can touch a strip, relative to the strip's left column.
#[derive(Debug, Clone, Copy)]
pub struct StripDisc {
    /// Centre's x' less the left column's.
    pub fx: f64,
    /// The same times the column spacing.
    pub fx_dx: f64,
    /// Centre's y'.
    pub cy: f64,
    /// Radius squared.
    pub r2: f64,
}

/// The heights of a column inside a disc: |y' − cy| < half.
#[derive(Debug, Clone, Copy)]
pub struct Gap {
    /// Centre's y'.
    pub cy: f64,
    /// Half the chord.
    pub half: f64,
}

/// A capsule or polygon that can touch a strip.
#[derive(Debug, Clone, Copy)]
pub struct Other {
    /// Its index in the world.
    pub index: usize,
    /// Between these heights it lies in the strip.
    pub low: f64,
    /// The upper one.
    pub high: f64,
}

/// What a strip between two columns has: so many of the terrain's lists, which are in the order of the strips.
#[derive(Debug, Clone, Copy)]
pub struct Strip {
    /// Width squared.
    pub dx2: f64,
    /// Discs that can touch it.
    pub discs: usize,
    /// Gaps of its right column; the goal's has none, as the goal is free.
    pub gaps: usize,
    /// Capsules and polygons that can touch it.
    pub others: usize,
    /// Heights where its right column is inside the field.
    pub inside: (f64, f64),
}

/// Lists by strip; strip j lies between columns j and j + 1.
#[derive(Debug, Clone, Default)]
pub struct Terrain {
    /// A strip of no width before the start, then strips 0 … m.
    pub strips: Vec<Strip>,
    /// Discs of all strips.
    pub discs: Vec<StripDisc>,
    /// Gaps of all columns.
    pub gaps: Vec<Gap>,
    /// Capsules and polygons of all strips.
    pub others: Vec<Other>,
    /// Whether the scene has a field.
    pub has_field: bool,
    /// Column spacing.
    pub dx: f64,
    /// Each disc that the swarm can meet once: centre and radius.
    met_discs: Vec<(f64, f64, f64)>,
    /// Each capsule and polygon once: index and box.
    met_others: Vec<(usize, Aabb)>,
    /// Indices of obstacles that may be met.
    near: Vec<usize>,
}

impl Terrain {
    /// Compiles the world for `columns`. With bounds, only obstacles that meet the search rectangle matter.
    pub fn compile(&mut self, world: &World, columns: &Columns, bounds: Bounds) {
        let (frame, dx, m) = (columns.frame(), columns.spacing(), columns.count());
        let length = frame.length();
        let reach = if bounds == Bounds::None { f64::INFINITY } else { columns.half_width() };
        self.dx = dx;
        self.met_discs.clear();
        self.met_others.clear();
        self.find_near(world, columns, bounds);
        for &i in &self.near {
            let obstacle = &world.obstacles()[i];
            if let Some((c, r)) = obstacle.as_disc() {
                let c = frame.to_local(c);
                if c.x + r > 0.0 && c.x - r < length && c.y.abs() - r < reach {
                    self.met_discs.push((c.x, c.y, r));
                }
            } else {
                let b = frame.aabb_of(obstacle);
                if b.max.x > 0.0 && b.min.x < length && b.max.y > -reach && b.min.y < reach {
                    self.met_others.push((i, b));
                }
            }
        }
        self.strips.clear();
        self.discs.clear();
        self.gaps.clear();
        self.others.clear();
        self.has_field = world.inner_field().is_some();
        let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
        self.strips.push(Strip { dx2: 0.0, discs: 0, gaps: 0, others: 0, inside: everywhere });
        for j in 0..=m {
            let before = (self.discs.len(), self.gaps.len(), self.others.len());
            let (left, right) = (columns.x(j), columns.x(j + 1));
            for &(cx, cy, r) in &self.met_discs {
                if cx + r > left && cx - r < right {
                    let fx = cx - left;
                    self.discs.push(StripDisc { fx, fx_dx: fx * dx, cy, r2: r * r });
                }
                let off = right - cx;
                if j < m && off.abs() < r {
                    self.gaps.push(Gap { cy, half: (r * r - off * off).sqrt() });
                }
            }
            for (index, b) in &self.met_others {
                if b.max.x > left && b.min.x < right {
                    let obstacle = &world.obstacles()[*index];
                    let (low, high) = span(frame, obstacle, left, right, world.epsilon());
                    self.others.push(Other { index: *index, low: low.max(b.min.y), high: high.min(b.max.y) });
                }
            }
            self.strips.push(Strip {
                dx2: dx * dx,
                discs: self.discs.len() - before.0,
                gaps: self.gaps.len() - before.1,
                others: self.others.len() - before.2,
                inside: match world.inner_field() {
                    Some(field) if j < m => columns.inside(j + 1, field),
                    _ => everywhere,
                },
            });
        }
    }

    /// Finds the obstacles whose boxes in the world meet that of the search rectangle.
    fn find_near(&mut self, world: &World, columns: &Columns, bounds: Bounds) {
        self.near.clear();
        if matches!(bounds, Bounds::None) {
            self.near.extend(0..world.obstacles().len());
            return;
        }
        let (length, h) = (columns.frame().length(), columns.half_width());
        let corners = [(0.0, -h), (0.0, h), (length, -h), (length, h)];
        let corners = corners.map(|(x, y)| columns.frame().to_world(Point::new(x, y)));
        // Wider than any rounding of the turn into the local frame and back.
        let region = Aabb::of_points(&corners).inflated(world.epsilon());
        world.for_each_overlapping(&region, |i| self.near.push(i));
        self.near.sort_unstable();
    }

    /// Centres (x', y') of every obstacle that the swarm can meet, in scene order by kind.
    pub fn centres(&self) -> impl Iterator<Item = Point> + '_ {
        let discs = self.met_discs.iter().map(|&(cx, cy, _)| Point::new(cx, cy));
        discs.chain(self.met_others.iter().map(|(_, b)| b.centre()))
    }
}

/// Heights between which an obstacle lies, from `left` to `right`, at least; lowest above highest where it does not.
///
/// A point of it is nearer than its radius r to a point of its core at most r further
/// left or right. All is widened by `margin`, for rounding.
fn span(frame: &LocalFrame, obstacle: &Inflated, left: f64, right: f64, margin: f64) -> (f64, f64) {
    let reach = obstacle.radius + margin;
    let (left, right) = (left - reach, right + reach);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut include = |a: Point, b: Point| {
        let (a, b) = (frame.to_local(a), frame.to_local(b));
        let (a, b) = if a.x <= b.x { (a, b) } else { (b, a) };
        if a.x <= right && b.x >= left {
            let at = |x: f64| {
                if x <= a.x {
                    a.y
                } else if x >= b.x {
                    b.y
                } else {
                    a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y)
                }
            };
            let (first, last) = (at(left), at(right));
            (low, high) = (low.min(first).min(last), high.max(first).max(last));
        }
    };
    match &obstacle.core {
        Core::Point(c) => include(*c, *c),
        Core::Segment(a, b) => include(*a, *b),
        Core::Polygon(polygon) => polygon.sides().for_each(|(a, b)| include(a, b)),
    }
    (low - reach, high + reach)
}

/// Whether the segment of strip j from height `a` to `b` hits one of `others`, capsules and polygons of `world`.
pub fn hits_other(world: &World, columns: &Columns, others: &[Other], j: usize, a: f64, b: f64) -> bool {
    let (low, high) = (a.min(b), a.max(b));
    let at = |i: usize, y: f64| columns.frame().to_world(Point::new(columns.x(i), y));
    others.iter().any(|other| {
        let apart = low >= other.high || high <= other.low;
        !apart && !world.obstacles()[other.index].segment_free(at(j, a), at(j + 1, b), 0.0)
    })
}
