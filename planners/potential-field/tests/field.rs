//! Forces against finite differences of the potential, in a scene of all shapes.

use env_model::scene::Field as Border;
use env_model::{Obstacle, Point, Scene, Shape, Vector, World};
use planner_api::Problem;
use planner_potential_field::{Field, PotentialFieldSettings, Repulsion, clearance};

fn scene() -> Scene {
    let shapes = [
        Shape::Disc { centre: [2.0, 3.0], radius: 0.5 },
        Shape::Capsule { from: [4.0, 1.0], to: [6.5, 2.0], radius: 0.2 },
        // A U, open to the left.
        Shape::Polygon(vec![
            [5.0, 3.0],
            [8.0, 3.0],
            [8.0, 5.0],
            [5.0, 5.0],
            [5.0, 4.7],
            [7.7, 4.7],
            [7.7, 3.3],
            [5.0, 3.3],
        ]),
    ];
    Scene {
        name: "shapes".into(),
        unit: "m".into(),
        robot_radius: 0.1,
        start: [1.0, 1.0],
        goal: [9.0, 2.0],
        field: Some(Border { min: [0.0, 0.0], max: [10.0, 6.0] }),
        obstacles: shapes.map(Obstacle::from).to_vec(),
    }
}

#[test]
fn the_force_is_minus_the_gradient_of_the_potential() {
    let scene = scene();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    for repulsion in [Repulsion::Khatib, Repulsion::GeCui] {
        // The well turns conic 3 reaches from the goal: both parts are met.
        let settings = PotentialFieldSettings { repulsion, conic_distance: 3.0, ..PotentialFieldSettings::default() };
        let reach = settings.influence * world.extent().diagonal();
        let field = Field::new(&problem, &settings);
        let (mut repelled, mut conic) = (0, 0);
        for k in 0..4000 {
            // A Kronecker sequence: evenly spread and far from every special position.
            let along = |alpha: f64| (f64::from(k) * alpha).fract();
            let p = Point::new(0.1 + 9.8 * along(0.754_877_666), 0.1 + 5.8 * along(0.569_840_291));
            if world.point_clearance(p) < 0.05 * reach {
                continue;
            }
            // h = 1e-5 ρ0: the third derivative of FIRAS at ρ = ρ0/20 is 2e4 |F|, so the
            // truncation h²/6 U''' stays below 1e-6 |F|; rounding adds 1e-16 U/h < 1e-9 (1 + |F|).
            let h = 1e-5;
            let slope = |axis: Vector| {
                let e = axis * (h * reach);
                (field.potential(p + e) - field.potential(p - e)) / (2.0 * h)
            };
            let (force, gradient) = (field.force(p), Vector::new(slope(Vector::x()), slope(Vector::y())));
            assert!((force + gradient).norm() <= 1e-6 * (1.0 + force.norm()), "{p}: {force} is not −{gradient}");
            repelled += usize::from(world.point_clearance(p) < reach);
            conic += usize::from((scene.goal() - p).norm() > 3.0 * reach);
        }
        assert!(repelled > 500 && conic > 500, "{repelled} {conic}");
    }
}

#[test]
fn the_clearance_is_the_worlds() {
    let scene = scene();
    let world = World::new(&scene).unwrap();
    for k in 0..2000 {
        let along = |alpha: f64| (f64::from(k) * alpha).fract();
        let p = Point::new(10.0 * along(0.754_877_666), 6.0 * along(0.569_840_291));
        for obstacle in world.obstacles() {
            let expected = obstacle.point_clearance(p);
            if expected > 0.0 {
                // Two ways of rounding the same distance in a scene of size 10.
                assert!((clearance(obstacle, p).distance - expected).abs() < 1e-13, "{p}");
            }
        }
    }
}

#[test]
fn the_repulsion_of_ge_and_cui_vanishes_at_the_goal_and_is_khatibs_far_away() {
    let mut scene = scene();
    scene.goal = [2.0, 2.2]; // 0.2 from the first disc, the reach is 0.57
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let khatib = PotentialFieldSettings::default();
    let ge_cui = PotentialFieldSettings { repulsion: Repulsion::GeCui, ..khatib.clone() };
    let (khatib, ge_cui) = (Field::new(&problem, &khatib), Field::new(&problem, &ge_cui));
    assert!(khatib.force(scene.goal()).norm() > 0.1);
    assert_eq!(ge_cui.force(scene.goal()), Vector::zeros());
    let far = Point::new(5.0, 1.0);
    assert!(khatib.force(far).norm() > 1.0, "beside the capsule");
    assert_eq!(khatib.force(far), ge_cui.force(far));
}
