//! Fake planners and small campaigns for tests.

use env_model::{Obstacle, Point, Scene};
use planner_api::{Candidates, Plan, PlanError, Planner, PopulationView, Problem, Run, Status, TreeView, View};

use crate::campaign::Campaign;
use crate::config::{BudgetSpec, Comparison, Limits, Maker, PlannerEntry, SceneEntry};
use crate::results::{RunRecord, SceneSet, Subject};
use crate::runner;
use crate::work::Work;

/// A planner that is a function of problem and seed, and counts its calls since `reset`.
pub struct Fake {
    calls: u64,
    act: fn(&Problem<'_>, u64, &mut Plan) -> Result<Status, PlanError>,
}

impl Planner for Fake {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        self.calls += 1;
        for (evaluations, cost) in [(1, f64::INFINITY), (2, 9.0), (3, 9.0), (4, 8.5)] {
            run.spent.evaluations = evaluations;
            run.report("fake", cost, || View::Progress);
        }
        run.spent.iterations = self.calls;
        plan.counters = run.spent;
        (self.act)(problem, run.seed, plan)
    }

    fn reset(&mut self) {
        self.calls = 0;
    }
}

/// Works until its budget ends it.
pub struct Patient;

impl Planner for Patient {
    fn plan_into(&mut self, _: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        while run.allows(1) {
            run.spent.iterations += 1;
        }
        Ok(Status::BudgetSpent)
    }
}

/// Shows a population for ten iterations, then a growing tree for two, and returns a detour.
pub struct Climber;

impl Planner for Climber {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let mut paths = Candidates::default();
        for k in 0..3 {
            paths.push([problem.start, Point::new(5.0, f64::from(k)), problem.goal]);
        }
        let mut nodes = vec![problem.start];
        let mut stopped = false;
        for k in 0..=12_u32 {
            if k > 0 {
                if !run.allows(1) {
                    stopped = true;
                    break;
                }
                run.spent.iterations += 1;
                run.spent.evaluations += 1;
                nodes.push(Point::new(f64::from(k), 2.0));
            }
            let parents: Vec<u32> = (0..=k).map(|i| i.saturating_sub(1)).collect();
            let fitness = [f64::from(k), 0.5 * f64::from(k), f64::NAN];
            if k <= 10 {
                let view = PopulationView { paths: &paths, fitness: &fitness, grid: None, best: &[] };
                run.report("climb", 1.0, || View::Population(view));
            } else {
                let trees = [TreeView { nodes: &nodes, parents: &parents }];
                run.report("grow", 1.0, || View::Trees(&trees));
            }
        }
        detour(problem, run.seed, plan)?;
        plan.cost = 12.0;
        plan.terms.extend([("length", 12.5), ("risk", f64::INFINITY)]);
        plan.counters = run.spent;
        Ok(if stopped { Status::BudgetSpent } else { Status::Solved })
    }
}

pub fn climber(budget: BudgetSpec) -> PlannerEntry {
    PlannerEntry { budget, maker: Maker::Catalogue(Box::new(|| Box::new(Climber))), ..entry("climber", detour) }
}

/// All runs of a campaign, sorted.
pub fn runs_of(campaign: &Campaign) -> Vec<RunRecord> {
    let mut runs = Vec::new();
    let optima = vec![None; campaign.arenas.len()];
    runner::run(campaign, &optima, &Work::all(1), |r| {
        runs.push(r);
        Ok(())
    })
    .unwrap();
    runs.sort_by(|a, b| (&a.scene, &a.planner, a.repeat).cmp(&(&b.scene, &b.planner, b.repeat)));
    runs
}

pub fn entry(label: &str, act: fn(&Problem<'_>, u64, &mut Plan) -> Result<Status, PlanError>) -> PlannerEntry {
    PlannerEntry {
        label: label.to_owned(),
        group: label.to_owned(),
        varied: String::new(),
        kind: "fake".to_owned(),
        settings: toml::Table::from_iter([("gain".to_owned(), 0.5.into())]),
        budget: BudgetSpec::default(),
        limits: Limits::default(),
        maker: Maker::Catalogue(Box::new(move || Box::new(Fake { calls: 0, act }))),
    }
}

pub fn straight(problem: &Problem<'_>, _: u64, plan: &mut Plan) -> Result<Status, PlanError> {
    plan.path.extend([problem.start, problem.goal]);
    Ok(Status::Solved)
}

/// Over (5, 2 + a number that depends on the seed): free of a disc of radius 1 at (5, 0).
pub fn detour(problem: &Problem<'_>, seed: u64, plan: &mut Plan) -> Result<Status, PlanError> {
    let height = 2.0 + (seed % 1000) as f64 / 7000.0;
    plan.path.extend([problem.start, Point::new(5.0, height), problem.goal]);
    Ok(Status::BudgetSpent)
}

pub fn nothing(_: &Problem<'_>, _: u64, _: &mut Plan) -> Result<Status, PlanError> {
    Ok(Status::NotFound)
}

pub fn refusal(_: &Problem<'_>, _: u64, _: &mut Plan) -> Result<Status, PlanError> {
    Err(PlanError::Unsupported("no, \"thanks\"".into()))
}

pub fn panic_on_odd(problem: &Problem<'_>, seed: u64, plan: &mut Plan) -> Result<Status, PlanError> {
    assert!(seed.is_multiple_of(2), "seed {seed} is odd");
    detour(problem, seed, plan)
}

pub fn not_finite(problem: &Problem<'_>, _: u64, plan: &mut Plan) -> Result<Status, PlanError> {
    plan.path.extend([problem.start, Point::new(f64::NAN, 1.0), problem.goal]);
    Ok(Status::Solved)
}

pub fn short_of_goal(problem: &Problem<'_>, _: u64, plan: &mut Plan) -> Result<Status, PlanError> {
    plan.path.extend([problem.start, Point::new(5.0, 3.0)]);
    Ok(Status::Solved)
}

pub fn scene(name: &str) -> Scene {
    Scene {
        name: name.into(),
        unit: "m".into(),
        robot_radius: 0.0,
        start: [0.0, 0.0],
        goal: [10.0, 0.0],
        field: None,
        obstacles: vec![Obstacle::disc(Point::new(5.0, 0.0), 1.0)],
    }
}

pub fn campaign(planners: Vec<PlannerEntry>) -> Campaign {
    let scenes = [scene("b-scene"), scene("a-scene")]
        .map(|scene| SceneEntry { scene, set: SceneSet::Test, simulation: None })
        .into();
    Campaign::new(Comparison {
        name: "test".into(),
        seed: 3,
        repeats: 5,
        subject: Subject::Paths,
        protocol: None,
        scenes,
        planners,
        notes: Vec::new(),
    })
    .unwrap()
}
