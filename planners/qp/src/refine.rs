//! Which model, which classes, in which order.

use std::collections::BTreeSet;

use env_model::{Columns, LocalFrame, Point};
use planner_api::{Plan, PlanError, Problem, Refinement, Refiner, Run, SettingError};

use crate::free::descend;
use crate::polish::{Polish, polish};
use crate::session::Session;
use crate::settings::{Classes, Model, Objective, Settings, Solver};
use crate::smooth::cost;
use crate::strip::{Sides, Strip};
use crate::structured::{Workspace, polish_structured};

/// Columns when the path suggests none (Lu & Sun 2012).
const DEFAULT_COLUMNS: usize = 20;

/// Convex refinement of a plan; see the crate's documentation.
#[derive(Debug, Clone)]
pub struct Qp {
    settings: Settings,
    workspace: Workspace,
}

impl Qp {
    /// A refiner with checked settings.
    ///
    /// # Errors
    /// What [`Settings::validate`] finds.
    pub fn new(settings: Settings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, workspace: Workspace::default() })
    }
}

impl Refiner for Qp {
    /// One solved programme counts as one iteration and one evaluation.
    ///
    /// `plan.cost` becomes the refiner's cost when the path changes, and the
    /// length of a free path under [`Objective::Shorten`] in any case.
    ///
    /// # Errors
    /// [`PlanError::Unsupported`] when the path has a vertex that is not
    /// finite, or does not lead from start to goal.
    fn refine(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Refinement, PlanError> {
        if !run.in_time() {
            plan.counters = run.spent;
            return Ok(Refinement::BudgetSpent);
        }
        if plan.path.is_empty() {
            plan.counters = run.spent;
            return Ok(Refinement::NotRepaired);
        }
        check(problem, &plan.path)?;
        let mut session = Session::new(problem.world, run, &plan.path);
        let free = session.is_free(&plan.path);
        if free && self.settings.objective == Objective::Shorten {
            session.cost = env_model::path_length(&plan.path);
            plan.cost = session.cost;
            plan.terms.clear();
        }
        let (settings, workspace) = (&self.settings, &mut self.workspace);
        let mut task = Task { settings, workspace, problem, plan, free, floor: settings.enough(session.cost) };
        session.report();
        let stopped = task.refine(&mut session) == Polish::Stopped;
        let gained = session.found && (!free || session.cost < task.floor);
        let Session { path, cost, .. } = session;
        if gained {
            plan.path = path;
            plan.cost = cost;
            // They were parts of the other planner's cost.
            plan.terms.clear();
        }
        plan.counters = run.spent;
        Ok(match (stopped, gained, free) {
            (true, ..) => Refinement::BudgetSpent,
            (_, true, true) => Refinement::Improved,
            (_, true, false) => Refinement::Repaired,
            (_, false, true) => Refinement::Unchanged,
            (_, false, false) => Refinement::NotRepaired,
        })
    }
}

fn check(problem: &Problem<'_>, path: &[Point]) -> Result<(), PlanError> {
    if let Some((i, p)) = path.iter().enumerate().find(|(_, p)| !(p.x.is_finite() && p.y.is_finite())) {
        return Err(PlanError::Unsupported(format!("vertex {i} of the path, ({}, {}), is not finite", p.x, p.y)));
    }
    let (first, last) = (path[0], path[path.len() - 1]);
    if path.len() < 2 || first != problem.start || last != problem.goal {
        return Err(PlanError::Unsupported(format!(
            "the path leads from ({}, {}) to ({}, {}); expected start ({}, {}) to goal ({}, {})",
            first.x, first.y, last.x, last.y, problem.start.x, problem.start.y, problem.goal.x, problem.goal.y
        )));
    }
    Ok(())
}

/// A way past the obstacles.
struct Class {
    sides: Sides,
    /// Lower bound on its length.
    bound: f64,
    /// Its taut string at the columns.
    string: Vec<f64>,
    /// Its first member at the columns.
    member: Vec<f64>,
    /// Whether the plan's path is that member.
    own: bool,
}

/// One plan to refine.
struct Task<'t> {
    settings: &'t Settings,
    workspace: &'t mut Workspace,
    problem: &'t Problem<'t>,
    plan: &'t Plan,
    /// Whether the plan's path is free.
    free: bool,
    /// What a new path must cost less than, when the old one is free.
    floor: f64,
}

