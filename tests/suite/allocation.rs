//! Steady state allocates nothing: a second call of the same size.

use planner_api::{Plan, Problem, Run};
use planner_catalogue::{build_str, kinds};

use crate::scenes;

#[test]
fn a_second_call_allocates_nothing() {
    // pso-qp builds programmes for a solver.
    for kind in kinds().iter().map(|k| k.name).filter(|k| *k != "pso-qp") {
        for scene in scenes::all() {
            let world = scenes::world(&scene);
            let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
            let mut planner = build_str(kind, settings).unwrap().planner;
            let mut plan = Plan::new();
            let mut call = || planner.plan_into(&problem, &mut Run::new(5), &mut plan).unwrap();
            call();
            let count = allocation_counter::measure(|| {
                call();
            });
            assert_eq!(count.count_total, 0, "{kind} {settings} in {}", scene.name);
        }
    }
}
