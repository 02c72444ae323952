//! A team that plans by priority and brakes in time never touches itself, whatever it is and whoever plans.

use planner_catalogue::controller_names;
use rand::seq::IndexedRandom;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use strategy::rules::Command;
use strategy::{CallBudget, Cooperation, PlayKind, Settings, Simulation, Swap};

/// As many as take a few seconds.
const CASES: u64 = 130;

fn any<T: Clone>(rng: &mut impl Rng, of: &[T]) -> T {
    of.choose(rng).expect("there is one").clone()
}

/// A team of equal robots that follow exactly, at once or late, in a play without zones that come upon it.
fn case(rng: &mut impl Rng) -> Settings {
    let duration_s = 3.0;
    let names = controller_names();
    let swaps = if rng.random_bool(0.5) { 0 } else { rng.random_range(1..4) };
    let mut at: Vec<f64> = (0..swaps).map(|_| rng.random_range(0.0..duration_s)).collect();
    at.sort_by(f64::total_cmp);
    let swap = |at_s| Swap { at_s, planner: any(rng, &names).into(), settings: Default::default() };
    let swap = at.into_iter().map(swap).collect();
    Settings {
        play: any(
            rng,
            &[PlayKind::CircleSwap, PlayKind::Crossing, PlayKind::Positions, PlayKind::Formation, PlayKind::Attack],
        ),
        command: Some(any(rng, &[Command::Off, Command::Running])),
        robots: rng.random_range(2..=12),
        duration_s,
        frame_rate: any(rng, &[5.0, 10.0, 20.0, 30.0, 60.0]),
        speed: any(rng, &[1.0, 3.0, 5.0]),
        acceleration: any(rng, &[1.0, 3.0, 6.0]),
        horizon_s: any(rng, &[0.05, 0.5, 2.0]),
        margin: any(rng, &[0.0, 0.03, 0.2]),
        latency_ms: any(rng, &[0.0, 10.0, 1e3 / 60.0, 50.0]),
        hysteresis: any(rng, &[0.0, 0.2, 1.0]),
        jitter: any(rng, &[0.0, 0.1, 0.5]),
        cooperation: Cooperation::Priority,
        emergency_brake: true,
        swap,
        ..Settings::default()
    }
}

#[test]
fn mates_never_touch() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let names = controller_names();
    let (mut runs, mut brakes) = (0, 0);
    for seed in 0..CASES {
        let settings = case(&mut rng);
        let kind = any(&mut rng, &names);
        let budget = CallBudget { iterations: Some(5), evaluations: Some(100), time: None };
        // Drawn starts may not all fit.
        let Ok(simulation) = Simulation::new(&settings, (kind, ""), budget, seed) else { continue };
        let record = simulation.without_trace().run(&|| 0.0).unwrap();
        let (n, m) = (settings.robots, &record.metrics);
        let contacts: Vec<_> = record.trace.events.iter().filter(|e| e.bodies[1] < n).collect();
        assert!(contacts.is_empty(), "seed {seed}, {kind}: {settings:#?}\n{m:?}\n{contacts:?}");
        runs += 1;
        brakes += m.emergency_brakes;
    }
    assert!(runs > CASES * 9 / 10 && brakes > 300, "{runs} runs, braked {brakes} times: the test tests little");
}
