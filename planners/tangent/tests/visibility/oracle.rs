//! A bracket of the exact optimum by two visibility graphs.
//!
//! Every inflated obstacle is replaced by polygons, once inscribed and once
//! circumscribed, of about k corners a turn. A shortest path among polygons is
//! a polyline that bends at their corners only, so Dijkstra's algorithm over
//! corners, start and goal finds it. Among inscribed polygons it is at most as
//! long as the optimum, among circumscribed ones at least as long; the bracket
//! narrows as 1/k² (arcs: (π/k)²/6 and (π/k)²/3 of their length).
//!
//! The optimum is taken among obstacles shrunk by the world's ε in a field grown
//! by ε. Inscribed polygons are those of shapes shrunk by 2 ε, circumscribed
//! ones those of the shapes as they are, and both may be entered by ε/16, far
//! above the rounding of all this (some 1e-14 of the scene's diagonal): both ends
//! of the bracket hold with room for rounding.
//!
//! Nothing here comes from `env_model::geometry`. Lozano-Pérez & Wesley 1979
//! (visibility graph); Cyrus & Beck 1978 (clipping a segment by a convex polygon).

use std::f64::consts::{PI, TAU};

use env_model::{Aabb, Core, Point, Vector, World, path_length};
use planner_api::Problem;

/// Which polygons stand for the obstacles.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stand {
    /// Inside the obstacles shrunk by 2 ε: paths are no longer than the optimum.
    Inscribed,
    /// Round the obstacles: paths are no shorter than the optimum.
    Circumscribed,
}

/// A polygon that a segment may touch but not enter.
#[derive(Debug)]
enum Member {
    /// The points with n·p ≤ h for all (n, h), n of length 1.
    Convex { corners: Vec<Point>, planes: Vec<(Vector, f64)> },
    /// A simple polygon, counter-clockwise.
    Simple { corners: Vec<Point> },
}

/// A point where a path may bend, and the corners next to it.
#[derive(Debug, Clone, Copy)]
struct Node {
    at: Point,
    before: Point,
    after: Point,
}

/// The polygons among which a path is sought.
#[derive(Debug)]
struct Region {
    members: Vec<Member>,
    /// The members' boxes: most segments are far from most members.
    boxes: Vec<Aabb>,
    field: Option<(Point, Point)>,
    /// How deep a segment may enter.
    depth: f64,
}

/// Lengths of the shortest paths among inscribed and circumscribed polygons of
/// `k` corners a turn; `None` where there is no path. By env-model's own measure,
/// the path among circumscribed polygons must be valid.
pub fn bracket(problem: &Problem<'_>, k: usize) -> (Option<f64>, Option<f64>) {
    let ends = [problem.start, problem.goal];
    let path = |stand| Region::new(problem.world, ends, stand, k).shortest(ends);
    let (low, high) = (path(Stand::Inscribed), path(Stand::Circumscribed));
    if let Some(high) = &high {
        assert_eq!(problem.world.first_violation(high), None, "the upper bound collides");
    }
    (low.map(|path| path_length(&path)), high.map(|path| path_length(&path)))
}

