//! Random scenes, one function a family, the same on every run.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use env_model::scene::Field;
use env_model::{Core, Inflated, Obstacle, Point, Scene, Shape, Vector};
use planner_api::seed::splitmix64;

/// A family: its name, how many scenes are drawn, and how.
pub struct Family {
    pub name: &'static str,
    count: u64,
    draw: fn(&mut Draw) -> Scene,
}

impl Family {
    /// All scenes of the family.
    pub fn scenes(&self) -> impl Iterator<Item = Scene> + '_ {
        (0..self.count).map(|index| self.scene(index))
    }

    /// Scene `index` of the family.
    fn scene(&self, index: u64) -> Scene {
        let seed = self.name.bytes().fold(index, |seed, byte| seed.wrapping_mul(257).wrapping_add(byte.into()));
        let mut scene = (self.draw)(&mut Draw(seed));
        scene.name = format!("{} {index}", self.name);
        scene
    }
}

/// All families; 806 scenes.
pub const FAMILIES: &[Family] = &[
    Family { name: "discs", count: 60, draw: |d| scatter(d, &[disc]) },
    Family { name: "convex polygons", count: 60, draw: |d| scatter(d, &[convex, rectangle]) },
    Family { name: "non-convex polygons", count: 70, draw: |d| scatter(d, &[star, ell, cup, comb]) },
    Family { name: "capsules", count: 50, draw: |d| scatter(d, &[capsule]) },
    Family { name: "mixed", count: 80, draw: |d| scatter(d, KINDS) },
    Family { name: "clusters", count: 50, draw: clusters },
    Family { name: "slits", count: 70, draw: slits },
    Family { name: "border", count: 50, draw: border },
    Family { name: "touched ends", count: 40, draw: touched_ends },
    Family { name: "shared sides", count: 40, draw: shared_sides },
    Family { name: "rings", count: 70, draw: rings },
    Family { name: "bars", count: 40, draw: bars },
    Family { name: "contacts", count: 50, draw: contacts },
    Family { name: "needles", count: 40, draw: needles },
    Family { name: "spirals", count: 30, draw: spirals },
    Family { name: "crowds", count: 6, draw: crowds },
];

/// A stream of random numbers.
pub struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        (splitmix64(&mut self.0) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    fn one_of<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    fn point(&mut self, half: Vector) -> Point {
        Point::new(self.between(-half.x, half.x), self.between(-half.y, half.y))
    }
}

fn polar(angle: f64, radius: f64) -> Vector {
    Vector::new(angle.cos(), angle.sin()) * radius
}

// Shapes about the origin, some 2 across.

fn disc(d: &mut Draw) -> Shape {
    Shape::Disc { centre: [0.0; 2], radius: d.between(0.2, 1.1) }
}

fn capsule(d: &mut Draw) -> Shape {
    let half = polar(d.between(0.0, TAU), d.between(0.2, 1.5));
    Shape::Capsule { from: (-half).into(), to: half.into(), radius: d.between(0.05, 0.5) }
}

fn polygon(corners: impl IntoIterator<Item = Vector>) -> Shape {
    Shape::Polygon(corners.into_iter().map(Into::into).collect())
}

/// Corners on an ellipse.
fn convex(d: &mut Draw) -> Shape {
    let n = 3 + d.below(5);
    let flat = d.between(0.3, 1.2);
    polygon(
        (0..n).map(|i| polar(TAU * (i as f64 + 0.7 * d.unit()) / n as f64, 1.0)).map(|v| Vector::new(v.x, flat * v.y)),
    )
}

/// An ellipse of so many corners that neighbouring sides are nearly one line.
fn many_corners(d: &mut Draw) -> Shape {
    let n = 30 + d.below(30);
    let flat = d.between(0.3, 1.2);
    polygon((0..n).map(|i| polar(TAU * i as f64 / n as f64, 1.0)).map(|v| Vector::new(v.x, flat * v.y)))
}

fn rectangle(d: &mut Draw) -> Shape {
    let (x, y) = (d.between(0.1, 1.2), d.between(0.1, 1.2));
    polygon([[-x, -y], [x, -y], [x, y], [-x, y]].map(Vector::from))
}

fn star(d: &mut Draw) -> Shape {
    let n = 4 + d.below(4);
    let depth = d.between(0.3, 0.8);
    let radius = |i: usize, d: &mut Draw| if i.is_multiple_of(2) { d.between(0.8, 1.4) } else { depth };
    polygon((0..2 * n).map(|i| polar(PI * (i as f64 + 0.4 * d.unit()) / n as f64, radius(i, d))))
}

