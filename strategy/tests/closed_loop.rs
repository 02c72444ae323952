//! Simulations from beginning to end.

use strategy::{CallBudget, PlayKind, Settings, simulate};

fn silent() -> f64 {
    0.0
}

#[test]
fn the_same_seed_gives_the_same_record() {
    let settings =
        Settings { play: PlayKind::Crossing, robots: 3, opponents: 4, duration_s: 3.0, ..Settings::default() };
    let run = |seed| simulate(&settings, ("tangent", ""), CallBudget::default(), seed, &silent).unwrap();
    assert_eq!(run(1), run(1));
    assert_ne!(run(1).trace.frames[0], run(2).trace.frames[0]);
}

#[test]
fn a_robot_alone_arrives_nearly_as_soon_as_it_could() {
    let settings = Settings { play: PlayKind::Crossing, robots: 1, ..Settings::default() };
    let record = simulate(&settings, ("tangent", ""), CallBudget::default(), 1, &silent).unwrap();
    assert!(record.metrics.is_clean(), "{:?}", record.metrics);
    let ratio = record.metrics.time_ratio().unwrap();
    assert!((1.0..1.01).contains(&ratio), "{ratio}");
}

/// One robot on an empty field: what latency, noise and frame rate cost.
fn alone(settings: Settings) -> strategy::Metrics {
    let settings = Settings { play: PlayKind::Crossing, robots: 1, duration_s: 10.0, ..settings };
    simulate(&settings, ("tangent", ""), CallBudget::default(), 3, &silent).unwrap().metrics
}

#[test]
fn latency_delays_and_does_no_more() {
    for frame_rate in [30.0, 60.0, 200.0] {
        for latency_ms in [0.0, 10.0, 1000.0 / 60.0, 40.0, 100.0] {
            let metrics = alone(Settings { latency_ms, frame_rate, ..Settings::default() });
            assert!(metrics.is_clean(), "{latency_ms} ms: {metrics:?}");
            // Arrivals are looked for frame by frame, which what is left from there makes up for but for rounding.
            let late = metrics.arrival_s.unwrap() - metrics.least_s;
            assert!(late < 1e-3 * latency_ms + 0.05 && late > 0.9e-3 * latency_ms, "{latency_ms} ms: {late} s late");
        }
    }
}

#[test]
fn noise_delays_a_little() {
    for (position_noise, velocity_noise, actuation_noise) in
        [(0.003, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.1), (0.003, 0.05, 0.05)]
    {
        for frame_rate in [30.0, 60.0, 200.0] {
            let noisy = Settings {
                position_noise,
                velocity_noise,
                actuation_noise,
                frame_rate,
                latency_ms: 50.0,
                ..Settings::default()
            };
            let metrics = alone(noisy);
            let case = (position_noise, velocity_noise, actuation_noise, frame_rate);
            assert!(metrics.is_clean(), "{case:?}: {metrics:?}");
            assert!(metrics.time_ratio().unwrap() < 1.15, "{case:?}: {metrics:?}");
        }
    }
}
