//! Obstacles as the search sees them: circles to go round, and pieces that block.
//!
//! Every inflated shape is a union of *pieces*, the points nearer than r to a
//! segment: a disc is one whose segment has no length, a capsule is one, a
//! polygon is the ring of its sides (who cannot cross its rim never gets
//! inside). A taut path touches pieces on the circles of radius r round their
//! ends, the *sites*; an offset side is the common tangent of two sites.
//!
//! Around a corner only the arc within the normal cone lies on the outline: the
//! outward directions that make no acute angle with either side. A reflex
//! corner has none, and nothing ever goes round it.
//!
//! The border of the field bends no path, being convex as seen from inside. It
//! bounds arcs and tangents.
//!
//! Coordinates are relative to the start: that keeps scenes far from the origin accurate.

use env_model::geometry::{cross, point_segment_distance, segment_segment_distance, segments_nearer_than};
use env_model::probe::{Disc, Probe};
use env_model::{Aabb, Core, Inflated, Point, Polygon, Vector, World};

use crate::bitangent::perp;
use crate::cells::{Cells, Strip};

/// Site of the start, of radius 0.
pub(crate) const START: usize = 0;
/// Site of the goal, of radius 0.
pub(crate) const GOAL: usize = 1;
/// The first site of an obstacle.
pub(crate) const FIRST: usize = 2;
/// No piece begins at the site.
const NONE: u32 = u32::MAX;
/// After so many obstacles it is time to look at the clock.
const OBSTACLES_A_LOOK: usize = 1024;
/// Up to so many sites the search remembers which obstacles have been in its way.
const MODEST: usize = 512;
/// Up to so many sites are all looked at, without asking the broad phase at all.
const FEW: usize = 64;

/// A circle that paths may go round.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Site {
    /// Its centre.
    pub centre: Point,
    /// Its radius.
    pub radius: f64,
    /// Distance to the goal, less twice the radius.
    detour: f64,
    /// What segments must keep off; nothing unless the piece here is a disc.
    disc: Disc,
}

impl Site {
    /// Lower bound of a path from `p` that touches the circle on its way to the
    /// goal: |p − c| − r to the circle, |c − goal| − r from it.
    pub fn via(&self, p: Point) -> f64 {
        (p - self.centre).norm() + self.detour
    }
}

/// The outward directions in which a site lies on its obstacle's outline.
#[derive(Debug, Clone, Copy)]
struct Cone {
    /// Unit directions to the neighbours on the outline; zero for a disc.
    to: [Vector; 2],
    /// Cosine that rounding may reach; negative when there is no such direction.
    slack: f64,
}

impl Cone {
    const WHOLE: Self = Self { to: [Vector::new(0.0, 0.0); 2], slack: 0.0 };
}

/// The points nearer than `radius` to a segment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    /// One end.
    pub from: Point,
    /// The other; the same for a disc.
    pub to: Point,
    /// How near.
    pub radius: f64,
}

impl Piece {
    /// Whether it is a disc.
    pub fn is_disc(&self) -> bool {
        self.from == self.to
    }

    /// Distance of its segment from segment `a b`.
    pub fn segment_distance(&self, a: Point, b: Point) -> f64 {
        if self.is_disc() {
            point_segment_distance(self.from, a, b)
        } else {
            segment_segment_distance(a, b, self.from, self.to)
        }
    }

    /// Distance of its segment from `p`.
    pub fn core_distance(&self, p: Point) -> f64 {
        point_segment_distance(p, self.from, self.to)
    }
}

/// Which obstacles are worth a look. Boxes and segments are relative to the start.
pub(crate) trait BroadPhase {
    /// Whether `test` holds for an obstacle that the segment `a b` may enter.
    fn any_along(&self, a: Point, b: Point, test: impl FnMut(usize) -> bool) -> bool;
    /// Visits at least every obstacle that overlaps `region`.
    fn overlapping(&self, region: &Aabb, visit: impl FnMut(usize));
}

/// All of so many obstacles.
pub(crate) struct Everything(pub usize);

impl BroadPhase for Everything {
    fn any_along(&self, _: Point, _: Point, test: impl FnMut(usize) -> bool) -> bool {
        (0..self.0).any(test)
    }

