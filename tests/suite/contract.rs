//! The contract of `planner_api::Planner`, kept by every kind in the catalogue.

use std::ops::ControlFlow;
use std::time::Instant;

use env_model::{Point, Scene, World, path_length};
use planner_api::{Budget, Detail, Frame, Observer, Plan, PlanError, Planner, Problem, Run, Status, View};

use crate::planners::planners;
use crate::scenes;

/// Calls `check` with every planner in every scene.
fn everywhere(mut check: impl FnMut(&str, &mut dyn Planner, &Scene, &World)) {
    for scene in scenes::all() {
        let world = scenes::world(&scene);
        for (name, mut planner) in planners() {
            check(&format!("{name} in {}", scene.name), planner.as_mut(), &scene, &world);
        }
    }
}

fn plan(planner: &mut dyn Planner, scene: &Scene, world: &World, run: &mut Run<'_>) -> (Plan, Status) {
    let problem = Problem::new(world, scene.start(), scene.goal()).unwrap();
    planner.plan(&problem, run).unwrap()
}

fn has_ends(path: &[Point], scene: &Scene) -> bool {
    path.len() >= 2 && path[0] == scene.start() && path[path.len() - 1] == scene.goal()
}

#[test]
fn paths_have_exact_ends_finite_points_and_keep_what_the_status_promises() {
    everywhere(|name, planner, scene, world| {
        for seed in 0..3 {
            let (plan, status) = plan(planner, scene, world, &mut Run::new(seed));
            assert!(plan.path.iter().all(|p| p.x.is_finite() && p.y.is_finite()), "{name}");
            let violation = world.first_violation(&plan.path);
            match status {
                Status::Solved => {
                    assert!(has_ends(&plan.path, scene), "{name}: {:?}", plan.path);
                    assert_eq!(violation, None, "{name}: believes in a colliding path");
                    assert!(plan.cost.is_finite(), "{name}");
                }
                Status::NotFound => {
                    assert!(plan.path.is_empty() || has_ends(&plan.path, scene), "{name}");
                    assert!(plan.path.is_empty() || violation.is_some(), "{name}: does not believe in a free path");
                }
                Status::Infeasible => panic!("{name}: every scene here is solvable"),
                Status::BudgetSpent => panic!("{name}: there was no budget"),
            }
            assert!(plan.counters.evaluations > 0 && plan.counters.collision_checks > 0, "{name}: counts its work");
        }
    });
}

#[test]
fn a_zero_budget_ends_at_once_and_is_no_error() {
    let none = Budget::default();
    let zeros = [
        Budget { iterations: Some(0), ..none },
        Budget { evaluations: Some(0), ..none },
        Budget { deadline: Some(Instant::now()), ..none },
    ];
    everywhere(|name, planner, scene, world| {
        for budget in zeros {
            let (plan, status) = plan(planner, scene, world, &mut Run::new(1).with_budget(budget));
            assert_eq!(status, Status::BudgetSpent, "{name}: {budget:?}");
            assert!(plan.path.is_empty() || has_ends(&plan.path, scene), "{name}");
            assert!(plan.counters.iterations == 0, "{name}: {budget:?}");
            if budget.evaluations.is_some() {
                assert_eq!(plan.counters.evaluations, 0, "{name}");
            }
        }
    });
}

#[test]
fn count_budgets_are_never_exceeded() {
    everywhere(|name, planner, scene, world| {
        for limit in [1, 7, 50, 300] {
            let budget = Budget { iterations: Some(limit), ..Budget::default() };
            let (by_iterations, _) = plan(planner, scene, world, &mut Run::new(2).with_budget(budget));
            assert!(by_iterations.counters.iterations <= limit, "{name}: {limit} iterations");
            let budget = Budget { evaluations: Some(limit), ..Budget::default() };
            let (by_evaluations, _) = plan(planner, scene, world, &mut Run::new(2).with_budget(budget));
            assert!(by_evaluations.counters.evaluations <= limit, "{name}: {limit} evaluations");
        }
    });
}

#[test]
fn the_same_seed_gives_the_same_plan_again_after_reset_and_in_a_new_planner() {
    for scene in scenes::all() {
        let world = scenes::world(&scene);
        for ((name, mut planner), (_, mut fresh)) in planners().into_iter().zip(planners()) {
            let first = plan(planner.as_mut(), &scene, &world, &mut Run::new(11));
            let other = plan(planner.as_mut(), &scene, &world, &mut Run::new(12));
            planner.reset();
            let again = plan(planner.as_mut(), &scene, &world, &mut Run::new(11));
            assert_eq!(first, again, "{name} in {}", scene.name);
            let new = plan(fresh.as_mut(), &scene, &world, &mut Run::new(12));
            assert_eq!(other, new, "{name} in {}: a fresh planner", scene.name);
        }
    }
}

/// The planners that draw random numbers.
fn random_planners() -> impl Iterator<Item = (String, Box<dyn Planner>)> {
    const DETERMINISTIC: &[&str] =
        &["straight", "tangent", "influence", "astar", "dijkstra", "theta-star", "potential", "neural"];
    planners().into_iter().filter(|(name, _)| !DETERMINISTIC.iter().any(|d| name.starts_with(d)))
}

#[test]
fn seeds_matter_to_random_planners() {
    let scene = scenes::paper();
    let world = scenes::world(&scene);
    for (name, mut planner) in random_planners().filter(|(name, _)| !name.contains("qp")) {
        let (a, _) = plan(planner.as_mut(), &scene, &world, &mut Run::new(1));
        let (b, _) = plan(planner.as_mut(), &scene, &world, &mut Run::new(2));
        assert_ne!(a.path, b.path, "{name}");
    }
}

