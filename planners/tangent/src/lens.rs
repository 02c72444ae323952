//! Which sites a path may touch next: those in a lens, as far as others leave them in sight.
//!
//! From a point p a site is worth a look when |p − c| − r + |c − goal| − r ≤ A,
//! A what the length limit leaves: centres in an ellipse about p and the goal,
//! narrow when the limit is near. It is swept from p on in strips across its
//! axis. Every piece swept *occludes* the headings between its two tangents for
//! what lies behind it, and the sweep ends where nothing ahead is in sight, so
//! among many obstacles its cost is that of a neighbourhood, however far the goal.
//!
//! Occlusion only leaves out tangents that are surely blocked: a ray whose
//! heading lies between the two tangents to a convex piece that is apart from its circle hits it on the near side,
//! between the points of contact. The way there from where it touches its circle is
//! √(|q − c|² − ρ²) for the point q that it hits: for a disc at most the longer of
//! the two tangents, for a capsule at most the distance of the farther end plus the radius.

use env_model::geometry::cross;
use env_model::{Point, Vector};

use crate::bitangent::{Bitangent, OrientedCircle};
use crate::cells::Strip;
use crate::terrain::{FIRST, Terrain};

/// Headings within a right angle of the axis are told apart this finely.
const BINS: usize = 256;

/// From which distance on headings are out of sight.
///
/// A heading's coordinate is t = tan(θ/2) of its angle θ from the axis, monotone and
/// without trigonometry; −1 < t < 1 is divided into equal bins. A piece hides the bins
/// that lie wholly between its tangents.
#[derive(Debug)]
struct Occlusion {
    axis: Vector,
    far: [f64; BINS],
}

impl Default for Occlusion {
    fn default() -> Self {
        Self { axis: Vector::x(), far: [f64::INFINITY; BINS] }
    }
}

impl Occlusion {
    fn reset(&mut self, axis: Vector) {
        self.axis = axis;
        self.far.fill(f64::INFINITY);
    }

    fn coordinate(&self, u: Vector) -> f64 {
        cross(self.axis, u) / (1.0 + self.axis.dot(&u)).max(1e-9)
    }

    /// Place of a coordinate among the bins; negative or beyond them for headings behind.
    fn place(t: f64) -> f64 {
        (t + 1.0) * (0.5 * BINS as f64)
    }

    /// Whether the ray with heading coordinate `t` is surely stopped before it has gone `length`.
    fn hides(&self, t: f64, length: f64) -> bool {
        let place = Self::place(t);
        place >= 0.0 && place < BINS as f64 && self.far[place as usize] <= length
    }

    /// Adds the headings from `low` to `high`, counter-clockwise, with coordinates `a` and `b`, but for those
    /// that enter a piece with tangents of at least `length` no deeper than `tolerance`.
    fn add(&mut self, [low, high]: [Vector; 2], [a, b]: [f64; 2], length: f64, far: f64, tolerance: f64) {
        // Turning by the angle δ moves a coordinate by δ(1 + t²)/2 ≤ δ.
        let margin = 2.0 * tolerance / length + 1e-12;
        let (a, b) = ((a + margin).max(-1.0), (b - margin).min(1.0));
        // A piece may straddle the direction opposite to the axis, or lie all round.
        if a < b && cross(low, high) > 0.0 {
            // One bin too few where the place is whole.
            let first = Self::place(a) as usize + 1;
            let last = Self::place(b) as usize;
            if first < last {
                for known in &mut self.far[first..last] {
                    // Not `min`: comparing compiles to vectors.
                    *known = if far < *known { far } else { *known };
                }
            }
        }
    }

    /// Whether all headings within the angle `half` of the axis are hidden from `beyond` on.
    fn hides_all(&self, half: f64, beyond: f64) -> bool {
        let edge = libm::tan(0.5 * half);
        let (first, last) = (Self::place(-edge), Self::place(edge));
        first >= 0.0
            && (last as usize) < BINS
            && self.far[first as usize..=last as usize].iter().all(|&far| far <= beyond)
    }
}