    fn overlapping(&self, _: &Aabb, visit: impl FnMut(usize)) {
        (0..self.0).for_each(visit);
    }
}

/// The broad phase of a world.
pub(crate) struct Within<'a> {
    /// The world.
    pub world: &'a World,
    /// The start.
    pub origin: Vector,
}

impl BroadPhase for Within<'_> {
    fn any_along(&self, a: Point, b: Point, test: impl FnMut(usize) -> bool) -> bool {
        self.world.any_along(a + self.origin, b + self.origin, test)
    }

    fn overlapping(&self, region: &Aabb, visit: impl FnMut(usize)) {
        let region = Aabb { min: region.min + self.origin, max: region.max + self.origin };
        self.world.for_each_overlapping(&region, visit);
    }
}

/// The obstacles of one query.
#[derive(Debug, Default)]
pub(crate) struct Terrain {
    /// Start, goal, then those of the obstacles.
    sites: Vec<Site>,
    cones: Vec<Cone>,
    /// Where the piece that begins at a site ends.
    next: Vec<u32>,
    /// First site of every obstacle, and one past the last.
    first: Vec<u32>,
    /// The obstacle of every site after start and goal.
    owner: Vec<u32>,
    /// The sites by place; only among many.
    cells: Cells,
    /// Where the path may be.
    bounds: Option<Aabb>,
    /// How deep segments and arcs may enter.
    tolerance: f64,
    /// Whether every piece is a disc.
    only_discs: bool,
    /// The largest radius.
    largest: f64,
    /// All sites are within this distance of the start, radius included.
    span: f64,
}

impl Terrain {
    /// Forgets all obstacles.
    fn reset(&mut self, goal: Point, tolerance: f64) {
        let end = |centre: Point| Site { centre, radius: 0.0, detour: (goal - centre).norm(), disc: Disc::NONE };
        self.sites.clear();
        self.sites.extend([end(Point::origin()), end(goal)]);
        self.cones.clear();
        self.cones.extend([Cone::WHOLE; 2]);
        self.next.clear();
        self.next.extend([NONE; 2]);
        self.first.clear();
        self.owner.clear();
        self.bounds = None;
        self.tolerance = tolerance;
        self.only_discs = true;
        self.largest = 0.0;
        self.span = goal.coords.norm();
    }

    /// Takes discs (centre and radius) in the plane; those without positive radius are no obstacles.
    pub fn read_discs(&mut self, discs: &[(Point, f64)], start: Point, goal: Point, tolerance: f64) {
        self.reset(goal - start.coords, tolerance);
        for &(centre, radius) in discs {
            self.first.push(self.sites.len() as u32);
            if radius > 0.0 {
                self.add_disc(centre - start.coords, radius);
            }
        }
        self.first.push(self.sites.len() as u32);
        self.sort();
    }

    /// Takes a world's obstacles, shrunk by `shrink`, and its field, grown by as much.
    ///
    /// An obstacle, or the border, that start or goal enter deeper, as far as a
    /// problem's ends are granted, gives way until they lie on it.
    ///
    /// Ends with `false` as soon as `go_on` says no.
    pub fn read_world(
        &mut self,
        world: &World,
        [start, goal]: [Point; 2],
        shrink: f64,
        tolerance: f64,
        mut go_on: impl FnMut() -> bool,
    ) -> bool {
        self.reset(goal - start.coords, tolerance);
        for (number, obstacle) in world.obstacles().iter().enumerate() {
            if number % OBSTACLES_A_LOOK == OBSTACLES_A_LOOK - 1 && !go_on() {
                return false;
            }
            self.first.push(self.sites.len() as u32);
            match &obstacle.core {
                Core::Point(c) => self.add_shrunk_disc(c - start.coords, obstacle.radius - shrink),
                Core::Segment(a, b) if a == b => self.add_shrunk_disc(a - start.coords, obstacle.radius - shrink),
                Core::Segment(a, b) => {
                    let radius = obstacle.radius - shrink_for(obstacle, [start, goal], shrink);
                    if radius > 0.0 {
                        self.add_capsule(a - start.coords, b - start.coords, radius);
                    }
                }
                Core::Polygon(polygon) => {
                    let shrink = shrink_for(obstacle, [start, goal], shrink);
                    self.add_polygon(polygon, start.coords, obstacle.radius, shrink);
                }
            }
        }
        self.first.push(self.sites.len() as u32);
        self.bounds = world.inner_field().map(|field| {
            let outside = [start, goal].map(|p| -field.depth_of(p));
            let field = field.inflated(shrink.max(outside[0]).max(outside[1]));
            Aabb { min: field.min - start.coords, max: field.max - start.coords }
        });
        self.sort();
        true
    }

