//! What a simulation leaves behind.

use hdrhistogram::Histogram;
use serde::{Deserialize, Serialize};

use crate::Metrics;

/// One own robot's way to one goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RobotRecord {
    /// Where it began.
    pub start: [f64; 2],
    /// Where it was to stand in the end.
    pub goal: [f64; 2],
    /// When it came to stand there for good, in seconds since the way's beginning; `None` if never.
    pub arrival_s: Option<f64>,
    /// The least time that any motion within its limits takes if nothing is in its way, in seconds.
    pub least_s: f64,
    /// How far it went, in metres.
    pub travelled: f64,
    /// Collisions that it took part in, on this way.
    pub collisions: u32,
}

/// Two bodies that touched.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// When, in seconds.
    pub time_s: f64,
    /// The bodies by their index in the trace.
    pub bodies: [usize; 2],
    /// Between them.
    pub at: [f64; 2],
    /// Speed at which they neared each other along the line of their centres, in m/s.
    pub closing: f64,
    /// Whether an own robot is guilty of a crash foul.
    pub foul: bool,
}

/// A body of a trace.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TraceBody {
    /// "own", "opponent" or "ball".
    pub side: String,
    /// In metres.
    pub radius: f64,
}

/// Where everybody was: for pictures.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Trace {
    /// Seconds between frames.
    pub period_s: f64,
    /// Who.
    pub bodies: Vec<TraceBody>,
    /// Positions of all bodies a frame, in metres.
    pub frames: Vec<Vec<[f64; 2]>>,
    /// Collisions.
    pub events: Vec<Event>,
}

/// How long the controllers took. Times, and so different in every run; everything else repeats.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Compute {
    /// One call for one robot, in microseconds, to three digits: median, 99 %, 99.9 %, greatest.
    pub call_us: [f64; 4],
    /// All robots of one frame.
    pub frame_us: [f64; 4],
    /// Frames that took longer than there is time between two.
    pub misses: u64,
    /// All calls together.
    pub total_us: f64,
}

/// Times of controllers as they come in: memory does not grow with their number.
#[derive(Debug, Clone)]
pub(crate) struct Stopwatch {
    calls: Histogram<u64>,
    frames: Histogram<u64>,
    period_us: f64,
    misses: u64,
    total_us: f64,
}

impl Stopwatch {
    /// With `period_us` between two frames.
    pub(crate) fn new(period_us: f64) -> Self {
        // Nanoseconds up to an hour, to three digits.
        let empty = || Histogram::new_with_bounds(1, 3_600_000_000_000, 3).expect("these bounds are allowed");
        Self { calls: empty(), frames: empty(), period_us, misses: 0, total_us: 0.0 }
    }

    /// The calls of one frame, in microseconds.
    pub(crate) fn frame(&mut self, calls: &[f64]) {
        let nanoseconds = |us: f64| (us * 1e3) as u64;
        let all: f64 = calls.iter().sum();
        for call in calls {
            self.calls.saturating_record(nanoseconds(*call));
        }
        self.frames.saturating_record(nanoseconds(all));
        self.misses += u64::from(all > self.period_us);
        self.total_us += all;
    }

    /// What it comes to.
    pub(crate) fn compute(&self) -> Compute {
        let quantiles = |h: &Histogram<u64>| {
            let [p50, p99, p999] = [0.5, 0.99, 0.999].map(|q| h.value_at_quantile(q) as f64 * 1e-3);
            [p50, p99, p999, h.max() as f64 * 1e-3]
        };
        let (call_us, frame_us) = (quantiles(&self.calls), quantiles(&self.frames));
        Compute { call_us, frame_us, misses: self.misses, total_us: self.total_us }
    }
}

/// One simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// What it comes to.
    pub metrics: Metrics,
    /// Own robots in their order, wave by wave.
    pub robots: Vec<RobotRecord>,
    /// The first of the errors that [`Metrics::errors`] counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_error: Option<String>,
    /// Times of the controllers.
    pub compute: Compute,
    /// For pictures.
    pub trace: Trace,
}

#[cfg(test)]
mod tests {
    use super::Stopwatch;

    #[test]
    fn quantiles_of_known_times() {
        let mut watch = Stopwatch::new(1000.0);
        for i in 1..=100 {
            watch.frame(&[f64::from(i), 1000.0 - f64::from(i)]);
        }
        watch.frame(&[2000.0]);
        let compute = watch.compute();
        // Of 201 calls the 101st is 1000 − 100 … in the middle: 100 or 900; the greatest 2000; to three digits.
        assert!((compute.call_us[3] - 2000.0).abs() < 2.0 && (compute.call_us[0] - 900.0).abs() < 1.0, "{compute:?}");
        assert!((compute.frame_us[0] - 1000.0).abs() < 1.0, "{compute:?}");
        assert_eq!((compute.misses, compute.total_us), (1, 102_000.0));
    }
}
