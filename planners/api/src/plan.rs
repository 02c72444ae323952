//! What a planner returns.

use env_model::Point;

/// Work done in a run, summed over all its stages.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    /// Iterations of outer loops.
    pub iterations: u64,
    /// Evaluations of the planner's own objective.
    pub evaluations: u64,
    /// Tests of one segment against the world: the currency between families.
    pub collision_checks: u64,
}

/// A plan; its buffers are reused from call to call.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The path; its first and last points are exactly start and goal. Empty when there is none.
    pub path: Vec<Point>,
    /// Its cost by the planner's own objective; +∞ without a path.
    pub cost: f64,
    /// Work done.
    pub counters: Counters,
    /// Named parts of the planner's own objective, e.g. `("length", L)` and
    /// `("risk", W)`; empty where the cost has no parts. Without a path, a descent
    /// that got stuck says where: `("stuck_x", x)`, `("stuck_y", y)`, scene units.
    pub terms: Vec<(&'static str, f64)>,
    /// Other candidate paths, which refinement may use; they may collide.
    pub candidates: Candidates,
}

impl Default for Plan {
    fn default() -> Self {
        Self::new()
    }
}

impl Plan {
    /// A plan without path.
    pub fn new() -> Self {
        Self {
            path: Vec::new(),
            cost: f64::INFINITY,
            counters: Counters::default(),
            terms: Vec::new(),
            candidates: Candidates::default(),
        }
    }

    /// Forgets everything but the buffers.
    pub fn clear(&mut self) {
        self.path.clear();
        self.cost = f64::INFINITY;
        self.counters = Counters::default();
        self.terms.clear();
        self.candidates.clear();
    }
}

/// A list of paths in one buffer.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Candidates {
    points: Vec<Point>,
    ends: Vec<usize>,
}

impl Candidates {
    /// Removes all paths.
    pub fn clear(&mut self) {
        self.points.clear();
        self.ends.clear();
    }

    /// Appends a path.
    pub fn push(&mut self, path: impl IntoIterator<Item = Point>) {
        self.push_with(|points| points.extend(path));
    }

    /// Appends the path that `write` adds to the buffer.
    pub fn push_with(&mut self, write: impl FnOnce(&mut Vec<Point>)) {
        write(&mut self.points);
        self.ends.push(self.points.len());
    }

    /// How many paths there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The paths in the order of their addition.
    pub fn iter(&self) -> impl Iterator<Item = &[Point]> + '_ {
        (0..self.ends.len()).map(|i| {
            let begin = if i == 0 { 0 } else { self.ends[i - 1] };
            &self.points[begin..self.ends[i]]
        })
    }
}
