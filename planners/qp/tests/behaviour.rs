//! Single cases: classes, budget, observer, ends that touch, paths off the columns.

mod support;

use std::ops::ControlFlow;

use env_model::scene::{Field, Shape};
use env_model::{Columns, LocalFrame, Obstacle, Point, World, path_length};
use planner_api::{Budget, Frame, Observer, Plan, PlanError, Problem, Refinement, Refiner, Run, View};
use planner_qp::{Classes, Model, Objective, Qp, Settings, Solver};
use support::{paper, paper_path, refine, scene};

fn twenty() -> Settings {
    Settings { columns: Some(20), ..Settings::default() }
}

/// A plan whose path is in the +++ class and whose candidates are in all classes.
fn swarm() -> Plan {
    let mut plan = Plan { path: paper_path([true, true, true]), ..Plan::new() };
    for bits in 0..8 {
        plan.candidates.push(paper_path([bits & 1 != 0, bits & 2 != 0, bits & 4 != 0]));
    }
    plan
}

#[test]
fn candidates_show_better_classes_and_the_bound_spares_the_rest() {
    let scene = paper();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let mut plan = swarm();
    let mut run = Run::new(1);
    let outcome = Qp::new(twenty()).unwrap().refine(&problem, &mut run, &mut plan).unwrap();
    assert_eq!(outcome, Refinement::Improved);
    assert!((plan.cost - 231.950_044).abs() < 1e-6, "{}", plan.cost);
    let swarm_solves = run.spent.iterations;
    let (only, _) = refine(&scene, twenty(), paper_path([true, false, false]));
    assert_eq!(swarm_solves, only.counters.iterations, "one class was polished of eight");

    let mut plan = swarm();
    let own = Settings { classes: Classes::Final, ..twenty() };
    Qp::new(own).unwrap().refine(&problem, &mut Run::new(1), &mut plan).unwrap();
    assert!((plan.cost - 236.078).abs() < 6e-4, "the path's own class: {}", plan.cost);
}

#[test]
fn refining_twice_changes_nothing() {
    let scene = paper();
    let (once, _) = refine(&scene, twenty(), paper_path([true, false, false]));
    let (twice, outcome) = refine(&scene, Settings::default(), once.path.clone());
    assert_eq!((outcome, &twice.path), (Refinement::Unchanged, &once.path), "its columns were recognised");
    let (again, _) = refine(&scene, twenty(), paper_path([true, false, false]));
    assert_eq!(once, again, "bit for bit");
}

/// Keeps every frame; ends the run after `last`.
struct Watch {
    last: usize,
    costs: Vec<f64>,
    iterations: Vec<u64>,
}

