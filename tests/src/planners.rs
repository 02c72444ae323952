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
        ("pso-qp, structured", "pso-qp", "qp = { solver = \"structured\" }"),
        ("influence-astar, soft", "influence-astar", "obstacles = \"soft\""),
        ("influence-astar, ring, pitch", "influence-astar", "heuristic = \"ring\"\nsearch_space = \"pitch\""),
        ("astar + qp", "astar", "refine = [\"qp\"]"),
        ("ant-colony, no elitists", "ant-colony", "elitists = 0.0\ndead_end = \"die\"\nalpha = 2.0"),
        ("grid-ga + qp", "grid-ga", "cells_passed = \"genes\"\nadaptive = false\nrefine = [\"qp\"]"),
        ("vertex-ga, length", "vertex-ga", "fitness = \"length\""),
        ("potential-field, Ge & Cui + qp", "potential-field", "repulsion = \"ge-cui\"\nrefine = [\"qp\"]"),
        ("neural + qp", "neural", "cells = 60\nrefine = [\"qp\"]"),
        ("rrt-connect + qp", "rrt-connect", "refine = [\"qp\"]"),
        ("pso, ring", "pso", "topology = \"ring\"\nbounds = \"reflect\""),
        ("pso, von Neumann", "pso", "rule = \"constriction\"\ntopology = \"von-neumann\""),
        ("pso, quantum", "pso", "rule = \"quantum\""),
        ("pso, spso-2011", "pso", "rule = \"spso-2011\""),
        ("pso, comprehensive", "pso", "rule = \"comprehensive\""),
    ] {
        let planner = build_str(kind, settings).unwrap_or_else(|e| panic!("{name}: {e}")).planner;
        planners.push((name.to_owned(), planner));
    }
    planners
}
