//! What the sampling planners promise: a path where there is one, and with many samples nearly the shortest.

use env_model::generate::{Generator, generate};
use env_model::{Scene, World};
use planner_api::{Plan, Planner, Problem, Run};
use planner_catalogue::build_str;

use crate::scenes;

/// The generator's scenes in which the straight line is blocked.
fn blocked(generator: Generator) -> impl Iterator<Item = Scene> {
    (0..)
        .map(move |index| generate(generator, None, 2, index).unwrap_or_else(|e| panic!("{e}")))
        .filter(|scene| !scenes::world(scene).segment_free(scene.start(), scene.goal()))
}

/// The length of the shortest path.
fn optimum(scene: &Scene) -> Option<f64> {
    let world = scenes::world(scene);
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    planner_tangent::optimum(&problem).ok().map(|optimum| optimum.length)
}

/// The cost of a valid path, +∞ without one.
fn cost(planner: &mut dyn Planner, world: &World, scene: &Scene, seed: u64, plan: &mut Plan) -> f64 {
    let problem = Problem::new(world, scene.start(), scene.goal()).unwrap();
    planner.plan_into(&problem, &mut Run::new(seed), plan).unwrap();
    let valid = !plan.path.is_empty() && world.first_violation(&plan.path).is_none();
    if valid { plan.cost } else { f64::INFINITY }
}

#[test]
fn paths_are_found_in_95_of_100_runs() {
    let mut plan = Plan::new();
    // Measured: 400 of 400 runs of RRT-Connect, 60 of 60 of the others, on each family.
    for generator in [Generator::Wall, Generator::SslA] {
        let scenes: Vec<Scene> = blocked(generator).take(20).collect();
        for (kind, settings) in
            [("rrt-connect", ""), ("rrt-star", "samples = 1000"), ("informed-rrt-star", "samples = 1000")]
        {
            let mut planner = build_str(kind, settings).unwrap().planner;
            let valid = scenes
                .iter()
                .filter(|scene| cost(planner.as_mut(), &scenes::world(scene), scene, 1, &mut plan).is_finite())
                .count();
            assert!(valid >= 19, "{kind} on {}: {valid} of 20", generator.name());
        }
    }
}

#[test]
fn twenty_thousand_samples_come_near_the_optimum() {
    let mut plan = Plan::new();
    let three = |generator| blocked(generator).filter(|scene| optimum(scene).is_some()).take(3).collect();
    for (family, scenes) in
        [("paper", vec![scenes::paper(); 3]), ("wall", three(Generator::Wall)), ("ssl-a", three(Generator::SslA))]
    {
        for kind in ["rrt-star", "informed-rrt-star"] {
            let mut planner = build_str(kind, "samples = 20000").unwrap().planner;
            let mut gaps: Vec<f64> = (0..)
                .zip(&scenes)
                .map(|(seed, scene)| {
                    let length = cost(planner.as_mut(), &scenes::world(scene), scene, seed, &mut plan);
                    length / optimum(scene).unwrap() - 1.0
                })
                .collect();
            gaps.sort_by(f64::total_cmp);
            // Promised: 0.05. Medians measured in walls, scrums, games and logs: 0.0012 to 0.0045; twice the worst.
            assert!(gaps[1] < 0.009, "{kind} on {family}: {gaps:?}");
        }
    }
}
