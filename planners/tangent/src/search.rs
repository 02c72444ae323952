//! A* over arrivals on oriented circles, the graph discovered on the way.

use std::collections::BinaryHeap;

use env_model::{Aabb, Point, Vector, World};

use crate::bitangent::{Bitangent, OrientedCircle, perp};
use crate::candidate::{Candidate, Way};
use crate::covers::{Covers, Reach};
use crate::lens::{Origin, Sight, Sweep};
use crate::route::Route;
use crate::separation::Separation;
use crate::terrain::{BroadPhase, Everything, GOAL, START, Terrain, Walls, Within};

/// After so many arrivals, when the way is longer than hoped, it pays to ask whether start and goal are separated at all.
const ASK_SEPARATION: usize = 256;

/// Paths are first looked for this much longer, relatively, than the straight line.
const HEADROOM: f64 = 2e-2;
/// By this factor the limit's excess over the straight line grows when it has proved too low.
const GROWTH: f64 = 2.0;

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// The shortest path and its exact length, in scene units.
    Found {
        /// Its length.
        length: f64,
    },
    /// There is none: obstacles separate start from goal, or hold one of them.
    Infeasible,
    /// The caller stopped the search.
    Stopped,
}

/// What the caller may say and see while the search runs.
pub(crate) trait Watch {
    /// Whether to go on; asked at every step.
    fn allows(&mut self) -> bool {
        true
    }
    /// Whether there is time to go on with what is no step of the search.
    fn in_time(&mut self) -> bool {
        true
    }
    /// An arrival was expanded.
    fn expanded(&mut self) {}
    /// A tangent was tested against the obstacles.
    fn tested(&mut self) {}
    /// No path is as short as the limit, which is about to rise. `write` writes
    /// the tree of arrivals: points and their parents.
    fn raised(&mut self, _write: impl FnOnce(&mut Vec<Point>, &mut Vec<u32>)) {}
}

impl Watch for () {}

/// A path has come to `circle`, touching it with unit `heading`.
#[derive(Debug, Clone, Copy)]
struct Arrival {
    circle: u32,
    /// The arrival before; its own index for the start.
    parent: u32,
    /// The arrival on the same circle that was found before this one, plus one; 0 if none.
    older: u32,
    heading: Vector,
    /// Length so far.
    cost: f64,
    /// Where it touches the circle.
    point: Point,
    /// How far it can follow the circle, radians.
    reach: f64,
    /// Candidates up to this bound have been offered.
    offered: f64,
    /// Whether the open set holds [`Way::Farther`] for it.
    pending: bool,
}

/// An exact shortest-path solver. Keeps its buffers: a second query of the same size allocates nothing.
#[derive(Debug, Default)]
pub struct Solver {
    terrain: Terrain,
    covers: Covers,
    sweep: Sweep,
    /// Among few obstacles: the sites of those that have been in the way.
    members: Vec<u32>,
    /// The pieces of those obstacles.
    walls: Walls,
    /// Whether an obstacle is one of them.
    joined: Vec<bool>,
    arrivals: Vec<Arrival>,
    /// The latest arrival on every circle, plus one; 0 if none.
    latest: Vec<u32>,
    open: BinaryHeap<Candidate>,
    /// No path longer than this is looked at yet.
    limit: f64,
    /// Whether the limit has been raised.
    raised: bool,
    separation: Separation,
    route: Route,
    found: bool,
    /// Start and goal as given; everything else is relative to the start.
    ends: [Point; 2],
}

/// Number of a site's circle that is passed clockwise or not.
fn circle(site: usize, clockwise: bool) -> usize {
    2 * site + usize::from(clockwise)
}

/// Candidates from one arrival.
struct Offers<'a> {
    terrain: &'a Terrain,
    open: &'a mut BinaryHeap<Candidate>,
    from: u32,
    arrival: Arrival,
    leaving: OrientedCircle,
    /// Bounds above the first and up to the second are wanted.
    bounds: [f64; 2],
    /// Whether one had a greater bound.
    longer: bool,
}

impl<'a> Offers<'a> {
    fn new(
        terrain: &'a Terrain,
        open: &'a mut BinaryHeap<Candidate>,
        from: u32,
        arrival: &Arrival,
        bounds: [f64; 2],
    ) -> Self {
        let leaving = oriented(terrain, arrival.circle as usize);
        Self { terrain, open, from, arrival: *arrival, leaving, bounds, longer: false }
    }

    fn origin(&self) -> Origin {
        let Arrival { circle, point, cost, .. } = self.arrival;
        Origin { circle: self.leaving, site: circle as usize / 2, point, room: self.bounds[1] - cost }
    }