    fn sort(&mut self) {
        if !self.is_modest() {
            let Self { cells, sites, .. } = self;
            cells.fill(FIRST, sites[FIRST..].iter().map(|site| site.centre));
        }
    }

    /// Visits at least the sites with centres in `strip`; only among many.
    pub fn sites_in(&self, strip: &Strip, visit: impl FnMut(usize)) {
        self.cells.visit(strip, visit);
    }

    fn add_site(&mut self, centre: Point, radius: f64, cone: Cone, next: u32) {
        let detour = (self.sites[GOAL].centre - centre).norm() - 2.0 * radius;
        let is_disc = next as usize == self.sites.len();
        let disc = if is_disc { Disc::new(centre, radius - self.tolerance) } else { Disc::NONE };
        self.only_discs &= is_disc;
        self.sites.push(Site { centre, radius, detour, disc });
        self.cones.push(cone);
        self.next.push(next);
        self.owner.push(self.first.len() as u32 - 1);
        self.largest = self.largest.max(radius);
        self.span = self.span.max(centre.coords.norm() + radius);
    }

    fn add_disc(&mut self, centre: Point, radius: f64) {
        let itself = self.sites.len() as u32;
        self.add_site(centre, radius, Cone::WHOLE, itself);
    }

    fn add_shrunk_disc(&mut self, c: Point, r: f64) {
        let end2 = c.coords.norm_squared().min((c - self.sites[GOAL].centre).norm_squared());
        let r = if r > 0.0 && end2 < r * r { end2.sqrt() } else { r };
        if r > 0.0 {
            self.add_disc(c, r);
        }
    }

    fn add_capsule(&mut self, a: Point, b: Point, radius: f64) {
        let itself = self.sites.len() as u32;
        let along = (b - a).normalize();
        let slack = self.cone_slack(radius);
        self.add_site(a, radius, Cone { to: [along; 2], slack }, itself + 1);
        self.add_site(b, radius, Cone { to: [-along; 2], slack }, NONE);
    }

    /// Cosine whose direction enters the neighbouring piece by the tolerance:
    /// r(1 − √(1 − s²)) ≈ r s²/2. Rounding of directions on top.
    fn cone_slack(&self, radius: f64) -> f64 {
        (2.0 * self.tolerance / radius).sqrt().min(0.5) + 1e-9
    }

    /// A polygon whose clearance is counted from `radius`, less `shrink`.
    ///
    /// Where less than `shrink` would remain of the radius, the polygon itself
    /// gives way, so that there are always circles to go round: its sides move
    /// inward by e, and circles of radius ρ = radius − shrink + e stand on the
    /// new corners. That set lies within the one asked for, and short of it by
    /// no more than a few times `shrink` at the tip of a corner.
    fn add_polygon(&mut self, polygon: &Polygon, origin: Vector, radius: f64, shrink: f64) {
        let rho = (radius - shrink).max(0.008 * shrink);
        let e = rho - (radius - shrink);
        let corners = polygon.corners();
        let n = corners.len();
        let begin = self.sites.len();
        let unit = |i: usize| (corners[(i + 1) % n] - corners[i % n]).normalize();
        let slack = self.cone_slack(rho);
        let mut before = unit(n - 1);
        for (i, corner) in corners.iter().enumerate() {
            let after = unit(i);
            // Half a side at most, so that a needle does not turn inside out.
            let sides = (corner - corners[(i + n - 1) % n]).norm().min((corners[(i + 1) % n] - corner).norm());
            let mitre = perp(before + after) * (e / (1.0 + before.dot(&after)).max(f64::MIN_POSITIVE));
            let mitre = if mitre.norm() > 0.5 * sides { mitre.normalize() * (0.5 * sides) } else { mitre };
            let convex = cross(before, after) > 0.0;
            let cone = Cone { to: [-before, after], slack: if convex { slack } else { -1.0 } };
            self.add_site(corner - origin + mitre, rho, cone, (begin + (i + 1) % n) as u32);
            before = after;
        }
        // Where the polygon is so thin that no corner is as deep inside as its sides have moved, nothing of it is left.
        let deep = |site: &Site| polygon.signed_distance(site.centre + origin) <= -0.99 * e;
        if e > 0.0 && !self.sites[begin..].iter().any(deep) {
            self.sites.truncate(begin);
            self.cones.truncate(begin);
            self.next.truncate(begin);
            self.owner.truncate(begin - FIRST);
        }
    }