impl Task<'_> {
    fn refine(&mut self, session: &mut Session<'_, '_>) -> Polish {
        let mut reference = self.plan.path.clone();
        let columns = self.settings.model == Model::Columns;
        if columns || !self.free {
            let kept = self.on_columns(session, &mut reference);
            if kept == Polish::Stopped || (kept == Polish::Done && columns) || (kept == Polish::Nothing && !self.free) {
                return kept;
            }
        }
        if self.settings.objective == Objective::Smooth && !session.found {
            session.cost = cost(&session.path, &reference, self.settings);
            self.floor = self.settings.enough(session.cost);
        }
        descend(self.settings, &reference, session)
    }

    /// Polishes the classes. `Nothing` when the plan's own path is better left to the free model.
    /// `reference` becomes the path that `smooth` recalls.
    fn on_columns(&mut self, session: &mut Session<'_, '_>, reference: &mut Vec<Point>) -> Polish {
        let (settings, world) = (self.settings, self.problem.world);
        let columns = Columns::new(self.problem.start, self.problem.goal, self.count());
        let limit = if settings.objective == Objective::Shorten { session.cost } else { f64::INFINITY };
        let strip = Strip::new(world, columns, self.problem.start, self.problem.goal, limit);
        let Some(classes) = self.classes(&strip, session) else { return Polish::Stopped };
        let smooth = settings.objective == Objective::Smooth;
        let mut kept_own = classes.iter().any(|c| c.own && c.bound.is_finite());
        let mut sampled = Vec::new();
        if let Some(own) = classes.iter().find(|c| c.own).filter(|_| smooth && self.free) {
            columns.write_path(&own.member, &mut sampled);
            // Samples that collide are no path of this model.
            self.floor = if session.is_free(&sampled) {
                settings.enough(cost(&sampled, &sampled, settings))
            } else {
                f64::INFINITY
            };
        }
        for class in classes.iter().filter(|c| c.bound.is_finite()) {
            if (smooth && session.found) || (!smooth && class.bound >= settings.enough(session.cost)) {
                break;
            }
            let (sides, start) = (&class.sides, &class.string);
            let kept = match settings.solver {
                Solver::Clarabel => polish(&strip, sides, start, &class.member, settings, session),
                Solver::Structured => {
                    polish_structured(&strip, sides, start, &class.member, settings, self.workspace, session)
                }
            };
            match kept {
                Polish::Stopped => return Polish::Stopped,
                Polish::Nothing => kept_own &= !class.own,
                Polish::Done => columns.write_path(&class.member, reference),
            }
            if smooth && self.free {
                break;
            }
        }
        if session.found || (self.free && kept_own) { Polish::Done } else { Polish::Nothing }
    }

    /// The distinct classes of the path and, if wanted, of the candidates, in the order to polish them;
    /// `None` when time ran out.
    fn classes(&self, strip: &Strip, session: &mut Session<'_, '_>) -> Option<Vec<Class>> {
        let swarm = self.settings.classes == Classes::Swarm;
        let candidates = self.plan.candidates.iter().filter(|p| swarm && check(self.problem, p).is_ok());
        let mut seen = BTreeSet::new();
        let mut classes = Vec::new();
        for (i, path) in std::iter::once(&self.plan.path[..]).chain(candidates).enumerate() {
            if !session.in_time() {
                return None;
            }
            let Some((sides, member)) = strip.sides_of(self.problem.world, path) else { continue };
            if seen.insert(sides.clone()) {
                let (bound, string) = strip.bound(&sides);
                classes.push(Class { sides, bound, string, member, own: i == 0 });
            }
        }
        // Stable: equal bounds stay in the order of their discovery.
        let smooth = self.settings.objective == Objective::Smooth;
        classes.sort_by(|a, b| {
            let own = if smooth { b.own.cmp(&a.own) } else { std::cmp::Ordering::Equal };
            own.then(a.bound.total_cmp(&b.bound))
        });
        Some(classes)
    }

    /// The columns of the settings, else of the path, else 20.
    fn count(&self) -> usize {
        let path = &self.plan.path;
        let own = || {
            let count = path.len().checked_sub(2).filter(|&m| m > 0)?;
            let frame = LocalFrame::new(self.problem.start, self.problem.goal);
            let spacing = frame.length() / (count + 1) as f64;
            // Far below what could be meant as another place, far above rounding.
            let on =
                |(i, p): (usize, &Point)| (frame.to_local(*p).x - i as f64 * spacing).abs() <= 1e-9 * frame.length();
            path.iter().enumerate().all(on).then_some(count)
        };
        self.settings.columns.or_else(own).unwrap_or(DEFAULT_COLUMNS)
    }
}