impl Region {
    fn new(world: &World, ends: [Point; 2], stand: Stand, k: usize) -> Self {
        let shrink = if stand == Stand::Inscribed { 2.0 * world.epsilon() } else { 0.0 };
        let cores: Vec<Vec<Vec<Point>>> = world.obstacles().iter().map(|o| convex_cores(&o.core)).collect();
        let mut members = Vec::new();
        for (i, obstacle) in world.obstacles().iter().enumerate() {
            if let Core::Polygon(polygon) = &obstacle.core {
                // A sharp polygon, or what the strips round the sides of a blunt one leave open.
                members.push(Member::Simple { corners: moved_in(polygon.corners(), shrink) });
                if obstacle.radius == 0.0 {
                    continue;
                }
            }
            for core in &cores[i] {
                // Where shapes nearly touch, and where an end nearly touches a shape, the
                // polygons must touch the shape: there the bracket is to tell open from closed.
                let mut towards: Vec<Vector> = ends.iter().map(|e| closest(core, &[*e]).1).collect();
                for (other, rivals) in
                    world.obstacles().iter().zip(&cores).enumerate().filter(|(j, _)| *j != i).map(|(_, o)| o)
                {
                    let reach = obstacle.radius + other.radius;
                    let nearest = rivals.iter().map(|rival| closest(core, rival));
                    towards.extend(nearest.filter(|(d, _)| (d - reach).abs() < 0.02 * reach).map(|(_, to)| to));
                }
                members.push(rounded(core, obstacle.radius - shrink, &normals(core, k, &towards), stand));
            }
        }
        let grow = Vector::new(shrink, shrink);
        let field = world.inner_field().map(|f| (f.min - grow, f.max + grow));
        let boxes = members.iter().map(|member| Aabb::of_points(member.corners())).collect();
        Self { members, boxes, field, depth: world.epsilon() / 16.0 }
    }

    /// Whether the segment stays in the field and enters no polygon.
    fn sees(&self, a: Point, b: Point) -> bool {
        let inside = |p: Point| {
            let d = self.depth;
            self.field.is_none_or(|(lo, hi)| p.x >= lo.x - d && p.y >= lo.y - d && p.x <= hi.x + d && p.y <= hi.y + d)
        };
        let way = Aabb::of_points([&a, &b]);
        let mut near = self.members.iter().zip(&self.boxes).filter(|(_, aabb)| aabb.overlaps(&way));
        inside(a) && inside(b) && !near.any(|(member, _)| member.entered(a, b, self.depth))
    }

    fn nodes(&self, ends: [Point; 2]) -> Vec<Node> {
        let mut nodes: Vec<Node> = ends.iter().map(|&at| Node { at, before: at, after: at }).collect();
        let same = |a: Point, b: Point| (a - b).norm() <= self.depth;
        for member in &self.members {
            let corners = member.corners();
            let n = corners.len();
            for i in 0..n {
                let node = Node { at: corners[i], before: corners[(i + n - 1) % n], after: corners[(i + 1) % n] };
                // No taut path bends round a corner that points inwards.
                let juts = cross(node.at - node.before, node.after - node.at) > 0.0;
                let known = |m: &Node| same(m.at, node.at) && same(m.before, node.before) && same(m.after, node.after);
                if juts && self.sees(node.at, node.at) && !nodes.iter().any(known) {
                    nodes.push(node);
                }
            }
        }
        nodes
    }

    /// Whether a taut path may run along `from`–`to`: both neighbours of either
    /// corner lie on one side of the line. Spares most pairs the test against all polygons.
    fn tangent(&self, from: &Node, to: &Node) -> bool {
        let along = to.at - from.at;
        let length = along.norm();
        if length <= self.depth {
            return true;
        }
        let grazes = |node: &Node| {
            let side = |p: Point| cross(along, p - node.at) / length;
            let (s, t) = (side(node.before), side(node.after));
            s * t >= 0.0 || s.abs().min(t.abs()) <= self.depth
        };
        grazes(from) && grazes(to)
    }

    /// The shortest path. A*, quadratic in the number of corners.
    fn shortest(&self, ends: [Point; 2]) -> Option<Vec<Point>> {
        let nodes = self.nodes(ends);
        let rest = |i: usize| (nodes[i].at - ends[1]).norm();
        let mut cost = vec![f64::INFINITY; nodes.len()];
        let mut done = vec![false; nodes.len()];
        let mut parent = vec![0; nodes.len()];
        cost[0] = 0.0;
        loop {
            let open = (0..nodes.len()).filter(|&i| !done[i] && cost[i].is_finite());
            let at = open.min_by(|&i, &j| (cost[i] + rest(i)).total_cmp(&(cost[j] + rest(j))))?;
            if at == 1 {
                let mut path = vec![ends[1]];
                let mut at = 1;
                while at != 0 {
                    at = parent[at];
                    path.push(nodes[at].at);
                }
                path.reverse();
                return Some(path);
            }
            done[at] = true;
            for i in 0..nodes.len() {
                let through = cost[at] + (nodes[i].at - nodes[at].at).norm();
                let better = !done[i] && through < cost[i];
                if better && self.tangent(&nodes[at], &nodes[i]) && self.sees(nodes[at].at, nodes[i].at) {
                    cost[i] = through;
                    parent[i] = at;
                }
            }
        }
    }
}

