//! `cargo bench --bench frames`: whole teams at 60 Hz.
//!
//! Eleven robots run to positions that change whenever all have arrived, for ten simulated minutes: alone, and among
//! eleven opponents that drift about. What is measured is what a strategy layer waits for: the guard's answer for one
//! robot, worlds and predictions included, and the answers of all robots of a frame. Everything is done twice: the
//! same seed must give the same trajectories to the last bit. Memory is the process's resident set after a tenth of
//! the time, after half of it and at the end.
//!
//! `-- --minutes 1` is a quick look, `-- --planner tangent` one planner alone.

use std::process::ExitCode;
use std::time::Instant;

use strategy::{CallBudget, Cooperation, PlayKind, Settings, Simulation};
use touchline_tests::report::{cpu, option, print_table, time};

/// Planner, settings, budget of evaluations a call, mark for the 99 % quantile of a frame among opponents in µs.
const PLANNERS: [(&str, &str, u64, f64); 2] = [
    ("tangent", "", u64::MAX, 2000.0),
    // Nineteen iterations of twenty particles, and what the refinement needs.
    ("pso-qp", "qp = { solver = \"structured\" }", 400, 12000.0),
];

/// One long simulation.
struct Outcome {
    compute: strategy::Compute,
    collisions: u32,
    brakes: u64,
    /// FNV-1a over the bits of all trajectories.
    hash: u64,
    /// Kilobytes after a tenth of the time, after half of it, and at the end.
    memory: [u64; 3],
}

fn main() -> ExitCode {
    let minutes: f64 = option("--minutes").and_then(|m| m.parse().ok()).unwrap_or(10.0);
    let only = option("--planner");
    println!("{}: 11 robots, 60 frames a second, {minutes} simulated minutes\n", cpu());
    let mut rows = Vec::new();
    let (mut same, mut flat) = (true, true);
    for (kind, settings, evaluations, mark) in PLANNERS {
        if only.as_deref().is_some_and(|only| only != kind) {
            continue;
        }
        for opponents in [0, 11] {
            let run = || simulate(kind, settings, evaluations, opponents, 60.0 * minutes);
            let (outcome, again) = (run(), run());
            same &= outcome.hash == again.hash;
            // Planners' buffers grow to what the hardest frame so far took, so the second half is looked at. What is
            // kept of a wave of eleven ways is a kilobyte; a call that leaked a hundred bytes would leave 18 MB in it.
            flat &= minutes < 10.0 || outcome.memory[2] < outcome.memory[1] + 1024;
            let (call, frame) = (outcome.compute.call_us.map(time), outcome.compute.frame_us.map(time));
            let [c50, c99, c999, c_max] = call;
            let [f50, f99, f999, f_max] = frame;
            let mark = if opponents > 0 { format!("≤ {}", time(mark)) } else { "–".into() };
            let misses = outcome.compute.misses.to_string();
            let memory = outcome.memory.map(|kilobytes| kilobytes / 1024);
            let memory = format!("{} → {} → {} MB", memory[0], memory[1], memory[2]);
            let hash = format!("{:016x}{}", outcome.hash, if outcome.hash == again.hash { "" } else { " DIFFERS" });
            let safety = format!("{} / {}", outcome.collisions, outcome.brakes);
            let name = format!("{kind}, {opponents} opponents");
            rows.push([name, c50, c99, c999, c_max, f50, f99, f999, f_max, mark, misses, memory, hash, safety]);
        }
    }
    let head = [
        "planner",
        "call p50",
        "p99",
        "p99.9",
        "maximum",
        "frame p50",
        "p99",
        "p99.9",
        "maximum",
        "mark for p99",
        "late frames",
        "memory",
        "trajectories",
        "collisions / brakes",
    ];
    print_table(head, &rows);
    if same && flat { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn simulate(kind: &str, planner: &str, evaluations: u64, opponents: usize, duration_s: f64) -> Outcome {
    let settings = Settings {
        play: PlayKind::Positions,
        waves: 10_000,
        robots: 11,
        opponents,
        duration_s,
        cooperation: Cooperation::Priority,
        emergency_brake: true,
        ..Settings::default()
    };
    let evaluations = (evaluations < u64::MAX).then_some(evaluations);
    let budget = CallBudget { evaluations, ..CallBudget::default() };
    let mut simulation = Simulation::new(&settings, (kind, planner), budget, 1).expect("valid").without_trace();
    let began = Instant::now();
    let clock = || began.elapsed().as_secs_f64() * 1e6;
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut memory = [0; 3];
    while !simulation.is_over() {
        simulation.step(&clock).expect("no swaps");
        for answer in simulation.team().answers() {
            for piece in answer.trajectory.pieces() {
                let (p, v, a) = (piece.position, piece.velocity, piece.acceleration);
                for value in [piece.duration, p.x, p.y, v.x, v.y, a.x, a.y] {
                    hash = (hash ^ value.to_bits()).wrapping_mul(0x0100_0000_01b3);
                }
            }
        }
        for (share, memory) in [0.1, 0.5].into_iter().zip(&mut memory) {
            if *memory == 0 && simulation.time() >= share * duration_s {
                *memory = resident();
            }
        }
    }
    assert!(simulation.time() >= duration_s - 1e-9, "ended after {} s", simulation.time());
    memory[2] = resident();
    let record = simulation.record();
    let (collisions, brakes) = (record.metrics.collisions, record.metrics.brakes);
    Outcome { compute: record.compute, collisions, brakes, hash, memory }
}

/// The process's resident set in kilobytes; 0 where the system does not say.
fn resident() -> u64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    pages.and_then(|text| text.split_whitespace().nth(1)?.parse::<u64>().ok()).map_or(0, |pages| pages * 4)
}