    /// The number of sites, start and goal among them.
    pub fn len(&self) -> usize {
        self.sites.len()
    }

    /// The site of that number.
    pub fn site(&self, site: usize) -> &Site {
        &self.sites[site]
    }

    /// Where the path ends.
    pub fn goal(&self) -> Point {
        self.sites[GOAL].centre
    }

    /// Whether there are so few sites that it is quicker to know those that matter than to look for them.
    pub fn is_modest(&self) -> bool {
        self.sites.len() <= MODEST
    }

    /// Whether all sites are to be looked at without a broad phase.
    pub fn is_small(&self) -> bool {
        self.sites.len() <= FEW
    }

    /// Where the path may be, if it is bounded.
    pub fn bounds(&self) -> Option<&Aabb> {
        self.bounds.as_ref()
    }

    /// How deep segments and arcs may enter obstacles.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The largest radius of a site.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// A distance from the start within which all sites lie.
    pub fn span(&self) -> f64 {
        self.span
    }

    /// How many obstacles there are.
    pub fn obstacles(&self) -> usize {
        self.first.len() - 1
    }

    /// The obstacle of a site.
    pub fn owner(&self, site: usize) -> usize {
        self.owner[site - FIRST] as usize
    }

    /// The obstacle's sites.
    pub fn sites_of(&self, obstacle: usize) -> std::ops::Range<usize> {
        self.first[obstacle] as usize..self.first[obstacle + 1] as usize
    }

    /// The piece that begins at a site.
    pub fn piece(&self, site: usize) -> Option<Piece> {
        let end = *self.next.get(site).filter(|&&end| end != NONE)?;
        let Site { centre, radius, .. } = self.sites[site];
        Some(Piece { from: centre, to: self.sites[end as usize].centre, radius })
    }

    /// The sites at the ends of the piece that begins at `site`, if one does.
    pub fn ends(&self, site: usize) -> Option<[usize; 2]> {
        let end = self.next[site];
        (end != NONE).then_some([site, end as usize])
    }

    /// Whether the outline of its obstacle has a part on the site's circle.
    pub fn is_corner(&self, site: usize) -> bool {
        self.cones[site].slack >= 0.0
    }

    /// Whether the site's circle is on the outline in unit direction `outward`.
    pub fn on_outline(&self, site: usize, outward: Vector) -> bool {
        let Cone { to, slack } = self.cones[site];
        to[0].dot(&outward) <= slack && to[1].dot(&outward) <= slack
    }

    /// Visits the pieces, by their first site, that may overlap `region`.
    pub fn pieces_near<B: BroadPhase>(&self, near: &B, region: &Aabb, mut visit: impl FnMut(usize)) {
        if self.is_small() {
            let (centre, half) = (region.centre(), 0.5 * region.size());
            for (number, site) in self.sites.iter().enumerate().skip(FIRST) {
                let d = site.centre - centre;
                let (x, y) = (half.x + site.radius, half.y + site.radius);
                let apart = (d.x.abs() > x) | (d.y.abs() > y);
                if self.next[number] != NONE && !(apart && self.next[number] as usize == number) {
                    visit(number);
                }
            }
        } else {
            near.overlapping(region, |o| self.sites_of(o).filter(|&s| self.next[s] != NONE).for_each(&mut visit));
        }
    }

