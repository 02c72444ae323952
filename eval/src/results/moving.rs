//! What runs leave that are no single plan: simulations of moving scenes, and tunings of behaviour control.

use serde::{Deserialize, Serialize};
use strategy::{Compute, Metrics, Record, RobotRecord, Trace};

/// What the runs of a campaign are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Subject {
    /// Paths from start to goal among what stands still.
    #[default]
    Paths,
    /// Teams of robots driven frame by frame. A run's `length` is the mean time of arrival in seconds, and its `gap`
    /// that over the mean least time, less 1; it is valid when all arrived and nobody touched anything.
    Simulation,
    /// Parameters of behaviour control, given or tuned, judged on held-out scenarios. A run's `length` is its loss,
    /// 1 − fitness; every run that ended is valid.
    Behaviour,
}

impl Subject {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Paths => "paths",
            Self::Simulation => "simulation",
            Self::Behaviour => "behaviour",
        }
    }

    /// The subject of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Paths, Self::Simulation, Self::Behaviour].into_iter().find(|s| s.name() == name)
    }

    /// Why its scenes have no optimum; `None` where they may have one.
    pub fn no_optimum(self) -> Option<&'static str> {
        match self {
            Self::Paths => None,
            Self::Simulation => Some("a moving scene has no shortest path; gap is arrival over least time, less 1"),
            Self::Behaviour => Some("the best fitness is not known; 1 would be perfect"),
        }
    }
}

/// One simulation, without its pictures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Moving {
    /// What it comes to.
    pub metrics: Metrics,
    /// How long the controllers took: the only figures that differ between machines.
    pub compute: Compute,
    /// Own robots in their order.
    pub robots: Vec<RobotRecord>,
}

impl Moving {
    /// The parts of a simulation's record: this, and its trace.
    pub fn of(record: Record) -> (Self, Trace) {
        let Record { metrics, robots, compute, trace, .. } = record;
        (Self { metrics, compute, robots }, trace)
    }
}

/// Why a trace is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TraceOf {
    /// The first repeat in which not all arrived, or somebody touched something.
    FirstFailure,
    /// The run with the median time of arrival among the clean ones.
    Median,
}

/// The moves of one simulation, replayed after the last timed run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MovingTrace {
    /// Name of the scene.
    pub scene: String,
    /// Label of the planner.
    pub planner: String,
    /// Repeat.
    pub repeat: u32,
    /// Its seed.
    pub seed: u64,
    /// Why it is here.
    pub of: TraceOf,
    /// Whether the replay came to the same metrics as the run; false is possible only with time budgets.
    pub faithful: bool,
    /// Who was where when; positions to the millimetre.
    pub trace: Trace,
}

/// Best and mean training fitness of one generation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GenerationRecord {
    /// Of its best member.
    pub max: f64,
    /// Of all members.
    pub mean: f64,
}

/// Parameters of behaviour control, and what they are worth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TuningRun {
    /// The generations of the search, from the first; empty for given parameters.
    pub generations: Vec<GenerationRecord>,
    /// The parameters judged, in the order of the planner.
    pub parameters: Vec<(String, f64)>,
    /// Fitness on the scenarios of the search; `None` for given parameters.
    pub training: Option<f64>,
    /// Mean fitness on held-out scenarios.
    pub held_out: f64,
    /// Fitness on each of them.
    pub each: Vec<f64>,
    /// Share of robots that arrive there.
    pub arrived: f64,
    /// Share of robots that collide there.
    pub collided: f64,
}
