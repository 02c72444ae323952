//! Every structure against a plain loop over all obstacles: equal decisions, clearances and
//! indices, whatever the arrangement.
//!
//! The loop's narrow phase is the plainest form: distances by root and division, polygons by
//! a quadratic walk over all sides' cuts.

use env_model::geometry::{cross, point_segment_distance, segment_segment_distance};
use env_model::scene::Field;
use env_model::{Aabb, Core, Inflated, Obstacle, Point, Polygon, Scene, Shape, Vector, World};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Whether `a b` keeps −`slack`, by the definitions.
fn free(obstacle: &Inflated, a: Point, b: Point, slack: f64) -> bool {
    let reach = obstacle.radius - slack;
    match &obstacle.core {
        Core::Point(c) => reach <= 0.0 || point_segment_distance(*c, a, b) >= reach,
        Core::Segment(c, e) => reach <= 0.0 || segment_segment_distance(a, b, *c, *e) >= reach,
        Core::Polygon(polygon) if reach > 0.0 => {
            !polygon.contains(a) && polygon.sides().all(|(c, e)| segment_segment_distance(a, b, c, e) >= reach)
        }
        Core::Polygon(polygon) => !enters_deeper_than(polygon, a, b, -reach),
    }
}

/// Between every two cuts, the ends of the sides' near intervals and the corners' feet, one point.
fn enters_deeper_than(polygon: &Polygon, a: Point, b: Point, delta: f64) -> bool {
    let d = b - a;
    let deep = |t: f64| {
        let p = a + d * t;
        polygon.contains(p) && polygon.sides().all(|(c, e)| point_segment_distance(p, c, e) > delta)
    };
    if a == b {
        return deep(0.0);
    }
    let mut cuts: Vec<f64> = polygon
        .sides()
        .flat_map(|(c, e)| {
            let foot = (c - a).dot(&d) / d.norm_squared();
            let (t0, t1) = near_interval(a, d, c, e, delta).unwrap_or((foot, foot));
            [t0, t1, foot]
        })
        .filter(|t| *t > 0.0 && *t < 1.0)
        .chain([0.0, 1.0])
        .collect();
    cuts.sort_by(f64::total_cmp);
    cuts.windows(2).any(|w| deep(0.5 * (w[0] + w[1])))
}

/// The parameters of a + t d within `delta` of segment `c e`: the hull of those near its ends and over it.
fn near_interval(a: Point, d: Vector, c: Point, e: Point, delta: f64) -> Option<(f64, f64)> {
    let dd = d.norm_squared();
    let mut ends = Vec::new();
    for q in [c, e] {
        let (mid, off) = ((q - a).dot(&d) / dd, cross(d, q - a));
        let half2 = (delta * delta * dd - off * off) / (dd * dd);
        if half2 >= 0.0 {
            ends.extend([mid - half2.sqrt(), mid + half2.sqrt()]);
        }
    }
    let u = (e - c).normalize();
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for (n, from, to) in [(u, 0.0, (e - c).norm()), (Vector::new(-u.y, u.x), -delta, delta)] {
        let (at, rate) = ((a - c).dot(&n), d.dot(&n));
        if rate != 0.0 {
            let (t0, t1) = ((from - at) / rate, (to - at) / rate);
            (low, high) = (low.max(t0.min(t1)), high.min(t0.max(t1)));
        } else if at < from || at > to {
            high = f64::NEG_INFINITY;
        }
    }
    if low <= high {
        ends.extend([low, high]);
    }
    let least = ends.iter().copied().fold(f64::INFINITY, f64::min);
    (!ends.is_empty()).then(|| (least, ends.iter().copied().fold(f64::NEG_INFINITY, f64::max)))
}

struct Draw(ChaCha8Rng);

impl Draw {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn log(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.between(libm::log(low), libm::log(high)))
    }

    fn below(&mut self, n: usize) -> usize {
        (self.0.next_u64() % n as u64) as usize
    }

    /// In the unit square.
    fn point(&mut self) -> Point {
        Point::new(self.between(0.0, 1.0), self.between(0.0, 1.0))
    }

    fn direction(&mut self) -> Vector {
        let angle = self.between(0.0, std::f64::consts::TAU);
        Vector::new(libm::cos(angle), libm::sin(angle))
    }

    fn polygon(&mut self, centre: Point, scale: f64) -> Shape {
        let (n, turn) = (3 + self.below(7), self.between(0.0, 6.0));
        let star = self.below(2) == 0;
        let corners = (0..n).map(|i| {
            let angle = turn + i as f64 * std::f64::consts::TAU / n as f64;
            let radius = if star { scale * self.between(0.2, 1.0) } else { scale };
            (centre + Vector::new(libm::cos(angle), libm::sin(angle)) * radius).into()
        });
        Shape::Polygon(corners.collect())
    }

    /// A box with sides along the axes, or a third of them with a notch.
    fn blocks(&mut self, centre: Point, scale: f64) -> Shape {
        let (w, h) = (scale * self.between(0.3, 1.0), scale * self.between(0.3, 1.0));
        let (x, y) = (centre.x, centre.y);
        let mut corners = vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]];
        if self.below(3) == 0 {
            corners.splice(2..3, [[x + w, y + 0.5 * h], [x + 0.5 * w, y + 0.5 * h], [x + 0.5 * w, y + h]]);
        }
        Shape::Polygon(corners)
    }

    fn shape(&mut self, centre: Point, scale: f64) -> Shape {
        match self.below(8) {
            0 => self.polygon(centre, scale),
            1 => self.blocks(centre, scale),
            2 => {
                let to = (centre + self.direction() * (2.0 * scale)).into();
                Shape::Capsule { from: centre.into(), to, radius: 0.3 * scale }
            }
            _ => Shape::Disc { centre: centre.into(), radius: scale * self.between(0.1, 1.0) },
        }
    }
}

