//! A* over arrivals on oriented circles, with the obstacles discovered on the way.

use std::collections::BinaryHeap;

use env_model::{Aabb, Point, Vector};

use crate::bitangent::{Bitangent, OrientedCircle};
use crate::candidate::{Candidate, Deferred};
use crate::discs::{Discs, Listed};
use crate::pairs::PairSet;
use crate::route::Route;
use crate::separation::Separation;
use crate::subset::{GOAL, START, Subset};

/// After so many arrivals it pays to ask whether start and goal are separated at all.
const ASK_SEPARATION: usize = 256;

/// A round first looks at paths this much longer, relatively, than the last round's.
const HEADROOM: f64 = 2e-3;

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// The shortest path and its exact length, in scene units.
    Found {
        /// Its length.
        length: f64,
    },
    /// There is none: the discs separate start from goal, or hold one of them.
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
    /// An arrival was expanded.
    fn expanded(&mut self) {}
    /// A segment was tested against the world.
    fn tested(&mut self) {}
    /// A round is over: the shortest path among the subset collides with the rest.
    /// `write` writes it, arcs coarsely.
    fn collided(&mut self, _write: impl FnOnce(&mut Vec<Point>)) {}
}

impl Watch for () {}

/// A path has come to `circle`, touching it with unit `heading`.
#[derive(Debug, Clone, Copy)]
struct Arrival {
    circle: usize,
    /// The arrival before; its own index for the start.
    parent: usize,
    heading: Vector,
    /// Length so far.
    cost: f64,
    /// Where it touches the circle.
    point: Point,
    /// How far it can follow the circle, radians.
    reach: f64,
    /// The arrival on the same circle that was found before this one.
    older: Option<usize>,
}

