//! A made-up tuning of behaviour control: published gains, and two searches that improve on them more or less.

use env_model::Scene;
use eval::results::{
    GenerationRecord, Manifest, Optimum, PlannerInfo, Results, RunRecord, RunStatus, SceneResult, SceneSet, Subject,
    TuningRun,
};

use crate::Random;

const PROTOCOL: &str = "robots = 4\nopponents = 6\nformation = \"diamond\"\ntraining = 8\nheld_out = 64\n\n[weights]\npath = 0.5\navoidance = 0.5\nformation = 0.0\narrival = 0.0\n";
const PARAMETERS: [(&str, f64, f64); 6] = [
    ("goal_gain", 0.8, 1.1),
    ("obstacle_gain", 1.5, 1.9),
    ("obstacle_margin", 0.05, 0.08),
    ("robot_gain", 2.0, 2.9),
    ("robot_sphere", 0.2, 0.31),
    ("noise_gain", 0.1, 0.02),
];
/// Label, and how much of what can be gained it gains; 0 of what is given.
const PLANNERS: [(&str, f64); 3] = [("balch-arkin-1998", 0.0), ("ga-binary", 0.06), ("ga-real", 0.004)];

fn tuning(gain: f64, random: &mut Random) -> TuningRun {
    let luck = 0.03 * (random.next() - 0.5);
    let generation = |g: u32| {
        let grown = gain.max(0.02) * (1.0 - libm::exp(-0.25 * f64::from(g)));
        GenerationRecord { max: 0.71 + grown + luck, mean: 0.48 + 2.2 * grown + luck + 0.01 * random.next() }
    };
    let generations: Vec<GenerationRecord> = if gain > 0.0 { (0..30).map(generation).collect() } else { Vec::new() };
    let parameters = PARAMETERS.map(|(name, published, tuned)| {
        let value = if gain > 0.0 { tuned * (0.8 + 0.4 * random.next()) } else { published };
        (name.to_owned(), value)
    });
    let held_out = 0.69 + gain + luck + 0.01 * random.next();
    TuningRun {
        training: generations.last().map(|g| g.max),
        generations,
        parameters: parameters.to_vec(),
        held_out,
        each: vec![held_out; 64],
        arrived: 0.9 + gain,
        collided: 0.2 - gain,
    }
}

/// The campaign.
pub fn campaign(repeats: u32, manifest: Manifest) -> Results {
    let mut random = Random(5);
    let scene = "held-out";
    let mut runs = Vec::new();
    for (label, gain) in PLANNERS {
        for repeat in 0..repeats {
            let tuning = tuning(gain, &mut random);
            runs.push(RunRecord {
                status: RunStatus::Solved,
                valid: true,
                length: Some(1.0 - tuning.held_out),
                time_us: 2e6 * (0.9 + 0.2 * random.next()),
                tuning: Some(tuning),
                ..RunRecord::empty(scene, label, repeat, 70 + u64::from(repeat))
            });
        }
    }
    let reason = Subject::Behaviour.no_optimum().map(str::to_owned);
    let scene = Scene {
        name: scene.to_owned(),
        unit: "m".to_owned(),
        robot_radius: 0.09,
        start: [0.0, 0.0],
        goal: [1.0, 0.0],
        field: None,
        obstacles: Vec::new(),
    };
    let optimum = Optimum { length: None, path: Vec::new(), reason };
    Results {
        name: "fang-2009-behaviour".to_owned(),
        seed: 1,
        repeats,
        subject: Subject::Behaviour,
        protocol: PROTOCOL.to_owned(),
        planners: PLANNERS.map(|(label, _)| PlannerInfo::plain(label, "behaviour", "population = 40\n")).to_vec(),
        scenes: vec![SceneResult { scene, optimum, set: SceneSet::Test, simulation: None }],
        runs,
        snapshots: Vec::new(),
        traces: Vec::new(),
        manifest,
    }
}