/// `count` obstacles in about the unit square.
fn arrangement(draw: &mut Draw, kind: &str, count: usize) -> Vec<Shape> {
    let usual = 0.3 / (count as f64).sqrt().max(1.0);
    let disc = |centre: Point, radius: f64| Shape::Disc { centre: centre.into(), radius };
    (0..count)
        .map(|i| {
            let centre = draw.point();
            match kind {
                "discs" => disc(centre, usual),
                "mixed sizes" => disc(centre, usual * draw.log(0.01, 3.0)),
                "a giant" => disc(centre, if i == count / 3 { 0.35 } else { 0.3 * usual }),
                "one place" => disc(Point::new(0.5, 0.5), usual * draw.between(0.5, 1.0)),
                "a line" => disc(Point::new(centre.x, 0.5), 0.3 * usual),
                "a steep line" => disc(Point::new(0.3 + 0.2 * centre.y, centre.y), 0.3 * usual),
                "clusters" => {
                    let middle = Point::new((i % 3) as f64 * 0.4 + 0.1, (i % 2) as f64 * 0.8);
                    disc(middle + (centre - Point::new(0.5, 0.5)) * 0.02, 0.02 * usual)
                }
                "shapes" => draw.shape(centre, usual),
                "polygons" => draw.polygon(centre, usual),
                "blocks" => draw.blocks(centre, usual),
                _ => unreachable!("{kind}"),
            }
        })
        .collect()
}

fn moved(shape: Shape, by: Vector) -> Shape {
    let to = |p: [f64; 2]| (Point::from(p) + by).into();
    match shape {
        Shape::Disc { centre, radius } => Shape::Disc { centre: to(centre), radius },
        Shape::Capsule { from, to: end, radius } => Shape::Capsule { from: to(from), to: to(end), radius },
        Shape::Polygon(corners) => Shape::Polygon(corners.into_iter().map(to).collect()),
    }
}

fn world(shapes: Vec<Shape>, robot_radius: f64, field: bool, by: Vector) -> World {
    let at = |x: f64, y: f64| (Point::new(x, y) + by).into();
    World::new(&Scene {
        name: "case".into(),
        unit: "m".into(),
        robot_radius,
        start: at(0.0, 0.0),
        goal: at(1.0, 1.0),
        field: field.then(|| Field { min: at(-0.2, -0.2), max: at(1.2, 1.2) }),
        obstacles: shapes.into_iter().map(|s| Obstacle::from(moved(s, by))).collect(),
    })
    .unwrap()
}

/// Segments of all lengths and directions, and some that touch, follow or end on obstacles.
fn query(draw: &mut Draw, world: &World, by: Vector) -> (Point, Point) {
    let a = draw.point() + by;
    let corner = |draw: &mut Draw| -> Point {
        let obstacles = world.obstacles();
        match obstacles.get(draw.below(obstacles.len().max(1))).map(|o| (&o.core, o.radius)) {
            Some((Core::Point(c), r)) => c + draw.direction() * r,
            Some((Core::Segment(c, _), r)) => c + draw.direction() * r,
            Some((Core::Polygon(p), _)) => p.corners()[draw.below(p.corners().len())],
            None => a,
        }
    };
    match draw.below(10) {
        0 => (a, a),
        1 => (a, a + Vector::new(draw.between(-1.0, 1.0), 0.0)),
        2 => (a, a + Vector::new(0.0, draw.between(-1.0, 1.0))),
        3 => (a, draw.point() + by),
        4 => (a + draw.direction() * 3.0, a + draw.direction() * 3.0),
        5 => (a + draw.direction() * 1e3, a + draw.direction() * 1e3),
        6 => (corner(draw), corner(draw)),
        7 => (corner(draw), a),
        8 => {
            let (c, d) = (corner(draw), draw.direction());
            (c - d * draw.log(1e-3, 1.0), c + d * draw.log(1e-3, 1.0))
        }
        _ => (a, a + draw.direction() * draw.log(1e-3, 0.3)),
    }
}

