//! Out of an obstacle, or off the field, by the shortest way.

use env_model::motion::Mover;
use env_model::{Core, Inflated, Point, Vector, World};
use libm::{cos, sin};

/// Directions tried where no shape's own way out is free.
const DIRECTIONS: usize = 16;
/// Rings of them, each 1.5 times as wide as the one before.
const RINGS: usize = 24;

/// The nearest point to `p` that is free of the world and of the movers as they stand now; `p` itself where it is
/// free. Exact out of a single obstacle, border or corner of two; of more, the best of a fan of points, which
/// is somewhat further than the nearest. `None` where the fan finds none.
pub fn nearest_free(world: &World, movers: &[Mover<'_>], p: Point) -> Option<Point> {
    let free = |q: Point| world.point_free(q) && movers.iter().all(|m| m.shape.point_clearance(q) >= 0.0);
    if free(p) {
        return Some(p);
    }
    let inside =
        world.inner_field().map_or(p, |f| Point::new(p.x.clamp(f.min.x, f.max.x), p.y.clamp(f.min.y, f.max.y)));
    let mut best: Option<(f64, Point)> = None;
    let mut consider = |q: Point| {
        let d = (q - p).norm_squared();
        if best.is_none_or(|(least, _)| d < least) && free(q) {
            best = Some((d, q));
        }
    };
    consider(inside);
    let shapes: Vec<&Inflated> = world.obstacles().iter().chain(movers.iter().map(|m| &m.shape)).collect();
    let near: Vec<&Inflated> = shapes.into_iter().filter(|s| s.point_clearance(inside) < 0.0).collect();
    for shape in &near {
        ways_out(shape, inside, world.epsilon(), &mut consider);
    }
    let deepest = near.iter().map(|s| -s.point_clearance(inside)).fold(world.epsilon(), f64::max);
    let mut radius = deepest;
    for _ in 0..RINGS {
        for i in 0..DIRECTIONS {
            let angle = std::f64::consts::TAU * i as f64 / DIRECTIONS as f64;
            consider(inside + Vector::new(cos(angle), sin(angle)) * radius);
        }
        radius *= 1.5;
    }
    best.map(|(_, q)| q)
}

/// Points just outside `shape` that are nearest to `p`, which lies inside.
fn ways_out(shape: &Inflated, p: Point, epsilon: f64, consider: &mut impl FnMut(Point)) {
    let reach = shape.radius + epsilon;
    let mut from = |core: Point| {
        let d = p - core;
        let n = d.norm();
        let out = if n > 0.0 { d / n } else { Vector::x() };
        consider(core + out * reach);
        consider(core - out * reach);
    };
    match &shape.core {
        Core::Point(c) => from(*c),
        Core::Segment(a, b) => from(env_model::geometry::closest_point(p, *a, *b)),
        Core::Polygon(polygon) => {
            let corners = polygon.corners();
            for (i, a) in corners.iter().enumerate() {
                from(env_model::geometry::closest_point(p, *a, corners[(i + 1) % corners.len()]));
            }
        }
    }
}
