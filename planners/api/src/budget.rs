//! How much work a run may do.

use std::time::Instant;

/// Limits on one run, planner and refinement together; any of them may be absent.
///
/// An algorithm's own iteration count is a setting, not a budget: reaching it
/// is [`Status::Solved`](crate::Status) or `NotFound`, not `BudgetSpent`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Budget {
    /// Iterations of the planner's outer loop.
    pub iterations: Option<u64>,
    /// Evaluations of the planner's own objective.
    pub evaluations: Option<u64>,
    /// When to stop; overshot by at most one inner step.
    pub deadline: Option<Instant>,
}