/// Checks frames as they come.
struct Watch {
    name: String,
    detail: Detail,
    frames: usize,
    last: Option<(&'static str, f64, u64, u64)>,
    stop_after: usize,
}

impl Observer for Watch {
    fn detail(&self) -> Detail {
        self.detail
    }

    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
        let name = &self.name;
        if let Some((stage, cost, iteration, evaluations)) = self.last {
            assert!(frame.iteration >= iteration && frame.evaluations >= evaluations, "{name}: counters go back");
            if stage == frame.stage {
                assert!(frame.best_cost <= cost, "{name}: best cost rises {cost} → {}", frame.best_cost);
            }
        }
        if let View::Swarm(swarm) = &frame.view {
            let (n, m) = (swarm.personal_costs.len(), swarm.columns.count());
            for matrix in [swarm.positions, swarm.velocities, swarm.personal_bests] {
                assert_eq!(matrix.len(), n * m, "{name}");
            }
            assert_eq!(swarm.global_best.len(), m, "{name}");
            let least = swarm.personal_costs.iter().copied().fold(f64::INFINITY, f64::min);
            assert_eq!(least, swarm.global_cost, "{name}: the global best is the best personal best");
        }
        if let View::Population(population) = &frame.view {
            assert_eq!(population.paths.len(), population.fitness.len(), "{name}");
            assert!(population.fitness.iter().all(|f| f.is_finite() && *f >= 0.0), "{name}");
            let ends = |path: &[Point]| (path[0], path[path.len() - 1]);
            assert!(population.paths.iter().all(|p| ends(p) == ends(population.best)), "{name}");
        }
        self.last = Some((frame.stage, frame.best_cost, frame.iteration, frame.evaluations));
        self.frames += 1;
        if self.frames == self.stop_after { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

fn watch(name: &str, detail: Detail, stop_after: usize) -> Watch {
    Watch { name: name.to_owned(), detail, frames: 0, last: None, stop_after }
}

#[test]
fn best_cost_never_worsens_and_watching_changes_nothing() {
    everywhere(|name, planner, scene, world| {
        let unseen = plan(planner, scene, world, &mut Run::new(4));
        for detail in [Detail::Progress, Detail::State] {
            let mut observer = watch(name, detail, usize::MAX);
            let seen = plan(planner, scene, world, &mut Run::new(4).with_observer(&mut observer));
            assert_eq!(unseen, seen, "{name}");
            assert!(observer.frames > 0, "{name} shows nothing");
        }
    });
}

#[test]
fn an_observer_can_stop_the_run() {
    let scene = scenes::paper();
    let world = scenes::world(&scene);
    // Its first frame shows its answer: nothing is left to stop.
    const ONE_FRAME: &[&str] = &["straight-line"];
    // They have no path until they reach the goal, so soon after the start they have none.
    const GROWING: &[&str] = &[
        "tangent",
        "rrt",
        "informed-rrt",
        "astar",
        "dijkstra",
        "theta-star",
        "influence-astar",
        "neural",
        "potential-field",
    ];
    for (name, mut planner) in planners().into_iter().filter(|(name, _)| !ONE_FRAME.contains(&name.as_str())) {
        // Among three discs the second frame of the exact planner shows its answer.
        let last = if name == "tangent" { 1 } else { 2 };
        let mut observer = watch(&name, Detail::Progress, last);
        let (plan, status) = plan(planner.as_mut(), &scene, &world, &mut Run::new(4).with_observer(&mut observer));
        assert_eq!((status, observer.frames), (Status::BudgetSpent, last), "{name}");
        let none_yet = plan.path.is_empty() && GROWING.iter().any(|kind| name.starts_with(kind));
        assert!(none_yet || has_ends(&plan.path, &scene), "{name}: best so far");
    }
}

#[test]
fn no_valid_path_is_shorter_than_the_optimum() {
    let mut checked = 0;
    everywhere(|name, planner, scene, world| {
        let problem = Problem::new(world, scene.start(), scene.goal()).unwrap();
        let optimum = planner_tangent::optimum(&problem).unwrap();
        for seed in 20..23 {
            let (plan, _) = plan(planner, scene, world, &mut Run::new(seed));
            if !plan.path.is_empty() && world.first_violation(&plan.path).is_none() {
                let length = path_length(&plan.path);
                // The sum of up to a few hundred rounded lengths: 1e-13 relative is a hundred times their error.
                assert!(length >= optimum.length * (1.0 - 1e-13), "{name}: {length} < {}", optimum.length);
                checked += 1;
            }
        }
    });
    assert!(checked > 100, "only {checked} valid paths");
}

#[test]
fn ends_in_obstacles_are_typed_errors() {
    let scene = scenes::paper();
    let world = scenes::world(&scene);
    let inside = Point::new(241.0, 160.0);
    match Problem::new(&world, inside, scene.goal()) {
        Err(PlanError::InsideObstacle { end: "start", obstacle: 0, depth, .. }) => {
            assert!((depth - 15.0).abs() < 1e-12);
        }
        other => panic!("{other:?}"),
    }
    assert!(matches!(Problem::new(&world, scene.start(), scene.start()), Err(PlanError::StartIsGoal { .. })));
    let nan = Point::new(f64::NAN, 0.0);
    assert!(matches!(Problem::new(&world, scene.start(), nan), Err(PlanError::NotFinite { end: "goal", .. })));
}
