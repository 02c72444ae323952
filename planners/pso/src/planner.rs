//! The planner round the swarm.

use env_model::{Columns, Point};
use planner_api::{Detail, Plan, PlanError, Planner, Problem, Run, SettingError, Status, SwarmView, Told, View};

use crate::Settings;
use crate::rules::{UpdateRule, rule};
use crate::sides::SideClasses;
use crate::swarm::{Ground, Swarm};
use crate::terrain::Terrain;
use crate::width::Width;

/// Lu & Sun's swarm, or one of its family. Buffers are kept between calls.
pub struct Pso {
    settings: Settings,
    rule: Box<dyn UpdateRule>,
    width: Width,
    swarm: Swarm,
    terrain: Terrain,
    sides: SideClasses,
    rows: Rows,
}

/// What is made only for observers: the swarm's matrices with one particle a row, its best cost where that is a length.
#[derive(Default)]
struct Rows {
    x: Vec<f64>,
    v: Vec<f64>,
    best: Vec<f64>,
    /// The global best as a path, its cost, and what observers are told of it.
    path: Vec<Point>,
    seen: f64,
    told: Told,
}

impl Pso {
    /// A planner with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: Settings) -> Result<Self, SettingError> {
        settings.validate()?;
        let settings = settings.filled();
        Ok(Self {
            rule: rule(&settings),
            settings,
            width: Width::widest(),
            swarm: Swarm::default(),
            terrain: Terrain::default(),
            sides: SideClasses::default(),
            rows: Rows::default(),
        })
    }

    /// The planner on a vector unit of your choice, to compare speeds; results are the same.
    #[must_use]
    pub fn on(self, width: Width) -> Self {
        Self { width, ..self }
    }
}

impl Rows {
    fn report(&mut self, swarm: &Swarm, columns: &Columns, run: &mut Run<'_>) {
        if run.detail() == Detail::None {
            return;
        }
        if swarm.global_cost < self.seen {
            self.seen = swarm.global_cost;
            self.path.clear();
            columns.write_path(&swarm.global, &mut self.path);
            self.told.improve(self.seen, &self.path);
        }
        if run.detail() == Detail::State {
            swarm.transpose(&swarm.x, &mut self.x);
            swarm.transpose(&swarm.v, &mut self.v);
            swarm.transpose(&swarm.best, &mut self.best);
        }
        run.report("pso", self.told.cost(), || {
            View::Swarm(SwarmView {
                columns,
                positions: &self.x,
                velocities: &self.v,
                personal_bests: &self.best,
                personal_costs: &swarm.best_cost[..swarm.particles],
                global_best: &swarm.global,
                global_cost: swarm.global_cost,
            })
        });
    }
}

impl Planner for Pso {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let (particles, m) = (self.settings.particles as u64, self.settings.columns);
        let columns = Columns::new(problem.start, problem.goal, m);
        if !run.allows_setup(particles) {
            plan.counters = run.spent;
            return Ok(Status::BudgetSpent);
        }
        let Self { settings, rule, width, swarm, terrain, sides, rows } = self;
        terrain.compile(problem.world, &columns, settings.bounds.unwrap_or_default());
        sides.begin(settings.side_classes, terrain, &columns);
        let ground = Ground { width: *width, settings, world: problem.world, columns: &columns, terrain };
        (rows.seen, rows.told) = (f64::INFINITY, Told::default());
        let mut account = |swarm: &Swarm, run: &mut Run<'_>| {
            run.spent.evaluations += swarm.evaluated;
            run.spent.collision_checks += swarm.evaluated * (m as u64 + 1);
            sides.collect(swarm);
            rows.report(swarm, &columns, run);
        };
        swarm.initialise(ground, rule.as_mut(), run.seed);
        account(swarm, run);
        for t in 0..settings.iterations {
            if !run.allows(particles) {
                break;
            }
            swarm.iterate(ground, rule.as_mut(), t);
            run.spent.iterations += 1;
            account(swarm, run);
        }
        columns.write_path(&swarm.global, &mut plan.path);
        plan.cost = swarm.global_cost;
        let free = problem.world.path_free(&plan.path);
        run.spent.collision_checks += m as u64 + 1;
        plan.counters = run.spent;
        for heights in sides.members(m) {
            plan.candidates.push_with(|points| columns.append_path(heights, points));
        }
        Ok(if run.stopped() {
            Status::BudgetSpent
        } else if free {
            Status::Solved
        } else {
            Status::NotFound
        })
    }
}
