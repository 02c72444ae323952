use env_model::scene::Field;
use env_model::{Obstacle, World};
use planner_api::seed::splitmix64;

use super::*;

fn scene(robot_radius: f64, obstacles: Vec<Shape>) -> Scene {
    Scene {
        name: "judged".into(),
        unit: "m".into(),
        robot_radius,
        start: [0.0, 0.0],
        goal: [10.0, 0.0],
        field: None,
        obstacles: obstacles.into_iter().map(Obstacle::from).collect(),
    }
}

fn path(points: &[[f64; 2]]) -> Vec<Point> {
    points.iter().map(|p| Point::from(*p)).collect()
}

fn square() -> Shape {
    Shape::Polygon(vec![[4.0, -1.0], [6.0, -1.0], [6.0, 1.0], [4.0, 1.0]])
}

/// A U, open above: arms x in [4, 5] and [7, 8], floor y in [-2, -1], up to y = 3.
fn cup() -> Shape {
    let corners = [[4.0, -2.0], [8.0, -2.0], [8.0, 3.0], [7.0, 3.0], [7.0, -1.0], [5.0, -1.0], [5.0, 3.0], [4.0, 3.0]];
    Shape::Polygon(corners.to_vec())
}

#[test]
fn paths_that_are_no_paths() {
    let scene = scene(0.1, vec![]);
    let judge = Judge::new(&scene);
    assert_eq!(judge.verdict(&[]), Err(Fault::NoPath));
    assert_eq!(judge.verdict(&path(&[[0.0, 0.0]])), Err(Fault::NoPath));
    assert_eq!(judge.verdict(&path(&[[f64::NAN, 0.0]])), Err(Fault::NotFinite { point: 0 }));
    assert_eq!(judge.verdict(&path(&[[0.0, 0.0], [10.0, 0.0]])), Ok(()));
    assert_eq!(judge.verdict(&path(&[[0.0, 0.0], [f64::NAN, 1.0], [10.0, 0.0]])), Err(Fault::NotFinite { point: 1 }));
    assert!(matches!(judge.verdict(&path(&[[1e-300, 0.0], [10.0, 0.0]])), Err(Fault::WrongStart(_))), "exactly");
    assert!(matches!(judge.verdict(&path(&[[0.0, 0.0], [10.0, 1e-12]])), Err(Fault::WrongGoal(_))), "exactly");
    assert_eq!(judge.clearance(&path(&[[0.0, 0.0], [10.0, 0.0]])), None, "nothing to keep clear of");
}

#[test]
fn every_shape_stops_paths_at_its_inflated_border_less_epsilon() {
    let disc = Shape::Disc { centre: [5.0, 0.0], radius: 0.5 };
    let capsule = Shape::Capsule { from: [5.0, -1.0], to: [5.0, 0.0], radius: 0.5 };
    for (shape, robot, border) in
        [(disc, 0.25, 0.75), (capsule, 0.25, 0.75), (square(), 0.25, 1.25), (square(), 0.0, 1.0)]
    {
        let scene = scene(robot, vec![shape.clone()]);
        let (judge, epsilon) = (Judge::new(&scene), scene.epsilon());
        let over = |height: f64| path(&[[0.0, 0.0], [0.0, height], [10.0, height], [10.0, 0.0]]);
        assert_eq!(judge.verdict(&over(border)), Ok(()), "grazing {shape:?}");
        assert_eq!(judge.verdict(&over(border - 0.9 * epsilon)), Ok(()), "within ε of {shape:?}");
        let deep = judge.verdict(&over(border - 1.1 * epsilon));
        assert_eq!(deep, Err(Fault::Obstacle { segment: 1, obstacle: "obstacle 0".into() }), "{shape:?}");
        // 1e-14: a few roundings of coordinates up to 10.
        assert!((judge.clearance(&over(border + 0.5)).unwrap() - 0.5).abs() < 1e-14);
        assert!((judge.clearance(&over(border - 0.25)).unwrap() + 0.25).abs() < 1e-12, "{shape:?}");
        let pause = path(&[[0.0, 0.0], [0.0, 2.0], [0.0, 2.0], [10.0, 2.0], [10.0, 0.0]]);
        assert_eq!(judge.verdict(&pause), Ok(()), "a segment of zero length");
        let inside = path(&[[0.0, 0.0], [5.0, 0.0], [5.0, 0.0], [10.0, 0.0]]);
        assert!(judge.verdict(&inside).is_err(), "and one inside {shape:?}");
    }
}

#[test]
fn a_cup_is_not_its_convex_hull() {
    let scene = scene(0.0, vec![cup()]);
    let judge = Judge::new(&scene);
    let into = path(&[[0.0, 0.0], [0.0, 4.0], [6.0, 4.0], [6.0, -1.0], [6.0, 4.0], [10.0, 4.0], [10.0, 0.0]]);
    assert_eq!(judge.verdict(&into), Ok(()), "down to its floor and out again");
    assert_eq!(judge.clearance(&into), Some(0.0));
    let along = path(&[[0.0, 0.0], [0.0, 3.0], [10.0, 3.0], [10.0, 0.0]]);
    assert_eq!(judge.verdict(&along), Ok(()), "along the tops of both arms");
    let across = path(&[[0.0, 0.0], [10.0, 0.0]]);
    assert_eq!(judge.verdict(&across), Err(Fault::Obstacle { segment: 0, obstacle: "obstacle 0".into() }));
    // Each arm is 1 wide; 1e-12: bisection down to rounding of a parameter over length 10.
    assert!((judge.clearance(&across).unwrap() + 0.5).abs() < 1e-12);
    let corner = path(&[[0.0, 0.0], [0.0, 3.0], [4.0, 3.0], [4.0, -2.0], [8.0, -2.0], [8.0, 3.0], [10.0, 0.0]]);
    assert_eq!(judge.verdict(&corner), Ok(()), "round its outside, through corners and along sides");
}

