//! The discs that the search has met so far, as oriented circles.

use std::f64::consts::TAU;

use env_model::geometry::point_segment_distance_squared;
use env_model::{Point, Vector};

use crate::bitangent::{NO_TURN, OrientedCircle, perp};
use crate::discs::Discs;

/// Circle of the start, of radius 0.
pub(crate) const START: usize = 0;
/// Circle of the goal, of radius 0.
pub(crate) const GOAL: usize = 1;
/// The first circle of a disc. Disc number m of the subset, counted from 0, has
/// circles 2m + 2 (counter-clockwise) and 2m + 3.
const FIRST: usize = 2;

/// What is known of an obstacle in the query of the same epoch.
#[derive(Debug, Clone, Copy, Default)]
struct Mark {
    epoch: u32,
    role: Role,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
enum Role {
    /// Not looked at yet.
    #[default]
    Unknown,
    /// Inside another disc: it can be left out.
    Redundant,
    /// In the subset.
    Member,
}

/// The part of a circle that another disc covers.
#[derive(Debug, Clone, Copy)]
struct Cover {
    /// Direction of its middle from the centre, radians.
    middle: f64,
    /// Half its angle.
    half: f64,
    /// The disc that covers it.
    by: usize,
}

/// How far one can go along a circle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    /// Angle in [0, 2π], in the circle's sense.
    pub angle: f64,
    /// The disc that ends it.
    pub blocker: Option<usize>,
}

/// A growing subset of the discs.
#[derive(Debug, Default)]
pub(crate) struct Subset {
    /// Start, goal, then two for each member.
    pub circles: Vec<OrientedCircle>,
    /// Members' obstacle indices.
    members: Vec<usize>,
    /// Members' centres and (radius − tolerance)².
    limits: Vec<(f64, f64, f64)>,
    /// Members' distances to the goal, less twice the radius.
    detours: Vec<f64>,
    /// For every circle, the member that blocked the last tangent from it.
    suspects: Vec<usize>,
    /// Ends of the members' ranges in `covers`.
    cover_ends: Vec<usize>,
    covers: Vec<Cover>,
    marks: Vec<Mark>,
    epoch: u32,
    tolerance: f64,
}

impl Subset {
    /// Forgets all members. Segments and arcs may enter discs by `tolerance`.
    pub fn reset(&mut self, obstacles: usize, start: Point, goal: Point, tolerance: f64) {
        self.circles.clear();
        self.circles.extend([start, goal].map(|centre| OrientedCircle { centre, rho: 0.0 }));
        self.members.clear();
        self.limits.clear();
        self.detours.clear();
        self.suspects.clear();
        self.suspects.resize(FIRST, 0);
        self.cover_ends.clear();
        self.covers.clear();
        if self.marks.len() < obstacles {
            self.marks.resize(obstacles, Mark::default());
        }
        // A stale mark of 2³² queries ago must not come alive.
        if self.epoch == u32::MAX {
            self.marks.fill(Mark::default());
            self.epoch = 0;
        }
        self.epoch += 1;
        self.tolerance = tolerance;
    }

    /// The obstacle whose circle it is; `None` for start and goal.
    pub fn obstacle_of(&self, circle: usize) -> Option<usize> {
        Some(self.members[circle.checked_sub(FIRST)? / 2])
    }

    /// How many discs have joined.
    pub fn len(&self) -> usize {
        self.members.len()
    }

    /// The two circles of member `m`.
    pub fn circles_of(m: usize) -> [usize; 2] {
        [FIRST + 2 * m, FIRST + 2 * m + 1]
    }

    /// Lower bound of a path from `p` that touches member `m` on its way to the
    /// goal: |p − c| − r to the disc, |c − goal| − r from it.
    pub fn via(&self, m: usize, p: Point) -> f64 {
        let (x, y, _) = self.limits[m];
        let (dx, dy) = (x - p.x, y - p.y);
        (dx * dx + dy * dy).sqrt() + self.detours[m]
    }

    /// Whether the obstacle has joined.
    pub fn contains(&self, obstacle: usize) -> bool {
        self.role(obstacle) == Role::Member
    }

    fn role(&self, obstacle: usize) -> Role {
        let mark = self.marks[obstacle];
        if mark.epoch == self.epoch { mark.role } else { Role::Unknown }
    }

    fn set_role(&mut self, obstacle: usize, role: Role) {
        self.marks[obstacle] = Mark { epoch: self.epoch, role };
    }

    /// Whether the segment `a b` between two circles enters a member by more
    /// than the tolerance. Much cheaper than asking the world.
    pub fn blocks(&mut self, a: Point, b: Point, from: usize, to: usize) -> bool {
        let d = b - a;
        let len2 = d.norm_squared();
        let enters = |&(x, y, limit2): &(f64, f64, f64)| {
            let (vx, vy) = (x - a.x, y - a.y);
            let (along, across) = (vx * d.x + vy * d.y, vx * d.y - vy * d.x);
            let (wx, wy) = (vx - d.x, vy - d.y);
            // No short circuit: the loop over members is to stay free of branches.
            ((along > 0.0) & (along < len2) & (across * across < limit2 * len2))
                | (vx * vx + vy * vy < limit2)
                | (wx * wx + wy * wy < limit2)
        };
        let ends = [from, to].map(|circle| circle.checked_sub(FIRST).map_or(usize::MAX, |i| i / 2));
        let suspect = self.suspects[from];
        if !ends.contains(&suspect) && self.limits.get(suspect).is_some_and(enters) {
            return true;
        }
        let found = (0..self.limits.len()).find(|m| enters(&self.limits[*m]) && !ends.contains(m));
        if let Some(member) = found {
            self.suspects[from] = member;
        }
        found.is_some()
    }

