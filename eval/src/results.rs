//! What a campaign leaves: the data model that store, exports and report share.

mod moving;

use env_model::{Point, Scene};
use serde::{Deserialize, Serialize};

use crate::config::BudgetSpec;
use crate::snapshot::Snapshot;
use crate::work::Shard;

pub use moving::{GenerationRecord, Moving, MovingTrace, Subject, TraceOf, TuningRun};

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RunStatus {
    /// The planner believes in its path.
    Solved,
    /// The budget ended it.
    BudgetSpent,
    /// No path that the planner believes in.
    NotFound,
    /// The planner proved that there is none.
    Infeasible,
    /// The planner refused the problem, or panicked with a message.
    Error,
    /// Its process died (isolated and external planners).
    Crashed,
    /// It outlived its hard limit.
    Timeout,
    /// It outgrew its memory limit.
    OutOfMemory,
}

impl RunStatus {
    /// Every status, in the order of declaration.
    pub const ALL: [Self; 8] = [
        Self::Solved,
        Self::BudgetSpent,
        Self::NotFound,
        Self::Infeasible,
        Self::Error,
        Self::Crashed,
        Self::Timeout,
        Self::OutOfMemory,
    ];

    /// The name in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::BudgetSpent => "budget_spent",
            Self::NotFound => "not_found",
            Self::Infeasible => "infeasible",
            Self::Error => "error",
            Self::Crashed => "crashed",
            Self::Timeout => "timeout",
            Self::OutOfMemory => "out_of_memory",
        }
    }

    /// Whether its process came to an end with it.
    pub fn is_killed(self) -> bool {
        matches!(self, Self::Crashed | Self::Timeout | Self::OutOfMemory)
    }

    /// The status of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|s| s.name() == name)
    }
}

/// What a scene is for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SceneSet {
    /// Planners are compared on it.
    #[default]
    Test,
    /// Settings were chosen on it, so it says nothing about how well they do elsewhere: it is
    /// shown, but takes no part in any statistic over scenes.
    Tuning,
}

impl SceneSet {
    /// The name in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Test => "test",
            Self::Tuning => "tuning",
        }
    }

    /// The set of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Test, Self::Tuning].into_iter().find(|s| s.name() == name)
    }
}

/// One point of a run's convergence: its best cost when it last improved.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Evaluations of the planner's objective so far.
    pub evaluations: u64,
    /// Microseconds since the run began.
    pub time_us: f64,
    /// Best cost so far by the planner's own objective.
    pub cost: f64,
}

/// One run, judged.
#[derive(Debug, Clone, PartialEq)]
pub struct RunRecord {
    /// Name of the scene.
    pub scene: String,
    /// Label of the planner.
    pub planner: String,
    /// Repeat, from 0.
    pub repeat: u32,
    /// The run's seed, < 2⁵³.
    pub seed: u64,
    /// How it ended.
    pub status: RunStatus,
    /// The independent judge's verdict, never the planner's word.
    pub valid: bool,
    /// Path length in scene units; `None` without a path.
    pub length: Option<f64>,
    /// length / optimum − 1; `None` unless valid and the optimum is known.
    pub gap: Option<f64>,
    /// Least clearance of the path, negative inside obstacles; `None` without a path or in an empty world.
    pub clearance_min: Option<f64>,
    /// Total absolute turning, rad; `None` without a path.
    pub turning: Option<f64>,
    /// Iterations of the planner's outer loop.
    pub iterations: u64,
    /// Evaluations of the planner's own objective.
    pub evaluations: u64,
    /// Tests of one segment against the world.
    pub collision_checks: u64,
    /// Wall time of the planning call, µs.
    pub time_us: f64,
    /// Processor time of the planning call, µs.
    pub cpu_us: f64,
    /// What went wrong, if anything.
    pub error: Option<String>,
    /// Cost of the path by the planner's own objective; `None` while infinite.
    pub cost: Option<f64>,
    /// Named parts of that objective, in the planner's order; only finite ones.
    pub terms: Vec<(String, f64)>,
    /// The path; empty without one.
    pub path: Vec<Point>,
    /// Convergence: one entry per improvement.
    pub progress: Vec<Progress>,
    /// What reaching the planner in its process cost beside `time_us`, µs; `None` where it ran in the bench's own
    /// process, or where the whole round trip counts as its time.
    pub overhead_us: Option<f64>,
    /// What a simulation came to; `None` of a path.
    pub moving: Option<Moving>,
    /// What a tuning came to; `None` of anything else.
    pub tuning: Option<TuningRun>,
}

impl RunRecord {
    /// A run of which nothing is known yet: an error without a message.
    pub fn empty(scene: &str, planner: &str, repeat: u32, seed: u64) -> Self {
        Self {
            scene: scene.to_owned(),
            planner: planner.to_owned(),
            repeat,
            seed,
            status: RunStatus::Error,
            valid: false,
            length: None,
            gap: None,
            clearance_min: None,
            turning: None,
            iterations: 0,
            evaluations: 0,
            collision_checks: 0,
            time_us: 0.0,
            cpu_us: 0.0,
            error: None,
            cost: None,
            terms: Vec::new(),
            path: Vec::new(),
            progress: Vec::new(),
            overhead_us: None,
            moving: None,
            tuning: None,
        }
    }

    /// The part of the planner's objective called `name`.
    pub fn term(&self, name: &str) -> Option<f64> {
        self.terms.iter().find(|(n, _)| n == name).map(|(_, value)| *value)
    }
}

