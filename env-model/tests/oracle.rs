//! The narrow phase against parry's segments, by brute force: acceptance of the exact collision.
//!
//! The oracle takes from parry only projections of points on segments, nearest points of two
//! segments, and point-in-polygon; radii are subtracted here. It shares no code with `env-model`.

mod common;

use common::{Draw, core, inside, point_oracle, point_segment, pv, sides};
use env_model::{Aabb, Inflated, Obstacle, Point, Polygon, Scene, Shape, Vector, World};
use parry2d_f64::math::Pose;
use parry2d_f64::query::details::distance_segment_segment;
use parry2d_f64::shape::Segment;

/// Relative to the diagonal of the box round shape and segment: the ε of the project.
const BAND: f64 = 1e-9;

/// Every term is the distance of two points of the segments, so the least is the nearest to the truth:
/// parry's pair alone is off by up to 3e-8 of the length for nearly parallel segments.
fn segment_segment(a: Point, b: Point, c: Point, d: Point) -> f64 {
    let parry = distance_segment_segment(&Pose::IDENTITY, &Segment::new(pv(a), pv(b)), &Segment::new(pv(c), pv(d)));
    parry
        .min(point_segment(a, c, d))
        .min(point_segment(b, c, d))
        .min(point_segment(c, a, b))
        .min(point_segment(d, a, b))
}

/// What the oracle says of the segment: outside, its clearance; for a polygon whose inside it
/// enters, an upper bound of it, the least of a few points'.
#[derive(Debug, Clone, Copy)]
struct Answer {
    clearance: f64,
    enters_polygon: bool,
}

fn oracle(shape: &Shape, robot_radius: f64, a: Point, b: Point) -> Answer {
    let (corners, radius) = core(shape);
    let reach = radius + robot_radius;
    match corners.as_slice() {
        [c] => Answer { clearance: point_segment(*c, a, b) - reach, enters_polygon: false },
        [c, d] => Answer { clearance: segment_segment(a, b, *c, *d) - reach, enters_polygon: false },
        _ => {
            let border = sides(&corners).map(|(c, d)| segment_segment(a, b, c, d)).fold(f64::INFINITY, f64::min);
            let points = (0..=16).map(|i| point_oracle(shape, robot_radius, a + (b - a) * (f64::from(i) / 16.0)));
            let clearance = points.fold(border - reach, f64::min);
            Answer { clearance, enters_polygon: inside(a, &corners) || clearance < -reach }
        }
    }
}

fn scene(obstacles: Vec<Obstacle>, robot_radius: f64, a: Point, b: Point) -> Scene {
    // A zero-length segment still needs a scene whose ends differ.
    let goal = if a == b { a + Vector::new(a.coords.amax().max(1e-3) * 1e-3, 0.0) } else { b };
    Scene {
        name: "case".into(),
        unit: "m".into(),
        robot_radius,
        start: a.into(),
        goal: goal.into(),
        field: None,
        obstacles,
    }
}