/// An exact shortest-path solver. Keeps its buffers: a second query of the same size allocates nothing.
#[derive(Debug, Default)]
pub struct Solver {
    subset: Subset,
    arrivals: Vec<Arrival>,
    /// The latest arrival on every circle.
    latest: Vec<Option<usize>>,
    open: BinaryHeap<Candidate>,
    /// What is not worth a look until paths of length `limit` have failed.
    deferred: Vec<Deferred>,
    limit: f64,
    /// Tangents that a disc blocks.
    blocked: PairSet,
    /// Tangents that are free in the whole world.
    clear: PairSet,
    separation: Separation,
    route: Route,
    /// Arrivals expanded in all rounds.
    expanded: usize,
    /// When to ask whether start and goal are separated.
    ask_at: usize,
    /// The last arrival of the round's path.
    last: usize,
    found: bool,
    /// Start and goal as given; everything else is relative to the start.
    ends: [Point; 2],
    tolerance: f64,
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
        self.search(&Listed { discs, origin: start.coords }, start, goal, 1e-12 * bounds.diagonal(), &mut ())
    }

    /// Writes the path found last as a polyline whose segments touch the arcs
    /// from outside: it enters no disc, and is longer than the exact path by at
    /// most the fraction `max_relative_excess`, > 0. Empty unless a path was found.
    pub fn write_polyline(&self, max_relative_excess: f64, out: &mut Vec<Point>) {
        self.write_polyline_within(None, max_relative_excess, out);
    }

    /// The same, keeping the corners inside `bounds`, which must hold the exact path.
    pub(crate) fn write_polyline_within(&self, bounds: Option<&Aabb>, max_relative_excess: f64, out: &mut Vec<Point>) {
        out.clear();
        if !self.found {
            return;
        }
        let [start, goal] = self.ends;
        let bounds = bounds.map(|b| Aabb { min: b.min - start.coords, max: b.max - start.coords });
        out.push(start);
        self.route.write(max_relative_excess, bounds.as_ref(), self.tolerance, |p| out.push(p + start.coords));
        out.push(goal);
        out.dedup();
    }

    /// The path found last.
    pub(crate) fn route(&self) -> &Route {
        &self.route
    }

    /// See [`Solver::shortest`]; `discs` are relative to `start`.
    pub(crate) fn search<D: Discs, W: Watch>(
        &mut self,
        discs: &D,
        start: Point,
        goal: Point,
        tolerance: f64,
        watch: &mut W,
    ) -> Outcome {
        self.ends = [start, goal];
        self.tolerance = tolerance;
        let goal = goal - start.coords;
        self.route.clear();
        self.found = false;
        self.subset.reset(discs.len(), Point::origin(), goal, tolerance);
        self.blocked.clear();
        self.clear.clear();
        for end in [Point::origin(), goal] {
            if self.subset.deepest(discs, end, end, [None; 2]).is_some() {
                return Outcome::Infeasible;
            }
        }
        if start == self.ends[GOAL] {
            self.found = true;
            return Outcome::Found { length: 0.0 };
        }
        self.limit = goal.coords.norm() * (1.0 + HEADROOM);
        self.expanded = 0;
        self.ask_at = ASK_SEPARATION;
        loop {
            match self.round(discs, watch) {
                Round::Path(cost) if self.is_free(discs, watch) => {
                    self.route.note_near(discs);
                    self.found = true;
                    return Outcome::Found { length: cost };
                }
                Round::Path(cost) => {
                    // The next path is no shorter, and mostly not much longer.
                    self.limit = cost * (1.0 + HEADROOM);
                    watch.collided(|out| {
                        out.clear();
                        out.push(start);
                        // A picture needs no more than a part in a thousand.
                        self.route.write(1e-3, None, 0.0, |p| out.push(p + start.coords));
                        out.push(self.ends[GOAL]);
                        out.dedup();
                    });
                }
                Round::NoPath => return Outcome::Infeasible,
                Round::Stopped => return Outcome::Stopped,
            }
        }
    }

    /// One A*: finds the shortest path among the subset and leaves it in `route`.
    fn round<D: Discs, W: Watch>(&mut self, discs: &D, watch: &mut W) -> Round {
        let goal = self.subset.circles[GOAL].centre;
        self.arrivals.clear();
        self.open.clear();
        self.deferred.clear();
        self.latest.clear();
        self.grow();
        if !watch.allows() {
            return Round::Stopped;
        }
        self.arrive(discs, START, START, Vector::zeros(), 0.0, watch);
        while let Some(Candidate { from, to, exact, .. }) = self.next() {
            if !watch.allows() {
                return Round::Stopped;
            }
            let start_circle = self.arrivals[from].circle;
            if self.blocked.contains(start_circle, to) {
                continue;
            }
            let Some((tangent, cost)) = self.depart(from, to, OrientedCircle::turn) else { continue };
            let b = self.subset.circles[to].touch(tangent.heading);
            let bound = cost + (goal - b).norm();
            if !exact && self.open.peek().is_some_and(|next| next.bound < bound) {
                self.open.push(Candidate { bound, from, to, exact: true });
                continue;
            }
            if self.dominated(to, tangent.heading, cost) {
                continue;
            }
            if !self.clear.contains(start_circle, to) {
                watch.tested();
                let a = self.subset.circles[start_circle].touch(tangent.heading);
                if self.subset.blocks(a, b, start_circle, to) {
                    self.block(start_circle, to);
                    continue;
                }
            }
            if to == GOAL {
                let Self { route, arrivals, subset, .. } = self;
                route.trace(arrivals, subset, from, tangent.heading);
                route.length = cost;
                self.last = from;
                return Round::Path(cost);
            }
            if self.expanded >= self.ask_at {
                self.ask_at = usize::MAX;
                // Overlaps below twice the tolerance are passable for the search.
                let margin = 4.0 * self.tolerance;
                match self.separation.separated(discs, Point::origin(), goal, margin, || watch.allows()) {
                    None => return Round::Stopped,
                    Some(true) => return Round::NoPath,
                    Some(false) => {}
                }
            }
            self.arrive(discs, from, to, tangent.heading, cost, watch);
        }
        Round::NoPath
    }

    /// Tests the tangents of the round's path against the whole world. What
    /// they enter deepest joins the subset.
    fn is_free<D: Discs, W: Watch>(&mut self, discs: &D, watch: &mut W) -> bool {
        let mut free = true;
        let mut to = GOAL;
        let mut last = self.last;
        loop {
            let Arrival { circle: from, parent, .. } = self.arrivals[last];
            if !self.clear.contains(from, to)
                && let Some(tangent) =
                    Bitangent::between(&self.subset.circles[from], &self.subset.circles[to], self.tolerance)
            {
                watch.tested();
                let [a, b] = [from, to].map(|circle| self.subset.circles[circle].touch(tangent.heading));
                let except = [from, to].map(|circle| self.subset.obstacle_of(circle));
                if let Some(violated) = self.subset.deepest(discs, a, b, except) {
                    free = false;
                    self.block(from, to);
                    self.join(discs, violated);
                } else {
                    self.clear.insert(from, to);
                    self.clear.insert(reversed(to), reversed(from));
                }
            }
            if from == START {
                return free;
            }
            (to, last) = (from, parent);
        }
    }

    /// Records an arrival and offers all ways on.
    fn arrive<D: Discs, W: Watch>(
        &mut self,
        discs: &D,
        parent: usize,
        circle: usize,
        heading: Vector,
        cost: f64,
        watch: &mut W,
    ) {
        watch.expanded();
        self.expanded += 1;
        let reach = self.subset.reach(circle, heading);
        let index = self.arrivals.len();
        let older = self.latest[circle].replace(index);
        let point = self.subset.circles[circle].touch(heading);
        self.arrivals.push(Arrival { circle, parent, heading, cost, point, reach: reach.angle, older });
        self.offer(index, GOAL);
        for member in 0..self.subset.len() {
            self.offer_member(index, member);
        }
        if let Some(blocker) = reach.blocker {
            let blocker = self.subset.representative(discs, blocker);
            if let Some(member) = self.join(discs, blocker) {
                for arrival in 0..self.arrivals.len() {
                    self.offer_member(arrival, member);
                }
            }
        }
    }

    /// Adds an obstacle to the subset; returns its number as a member, unless it was one.
    fn join<D: Discs>(&mut self, discs: &D, obstacle: usize) -> Option<usize> {
        if self.subset.contains(obstacle) {
            return None;
        }
        let member = self.subset.len();
        self.subset.add(discs, obstacle);
        self.grow();
        Some(member)
    }

    /// Makes room for the subset's new circles.
    fn grow(&mut self) {
        self.latest.resize(self.subset.circles.len(), None);
        self.blocked.resize(self.subset.circles.len());
        self.clear.resize(self.subset.circles.len());
    }

    /// The open candidate of the least bound; looks at what was put off first if that might be less.
    fn next(&mut self) -> Option<Candidate> {
        while !self.deferred.is_empty() && self.open.peek().is_none_or(|next| next.bound > self.limit) {
            let straight = self.subset.circles[GOAL].centre.coords.norm();
            let least = self.deferred.iter().map(|d| d.bound).fold(f64::INFINITY, f64::min);
            // Doubling what the limit allows beyond the straight line keeps the number of sweeps logarithmic.
            self.limit = (straight + 2.0 * (self.limit - straight)).max(least);
            let mut i = 0;
            while let Some(&Deferred { bound, from, member }) = self.deferred.get(i) {
                if bound > self.limit {
                    i += 1;
                    continue;
                }
                self.deferred.swap_remove(i);
                for to in Subset::circles_of(member) {
                    self.offer(from, to);
                }
            }
        }
        self.open.pop()
    }

    /// Offers both tangents from an arrival to a member, or puts them off.
    fn offer_member(&mut self, from: usize, member: usize) {
        let arrival = &self.arrivals[from];
        let bound = arrival.cost + self.subset.via(member, arrival.point);
        if bound > self.limit {
            self.deferred.push(Deferred { bound, from, member });
            return;
        }
        for to in Subset::circles_of(member) {
            self.offer(from, to);
        }
    }

    /// Puts a candidate in the queue if its tangent exists, may be in reach and is not known to be blocked.
    fn offer(&mut self, from: usize, to: usize) {
        let circle = self.arrivals[from].circle;
        if (circle / 2 == to / 2 && to != GOAL) || self.blocked.contains(circle, to) {
            return;
        }
        if let Some((tangent, cost)) = self.depart(from, to, OrientedCircle::turn_at_least) {
            let point = self.subset.circles[to].touch(tangent.heading);
            let bound = cost + (self.subset.circles[GOAL].centre - point).norm();
            self.open.push(Candidate { bound, from, to, exact: false });
        }
    }

    /// The tangent from arrival `from` to circle `to`, and the path's length to its end; `None`
    /// when there is none or the arc to it, as measured by `turn`, is out of reach.
    fn depart(
        &self,
        from: usize,
        to: usize,
        turn: impl Fn(&OrientedCircle, Vector, Vector) -> f64,
    ) -> Option<(Bitangent, f64)> {
        let Self { subset, tolerance, .. } = self;
        let arrival = &self.arrivals[from];
        let circle = &subset.circles[arrival.circle];
        let tangent = Bitangent::between(circle, &subset.circles[to], *tolerance)?;
        let turn = turn(circle, arrival.heading, tangent.heading);
        (turn <= arrival.reach).then(|| (tangent, arrival.cost + turn * circle.rho.abs() + tangent.length))
    }

    /// Remembers that the tangent between two circles is blocked, either way.
    fn block(&mut self, from: usize, to: usize) {
        self.blocked.insert(from, to);
        self.blocked.insert(reversed(to), reversed(from));
    }

    /// Whether an older arrival on the same circle gets to this one at no greater cost.
    fn dominated(&self, circle: usize, heading: Vector, cost: f64) -> bool {
        let shape = &self.subset.circles[circle];
        let mut next = self.latest[circle];
        while let Some(index) = next {
            let older = &self.arrivals[index];
            let turn = shape.turn(older.heading, heading);
            // A tenth of the tolerance, so that chains of tangents without length cannot go round for ever.
            if turn <= older.reach && older.cost + turn * shape.rho.abs() <= cost + 0.1 * self.tolerance {
                return true;
            }
            next = older.older;
        }
        false
    }
}

/// How a round ended.
enum Round {
    /// The shortest path among the subset is in `Solver::route`; its length.
    Path(f64),
    /// There is none: the subset, or the whole, separates start from goal.
    NoPath,
    /// The caller stopped it.
    Stopped,
}

/// The same disc passed the other way round.
fn reversed(circle: usize) -> usize {
    if circle <= GOAL { circle } else { circle ^ 1 }
}

impl Route {
    /// Makes this the path to arrival `last` that leaves its circle with `heading`.
    fn trace(&mut self, arrivals: &[Arrival], subset: &Subset, last: usize, heading: Vector) {
        self.clear();
        let (mut at, mut leaving) = (last, heading);
        while arrivals[at].circle != START {
            let Arrival { circle, heading, parent, .. } = arrivals[at];
            let circle = subset.circles[circle];
            self.push(circle, heading, circle.turn(heading, leaving));
            (at, leaving) = (parent, heading);
        }
        self.arcs.reverse();
    }
}