    /// Offers both tangents to a site.
    fn add_site(&mut self, number: usize) {
        let site = self.terrain.site(number);
        if number == self.arrival.circle as usize / 2 {
            return;
        }
        // Rounding must not lose a site between two limits.
        if self.arrival.cost + site.via(self.arrival.point) > self.bounds[1] + self.terrain.tolerance() {
            self.longer = true;
            return;
        }
        for rho in [site.radius, -site.radius] {
            let circle = OrientedCircle { centre: site.centre, rho };
            if let Some(tangent) = Bitangent::between(&self.leaving, &circle, self.terrain.tolerance()) {
                self.add(&Sight { site: number, circle, tangent });
            }
        }
    }

    /// Offers a tangent.
    fn add(&mut self, Sight { site, circle: target, tangent }: &Sight) {
        let Arrival { heading, reach, cost, .. } = self.arrival;
        let turn = self.leaving.turn_at_least(heading, tangent.heading);
        if turn > reach {
            return;
        }
        let touch = target.touch(tangent.heading);
        let bound = cost + turn * self.leaving.rho.abs() + tangent.length + (self.terrain.goal() - touch).norm();
        let outward = perp(tangent.heading) * -target.rho.signum();
        if bound > self.bounds[1] {
            self.longer = true;
        } else if bound > self.bounds[0] && self.terrain.on_outline(*site, outward) {
            let to = circle(*site, target.rho < 0.0) as u32;
            self.open.push(Candidate { bound, from: self.from, way: Way::Tangent(to) });
        }
    }
}

/// The circle of that number.
fn oriented(terrain: &Terrain, circle: usize) -> OrientedCircle {
    let site = terrain.site(circle / 2);
    OrientedCircle { centre: site.centre, rho: if circle % 2 == 1 { -site.radius } else { site.radius } }
}

impl Solver {
    /// A solver without buffers yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The length of the shortest path from `start` to `goal` among open `discs`
    /// (centre and radius; overlapping, nested, equal and touching ones too),
    /// in the units of its input. Discs without positive radius are ignored.
    ///
    /// Coordinates must be finite. The path may enter discs by 1e-12 of the
    /// diagonal of the box round everything, which decides how exact contacts
    /// are read: touching discs let it through. Tests every tangent against all
    /// discs; among thousands use [`optimum`](crate::optimum), which has a broad phase.
    pub fn shortest(&mut self, discs: &[(Point, f64)], start: Point, goal: Point) -> Outcome {
        let bounds = discs.iter().fold(Aabb::of_points([&start, &goal]), |b, &(c, r)| {
            if r > 0.0 { b.union(Aabb { min: c, max: c }.inflated(r)) } else { b }
        });
        self.ends = [start, goal];
        self.terrain.read_discs(discs, start, goal, 1e-12 * bounds.diagonal());
        self.search(&Everything(discs.len()), &mut ())
    }

    /// The same among the obstacles of `world`, less `shrink`, within its field.
    /// The path may enter what is left by `tolerance`.
    pub(crate) fn shortest_in<W: Watch>(
        &mut self,
        world: &World,
        [start, goal]: [Point; 2],
        shrink: f64,
        tolerance: f64,
        watch: &mut W,
    ) -> Outcome {
        self.ends = [start, goal];
        if !self.terrain.read_world(world, [start, goal], shrink, tolerance, || watch.in_time()) {
            self.found = false;
            return Outcome::Stopped;
        }
        self.search(&Within { world, origin: start.coords }, watch)
    }

    /// Writes the path found last as a polyline whose segments touch the arcs
    /// from outside: it enters no obstacle, and is longer than the exact path by
    /// at most the fraction `max_relative_excess`, > 0. Empty unless a path was found.
    pub fn write_polyline(&self, max_relative_excess: f64, out: &mut Vec<Point>) {
        out.clear();
        if !self.found {
            return;
        }
        let [start, goal] = self.ends;
        out.push(start);
        self.route.write(&self.terrain, max_relative_excess, |p| out.push(p + start.coords));
        out.push(goal);
        out.dedup();
    }

    /// A* on the terrain.
    fn search<B: BroadPhase, W: Watch>(&mut self, near: &B, watch: &mut W) -> Outcome {
        self.route.clear();
        self.found = false;
        let goal = self.terrain.goal();
        for end in [Point::origin(), goal] {
            if self.terrain.blocks(near, end, end) {
                return Outcome::Infeasible;
            }
        }
        if goal == Point::origin() {
            self.found = true;
            return Outcome::Found { length: 0.0 };
        }
        let outcome = self.search_tree(near, watch);
        if matches!(outcome, Outcome::Found { .. }) {
            self.route.note_near(&self.terrain, near);
            self.found = true;
        }
        outcome
    }

