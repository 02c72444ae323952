//! Random overlapping discs against an independent bracket, and the symmetries of the plane.

use env_model::geometry::point_segment_distance;
use env_model::{Point, Vector};
use planner_tangent::{Outcome, Solver};
use proptest::prelude::*;

type Discs = Vec<(Point, f64)>;

/// Points on every circle of the visibility graphs.
const SAMPLES: usize = 40;

/// Shortest path over a dense visibility graph: `SAMPLES` nodes round every
/// disc at `rim` · r, edges that keep `core` · r from every centre. Dijkstra, O(n²).
fn visibility(discs: &Discs, start: Point, goal: Point, rim: f64, core: f64) -> Option<f64> {
    let mut nodes = vec![start, goal];
    for &(c, r) in discs {
        for i in 0..SAMPLES {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / SAMPLES as f64).sin_cos();
            nodes.push(c + Vector::new(cos, sin) * (rim * r));
        }
    }
    let free = |a: Point, b: Point| discs.iter().all(|&(c, r)| point_segment_distance(c, a, b) >= core * r);
    nodes.retain(|&p| free(p, p));
    let mut cost = vec![f64::INFINITY; nodes.len()];
    let mut done = vec![false; nodes.len()];
    cost[0] = 0.0;
    loop {
        let at = (0..nodes.len()).filter(|&i| !done[i]).min_by(|&i, &j| cost[i].total_cmp(&cost[j]))?;
        if at == 1 || cost[at].is_infinite() {
            return cost[at].is_finite().then_some(cost[at]);
        }
        done[at] = true;
        for i in 0..nodes.len() {
            let through = cost[at] + (nodes[i] - nodes[at]).norm();
            if !done[i] && through < cost[i] && free(nodes[at], nodes[i]) {
                cost[i] = through;
            }
        }
    }
}

/// Every valid path of the graph is a valid path among the discs: an upper bound.
fn upper(discs: &Discs, start: Point, goal: Point) -> Option<f64> {
    visibility(discs, start, goal, 1.0 / (std::f64::consts::PI / SAMPLES as f64).cos(), 1.0)
}

/// The polygons inscribed in the discs let through at least what the discs do,
/// and the shortest path among polygons bends at corners only. The graph's test
/// lets through even more, because the polygons contain discs of r cos(π/SAMPLES):
/// a lower bound.
fn lower(discs: &Discs, start: Point, goal: Point) -> Option<f64> {
    // 1e-9 off, because sides of the polygon touch the inner disc exactly.
    visibility(discs, start, goal, 1.0, (std::f64::consts::PI / SAMPLES as f64).cos() * (1.0 - 1e-9))
}

fn solve(discs: &Discs, start: Point, goal: Point) -> Option<f64> {
    match Solver::new().shortest(discs, start, goal) {
        Outcome::Found { length } => Some(length),
        _ => None,
    }
}

fn point(half: f64) -> impl Strategy<Value = Point> {
    (-half..half, -half..half).prop_map(|(x, y)| Point::new(x, y))
}

/// Up to `count` discs in the middle, start and goal on either side of it or in it, but outside all discs.
fn scene(count: usize, radius: f64) -> impl Strategy<Value = (Discs, Point, Point)> {
    let discs = prop::collection::vec((point(4.0), 0.1 * radius..radius), 1..count);
    (discs, -6.0..-2.0, 2.0..6.0, point(3.0)).prop_map(|(mut discs, left, right, y)| {
        let (start, goal) = (Point::new(left, y.x), Point::new(right, y.y));
        discs.retain(|(c, r)| (c - start).norm() > *r && (c - goal).norm() > *r);
        (discs, start, goal)
    })
}

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn the_length_lies_between_the_visibility_graphs((discs, start, goal) in scene(24, 1.8)) {
        let (low, high) = (lower(&discs, start, goal), upper(&discs, start, goal));
        match solve(&discs, start, goal) {
            Some(length) => {
                // Rounding of a few dozen summands.
                prop_assert!(low.is_some_and(|low| low <= length * (1.0 + 1e-13)), "{length} under {low:?}");
                prop_assert!(high.is_none_or(|high| length <= high * (1.0 + 1e-13)), "{length} over {high:?}");
            }
            None => prop_assert!(high.is_none(), "infeasible, but there is a path of {high:?}"),
        }
    }
}

proptest! {
    #![proptest_config(cases(500))]

    #[test]
    fn moving_mirroring_and_scaling_carry_over(
        (discs, start, goal) in scene(40, 1.5),
        angle in 0.0..std::f64::consts::TAU,
        shift in point(10.0),
        exponent in -3.0..6.0,
        mirrored: bool,
        swapped: bool,
    ) {
        let scale = f64::powf(10.0, exponent);
        let (sin, cos) = angle.sin_cos();
        let map = |p: Point| {
            let p = Point::new(p.x, if mirrored { -p.y } else { p.y });
            Point::new(p.x * cos - p.y * sin + shift.x, p.x * sin + p.y * cos + shift.y) * scale
        };
        let moved: Discs = discs.iter().rev().map(|&(c, r)| (map(c), r * scale)).collect();
        let ends = if swapped { (map(goal), map(start)) } else { (map(start), map(goal)) };
        match (solve(&discs, start, goal), solve(&moved, ends.0, ends.1)) {
            // Moving rounds coordinates by 1e-15, and a path among nearly touching
            // discs reacts by the square root of that where it leaves them.
            (Some(a), Some(b)) => prop_assert!((b / scale / a - 1.0).abs() < 1e-11, "{a} became {}", b / scale),
            (a, b) => prop_assert_eq!(a.is_some(), b.is_some()),
        }
    }

    #[test]
    fn adding_a_disc_never_shortens((mut discs, start, goal) in scene(30, 1.5)) {
        let all = solve(&discs, start, goal);
        discs.pop();
        let fewer = solve(&discs, start, goal);
        match (fewer, all) {
            (Some(fewer), Some(all)) => prop_assert!(fewer <= all * (1.0 + 1e-12), "{fewer} against {all}"),
            (fewer, all) => prop_assert!(all.is_none() || fewer.is_some()),
        }
    }
}