/// The exact shortest length in a scene, or why it is not known.
#[derive(Debug, Clone, PartialEq)]
pub struct Optimum {
    /// Shortest length among obstacles shrunk by the scene's ε.
    pub length: Option<f64>,
    /// A polyline of that path, for pictures.
    pub path: Vec<Point>,
    /// Why there is no length.
    pub reason: Option<String>,
}

/// A scene of the campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneResult {
    /// The scene itself.
    pub scene: Scene,
    /// Its optimum.
    pub optimum: Optimum,
    /// What it is for.
    pub set: SceneSet,
    /// What moves in it, where something does: `scene` then only stands for its field.
    pub simulation: Option<strategy::Settings>,
}

/// A planner of the campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannerInfo {
    /// The label in tables.
    pub label: String,
    /// The kind in the catalogue.
    pub kind: String,
    /// Every setting actually used, as TOML.
    pub settings: String,
    /// Label of the table it was written in: variants of a sweep share it.
    pub group: String,
    /// What tells it from the others of its group, as in its label; empty for an only one.
    pub varied: String,
    /// What a run may spend.
    pub budget: BudgetSpec,
}

impl PlannerInfo {
    /// A planner that is no variant, without a budget.
    pub fn plain(label: &str, kind: &str, settings: &str) -> Self {
        Self {
            label: label.to_owned(),
            kind: kind.to_owned(),
            settings: settings.to_owned(),
            group: label.to_owned(),
            varied: String::new(),
            budget: BudgetSpec::default(),
        }
    }
}

/// Where and how the numbers were made.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of the program.
    pub version: String,
    /// Debug or release build.
    pub profile: String,
    /// Operating system and architecture.
    pub platform: String,
    /// Processor model.
    pub cpu: String,
    /// Logical processors.
    pub cores: usize,
    /// Threads that ran planners.
    pub jobs: usize,
    /// When the campaign began, RFC 3339, UTC.
    pub started: String,
    /// When it ended.
    pub finished: String,
    /// Identity of the campaign: hash of resolved comparison, scenes and version.
    pub identity: String,
    /// What a reader ought to know of how the scenes came about; manifests before these notes had none.
    #[serde(default)]
    pub notes: Vec<String>,
    /// Whether every planner ran in a process of its own; external ones always do.
    #[serde(default)]
    pub isolated: bool,
    /// How often the campaign was taken up again.
    #[serde(default)]
    pub resumed: u32,
    /// What part of the campaign this is, as I/N; empty for all of it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub shard: String,
    /// The shards that were merged into this campaign, each with its machine and times.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub shards: Vec<Manifest>,
    /// The stretches in which its runs were made, the earliest first; empty for merged campaigns and older ones.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sessions: Vec<Session>,
}

/// From a start to its end or interruption.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Session {
    /// When it began, RFC 3339, UTC.
    pub started: String,
    /// When it ended; empty where it was interrupted, or lasts.
    pub finished: String,
    /// How many runs were there before it.
    pub runs_before: usize,
    /// Threads that ran planners.
    pub jobs: usize,
    /// Whether every planner ran in a process of its own.
    pub isolated: bool,
}

impl Manifest {
    /// The part of the campaign that is to be made.
    pub fn part(&self) -> Shard {
        self.shard.parse().unwrap_or(Shard::WHOLE)
    }
}

/// A whole campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct Results {
    /// Name of the comparison.
    pub name: String,
    /// The comparison's seed.
    pub seed: u64,
    /// Repeats per planner and scene.
    pub repeats: u32,
    /// What the runs are.
    pub subject: Subject,
    /// The keys of the table `[behaviour]` in force, as TOML; empty for other subjects.
    pub protocol: String,
    /// The planners in the comparison file's order.
    pub planners: Vec<PlannerInfo>,
    /// The scenes in the comparison file's order.
    pub scenes: Vec<SceneResult>,
    /// The runs, sorted by scene, planner, repeat (names in byte order).
    pub runs: Vec<RunRecord>,
    /// What planners looked like at the end of some runs, in the order of scenes and planners.
    pub snapshots: Vec<Snapshot>,
    /// Simulations to look at, in the order of scenes and planners.
    pub traces: Vec<MovingTrace>,
    /// Machine, versions, times.
    pub manifest: Manifest,
}

impl Results {
    /// How many runs it has when it is complete; of a shard, when that is.
    pub fn planned(&self) -> usize {
        let units = self.scenes.len().saturating_mul(self.repeats as usize);
        self.manifest.part().size(units).saturating_mul(self.planners.len())
    }

    /// The runs of one planner, over one scene or (`None`) all of them.
    pub fn runs_of<'a>(&'a self, planner: &'a str, scene: Option<&'a str>) -> impl Iterator<Item = &'a RunRecord> {
        self.runs.iter().filter(move |r| r.planner == planner && scene.is_none_or(|s| r.scene == s))
    }
}

#[cfg(test)]
mod tests {
    use super::Manifest;

    #[test]
    fn manifests_without_notes_are_still_read() {
        let manifest = Manifest { jobs: 2, ..Manifest::default() };
        let mut json = serde_json::to_value(&manifest).unwrap();
        json.as_object_mut().unwrap().remove("notes").unwrap();
        assert_eq!(serde_json::from_value::<Manifest>(json).unwrap(), manifest);
    }
}