#[test]
fn all_answers_are_those_of_a_plain_loop() {
    let mut draw = Draw(ChaCha8Rng::seed_from_u64(64));
    let kinds = [
        "discs",
        "mixed sizes",
        "a giant",
        "one place",
        "a line",
        "a steep line",
        "clusters",
        "shapes",
        "polygons",
        "blocks",
    ];
    for kind in kinds {
        let (mut passed, mut blocked) = (0, 0);
        // Round the number up to which bits are used, and beyond.
        for (case, count) in [0, 1, 2, 7, 22, 63, 64, 65, 66, 150, 900].into_iter().enumerate() {
            // At most 10⁵ sizes from the origin: rounding is 1e-11 there, the slack a few 1e-10.
            let by = [Vector::zeros(), Vector::new(-3e3, 70.0), Vector::new(1e5, 1e5)][case % 3];
            for robot_radius in [0.0, 0.002] {
                let shapes = arrangement(&mut draw, kind, count);
                let world = world(shapes, robot_radius, case % 2 == 0, by);
                for _ in 0..if count > 100 { 60 } else { 200 } {
                    let (a, b) = query(&mut draw, &world, by);
                    let context = || format!("{count} {kind}, robot {robot_radius}, {a} to {b}");
                    let inside = world.field_clearance(a).min(world.field_clearance(b)) >= -world.slack();
                    let obstacles = world.obstacles();
                    let all = inside && obstacles.iter().all(|o| free(o, a, b, world.slack()));
                    assert_eq!(world.segment_free(a, b), all, "{}", context());
                    assert_eq!(world.segment_free(b, a), all, "reversed, {}", context());
                    (passed, blocked) = if all { (passed + 1, blocked) } else { (passed, blocked + 1) };

                    let least = obstacles.iter().enumerate().map(|(i, o)| (o.point_clearance(a), i));
                    let least = least
                        .fold(None, |m: Option<(f64, usize)>, c| if m.is_none_or(|m| c < m) { Some(c) } else { m });
                    assert_eq!(world.nearest_obstacle(a), least, "{}", context());
                    check_visits(&world, a, b, &context);
                }
            }
        }
        assert!(passed > 500 && blocked > 500, "{kind}: {passed} free, {blocked} blocked");
    }
}

/// What is visited: no obstacle twice, and all that the query could be about.
fn check_visits(world: &World, a: Point, b: Point, context: &dyn Fn() -> String) {
    let region = Aabb::of_points([&a, &b]);
    let (mut along, mut overlapping) = (Vec::new(), Vec::new());
    world.for_each_along(a, b, |i| along.push(i));
    world.for_each_overlapping(&region, |i| overlapping.push(i));
    for visited in [&mut along, &mut overlapping] {
        visited.sort_unstable();
        assert!(visited.windows(2).all(|w| w[0] < w[1]), "visited twice, {}", context());
    }
    for (i, obstacle) in world.obstacles().iter().enumerate() {
        if obstacle.aabb().overlaps(&region) {
            assert!(overlapping.binary_search(&i).is_ok(), "obstacle {i} left out, {}", context());
        }
        if !free(obstacle, a, b, 0.0) {
            assert!(along.binary_search(&i).is_ok(), "obstacle {i} left out, {}", context());
        }
    }
}

#[test]
fn convex_and_notched_polygons_decide_as_the_walk_over_all_cuts() {
    let mut draw = Draw(ChaCha8Rng::seed_from_u64(2009));
    let (mut deep, mut shallow) = (0, 0);
    for case in 0..20_000 {
        let centre = draw.point();
        let shape = if case % 2 == 0 { draw.polygon(centre, 0.3) } else { draw.blocks(centre, 0.3) };
        let Shape::Polygon(corners) = &shape else { unreachable!() };
        let polygon = Polygon::new(corners.iter().map(|c| (*c).into()).collect()).unwrap();
        let world = world(vec![shape], 0.0, false, Vector::zeros());
        let (a, b) = query(&mut draw, &world, Vector::zeros());
        let delta = [world.slack(), 1e-3, 0.03][case % 3];
        let expected = enters_deeper_than(&polygon, a, b, delta);
        // Where they differ, the depth is δ to rounding, 1e-12 of the longest query, and both are right.
        if polygon.enters_deeper_than(a, b, delta) != expected {
            let rounding = 1e-12 * a.coords.amax().max(b.coords.amax()).max(1.0);
            assert!(
                enters_deeper_than(&polygon, a, b, delta - rounding)
                    && !enters_deeper_than(&polygon, a, b, delta + rounding),
                "case {case}: {polygon:?} {a} {b} {delta}"
            );
        }
        (deep, shallow) = if expected { (deep + 1, shallow) } else { (deep, shallow + 1) };
    }
    assert!(deep > 3000 && shallow > 3000, "{deep} deeper, {shallow} not");
}
