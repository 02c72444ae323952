//! What must hold between the optima of related scenes, and between optimum and planner.

use env_model::{Inflated, Obstacle, Point, Scene, Shape, Vector, World, path_length};
use planner_api::{Planner, Problem, Run, Status};
use planner_tangent::{Settings, Tangent};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::families::FAMILIES;
use crate::{solve, with_problem};

/// How much obstacles shrunk by up to ε can shorten a path, in ε: the sharpest
/// tips (0.1 rad) retreat by 20 ε, which two segments each save; a path meets few.
const SAVED: f64 = 300.0;

/// Calls `check` with every scene, its problem and the length of its optimum,
/// `None` when infeasible.
fn everywhere(mut check: impl FnMut(&Scene, &Problem<'_>, Option<f64>)) {
    let mut scenes = 0;
    for family in FAMILIES {
        for scene in family.scenes() {
            scenes += 1;
            with_problem(&scene, |problem| {
                check(&scene, problem, solve(problem).map(|best| best.length));
            });
        }
    }
    assert!(scenes >= 500, "{scenes}");
}

/// The optimum of `other` is `a` too, or there is none either.
///
/// 1e-9 relative: the lengths differ by rounding only, but a path that leaves an
/// obstacle where it nearly touches another reacts to the square root of that.
fn assert_same(a: Option<f64>, other: &Problem<'_>, scene: &Scene) {
    let b = solve(other).map(|best| best.length);
    let same = match (a, b) {
        (Some(a), Some(b)) => (a / b - 1.0).abs() <= 1e-9,
        (a, b) => a == b,
    };
    assert!(same, "{}: {a:?} and {b:?}\n{}", scene.name, scene.to_toml());
}

#[test]
fn backwards_it_is_as_long() {
    everywhere(|scene, problem, forth| {
        let back = Problem::new(problem.world, problem.goal, problem.start).unwrap();
        assert_same(forth, &back, scene);
    });
}

#[test]
fn in_the_mirror_it_is_as_long() {
    everywhere(|scene, _, seen| {
        let mut mirrored = scene.clone();
        let flip = |p: &mut [f64; 2]| p[0] = -p[0];
        flip(&mut mirrored.start);
        flip(&mut mirrored.goal);
        if let Some(field) = &mut mirrored.field {
            (field.min[0], field.max[0]) = (-field.max[0], -field.min[0]);
        }
        for obstacle in &mut mirrored.obstacles {
            match &mut obstacle.shape {
                Shape::Disc { centre, .. } => flip(centre),
                Shape::Capsule { from, to, .. } => {
                    flip(from);
                    flip(to);
                }
                Shape::Polygon(corners) => corners.iter_mut().for_each(flip),
            }
        }
        with_problem(&mirrored, |problem| assert_same(seen, problem, scene));
    });
}

#[test]
fn the_same_obstacles_told_otherwise_change_nothing() {
    everywhere(|scene, _, told| {
        let mut other = scene.clone();
        other.obstacles.reverse();
        other.obstacles.extend(scene.obstacles.first().cloned());
        for obstacle in &mut other.obstacles {
            match &mut obstacle.shape {
                Shape::Disc { .. } => {}
                Shape::Capsule { from, to, .. } => std::mem::swap(from, to),
                // The other winding, from another corner on.
                Shape::Polygon(corners) => {
                    corners.reverse();
                    corners.rotate_left(1);
                }
            }
        }
        with_problem(&other, |problem| assert_same(told, problem, scene));
    });
}

#[test]
fn corners_in_the_middle_of_sides_change_nothing() {
    everywhere(|scene, _, plain| {
        let mut other = scene.clone();
        for obstacle in &mut other.obstacles {
            if let Shape::Polygon(corners) = &mut obstacle.shape {
                let n = corners.len();
                let side = |i: usize| (corners[i], corners[(i + 1) % n]);
                let halves = (0..n).map(side).flat_map(|(a, b)| [a, [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]]);
                *corners = halves.collect();
            }
        }
        with_problem(&other, |problem| assert_same(plain, problem, scene));
    });
}

#[test]
fn an_obstacle_less_never_lengthens() {
    everywhere(|scene, _, all| {
        for skip in 0..scene.obstacles.len().min(4) {
            let mut fewer = scene.clone();
            fewer.obstacles.remove(skip);
            with_problem(&fewer, |problem| {
                let fewer = solve(problem);
                // ε goes with the box round the scene: the others may shrink less now.
                let slack = SAVED * scene.epsilon();
                let sound = all.is_none_or(|all| fewer.as_ref().is_some_and(|fewer| fewer.length <= all + slack));
                let fewer = fewer.map(|fewer| fewer.length);
                assert!(sound, "{}: {fewer:?} without {skip}, {all:?} with it\n{}", scene.name, scene.to_toml());
            });
        }
    });
}

#[test]
fn the_planner_finds_the_optimum_or_proves_that_there_is_none() {
    let mut planner = Tangent::new(Settings::default()).unwrap();
    everywhere(|scene, problem, best| {
        let (plan, status) = planner.plan(problem, &mut Run::new(1)).unwrap();
        let text = || format!("{}: {status:?}, optimum {best:?}\n{}", scene.name, scene.to_toml());
        let Some(best) = best else {
            assert_eq!(status, Status::Infeasible, "{}", text());
            assert!(plan.path.is_empty(), "{}", text());
            return;
        };
        assert_eq!(status, Status::Solved, "{}", text());
        assert_eq!((plan.path[0], plan.path[plan.path.len() - 1]), (problem.start, problem.goal), "{}", text());
        assert!(problem.world.path_free(&plan.path), "{}", text());
        let length = path_length(&plan.path);
        // Not under it but for the rounding of the sum; over it by a millionth for
        // the polyline, and by what the optimum's shrunken obstacles save.
        let over = 1.001e-6 * best + SAVED * scene.epsilon();
        assert!(length >= best * (1.0 - 1e-12) && length <= best + over, "{length}: {}", text());
    });
}

/// Adds so many tiny discs inside one of the obstacles that neighbours are found by sweeps
/// instead of by what has been in the way.
fn crowd(scene: &Scene) -> Option<Scene> {
    let world = World::new(scene).unwrap();
    let deepest = |obstacle: &Inflated| {
        let (bounds, n) = (obstacle.aabb(), 40);
        let at = |i: i32, j: i32| {
            bounds.min
                + bounds.size().component_mul(&Vector::new(f64::from(i) + 0.5, f64::from(j) + 0.5)) / f64::from(n)
        };
        let depth = |p: Point| -obstacle.point_clearance(p) - scene.robot_radius;
        (0..n * n).map(|k| at(k % n, k / n)).map(|p| (depth(p), p)).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
    };
    let (depth, centre) = world.obstacles().iter().map(deepest).max_by(|a, b| a.0.total_cmp(&b.0))?;
    if depth < 1e3 * scene.epsilon() {
        return None;
    }
    let mut other = scene.clone();
    for i in 0..600 {
        let at = centre + Vector::new(f64::from(i % 20), f64::from(i / 20)) * (0.01 * depth);
        other.obstacles.push(Obstacle::disc(at, 0.1 * depth));
    }
    Some(other)
}

#[test]
fn a_crowd_within_an_obstacle_changes_nothing() {
    let mut crowded = 0;
    everywhere(|scene, _, alone| {
        if let Some(other) = crowd(scene) {
            with_problem(&other, |problem| assert_same(alone, problem, scene));
            crowded += 1;
        }
    });
    assert!(crowded >= 600, "{crowded}");
}

/// A thin capsule that runs through another's cap, both its ends outside: it may lie behind a ray
/// whose heading is between the tangents to its ends.
#[test]
fn sticks_through_circles_hide_nothing_behind_them() {
    let mut bent = 0;
    for seed in 0..600 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut next = || (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let mut scene = Scene {
            name: format!("sticks {seed}"),
            unit: "m".into(),
            robot_radius: 0.02,
            start: [0.3, 5.0],
            goal: [9.7, 5.0],
            field: None,
            obstacles: Vec::new(),
        };
        while scene.obstacles.len() < 28 {
            let from = [10.0 * next(), 10.0 * next()];
            let (angle, length, radius) = (std::f64::consts::TAU * next(), 1.0 + 3.0 * next(), 0.002 + 0.08 * next());
            let disc = next() < 0.4;
            let to = [from[0] + length * angle.cos(), from[1] + length * angle.sin()];
            let shape = if disc {
                Shape::Disc { centre: from, radius: 8.0 * radius }
            } else {
                Shape::Capsule { from, to, radius }
            };
            scene.obstacles.push(shape.into());
            let world = World::new(&scene).unwrap();
            if [scene.start(), scene.goal()].iter().any(|&p| world.point_clearance(p) < 0.0) {
                scene.obstacles.pop();
            }
        }
        let few = with_problem(&scene, |problem| solve(problem).map(|best| best.length));
        bent += u32::from(few.is_some_and(|length| length > 9.5));
        let many = crowd(&scene).unwrap();
        with_problem(&many, |problem| assert_same(few, problem, &scene));
    }
    assert!(bent >= 200, "{bent}");
}

#[test]
fn a_point_passes_through_a_wall_thinner_than_two_epsilon() {
    for (thickness, open) in [(0.5, true), (1.9, true), (3.0, false), (10.0, false)] {
        let mut scene = Scene {
            name: format!("needle of {thickness}"),
            unit: "m".into(),
            robot_radius: 0.0,
            start: [0.0, 0.0],
            goal: [10.0, 0.0],
            field: None,
            obstacles: vec![Shape::Polygon(vec![[5.0, -4.0], [6.0, -4.0], [6.0, 4.0], [5.0, 4.0]]).into()],
        };
        let right = 5.0 + thickness * scene.epsilon();
        scene.obstacles = vec![Shape::Polygon(vec![[5.0, -4.0], [right, -4.0], [right, 4.0], [5.0, 4.0]]).into()];
        let length = with_problem(&scene, |problem| solve(problem).unwrap().length);
        assert_eq!(length == 10.0, open, "{thickness} ε: {length}");
    }
}
