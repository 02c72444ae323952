//! Influence regions: who is nearer, the player on the ball or how many of the defenders.
//!
//! The perpendicular bisector B(f : q) of a defender f and the player q cuts the
//! pitch into the half nearer to q and the half H(f : q) nearer to f. A region
//! inside k of the H(fᵢ : q) has level k; level 0 is the safe region round q
//! (Wang & Zhu 2018, §1; the half-plane pruning of TPL, Tao, Papadias & Lian
//! 2004, for reverse nearest neighbours).
//!
//! n bisectors make at most 1 + n + n(n − 1)/2 regions. [`Partition`] finds them
//! by clipping, in O(n³); the level of a single point is [`level`], in O(n).

use crate::geometry::cross;
use crate::{Aabb, Point, Vector};

/// How many of `defenders` are strictly nearer to `p` than `q` is: #{f : |p − f| < |p − q|}.
///
/// A defender at `q` itself is never nearer. O(n).
pub fn level(q: Point, defenders: &[Point], p: Point) -> usize {
    let own = (p - q).norm_squared();
    defenders.iter().filter(|f| (p - **f).norm_squared() < own).count()
}

/// Where the bisector of a defender and q crosses the pitch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Border {
    /// A of the line Ax + By + C = 0; A² + B² = 1, positive on the defender's side.
    pub a: f64,
    /// B.
    pub b: f64,
    /// C, in scene units.
    pub c: f64,
    /// Where it enters the pitch; the defender is on the left of the way to `to`.
    pub from: Point,
    /// Where it leaves.
    pub to: Point,
    /// The defender, as an index into the list that the caller gave.
    pub defender: usize,
}

impl Border {
    /// The part of B(f : q) inside `pitch`, f = `defenders[defender]`. `None` where
    /// it does not pass through the inside, or f is at `q` and there is no bisector.
    pub fn within(pitch: &Aabb, q: Point, defenders: &[Point], defender: usize) -> Option<Self> {
        let bisector = Bisector::of(q, defenders[defender])?;
        let corners = corners_of(pitch);
        let mut signed = Vec::with_capacity(4);
        if bisector.side_of(&corners, tolerance(pitch), &mut signed) != Side::Both {
            return None;
        }
        let mut ends = [Point::origin(); 2];
        for i in 0..4 {
            let j = (i + 1) % 4;
            // Walking anticlockwise the far side is entered at `to` and left at `from`.
            if signed[i] < 0.0 && signed[j] >= 0.0 {
                ends[1] = crossing(&corners, &signed, i, j);
            } else if signed[i] >= 0.0 && signed[j] < 0.0 {
                ends[0] = crossing(&corners, &signed, i, j);
            }
        }
        let Bisector { normal, middle } = bisector;
        let c = -normal.dot(&middle.coords);
        Some(Self { a: normal.x, b: normal.y, c, from: ends[0], to: ends[1], defender })
    }
}

/// A convex region of the pitch in which the level is the same everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region<'a> {
    /// In how many of the H(fᵢ : q) it lies.
    pub level: usize,
    /// Its corners, anticlockwise, at least three.
    pub corners: &'a [Point],
    /// For each side, from the corner of the same index to the next, the defender
    /// on whose bisector it lies; `None` on the border of the pitch. Where several
    /// bisectors coincide, the first that was cut.
    pub sides: &'a [Option<usize>],
}

impl Region<'_> {
    /// Its area, in square scene units.
    pub fn area(&self) -> f64 {
        let origin = self.corners[0];
        0.5 * self.corners.windows(2).map(|w| cross(w[0] - origin, w[1] - origin)).sum::<f64>()
    }

    /// Whether `p` is inside or on the border.
    pub fn contains(&self, p: Point) -> bool {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).all(|(a, b)| cross(b - a, p - a) >= 0.0)
    }
}

/// The pitch cut by the bisectors of all defenders.
#[derive(Debug, Clone, PartialEq)]
pub struct Partition {
    regions: Regions,
    borders: Vec<Border>,
}

