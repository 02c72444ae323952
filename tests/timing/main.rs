//! Deadlines are overshot by one inner step at most.

use std::time::{Duration, Instant};

use env_model::generate::{Generator, generate};
use planner_api::{Budget, Plan, Planner, Problem, Run};
use touchline_tests::{planners, scenes};

const MILLISECOND: Duration = Duration::from_millis(1);

/// The most that an inner step may take: one convex programme, or the cells of a fine grid among a thousand
/// obstacles. Up to 2 ms in a debug build on a quiet machine, and three times that on a busy one.
/// A planner that does not look at the clock misses it by tens of milliseconds; how well deadlines are
/// held in an optimised build is measured by the `deadlines` benchmark.
const STEP: Duration = Duration::from_millis(8);

/// Median overshoot of a deadline of 1 ms over 15 seeds.
fn median_overshoot(planner: &mut dyn Planner, problem: &Problem<'_>) -> Duration {
    let mut plan = Plan::new();
    let mut overshoots: Vec<Duration> = (0..15)
        .map(|seed| {
            let deadline = Instant::now() + MILLISECOND;
            let budget = Budget { deadline: Some(deadline), ..Budget::default() };
            // An error counts as well: a coarse grid may have no free cell beside an end in a crowd.
            let _ = planner.plan_into(problem, &mut Run::new(seed).with_budget(budget), &mut plan);
            Instant::now().saturating_duration_since(deadline)
        })
        .collect();
    overshoots.sort();
    overshoots[7]
}

/// Another process may take the processor, for a whole series even; a planner
/// that overshoots by itself does so in every series.
#[test]
fn a_deadline_of_a_millisecond_is_overshot_by_less_than_one_step_at_the_median() {
    let crowd = |generator, obstacles| generate(generator, Some(obstacles), 3, 0).unwrap();
    let crowds = [crowd(Generator::Wall, 200), crowd(Generator::Scrum, 300), crowd(Generator::Open, 1000)];
    for scene in scenes::all().into_iter().chain(crowds) {
        let world = scenes::world(&scene);
        let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
        for (name, mut planner) in planners::planners() {
            let least = (0..3).map(|_| median_overshoot(planner.as_mut(), &problem)).find(|o| *o < STEP);
            assert!(least.is_some(), "{name} in {}: {:?}", scene.name, median_overshoot(planner.as_mut(), &problem));
        }
    }
}
