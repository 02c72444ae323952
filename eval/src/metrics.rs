//! What is measured of a path, each metric with its definition.
//!
//! Every metric keeps its value when a path is resampled without changing its
//! course: points are never averaged over.

mod moving;

use env_model::Point;

pub use moving::{MOVING, MovingMetric};

/// A metric as `touchline list metrics` and the report name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct Metric {
    /// The column in `runs.csv`.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// How it is computed.
    pub definition: &'static str,
}

/// Version of the definitions below: it changes when any of them changes its value.
pub const VERSION: u32 = 1;

/// The metrics of a run, in the order of `runs.csv`.
pub const METRICS: [Metric; 12] = [
    Metric {
        name: "valid",
        unit: "true/false",
        definition: "verdict of the independent judge: the path starts and ends exactly at start and goal, every segment keeps a distance of at least the inflated radius − ε from every obstacle, and the robot's whole disc stays in the field − ε; ε = 1e-9 × diagonal of the box round start, goal, obstacles and field",
    },
    Metric { name: "length", unit: "scene units", definition: "sum of the lengths of the path's segments" },
    Metric {
        name: "gap",
        unit: "1",
        definition: "length/optimum − 1 with the exact continuous optimum; empty unless the path is valid and the optimum is known",
    },
    Metric {
        name: "clearance_min",
        unit: "scene units",
        definition: "least signed distance of the path to an inflated obstacle or to the border of the field, over whole segments; negative inside",
    },
    Metric {
        name: "turning",
        unit: "rad",
        definition: "sum of the absolute heading changes between neighbouring segments; segments of zero length are skipped",
    },
    Metric { name: "iterations", unit: "count", definition: "iterations of the planner's outer loops" },
    Metric { name: "evaluations", unit: "count", definition: "evaluations of the planner's own objective" },
    Metric { name: "collision_checks", unit: "count", definition: "tests of one segment against the world" },
    Metric { name: "time_us", unit: "µs", definition: "wall time of the planning call alone" },
    Metric { name: "cpu_us", unit: "µs", definition: "processor time of the planning call's thread" },
    Metric {
        name: "cost",
        unit: "the planner's own",
        definition: "cost of the path by the planner's own objective; empty while infinite",
    },
    Metric {
        name: "terms",
        unit: "the planner's own",
        definition: "named parts of the planner's own objective, as name=value separated by semicolons",
    },
];

/// Path length Σ‖pᵢ₊₁ − pᵢ‖, summed from the start, in scene units.
pub fn length(path: &[Point]) -> f64 {
    env_model::path_length(path)
}

/// Total absolute turning Σ|∠(dᵢ, dᵢ₊₁)| over neighbouring directions, rad.
///
/// The angle is atan2(|u × v|, u · v), exact to rounding for small and for
/// reversing turns alike. Segments of zero length have no direction: skipped.
pub fn turning(path: &[Point]) -> f64 {
    let mut total = 0.0;
    let mut last: Option<env_model::Vector> = None;
    for d in path.windows(2).map(|w| w[1] - w[0]).filter(|d| d.x != 0.0 || d.y != 0.0) {
        if let Some(u) = last {
            total += libm::atan2((u.x * d.y - u.y * d.x).abs(), u.x * d.x + u.y * d.y);
        }
        last = Some(d);
    }
    total
}

/// length/optimum − 1 for a valid path with a known optimum.
pub fn gap(length: f64, optimum: f64) -> f64 {
    length / optimum - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn turning_of_hand_made_paths() {
        let p = Point::new;
        assert_eq!(turning(&[]), 0.0);
        assert_eq!(turning(&[p(0.0, 0.0), p(1.0, 0.0), p(3.0, 0.0)]), 0.0, "straight");
        // Two right angles; 1e-15 is a few roundings of π.
        let zigzag = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(2.0, 1.0)];
        assert!((turning(&zigzag) - PI).abs() < 1e-15, "turns add up, whatever their sign");
        let doubled = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(1.0, 1.0), p(2.0, 1.0)];
        assert_eq!(turning(&doubled), turning(&zigzag), "repeated points change nothing");
        assert!((turning(&[p(0.0, 0.0), p(1.0, 0.0), p(0.0, 0.0)]) - PI).abs() < 1e-15, "about turn");
    }
}
