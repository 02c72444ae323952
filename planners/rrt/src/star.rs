//! RRT*, and its informed form.
//!
//! Each sample steers a step from the nearest node; the new node takes the parent
//! within radius r that makes its way from the start shortest, and becomes the
//! parent of neighbours whose ways it shortens:
//! r = min(η, f·√(3 μ ln n / (π n))), n nodes in area μ.
//! - RRT*: samples uniform in the box; μ its area, an upper bound on the free area.
//!   Karaman & Frazzoli, "Sampling-based algorithms for optimal motion planning",
//!   *International Journal of Robotics Research* 30(7), 2011, 846–894, Algorithm 6
//!   and Theorem 38 (doi 10.1177/0278364911406761).
//! - Informed RRT*: once a path of length c is known, samples are uniform in the
//!   part of the box where ‖x − start‖ + ‖x − goal‖ ≤ c; n and μ count what lies
//!   there. Gammell, Srinivasa & Barfoot, IROS 2014, Algorithms 1 and 2
//!   (doi 10.1109/IROS.2014.6942976).
//!
//! The goal is a node like any other, joined by a sample of its own: what rewiring
//! does for it shortens the path.

use std::f64::consts::PI;

use env_model::{Aabb, Point, World};
use planner_api::{Counters, Plan, PlanError, Planner, Problem, Run, SettingError, Status, View};

use crate::StarSettings;
use crate::cost_tree::CostTree;
use crate::ellipse::Ellipse;
use crate::rewire::{Neighbour, best_parent, rewire};
use crate::sampler::Sampler;
use crate::tree::Tree;

/// Returns the best path after all its samples. Its cost is the path's length.
/// An iteration is a sample; so is an evaluation: the node that it proposes.
#[derive(Debug, Clone)]
pub struct RrtStar {
    settings: StarSettings,
    informed: bool,
    tree: CostTree,
    near: Vec<Neighbour>,
}

impl RrtStar {
    /// RRT* with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: StarSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, informed: false, tree: CostTree::default(), near: Vec::new() })
    }

    /// Informed RRT* with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn informed(settings: StarSettings) -> Result<Self, SettingError> {
        Ok(Self { informed: true, ..Self::new(settings)? })
    }

    fn name(&self) -> &'static str {
        if self.informed { "informed-rrt-star" } else { "rrt-star" }
    }

    /// Grows a step of at most `step` towards `target` and rewires within `radius`;
    /// the new node, unless the step is blocked or leads nowhere.
    fn grow(&mut self, world: &World, target: Point, step: f64, radius: f64, spent: &mut Counters) -> Option<u32> {
        let Self { tree, near, .. } = self;
        spent.evaluations += 1;
        let (nearest, distance) = tree.tree.nearest(target);
        if distance == 0.0 {
            return None;
        }
        let from = tree.tree.point(nearest);
        let to = Tree::steer(from, target, distance, step);
        let checks = &mut spent.collision_checks;
        *checks += 1;
        if !world.segment_free(from, to) {
            return None;
        }
        near.clear();
        tree.tree.index.within(to, radius, |node, squared| {
            near.push(Neighbour { node, distance: squared.sqrt(), through: f64::INFINITY });
        });
        for neighbour in near.iter_mut() {
            neighbour.through = tree.cost(neighbour.node) + neighbour.distance;
        }
        let through_nearest = tree.cost(nearest) + (to - from).norm();
        let parent = best_parent(world, tree, near, to, (nearest, through_nearest), checks);
        let new = tree.push(to, parent);
        rewire(world, tree, near, new, checks);
        Some(new)
    }

    fn report(&self, run: &mut Run<'_>, cost: f64) {
        let views = [self.tree.tree.view()];
        run.report(self.name(), cost, || View::Trees(&views));
    }
}

