//! Deadlines are overshot by one inner step at most.

use std::time::{Duration, Instant};

use planner_api::{Budget, Plan, Problem, Run};

use crate::contract::planners;
use crate::scenes;

#[test]
fn a_deadline_of_a_millisecond_is_overshot_by_less_than_one_at_the_median() {
    let allowed = Duration::from_millis(1);
    for scene in scenes::all() {
        let world = scenes::world(&scene);
        let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
        for (name, mut planner) in planners() {
            let mut plan = Plan::new();
            let mut overshoots: Vec<Duration> = (0..15)
                .map(|seed| {
                    let deadline = Instant::now() + allowed;
                    let budget = Budget { deadline: Some(deadline), ..Budget::default() };
                    planner.plan_into(&problem, &mut Run::new(seed).with_budget(budget), &mut plan).unwrap();
                    Instant::now().saturating_duration_since(deadline)
                })
                .collect();
            overshoots.sort();
            assert!(overshoots[7] < Duration::from_millis(1), "{name} in {}: {:?}", scene.name, overshoots[7]);
        }
    }
}