    fn search_tree<B: BroadPhase, W: Watch>(&mut self, near: &B, watch: &mut W) -> Outcome {
        let goal = self.terrain.goal();
        self.covers.reset(self.terrain.len());
        self.latest.clear();
        self.latest.resize(2 * self.terrain.len(), 0);
        self.arrivals.clear();
        self.open.clear();
        self.limit = goal.coords.norm() * (1.0 + HEADROOM);
        self.raised = false;
        self.members.clear();
        self.walls.clear();
        self.joined.clear();
        self.joined.resize(self.terrain.obstacles(), false);
        let mut asked = false;
        if !watch.allows() {
            return Outcome::Stopped;
        }
        self.arrive(near, circle(START, false), 0, Vector::zeros(), 0.0, watch);
        while let Some(Candidate { bound, from, way }) = self.open.pop() {
            if !watch.allows() {
                return Outcome::Stopped;
            }
            let (to, measured) = match way {
                Way::Tangent(to) => (to as usize, false),
                Way::Measured(to) => (to as usize, true),
                Way::Farther => {
                    if bound >= self.limit {
                        self.raise(bound, watch);
                    }
                    self.arrivals[from as usize].pending = false;
                    self.offer_all(from);
                    continue;
                }
            };
            let Some((tangent, cost)) = self.depart(from, to, OrientedCircle::turn) else { continue };
            let b = self.circle(to).touch(tangent.heading);
            let exact = cost + (goal - b).norm();
            if !measured && self.open.peek().is_some_and(|next| next.bound < exact) {
                self.open.push(Candidate { bound: exact, from, way: Way::Measured(to as u32) });
                continue;
            }
            if self.dominated(to, tangent.heading, cost) {
                continue;
            }
            watch.tested();
            let a = self.circle(self.arrivals[from as usize].circle as usize).touch(tangent.heading);
            if self.is_blocked(near, a, b) {
                continue;
            }
            if to == circle(GOAL, false) {
                self.trace(from, tangent.heading, cost);
                return Outcome::Found { length: cost };
            }
            if !asked && self.raised && self.arrivals.len() >= ASK_SEPARATION {
                asked = true;
                match self.separation.separated(&self.terrain, near, || watch.allows()) {
                    None => return Outcome::Stopped,
                    Some(true) => return Outcome::Infeasible,
                    Some(false) => {}
                }
            }
            self.arrive(near, to, from, tangent.heading, cost, watch);
        }
        Outcome::Infeasible
    }

    /// Lets the search look at paths longer than `bound`.
    fn raise<W: Watch>(&mut self, bound: f64, watch: &mut W) {
        let straight = self.terrain.goal().coords.norm();
        self.limit = straight + GROWTH * (bound - straight);
        self.raised = true;
        watch.raised(|points, parents| self.write_tree(points, parents));
    }

    /// Appends the tree of the last search: two points an arrival, where its path leaves the
    /// circle before and where it arrives, and their parents' indices. The start is one point.
    pub(crate) fn write_tree(&self, points: &mut Vec<Point>, parents: &mut Vec<u32>) {
        let origin = self.ends[0].coords;
        points.push(self.ends[0]);
        parents.push(0);
        for (i, arrival) in self.arrivals.iter().enumerate().skip(1) {
            let before = self.circle(self.arrivals[arrival.parent as usize].circle as usize);
            points.extend([before.touch(arrival.heading) + origin, arrival.point + origin]);
            parents.extend([2 * arrival.parent, 2 * i as u32 - 1]);
        }
    }

    fn circle(&self, circle: usize) -> OrientedCircle {
        oriented(&self.terrain, circle)
    }

    /// Records an arrival and offers the ways on.
    fn arrive<B: BroadPhase, W: Watch>(
        &mut self,
        near: &B,
        to: usize,
        parent: u32,
        heading: Vector,
        cost: f64,
        watch: &mut W,
    ) {
        watch.expanded();
        let shape = self.circle(to);
        let reach = if shape.rho == 0.0 {
            Reach::WHOLE
        } else {
            self.covers.reach(&self.terrain, near, to / 2, shape.rho.signum(), heading)
        };
        let index = self.arrivals.len() as u32;
        let older = std::mem::replace(&mut self.latest[to], index + 1);
        let point = shape.touch(heading);
        let arrival = Arrival {
            circle: to as u32,
            parent,
            older,
            heading,
            cost,
            point,
            reach: reach.angle,
            offered: 0.0,
            pending: false,
        };
        self.arrivals.push(arrival);
        let straight_on = circle(GOAL, false);
        if let Some((_, bound)) = self.depart(index, straight_on, OrientedCircle::turn_at_least) {
            self.open.push(Candidate { bound, from: index, way: Way::Tangent(straight_on as u32) });
        }
        self.offer_all(index);
        if let Some(by) = reach.by.filter(|_| self.terrain.is_modest()) {
            self.join(self.terrain.owner(by as usize));
        }
    }

