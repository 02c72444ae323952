//! The nearest free point: out of an obstacle, or back onto the field.
//!
//! The border of free space is made of circles (round discs and corners) and lines (beside sides, and the field's
//! border). The point of it nearest to p is p's foot on one of them, or where two of them cross. All these candidates
//! within a reach are tried, in the order of their distance; the reach grows until one of them is free.

use env_model::motion::Mover;
use env_model::{Core, Inflated, Point, Vector, World};

/// The first reach, over the furthest that anything is: about a billionth.
const FIRST: f64 = 1.0 / (1u64 << 30) as f64;

/// So many points of a circle are tried from its centre, to which all are equally near.
const ROUND: usize = 8;

/// A part of the border of free space.
#[derive(Debug, Clone, Copy)]
enum Part {
    Circle(Point, f64),
    /// Through a point, along a unit vector.
    Line(Point, Vector),
}

impl Part {
    fn distance(self, p: Point) -> f64 {
        match self {
            Self::Circle(c, r) => ((p - c).norm() - r).abs(),
            Self::Line(o, u) => env_model::geometry::cross(u, p - o).abs(),
        }
    }
}

/// The nearest point to `p` that is free of `world` and of the movers as they are now; `p` itself where it is free.
/// A little outside of what it leaves, by the world's ε. `None` where there is no free point.
pub fn nearest_free(world: &World, movers: &[Mover<'_>], p: Point) -> Option<Point> {
    nearest_accepted(world, movers, p, Vector::x(), |_| true)
}

/// The nearest of the candidates that are free and that `accepts` agrees to, which is asked in the order of their
/// distances; `p` itself where it is free. From the centre of a circle, to which all its points are equally near, that
/// in the direction of the unit vector `towards` comes first.
pub(crate) fn nearest_accepted(
    world: &World,
    movers: &[Mover<'_>],
    p: Point,
    towards: Vector,
    mut accepts: impl FnMut(Point) -> bool,
) -> Option<Point> {
    let free = |q: Point| world.point_free(q) && movers.iter().all(|m| m.shape.point_clearance(q) >= 0.0);
    if free(p) {
        return Some(p);
    }
    let epsilon = world.epsilon();
    let shapes = || world.obstacles().iter().chain(movers.iter().map(|m| &m.shape));
    // Nothing further away can be free of a field; without one the furthest obstacle is left behind.
    let extent = shapes().fold(world.extent(), |all, shape| all.union(shape.aabb()));
    let furthest = (p - extent.centre()).norm() + extent.diagonal();
    let (mut tried, mut reach) = (f64::NEG_INFINITY, (furthest * FIRST).max(epsilon));
    let mut parts = Vec::new();
    let mut candidates: Vec<(f64, Point)> = Vec::new();
    loop {
        parts.clear();
        candidates.clear();
        for shape in shapes() {
            if shape.point_clearance(p) <= reach {
                borders(shape, epsilon, &mut parts);
            }
        }
        if let Some(field) = world.inner_field() {
            for (corner, along) in
                [(field.min, Vector::x()), (field.min, Vector::y()), (field.max, Vector::x()), (field.max, Vector::y())]
            {
                parts.push(Part::Line(corner, along));
            }
        }
        parts.retain(|part| part.distance(p) <= reach);
        let mut consider = |q: Point, d: f64| {
            if d > tried && d <= reach {
                candidates.push((d, q));
            }
        };
        for (i, a) in parts.iter().enumerate() {
            feet(*a, p, towards, &mut consider);
            let mut consider = |q: Point| consider(q, (q - p).norm());
            parts[..i].iter().for_each(|b| crossings(*a, *b, &mut consider));
        }
        // Ties in the order of the obstacles.
        candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, q)) = candidates.iter().find(|(_, q)| free(*q) && accepts(*q)) {
            return Some(*q);
        }
        if reach > furthest || !furthest.is_finite() {
            return None;
        }
        tried = reach;
        reach *= 2.0;
    }
}

/// The circles and lines that a shape's border is made of, `epsilon` further out.
fn borders(shape: &Inflated, epsilon: f64, parts: &mut Vec<Part>) {
    let reach = shape.radius + epsilon;
    let mut side = |a: Point, b: Point| {
        parts.push(Part::Circle(a, reach));
        let d = b - a;
        if d.norm() > 0.0 {
            let along = d.normalize();
            let across = Vector::new(-along.y, along.x) * reach;
            parts.push(Part::Line(a + across, along));
            parts.push(Part::Line(a - across, along));
        }
    };
    match &shape.core {
        Core::Point(c) => side(*c, *c),
        Core::Segment(a, b) => {
            side(*a, *b);
            side(*b, *b);
        }
        Core::Polygon(polygon) => {
            let corners = polygon.corners();
            for (i, a) in corners.iter().enumerate() {
                side(*a, corners[(i + 1) % corners.len()]);
            }
        }
    }
}

/// The points of a part at which its distance to `p` is extreme, with their distances.
fn feet(part: Part, p: Point, towards: Vector, consider: &mut impl FnMut(Point, f64)) {
    match part {
        Part::Circle(c, r) => {
            let d = p - c;
            let away = d.norm();
            if away > 0.0 {
                let out = d / away;
                consider(c + out * r, (r - away).abs());
                consider(c - out * r, r + away);
                return;
            }
            let mut out = towards;
            for _ in 0..ROUND {
                consider(c + out * r, r);
                // An eighth of a turn.
                out = Vector::new(out.x - out.y, out.x + out.y) * std::f64::consts::FRAC_1_SQRT_2;
            }
        }
        Part::Line(o, u) => {
            let foot = o + u * (p - o).dot(&u);
            consider(foot, (foot - p).norm());
        }
    }
}

fn crossings(a: Part, b: Part, consider: &mut impl FnMut(Point)) {
    match (a, b) {
        (Part::Line(o, u), Part::Line(q, w)) => {
            let sine = env_model::geometry::cross(u, w);
            if sine.abs() > 1e-12 {
                consider(o + u * (env_model::geometry::cross(q - o, w) / sine));
            }
        }
        (Part::Line(o, u), Part::Circle(c, r)) | (Part::Circle(c, r), Part::Line(o, u)) => {
            let foot = o + u * (c - o).dot(&u);
            let half = r * r - (c - foot).norm_squared();
            if half >= 0.0 {
                consider(foot + u * half.sqrt());
                consider(foot - u * half.sqrt());
            }
        }
        (Part::Circle(c, r), Part::Circle(e, s)) => {
            let d = e - c;
            let length = d.norm();
            if length > 0.0 && length <= r + s && length >= (r - s).abs() {
                let along = 0.5 * (length + (r - s) * (r + s) / length);
                let across = (r * r - along * along).max(0.0).sqrt();
                let (u, foot) = (d / length, c + d * (along / length));
                let n = Vector::new(-u.y, u.x) * across;
                consider(foot + n);
                consider(foot - n);
            }
        }
    }
}
