//! Steady state allocates nothing: a second call of the same size.

use planner_api::{Plan, Problem, Run};

use crate::planners::planners;
use crate::scenes;

#[test]
fn a_second_call_allocates_nothing() {
    // The refinement builds programmes for a solver.
    for (name, mut planner) in planners().into_iter().filter(|(name, _)| !name.contains("qp")) {
        for scene in scenes::all() {
            let world = scenes::world(&scene);
            let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
            let mut plan = Plan::new();
            let mut call = || planner.plan_into(&problem, &mut Run::new(5), &mut plan).unwrap();
            call();
            let count = allocation_counter::measure(|| {
                call();
            });
            assert_eq!(count.count_total, 0, "{name} in {}", scene.name);
        }
    }
}