    /// Whether segment `a b` is blocked. Among few obstacles the deepest in its way joins the members.
    fn is_blocked<B: BroadPhase>(&mut self, near: &B, a: Point, b: Point) -> bool {
        if !self.terrain.is_modest() {
            return self.terrain.blocks(near, a, b);
        }
        if self.terrain.blocked_by(&self.walls, a, b) {
            return true;
        }
        let deepest = self.terrain.deepest(near, a, b);
        if let Some(obstacle) = deepest {
            self.join(obstacle);
        }
        deepest.is_some()
    }

    /// Makes an obstacle's sites members, and offers them to all arrivals.
    fn join(&mut self, obstacle: usize) {
        if std::mem::replace(&mut self.joined[obstacle], true) {
            return;
        }
        self.terrain.copy_walls(obstacle, &mut self.walls);
        let known = self.members.len();
        let corners = self.terrain.sites_of(obstacle).filter(|&site| self.terrain.is_corner(site));
        self.members.extend(corners.map(|site| site as u32));
        for from in 0..self.arrivals.len() {
            // What is longer comes with the rest.
            let limit = self.arrivals[from].offered;
            self.offer_members(from as u32, known, 0.0, limit);
        }
    }

    /// Offers the tangents of an arrival with bounds up to the limit, but for those offered before.
    fn offer_all(&mut self, from: u32) {
        let limit = self.limit;
        let offered = std::mem::replace(&mut self.arrivals[from as usize].offered, limit);
        if self.terrain.is_modest() {
            self.offer_members(from, 0, offered, limit);
            return;
        }
        let Self { terrain, sweep, open, arrivals, .. } = self;
        let mut offers = Offers::new(terrain, open, from, &arrivals[from as usize], [offered, limit]);
        let origin = offers.origin();
        offers.longer |= sweep.visit(terrain, &origin, |sight| offers.add(&sight));
        if offers.longer {
            self.put_off(from, limit);
        }
    }

    /// The same to all members from number `first` on, with bounds above `offered` and up to `limit`.
    fn offer_members(&mut self, from: u32, first: usize, offered: f64, limit: f64) {
        let Self { terrain, members, open, arrivals, .. } = self;
        let mut offers = Offers::new(terrain, open, from, &arrivals[from as usize], [offered, limit]);
        for &member in &members[first..] {
            offers.add_site(member as usize);
        }
        if offers.longer {
            self.put_off(from, limit);
        }
    }

    /// Sees to it that an arrival's candidates above `limit` will come up.
    fn put_off(&mut self, from: u32, limit: f64) {
        if !std::mem::replace(&mut self.arrivals[from as usize].pending, true) {
            self.open.push(Candidate { bound: limit, from, way: Way::Farther });
        }
    }

    /// The tangent from arrival `from` to circle `to`, and the path's length to its end; `None`
    /// when there is none or the arc to it, as measured by `turn`, is out of reach.
    fn depart(
        &self,
        from: u32,
        to: usize,
        turn: impl Fn(&OrientedCircle, Vector, Vector) -> f64,
    ) -> Option<(Bitangent, f64)> {
        let arrival = &self.arrivals[from as usize];
        let circle = self.circle(arrival.circle as usize);
        let tangent = Bitangent::between(&circle, &self.circle(to), self.terrain.tolerance())?;
        let turn = turn(&circle, arrival.heading, tangent.heading);
        (turn <= arrival.reach).then(|| (tangent, arrival.cost + turn * circle.rho.abs() + tangent.length))
    }

    /// Whether an older arrival on the same circle gets to this one at no greater cost.
    fn dominated(&self, circle: usize, heading: Vector, cost: f64) -> bool {
        let shape = self.circle(circle);
        let mut next = self.latest[circle];
        while next > 0 {
            let older = &self.arrivals[next as usize - 1];
            let turn = shape.turn(older.heading, heading);
            // A tenth of the tolerance, so that chains of tangents without length cannot go round for ever.
            if turn <= older.reach && older.cost + turn * shape.rho.abs() <= cost + 0.1 * self.terrain.tolerance() {
                return true;
            }
            next = older.older;
        }
        false
    }

    /// Makes the route the path to arrival `last` that leaves its circle with `heading` for the goal.
    fn trace(&mut self, last: u32, heading: Vector, length: f64) {
        self.route.length = length;
        let (mut at, mut leaving) = (last, heading);
        while at > 0 {
            let Arrival { circle, heading, parent, .. } = self.arrivals[at as usize];
            let circle = self.circle(circle as usize);
            self.route.push(circle, heading, circle.turn(heading, leaving));
            (at, leaving) = (parent, heading);
        }
        self.route.arcs.reverse();
    }
}
