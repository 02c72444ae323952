//! A* over pairs of cell and safe interval.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use env_model::motion::Mover;
use env_model::{CellGrid, Point, World};
use planner_api::Run;

use crate::intervals::{SafeIntervals, for_each_cover};

/// Where the robot is to be, and when.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Where.
    pub point: Point,
    /// When it comes there at the earliest, in seconds.
    pub arrive: f64,
    /// When it leaves.
    pub depart: f64,
}

/// What is asked of the search.
#[derive(Debug, Clone, Copy)]
pub struct Query<'q, 'm> {
    pub world: &'q World,
    pub movers: &'q [Mover<'m>],
    pub horizon: f64,
    /// Where the robot can begin at rest, and when.
    pub start: (Point, f64),
    pub goal: Point,
    /// Units per second.
    pub speed: f64,
}

/// A pair of cell and safe interval, reached.
#[derive(Debug, Clone, Copy)]
struct Node {
    cell: u32,
    time: f64,
    /// The interval that it was reached from; itself at the beginning.
    parent: u32,
    done: bool,
}

const UNREACHED: Node = Node { cell: 0, time: f64::INFINITY, parent: u32::MAX, done: false };

#[derive(Debug, Clone, Copy, PartialEq)]
struct Open {
    bound: f64,
    time: f64,
    interval: u32,
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    /// The greatest has the least bound; of equals the one that is farther on its way.
    fn cmp(&self, other: &Self) -> Ordering {
        (other.bound.total_cmp(&self.bound))
            .then(self.time.total_cmp(&other.time))
            .then(other.interval.cmp(&self.interval))
    }
}

/// Safe interval path planning. Its buffers are reused.
#[derive(Debug, Default)]
pub struct Search {
    blocked: Vec<bool>,
    intervals: SafeIntervals,
    nodes: Vec<Node>,
    open: BinaryHeap<Open>,
    exits: Vec<(usize, f64)>,
}

/// How far from start and goal cells may be by which a way joins the grid, in cells.
const RINGS: isize = 1;

impl Search {
    /// The way that arrives first, into `way`; whether it leads to the goal. Where none does, the way to the cell
    /// nearest to the goal; empty where there is no way at all.
    /// `free(to, depart, arrive)` tells whether the straight way from the start is.
    pub fn run(
        &mut self,
        grid: &CellGrid,
        query: &Query<'_, '_>,
        mut free: impl FnMut(Point, f64, f64) -> bool,
        run: &mut Run<'_>,
        way: &mut Vec<Stop>,
    ) -> bool {
        let Query { world, movers, horizon, start, goal, speed } = *query;
        way.clear();
        grid.occupy(world, &mut self.blocked);
        self.intervals.compute(grid, &self.blocked, movers, horizon);
        self.nodes.clear();
        self.nodes.resize(self.intervals.len(), UNREACHED);
        self.open.clear();
        let bound = |cell: usize, time: f64| time + (grid.centre(cell) - goal).norm() / speed;
        self.joins(grid, world, start.0);
        for i in 0..self.exits.len() {
            let (cell, distance) = self.exits[i];
            for interval in self.intervals.of(cell) {
                let safe = self.intervals.get(interval);
                let time = safe.begin.max(start.1 + distance / speed);
                if time < safe.end && free(grid.centre(cell), time - distance / speed, time) {
                    self.reach(interval, cell, time, interval as u32, bound(cell, time));
                }
            }
        }
        self.joins(grid, world, goal);
        let goal_free = free_from(movers, goal, horizon);
        let mut nearest: Option<(f64, u32)> = None;
        let mut arrival: Option<(f64, u32)> = None;
        while let Some(Open { bound: f, time, interval }) = self.open.pop() {
            if arrival.is_some_and(|(t, _)| t <= f) {
                break;
            }
            let node = &mut self.nodes[interval as usize];
            if node.done || time > node.time {
                continue;
            }
            node.done = true;
            let cell = node.cell as usize;
            if !run.allows(1) {
                break;
            }
            (run.spent.iterations, run.spent.evaluations) = (run.spent.iterations + 1, run.spent.evaluations + 1);
            let left = f - time;
            if nearest.is_none_or(|(least, _)| left < least) {
                nearest = Some((left, interval));
            }
            let safe = self.intervals.get(interval as usize);
            if let Some((_, distance)) = self.exits.iter().find(|(exit, _)| *exit == cell) {
                let t = goal_free.max(time + distance / speed);
                if t < safe.end && arrival.is_none_or(|(best, _)| t < best) {
                    arrival = Some((t, interval));
                }
            }
            for (k, to) in grid.moves(&self.blocked, cell).into_iter().enumerate() {
                let Some(to) = to else { continue };
                let length = if k % 2 == 1 { std::f64::consts::SQRT_2 } else { 1.0 } * grid.size();
                let lasts = length / speed;
                for next in self.intervals.of(to) {
                    let there = self.intervals.get(next);
                    // On the way both cells must be safe.
                    let depart = time.max(there.begin);
                    let t = depart + lasts;
                    if t < safe.end && t < there.end && t < self.nodes[next].time {
                        self.reach(next, to, t, interval, bound(to, t));
                    }
                }
            }
        }
        let Some((_, last)) = arrival.or(nearest) else { return false };
        self.trace(grid, query, last, way);
        if let Some((time, last)) = arrival {
            let distance = (goal - grid.centre(self.nodes[last as usize].cell as usize)).norm();
            push(way, goal, time, distance / speed);
        }
        arrival.is_some()
    }

