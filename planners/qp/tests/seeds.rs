//! The swarm of the 2012 paper, refined: how many seeds reach the column model's optimum.

mod support;

use env_model::World;
use planner_api::{Plan, Planner, Problem, Refiner, Run};
use planner_pso::Pso;
use planner_qp::{Qp, Settings, Solver};
use support::paper;

/// Seeds of 1000 … that end at 231.9500436.
fn reached(solver: Solver, seeds: u64) -> usize {
    let scene = paper();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let mut swarm = Pso::new(planner_pso::Settings { side_classes: 256, ..Default::default() }).unwrap();
    let mut qp = Qp::new(Settings { solver, ..Settings::default() }).unwrap();
    let mut plan = Plan::new();
    let mut optimal = |seed| {
        let mut run = Run::new(seed);
        swarm.plan_into(&problem, &mut run, &mut plan).unwrap();
        qp.refine(&problem, &mut run, &mut plan).unwrap();
        assert!(world.first_violation(&plan.path).is_none());
        // The solvers' 1e-9, and ε/2 = 1.2e-7 of margin at each of four contacts.
        assert!(plan.cost > 231.950_043, "shorter than the model allows: {}", plan.cost);
        plan.cost < 231.950_044_5
    };
    (1000..1000 + seeds).filter(|&seed| optimal(seed)).count()
}

#[test]
fn fifty_seeds_by_either_solver() {
    for solver in [Solver::Clarabel, Solver::Structured] {
        let reached = reached(solver, 50);
        // 998 of 1000 were published: two misses in 50 would happen once in 200 trials.
        assert!(reached >= 49, "{solver:?}: {reached} of 50");
    }
}

#[test]
#[ignore = "seconds in a release build, a minute without optimisation"]
fn a_thousand_seeds_by_either_solver() {
    for solver in [Solver::Clarabel, Solver::Structured] {
        let reached = reached(solver, 1000);
        println!("{solver:?}: {reached} of 1000");
        assert!(reached >= 995, "{solver:?}: {reached} of 1000");
    }
}
