//! What a simulation leaves behind.

use serde::{Deserialize, Serialize};

use crate::Metrics;

/// One own robot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RobotRecord {
    /// Where it began.
    pub start: [f64; 2],
    /// Where it was to stand in the end.
    pub goal: [f64; 2],
    /// When it came to stand there for good, in seconds; `None` if never.
    pub arrival_s: Option<f64>,
    /// The least time that any motion within its limits takes if nothing is in its way, in seconds.
    pub least_s: f64,
    /// How far it went, in metres.
    pub travelled: f64,
    /// Collisions that it took part in.
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
    /// One call for one robot, in microseconds: median, 99 %, 99.9 %, greatest.
    pub call_us: [f64; 4],
    /// All robots of one frame.
    pub frame_us: [f64; 4],
    /// Frames that took longer than there is time between two.
    pub misses: u64,
    /// All calls together.
    pub total_us: f64,
}

/// The nearest-rank quantiles 0.5, 0.99, 0.999 and 1 of `values`, which get sorted; zeros for none.
fn quantiles(values: &mut [f64]) -> [f64; 4] {
    values.sort_unstable_by(f64::total_cmp);
    [0.5, 0.99, 0.999, 1.0].map(|q| {
        let rank = (q * values.len() as f64).ceil() as usize;
        values.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
    })
}

impl Compute {
    /// Sums up the times of calls and of frames, in microseconds, with `period_us` between two frames.
    pub fn new(calls: &mut [f64], frames: &mut [f64], period_us: f64) -> Self {
        let (total_us, misses) = (calls.iter().sum(), frames.iter().filter(|t| **t > period_us).count() as u64);
        Self { call_us: quantiles(calls), frame_us: quantiles(frames), misses, total_us }
    }
}

/// One simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// What it comes to.
    pub metrics: Metrics,
    /// Own robots in their order.
    pub robots: Vec<RobotRecord>,
    /// Times of the controllers.
    pub compute: Compute,
    /// For pictures.
    pub trace: Trace,
}
