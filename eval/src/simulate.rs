//! Makes the runs of moving scenes: a team of one planner, driven from beginning to end in the bench's own process.
//!
//! There is no warm-up: the thousands of calls of one simulation are one. Only the controllers' calls are timed.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use cpu_time::ThreadTime;
use strategy::{CallBudget, Record, Settings, Trace};

use crate::campaign::micros;
use crate::config::{BudgetSpec, PlannerEntry};
use crate::results::{Moving, RunRecord, RunStatus};
use crate::runner::panicked;

/// What `entry`'s team makes of the moving scene `settings`, which is called `scene`; and who was where when.
pub fn run(entry: &PlannerEntry, scene: &str, settings: &Settings, seed: u64) -> (RunRecord, Option<Trace>) {
    let mut run = RunRecord::empty(scene, &entry.label, 0, seed);
    let clock = Clock::default();
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let text = entry.settings.to_string();
        let read = || clock.read();
        strategy::simulate(settings, (&entry.kind, &text), call_budget(&entry.budget), seed, &read)
    }));
    run.cpu_us = clock.cpu.get();
    match outcome {
        Ok(Ok(record)) => {
            let trace = tell(&mut run, record);
            return (run, Some(trace));
        }
        Ok(Err(e)) => run.error = Some(e.to_string()),
        Err(panic) => run.error = Some(panicked(panic.as_ref())),
    }
    (run, None)
}

/// Writes into `run` what `record` says of it.
fn tell(run: &mut RunRecord, record: Record) -> Trace {
    let (moving, trace) = Moving::of(record);
    let metrics = &moving.metrics;
    run.valid = metrics.is_clean();
    run.status = if run.valid { RunStatus::Solved } else { RunStatus::NotFound };
    run.length = metrics.arrival_s;
    run.gap = metrics.time_ratio().filter(|r| run.valid && r.is_finite()).map(|r| r - 1.0);
    run.clearance_min = metrics.least_clearance;
    [run.iterations, run.evaluations, run.collision_checks] = metrics.work;
    // A call's, as elsewhere: a run that lasts longer is not slower.
    run.time_us = moving.compute.total_us / metrics.calls.max(1) as f64;
    run.cpu_us /= metrics.calls.max(1) as f64;
    run.moving = Some(moving);
    trace
}

/// The budget of one call of a controller.
fn call_budget(spec: &BudgetSpec) -> CallBudget {
    let BudgetSpec { iterations, evaluations, time_ms } = *spec;
    CallBudget { iterations, evaluations, time: time_ms.map(|ms| Duration::from_secs_f64(ms / 1000.0)) }
}

/// Read before and after every call of a controller.
struct Clock {
    began: Instant,
    /// Processor time when the call under way began.
    call: Cell<Option<ThreadTime>>,
    /// That of all calls before, µs.
    cpu: Cell<f64>,
}

impl Default for Clock {
    fn default() -> Self {
        Self { began: Instant::now(), call: Cell::new(None), cpu: Cell::new(0.0) }
    }
}

impl Clock {
    /// Microseconds; the slower look at the processor's clock is taken outside of the call.
    fn read(&self) -> f64 {
        match self.call.take() {
            None => {
                self.call.set(Some(ThreadTime::now()));
                micros(self.began)
            }
            Some(call) => {
                let now = micros(self.began);
                self.cpu.set(self.cpu.get() + call.elapsed().as_nanos() as f64 / 1000.0);
                now
            }
        }
    }
}
