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
    /// Whether the observer wanted no more.
    broken_off: bool,
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
            broken_off: false,
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

    /// Carries out `stage` with a share of what is left of the budget, so that stages after it have the rest:
    /// `counts` of the iterations and evaluations (at least one of each is kept back), `time` of the time until the
    /// deadline. Without a limit nothing is shared out.
    pub fn with_share<T>(&mut self, counts: f64, time: f64, stage: impl FnOnce(&mut Self) -> T) -> T {
        let whole = self.budget;
        let share = |limit: Option<u64>, used: u64| {
            // Exact below 2⁵³; larger budgets end no run.
            limit.map(|limit| used + (counts * limit.saturating_sub(used) as f64).floor() as u64)
        };
        self.budget = Budget {
            iterations: share(whole.iterations, self.spent.iterations),
            evaluations: share(whole.evaluations, self.spent.evaluations),
            deadline: whole.deadline.map(|deadline| {
                let now = Instant::now();
                now + deadline.saturating_duration_since(now).mul_f64(time)
            }),
        };
        let outcome = stage(self);
        self.budget = whole;
        // The share's end is not the run's.
        self.stopped = self.broken_off;
        outcome
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
            self.broken_off = true;
            self.observer = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_leaves_the_rest_to_later_stages() {
        let budget = Budget { iterations: Some(400), evaluations: Some(11), deadline: None };
        let mut run = Run::new(1).with_budget(budget);
        run.spent.evaluations = 1;
        run.with_share(0.9, 0.75, |run| {
            assert!(run.allows(9) && !run.allows(10), "nine of the ten that are left");
            assert!(run.stopped());
            run.spent.evaluations += 9;
        });
        assert!(!run.stopped() && run.allows(1) && !run.allows(2), "the tenth is the next stage's");
        let whole = Run::new(1).with_share(0.9, 0.75, |run| run.allows(u64::MAX));
        assert!(whole, "nothing to share");
    }

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
