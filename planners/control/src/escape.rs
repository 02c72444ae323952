//! The nearest free point: out of an obstacle, or back onto the field.
//!
//! The border of free space is made of circles (round discs and corners) and lines (beside sides, and the field's
//! border). The point of it nearest to p is p's foot on one of them, or where two of them cross. All these candidates
//! within a reach are tried, in the order of their distance; the reach grows until one of them is free.

use env_model::motion::Mover;
use env_model::{Core, Inflated, Point, Vector, World};

/// How often the reach doubles before giving up: from a billionth of the way across to all of it.
const DOUBLINGS: usize = 48;

/// A part of the border of free space.
#[derive(Debug, Clone, Copy)]
enum Part {
    Circle(Point, f64),
    /// Through a point, along a unit vector.
    Line(Point, Vector),
}

/// The nearest point to `p` that is free of `world` and of the movers as they are now; `p` itself where it is free.
/// A little outside of what it leaves, by the world's ε. `None` where there is no free point.
pub fn nearest_free(world: &World, movers: &[Mover<'_>], p: Point) -> Option<Point> {
    let free = |q: Point| world.point_free(q) && movers.iter().all(|m| m.shape.point_clearance(q) >= 0.0);
    if free(p) {
        return Some(p);
    }
    let (extent, epsilon) = (world.extent(), world.epsilon());
    // Nothing further away can be free of a field; without one the furthest obstacle is left behind.
    let middle = extent.min + extent.size() * 0.5;
    let furthest = (p - middle).norm() + extent.diagonal() + movers.iter().map(|m| m.shape.radius).fold(0.0, f64::max);
    let mut reach = furthest * 2f64.powi(-(DOUBLINGS as i32) + 18).max(epsilon);
    let mut parts = Vec::new();
    let mut candidates: Vec<(f64, Point)> = Vec::new();
    for _ in 0..DOUBLINGS {
        parts.clear();
        candidates.clear();
        for shape in world.obstacles().iter().chain(movers.iter().map(|m| &m.shape)) {
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
        let mut consider = |q: Point| {
            let d = (q - p).norm();
            if d <= reach {
                candidates.push((d, q));
            }
        };
        for (i, a) in parts.iter().enumerate() {
            feet(*a, p, &mut consider);
            parts[..i].iter().for_each(|b| crossings(*a, *b, &mut consider));
        }
        // Ties in the order of the obstacles.
        candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, q)) = candidates.iter().find(|(_, q)| free(*q)) {
            return Some(*q);
        }
        if reach > furthest {
            return None;
        }
        reach *= 2.0;
    }
    None
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

/// The points of a part at which its distance to `p` is extreme.
fn feet(part: Part, p: Point, consider: &mut impl FnMut(Point)) {
    match part {
        Part::Circle(c, r) => {
            let d = p - c;
            let out = if d.norm() > 0.0 { d.normalize() } else { Vector::x() };
            consider(c + out * r);
            consider(c - out * r);
        }
        Part::Line(o, u) => consider(o + u * (p - o).dot(&u)),
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
