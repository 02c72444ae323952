//! What a simulation comes to.

use serde::{Deserialize, Serialize};

/// Figures of one simulation, all but the counts of calls as the referee saw them.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Metrics {
    /// How long it lasted, in seconds.
    pub duration_s: f64,
    /// Own robots; with waves, each counts once a wave that began.
    pub robots: usize,
    /// Own robots that came to stand at their goal for good.
    pub arrived: usize,
    /// Mean time of arrival since the beginning of its wave, in seconds; `None` unless all arrived.
    pub arrival_s: Option<f64>,
    /// Mean least time, in seconds, if nothing were in the way.
    pub least_s: f64,
    /// Contacts of an own robot with another robot.
    pub collisions: u32,
    /// How often an own robot went where it must not be, over the border or into a zone of the rules, or became faster
    /// than they allow.
    pub violations: u32,
    /// Mean seconds that an own robot spent so, those included in which a zone came upon it.
    pub violation_s: f64,
    /// Collisions that are crash fouls by an own robot.
    pub fouls: u32,
    /// Way of the robots that arrived over the straight ones; `None` where none did.
    pub length_ratio: Option<f64>,
    /// Least clearance between an own robot and another one, in metres, negative in contact; `None` for one robot alone.
    pub least_clearance: Option<f64>,
    /// How often a second an own robot's plan changes by more than its radius within the next second.
    pub switches_per_s: f64,
    /// Mean seconds for which an own robot stood elsewhere than at its goal.
    pub stuck_s: f64,
    /// Mean distance of own robots to their places in the formation, in metres, where there is one.
    pub formation_error: Option<f64>,
    /// Calls of controllers. A robot that is ordered to halt, or whose input is unusable, is none.
    pub calls: u64,
    /// Calls whose answer was to brake: nothing was found, or there was no time left to stop later.
    pub brakes: u64,
    /// Those of `brakes` for which there was no time left to stop later.
    pub emergency_brakes: u64,
    /// Calls whose answer was to escape from an obstacle.
    pub escapes: u64,
    /// How often a robot braked because it was ordered to halt.
    pub halts: u64,
    /// How often a robot braked because its input was unusable, or its controller's call ended in an error.
    pub errors: u64,
    /// Work of the controllers: iterations, evaluations, collision checks.
    pub work: [u64; 3],
}

impl Metrics {
    /// Whether all arrived and nobody touched anybody or broke a rule.
    pub fn is_clean(&self) -> bool {
        self.arrived == self.robots && self.collisions == 0 && self.violations == 0
    }

    /// Collisions a minute.
    pub fn collisions_per_minute(&self) -> f64 {
        f64::from(self.collisions) * 60.0 / self.duration_s
    }

    /// Crash fouls a minute.
    pub fn fouls_per_minute(&self) -> f64 {
        f64::from(self.fouls) * 60.0 / self.duration_s
    }

    /// Mean arrival over mean least time; `None` unless all arrived.
    pub fn time_ratio(&self) -> Option<f64> {
        self.arrival_s.map(|t| t / self.least_s)
    }
}