impl Partition {
    /// Cuts `pitch` by B(f : q) for each of `defenders`, by increasing distance
    /// from `q`, ties by index.
    ///
    /// A bisector that misses the pitch, or runs along its border, cuts nothing
    /// but may raise the level of all of it. A defender at `q` has no bisector
    /// and raises no level: no point is strictly nearer to it (see [`level`]).
    /// Corners nearer to a bisector than 10⁻⁹ of the pitch's diagonal count as on
    /// it, so that coinciding and concurrent bisectors leave no slivers.
    pub fn new(pitch: &Aabb, q: Point, defenders: &[Point]) -> Self {
        let distance = |f: usize| (defenders[f] - q).norm_squared();
        let mut order: Vec<usize> = (0..defenders.len()).collect();
        order.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)));

        let tolerance = tolerance(pitch);
        let mut regions = Regions::default();
        regions.push(0, corners_of(pitch).map(|p| (p, None)));
        let mut signed = Vec::new();
        for defender in order {
            let Some(bisector) = Bisector::of(q, defenders[defender]) else { continue };
            let mut cut = Regions::default();
            for region in regions.iter() {
                let side = bisector.side_of(region.corners, tolerance, &mut signed);
                if side != Side::Far {
                    cut.push_half(&region, &signed, -1.0, region.level, defender);
                }
                if side != Side::Near {
                    cut.push_half(&region, &signed, 1.0, region.level + 1, defender);
                }
            }
            regions = cut;
        }
        let borders = (0..defenders.len()).filter_map(|f| Border::within(pitch, q, defenders, f)).collect();
        Self { regions, borders }
    }

    /// The regions; they tile the pitch.
    pub fn regions(&self) -> impl Iterator<Item = Region<'_>> + '_ {
        self.regions.iter()
    }

    /// The border lines between regions, each drawn through: one for every
    /// bisector that passes through the pitch, by the defenders' indices.
    pub fn borders(&self) -> &[Border] {
        &self.borders
    }
}

/// Regions in one buffer.
#[derive(Debug, Clone, PartialEq, Default)]
struct Regions {
    corners: Vec<Point>,
    sides: Vec<Option<usize>>,
    /// Level of each region and where its corners end.
    spans: Vec<(usize, usize)>,
}

impl Regions {
    fn push(&mut self, level: usize, corners: impl IntoIterator<Item = (Point, Option<usize>)>) {
        for (corner, side) in corners {
            self.corners.push(corner);
            self.sides.push(side);
        }
        self.spans.push((level, self.corners.len()));
    }

    /// Appends the part of `region` on the side where `sign`·`signed` ≥ 0.
    fn push_half(&mut self, region: &Region<'_>, signed: &[f64], sign: f64, level: usize, defender: usize) {
        let n = region.corners.len();
        let corners = (0..n).flat_map(|i| {
            let j = (i + 1) % n;
            let (here, next) = (sign * signed[i], sign * signed[j]);
            let leaves = next < 0.0;
            // From a corner on the bisector straight out, the new side begins at that corner.
            let side = if here == 0.0 && leaves { Some(defender) } else { region.sides[i] };
            let corner = (here >= 0.0).then_some((region.corners[i], side));
            let cut = (here * next < 0.0).then(|| {
                let side = if leaves { Some(defender) } else { region.sides[i] };
                (crossing(region.corners, signed, i, j), side)
            });
            corner.into_iter().chain(cut)
        });
        self.push(level, corners);
    }

    fn iter(&self) -> impl Iterator<Item = Region<'_>> + '_ {
        let begins = std::iter::once(0).chain(self.spans.iter().map(|(_, end)| *end));
        begins.zip(&self.spans).map(|(begin, &(level, end))| Region {
            level,
            corners: &self.corners[begin..end],
            sides: &self.sides[begin..end],
        })
    }
}

/// The perpendicular bisector of q and a defender.
#[derive(Debug, Clone, Copy)]
struct Bisector {
    /// Unit vector towards the defender.
    normal: Vector,
    middle: Point,
}

/// On which side of a bisector a convex region lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Near,
    Far,
    Both,
}

impl Bisector {
    fn of(q: Point, f: Point) -> Option<Self> {
        let normal = (f - q).try_normalize(0.0)?;
        Some(Self { normal, middle: nalgebra::center(&q, &f) })
    }

    /// Writes the corners' signed distances, positive towards the defender and 0
    /// within `tolerance`, and says where the region lies.
    fn side_of(&self, corners: &[Point], tolerance: f64, signed: &mut Vec<f64>) -> Side {
        signed.clear();
        signed.extend(corners.iter().map(|p| {
            let d = self.normal.dot(&(p - self.middle));
            if d.abs() <= tolerance { 0.0 } else { d }
        }));
        match (signed.iter().any(|d| *d < 0.0), signed.iter().any(|d| *d > 0.0)) {
            (true, true) => Side::Both,
            (false, true) => Side::Far,
            (_, false) => Side::Near,
        }
    }
}

/// Where the side from corner `i` to `j` meets the bisector.
fn crossing(corners: &[Point], signed: &[f64], i: usize, j: usize) -> Point {
    corners[i] + (corners[j] - corners[i]) * (signed[i] / (signed[i] - signed[j]))
}

fn corners_of(pitch: &Aabb) -> [Point; 4] {
    let (lo, hi) = (pitch.min, pitch.max);
    [lo, Point::new(hi.x, lo.y), hi, Point::new(lo.x, hi.y)]
}

/// What counts as on a bisector: ε of a scene of the pitch's size, far above
/// rounding and far below anything on a pitch.
fn tolerance(pitch: &Aabb) -> f64 {
    1e-9 * pitch.diagonal()
}
