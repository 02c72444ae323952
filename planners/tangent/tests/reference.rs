//! Agreement with the stored optima of the reference scenes.

use std::fs;

use env_model::{Point, Scene, World, path_length};
use planner_api::{Plan, Planner, Problem, Run, Status};
use planner_tangent::{Outcome, Settings, Solver, Tangent, optimum};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/reference");

/// Every reference scene and its optimum.
fn references() -> Vec<(Scene, f64)> {
    let text = fs::read_to_string(format!("{FOLDER}/optima.csv")).unwrap();
    let read = |line: &str| {
        let (name, optimum) = line.split_once(',').unwrap();
        let path = format!("{FOLDER}/{name}.toml");
        (Scene::from_toml(&path, &fs::read_to_string(&path).unwrap()).unwrap(), optimum.parse().unwrap())
    };
    let all: Vec<_> = text.lines().skip(1).map(read).collect();
    assert_eq!(all.len(), 13);
    all
}

#[test]
fn the_solver_agrees_with_every_reference_optimum() {
    let mut solver = Solver::new();
    let mut path = Vec::new();
    for (scene, expected) in references() {
        let world = World::new(&scene).unwrap();
        let discs: Vec<(Point, f64)> = world.obstacles().iter().map(|o| o.as_disc().unwrap()).collect();
        for (from, to) in [(scene.start(), scene.goal()), (scene.goal(), scene.start())] {
            let outcome = solver.shortest(&discs, from, to);
            let Outcome::Found { length } = outcome else { panic!("{}: {outcome:?}", scene.name) };
            // Both solvers are exact: sums of a few dozen roundings of 1e-16.
            assert!((length / expected - 1.0).abs() < 1e-13, "{}: {length} against {expected}", scene.name);
            for excess in [1e-2, 1e-4, 1e-6, 1e-8] {
                solver.write_polyline(excess, &mut path);
                assert!(world.path_free(&path), "{}: {:?}", scene.name, world.first_violation(&path));
                let found = path_length(&path) / length - 1.0;
                // Summing thousands of short segments rounds by 1e-13.
                assert!(found > -1e-13 && found <= excess + 1e-13, "{}: {found:e} above {excess:e}", scene.name);
                assert_eq!((path[0], path[path.len() - 1]), (from, to));
            }
        }
    }
}

#[test]
fn planner_and_optimum_agree_with_every_reference_optimum() {
    let mut planner = Tangent::new(Settings::default()).unwrap();
    let mut plan = Plan::new();
    for (scene, expected) in references() {
        let world = World::new(&scene).unwrap();
        let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
        let best = optimum(&problem).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        // Shrinking by ε shortens the path by about ε for each radian that it turns, a few times 1e-9 in all.
        let gap = expected - best.length;
        assert!(gap >= -1e-13 * expected && gap < 1e-8 * expected, "{}: {} of {expected}", scene.name, best.length);
        let deepest = best.path.windows(2).map(|w| world.segment_clearance(w[0], w[1])).fold(0.0, f64::min);
        // It touches discs shrunk by ε; the solver's tolerance is ε/1000.
        assert!(deepest >= -1.01 * world.epsilon(), "{}: {deepest:e}", scene.name);

        let mut run = Run::new(1);
        assert_eq!(planner.plan_into(&problem, &mut run, &mut plan).unwrap(), Status::Solved);
        assert!(plan.cost >= best.length && plan.cost <= expected * (1.0 + 1e-13), "{}", scene.name);
        assert!(world.path_free(&plan.path), "{}", scene.name);
        // 1e-6 of excess, and the planner's extra radius of three quarters of ε.
        let found = path_length(&plan.path) / best.length - 1.0;
        assert!((0.0..1.01e-6).contains(&found), "{}: {found:e}", scene.name);
        assert_eq!((plan.path[0], plan.path[plan.path.len() - 1]), (scene.start(), scene.goal()));
        assert_eq!(plan.counters, run.spent);
        assert!(plan.counters.iterations >= 1 && plan.counters.collision_checks >= plan.counters.iterations);
    }
}