impl Member {
    fn corners(&self) -> &[Point] {
        let (Self::Convex { corners, .. } | Self::Simple { corners }) = self;
        corners
    }

    /// Whether some point of the segment lies inside, deeper than `depth`.
    fn entered(&self, a: Point, b: Point, depth: f64) -> bool {
        match self {
            Self::Convex { planes, .. } => enters_convex(planes, a, b, depth),
            Self::Simple { corners } => enters_simple(corners, a, b, depth),
        }
    }
}

/// Cuts the segment by every half-plane in turn; what is left lies inside.
fn enters_convex(planes: &[(Vector, f64)], a: Point, b: Point, depth: f64) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (n, h) in planes {
        let (at_a, at_b) = (n.dot(&a.coords) - h + depth, n.dot(&b.coords) - h + depth);
        if at_a >= 0.0 && at_b >= 0.0 {
            return false;
        }
        let crossing = at_a / (at_a - at_b);
        if at_a > 0.0 {
            from = from.max(crossing);
        } else if at_b > 0.0 {
            to = to.min(crossing);
        }
        if from >= to {
            return false;
        }
    }
    true
}

/// Cuts the segment where it crosses the lines of the sides and where it passes
/// the corners, and looks at three points of every piece: a piece lies inside or
/// outside as a whole, and not all three points are near the border unless all of it is.
fn enters_simple(corners: &[Point], a: Point, b: Point, depth: f64) -> bool {
    let n = corners.len();
    let sides = || (0..n).map(|i| (corners[i], corners[(i + 1) % n]));
    let deep = |p: Point| {
        let mut inside = false;
        for (c, e) in sides() {
            if distance(p, c, e) <= depth {
                return false;
            }
            // A ray to the right crosses the side.
            if (c.y > p.y) != (e.y > p.y) && p.x < c.x + (p.y - c.y) / (e.y - c.y) * (e.x - c.x) {
                inside = !inside;
            }
        }
        inside
    };
    let along = b - a;
    let square = along.norm_squared();
    if square == 0.0 {
        return deep(a);
    }
    let mut cuts = vec![0.0, 1.0];
    for (c, e) in sides() {
        let slope = cross(along, e - c);
        cuts.extend((slope != 0.0).then(|| cross(c - a, e - c) / slope));
        cuts.push((c - a).dot(&along) / square);
    }
    cuts.retain(|t| (0.0..=1.0).contains(t));
    cuts.sort_by(f64::total_cmp);
    cuts.windows(2).any(|w| [0.25, 0.5, 0.75].iter().any(|part| deep(a + along * (w[0] + (w[1] - w[0]) * part))))
}

fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

fn unit(angle: f64) -> Vector {
    Vector::new(angle.cos(), angle.sin())
}

/// The point of segment `a b` nearest to `p`.
fn foot(p: Point, a: Point, b: Point) -> Point {
    let along = b - a;
    let square = along.norm_squared();
    if square == 0.0 { a } else { a + along * ((p - a).dot(&along) / square).clamp(0.0, 1.0) }
}

fn distance(p: Point, a: Point, b: Point) -> f64 {
    (p - foot(p, a, b)).norm()
}