impl Observer for Watch {
    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
        assert_eq!(frame.stage, "qp");
        let View::Path(path) = frame.view else { panic!("a path was expected") };
        if frame.best_cost.is_finite() {
            assert_eq!(frame.best_cost, path_length(path));
        }
        self.costs.push(frame.best_cost);
        self.iterations.push(frame.iteration);
        if self.costs.len() > self.last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn observers_see_every_round_and_may_end_it() {
    let scene = paper();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    for above in [[true, true, true], [false, false, false]] {
        for last in [usize::MAX, 2] {
            let mut watch = Watch { last, costs: Vec::new(), iterations: Vec::new() };
            let mut plan = Plan { path: paper_path(above), ..Plan::new() };
            let free = world.path_free(&plan.path);
            let mut run = Run::new(1).with_observer(&mut watch);
            let outcome = Qp::new(twenty()).unwrap().refine(&problem, &mut run, &mut plan).unwrap();
            assert_eq!(outcome == Refinement::BudgetSpent, last == 2);
            assert!(!free || world.path_free(&plan.path), "free stays free");
            assert!(watch.costs.windows(2).all(|w| w[1] <= w[0]), "{:?}", watch.costs);
            assert!(watch.iterations.iter().enumerate().all(|(i, &n)| n == i as u64), "{:?}", watch.iterations);
        }
    }
}

#[test]
fn a_budget_is_kept_by_the_structured_solver() {
    let scene = paper();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let mut qp = Qp::new(Settings { solver: Solver::Structured, ..twenty() }).unwrap();
    for (iterations, expected) in [(0, Refinement::BudgetSpent), (1, Refinement::Improved)] {
        let mut plan = Plan { path: paper_path([true, true, true]), ..Plan::new() };
        let mut run = Run::new(1).with_budget(Budget { iterations: Some(iterations), ..Budget::default() });
        assert_eq!(qp.refine(&problem, &mut run, &mut plan), Ok(expected));
        assert!(run.spent.iterations == iterations && plan.counters == run.spent && world.path_free(&plan.path));
    }
}

#[test]
fn a_budget_is_kept_and_leaves_the_best_so_far() {
    let scene = paper();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let original = paper_path([true, true, true]);
    let mut last = f64::INFINITY;
    for iterations in 0..8 {
        let mut plan = Plan { path: original.clone(), ..Plan::new() };
        let mut run = Run::new(1).with_budget(Budget { iterations: Some(iterations), ..Budget::default() });
        let outcome = Qp::new(twenty()).unwrap().refine(&problem, &mut run, &mut plan).unwrap();
        assert!(run.spent.iterations <= iterations && plan.counters == run.spent);
        assert!(world.path_free(&plan.path) && plan.cost <= last);
        last = plan.cost;
        if iterations == 0 {
            assert_eq!((outcome, &plan.path), (Refinement::BudgetSpent, &original));
        }
        if iterations == 7 {
            assert_eq!(outcome, Refinement::Improved, "7 solves suffice");
        }
    }
}

#[test]
fn without_a_path_there_is_nothing_to_repair() {
    let (plan, outcome) = refine(&paper(), Settings::default(), Vec::new());
    assert_eq!((outcome, plan.path.len()), (Refinement::NotRepaired, 0));
}

#[test]
fn paths_of_other_problems_are_refused() {
    let scene = paper();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    for path in [
        vec![scene.start(), Point::new(0.0, 0.0)],
        vec![scene.start()],
        vec![scene.start(), Point::new(f64::NAN, 0.0), scene.goal()],
    ] {
        let mut plan = Plan { path, ..Plan::new() };
        let refused = Qp::new(Settings::default()).unwrap().refine(&problem, &mut Run::new(1), &mut plan);
        assert!(matches!(refused, Err(PlanError::Unsupported(_))), "{refused:?}");
    }
}

/// In an empty world every programme is without rows.
#[test]
fn nothing_in_the_way() {
    let scene = scene([0.0, 0.0], [10.0, 0.0], Vec::new());
    let bent = vec![scene.start(), Point::new(3.0, 4.0), Point::new(7.0, -2.0), scene.goal()];
    for model in [Model::Columns, Model::Free] {
        for objective in [Objective::Shorten, Objective::Smooth] {
            let settings = Settings { model, objective, ..Settings::default() };
            let (plan, outcome) = refine(&scene, settings, bent.clone());
            assert_eq!(outcome, Refinement::Improved);
            // The tolerance of the settings is 1e-9 relative; free vertices approach it by factors.
            assert!(path_length(&plan.path) - 10.0 < 1e-6, "{model:?} {objective:?}: {}", path_length(&plan.path));
        }
    }
    let straight = vec![scene.start(), scene.goal()];
    let (plan, outcome) = refine(&scene, Settings::default(), straight);
    assert_eq!((outcome, plan.counters.iterations), (Refinement::Unchanged, 0));
}

#[test]
fn start_and_goal_may_touch_obstacles() {
    // Both ends on the border of the discs that block the straight line, which meets the first at a right angle.
    let discs = vec![Obstacle::disc(Point::new(5.0, 0.0), 5.0), Obstacle::disc(Point::new(16.0, 3.0), 5.0)];
    let scene = scene([5.0, 5.0], [20.0, 6.0], discs);
    let world = World::new(&scene).unwrap();
    assert!(world.point_clearance(scene.start()).abs() < 1e-12 && world.point_clearance(scene.goal()).abs() < 1e-12);
    let over = vec![scene.start(), Point::new(16.0, 12.0), scene.goal()];
    let (plan, outcome) = refine(&scene, twenty(), over);
    assert_eq!(outcome, Refinement::Improved);
    assert!(world.path_free(&plan.path));
    // Tangent of length 10 to the second disc, at atan2(2, −11) − acos(5/√125) = 106.26°, then its arc to 36.87°.
    let shortest = 10.0 + 5.0 * (106.26_f64 - 36.87).to_radians();
    // The polyline keeps outside an arc of 1.21 rad in about six pieces of φ = 0.2: φ²/12 of 6 longer, and
    // the last one, tangent to the border at the goal, costs as much again.
    assert!(plan.cost > shortest - 1e-3 && plan.cost < shortest + 0.1, "{} {shortest}", plan.cost);
}

#[test]
fn the_field_bounds_columns_and_free_vertices() {
    // A wall from below the lower border to y = 9, the upper border at 10, robot radius 0.5: the gap is at 9.5.
    let wall = Shape::Capsule { from: [5.0, -3.0], to: [5.0, 8.5], radius: 0.5 };
    let mut scene = scene([1.0, 5.0], [9.0, 5.0], vec![wall.into()]);
    scene.robot_radius = 0.49;
    scene.field = Some(Field { min: [0.0, 0.0], max: [10.0, 10.0] });
    let world = World::new(&scene).unwrap();
    let over = vec![scene.start(), Point::new(5.0, 9.5), scene.goal()];
    let under = vec![scene.start(), Point::new(5.0, 0.5), scene.goal()];
    let outside = vec![scene.start(), Point::new(5.0, 14.0), scene.goal()];
    for path in [over, outside] {
        let (plan, outcome) = refine(&scene, twenty(), path);
        assert!(matches!(outcome, Refinement::Improved | Refinement::Repaired), "{outcome:?}");
        assert!(world.path_free(&plan.path));
    }
    let (plan, outcome) = refine(&scene, twenty(), under.clone());
    assert_eq!((outcome, &plan.path), (Refinement::NotRepaired, &under), "the wall reaches below the field");
}

#[test]
fn paths_off_the_columns_are_refined_where_they_are() {
    // Start in a pocket that opens backwards: the way out begins away from the goal.
    let wall = |from: [f64; 2], to: [f64; 2]| Obstacle::from(Shape::Capsule { from, to, radius: 1.0 });
    let obstacles =
        vec![wall([-10.0, 5.0], [5.0, 5.0]), wall([5.0, 5.0], [5.0, -5.0]), wall([5.0, -5.0], [-10.0, -5.0])];
    let scene = scene([0.0, 0.0], [30.0, 0.0], obstacles);
    let world = World::new(&scene).unwrap();
    let way = [[-14.0, 2.0], [-14.0, 8.0], [-5.0, 12.0], [10.0, 12.0]].map(Point::from);
    let path: Vec<Point> = std::iter::once(scene.start()).chain(way).chain([scene.goal()]).collect();
    assert!(world.path_free(&path));
    let (plan, outcome) = refine(&scene, Settings::default(), path.clone());
    assert_eq!(outcome, Refinement::Improved);
    assert!(world.path_free(&plan.path) && plan.cost < path_length(&path) - 3.0, "{}", plan.cost);
    let settings = Settings { objective: Objective::Smooth, w_smooth: 3.0, ..Settings::default() };
    let (plan, outcome) = refine(&scene, settings, path);
    assert_eq!(outcome, Refinement::Improved);
    assert!(world.path_free(&plan.path));
}

/// A polygon with reflex corners is passed side by side, so a path into its notch is kept there.
#[test]
fn a_notch_is_part_of_a_class() {
    // A "U" lying on its side, open to the right, with the start inside.
    let corners =
        vec![[-4.0, -6.0], [8.0, -6.0], [8.0, -4.0], [-2.0, -4.0], [-2.0, 4.0], [8.0, 4.0], [8.0, 6.0], [-4.0, 6.0]];
    let scene = scene([0.0, 2.0], [20.0, 18.0], vec![Shape::Polygon(corners).into()]);
    let world = World::new(&scene).unwrap();
    let frame = LocalFrame::new(scene.start(), scene.goal());
    let path = vec![scene.start(), Point::new(9.0, 3.0), scene.goal()];
    assert!(world.path_free(&path) && frame.to_local(path[1]).x > 0.0);
    let (plan, outcome) = refine(&scene, twenty(), path);
    assert_eq!(outcome, Refinement::Improved);
    let corner = Point::new(8.0, 4.0);
    let shortest = (corner - scene.start()).norm() + (scene.goal() - corner).norm();
    // Columns are 1.22 apart: their kinks lie that near the corner's, and cut its turn of 0.6 rad a little wider.
    assert!(world.path_free(&plan.path) && plan.cost >= shortest - 1e-6 && plan.cost < shortest + 0.1, "{}", plan.cost);
}

/// The column model's optimum has slack off its columns.
#[test]
fn free_vertices_shorten_what_columns_cannot() {
    let scene = paper();
    let columns = Columns::new(scene.start(), scene.goal(), 20);
    let (best, _) = refine(&scene, twenty(), paper_path([true, false, false]));
    let (plan, outcome) = refine(&scene, Settings { model: Model::Free, ..twenty() }, best.path.clone());
    assert_eq!(outcome, Refinement::Improved);
    // Between the optimum in the plane and the columns' own.
    assert!(plan.cost < best.cost && plan.cost > 231.588_978, "{}", plan.cost);
    assert!(columns.count() + 2 == plan.path.len());
}

/// The structured solver on a hundred columns among discs in a row, half of them far from any shorter path.
#[test]
fn obstacles_beyond_any_shorter_path_change_nothing() {
    let disc = |x: f64, y: f64| Obstacle::disc(Point::new(x, y), 4.0);
    let near: Vec<Obstacle> = (1..9).map(|i| disc(10.0 * f64::from(i), if i % 2 == 0 { 1.0 } else { -1.5 })).collect();
    let far = (1..60).flat_map(|i| [60.0, -70.0].map(|y| disc(1.5 * f64::from(i), y)));
    let crowd: Vec<Obstacle> = near.iter().cloned().chain(far).collect();
    for solver in [Solver::Clarabel, Solver::Structured] {
        let run = |obstacles: &[Obstacle]| {
            let mut scene = scene([0.0, 0.0], [90.0, 0.0], obstacles.to_vec());
            // The same ε in both worlds.
            scene.field = Some(Field { min: [-50.0, -100.0], max: [150.0, 100.0] });
            let over = vec![scene.start(), Point::new(1.0, 9.0), Point::new(89.0, 9.0), scene.goal()];
            refine(&scene, Settings { solver, columns: Some(100), ..Settings::default() }, over)
        };
        let ((few, outcome), (many, _)) = (run(&near), run(&crowd));
        assert_eq!(outcome, Refinement::Improved);
        assert_eq!(few.path, many.path, "{solver:?}");
    }
}

/// A class whose gates are open but that no polyline on the columns passes is dismissed, and the path stays.
#[test]
fn structured_repair_fails_where_there_is_no_path() {
    // Two columns: over the first two discs and under the bar between them.
    let discs = [[30.0, -8.0], [60.0, -8.0]].map(|c| Obstacle::disc(c.into(), 10.0));
    let bar = Obstacle::disc(Point::new(45.0, 11.5), 10.0);
    let scene = scene([0.0, 0.0], [90.0, 0.0], discs.into_iter().chain([bar]).collect());
    let between: Vec<Point> = [[0.0, 0.0], [30.0, 1.0], [60.0, 1.0], [90.0, 0.0]].map(Point::from).into();
    for solver in [Solver::Clarabel, Solver::Structured] {
        let settings = Settings { solver, columns: Some(2), classes: Classes::Final, ..Settings::default() };
        let (plan, outcome) = refine(&scene, settings, between.clone());
        assert_eq!((outcome, plan.path), (Refinement::NotRepaired, between.clone()), "{solver:?}");
    }
}
