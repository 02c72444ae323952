//! One JSON line for each frame of a run: what an animation needs.
//!
//! Every line holds `stage`, `iteration`, `evaluations`, `best_cost` (null while
//! infinite). A path in sight adds `path`, `[[x, y], …]` in scene units. A swarm adds
//!
//! - `frame`: `origin` and `axis` = (cos θ, sin θ) of the local frame X'RY': the
//!   local point (x', y') lies at origin + x'·axis + y'·(−sin θ, cos θ);
//! - `x`: the m columns' x'; `half_width`: H = L/4 of the paper's rectangle;
//! - `positions`, `velocities`, `personal_bests`: n rows of m heights y';
//! - `personal_costs` (n), `global_best` (m), `global_cost`.

use std::io::{self, Write};
use std::ops::ControlFlow;

use planner_api::{Frame, Observer, Problem, SwarmView, View};
use serde_json::{Map, Value, json};

/// Writes frames as they come.
pub struct Tracer<W: Write> {
    out: W,
    origin: [f64; 2],
    axis: [f64; 2],
    outcome: io::Result<()>,
}

impl<W: Write> Tracer<W> {
    /// A tracer of runs on `problem`.
    pub fn new(out: W, problem: &Problem<'_>) -> Self {
        let d = problem.goal - problem.start;
        let axis = d / d.norm();
        Self { out, origin: [problem.start.x, problem.start.y], axis: [axis.x, axis.y], outcome: Ok(()) }
    }

    /// Ends the trace; the first error of writing, if there was one.
    pub fn finish(mut self) -> io::Result<()> {
        self.outcome?;
        self.out.flush()
    }

    fn line(&mut self, frame: &Frame<'_>) -> io::Result<()> {
        let mut line = Map::new();
        line.insert("stage".into(), frame.stage.into());
        line.insert("iteration".into(), frame.iteration.into());
        line.insert("evaluations".into(), frame.evaluations.into());
        line.insert("best_cost".into(), finite(frame.best_cost));
        match frame.view {
            View::Path(path) => {
                line.insert("path".into(), path.iter().map(|p| json!([p.x, p.y])).collect());
            }
            View::Swarm(swarm) => self.swarm(&mut line, &swarm),
            _ => {}
        }
        serde_json::to_writer(&mut self.out, &line)?;
        self.out.write_all(b"\n")
    }

    fn swarm(&self, line: &mut Map<String, Value>, swarm: &SwarmView<'_>) {
        let m = swarm.columns.count();
        let rows = |values: &[f64]| values.chunks(m).map(|row| json!(row)).collect::<Value>();
        line.insert("frame".into(), json!({ "origin": self.origin, "axis": self.axis }));
        line.insert("x".into(), (1..=m).map(|i| json!(swarm.columns.x(i))).collect());
        line.insert("half_width".into(), swarm.columns.half_width().into());
        line.insert("positions".into(), rows(swarm.positions));
        line.insert("velocities".into(), rows(swarm.velocities));
        line.insert("personal_bests".into(), rows(swarm.personal_bests));
        line.insert("personal_costs".into(), swarm.personal_costs.iter().copied().map(finite).collect());
        line.insert("global_best".into(), json!(swarm.global_best));
        line.insert("global_cost".into(), finite(swarm.global_cost));
    }
}

/// JSON has no infinity: null.
fn finite(value: f64) -> Value {
    if value.is_finite() { value.into() } else { Value::Null }
}

impl<W: Write> Observer for Tracer<W> {
    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
        self.outcome = self.line(frame);
        if self.outcome.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}
