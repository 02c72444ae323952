//! One refinement under way: the best path so far, the budget, the observer.

use env_model::{Point, World};
use planner_api::{Run, View};

/// What the stages of a refinement share.
pub(crate) struct Session<'a, 'r> {
    pub(crate) world: &'a World,
    run: &'a mut Run<'r>,
    /// The best path; the planner's own until something free is found.
    pub(crate) path: Vec<Point>,
    /// Its cost; +∞ while it collides or has none in the model.
    pub(crate) cost: f64,
    /// Whether `path` came out of a programme.
    pub(crate) found: bool,
}

impl<'a, 'r> Session<'a, 'r> {
    /// Begins at `path`, without cost.
    pub(crate) fn new(world: &'a World, run: &'a mut Run<'r>, path: &[Point]) -> Self {
        Self { world, run, path: path.to_vec(), cost: f64::INFINITY, found: false }
    }

    /// Whether another programme may be solved.
    pub(crate) fn allows(&mut self) -> bool {
        self.run.allows(1)
    }

    /// Whether work between programmes may go on.
    pub(crate) fn in_time(&mut self) -> bool {
        self.run.in_time()
    }

    /// Counts a solved programme: an iteration and an evaluation.
    pub(crate) fn count(&mut self) {
        self.run.spent.iterations += 1;
        self.run.spent.evaluations += 1;
    }

    /// Whether every segment of `path` is free; counts the tests.
    pub(crate) fn is_free(&mut self, path: &[Point]) -> bool {
        self.run.spent.collision_checks += path.len().saturating_sub(1) as u64;
        self.world.path_free(path)
    }

    /// Takes `path` if it costs less than the best and is free. Returns whether it is free,
    /// or true without a test when it costs more.
    pub(crate) fn offer(&mut self, path: &[Point], cost: f64) -> bool {
        if cost >= self.cost {
            return true;
        }
        let free = self.is_free(path);
        if free {
            self.path.clear();
            self.path.extend_from_slice(path);
            self.cost = cost;
            self.found = true;
        }
        free
    }

    /// Shows the observer the best so far.
    pub(crate) fn report(&mut self) {
        let path = &self.path;
        self.run.report("qp", self.cost, || View::Path(path));
    }
}