/// A segment placed by `mode`, and the clearance that its construction promises, if any.
fn segment(draw: &mut Draw, mode: usize, shape: &Shape, robot: f64, scale: f64) -> (Point, Point, Option<f64>) {
    let (corners, radius) = core(shape);
    let reach = radius + robot;
    let middle = nalgebra::center(&corners[0], &corners[corners.len() / 2]);
    let any = |draw: &mut Draw| draw.point(middle, 2.5 * scale);
    match mode {
        // Anywhere.
        0 => (any(draw), any(draw), None),
        // Grazing: along a supporting line of the inflated shape, at a tiny signed offset.
        1..=3 => {
            let n = draw.direction();
            let support = corners.iter().copied().max_by(|p, q| p.coords.dot(&n).total_cmp(&q.coords.dot(&n))).unwrap();
            let offset = draw.sign() * draw.log(1e-13, 1e-1) * scale;
            let foot = support + n * (reach + offset);
            let along = Vector::new(-n.y, n.x);
            let stretch = if mode == 3 { 100.0 } else { 3.0 } * scale;
            let (a, b) = (foot - along * draw.between(0.0, stretch), foot + along * draw.between(0.0, stretch));
            // Deeper than the radius the line is over the core's edge and depth is another matter.
            (a, b, (reach + offset > 0.0).then_some(offset))
        }
        // Pointing away from a supporting line, one end at a tiny signed offset.
        4 => {
            let n = draw.direction();
            let support = corners.iter().copied().max_by(|p, q| p.coords.dot(&n).total_cmp(&q.coords.dot(&n))).unwrap();
            let offset = draw.sign() * draw.log(1e-13, 1e-1) * scale;
            let near = support + n * (reach + offset);
            (near, near + n * draw.between(0.0, 3.0) * scale, (reach + offset > 0.0).then_some(offset))
        }
        // Zero length.
        5 => {
            let p = any(draw);
            (p, p, None)
        }
        // From the core out.
        6 => {
            let c = corners[draw.below(corners.len())];
            (c + (middle - c) * draw.between(0.0, 0.5), any(draw), None)
        }
        // Through a corner of the core.
        7 => {
            let (c, d) = (corners[draw.below(corners.len())], draw.direction() * scale);
            (c - d * draw.between(0.0, 3.0), c + d * draw.between(0.0, 3.0), None)
        }
        // Along a side, beyond both its ends or within it.
        8 => {
            let i = draw.below(corners.len());
            let (c, e) = (corners[i], corners[(i + 1) % corners.len()]);
            (c - (e - c) * draw.between(-0.4, 1.0), e + (e - c) * draw.between(-0.4, 1.0), None)
        }
        // Nearly along a side, and from its very corner.
        _ => {
            let i = draw.below(corners.len());
            let (c, e) = (corners[i], corners[(i + 1) % corners.len()]);
            (c, e + draw.direction() * (draw.log(1e-13, 1e-2) * scale), None)
        }
    }
}

#[test]
fn random_segments_agree_with_parry() {
    const CASES: usize = 140_000;
    let mut draw = Draw::new(2012);
    let (mut in_band, mut entering, mut blocked, mut worst) = (0, 0, 0, 0.0f64);
    for case in 0..CASES {
        let scale = draw.log(1e-2, 1e4);
        let centre = draw.point(Point::origin(), 3.0 * scale);
        let shape = draw.shape(case % 4, centre, scale);
        let robot = if draw.below(3) == 0 { 0.0 } else { scale * draw.log(1e-3, 0.5) };
        let mode = (case / 4) % 10;
        let (a, b, promised) = segment(&mut draw, mode, &shape, robot, scale);
        let expected = oracle(&shape, robot, a, b);

        // Start and goal of a scene must differ; the segment's ends need not.
        let goal = if (b - a).norm() > 1e-6 * scale { b } else { a + Vector::new(scale, scale) };
        let scene = scene(vec![shape.clone().into()], robot, a, goal);
        let world = World::new(&scene).unwrap();
        let band = BAND * scene.aabb().diagonal();
        let inflated = &world.obstacles()[0];
        let clearance = world.segment_clearance(a, b);
        let context = || format!("case {case}, mode {mode}: {shape:?} + {robot}, {a} to {b}");

        if expected.enters_polygon || expected.clearance + robot <= band && matches!(shape, Shape::Polygon(_)) {
            // Depth is compared with dense sampling below; here only that it is no less than any point's.
            entering += 1;
            assert!(clearance <= expected.clearance.min(-robot) + band, "{clearance}, {}", context());
        } else {
            let error = (clearance - expected.clearance).abs() / band;
            worst = worst.max(error);
            assert!(error <= 1.0, "{clearance}, parry {expected:?}, {}", context());
        }
        if let Some(promised) = promised {
            assert!((clearance - promised).abs() <= band, "{clearance}, built at {promised}, {}", context());
        }
        if expected.clearance.abs() <= band {
            in_band += 1;
            continue;
        }
        let free = expected.clearance > 0.0;
        blocked += usize::from(!free);
        assert_eq!(inflated.segment_free(a, b, 0.0), free, "{clearance}, {expected:?}, {}", context());
        assert_eq!(world.segment_free(a, b), free, "{clearance}, {expected:?}, {}", context());
        assert_eq!(world.segment_free(b, a), free, "reversed, {}", context());
        // Bisection on depth in polygons is slow; a share of the cases will do.
        if case % 401 < 20 {
            assert_eq!(clearance, inflated.segment_clearance(a, b), "broad phase, {}", context());
            assert_eq!(world.first_violation(&[a, b]).is_none(), free, "verdict, {}", context());
        }
    }
    println!(
        "{CASES} cases: {in_band} in the band, {entering} enter a polygon, {blocked} blocked, worst error {worst:.1e} bands"
    );
    assert!(CASES - in_band >= 100_000, "only {} cases decide anything", CASES - in_band);
    assert!(blocked > CASES / 4 && CASES - in_band - blocked > CASES / 5, "both answers must be common: {blocked}");
}