    fn reach(&mut self, interval: usize, cell: usize, time: f64, parent: u32, bound: f64) {
        if time < self.nodes[interval].time {
            self.nodes[interval] = Node { cell: cell as u32, time, parent, done: false };
            self.open.push(Open { bound, time, interval: interval as u32 });
        }
    }

    /// The cells near `p` whose centres it sees, into `exits`.
    fn joins(&mut self, grid: &CellGrid, world: &World, p: Point) {
        self.exits.clear();
        let at = grid.cell_at(p);
        for dy in -RINGS..=RINGS {
            for dx in -RINGS..=RINGS {
                let Some(cell) = grid.step(at, (dx, dy)).filter(|cell| !self.blocked[*cell]) else { continue };
                let centre = grid.centre(cell);
                if world.segment_free(p, centre) {
                    self.exits.push((cell, (centre - p).norm()));
                }
            }
        }
    }

    /// The stops from the start to the interval `last`.
    fn trace(&self, grid: &CellGrid, query: &Query<'_, '_>, last: u32, way: &mut Vec<Stop>) {
        let mut at = last;
        loop {
            let Node { cell, time, parent, .. } = self.nodes[at as usize];
            way.push(Stop { point: grid.centre(cell as usize), arrive: time, depart: time });
            if parent == at {
                break;
            }
            at = parent;
        }
        let (start, begin) = query.start;
        way.push(Stop { point: start, arrive: begin, depart: begin });
        way.reverse();
        for i in 1..way.len() {
            let lasts = (way[i].point - way[i - 1].point).norm() / query.speed;
            way[i - 1].depart = way[i].arrive - lasts;
        }
    }
}

/// One more stop, `lasts` seconds from the last one.
fn push(way: &mut Vec<Stop>, point: Point, arrive: f64, lasts: f64) {
    if let Some(before) = way.last_mut() {
        before.depart = arrive - lasts;
    }
    way.push(Stop { point, arrive, depart: f64::INFINITY });
}

/// From when on no mover covers `p`; +∞ where one stays there.
fn free_from(movers: &[Mover<'_>], p: Point, horizon: f64) -> f64 {
    let mut from: f64 = 0.0;
    for mover in movers {
        for_each_cover(mover, p, horizon, |cover| from = from.max(cover.end));
    }
    from
}
