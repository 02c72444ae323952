use std::ops::ControlFlow;

use env_model::scene::Field;
use env_model::{Scene, Shape};
use planner_api::{Budget, Frame, Observer};

use super::*;
use crate::paper;

fn planners(settings: &StarSettings) -> [RrtStar; 2] {
    [RrtStar::new(settings.clone()).unwrap(), RrtStar::informed(settings.clone()).unwrap()]
}

fn solve(planner: &mut RrtStar, scene: &Scene, seed: u64) -> (Plan, Status) {
    let world = World::new(scene).unwrap();
    planner.plan(&Problem::new(&world, scene.start(), scene.goal()).unwrap(), &mut Run::new(seed)).unwrap()
}

#[test]
fn the_radius_is_that_of_the_theorem() {
    // n = e² nodes of area π e²/6: √(3/π · π e²/6 · 2/e²) = 1, n rounded to 7: √(3/π · π e²/6 · ln 7/7).
    let e2 = std::f64::consts::E.powi(2);
    let expected = (0.5 * e2 * 7.0_f64.ln() / 7.0).sqrt();
    // Three roundings of a number near 1.
    assert!((critical_radius(7, PI * e2 / 6.0) - expected).abs() < 1e-15 * 4.0);
    assert_eq!(critical_radius(1, 1.0), 0.0);
}

#[test]
fn costs_and_links_are_consistent_after_every_kind_of_run() {
    for seed in 0..3 {
        for mut planner in planners(&StarSettings { samples: 1500, ..StarSettings::default() }) {
            let (plan, status) = solve(&mut planner, &paper(), seed);
            assert_eq!(status, Status::Solved);
            planner.tree.assert_consistent();
            // The cost sums the same lengths in the same order.
            assert_eq!(plan.cost, env_model::path_length(&plan.path));
        }
    }
}

/// The tree must be what the definition makes it: no neighbour within reach offers a
/// shorter way to the newest node, or is better off with it as parent, unless blocked.
#[test]
fn the_newest_node_is_rewired_with_all_its_neighbours() {
    let scene = paper();
    let world = World::new(&scene).unwrap();
    let mut planner = RrtStar::new(StarSettings::default()).unwrap();
    planner.tree.plant(scene.start());
    let mut sampler = Sampler::new(9);
    let mut rewired = 0;
    for _ in 0..600 {
        let target = sampler.in_box(&world.extent());
        let parents = planner.tree.tree.view().parents.to_vec();
        let Some(new) = planner.grow(&world, target, 60.0, 50.0, &mut Counters::default()) else { continue };
        let tree = &planner.tree;
        let at = tree.tree.point(new);
        for node in 0..new {
            let other = tree.tree.point(node);
            let distance = (other - at).norm();
            if distance > 50.0 || !world.segment_free(other, at) {
                continue;
            }
            assert!(tree.cost(node) + distance >= tree.cost(new), "{node} is a better parent of {new}");
            assert!(tree.cost(new) + distance >= tree.cost(node), "{new} is a better parent of {node}");
        }
        rewired += parents.iter().zip(tree.tree.view().parents).filter(|(a, b)| a != b).count();
    }
    assert!(rewired > 100, "rewired {rewired} times only");
}

#[test]
fn the_optimum_of_the_papers_scene_is_approached() {
    let optimum = 231.588_978_256_845; // published by the exact planner's golden test
    for (i, samples) in [500, 4000].into_iter().enumerate() {
        for mut planner in planners(&StarSettings { samples, ..StarSettings::default() }) {
            let mut gaps: Vec<f64> =
                (0..9).map(|seed| solve(&mut planner, &paper(), seed).0.cost / optimum - 1.0).collect();
            gaps.sort_by(f64::total_cmp);
            // Slack of ε = 3e-7 cm at four tangent points; see there.
            assert!(gaps[0] > -1e-8, "{}: shorter than possible: {}", planner.name(), gaps[0]);
            // Medians measured below half of these.
            let most = [0.05, 0.02][i];
            assert!(gaps[4] < most, "{}: {} after {samples}", planner.name(), gaps[4]);
        }
    }
}

#[test]
fn once_it_has_a_path_the_informed_form_samples_where_it_may_get_shorter() {
    /// Keeps the best cost at which each node arrived.
    struct Arrivals(Vec<(Point, f64)>, f64);
    impl Observer for Arrivals {
        fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
            let View::Trees([tree]) = frame.view else { panic!("shows its tree") };
            for node in &tree.nodes[self.0.len()..] {
                self.0.push((*node, self.1));
            }
            self.1 = frame.best_cost;
            ControlFlow::Continue(())
        }
    }
    let scene = paper();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let mut counts = Vec::new();
    for mut planner in planners(&StarSettings::default()) {
        let mut arrivals = Arrivals(Vec::new(), f64::INFINITY);
        planner.plan(&problem, &mut Run::new(3).with_observer(&mut arrivals)).unwrap();
        let late: Vec<_> = arrivals.0.iter().filter(|(_, cost)| cost.is_finite()).collect();
        // Coordinates below 1000 round by 1e-13. Steering from outside may end outside, so nodes
        // of the last half only: steps are full samples then.
        let outside = late[late.len() / 2..]
            .iter()
            .filter(|(p, cost)| (p - problem.start).norm() + (p - problem.goal).norm() > cost + 1e-12)
            .count();
        counts.push((outside, late.len()));
    }
    assert!(counts[0].0 > 100, "plain samples lie everywhere: {counts:?}");
    assert_eq!(counts[1].0, 0, "informed ones do not: {counts:?}");
}

