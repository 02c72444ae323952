//! The exact optimum as a bound for every planner, among every shape.
//!
//! The scenes of [`scenes::all`] are in `contract`; here are those of the generators,
//! two in three obstacles changed into other shapes.

use env_model::generate::{Generator, generate};
use env_model::{Point, Scene, Shape, path_length};
use planner_api::{Budget, Problem, Run};
use planner_tangent::{NoOptimum, optimum};

use touchline_tests::planners::planners;
use touchline_tests::scenes;

/// Scenes of every generator.
const SCENES: u32 = 3;

/// The disc as a capsule, a kite or an arrow head, which is not convex, about as large.
fn changed(i: usize, shape: &Shape) -> Shape {
    let Shape::Disc { centre: [x, y], radius: r } = *shape else { return shape.clone() };
    let turn = i as f64;
    let at = |along: f64, across: f64| {
        let (sin, cos) = (turn.sin(), turn.cos());
        [x + r * (along * cos - across * sin), y + r * (along * sin + across * cos)]
    };
    match i % 6 {
        1 | 4 => Shape::Capsule { from: at(-2.0, 0.0), to: at(2.0, 0.0), radius: 0.4 * r },
        2 => Shape::Polygon(vec![at(-1.0, 0.0), at(0.0, -0.8), at(2.0, 0.0), at(0.0, 0.8)]),
        5 => Shape::Polygon(vec![at(-1.5, -1.5), at(1.5, 0.0), at(-1.5, 1.5), at(-0.3, 0.0)]),
        _ => shape.clone(),
    }
}

/// A generated scene with other shapes, those left out that an end would lie in.
fn mixed(generator: Generator, index: u32) -> Scene {
    let mut scene = generate(generator, None, 9, index).unwrap_or_else(|e| panic!("{e}"));
    for (i, obstacle) in scene.obstacles.iter_mut().enumerate() {
        obstacle.shape = changed(i, &obstacle.shape);
    }
    let ends: [Point; 2] = [scene.start(), scene.goal()];
    for i in (0..scene.obstacles.len()).rev() {
        let shape = scene.inflated(i).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        if ends.iter().any(|end| shape.point_clearance(*end) < 0.0) {
            scene.obstacles.remove(i);
        }
    }
    scene
}

#[test]
fn every_scene_has_an_optimum() {
    for scene in scenes::all() {
        let world = scenes::world(&scene);
        let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
        let best = optimum(&problem);
        assert!(best.is_ok(), "{}: {best:?}", scene.name);
    }
}

#[test]
fn no_planner_undercuts_the_optimum_among_any_shapes() {
    let (mut bounded, mut paths) = (0, 0);
    let scenes = Generator::ALL.into_iter().flat_map(|generator| (0..SCENES).map(move |i| mixed(generator, i)));
    for scene in scenes {
        let world = scenes::world(&scene);
        let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
        let best = match optimum(&problem) {
            Ok(best) => best.length,
            // Then no path is valid.
            Err(NoOptimum::Infeasible) => f64::INFINITY,
            Err(other) => panic!("{}: {other}", scene.name),
        };
        bounded += 1;
        for (name, mut planner) in planners() {
            let budget = Budget { iterations: Some(1000), evaluations: Some(4000), ..Budget::default() };
            // A grid may be too coarse for an end; that says nothing about the optimum.
            let Ok((plan, _)) = planner.plan(&problem, &mut Run::new(30).with_budget(budget)) else { continue };
            if !plan.path.is_empty() && world.first_violation(&plan.path).is_none() {
                let length = path_length(&plan.path);
                // The sum of up to a thousand rounded lengths is good to 1e-13.
                assert!(length >= best * (1.0 - 1e-12), "{name} in {}: {length} < {best}", scene.name);
                paths += 1;
            }
        }
    }
    assert!(
        bounded == Generator::ALL.len() as u32 * SCENES && paths >= 10 * bounded,
        "{bounded} scenes, {paths} valid paths"
    );
}