fn ell(d: &mut Draw) -> Shape {
    let (x, y, t) = (d.between(0.8, 2.0), d.between(0.8, 2.0), d.between(0.1, 0.6));
    let corners = [[0.0, 0.0], [x, 0.0], [x, t], [t, t], [t, y], [0.0, y]];
    polygon(corners.map(|[a, b]| Vector::new(a - 0.5 * x, b - 0.5 * y)))
}

fn cup(d: &mut Draw) -> Shape {
    comb_of(1, d)
}

fn comb(d: &mut Draw) -> Shape {
    let gaps = 2 + d.below(2);
    comb_of(gaps, d)
}

/// A back along the x axis with `gaps` + 1 teeth upwards.
fn comb_of(gaps: usize, d: &mut Draw) -> Shape {
    let (gap, tooth, back) = (d.between(0.3, 1.2), d.between(0.1, 0.4), d.between(0.1, 0.4));
    let width = gaps as f64 * (gap + tooth) + tooth;
    let mut corners = vec![Vector::new(0.0, 0.0), Vector::new(width, 0.0)];
    for i in (0..=gaps).rev() {
        let (left, top) = (i as f64 * (gap + tooth), d.between(back + 0.2, 1.8));
        let right = left + tooth;
        corners.extend([[right, back], [right, top], [left, top], [left, back]].map(Vector::from));
    }
    // The outermost teeth go down to the back's lower side.
    corners.remove(2);
    corners.pop();
    polygon(corners.into_iter().map(|c| c - Vector::new(0.5 * width, 0.5)))
}

/// The shape turned, stretched, then shifted.
fn placed(shape: Shape, angle: f64, scale: f64, shift: Vector) -> Shape {
    let (sin, cos) = angle.sin_cos();
    let put = |p: [f64; 2]| [(p[0] * cos - p[1] * sin) * scale + shift.x, (p[0] * sin + p[1] * cos) * scale + shift.y];
    match shape {
        Shape::Disc { centre, radius } => Shape::Disc { centre: put(centre), radius: radius * scale },
        Shape::Capsule { from, to, radius } => Shape::Capsule { from: put(from), to: put(to), radius: radius * scale },
        Shape::Polygon(corners) => Shape::Polygon(corners.into_iter().map(put).collect()),
    }
}

fn anywhere(d: &mut Draw, shape: Shape, half: Vector) -> Shape {
    let at = d.point(half);
    placed(shape, d.between(0.0, TAU), 1.0, at.coords)
}

fn scene(robot_radius: f64, start: Point, goal: Point, shapes: Vec<Shape>) -> Scene {
    Scene {
        name: "random".into(),
        unit: "m".into(),
        robot_radius,
        start: start.into(),
        goal: goal.into(),
        field: None,
        obstacles: shapes.into_iter().map(Obstacle::from).collect(),
    }
}

/// Leaves out the obstacles that `start` or `goal` lie in.
fn freed(mut scene: Scene) -> Scene {
    let ends = [scene.start(), scene.goal()];
    for i in (0..scene.obstacles.len()).rev() {
        let shape = scene.inflated(i).expect("a sound shape");
        // Ends that touch by construction miss the border by rounding.
        if ends.iter().any(|e| shape.point_clearance(*e) < -1e-12) {
            scene.obstacles.remove(i);
        }
    }
    scene
}

/// The scene turned by an odd angle (sometimes not, and never a field, which has no angle), in
/// thousandths, units or thousands, and away from the origin.
fn moved(d: &mut Draw, mut scene: Scene) -> Scene {
    let angle = if scene.field.is_some() || d.chance(0.3) { 0.0 } else { d.between(0.0, TAU) };
    let scale = d.one_of(&[1e-3, 1.0, 1e3]);
    let shift = if d.chance(0.3) { Vector::zeros() } else { d.point(Vector::new(40.0, 40.0)).coords * scale };
    let point = |p: [f64; 2]| {
        let Shape::Disc { centre, .. } = placed(Shape::Disc { centre: p, radius: 0.0 }, angle, scale, shift) else {
            panic!("a disc stays one")
        };
        centre
    };
    scene.start = point(scene.start);
    scene.goal = point(scene.goal);
    scene.robot_radius *= scale;
    scene.field = scene.field.map(|f| Field { min: point(f.min), max: point(f.max) });
    for obstacle in &mut scene.obstacles {
        obstacle.shape = placed(obstacle.shape.clone(), angle, scale, shift);
    }
    scene
}

