//! Uniform random polylines on the columns of the 2012 paper; the best stays.
//!
//! Same model, same objective (Σ λᵢ fᵢ, λᵢ = 1000 for a colliding segment) and
//! by default as many evaluations as the swarm: what is left is the search.

use env_model::{Columns, Point};
use planner_api::{Plan, PlanError, Planner, Problem, Run, SettingError, Status, Told, View};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

/// λ of a colliding segment (Lu & Sun 2012, eq. 4).
const PENALTY: f64 = 1000.0;

/// Settings of [`RandomSearch`].
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RandomSearchSettings {
    /// Columns m, 1 … 10 000. Default 20, the swarm's.
    pub columns: usize,
    /// Polylines tried, 1 … 10⁹. Default 8020 = 20 particles × (1 + 400 iterations).
    pub evaluations: u64,
}

impl Default for RandomSearchSettings {
    fn default() -> Self {
        Self { columns: 20, evaluations: 8020 }
    }
}

impl RandomSearchSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check((1..=10_000).contains(&self.columns), "columns", self.columns, "1 to 10000")?;
        let tried = self.evaluations;
        SettingError::check((1..=1_000_000_000).contains(&tried), "evaluations", tried, "1 to 1000000000")
    }
}

/// Draws heights uniformly on [−L/4, L/4] for each column, keeps the cheapest polyline.
#[derive(Debug, Clone)]
pub struct RandomSearch {
    settings: RandomSearchSettings,
    heights: Vec<f64>,
    trial: Vec<Point>,
}

impl RandomSearch {
    /// A planner with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: RandomSearchSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, heights: Vec::new(), trial: Vec::new() })
    }
}

impl Planner for RandomSearch {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let columns = Columns::new(problem.start, problem.goal, self.settings.columns);
        let half_width = columns.half_width();
        let mut rng = ChaCha8Rng::seed_from_u64(run.seed);
        let (mut free, mut told) = (false, Told::default());
        for _ in 0..self.settings.evaluations {
            if !run.allows(1) {
                break;
            }
            self.heights.clear();
            self.heights.extend((0..columns.count()).map(|_| (2.0 * rng.random::<f64>() - 1.0) * half_width));
            columns.write_path(&self.heights, &mut self.trial);
            let (mut cost, mut hits) = (0.0, 0);
            for w in self.trial.windows(2) {
                run.spent.collision_checks += 1;
                let hit = !problem.world.segment_free(w[0], w[1]);
                hits += usize::from(hit);
                cost += (w[1] - w[0]).norm() * if hit { PENALTY } else { 1.0 };
                // Costs only grow along the path: the rest cannot save this one.
                if cost >= plan.cost {
                    break;
                }
            }
            run.spent.iterations += 1;
            run.spent.evaluations += 1;
            if cost < plan.cost {
                plan.cost = cost;
                free = hits == 0;
                std::mem::swap(&mut plan.path, &mut self.trial);
                told.improve(plan.cost, &plan.path);
            }
            run.report("random-search", told.cost(), || View::Path(&plan.path));
        }
        plan.counters = run.spent;
        Ok(match (run.stopped(), free) {
            (true, _) => Status::BudgetSpent,
            (false, true) => Status::Solved,
            (false, false) => Status::NotFound,
        })
    }
}