    /// Whether segment `a b` leaves the bounds by more than the tolerance. They are convex: the ends decide.
    fn leaves(&self, a: Point, b: Point) -> bool {
        let outside = |p| self.bounds.is_some_and(|bounds| bounds.depth_of(p) < -self.tolerance);
        outside(a) || outside(b)
    }

    /// Whether segment `a b` enters the piece that begins at site `number` by more than the tolerance.
    fn enters(&self, probe: &Probe, [a, b]: [Point; 2], number: usize) -> bool {
        let site = &self.sites[number];
        if probe.enters(&site.disc) {
            return true;
        }
        let (end, limit) = (self.next[number], site.radius - self.tolerance);
        !self.only_discs
            && end != NONE
            && end as usize != number
            && limit > 0.0
            && segments_nearer_than(limit, a, b, site.centre, self.sites[end as usize].centre)
    }

    /// Adds an obstacle's pieces to `walls`.
    pub fn copy_walls(&self, obstacle: usize, walls: &mut Walls) {
        for number in self.sites_of(obstacle) {
            let Site { centre, disc, radius, .. } = self.sites[number];
            match self.next[number] {
                NONE => {}
                end if end as usize == number => walls.discs.push(disc),
                end => walls.capsules.push((centre, self.sites[end as usize].centre, radius - self.tolerance)),
            }
        }
    }

    /// Whether segment `a b` enters one of `walls`, or leaves the bounds, by more than the tolerance.
    pub fn blocked_by(&self, walls: &Walls, a: Point, b: Point) -> bool {
        let probe = Probe::new(a, b);
        // In eights without a branch: most are missed.
        let fold = |discs: &[Disc]| discs.iter().fold(false, |hit, disc| hit | probe.enters(disc));
        self.leaves(a, b)
            || walls.discs.chunks(8).any(fold)
            || walls.capsules.iter().any(|&(c, d, limit)| limit > 0.0 && segments_nearer_than(limit, a, b, c, d))
    }

    /// Whether segment `a b` enters an obstacle, or leaves the bounds, by more than the tolerance.
    pub fn blocks<B: BroadPhase>(&self, near: &B, a: Point, b: Point) -> bool {
        let probe = Probe::new(a, b);
        self.leaves(a, b)
            || near.any_along(a, b, |o| self.sites_of(o).any(|number| self.enters(&probe, [a, b], number)))
    }

    /// The obstacle that segment `a b` enters deepest, by more than the tolerance; the lower number wins a tie.
    pub fn deepest<B: BroadPhase>(&self, near: &B, a: Point, b: Point) -> Option<usize> {
        let probe = Probe::new(a, b);
        let mut worst: Option<(f64, usize)> = None;
        let mut look = |number: usize| {
            if self.enters(&probe, [a, b], number)
                && let Some(piece) = self.piece(number)
            {
                let obstacle = self.owner(number);
                let depth = piece.radius - piece.segment_distance(a, b);
                if worst.is_none_or(|(d, o)| depth > d || (depth == d && obstacle < o)) {
                    worst = Some((depth, obstacle));
                }
            }
        };
        if self.is_small() {
            (FIRST..self.len()).for_each(look);
        } else {
            near.any_along(a, b, |obstacle| {
                self.sites_of(obstacle).for_each(&mut look);
                false
            });
        }
        worst.map(|(_, obstacle)| obstacle)
    }
}

/// Pieces that segments are tested against first.
#[derive(Debug, Default)]
pub(crate) struct Walls {
    discs: Vec<Disc>,
    /// Ends, and how near segments may come.
    capsules: Vec<(Point, Point, f64)>,
}

impl Walls {
    /// Forgets all.
    pub fn clear(&mut self) {
        self.discs.clear();
        self.capsules.clear();
    }
}

/// `shrink`, or more where an end lies deeper inside.
fn shrink_for(obstacle: &Inflated, ends: [Point; 2], shrink: f64) -> f64 {
    ends.into_iter().fold(shrink, |s, end| s.max(-obstacle.point_clearance(end)))
}
