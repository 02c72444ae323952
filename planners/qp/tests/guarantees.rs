//! What refinement promises, on random scenes with random paths.

mod support;

use env_model::scene::{Field, Shape};
use env_model::{Obstacle, Point, Scene, World, path_length};
use planner_api::{Plan, Problem, Refinement, Refiner, Run};
use planner_qp::{Classes, Method, Model, Objective, Qp, Settings, Solver};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use support::scene;

const START: [f64; 2] = [0.0, 0.0];
const GOAL: [f64; 2] = [80.0, 60.0];

fn obstacle() -> impl Strategy<Value = Obstacle> {
    let at = || (5.0..75.0, -5.0..65.0).prop_map(|(x, y)| [x, y]);
    let disc = (at(), 1.0..12.0).prop_map(|(centre, radius)| Shape::Disc { centre, radius });
    let capsule = (at(), -12.0..12.0, -12.0..12.0, 0.5..6.0).prop_map(|([x, y], dx, dy, radius)| Shape::Capsule {
        from: [x, y],
        to: [x + dx, y + dy],
        radius,
    });
    // A star of five corners: convex or not, always simple.
    let star = (at(), prop::array::uniform5(2.0..12.0)).prop_map(|([x, y], reach)| {
        let spoke = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / 5.0;
            [x + reach[i] * angle.cos(), y + reach[i] * angle.sin()]
        };
        Shape::Polygon((0..5).map(spoke).collect())
    });
    prop_oneof![3 => disc, 1 => capsule, 1 => star].prop_map(Obstacle::from)
}

fn scenes() -> impl Strategy<Value = Scene> {
    let field = prop::option::of(Just(Field { min: [-12.0, -14.0], max: [95.0, 80.0] }));
    (prop::collection::vec(obstacle(), 1..9), prop_oneof![Just(0.0), 0.5..2.0], field)
        .prop_map(|(obstacles, robot_radius, field)| Scene { robot_radius, field, ..scene(START, GOAL, obstacles) })
        .prop_filter("start and goal are free", |s| World::new(s).is_ok_and(|w| s.validate_ends(&w).is_ok()))
}

/// Vertices in the box round the scene: near start → goal, on columns, or anywhere.
fn paths() -> impl Strategy<Value = Vec<Point>> {
    let local = |x: f64, y: f64| Point::new(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y);
    let ends = |inner: Vec<Point>| {
        let mut path = vec![Point::from(START)];
        path.extend(inner);
        path.push(GOAL.into());
        path
    };
    let monotone =
        prop::collection::vec((0.0..100.0, -30.0..30.0), 1..8).prop_map(move |mut inner: Vec<(f64, f64)>| {
            inner.sort_by(|a, b| a.0.total_cmp(&b.0));
            inner.into_iter().map(|(x, y)| local(x, y)).collect()
        });
    let columns = prop::collection::vec(-30.0..30.0, 1..25).prop_map(move |y: Vec<f64>| {
        let spacing = 100.0 / (y.len() + 1) as f64;
        y.iter().enumerate().map(|(i, &y)| local((i + 1) as f64 * spacing, y)).collect()
    });
    let anywhere = prop::collection::vec((-10.0..90.0, -12.0..78.0), 1..7)
        .prop_map(|inner: Vec<(f64, f64)>| inner.into_iter().map(|(x, y)| Point::new(x, y)).collect());
    prop_oneof![2 => monotone, 2 => columns, 2 => anywhere].prop_map(ends)
}

fn settings() -> impl Strategy<Value = Settings> {
    let model = prop_oneof![Just(Model::Columns), Just(Model::Free)];
    let objective = prop_oneof![2 => Just(Objective::Shorten), 1 => Just(Objective::Smooth)];
    let method = prop_oneof![3 => Just(Method::ReweightedQp), 1 => Just(Method::Socp)];
    let solver = prop_oneof![Just(Solver::Clarabel), Just(Solver::Structured)];
    let weights = prop::array::uniform3(prop_oneof![Just(0.0), 0.01..3.0]);
    (model, objective, method, solver, weights).prop_map(
        |(model, objective, method, solver, [w_smooth, w_reference, more])| {
            let covered = model == Model::Columns && method == Method::ReweightedQp;
            Settings {
                model,
                objective,
                method,
                solver: if covered { solver } else { Solver::Clarabel },
                w_smooth,
                w_reference,
                w_length: 0.1 + more,
                max_rounds: 30,
                ..Settings::default()
            }
        },
    )
}

