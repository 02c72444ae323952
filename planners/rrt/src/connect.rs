//! RRT-Connect: a tree from the start and one from the goal; by turns one grows
//! a step towards a random sample and the other as far as it can towards that step's end.
//!
//! Kuffner & `LaValle`, "RRT-Connect: An efficient approach to single-query path
//! planning", ICRA 2000, 995–1001, figs. 2 and 5 (doi 10.1109/ROBOT.2000.844730).

use env_model::{Point, World, path_length};
use planner_api::{Plan, PlanError, Planner, Problem, Run, SettingError, Status, View};

use crate::ConnectSettings;
use crate::sampler::Sampler;
use crate::tree::Tree;

/// Ends with the first path, as found: with no smoothing, and no better with more
/// samples. Its cost is the path's length. An iteration is a sample, an evaluation
/// a step that is tried; each costs one collision check.
#[derive(Debug, Clone)]
pub struct RrtConnect {
    settings: ConnectSettings,
    /// From the start, from the goal.
    trees: [Tree; 2],
}

/// Points that a plan has room for from its first use on.
const CORNERS: usize = 64;

/// What came of a step.
enum Step {
    /// It is blocked.
    Trapped,
    /// It ends short of the target, at this new node.
    Advanced(u32),
    /// This node is at the target.
    Reached(u32),
}

impl RrtConnect {
    /// A planner with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: ConnectSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, trees: Default::default() })
    }

    /// EXTEND: one step of at most `step` from the nearest node towards `target`.
    fn extend(&mut self, side: usize, target: Point, step: f64, world: &World, run: &mut Run<'_>) -> Step {
        let tree = &mut self.trees[side];
        let (nearest, distance) = tree.nearest(target);
        if distance == 0.0 {
            return Step::Reached(nearest);
        }
        let from = tree.point(nearest);
        let to = Tree::steer(from, target, distance, step);
        run.spent.evaluations += 1;
        run.spent.collision_checks += 1;
        // In the direction of travel, so that the path's own test sees the same numbers.
        let free = if side == 0 { world.segment_free(from, to) } else { world.segment_free(to, from) };
        match (free, distance <= step) {
            (false, _) => Step::Trapped,
            (true, false) => Step::Advanced(tree.push(to, nearest)),
            (true, true) => Step::Reached(tree.push(to, nearest)),
        }
    }

    /// CONNECT: steps towards `target` until it is reached.
    fn connect(&mut self, side: usize, target: Point, step: f64, world: &World, run: &mut Run<'_>) -> Option<u32> {
        while run.allows_setup(1) {
            match self.extend(side, target, step, world, run) {
                Step::Trapped => return None,
                Step::Advanced(_) => {}
                Step::Reached(node) => return Some(node),
            }
        }
        None
    }

    fn report(&self, run: &mut Run<'_>, cost: f64) {
        let views = [self.trees[0].view(), self.trees[1].view()];
        run.report("rrt-connect", cost, || View::Trees(&views));
    }
}

impl Planner for RrtConnect {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let Problem { world, start, goal, .. } = *problem;
        let extent = world.extent().including(start).including(goal);
        let range = self.settings.range * extent.diagonal();
        let mut sampler = Sampler::new(run.seed);
        plan.path.reserve(CORNERS);
        self.trees[0].plant(start);
        self.trees[1].plant(goal);
        self.report(run, plan.cost);
        for sample in 0..self.settings.samples {
            if !run.allows(1) {
                break;
            }
            run.spent.iterations += 1;
            let target = sampler.in_box(&extent);
            let side = (sample % 2) as usize;
            if let Step::Advanced(node) | Step::Reached(node) = self.extend(side, target, range, world, run) {
                let meeting = self.trees[side].point(node);
                if let Some(other) = self.connect(1 - side, meeting, range, world, run) {
                    let ends = if side == 0 { [node, other] } else { [other, node] };
                    self.trees[0].append_branch(ends[0], &mut plan.path);
                    plan.path.reverse();
                    // Both trees have a node where they meet.
                    plan.path.pop();
                    self.trees[1].append_branch(ends[1], &mut plan.path);
                    plan.cost = path_length(&plan.path);
                }
            }
            self.report(run, plan.cost);
            if !plan.path.is_empty() {
                break;
            }
        }
        plan.counters = run.spent;
        Ok(match (plan.path.is_empty(), run.stopped()) {
            (_, true) => Status::BudgetSpent,
            (false, false) => Status::Solved,
            (true, false) => Status::NotFound,
        })
    }
}

#[cfg(test)]
mod tests {
    use env_model::scene::Field;
    use env_model::{Obstacle, Scene, Shape};
    use planner_api::Budget;

