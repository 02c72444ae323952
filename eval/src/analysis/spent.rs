//! How many evaluations a run counts with where it did not live to tell.
//!
//! Of a run that crashed, outlived a limit or ended in an error, 0 evaluations means that nobody counted them. Taken at
//! its word, failing would cost nothing: a planner that crashes nine times of ten would have the expected running time
//! of one that never does. Such a run is charged the planner's budget of evaluations or, without one, the most that
//! any run of the planner is known to have made.

use crate::results::{PlannerInfo, RunRecord, RunStatus};

/// What runs of one planner count with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Evaluations {
    untold: Option<f64>,
}

impl Evaluations {
    /// Reads the planner's budget and all of its runs.
    pub fn of<'a>(planner: &PlannerInfo, runs: impl Iterator<Item = &'a RunRecord>) -> Self {
        let most = || runs.map(|r| r.evaluations).max().filter(|most| *most > 0);
        Self { untold: planner.budget.evaluations.or_else(most).map(|n| n as f64) }
    }

    /// The evaluations of one of its runs; `None` where neither the run nor any other one nor a budget tells.
    pub fn spent(self, run: &RunRecord) -> Option<f64> {
        let cut_short = run.status == RunStatus::Error || run.status.is_killed();
        if cut_short && run.evaluations == 0 { self.untold } else { Some(run.evaluations as f64) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::run;
    use super::*;

    #[test]
    fn a_crash_is_not_free() {
        let mut planner = PlannerInfo::plain("a", "fake", "");
        let good = run("s", "a", 0, 10.5);
        let crashed = |status, evaluations| RunRecord { status, evaluations, ..run("s", "a", 1, f64::INFINITY) };
        let killed = crashed(RunStatus::Crashed, 0);
        let known = Evaluations::of(&planner, [&good, &killed].into_iter());
        assert_eq!(known.spent(&good), Some(100.0));
        for status in [RunStatus::Crashed, RunStatus::Timeout, RunStatus::OutOfMemory, RunStatus::Error] {
            assert_eq!(known.spent(&crashed(status, 0)), Some(100.0), "{status:?}");
            assert_eq!(known.spent(&crashed(status, 7)), Some(7.0), "it told");
        }
        // Nothing evaluated is a count like any other where the planner ended by itself.
        assert_eq!(known.spent(&crashed(RunStatus::NotFound, 0)), Some(0.0));
        assert_eq!(Evaluations::of(&planner, [&killed].into_iter()).spent(&killed), None);
        planner.budget.evaluations = Some(500);
        assert_eq!(Evaluations::of(&planner, [&good].into_iter()).spent(&killed), Some(500.0));
    }
}
