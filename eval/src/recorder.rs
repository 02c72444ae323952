//! Watches a run and keeps its improvements: the convergence curve.

use std::ops::ControlFlow;
use std::time::Instant;

use planner_api::{Detail, Frame, Observer};

use crate::campaign::micros;
use crate::results::Progress;

/// Runs with more improvements than this allocate while they are timed.
const ROOM: usize = 8192;

/// Keeps (evaluations, time, cost) whenever the best cost falls to a finite value; reads the clock only then.
pub struct Recorder {
    began: Instant,
    best: f64,
    improvements: Vec<Progress>,
}

impl Default for Recorder {
    fn default() -> Self {
        Self::new()
    }
}

impl Recorder {
    /// A recorder with room for a usual run.
    pub fn new() -> Self {
        Self { began: Instant::now(), best: f64::INFINITY, improvements: Vec::with_capacity(ROOM) }
    }

    /// Forgets the last run and starts the clock.
    pub fn begin(&mut self) -> Instant {
        self.improvements.clear();
        self.best = f64::INFINITY;
        self.began = Instant::now();
        self.began
    }

    /// What it has seen since, costs falling.
    pub fn improvements(&self) -> &[Progress] {
        &self.improvements
    }
}

impl Observer for Recorder {
    fn detail(&self) -> Detail {
        Detail::Progress
    }

    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
        if frame.best_cost < self.best && frame.best_cost.is_finite() {
            self.best = frame.best_cost;
            let (evaluations, cost) = (frame.evaluations, frame.best_cost);
            self.improvements.push(Progress { evaluations, time_us: micros(self.began), cost });
        }
        ControlFlow::Continue(())
    }
}