type Kind = fn(&mut Draw) -> Shape;

const KINDS: &[Kind] = &[disc, capsule, convex, rectangle, star, ell, cup, comb, many_corners];

/// 3 to 12 obstacles of some kinds between start and goal, or round them.
fn scatter(d: &mut Draw, kinds: &[Kind]) -> Scene {
    let half = Vector::new(4.0, 3.0);
    let count = 3 + d.below(10);
    let shapes = (0..count).map(|_| d.one_of(kinds)(d)).collect::<Vec<_>>();
    let shapes = shapes.into_iter().map(|shape| anywhere(d, shape, half)).collect();
    let robot_radius = d.one_of(&[0.0, 0.05, 0.2]);
    let (start, goal) = if d.chance(0.5) {
        (Point::new(-6.0, d.between(-2.0, 2.0)), Point::new(6.0, d.between(-2.0, 2.0)))
    } else {
        (d.point(half), d.point(half))
    };
    let scene = scene(robot_radius, start, goal, shapes);
    moved(d, freed(scene))
}

/// 40 to 70 small obstacles of every kind.
fn crowds(d: &mut Draw) -> Scene {
    let half = Vector::new(5.0, 3.0);
    let mut shapes = Vec::new();
    for _ in 0..40 + d.below(30) {
        let shape = d.one_of(KINDS)(d);
        let (angle, scale) = (d.between(0.0, TAU), d.between(0.2, 0.4));
        shapes.push(placed(shape, angle, scale, d.point(half).coords));
    }
    let (start, goal) = (Point::new(-6.0, d.between(-2.0, 2.0)), Point::new(6.0, d.between(-2.0, 2.0)));
    let scene = scene(d.one_of(&[0.0, 0.05]), start, goal, shapes);
    moved(d, freed(scene))
}

/// Heaps of overlapping obstacles.
fn clusters(d: &mut Draw) -> Scene {
    let mut shapes = Vec::new();
    for _ in 0..1 + d.below(3) {
        let centre = d.point(Vector::new(3.0, 2.0)).coords;
        for _ in 0..3 + d.below(3) {
            let shape = d.one_of(KINDS)(d);
            shapes.push(placed(anywhere(d, shape, Vector::new(0.9, 0.9)), 0.0, 1.0, centre));
        }
    }
    let (start, goal) = (Point::new(-5.0, d.between(-2.0, 2.0)), Point::new(5.0, d.between(-2.0, 2.0)));
    let scene = scene(d.one_of(&[0.0, 0.1]), start, goal, shapes);
    moved(d, freed(scene))
}

/// A wall with a slit that is barely wider or barely narrower than the robot.
fn slits(d: &mut Draw) -> Scene {
    let robot_radius = d.one_of(&[0.0, 0.1, 0.3]);
    // ε is about 2e-8 here: 1e-6 is the least that both kinds of obstacles, as
    // they are and shrunk, answer alike.
    let width = 2.0 * robot_radius + d.one_of(&[-0.03, -1e-4, -1e-6, 1e-6, 1e-4, 0.03]);
    let at = d.between(-1.5, 1.5);
    let mut half = |sign: f64| {
        let near = at + sign * 0.5 * width;
        let far = sign * d.between(5.0, 6.0);
        match d.below(3) {
            0 => {
                let r = d.between(0.05, 0.4);
                Shape::Capsule { from: [0.0, near + sign * r], to: [0.0, far], radius: r }
            }
            1 => {
                let (x, (low, high)) = (d.between(0.05, 0.4), (near.min(far), near.max(far)));
                polygon([[-x, low], [x, low], [x, high], [-x, high]].map(Vector::from))
            }
            _ => {
                let r = d.between(1.0, 2.0);
                Shape::Disc { centre: [0.0, near + sign * r], radius: r }
            }
        }
    };
    let shapes = vec![half(-1.0), half(1.0)];
    let mut scene = scene(robot_radius, d.point(Vector::new(1.0, 3.0)), d.point(Vector::new(1.0, 3.0)), shapes);
    scene.start[0] -= 4.0;
    scene.goal[0] += 4.0;
    moved(d, scene)
}