impl Planner for RrtStar {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let Problem { world, start, goal, .. } = *problem;
        let StarSettings { samples, range, goal_bias, rewire_factor } = self.settings;
        let mut focus = Focus::new(start, goal, world.extent().including(start).including(goal));
        let range = range * focus.extent.diagonal();
        let mut sampler = Sampler::new(run.seed);
        let mut end: Option<u32> = None;
        self.tree.plant(start);
        self.report(run, plan.cost);
        for _ in 0..samples {
            if !run.allows(1) {
                break;
            }
            run.spent.iterations += 1;
            let target = match end {
                Some(_) if self.informed => focus.sample(plan.cost, &mut sampler),
                None if sampler.unit() < goal_bias => goal,
                _ => sampler.in_box(&focus.extent),
            };
            let (nodes, area) = match end {
                Some(_) if self.informed => focus.content(self.tree.tree.points(), plan.cost),
                _ => (self.tree.tree.len(), focus.extent_area()),
            };
            let new = self.grow(
                world,
                target,
                range,
                range.min(rewire_factor * critical_radius(nodes, area)),
                &mut run.spent,
            );
            end = end.or(new.filter(|n| self.tree.tree.point(*n) == goal));
            if let Some(end) = end {
                plan.cost = self.tree.cost(end);
            }
            self.report(run, plan.cost);
        }
        if let Some(end) = end {
            self.tree.tree.append_branch(end, &mut plan.path);
            plan.path.reverse();
        }
        plan.counters = run.spent;
        Ok(match (run.stopped(), end) {
            (true, _) => Status::BudgetSpent,
            (false, Some(_)) => Status::Solved,
            (false, None) => Status::NotFound,
        })
    }
}

/// The least radius for which n nodes in area μ keep RRT* asymptotically optimal in
/// the plane: `(2(1 + 1/d))^{1/d} (μ/ζ_d)^{1/d} (ln n/n)^{1/d}` with d = 2, ζ₂ = π.
fn critical_radius(nodes: usize, area: f64) -> f64 {
    let n = nodes as f64;
    (3.0 / PI * area * libm::log(n) / n).sqrt()
}

/// Where Informed RRT* samples, and how many nodes are there.
struct Focus {
    ellipse: Ellipse,
    extent: Aabb,
    /// Points counted so far, those of them inside, and the area of the ellipse that they were counted in.
    seen: usize,
    inside: usize,
    counted_area: f64,
}

impl Focus {
    /// Draws before an unlikely shape of the intersection is given up.
    const DRAWS: u32 = 100;
    /// Shrinkage of the ellipse that makes it worthwhile to count again.
    const SHRINKAGE: f64 = 0.95;

    fn new(start: Point, goal: Point, extent: Aabb) -> Self {
        Self { ellipse: Ellipse::new(start, goal), extent, seen: 0, inside: 0, counted_area: f64::INFINITY }
    }

    fn extent_area(&self) -> f64 {
        let size = self.extent.size();
        size.x * size.y
    }

    /// Uniform in the intersection of box and ellipse: drawn from the smaller of the
    /// two until it lies in the other. A point outside, which can improve nothing,
    /// in the case that none of 100 draws does.
    fn sample(&self, cost: f64, sampler: &mut Sampler) -> Point {
        let from_ellipse = self.ellipse.area(cost) < self.extent_area();
        let mut draw = || {
            if from_ellipse { self.ellipse.sample(cost, sampler) } else { sampler.in_box(&self.extent) }
        };
        let accepted = |p: Point| {
            if from_ellipse { self.extent.depth_of(p) >= 0.0 } else { self.ellipse.contains(p, cost) }
        };
        let mut p = draw();
        for _ in 1..Self::DRAWS {
            if accepted(p) {
                break;
            }
            p = draw();
        }
        p
    }

    /// How many of `points` lie in the ellipse, and a bound on the area where they
    /// may. Points are counted as they come, and all again when the ellipse has
    /// lost a twentieth of its area.
    fn content(&mut self, points: &[Point], cost: f64) -> (usize, f64) {
        let area = self.ellipse.area(cost);
        if area < Self::SHRINKAGE * self.counted_area {
            (self.seen, self.inside, self.counted_area) = (0, 0, area);
        }
        self.inside += points[self.seen..].iter().filter(|p| self.ellipse.contains(**p, cost)).count();
        self.seen = points.len();
        // The ends are always inside, whatever rounding says.
        (self.inside.max(2), area.min(self.extent_area()))
    }
}

#[cfg(test)]
mod tests;