/// A way on: the tangent to a site's circle, in one of its senses.
pub(crate) struct Sight {
    /// The site.
    pub site: usize,
    /// Its circle in that sense.
    pub circle: OrientedCircle,
    /// The tangent.
    pub tangent: Bitangent,
}

/// What to sweep from.
pub(crate) struct Origin {
    /// The circle that rays leave.
    pub circle: OrientedCircle,
    /// Its site.
    pub site: usize,
    /// Where the path has come to.
    pub point: Point,
    /// A: how long the rest may be.
    pub room: f64,
}

/// A sweep's buffers.
#[derive(Debug, Default)]
pub(crate) struct Sweep {
    occlusion: Occlusion,
    /// Sites and the squares of their distances.
    strip: Vec<(f64, u32)>,
}

impl Sweep {
    /// Visits the tangents that the path may take next and no nearer piece hides.
    /// Returns whether there may be more with a longer rest.
    pub fn visit(&mut self, terrain: &Terrain, from: &Origin, mut visit: impl FnMut(Sight)) -> bool {
        let to_goal = terrain.goal() - from.point;
        let distance = to_goal.norm();
        let axis = if distance > 0.0 { to_goal / distance } else { Vector::x() };
        self.occlusion.reset(axis);
        // Rounding must not lose a site between two limits.
        let room = from.room + terrain.tolerance();
        if room >= 4.0 * terrain.span() {
            self.strip.clear();
            let mut more = false;
            for number in FIRST..terrain.len() {
                if terrain.site(number).via(from.point) > room {
                    more = true;
                } else {
                    self.strip.push(((terrain.site(number).centre - from.point).norm_squared(), number as u32));
                }
            }
            self.look(terrain, from, &mut visit);
            return more;
        }
        let largest = terrain.largest();
        // Centres: |p − c| + |c − goal| ≤ A + 2r.
        let major = 0.5 * (room + 2.0 * largest);
        let focus = 0.5 * distance;
        let minor2 = (major * major - focus * focus).max(0.0);
        // Radii tell how dense obstacles lie, unless they are tiny.
        let step = (4.0 * largest).max(major / 32.0);
        let (mut begin, last) = (focus - major, focus + major);
        let mut end = step;
        loop {
            // The widest place of the strip is the one nearest to the middle.
            let x = (focus.clamp(begin, end) - focus) / major;
            let half = (minor2 * (1.0 - x * x).max(0.0)).sqrt();
            self.collect(terrain, from, [begin, end.min(last), half], room);
            self.look(terrain, from, &mut visit);
            if end >= last || self.is_closed(end, from, largest, [major, focus, minor2]) {
                return true;
            }
            begin = end;
            end += step;
        }
    }

    /// Whether no centre in the ellipse at distance `end` or farther belongs to a site in sight.
    ///
    /// The ellipse is given by half the greatest sum of distances, half the distance between its foci and the
    /// square of half its width.
    fn is_closed(&self, end: f64, from: &Origin, largest: f64, [major, focus, minor2]: [f64; 3]) -> bool {
        let rho = from.circle.rho.abs();
        // Centres are at least so far from the circle's; tangents at least √(D² − (ρ + r)²) long.
        let centres = end - rho;
        let sum = rho + largest;
        if centres <= 2.0 * sum || focus == 0.0 {
            return false;
        }
        // Polar form of the ellipse about p: nothing ahead lies farther off the axis than this, as
        // seen from p; a ray off the circle to a circle there points elsewhere by asin((ρ + r)/D) at most, and
        // the circle's centre is off p by ρ.
        let cosine = (major - minor2 / end) / focus;
        if cosine <= 0.0 {
            return false;
        }
        let half = libm::acos(cosine.min(1.0)) + libm::asin(sum / centres) + libm::asin(rho / centres);
        self.occlusion.hides_all(half, (centres * centres - sum * sum).sqrt())
    }

