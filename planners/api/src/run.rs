//! One run: seed, budget, observer, and the work done so far.

use std::ops::ControlFlow;
use std::time::Instant;

use crate::{Budget, Counters, Detail, Frame, Observer, View};

/// The caller's side of one planning call. Stages of a composition share it,
/// so one budget covers planner and refinement.
pub struct Run<'r> {
    /// All randomness of the run comes from here.
    pub seed: u64,
    /// Work done so far; planners add to it as they go.
    pub spent: Counters,
    budget: Budget,
    observer: Option<&'r mut dyn Observer>,
    detail: Detail,
    stopped: bool,
}

impl<'r> Run<'r> {
    /// A run without budget or observer.
    pub fn new(seed: u64) -> Self {
        Self {
            seed,
            spent: Counters::default(),
            budget: Budget::default(),
            observer: None,
            detail: Detail::None,
            stopped: false,
        }
    }

    /// Limits the run.
    #[must_use]
    pub fn with_budget(mut self, budget: Budget) -> Self {
        self.budget = budget;
        self
    }

    /// Has `observer` watch the run.
    #[must_use]
    pub fn with_observer(mut self, observer: &'r mut dyn Observer) -> Self {
        self.detail = observer.detail();
        self.observer = Some(observer);
        self
    }

    /// Whether an iteration with `evaluations` evaluations may begin. Reads
    /// the clock only when there is a deadline.
    pub fn allows(&mut self, evaluations: u64) -> bool {
        let within = |limit: Option<u64>, used: u64| limit.is_none_or(|limit| used <= limit);
        if !self.stopped {
            self.stopped = !within(self.budget.iterations, self.spent.iterations + 1)
                || !within(self.budget.evaluations, self.spent.evaluations + evaluations)
                || self.late();
        }
        !self.stopped
    }

    /// Whether `evaluations` evaluations may be done outside the iterations
    /// (an initial population). Reads the clock only when there is a deadline.
    pub fn allows_setup(&mut self, evaluations: u64) -> bool {
        if !self.stopped {
            self.stopped = self.budget.evaluations.is_some_and(|limit| self.spent.evaluations + evaluations > limit)
                || self.late();
        }
        !self.stopped
    }

    /// Whether work that is neither iteration nor evaluation may go on. Reads
    /// the clock only when there is a deadline.
    pub fn in_time(&mut self) -> bool {
        self.stopped |= self.late();
        !self.stopped
    }

    fn late(&self) -> bool {
        self.budget.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// Whether budget or observer have ended the run.
    pub fn stopped(&self) -> bool {
        self.stopped
    }

    /// What the observer wants to see.
    pub fn detail(&self) -> Detail {
        self.detail
    }

    /// Shows the observer a frame. `view` is built only when the state is wanted.
    pub fn report<'v>(&mut self, stage: &'static str, best_cost: f64, view: impl FnOnce() -> View<'v>) {
        let Some(observer) = self.observer.as_deref_mut() else { return };
        if self.detail == Detail::None {
            return;
        }
        let view = if self.detail == Detail::State { view() } else { View::Progress };
        let Counters { iterations: iteration, evaluations, .. } = self.spent;
        if observer.frame(&Frame { stage, iteration, evaluations, best_cost, view }) == ControlFlow::Break(()) {
            self.stopped = true;
            self.observer = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn budgets_count_iterations_and_evaluations() {
        let mut run = Run::new(1).with_budget(Budget { iterations: Some(1), evaluations: Some(30), deadline: None });
        assert!(run.allows_setup(20));
        run.spent.evaluations = 20;
        assert!(run.allows(10));
        run.spent.iterations = 1;
        assert!(!run.allows(0), "one iteration was all");
        let mut run = Run::new(1).with_budget(Budget { evaluations: Some(30), ..Budget::default() });
        run.spent.evaluations = 20;
        assert!(!run.allows(11) && run.stopped());
    }

    #[test]
    fn an_observer_can_stop_the_run() {
        struct Once;
        impl Observer for Once {
            fn frame(&mut self, _: &Frame<'_>) -> ControlFlow<()> {
                ControlFlow::Break(())
            }
        }
        let mut once = Once;
        let mut run = Run::new(1).with_observer(&mut once);
        assert!(run.allows(1));
        run.report("test", 1.0, || View::Progress);
        assert!(!run.allows(1));
    }
}
