//! The planner round the swarm.

use env_model::Columns;
use planner_api::{Detail, Plan, PlanError, Planner, Problem, Run, SettingError, Status, SwarmView, View};
use pulp::Arch;

use crate::Settings;
use crate::sides::SideClasses;
use crate::swarm::Swarm;
use crate::terrain::Terrain;

/// Lu & Sun's swarm. Buffers are kept between calls.
pub struct Pso {
    settings: Settings,
    arch: Arch,
    swarm: Swarm,
    terrain: Terrain,
    sides: SideClasses,
    rows: Rows,
}

/// The swarm's matrices with one particle a row, made only for observers.
#[derive(Default)]
struct Rows {
    x: Vec<f64>,
    v: Vec<f64>,
    best: Vec<f64>,
}

impl Pso {
    /// A planner with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: Settings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self {
            settings,
            arch: Arch::new(),
            swarm: Swarm::default(),
            terrain: Terrain::default(),
            sides: SideClasses::default(),
            rows: Rows::default(),
        })
    }

    fn report(&mut self, columns: &Columns, run: &mut Run<'_>) {
        let Self { swarm, rows, .. } = self;
        if run.detail() == Detail::State {
            swarm.transpose(&swarm.x, &mut rows.x);
            swarm.transpose(&swarm.v, &mut rows.v);
            swarm.transpose(&swarm.best, &mut rows.best);
        }
        run.report("pso", swarm.global_cost, || {
            View::Swarm(SwarmView {
                columns,
                positions: &rows.x,
                velocities: &rows.v,
                personal_bests: &rows.best,
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
        let half_width = columns.half_width();
        if !run.allows_setup(particles) {
            plan.counters = run.spent;
            return Ok(Status::BudgetSpent);
        }
        self.terrain.compile(problem.world, &columns, self.settings.bounds);
        self.sides.begin(self.settings.side_classes, &self.terrain, &columns);
        self.swarm.initialise(self.arch, &self.settings, &self.terrain, half_width, run.seed);
        let account = |run: &mut Run<'_>| {
            run.spent.evaluations += particles;
            run.spent.collision_checks += particles * (m as u64 + 1);
        };
        account(run);
        self.sides.collect(&self.swarm);
        self.report(&columns, run);
        for t in 0..self.settings.iterations {
            if !run.allows(particles) {
                break;
            }
            self.swarm.iterate(self.arch, &self.settings, &self.terrain, half_width, t);
            run.spent.iterations += 1;
            account(run);
            self.sides.collect(&self.swarm);
            self.report(&columns, run);
        }
        columns.write_path(&self.swarm.global, &mut plan.path);
        plan.cost = self.swarm.global_cost;
        let free = problem.world.path_free(&plan.path);
        run.spent.collision_checks += m as u64 + 1;
        plan.counters = run.spent;
        for heights in self.sides.members(m) {
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