/// Distance of two disjoint convex cores and the way from a nearest point of
/// `from` to one of `to`. Where they cross the answer means nothing.
fn closest(from: &[Point], to: &[Point]) -> (f64, Vector) {
    let sides = |core: &[Point]| -> Vec<_> { (0..core.len()).map(|i| (core[i], core[(i + 1) % core.len()])).collect() };
    let mut best = (f64::INFINITY, Vector::zeros());
    let mut consider = |way: Vector| {
        if way.norm() < best.0 {
            best = (way.norm(), way);
        }
    };
    from.iter().for_each(|p| sides(to).into_iter().for_each(|(a, b)| consider(foot(*p, a, b) - p)));
    to.iter().for_each(|p| sides(from).into_iter().for_each(|(a, b)| consider(p - foot(*p, a, b))));
    best
}

/// Convex cores whose inflations together are the inflation of `core`, but for the
/// middle of a polygon that is not convex, which its sides wall in.
fn convex_cores(core: &Core) -> Vec<Vec<Point>> {
    match core {
        Core::Point(c) => vec![vec![*c]],
        Core::Segment(a, b) if a == b => vec![vec![*a]],
        Core::Segment(a, b) => vec![vec![*a, *b]],
        Core::Polygon(polygon) => {
            let corners = polygon.corners();
            let n = corners.len();
            let turn = |i: usize| cross(corners[(i + 1) % n] - corners[i], corners[(i + 2) % n] - corners[(i + 1) % n]);
            if (0..n).all(|i| turn(i) > 0.0) {
                vec![corners.to_vec()]
            } else {
                (0..n).map(|i| vec![corners[i], corners[(i + 1) % n]]).collect()
            }
        }
    }
}

/// A simple polygon with every side moved in by `by`. At corners that point
/// inwards this takes away more than all points within `by` of the border, elsewhere just these.
fn moved_in(corners: &[Point], by: f64) -> Vec<Point> {
    let n = corners.len();
    (0..n)
        .map(|i| {
            let (u, v) = (corners[i] - corners[(i + n - 1) % n], corners[(i + 1) % n] - corners[i]);
            let (u, v) = (u / u.norm(), v / v.norm());
            // The inward normals m, w of both sides: the corner moves to x with m·x = w·x = by.
            let sum = Vector::new(-u.y - v.y, u.x + v.x);
            corners[i] + sum * (by * 2.0 / sum.norm_squared())
        })
        .collect()
}

/// Angles of outward normals, ascending: those of the core's sides, those of
/// `towards`, and in between some of `k` a turn.
fn normals(core: &[Point], k: usize, towards: &[Vector]) -> Vec<f64> {
    let step = TAU / k as f64;
    let mut angles: Vec<f64> = Vec::new();
    let mut add = |angle: f64, apart: f64| {
        let off = |other: &f64| {
            let d = (angle - other).abs() % TAU;
            d.min(TAU - d)
        };
        if angles.iter().all(|other| off(other) > apart) {
            angles.push(angle);
        }
    };
    // Sides shorter than a millionth of a turn would have no direction; leaving them
    // out moves the border by 1e-12 of the radius.
    if core.len() > 1 {
        for i in 0..core.len() {
            let side = core[(i + 1) % core.len()] - core[i];
            add((-side.x).atan2(side.y), 0.0);
        }
    }
    if core.len() == 2 {
        let axis = core[1] - core[0];
        add(axis.y.atan2(axis.x), 1e-6);
        add((-axis.y).atan2(-axis.x), 1e-6);
    }
    towards.iter().filter(|v| v.norm() > 0.0).for_each(|v| add(v.y.atan2(v.x), 1e-6));
    (0..k).for_each(|i| add(step * i as f64 - PI, step / 8.0));
    angles.sort_by(f64::total_cmp);
    angles
}