#[test]
fn depth_in_polygons_agrees_with_dense_sampling() {
    const SAMPLES: usize = 400;
    let mut draw = Draw::new(7);
    let mut entering = 0;
    for case in 0..2000 {
        let scale = draw.log(1e-2, 1e4);
        let centre = draw.point(Point::origin(), 3.0 * scale);
        let shape = draw.shape(2 + case % 2, centre, scale);
        let (a, b) = (draw.point(centre, 1.5 * scale), draw.point(centre, 1.5 * scale));
        let polygon = Polygon::new(core(&shape).0).unwrap();
        let depth = polygon.segment_signed_distance(a, b);
        let sampled = (0..=SAMPLES)
            .map(|i| point_oracle(&shape, 0.0, a + (b - a) * (i as f64 / SAMPLES as f64)))
            .fold(f64::INFINITY, f64::min);
        // Rounding; and between samples the distance changes by at most half the step.
        let rounding = 1e-12 * scale;
        let between = 0.5 * (b - a).norm() / SAMPLES as f64;
        assert!(depth <= sampled + rounding, "case {case}: {depth} is shallower than a sample, {sampled}");
        assert!(depth >= sampled - between - rounding, "case {case}: {depth} is deeper than any sample, {sampled}");
        entering += usize::from(depth < 0.0);
    }
    assert!(entering > 500, "{entering} of 2000 enter");
}

fn mixed(draw: &mut Draw, count: usize, field: f64) -> Vec<Obstacle> {
    (0..count)
        .map(|_| {
            let (kind, centre) = (draw.below(4), draw.point(Point::origin(), field));
            let scale = field * draw.log(0.003, 0.3) / (count as f64).sqrt().max(1.0) * 4.0;
            draw.shape(kind, centre, scale).into()
        })
        .collect()
}

