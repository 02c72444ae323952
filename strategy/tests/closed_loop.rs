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
    // Arrival is seen frame by frame, 20 ms at 5 cm/s before the end at the earliest.
    let ratio = record.metrics.time_ratio().unwrap();
    assert!((0.98..1.02).contains(&ratio), "{ratio}");
}
