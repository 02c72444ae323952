//! What is measured of a simulation, each metric with its definition.

use super::Metric;
use crate::results::Moving;

/// A metric of a simulation, and where it is found; `None` where it does not apply.
pub struct MovingMetric {
    /// Its column in `simulations.csv`, unit and definition.
    pub metric: Metric,
    /// Its value.
    pub value: fn(&Moving) -> Option<f64>,
    /// Whether it is a time of this machine: all others repeat bit for bit.
    pub is_timing: bool,
}

const fn counted(
    name: &'static str,
    unit: &'static str,
    definition: &'static str,
    value: fn(&Moving) -> Option<f64>,
) -> MovingMetric {
    MovingMetric { metric: Metric { name, unit, definition }, value, is_timing: false }
}

const fn timed(name: &'static str, definition: &'static str, value: fn(&Moving) -> Option<f64>) -> MovingMetric {
    MovingMetric { metric: Metric { name, unit: "µs", definition }, value, is_timing: true }
}

/// The metrics of a simulation, in the order of `simulations.csv`. All but calls are as the referee saw them.
pub const MOVING: [MovingMetric; 37] = [
    counted("duration_s", "s", "simulated time: until all had arrived, at most the scene's", |m| {
        Some(m.metrics.duration_s)
    }),
    counted("robots", "count", "own robots", |m| Some(m.metrics.robots as f64)),
    counted("arrived", "count", "own robots that came to stand at their goal for good", |m| {
        Some(m.metrics.arrived as f64)
    }),
    counted("arrival_share", "1", "arrived / robots", |m| Some(m.metrics.arrived as f64 / m.metrics.robots as f64)),
    counted("arrival_s", "s", "mean time of arrival; empty unless all arrived", |m| m.metrics.arrival_s),
    counted(
        "least_s",
        "s",
        "mean over robots of the least time that their limits allow with nothing in the way",
        |m| Some(m.metrics.least_s),
    ),
    counted("time_ratio", "1", "arrival_s / least_s; empty unless all arrived", |m| {
        m.metrics.time_ratio().filter(|r| r.is_finite())
    }),
    counted("length_ratio", "1", "mean of way / straight way over robots that arrived; empty without one", |m| {
        m.metrics.length_ratio
    }),
    counted("collisions", "count", "contacts of an own robot with another robot", |m| {
        Some(f64::from(m.metrics.collisions))
    }),
    counted("collisions_per_min", "1/min", "collisions a simulated minute", |m| {
        Some(m.metrics.collisions_per_minute())
    }),
    counted("fouls", "count", "collisions that are crash fouls by an own robot (rules of 2026)", |m| {
        Some(f64::from(m.metrics.fouls))
    }),
    counted("fouls_per_min", "1/min", "crash fouls a simulated minute", |m| Some(m.metrics.fouls_per_minute())),
    counted(
        "violations",
        "count",
        "times that an own robot went over the border or into a zone of the rules, or became faster than they allow",
        |m| Some(f64::from(m.metrics.violations)),
    ),
    counted("violations_per_min", "1/min", "violations a simulated minute", |m| {
        Some(f64::from(m.metrics.violations) * 60.0 / m.metrics.duration_s)
    }),
    counted("violation_s", "s", "mean time that an own robot spent so", |m| Some(m.metrics.violation_s)),
    counted(
        "least_clearance",
        "m",
        "least distance from hull to hull of an own robot and another, negative in contact",
        |m| m.metrics.least_clearance,
    ),
    counted(
        "switches_per_s",
        "1/s",
        "how often a robot's plan changes by more than its radius within the next second",
        |m| Some(m.metrics.switches_per_s),
    ),
    counted("stuck_s", "s", "mean time for which a robot stood elsewhere than at its goal", |m| {
        Some(m.metrics.stuck_s)
    }),
    counted("formation_error", "m", "mean distance of robots to their places, where there is a formation", |m| {
        m.metrics.formation_error
    }),
    counted("calls", "count", "calls of controllers; a robot that is ordered to halt is none", |m| {
        Some(m.metrics.calls as f64)
    }),
    counted("brakes", "count", "calls answered by braking: nothing was found, or no time left to stop later", |m| {
        Some(m.metrics.brakes as f64)
    }),
    counted("emergency_brakes", "count", "those of brakes for which there was no time left to stop later", |m| {
        Some(m.metrics.emergency_brakes as f64)
    }),
    counted("escapes", "count", "calls answered by escaping from an obstacle", |m| Some(m.metrics.escapes as f64)),
    counted("halts", "count", "times that a robot braked because it was ordered to halt", |m| {
        Some(m.metrics.halts as f64)
    }),
    counted("errors", "count", "times that a robot braked because its input or its controller was in error", |m| {
        Some(m.metrics.errors as f64)
    }),
    counted("iterations", "count", "iterations of the controllers' outer loops", |m| Some(m.metrics.work[0] as f64)),
    counted("evaluations", "count", "evaluations of the controllers' own objectives", |m| {
        Some(m.metrics.work[1] as f64)
    }),
    counted("collision_checks", "count", "tests of one segment against the world", |m| Some(m.metrics.work[2] as f64)),
    timed("call_p50_us", "wall time of one call for one robot: median", |m| Some(m.compute.call_us[0])),
    timed("call_p99_us", "99 % of the calls take at most this", |m| Some(m.compute.call_us[1])),
    timed("call_p999_us", "99.9 % of the calls take at most this", |m| Some(m.compute.call_us[2])),
    timed("call_max_us", "the longest call", |m| Some(m.compute.call_us[3])),
    timed("frame_p50_us", "all calls of one frame together: median", |m| Some(m.compute.frame_us[0])),
    timed("frame_p99_us", "99 % of the frames take at most this", |m| Some(m.compute.frame_us[1])),
    timed("frame_p999_us", "99.9 % of the frames take at most this", |m| Some(m.compute.frame_us[2])),
    timed("frame_max_us", "the longest frame", |m| Some(m.compute.frame_us[3])),
    MovingMetric {
        metric: Metric {
            name: "deadline_misses",
            unit: "count",
            definition: "frames whose calls took longer than there is time between two; of this machine, like all times",
        },
        value: |m| Some(m.compute.misses as f64),
        is_timing: true,
    },
];