#[test]
fn broad_phase_agrees_with_trying_every_obstacle() {
    let mut draw = Draw::new(99);
    let (mut free, mut blocked, mut in_band) = (0, 0, 0);
    for count in [1, 2, 3, 4, 5, 8, 9, 17, 50, 200, 700, 2000] {
        for robot in [0.0, 0.02] {
            let obstacles = mixed(&mut draw, count, 1.0);
            let corner = Point::new(-1.2, -1.2);
            let scene = scene(obstacles, robot, corner, -corner);
            let world = World::new(&scene).unwrap();
            let band = BAND * scene.aabb().diagonal();
            for _ in 0..60 {
                let a = draw.point(Point::origin(), 1.2);
                let length = draw.log(1e-2, 2.4);
                let b = a + draw.direction() * length;
                let least = |f: &dyn Fn(&Inflated) -> f64| {
                    world
                        .obstacles()
                        .iter()
                        .enumerate()
                        .map(|(i, o)| (f(o), i))
                        .fold((f64::INFINITY, usize::MAX), |m, c| if c < m { c } else { m })
                };
                // The same narrow phase on every obstacle: equal to the bit.
                let nearest = least(&|o| o.point_clearance(a));
                assert_eq!(world.nearest_obstacle(a), Some(nearest), "{count} obstacles, {a}");
                assert_eq!(world.point_clearance(a), nearest.0);
                let along = least(&|o| o.segment_clearance(a, b)).0;
                assert_eq!(world.segment_clearance(a, b), along, "{count} obstacles, {a} to {b}");
                let all = world.obstacles().iter().all(|o| o.segment_free(a, b, world.slack()));
                assert_eq!(world.segment_free(a, b), all, "{count} obstacles, {a} to {b}");
                // And parry's on every obstacle: equal outside the band.
                let parry =
                    scene.obstacles.iter().map(|o| point_oracle(&o.shape, robot, a)).fold(f64::INFINITY, f64::min);
                assert!((parry - nearest.0).abs() <= band, "{parry} {nearest:?}");
                let parry = scene
                    .obstacles
                    .iter()
                    .map(|o| oracle(&o.shape, robot, a, b).clearance)
                    .fold(f64::INFINITY, f64::min);
                if parry.abs() <= band {
                    in_band += 1;
                } else {
                    assert_eq!(all, parry > 0.0, "{count} obstacles, {a} to {b}: {parry}");
                }
                (free, blocked) = if all { (free + 1, blocked) } else { (free, blocked + 1) };
                check_violation(&world, &[a, b, draw.point(b, 0.3)]);
            }
        }
    }
    println!("{free} free, {blocked} blocked, {in_band} in the band");
    assert!(free > 200 && blocked > 200, "both answers must be common: {free} free, {blocked} blocked");
}

/// The first violation is where the clearance over a prefix drops below −ε: nothing is wrong before, all is there.
fn check_violation(world: &World, path: &[Point]) {
    let deepest = |i: usize, a: Point, b: Point| world.obstacles()[i].segment_clearance(a, b);
    match world.first_violation(path) {
        None => assert!(path.windows(2).all(|w| world.segment_clearance(w[0], w[1]) >= -world.epsilon())),
        Some(v) => {
            let (a, b) = (path[v.segment], path[v.segment + 1]);
            let obstacle = v.obstacle.expect("no field");
            assert!(path[..=v.segment].windows(2).all(|w| world.segment_clearance(w[0], w[1]) >= -world.epsilon()));
            assert_eq!(v.depth, -deepest(obstacle, a, b));
            // The place is exact to 1e-15 of the segment; half an ε is far above what that changes.
            let before = a + (v.at - a) * (1.0 - 1e-9);
            assert!(world.segment_clearance(a, before) >= -1.5 * world.epsilon() || v.at == a, "{v:?}");
            assert!(deepest(obstacle, a, v.at) <= -0.5 * world.epsilon(), "{v:?}");
        }
    }
}

fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

fn one(shape: Shape, robot: f64) -> World {
    World::new(&scene(vec![shape.into()], robot, p(-10.0, -10.0), p(10.0, 10.0))).unwrap()
}