/// A field, and obstacles across its border that close its sides.
fn border(d: &mut Draw) -> Scene {
    let half = Vector::new(6.0, 3.0);
    let robot_radius = d.one_of(&[0.0, 0.1, 0.3]);
    let mut shapes = Vec::new();
    for _ in 0..3 + d.below(5) {
        let shape = d.one_of(KINDS)(d);
        let y = d.one_of(&[-half.y, half.y]) + d.between(-0.3, 0.3);
        let (angle, x) = (d.between(0.0, TAU), d.between(-4.0, 4.0));
        shapes.push(placed(shape, angle, d.between(1.0, 1.8), Vector::new(x, y)));
    }
    for _ in 0..d.below(4) {
        let shape = d.one_of(KINDS)(d);
        shapes.push(anywhere(d, shape, Vector::new(3.0, 2.5)));
    }
    let y = half.y - robot_radius;
    let (mut start, goal) = (Point::new(-5.5, d.between(-y, y)), Point::new(5.5, d.between(-y, y)));
    if d.chance(0.2) {
        start.y = -y;
    }
    let mut scene = scene(robot_radius, start, goal, shapes);
    scene.field = Some(Field { min: (-half).into(), max: half.into() });
    moved(d, freed(scene))
}

/// A point on the border of an inflated shape.
fn on_border(d: &mut Draw, shape: &Inflated) -> Point {
    let round = |d: &mut Draw, c: Point| c + polar(d.between(0.0, TAU), shape.radius);
    match &shape.core {
        Core::Point(c) => round(d, *c),
        Core::Segment(a, b) => {
            let along = (b - a).normalize();
            a + (b - a) * d.unit() + Vector::new(-along.y, along.x) * (d.one_of(&[-1.0, 1.0]) * shape.radius)
        }
        Core::Polygon(polygon) => {
            let sides: Vec<_> = polygon.sides().collect();
            let (a, b) = d.one_of(&sides);
            let along = (b - a).normalize();
            a + (b - a) * d.one_of(&[0.0, 0.3, 0.8]) + Vector::new(along.y, -along.x) * shape.radius
        }
    }
}

/// Start, and often goal, on an obstacle's border.
fn touched_ends(d: &mut Draw) -> Scene {
    let mut scene = scatter_still(d);
    let touch = |d: &mut Draw, scene: &Scene| {
        let shape = scene.inflated(d.below(scene.obstacles.len())).expect("a sound shape");
        let border = on_border(d, &shape);
        // Where two sides meet at a reflex corner, a side's border may lie inside.
        (shape.point_clearance(border) > -1e-12).then_some(border)
    };
    if let Some(start) = touch(d, &scene) {
        scene.start = start.into();
    }
    if d.chance(0.6)
        && let Some(goal) = touch(d, &scene)
        && (goal - scene.start()).norm() > 0.1
    {
        scene.goal = goal.into();
    }
    moved(d, freed(scene))
}

fn scatter_still(d: &mut Draw) -> Scene {
    let count = 3 + d.below(6);
    let shapes = (0..count).map(|_| d.one_of(KINDS)(d)).collect::<Vec<_>>();
    let shapes = shapes.into_iter().map(|shape| anywhere(d, shape, Vector::new(3.0, 2.0))).collect();
    let (start, goal) = (Point::new(-6.0, d.between(-2.0, 2.0)), Point::new(6.0, d.between(-2.0, 2.0)));
    scene(d.one_of(&[0.0, 0.1]), start, goal, shapes)
}

/// Rectangles on a lattice that share sides and corners exactly.
fn shared_sides(d: &mut Draw) -> Scene {
    let mut shapes = Vec::new();
    for column in -2..3 {
        for row in -2..3 {
            if d.chance(0.45) {
                let (x, y) = (f64::from(column), f64::from(row));
                let corners = [[x - 0.5, y - 0.5], [x + 0.5, y - 0.5], [x + 0.5, y + 0.5], [x - 0.5, y + 0.5]];
                shapes.push(polygon(corners.map(Vector::from)));
            }
        }
    }
    let radius = d.one_of(&[0.0, 0.0, 0.1]);
    let start = Point::new(-3.5, d.one_of(&[0.0, 0.5, 0.3]));
    let scene = scene(radius, start, Point::new(3.5, d.one_of(&[0.0, -0.5, 0.7])), shapes);
    moved(d, freed(scene))
}

