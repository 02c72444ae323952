//! Free vertices: descent with a guarantee for whole segments.
//!
//! Each round replaces the obstacles near a segment by half-planes that both
//! of its ends keep (`halfplane`); the current path keeps them too, so the
//! convex programme never costs more, and by convexity the segments between
//! stay clear. Obstacles that the step meets beyond those join and the round is
//! solved again. To shorten, a path of many vertices is thinned first: a solve takes
//! as long as it has unknowns, and no deadline can interrupt it. Fixed points need not be local optima: a segment that touches
//! a disc inside its length cannot turn about the contact.

use std::collections::BTreeSet;

use env_model::{Aabb, Point, Vector, World};

use crate::halfplane::{HalfPlane, between};
use crate::piece::{Piece, decompose};
use crate::polish::Polish;
use crate::program::{Answer, Quadratic, Rows, solve};
use crate::session::Session;
use crate::settings::{Method, Objective, Settings};
use crate::smooth::{cost, mean_spacing};

/// Shorter segments weigh like this share of the spacing: reweighting stays finite.
const LEAST_LENGTH: f64 = 1e-3;

/// Steps shrink slowly here: the descent ends at this many times the tolerance.
const CREEP: f64 = 1e4;

/// Shortening thins a longer path to about this many vertices: a solve takes about a millisecond.
const MOST_VERTICES: usize = 24;

/// The convex pieces of all obstacles, in the world frame.
struct Pieces {
    list: Vec<Piece>,
    /// Pieces of obstacle i: `first[i]..first[i + 1]`.
    first: Vec<usize>,
}

impl Pieces {
    fn new(world: &World) -> Self {
        let (mut list, mut first) = (Vec::new(), vec![0]);
        for (i, obstacle) in world.obstacles().iter().enumerate() {
            decompose(obstacle, i, &mut list);
            first.push(list.len());
        }
        Self { list, first }
    }
}

/// One round's constraints.
struct Round<'a> {
    world: &'a World,
    pieces: &'a Pieces,
    path: &'a [Point],
    /// (segment, obstacle) that have their half-planes.
    pairs: BTreeSet<(usize, usize)>,
    planes: Vec<(usize, HalfPlane)>,
}

impl Round<'_> {
    /// Adds the pieces of `obstacle` for `segment`, unless they are there.
    fn add(&mut self, segment: usize, obstacle: usize) {
        if !self.pairs.insert((segment, obstacle)) {
            return;
        }
        let (a, b) = (self.path[segment], self.path[segment + 1]);
        let grazing = 1e-6 * mean_spacing(self.path);
        for piece in &self.pieces.list[self.pieces.first[obstacle]..self.pieces.first[obstacle + 1]] {
            let mut plane = between(a, b, piece, grazing);
            // The margin makes up for the solver's rounding; where the path lies
            // nearer, it keeps what it has, so that it stays feasible.
            let here = plane.normal.dot(&a.coords).min(plane.normal.dot(&b.coords));
            plane.offset = (plane.offset + self.world.slack()).min(here);
            self.planes.push((segment, plane));
        }
    }

    /// Adds what lies within `reach` of the segments.
    fn add_near(&mut self, reach: f64) {
        for i in 0..self.path.len() - 1 {
            let mut near = Vec::new();
            let region = Aabb::of_points(&self.path[i..i + 2]).inflated(reach);
            self.world.for_each_overlapping(&region, |k| near.push(k));
            near.sort_unstable();
            near.into_iter().for_each(|k| self.add(i, k));
        }
    }

    /// Adds what `step` collides with. Returns whether anything was new.
    fn add_met(&mut self, step: &[Point]) -> bool {
        let before = self.pairs.len();
        for (i, w) in step.windows(2).enumerate() {
            let mut met = Vec::new();
            self.world.for_each_along(w[0], w[1], |k| met.push(k));
            met.retain(|&k| !self.world.obstacles()[k].segment_free(w[0], w[1], self.world.slack()));
            met.sort_unstable();
            met.into_iter().for_each(|k| self.add(i, k));
        }
        self.pairs.len() > before
    }

    /// The constraints on displacements in units of `unit`: vertex k has the unknowns 2(k − 1) and 2(k − 1) + 1.
    fn rows(&self, unit: f64) -> Rows {
        let mut rows = Rows::default();
        let inner = 1..self.path.len() - 1;
        for (segment, plane) in &self.planes {
            for k in [*segment, segment + 1] {
                if inner.contains(&k) {
                    let room = plane.normal.dot(&self.path[k].coords) - plane.offset;
                    let terms = [(2 * (k - 1), -plane.normal.x), (2 * (k - 1) + 1, -plane.normal.y)];
                    rows.push(terms, room.max(0.0) / unit);
                }
            }
        }
        if let Some(field) = self.world.inner_field() {
            for k in inner {
                for axis in 0..2 {
                    let p = self.path[k][axis];
                    rows.push([(2 * (k - 1) + axis, 1.0)], (field.max[axis] - p).max(0.0) / unit);
                    rows.push([(2 * (k - 1) + axis, -1.0)], (p - field.min[axis]).max(0.0) / unit);
                }
            }
        }
        rows
    }
}