#[test]
fn special_cases_of_discs_and_capsules() {
    let disc = one(Shape::Disc { centre: [0.0, 0.0], radius: 1.0 }, 0.5);
    let capsule = one(Shape::Capsule { from: [-2.0, 0.0], to: [2.0, 0.0], radius: 1.0 }, 0.5);
    for world in [&disc, &capsule] {
        assert_eq!(world.segment_clearance(p(-5.0, 1.5), p(5.0, 1.5)), 0.0, "grazing");
        assert!(world.segment_free(p(-5.0, 1.5), p(5.0, 1.5)), "grazing is allowed");
        assert!(!world.segment_free(p(-5.0, 1.499_999), p(5.0, 1.499_999)));
        assert!(world.segment_free(p(0.0, 4.0), p(0.0, 1.5)), "touching with its end");
        assert!(world.segment_free(p(0.0, 1.5), p(0.0, 1.5)), "zero length, touching");
        assert!(!world.segment_free(p(0.0, 1.2), p(0.0, 1.2)), "zero length, inside");
        assert!(!world.segment_free(p(0.0, 0.0), p(9.0, 9.0)), "start inside");
        assert!(!world.segment_free(p(-0.2, 0.1), p(0.3, 0.2)), "the shape contains the segment");
        assert!(!world.segment_free(p(-9.0, 0.3), p(9.0, 0.4)), "right through");
    }
    assert_eq!(disc.segment_clearance(p(-9.0, 0.0), p(9.0, 0.0)), -1.5, "through the centre");
    assert_eq!(capsule.segment_clearance(p(-1.0, 0.0), p(1.0, 0.0)), -1.5, "along the axis");
    assert_eq!(capsule.segment_clearance(p(5.0, 0.0), p(9.0, 0.0)), 1.5, "beyond the axis");
    let point = one(Shape::Capsule { from: [0.0, 0.0], to: [0.0, 0.0], radius: 1.0 }, 0.5);
    assert_eq!(point.segment_clearance(p(-5.0, 2.0), p(5.0, 2.0)), 0.5, "a capsule without axis is a disc");
}

#[test]
fn special_cases_of_polygons() {
    let square = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let bare = one(Shape::Polygon(square.clone()), 0.0);
    assert!(bare.segment_free(p(-5.0, 1.0), p(5.0, 1.0)), "along a side");
    assert!(bare.segment_free(p(-0.5, 1.0), p(0.5, 1.0)), "within a side");
    assert!(bare.segment_free(p(0.0, 2.0), p(2.0, 0.0)), "touching a corner");
    assert!(!bare.segment_free(p(-2.0, -2.0), p(2.0, 2.0)), "through two corners, diagonally");
    assert!(!bare.segment_free(p(-1.0, -1.0), p(1.0, 1.0)), "from corner to corner");
    assert!(!bare.segment_free(p(-1.0, 0.0), p(1.0, 0.0)), "from side to side");
    assert!(bare.segment_free(p(1.0, 1.0), p(1.0, 1.0)), "zero length on a corner");
    assert!(!bare.segment_free(p(0.5, 0.5), p(0.5, 0.5)), "zero length inside");
    assert!(!bare.segment_free(p(-0.5, 0.0), p(0.5, 0.0)), "the polygon contains the segment");
    assert!((bare.segment_clearance(p(-2.0, -2.0), p(2.0, 2.0)) + 1.0).abs() < 1e-12, "depth at the centre");

    let round = one(Shape::Polygon(square), 0.5);
    assert!(round.segment_free(p(-5.0, 1.5), p(5.0, 1.5)), "grazing the inflated side");
    assert!(!round.segment_free(p(-5.0, 1.0), p(5.0, 1.0)), "along the bare side");
    // The inflated corner is round: (1.5, 1.5) is √½ − ½ outside, 0.354 along the diagonal touches.
    let touch = 1.0 + 0.5 * std::f64::consts::FRAC_1_SQRT_2;
    assert!(round.segment_free(p(touch, touch), p(3.0, 3.0)), "touching the round corner");
    assert!(!round.segment_free(p(touch - 1e-6, touch - 1e-6), p(3.0, 3.0)));

    // An L: its notch is free, its hull is not the obstacle.
    let ell = one(Shape::Polygon(vec![[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 4.0], [0.0, 4.0]]), 0.0);
    assert!(ell.segment_free(p(3.0, 3.0), p(1.0, 1.0)), "to the reflex corner");
    assert!(ell.segment_free(p(4.0, 1.0), p(1.0, 4.0)), "across the notch, from corner to corner");
    assert!(!ell.segment_free(p(0.5, 5.0), p(0.5, -1.0)), "down the arm");
    assert!(!ell.segment_free(p(2.0, 2.0), p(0.0, 0.0)), "through the reflex corner");
    assert_eq!(ell.segment_clearance(p(2.0, 2.0), p(3.0, 3.0)), 1.0);
    assert!(ell.segment_free(p(1.0, 5.0), p(1.0, 1.0)), "along two collinear points of a side and its end");
}