    /// The obstacle that the segment `a b` enters deepest, by more than the
    /// tolerance; `except` are not asked. The lower index wins a tie.
    pub fn deepest<D: Discs>(&mut self, discs: &D, a: Point, b: Point, except: [Option<usize>; 2]) -> Option<usize> {
        loop {
            let mut worst: Option<(f64, usize)> = None;
            discs.along(a, b, |i| {
                if except.contains(&Some(i)) {
                    return;
                }
                let Some((c, r)) = discs.disc(i) else { return };
                let d2 = point_segment_distance_squared(c, a, b);
                let limit = r - self.tolerance;
                if limit <= 0.0 || d2 >= limit * limit || self.role(i) == Role::Redundant {
                    return;
                }
                let depth = r - d2.sqrt();
                if worst.is_none_or(|(d, j)| depth > d || (depth == d && i < j)) {
                    worst = Some((depth, i));
                }
            });
            let (_, i) = worst?;
            if self.contains(i) || self.container(discs, i).is_none() {
                return Some(i);
            }
            self.set_role(i, Role::Redundant);
        }
    }

    /// The greatest disc that contains obstacle `i` up to the tolerance. Of equal discs the first counts as greater.
    fn container<D: Discs>(&self, discs: &D, i: usize) -> Option<usize> {
        let (c, r) = discs.disc(i)?;
        let greater = |(r, i): (f64, usize), (s, j): (f64, usize)| r > s || (r == s && i < j);
        let mut best: Option<(f64, usize)> = None;
        discs.around(c, r, |j| {
            if let Some((cj, rj)) = discs.disc(j)
                && greater((rj, j), (r, i))
                && (cj - c).norm() + r <= rj + self.tolerance
                && best.is_none_or(|b| greater((rj, j), b))
            {
                best = Some((rj, j));
            }
        });
        best.map(|(_, j)| j)
    }

    /// The disc to keep in place of `i`: itself, unless another contains it.
    pub fn representative<D: Discs>(&self, discs: &D, mut i: usize) -> usize {
        // Ends, because every step goes to a greater disc.
        while !self.contains(i)
            && let Some(j) = self.container(discs, i)
        {
            i = j;
        }
        i
    }

    /// Adds obstacle `i`, which must be a disc, and cuts its circle by the discs that overlap it.
    pub fn add<D: Discs>(&mut self, discs: &D, i: usize) {
        let Some((centre, r)) = discs.disc(i) else { return };
        self.set_role(i, Role::Member);
        self.members.push(i);
        let limit = (r - self.tolerance).max(0.0);
        self.limits.push((centre.x, centre.y, limit * limit));
        self.detours.push((self.circles[GOAL].centre - centre).norm() - 2.0 * r);
        self.suspects.extend([0; 2]);
        self.circles.extend([r, -r].map(|rho| OrientedCircle { centre, rho }));
        let tolerance = self.tolerance;
        discs.around(centre, r, |j| {
            let Some((c, rj)) = discs.disc(j) else { return };
            let (d, rj) = (c - centre, rj - tolerance);
            let d2 = d.norm_squared();
            let distance = d2.sqrt();
            if j == i || rj <= 0.0 || distance >= r + rj || distance + rj <= r {
                return;
            }
            // Law of cosines. Below −1 the disc is contained, which `deepest` rules out.
            let cosine = ((r * r - rj * rj + d2) / (2.0 * r * distance)).clamp(-1.0, 1.0);
            self.covers.push(Cover { middle: libm::atan2(d.y, d.x), half: libm::acos(cosine), by: j });
        });
        self.cover_ends.push(self.covers.len());
    }

    /// How far a path that arrives on `circle` with heading `u` can follow it.
    pub fn reach(&self, circle: usize, u: Vector) -> Reach {
        let mut reach = Reach { angle: TAU, blocker: None };
        let Some(member) = circle.checked_sub(FIRST).map(|i| i / 2) else { return reach };
        let begin = if member == 0 { 0 } else { self.cover_ends[member - 1] };
        let covers = &self.covers[begin..self.cover_ends[member]];
        if covers.is_empty() {
            return reach;
        }
        let sense = self.circles[circle].rho.signum();
        let out = perp(u) * -sense;
        let at = libm::atan2(out.y, out.x);
        for cover in covers {
            let to_middle = (cover.middle - at) * sense;
            let to_middle = if to_middle < 0.0 { to_middle + TAU } else { to_middle };
            let to_middle = if to_middle >= TAU { to_middle - TAU } else { to_middle };
            // Negative: just past the border, by rounding.
            let angle = (to_middle - cover.half).max(0.0) + NO_TURN;
            if angle < reach.angle || (angle == reach.angle && reach.blocker.is_some_and(|b| cover.by < b)) {
                reach = Reach { angle, blocker: Some(cover.by) };
            }
        }
        reach
    }
}