/// Everything that holds for any path, whatever the outcome.
fn check(
    scene: &Scene,
    settings: &Settings,
    path: &[Point],
    candidates: &[Vec<Point>],
) -> Result<Refinement, TestCaseError> {
    let world = World::new(scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let mut plan = Plan { path: path.to_vec(), ..Plan::new() };
    candidates.iter().for_each(|c| plan.candidates.push(c.iter().copied()));
    let mut qp = Qp::new(settings.clone()).unwrap();
    let mut run = Run::new(1);
    let outcome = qp.refine(&problem, &mut run, &mut plan).unwrap();
    let (old, new) = (path, &plan.path[..]);
    let free = world.path_free(old);
    prop_assert_eq!((new[0], new[new.len() - 1]), (scene.start(), scene.goal()));
    prop_assert_eq!(plan.counters, run.spent);
    match outcome {
        Refinement::Improved | Refinement::Unchanged => prop_assert!(free),
        Refinement::Repaired | Refinement::NotRepaired => prop_assert!(!free),
        Refinement::BudgetSpent => prop_assert!(false, "there was no budget"),
    }
    if matches!(outcome, Refinement::Unchanged | Refinement::NotRepaired) {
        prop_assert_eq!(new, old);
    } else {
        prop_assert!(world.path_free(new));
        // The other oracle: bisection on signed distances, tolerance ε instead of ε/2.
        prop_assert!(world.first_violation(new).is_none(), "{:?}", world.first_violation(new));
    }
    if free && settings.objective == Objective::Shorten {
        prop_assert!(path_length(new) <= path_length(old), "{} > {}", path_length(new), path_length(old));
        prop_assert_eq!(plan.cost, path_length(new));
    }
    Ok(outcome)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        max_global_rejects: 10_000,
        // The same cases everywhere; other seeds have been run by the thousand.
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn no_path_gets_worse(scene in scenes(), settings in settings(), path in paths(), others in prop::collection::vec(paths(), 0..4)) {
        check(&scene, &settings, &path, &others)?;
    }

    /// A colliding path made from a free one of the same sides is repaired:
    /// pulled towards start → goal it enters obstacles, but the class has a path on as many columns.
    #[test]
    fn feasible_classes_are_repaired(
        scene in scenes(),
        heights in prop::collection::vec(-30.0..30.0, 12..20),
        method in prop_oneof![Just(Method::ReweightedQp), Just(Method::Socp)],
    ) {
        let world = World::new(&scene).unwrap();
        let columns = env_model::Columns::new(scene.start(), scene.goal(), heights.len());
        let settings = Settings { method, classes: Classes::Final, ..Settings::default() };
        let mut path = Vec::new();
        columns.write_path(&heights, &mut path);
        // First a free member of some class, by repair or by chance.
        let (member, outcome) = support::refine(&scene, settings.clone(), path);
        prop_assume!(outcome != Refinement::NotRepaired);
        // Then one vertex moved a little inside an obstacle, if that leaves the sides alone.
        for i in 1..=heights.len() {
            for push in [-0.5, 0.5] {
                let mut bent = member.path.clone();
                bent[i] += (columns.frame().to_world(Point::new(0.0, push)) - scene.start()) * 1.0;
                if world.path_free(&bent) {
                    continue;
                }
                // Obstacles thinner than the push may change sides.
                let thin = scene.obstacles.iter().any(|o| !matches!(o.shape, Shape::Disc { radius, .. } if radius > 2.0));
                if thin {
                    continue;
                }
                let outcome = check(&scene, &settings, &bent, &[])?;
                prop_assert_eq!(outcome, Refinement::Repaired);
            }
        }
    }

    /// Two algorithms for one convex problem.
    #[test]
    fn both_methods_agree(scene in scenes(), heights in prop::collection::vec(-30.0..30.0, 5..20)) {
        let columns = env_model::Columns::new(scene.start(), scene.goal(), heights.len());
        let mut path = Vec::new();
        columns.write_path(&heights, &mut path);
        let run = |method| support::refine(&scene, Settings { method, ..Settings::default() }, path.clone());
        let ((qp, qp_outcome), (socp, socp_outcome)) = (run(Method::ReweightedQp), run(Method::Socp));
        prop_assert_eq!(qp_outcome, socp_outcome);
        if matches!(qp_outcome, Refinement::Repaired | Refinement::Improved) {
            prop_assert!((qp.cost - socp.cost).abs() < 1e-7 * qp.cost, "{} {}", qp.cost, socp.cost);
        }
    }

    /// Cutting planes by clarabel against one curved programme: the same optimum of the same convex problem.
    #[test]
    fn both_solvers_agree(
        scene in scenes(),
        heights in prop::collection::vec(-30.0..30.0, 2..25),
        smooth in prop::option::of(prop::array::uniform2(0.0..3.0)),
    ) {
        let columns = env_model::Columns::new(scene.start(), scene.goal(), heights.len());
        let mut path = Vec::new();
        columns.write_path(&heights, &mut path);
        let [w_smooth, w_reference] = smooth.unwrap_or_default();
        let objective = if smooth.is_some() { Objective::Smooth } else { Objective::Shorten };
        let settings = Settings { objective, w_smooth, w_reference, classes: Classes::Final, ..Settings::default() };
        let run = |solver| support::refine(&scene, Settings { solver, ..settings.clone() }, path.clone());
        let ((one, one_outcome), (two, two_outcome)) = (run(Solver::Clarabel), run(Solver::Structured));
        prop_assert_eq!(one_outcome, two_outcome);
        if matches!(one_outcome, Refinement::Repaired | Refinement::Improved) {
            prop_assert!((one.cost - two.cost).abs() < 1e-7 * one.cost, "{} {}", one.cost, two.cost);
        }
    }
}
