//! Campaigns by hand.

use crate::results::{
    Manifest, Optimum, PlannerInfo, Progress, Results, RunRecord, RunStatus, SceneResult, SceneSet, Subject,
};
use crate::testing;

/// A run of 100 evaluations and 1 ms with a valid path of `length`, or none when that is infinite.
pub fn run(scene: &str, planner: &str, repeat: u32, length: f64) -> RunRecord {
    let valid = length.is_finite();
    RunRecord {
        status: if valid { RunStatus::Solved } else { RunStatus::NotFound },
        valid,
        length: valid.then_some(length),
        iterations: 10,
        evaluations: 100,
        collision_checks: 1000,
        time_us: 1000.0,
        cpu_us: 1000.0,
        cost: valid.then_some(length),
        ..RunRecord::empty(scene, planner, repeat, 0)
    }
}

/// Progress points (evaluations, time in µs, cost).
pub fn progress<const N: usize>(points: [(u64, f64, f64); N]) -> Vec<Progress> {
    points.map(|(evaluations, time_us, cost)| Progress { evaluations, time_us, cost }).to_vec()
}

/// Results of these runs; scenes with their optimal lengths.
pub fn results(planners: &[&str], scenes: &[(&str, Option<f64>)], runs: Vec<RunRecord>) -> Results {
    let planner = |p: &&str| PlannerInfo::plain(p, "fake", "");
    let scene = |(name, length): &(&str, Option<f64>)| SceneResult {
        scene: testing::scene(name),
        optimum: Optimum { length: *length, path: Vec::new(), reason: None },
        set: SceneSet::Test,
        simulation: None,
    };
    Results {
        name: "by hand".into(),
        seed: 0,
        repeats: runs.iter().map(|r| r.repeat + 1).max().unwrap_or(0),
        subject: Subject::Paths,
        protocol: String::new(),
        planners: planners.iter().map(planner).collect(),
        scenes: scenes.iter().map(scene).collect(),
        runs,
        snapshots: Vec::new(),
        traces: Vec::new(),
        manifest: Manifest::default(),
    }
}

/// One scene "s" of optimum 10 and its runs: for each planner the gaps of its repeats in per cent.
pub fn one_scene(planners: &[(&str, &[f64])]) -> Results {
    let labels: Vec<&str> = planners.iter().map(|p| p.0).collect();
    let runs = |(label, gaps): &(&str, &[f64])| -> Vec<RunRecord> {
        (0..).zip(gaps.iter()).map(|(i, gap)| run("s", label, i, 10.0 * (1.0 + gap / 100.0))).collect()
    };
    results(&labels, &[("s", Some(10.0))], planners.iter().flat_map(runs).collect())
}