#[test]
fn the_whole_disc_stays_inside_the_field() {
    let mut scene = scene(0.5, vec![]);
    scene.field = Some(Field { min: [-1.0, -2.0], max: [11.0, 2.0] });
    let judge = Judge::new(&scene);
    assert_eq!(judge.verdict(&path(&[[0.0, 0.0], [5.0, 1.5], [10.0, 0.0]])), Ok(()));
    let out = path(&[[0.0, 0.0], [1.0, 0.0], [5.0, 1.500_001], [10.0, 0.0]]);
    assert_eq!(judge.verdict(&out), Err(Fault::Field { segment: 1 }));
    assert!((judge.clearance(&out).unwrap() + 1e-6).abs() < 1e-15);
}

/// The judge and the planners' world agree on random scenes outside a band round the tolerance.
#[test]
fn agrees_with_the_world_of_the_planners() {
    let mut state = 20_120_722;
    let mut uniform = move |lo: f64, hi: f64| lo + (hi - lo) * (splitmix64(&mut state) >> 11) as f64 / 2f64.powi(53);
    let (mut valid, mut banded, mut entered) = (0, 0, 0);
    for round in 0..80 {
        let mut shapes = Vec::new();
        for k in 0..6 {
            let c = [uniform(1.0, 9.0), uniform(-4.0, 4.0)];
            shapes.push(match k % 3 {
                0 => Shape::Disc { centre: c, radius: uniform(0.05, 0.8) },
                1 => Shape::Capsule {
                    from: c,
                    to: [c[0] + uniform(-1.0, 1.0), c[1] + uniform(-1.0, 1.0)],
                    radius: uniform(0.05, 0.4),
                },
                // A random star is simple and usually not convex.
                _ => Shape::Polygon(
                    (0..8)
                        .map(|i| {
                            let (angle, r) = (f64::from(i) * std::f64::consts::FRAC_PI_4, uniform(0.2, 1.2));
                            [c[0] + r * libm::cos(angle), c[1] + r * libm::sin(angle)]
                        })
                        .collect(),
                ),
            });
        }
        let mut scene = scene(if round % 2 == 0 { 0.0 } else { 0.09 }, shapes);
        if round % 3 == 0 {
            scene.field = Some(Field { min: [-1.0, -5.0], max: [11.0, 5.0] });
        }
        let (judge, world) = (Judge::new(&scene), World::new(&scene).unwrap());
        for _ in 0..20 {
            let mut points = vec![scene.start()];
            points.extend((0..3).map(|_| Point::new(uniform(-1.5, 11.5), uniform(-5.5, 5.5))));
            points.push(scene.goal());
            let clearance =
                points.windows(2).map(|w| world.segment_clearance(w[0], w[1])).fold(f64::INFINITY, f64::min);
            // Both sides are bisections or square roots of numbers about 10: 1e-9 is far above their rounding.
            assert!((judge.clearance(&points).unwrap() - clearance).abs() < 1e-9, "round {round}: {points:?}");
            entered += usize::from(clearance < 0.0);
            if (clearance + scene.epsilon()).abs() < 1e-9 * 20.0 {
                banded += 1;
                continue;
            }
            let free = world.first_violation(&points).is_none();
            assert_eq!(judge.verdict(&points).is_ok(), free, "round {round}: {points:?}");
            valid += usize::from(free);
        }
    }
    assert!(valid > 60 && entered > 300, "the test sees both: {valid} valid, {entered} entered");
    assert!(banded < 16, "and decides nearly all: {banded} in the band");
}

#[test]
fn a_scene_is_judged_the_same_at_any_size_and_place() {
    let capsule = |k: f64, o: f64| Shape::Capsule {
        from: [o + 5.0 * k, o - 5.0 * k],
        to: [o + 5.0 * k, o + 5.0 * k],
        radius: 0.1 * k,
    };
    let block = |k: f64, o: f64| {
        Shape::Polygon([[4.0, -1.0], [6.0, -1.0], [6.0, 1.0], [4.0, 1.0]].map(|c| c.map(|v| o + v * k)).to_vec())
    };
    for (k, o) in [(1e-9, 0.0), (1e-6, 0.0), (1e-5, 0.0), (1.0, 0.0), (1e6, 0.0), (1e90, 0.0), (1.0, 1e6), (1e-3, 1e3)]
    {
        for (shape, robot, depth) in [(capsule(k, o), 0.0, 0.1), (block(k, o), 0.09, 1.09), (block(k, o), 0.0, 1.0)] {
            let mut scene = scene(robot * k, vec![shape]);
            scene.start = [o, o];
            scene.goal = [o + 10.0 * k, o];
            assert_eq!(scene.validate(), Ok(()));
            let judge = Judge::new(&scene);
            let through = path(&[scene.start, scene.goal]);
            assert!(judge.verdict(&through).is_err(), "size {k}, place {o}, robot {robot}");
            let clearance = judge.clearance(&through).unwrap();
            // ε is a billionth of the scene's diagonal, as far as coordinates of this size resolve.
            assert!((clearance + depth * k).abs() < scene.epsilon(), "size {k}, place {o}: {clearance}");
            let over = [[o, o], [o, o + 6.0 * k], [o + 10.0 * k, o + 6.0 * k], [o + 10.0 * k, o]];
            assert_eq!(judge.verdict(&path(&over)), Ok(()), "size {k}, place {o}");
        }
    }
}