/// The polygon that stands for all points within `radius` of a convex core.
///
/// Circumscribed: the half-planes with these normals that touch the shape.
/// Inscribed: the hull of the points where they touch it.
fn rounded(core: &[Point], radius: f64, angles: &[f64], stand: Stand) -> Member {
    let reach = |n: &Vector| core.iter().map(|p| p.coords.dot(n)).fold(f64::NEG_INFINITY, f64::max);
    let mut corners: Vec<Point> = Vec::new();
    // Planes come from the angles, not the corners: sides may be too short to have a direction.
    let mut planes: Vec<_> = angles.iter().map(|&a| unit(a)).map(|n| (n, reach(&n) + radius)).collect();
    for (i, &from) in angles.iter().enumerate() {
        let to = angles.get(i + 1).copied().unwrap_or(angles[0] + TAU);
        let (middle, half) = (unit(0.5 * (from + to)), 0.5 * (to - from));
        // Between two neighbouring normals one corner of the core juts out farthest.
        let jut = core.iter().max_by(|a, b| a.coords.dot(&middle).total_cmp(&b.coords.dot(&middle)));
        let jut = *jut.expect("a core has points");
        match stand {
            Stand::Circumscribed => corners.push(jut + middle * (radius / half.cos())),
            Stand::Inscribed => {
                corners.extend([jut + unit(from) * radius, jut + unit(to) * radius]);
                planes.push((middle, jut.coords.dot(&middle) + radius * half.cos()));
            }
        }
    }
    corners.dedup_by(|a, b| (*a - *b).norm() <= 1e-9 * radius);
    if (corners[0] - corners[corners.len() - 1]).norm() <= 1e-9 * radius {
        corners.pop();
    }
    Member::Convex { corners, planes }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::FAMILIES;

    /// With that and convexity, inscribed polygons lie in the obstacles shrunk by ε;
    /// that circumscribed ones cover them is what `bracket` checks.
    #[test]
    fn inscribed_corners_lie_deeper_than_epsilon() {
        let mut corners_seen = 0;
        for scene in FAMILIES.iter().flat_map(|family| family.scenes().step_by(5)) {
            let world = World::new(&scene).unwrap();
            let region = Region::new(&world, [scene.start(), scene.goal()], Stand::Inscribed, 32);
            for member in &region.members {
                for &corner in member.corners() {
                    let (clearance, obstacle) = world.nearest_obstacle(corner).unwrap();
                    let deep = -clearance / world.epsilon();
                    // Two ε by construction; rounding takes some 1e-5 of it.
                    assert!(deep > 1.99, "{} {obstacle}: {corner} is {deep} ε deep", scene.name);
                    corners_seen += 1;
                }
            }
        }
        assert!(corners_seen > 10_000, "{corners_seen}");
    }

    #[test]
    fn both_ways_to_test_a_segment_agree_on_convex_polygons() {
        let mut state = 7;
        let mut draw = || planner_api::seed::splitmix64(&mut state) as f64 / u64::MAX as f64;
        let mut entered = 0;
        for _ in 0..200 {
            let core: Vec<_> = (0..6).map(|i| Point::origin() + unit(f64::from(i) + 0.8 * draw()) * 2.0).collect();
            let angles = normals(&core, 3, &[]);
            let Member::Convex { corners, planes } = rounded(&core, 0.0, &angles, Stand::Circumscribed) else {
                panic!("rounded gives convex members")
            };
            for _ in 0..50 {
                let [a, b] = [(); 2].map(|()| Point::new(6.0 * draw() - 3.0, 6.0 * draw() - 3.0));
                let depth = 0.3 * draw() * draw();
                let convex = enters_convex(&planes, a, b, depth);
                // The plain test looks at three points of a piece, which may miss the deep part of it.
                assert!(convex || !enters_simple(&corners, a, b, depth), "{a} {b} {depth}");
                assert_eq!(enters_convex(&planes, a, b, 1e-9), enters_simple(&corners, a, b, 1e-9), "{a} {b}");
                entered += u32::from(convex);
            }
        }
        assert!((1000..9000).contains(&entered), "{entered} of 10000");
    }
}