#[test]
fn samples_are_clipped_to_the_box() {
    // Start and goal beside the border of the field: half of each ellipse lies outside.
    let extent = Aabb { min: Point::new(0.0, 0.0), max: Point::new(10.0, 6.0) };
    let focus = Focus::new(Point::new(1.0, 0.0), Point::new(9.0, 0.0), extent);
    let mut sampler = Sampler::new(1);
    for cost in [8.0001, 9.0, 12.0, 40.0] {
        for _ in 0..1000 {
            let p = focus.sample(cost, &mut sampler);
            assert!(extent.depth_of(p) >= 0.0 && focus.ellipse.contains(p, cost * (1.0 + 1e-15)));
        }
    }
}

#[test]
fn nodes_in_the_ellipse_are_counted() {
    let extent = Aabb { min: Point::new(0.0, 0.0), max: Point::new(10.0, 6.0) };
    let (start, goal) = (Point::new(2.0, 3.0), Point::new(8.0, 3.0));
    let mut focus = Focus::new(start, goal, extent);
    let mut sampler = Sampler::new(1);
    let mut points = vec![start, goal];
    for cost in [9.0, 8.0, 7.0, 6.5, 6.01] {
        points.extend((0..100).map(|_| sampler.in_box(&extent)));
        let (count, area) = focus.content(&points, cost);
        let inside = points.iter().filter(|p| (**p - start).norm() + (**p - goal).norm() <= cost).count();
        assert_eq!((count, area), (inside, focus.ellipse.area(cost)));
    }
    assert_eq!(Focus::new(start, goal, extent).content(&points, 100.0), (points.len(), 60.0));
}

#[test]
fn in_an_empty_world_no_step_is_longer_than_the_range_and_the_path_nearly_straight() {
    let mut scene = paper();
    scene.obstacles.clear();
    let diagonal = World::new(&scene).unwrap().extent().diagonal();
    for range in [0.05, 0.2] {
        for mut planner in planners(&StarSettings { range, ..StarSettings::default() }) {
            let (plan, status) = solve(&mut planner, &scene, 1);
            assert_eq!((status, plan.counters.iterations), (Status::Solved, 4000), "all samples are drawn");
            let longest = plan.path.windows(2).map(|w| (w[1] - w[0]).norm()).fold(0.0, f64::max);
            // Coordinates below 1000 round by 1e-13.
            assert!(longest <= range * diagonal + 1e-12, "{longest} in {range}");
            let gap = plan.cost / (scene.goal() - scene.start()).norm() - 1.0;
            assert!((0.0..0.01).contains(&gap), "{}: {gap} at {range}", planner.name());
        }
    }
}

#[test]
fn ends_that_touch_obstacles_are_left() {
    // Start and goal on the borders of the discs, which lie between them.
    let mut scene = paper();
    (scene.start, scene.goal) = ([224.0, 160.0], [336.0, 230.0]);
    for mut planner in planners(&StarSettings { samples: 1000, ..StarSettings::default() }) {
        for seed in 0..5 {
            let (plan, status) = solve(&mut planner, &scene, seed);
            assert_eq!(status, Status::Solved, "{} {seed}", planner.name());
            assert!(World::new(&scene).unwrap().first_violation(&plan.path).is_none());
        }
    }
}

/// Stops at its third frame.
struct Third(u32);

impl Observer for Third {
    fn frame(&mut self, _: &Frame<'_>) -> ControlFlow<()> {
        self.0 += 1;
        if self.0 == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn a_closed_room_is_not_found_and_a_budget_returns_the_best_so_far() {
    let mut scene = paper();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    for mut planner in planners(&StarSettings::default()) {
        let budget = Budget { evaluations: Some(900), ..Budget::default() };
        let (plan, status) = planner.plan(&problem, &mut Run::new(1).with_budget(budget)).unwrap();
        assert_eq!((status, plan.counters.evaluations), (Status::BudgetSpent, 900));
        assert!(world.path_free(&plan.path) && plan.path.len() > 2);
        let mut observer = Third(0);
        let (plan, status) = planner.plan(&problem, &mut Run::new(1).with_observer(&mut observer)).unwrap();
        assert_eq!((status, plan.counters.iterations), (Status::BudgetSpent, 2), "frame 0 precedes the samples");
    }
    scene.field = Some(Field { min: [100.0, 100.0], max: [500.0, 300.0] });
    scene.obstacles = vec![Shape::Polygon(vec![[300.0, 90.0], [310.0, 90.0], [310.0, 310.0], [300.0, 310.0]]).into()];
    for mut planner in planners(&StarSettings { samples: 300, ..StarSettings::default() }) {
        let (plan, status) = solve(&mut planner, &scene, 1);
        assert_eq!((status, plan.path.len(), plan.cost), (Status::NotFound, 0, f64::INFINITY));
        assert_eq!(plan.counters.iterations, 300);
    }
}
