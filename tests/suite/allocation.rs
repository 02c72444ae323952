//! Steady state allocates nothing: a second call of the same size.

use planner_api::{Plan, Problem, Run};
use planner_catalogue::build_str;

use crate::scenes;

#[test]
fn a_second_call_allocates_nothing() {
    for kind in ["straight-line", "random-search", "pso", "tangent", "rrt-connect", "rrt-star", "informed-rrt-star"] {
        for scene in scenes::all() {
            let world = scenes::world(&scene);
            let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
            let mut planner = build_str(kind, "").unwrap().planner;
            let mut plan = Plan::new();
            let mut call = || planner.plan_into(&problem, &mut Run::new(5), &mut plan).unwrap();
            call();
            let count = allocation_counter::measure(|| {
                call();
            });
            assert_eq!(count.count_total, 0, "{kind} in {}", scene.name);
        }
    }
}