/// One link of a chain from `a` to `b`, which overlaps its neighbours.
fn link(d: &mut Draw, a: Point, b: Point) -> Shape {
    let middle = env_model::Aabb::of_points([&a, &b]).centre();
    let along = b - a;
    match d.below(4) {
        0 => Shape::Disc { centre: middle.into(), radius: 0.5 * along.norm() * d.between(1.000_01, 1.1) },
        1 => Shape::Capsule { from: a.into(), to: b.into(), radius: d.between(0.05, 0.3) },
        2 => {
            let across = Vector::new(-along.y, along.x).normalize() * d.between(0.05, 0.3);
            let more = along * d.between(1e-5, 0.1);
            polygon([a - more - across, b + more - across, b + more + across, a - more + across].map(|p| p.coords))
        }
        _ => {
            let across = Vector::new(-along.y, along.x).normalize() * d.between(0.1, 0.3);
            let more = along * 0.05;
            let (u, v) = (a - more, b + more);
            // An arrow head: not convex.
            polygon([u - across, middle - across * 0.5, v - across, v + across, u + across].map(|p| p.coords))
        }
    }
}

/// Links round one end or round both, closed or with one link missing.
fn rings(d: &mut Draw) -> Scene {
    let n = 4 + d.below(7);
    let radius = d.between(2.0, 3.0);
    let turned = d.between(0.0, TAU);
    let corner = |i: usize| Point::origin() + polar(turned + TAU * i as f64 / n as f64, radius);
    let mut shapes: Vec<Shape> = (0..n).map(|i| link(d, corner(i), corner(i + 1))).collect();
    if d.chance(0.4) {
        shapes.remove(d.below(n));
    }
    let inside = d.point(Vector::new(0.3, 0.3));
    let other = if d.chance(0.2) { -inside } else { Point::origin() + polar(d.between(0.0, TAU), 5.0) };
    let (start, goal) = if d.chance(0.5) { (inside, other) } else { (other, inside) };
    let scene = scene(d.one_of(&[0.0, 0.1]), start, goal, shapes);
    moved(d, freed(scene))
}

/// A chain from border to border of a field; its last link may leave a gap that
/// is barely wider or narrower than the robot.
fn bars(d: &mut Draw) -> Scene {
    let half = Vector::new(5.0, 3.0);
    let n = 3 + d.below(4);
    let robot_radius = d.one_of(&[0.0, 0.1]);
    let knots: Vec<Point> =
        (0..=n).map(|i| Point::new(d.between(-1.5, 1.5), half.y * (2.0 * i as f64 / n as f64 - 1.0))).collect();
    let mut shapes: Vec<Shape> = (1..n).map(|i| link(d, knots[i - 1], knots[i])).collect();
    let gap = d.one_of(&[-1.0, -0.03, -1e-6, 1e-6, 0.03]);
    // From the last knot up to the border less the robot and the gap.
    let top = half.y - 2.0 * robot_radius - gap;
    let x = knots[n - 1].x;
    shapes.push(if d.chance(0.5) {
        Shape::Capsule { from: knots[n - 1].into(), to: [x, top - 0.2], radius: 0.2 }
    } else {
        let low = knots[n - 1].y - 0.1;
        polygon([[x - 0.2, low], [x + 0.2, low], [x + 0.2, top], [x - 0.2, top]].map(Vector::from))
    });
    let ends = d.one_of(&[Vector::new(-4.0, 1.0), Vector::new(-4.0, -2.0), Vector::new(-4.0, 0.0)]);
    let scene = Scene {
        field: Some(Field { min: (-half).into(), max: half.into() }),
        ..scene(robot_radius, Point::origin() + ends, Point::new(4.0, d.between(-2.0, 2.0)), shapes)
    };
    // Sometimes upside down, or on its side.
    let mut scene = freed(scene);
    let quarter = f64::from(d.one_of(&[0_u8, 1, 2, 3])) * FRAC_PI_2;
    turn_quarter(&mut scene, quarter);
    moved(d, scene)
}