#[test]
fn entering_exactly_through_a_corner_is_seen() {
    // Both found by the random cases above: by rounding, the segment crosses neither side of the corner.
    let hexagon = [
        [-1683.3739382634644, -1175.8496610288514],
        [1351.8733074011873, 1846.6779782719295],
        [3008.3860841764654, 1427.6000538627395],
        [4560.21310521075, -1036.54938397643],
        [1573.4189484741357, -4404.008034009323],
        [457.1338926396139, -4247.540184152096],
    ];
    let (a, b) = (p(1351.880275829909, 1846.6327119953885), p(895.1930584664012, 4813.23116622895));
    let expected = point_oracle(&Shape::Polygon(hexagon.to_vec()), 0.0, a);
    let world = one(Shape::Polygon(hexagon.to_vec()), 0.0);
    assert!(expected < -0.03, "it starts inside: {expected}");
    assert!((world.segment_clearance(a, b) - expected).abs() < 1e-9, "its start is its deepest point");
    assert!(world.first_violation(&[a, b]).is_some());

    let notched = [
        [-0.10588240093034068, 0.07712223263584157],
        [-0.07570530749280385, 0.06799730614487598],
        [-0.07185466023816034, 0.02635140662063947],
        [-0.0569954458237341, 0.05520911716979902],
        [-0.03516238071738495, 0.059810327519455114],
        [-0.03507704488694817, 0.07032932454778656],
        [-0.05005535475615161, 0.1173272050611043],
        [-0.06776529915849301, 0.07681147538946212],
    ];
    let (a, b) = (p(-0.07506244569289662, 0.0201216463133441), p(-0.05238827913827719, 0.06415658094228271));
    let expected = point_oracle(&Shape::Polygon(notched.to_vec()), 0.0, b);
    let world = one(Shape::Polygon(notched.to_vec()), 0.0);
    assert!(expected < -0.007, "along a side, then over its reflex corner: {expected}");
    assert!((world.segment_clearance(a, b) - expected).abs() < 1e-9, "its end is its deepest point");
    assert!(world.first_violation(&[a, b]).is_some());
}

#[test]
fn boxes_hold_their_shapes() {
    let mut draw = Draw::new(5);
    for case in 0..2000 {
        let scale = draw.log(1e-2, 1e4);
        let shape = draw.shape(case % 4, Point::origin(), scale);
        let world = one_at(shape.clone(), 0.3 * scale, scale);
        let inflated = &world.obstacles()[0];
        let Aabb { min, max } = inflated.aabb();
        let q = draw.point(Point::origin(), 2.0 * scale);
        let outside = (min.x - q.x).max(q.x - max.x).max(min.y - q.y).max(q.y - max.y);
        // What is outside the box by d is at least d away; 1e-12 for rounding.
        assert!(inflated.point_clearance(q) >= outside - 1e-12 * scale || outside < 0.0);
        assert!((inflated.point_clearance(q) - point_oracle(&shape, 0.3 * scale, q)).abs() <= 1e-12 * scale);
    }
}

fn one_at(shape: Shape, robot: f64, scale: f64) -> World {
    World::new(&scene(vec![shape.into()], robot, p(-scale, 0.0), p(scale, 0.0))).unwrap()
}