/// Descends from the session's path, which is free and has its cost. Never fails: at worst it stays.
pub(crate) fn descend(settings: &Settings, reference: &[Point], session: &mut Session<'_, '_>) -> Polish {
    let mut path = session.path.clone();
    if path.len() < 3 {
        return Polish::Done;
    }
    if settings.objective == Objective::Shorten && path.len() > MOST_VERTICES {
        path = thinned(&path, session);
        let length = cost(&path, reference, settings);
        if length < session.cost {
            session.offer(&path, length);
        }
    }
    let world = session.world;
    let pieces = Pieces::new(world);
    let unit = mean_spacing(&path);
    for _ in 0..settings.max_rounds {
        let mut round = Round { world, pieces: &pieces, path: &path, pairs: BTreeSet::new(), planes: Vec::new() };
        round.add_near(0.5 * unit);
        let step = loop {
            if !session.allows() {
                return Polish::Stopped;
            }
            let answer = programme(&round, settings, reference, unit);
            session.count();
            let Answer::Point { x: z, .. } = answer else {
                session.report();
                return Polish::Done;
            };
            let mut step = path.clone();
            for (p, d) in step[1..].iter_mut().zip(z.chunks_exact(2)).take(path.len() - 2) {
                *p += Vector::new(d[0], d[1]) * unit;
            }
            if session.is_free(&step) || !round.add_met(&step) {
                break step;
            }
            session.report();
        };
        let before = session.cost;
        // Half-planes hold to the solver's accuracy; what that spoils, a shorter step mends.
        let mut share = 1.0;
        let taken = (0..20).any(|_| {
            let part: Vec<Point> = path.iter().zip(&step).map(|(p, q)| p + (q - p) * share).collect();
            share *= 0.5;
            let c = cost(&part, reference, settings);
            c < before && session.offer(&part, c)
        });
        session.report();
        if !taken || before - session.cost <= CREEP * settings.tolerance * before {
            return Polish::Done;
        }
        path.clone_from(&session.path);
    }
    Polish::Done
}

/// Every k-th vertex of a free path, with more where a shortcut would collide: free, and never longer.
fn thinned(path: &[Point], session: &mut Session<'_, '_>) -> Vec<Point> {
    let (last, stride) = (path.len() - 1, path.len().div_ceil(MOST_VERTICES));
    let (mut kept, mut at) = (vec![path[0]], 0);
    while at < last {
        let mut next = (at + stride).min(last);
        while next > at + 1 && !session.is_free(&[path[at], path[next]]) {
            next = at + (next - at) / 2;
        }
        kept.push(path[next]);
        at = next;
    }
    kept
}

fn programme(round: &Round<'_>, settings: &Settings, reference: &[Point], unit: f64) -> Answer {
    let path = round.path;
    let (segments, unknowns) = (path.len() - 1, 2 * (path.len() - 2));
    let mut rows = round.rows(unit);
    // Terms of Σ cₖ (pₖ + z): those of inner vertices, and the constant that path or reference give.
    let terms = |axis: usize, weights: &[(usize, f64)]| -> Vec<(usize, f64)> {
        let inner = weights.iter().filter(|&&(k, _)| k > 0 && k < segments);
        inner.map(|&(k, c)| (2 * (k - 1) + axis, c)).collect()
    };
    let side = |i: usize| (path[i + 1] - path[i]) / unit;
    if settings.objective == Objective::Shorten && settings.method == Method::Socp {
        let mut objective = Quadratic::new(unknowns + segments, 0);
        for i in 0..segments {
            objective.add_linear(unknowns + i, 1.0);
            rows.push([(unknowns + i, -1.0)], 0.0);
            for axis in 0..2 {
                let difference = terms(axis, &[(i, 1.0), (i + 1, -1.0)]);
                rows.push(difference, side(i)[axis]);
            }
        }
        return solve(&objective, &rows, segments);
    }
    let mut quadratic = Quadratic::new(unknowns, 4);
    for axis in 0..2 {
        for i in 0..segments {
            let w = match settings.objective {
                Objective::Shorten => 1.0 / side(i).norm().max(LEAST_LENGTH),
                Objective::Smooth => settings.w_length,
            };
            quadratic.add_square(w, &terms(axis, &[(i, -1.0), (i + 1, 1.0)]), side(i)[axis]);
        }
        if settings.objective == Objective::Smooth {
            for k in 1..segments {
                let bend = side(k)[axis] - side(k - 1)[axis];
                let second = terms(axis, &[(k - 1, 1.0), (k, -2.0), (k + 1, 1.0)]);
                quadratic.add_square(settings.w_smooth * unit, &second, bend);
                let away = (path[k] - reference[k])[axis] / unit;
                quadratic.add_square(settings.w_reference * unit, &terms(axis, &[(k, 1.0)]), away);
            }
        }
    }
    solve(&quadratic, &rows, 0)
}
