//! Steady state allocates nothing: a second call of the same size.

use env_model::{Scene, World};
use planner_api::{Plan, Planner, Problem, Run};
use planner_catalogue::{build_str, kinds};

use crate::planners::planners;
use crate::scenes;

/// Allocations of `rounds` over all of `problems` with three seeds each, after a first round with the same seeds.
fn allocations(planner: &mut dyn Planner, problems: &[Problem<'_>], rounds: usize) -> u64 {
    let mut plan = Plan::new();
    let mut round = || {
        for problem in problems {
            for seed in 5..8 {
                planner.plan_into(problem, &mut Run::new(seed), &mut plan).unwrap();
            }
        }
    };
    round();
    allocation_counter::measure(|| (0..rounds).for_each(|_| round())).count_total
}

fn problem<'a>(world: &'a World, scene: &Scene) -> Problem<'a> {
    Problem::new(world, scene.start(), scene.goal()).unwrap()
}

#[test]
fn a_second_call_allocates_nothing() {
    // Clarabel builds a programme a solve; the swarm of `pso-qp` is tested below.
    for (name, mut planner) in planners().into_iter().filter(|(name, _)| !name.contains("qp")) {
        for scene in scenes::all() {
            let world = scenes::world(&scene);
            let count = allocations(planner.as_mut(), &[problem(&world, &scene)], 1);
            assert_eq!(count, 0, "{name} in {}", scene.name);
        }
    }
}

/// A game goes on: after a hundred calls each new one has a seed of its own.
fn allocations_later(planner: &mut dyn Planner, problems: &[Problem<'_>]) -> u64 {
    let mut plan = Plan::new();
    let mut calls = |seeds: std::ops::Range<u64>| {
        for (seed, problem) in seeds.zip(problems.iter().cycle()) {
            planner.plan_into(problem, &mut Run::new(seed), &mut plan).unwrap();
        }
    };
    calls(0..100);
    allocation_counter::measure(|| calls(100..150)).count_total
}

#[test]
fn real_time_planners_allocate_nothing_as_a_game_goes_on() {
    let scenes = scenes::games(8);
    let worlds: Vec<World> = scenes.iter().map(scenes::world).collect();
    let problems: Vec<Problem<'_>> = worlds.iter().zip(&scenes).map(|(world, scene)| problem(world, scene)).collect();
    let mut claims = Vec::new();
    for kind in kinds().iter().filter(|kind| kind.real_time) {
        let mut planner = build_str(kind.name, "").unwrap().planner;
        assert_eq!(allocations_later(planner.as_mut(), &problems), 0, "{}", kind.name);
        claims.push(kind.name);
    }
    for name in ["straight-line", "pso", "tangent", "rrt-connect"] {
        assert!(claims.contains(&name), "{name} claims real time");
    }
}

#[test]
fn the_swarm_of_pso_qp_allocates_nothing() {
    // All that `pso-qp` runs before it refines: the swarm with its memory of side classes.
    let memory = build_str("pso-qp", "").unwrap().settings["side_classes"].as_integer().unwrap();
    let mut swarm = build_str("pso", &format!("side_classes = {memory}")).unwrap().planner;
    for scene in [scenes::paper(), scenes::reference("wall-00"), scenes::reference("dense-0")] {
        let world = scenes::world(&scene);
        let problem = problem(&world, &scene);
        let mut plan = Plan::new();
        swarm.plan_into(&problem, &mut Run::new(5), &mut plan).unwrap();
        assert!(plan.candidates.len() > 1, "hands on side classes in {}", scene.name);
        assert_eq!(allocations(swarm.as_mut(), &[problem], 1), 0, "{}", scene.name);
    }
}
