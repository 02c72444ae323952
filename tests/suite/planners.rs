//! The planners under test.

use planner_api::Planner;
use planner_catalogue::{build_str, kinds};

/// Every kind with default settings, and compositions.
pub fn planners() -> Vec<(String, Box<dyn Planner>)> {
    let mut planners: Vec<_> = kinds()
        .iter()
        .map(|kind| (kind.name.to_owned(), build_str(kind.name, "").unwrap_or_else(|e| panic!("{e}")).planner))
        .collect();
    for (name, kind, settings) in [
        ("pso + qp", "pso", "refine = [\"qp\"]"),
        ("pso + free smooth qp", "pso", "refine = [{ kind = \"qp\", model = \"free\", objective = \"smooth\" }]"),
        ("straight-line + qp", "straight-line", "refine = [\"qp\"]"),
        ("tangent + smooth qp", "tangent", "refine = [{ kind = \"qp\", objective = \"smooth\" }]"),
        ("pso-qp, final class", "pso-qp", "classes = \"final\""),
        ("rrt-connect + qp", "rrt-connect", "refine = [\"qp\"]"),
        ("pso, ring", "pso", "topology = \"ring\"\nbounds = \"reflect\""),
    ] {
        let planner = build_str(kind, settings).unwrap_or_else(|e| panic!("{name}: {e}")).planner;
        planners.push((name.to_owned(), planner));
    }
    planners
}
