//! Obstacles as polygons, their vertices numbered (Fang 2009, §4.4 (1)).
//!
//! The thesis has polygons only. Here every inflated obstacle gets a polygon round
//! it: regular for a disc, two half polygons for a capsule, mitred corners for a
//! polygon (two where one would stick out too far). Its sides touch the inflated
//! obstacle grown by the world's ε, so lines along them are free.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use env_model::geometry::cross;
use env_model::{Core, Inflated, Point, Vector, World};

/// Writes the usable vertices of all obstacles into `out`, obstacle by obstacle,
/// counter-clockwise: vertex number v is `out[v − 1]`.
///
/// Left out, because no valid path turns there, are vertices where the robot
/// cannot stand: inside another obstacle or outside the field. A reflex corner of
/// a polygon has none: no path turns round it. Stops when `go_on`, asked before
/// each obstacle, says so. Returns the number of tests.
pub fn number_vertices(
    world: &World,
    corners: usize,
    mut go_on: impl FnMut() -> bool,
    out: &mut Vec<Point>,
    polygon: &mut Vec<Point>,
) -> u64 {
    out.clear();
    let mut tests = 0;
    for obstacle in world.obstacles().iter().take_while(|_| go_on()) {
        polygon.clear();
        surround(obstacle, corners, world.epsilon(), polygon);
        tests += polygon.len() as u64;
        out.extend(polygon.iter().filter(|p| world.point_free(**p)));
    }
    tests
}

/// Appends the corners of a polygon round `obstacle`, `gap` away from it.
fn surround(obstacle: &Inflated, corners: usize, gap: f64, out: &mut Vec<Point>) {
    let d = obstacle.radius + gap;
    match &obstacle.core {
        Core::Point(c) => cap(*c, Vector::new(1.0, 0.0), TAU, corners, d, out),
        Core::Segment(a, b) => {
            let axis = (b - a).normalize();
            let right = Vector::new(axis.y, -axis.x);
            let half = corners.div_ceil(2);
            cap(*b, right, PI, half, d, out);
            cap(*a, -right, PI, half, d, out);
        }
        Core::Polygon(polygon) => {
            let corners = polygon.corners();
            let n = corners.len();
            for i in 0..n {
                let (u, v) = (corners[i] - corners[(i + n - 1) % n], corners[(i + 1) % n] - corners[i]);
                let turn = libm::atan2(cross(u, v), u.dot(&v));
                if turn > 0.0 {
                    let outward = Vector::new(u.y, -u.x).normalize();
                    let pieces = if turn > FRAC_PI_2 { 2 } else { 1 };
                    cap(corners[i], outward, turn, pieces, d, out);
                }
            }
        }
    }
}

/// Appends the `pieces` corners of a polygon round the arc of radius `d` about
/// `centre` from the direction `normal` through `angle`: at distance
/// d/cos(angle/2 pieces), so that the sides between them touch the arc. The
/// first and the last side lie on the tangents at the arc's ends.
fn cap(centre: Point, normal: Vector, angle: f64, pieces: usize, d: f64, out: &mut Vec<Point>) {
    let half = 0.5 * angle / pieces as f64;
    let reach = d / libm::cos(half);
    out.extend((0..pieces).map(|i| {
        let turn = (2 * i + 1) as f64 * half;
        let (s, c) = (libm::sin(turn), libm::cos(turn));
        centre + Vector::new(normal.x * c - normal.y * s, normal.x * s + normal.y * c) * reach
    }));
}

#[cfg(test)]
mod tests {
    use env_model::{Obstacle, Scene, Shape};

    use super::*;

    fn world(obstacles: Vec<Obstacle>, robot_radius: f64) -> World {
        World::new(&Scene {
            name: "vertices".into(),
            unit: "m".into(),
            robot_radius,
            start: [-9.0, -9.0],
            goal: [9.0, 9.0],
            field: None,
            obstacles,
        })
        .unwrap()
    }

    fn vertices(world: &World, corners: usize) -> Vec<Point> {
        let mut out = Vec::new();
        number_vertices(world, corners, || true, &mut out, &mut Vec::new());
        out
    }

    fn close(found: &[Point], expected: &[[f64; 2]]) {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (p, e) in found.iter().zip(expected) {
            // ε is 1e-9 of a diagonal of 26; corners move by √2 of it or, at two pieces, less.
            assert!((p - Point::new(e[0], e[1])).norm() < 1e-7, "{p} for {e:?}");
        }
    }

    #[test]
    fn polygons_by_hand() {
        let square = Shape::Polygon(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        close(
            &vertices(&world(vec![square.clone().into()], 0.0), 8),
            &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        );
        let mitred = [[-0.5, -0.5], [1.5, -0.5], [1.5, 1.5], [-0.5, 1.5]];
        close(&vertices(&world(vec![square.into()], 0.5), 8), &mitred);
        let disc = Obstacle::disc(Point::new(2.0, 3.0), 1.0);
        close(&vertices(&world(vec![disc], 0.0), 4), &[[3.0, 4.0], [1.0, 4.0], [1.0, 2.0], [3.0, 2.0]]);
        let capsule = Shape::Capsule { from: [0.0, 0.0], to: [2.0, 0.0], radius: 1.0 };
        close(&vertices(&world(vec![capsule.into()], 0.0), 4), &[[3.0, -1.0], [3.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]]);
    }

    #[test]
    fn reflex_corners_and_unusable_vertices_have_no_number() {
        let l = Shape::Polygon(vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 4.0], [3.0, 1.0], [0.0, 1.0]]);
        let alone = vertices(&world(vec![l.clone().into()], 0.0), 8);
        close(&alone, &[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 4.0], [0.0, 1.0]]);
        let covered = world(vec![l.into(), Obstacle::disc(Point::new(4.0, 4.0), 0.5)], 0.0);
        let left = vertices(&covered, 4);
        assert!(!left.iter().any(|p| (p - Point::new(4.0, 4.0)).norm() < 0.5), "{left:?}");
    }

    /// Whatever the shape and however sharp: standing at a vertex and going to the next is free.
    #[test]
    fn sides_are_free() {
        let needle = Shape::Polygon(vec![[-3.0, 0.0], [3.0, -0.1], [3.0, 0.1]]);
        let capsule = Shape::Capsule { from: [-1.0, 2.0], to: [2.0, -1.5], radius: 0.3 };
        let shapes = [needle, capsule, Shape::Disc { centre: [1.0, 1.0], radius: 2.0 }];
        for shape in shapes {
            for (radius, corners) in [(0.0, 3), (0.0, 8), (0.7, 3), (0.7, 5), (0.7, 64)] {
                let world = world(vec![shape.clone().into()], radius);
                let found = vertices(&world, corners);
                assert!(found.len() >= 3);
                for (i, a) in found.iter().enumerate() {
                    let b = found[(i + 1) % found.len()];
                    assert!(world.segment_free(*a, b), "{shape:?} with {radius} and {corners}: side {i}");
                }
            }
        }
    }
}
