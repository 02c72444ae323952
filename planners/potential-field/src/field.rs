//! The potential and its force.

use env_model::{Aabb, Point, Vector, World};
use planner_api::Problem;

use crate::clearance::{Clearance, clearance};
use crate::{PotentialFieldSettings, Repulsion};

/// Nearest clearance that the force tells apart, in units of ρ0: on the border
/// itself FIRAS is infinite, and a start may touch an obstacle.
const NEAREST: f64 = 1e-3;

/// The potential field of a problem. Lengths in its formulas are in units of the
/// reach ρ0, so potentials and forces are numbers without unit.
#[derive(Debug, Clone, Copy)]
pub struct Field<'a> {
    world: &'a World,
    goal: Point,
    /// ρ0, in scene units.
    reach: f64,
    settings: &'a PotentialFieldSettings,
}

impl<'a> Field<'a> {
    /// The field of `problem`; `settings` are taken as valid.
    pub fn new(problem: &Problem<'a>, settings: &'a PotentialFieldSettings) -> Self {
        let reach = settings.influence * problem.world.extent().diagonal();
        Self { world: problem.world, goal: problem.goal, reach, settings }
    }

    /// U = Uₐ + Σ Uᵣ at a free point `p`, in units of ξ's.
    pub fn potential(&self, p: Point) -> f64 {
        let d = (self.goal - p).norm() / self.reach;
        let pull = d.min(self.settings.conic_distance);
        let mut repulsive = 0.0;
        self.for_each_near(p, |sigma, _| repulsive += self.firas(sigma));
        self.settings.attraction_gain * pull * (d - 0.5 * pull) + self.weight(d) * repulsive
    }

    /// F = −∇U at a free point `p`, by the exact gradients of the clearances,
    /// per ρ0. O(log n + the obstacles within ρ0).
    ///
    /// Khatib: Fᵣ = η (1/ρ − 1)/ρ² ∇ρ. Ge & Cui: that times the weight
    /// w = (min(d, d\*)/d\*)², and − Uᵣ ∇w, which pulls towards the goal.
    /// Clearances below ρ0/1000 count as that much.
    pub fn force(&self, p: Point) -> Vector {
        let to = self.goal - p;
        let distance = to.norm();
        let d = distance / self.reach;
        let towards = if distance > 0.0 { to / distance } else { Vector::zeros() };
        let (mut force, mut repulsive) = (Vector::zeros(), 0.0);
        self.for_each_near(p, |sigma, gradient| {
            let slope = self.settings.repulsion_gain * (1.0 / sigma - 1.0) / (sigma * sigma);
            force += gradient * slope;
            repulsive += self.firas(sigma);
        });
        let pull = self.settings.attraction_gain * d.min(self.settings.conic_distance);
        force * self.weight(d) + towards * (pull + repulsive * self.weight_slope(d))
    }

    /// Whether a robot may stand at `p`; where it may not, the field means nothing.
    pub(crate) fn is_free(&self, p: Point) -> bool {
        self.world.point_clearance(p) >= 0.0
    }

    /// ½ η (1/ρ − 1)², ρ in units of ρ0.
    fn firas(&self, sigma: f64) -> f64 {
        let excess = 1.0 / sigma - 1.0;
        0.5 * self.settings.repulsion_gain * excess * excess
    }

    /// What the repulsion is multiplied by at distance d of the goal.
    fn weight(&self, d: f64) -> f64 {
        match self.settings.repulsion {
            Repulsion::Khatib => 1.0,
            Repulsion::GeCui => {
                let w = (d / self.settings.conic_distance).min(1.0);
                w * w
            }
        }
    }

    /// The weight's derivative by d.
    fn weight_slope(&self, d: f64) -> f64 {
        let conic = self.settings.conic_distance;
        match self.settings.repulsion {
            Repulsion::GeCui if d < conic => 2.0 * d / (conic * conic),
            _ => 0.0,
        }
    }

    /// Calls `visit(ρ/ρ0, ∇ρ)` for each obstacle and each side of the field within ρ0.
    fn for_each_near(&self, p: Point, mut visit: impl FnMut(f64, Vector)) {
        let mut consider = |Clearance { distance, gradient }: Clearance| {
            if distance < self.reach {
                visit((distance / self.reach).max(NEAREST), gradient);
            }
        };
        let near = Aabb { min: p, max: p }.inflated(self.reach);
        self.world.for_each_overlapping(&near, |i| consider(clearance(&self.world.obstacles()[i], p)));
        if let Some(field) = self.world.inner_field() {
            let (low, high) = (p - field.min, field.max - p);
            for (distance, gradient) in [
                (low.x, Vector::new(1.0, 0.0)),
                (low.y, Vector::new(0.0, 1.0)),
                (high.x, Vector::new(-1.0, 0.0)),
                (high.y, Vector::new(0.0, -1.0)),
            ] {
                consider(Clearance { distance, gradient });
            }
        }
    }
}