fn turn_quarter(scene: &mut Scene, angle: f64) {
    // Sines and cosines of whole quarters are exact after rounding.
    let (sin, cos) = (angle.sin().round(), angle.cos().round());
    let put = |p: [f64; 2]| [p[0] * cos - p[1] * sin, p[0] * sin + p[1] * cos];
    scene.start = put(scene.start);
    scene.goal = put(scene.goal);
    if let Some(field) = &mut scene.field {
        let corners = [put(field.min), put(field.max)];
        field.min = [corners[0][0].min(corners[1][0]), corners[0][1].min(corners[1][1])];
        field.max = [corners[0][0].max(corners[1][0]), corners[0][1].max(corners[1][1])];
    }
    for obstacle in &mut scene.obstacles {
        match &mut obstacle.shape {
            Shape::Disc { centre, .. } => *centre = put(*centre),
            Shape::Capsule { from, to, .. } => (*from, *to) = (put(*from), put(*to)),
            Shape::Polygon(corners) => corners.iter_mut().for_each(|c| *c = put(*c)),
        }
    }
}

/// Discs, capsules and squares on a lattice, all touching and none overlapping.
fn contacts(d: &mut Draw) -> Scene {
    let mut shapes = Vec::new();
    for column in -2..3 {
        for row in -2..2 {
            let at = Vector::new(f64::from(column), f64::from(row));
            match d.below(7) {
                0 | 1 => shapes.push(placed(Shape::Disc { centre: [0.0; 2], radius: 0.5 }, 0.0, 1.0, at)),
                2 => shapes
                    .push(polygon([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(|c| at + Vector::from(c)))),
                3 => {
                    let half = Vector::from(d.one_of(&[[0.25, 0.0], [0.0, 0.25]]));
                    shapes.push(Shape::Capsule { from: (at - half).into(), to: (at + half).into(), radius: 0.25 });
                }
                // A square on its corner.
                4 => shapes
                    .push(polygon([[-0.5, 0.0], [0.0, -0.5], [0.5, 0.0], [0.0, 0.5]].map(|c| at + Vector::from(c)))),
                _ => {}
            }
        }
    }
    let start = Point::new(-3.0, d.one_of(&[-0.5, 0.0, 0.5]));
    let scene = scene(0.0, start, Point::new(3.0, d.one_of(&[-0.5, 0.0, 0.2])), shapes);
    moved(d, freed(scene))
}

/// Slender triangles, for a point and for the tiniest robots.
fn needles(d: &mut Draw) -> Scene {
    let needle = |d: &mut Draw| {
        let long = d.between(1.0, 4.0);
        let (foot, tip) = (d.between(0.05, 0.1) * long, d.between(-0.5, 0.5) * long);
        polygon([[-foot, 0.0], [foot, 0.0], [0.2 * tip, long]].map(Vector::from))
    };
    let shapes = (0..4 + d.below(8)).map(|_| needle(d)).collect::<Vec<_>>();
    let shapes = shapes.into_iter().map(|shape| anywhere(d, shape, Vector::new(3.0, 2.5))).collect();
    let (start, goal) = (Point::new(-6.0, d.between(-2.0, 2.0)), Point::new(6.0, d.between(-2.0, 2.0)));
    let scene = scene(d.one_of(&[0.0, 1e-6, 1e-3]), start, goal, shapes);
    moved(d, freed(scene))
}

/// Out of a spiral of up to two turns, one polygon, perhaps with a disc in its corridor.
fn spirals(d: &mut Draw) -> Scene {
    let (turns, rise, thick) = (d.between(0.6, 2.0), d.between(0.15, 0.3), d.between(0.05, 0.3));
    let knots = 8 + d.below(20);
    let angle = |i: usize| TAU * turns * i as f64 / knots as f64;
    let inner = (0..=knots).map(|i| polar(angle(i), 0.6 + rise * angle(i)));
    let outer = (0..=knots).rev().map(|i| polar(angle(i), 0.6 + thick + rise * angle(i)));
    let mut shapes = vec![polygon(inner.chain(outer))];
    if d.chance(0.5) {
        let at = polar(d.between(0.5, 1.0) * angle(knots), 0.6 + rise * angle(knots) - d.between(0.2, 0.8));
        shapes.push(Shape::Disc { centre: at.into(), radius: d.between(0.1, 0.4) });
    }
    let goal = Point::origin() + polar(d.between(0.0, TAU), 6.0);
    let scene = scene(d.one_of(&[0.0, 0.1, 0.3]), d.point(Vector::new(0.2, 0.2)), goal, shapes);
    let (start, goal) = (scene.start, scene.goal);
    let swapped = d.chance(0.5);
    moved(
        d,
        freed(Scene { start: if swapped { goal } else { start }, goal: if swapped { start } else { goal }, ..scene }),
    )
}