    use super::*;
    use crate::paper;

    fn solve(settings: ConnectSettings, scene: &Scene, run: &mut Run<'_>) -> (RrtConnect, Plan, Status) {
        let world = World::new(scene).unwrap();
        let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
        let mut planner = RrtConnect::new(settings).unwrap();
        let (plan, status) = planner.plan(&problem, run).unwrap();
        assert_eq!(plan.path.is_empty(), !world.path_free(&plan.path) || plan.path.len() < 2);
        (planner, plan, status)
    }

    #[test]
    fn the_trees_meet_in_one_point_and_no_step_is_longer_than_the_range() {
        let scene = paper();
        let diagonal = World::new(&scene).unwrap().extent().diagonal();
        for range in [0.05, 0.2, 1.0] {
            for seed in 0..50 {
                let settings = ConnectSettings { range, ..ConnectSettings::default() };
                let (planner, plan, status) = solve(settings, &scene, &mut Run::new(seed));
                assert_eq!(status, Status::Solved);
                assert_eq!((plan.path[0], plan.path[plan.path.len() - 1]), (scene.start(), scene.goal()));
                let longest = plan.path.windows(2).map(|w| (w[1] - w[0]).norm()).fold(0.0, f64::max);
                // Coordinates below 1000 round by 1e-13.
                assert!(longest <= range * diagonal + 1e-12, "{longest} in {range}");
                assert!(plan.path.windows(2).all(|w| w[0] != w[1]), "a point twice: {:?}", plan.path);
                for tree in &planner.trees {
                    let view = tree.view();
                    assert!((1..tree.len()).all(|i| (view.parents[i] as usize) < i), "a child before its parent");
                }
                assert_eq!(plan.counters.evaluations, plan.counters.collision_checks);
            }
        }
    }

    #[test]
    fn in_an_empty_world_the_first_sample_joins_the_trees() {
        let mut scene = paper();
        scene.obstacles.clear();
        let diagonal = World::new(&scene).unwrap().extent().diagonal();
        for seed in 0..20 {
            let (_, plan, status) =
                solve(ConnectSettings { range: 0.05, ..Default::default() }, &scene, &mut Run::new(seed));
            assert_eq!((status, plan.counters.iterations), (Status::Solved, 1));
            // A step towards the sample, and from its end to the goal by straight steps as long as allowed.
            let turn = (plan.path[1] - plan.path[0]).norm() + (scene.goal() - plan.path[1]).norm();
            // Some twenty lengths below 1000 are summed.
            assert!((plan.cost - turn).abs() < 1e-11, "{} {turn}", plan.cost);
            let longest = plan.path.windows(2).map(|w| (w[1] - w[0]).norm()).fold(0.0, f64::max);
            assert!(longest <= 0.05 * diagonal + 1e-12, "{longest}");
        }
    }

    #[test]
    fn a_narrow_door_is_found_in_time_and_a_closed_one_never() {
        let mut scene = paper();
        scene.robot_radius = 4.5;
        scene.field = Some(Field { min: [100.0, 100.0], max: [500.0, 300.0] });
        let wall = |low: f64, high: f64| {
            Obstacle::from(Shape::Polygon(vec![[300.0, low], [310.0, low], [310.0, high], [300.0, high]]))
        };
        // A door of 14 for a robot of 9: a fortieth of the field's width.
        scene.obstacles = vec![wall(90.0, 120.0), wall(134.0, 310.0)];
        for seed in 0..10 {
            let (_, _, status) = solve(ConnectSettings::default(), &scene, &mut Run::new(seed));
            assert_eq!(status, Status::Solved, "seed {seed}");
        }
        scene.obstacles = vec![wall(90.0, 310.0)];
        let settings = ConnectSettings { samples: 200, ..ConnectSettings::default() };
        let (_, plan, status) = solve(settings, &scene, &mut Run::new(1));
        assert_eq!((plan.path.len(), plan.cost, status), (0, f64::INFINITY, Status::NotFound));
        assert_eq!(plan.counters.iterations, 200);
    }

    #[test]
    fn a_budget_of_evaluations_holds_within_a_long_connection() {
        for limit in 1..40 {
            let budget = Budget { evaluations: Some(limit), ..Budget::default() };
            let settings = ConnectSettings { range: 0.01, ..ConnectSettings::default() };
            let (_, plan, status) = solve(settings, &paper(), &mut Run::new(2).with_budget(budget));
            assert!(plan.counters.evaluations <= limit);
            assert_eq!(status, Status::BudgetSpent, "40 steps of 1 % do not reach the goal");
        }
    }
}