    /// Collects the sites between two distances along the axis.
    fn collect(&mut self, terrain: &Terrain, from: &Origin, [begin, end, half]: [f64; 3], room: f64) {
        let Self { strip, occlusion } = self;
        let axis = occlusion.axis;
        strip.clear();
        let middle = from.point + axis * (0.5 * (begin + end));
        terrain.sites_in(&Strip { middle, axis, half: [0.5 * (end - begin), half] }, |number| {
            let site = terrain.site(number);
            let d = site.centre - from.point;
            let along = d.dot(&axis);
            if along >= begin && along < end && site.via(from.point) <= room {
                strip.push((d.norm_squared(), number as u32));
            }
        });
    }

    /// Looks at the collected sites, nearest first.
    fn look(&mut self, terrain: &Terrain, from: &Origin, visit: &mut impl FnMut(Sight)) {
        let Self { strip, occlusion } = self;
        let tolerance = terrain.tolerance();
        strip.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for &(_, number) in &*strip {
            let number = number as usize;
            if number == from.site {
                continue;
            }
            let site = terrain.site(number);
            let circles = [site.radius, -site.radius].map(|rho| OrientedCircle { centre: site.centre, rho });
            let tangents = circles.map(|circle| Bitangent::between(&from.circle, &circle, tolerance));
            let coordinates = tangents.map(|t| t.map_or(0.0, |t| occlusion.coordinate(t.heading)));
            for ((circle, tangent), &coordinate) in circles.into_iter().zip(tangents).zip(&coordinates) {
                let Some(tangent) = tangent else { continue };
                if terrain.is_corner(number) && !occlusion.hides(coordinate, tangent.length) {
                    visit(Sight { site: number, circle, tangent });
                }
            }
            let Some(ends) = terrain.ends(number) else { continue };
            // A disc that overlaps the circle has only one tangent.
            let [Some(left), Some(right)] = tangents else { continue };
            if ends[0] == ends[1] {
                // The ray hits the disc on the near side, between the points of contact.
                let (near, far) = (left.length.min(right.length), left.length.max(right.length));
                occlusion.add([left.heading, right.heading], coordinates, near, far, tolerance);
            } else if !ends.contains(&from.site) {
                occlude_by_capsule(occlusion, terrain, from, ends);
            }
        }
    }
}

/// Adds what the capsule between two sites hides.
fn occlude_by_capsule(occlusion: &mut Occlusion, terrain: &Terrain, from: &Origin, ends: [usize; 2]) {
    let tolerance = terrain.tolerance();
    let Some(piece) = terrain.piece(ends[0]) else { return };
    // One that runs through the circle may lie behind a ray between the tangents to its ends.
    if piece.core_distance(from.circle.centre) < from.circle.rho.abs() + piece.radius {
        return;
    }
    let tangents = ends.map(|end| {
        let site = terrain.site(end);
        let tangent = |rho| Bitangent::between(&from.circle, &OrientedCircle { centre: site.centre, rho }, 0.0);
        (tangent(site.radius), tangent(-site.radius), (site.centre - from.circle.centre).norm() + site.radius)
    });
    let [(Some(left), Some(right), far), (Some(other_left), Some(other_right), other_far)] = tangents else { return };
    let least = [left, right, other_left, other_right].iter().fold(f64::INFINITY, |l, t| l.min(t.length));
    let pick = |a: Vector, b: Vector, first: bool| if (cross(a, b) > 0.0) == first { a } else { b };
    let hull = [pick(left.heading, other_left.heading, true), pick(right.heading, other_right.heading, false)];
    let coordinates = hull.map(|u| occlusion.coordinate(u));
    occlusion.add(hull, coordinates, least, far.max(other_far), tolerance);
}
