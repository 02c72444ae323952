//! Which controllers get through crowds without touching: each in ten seeds, with the number that must be clean.

use strategy::{CallBudget, PlayKind, Settings, simulate};

/// How many of ten simulations are clean: all arrive, nobody touches anything.
fn clean(kind: &str, settings: &Settings) -> usize {
    let run = |seed| simulate(settings, (kind, ""), CallBudget::default(), seed, &|| 0.0).unwrap().metrics.is_clean();
    (0..10).filter(|seed| run(*seed)).count()
}

#[test]
fn eight_robots_change_places_on_a_circle() {
    // One in twenty may fail; of ten seeds that is one. Each for itself: mates are seen, not known.
    for (kind, least) in [("orca", 9), ("bang-bang", 9), ("moving-potential-field", 9), ("sipp", 8)] {
        let n = clean(kind, &Settings::default());
        assert!(n >= least, "{kind}: {n} of 10");
    }
    assert_eq!(clean("straight-line", &Settings::default()), 0, "the scene is a test");
}

#[test]
fn one_robot_crosses_among_opponents_that_give_no_way() {
    let settings = Settings { play: PlayKind::Crossing, robots: 1, opponents: 4, ..Settings::default() };
    for kind in ["orca", "bang-bang", "moving-potential-field", "dynamic-window", "sipp"] {
        let n = clean(kind, &settings);
        assert!(n >= 9, "{kind}: {n} of 10");
    }
    assert!(clean("straight-line", &settings) <= 5, "the scene is a test");
}

#[test]
fn a_robot_alone_gets_round_the_ball_in_stop() {
    let command = Some(strategy::rules::Command::Stop);
    let settings = Settings { robots: 1, command, ..Settings::default() };
    for kind in ["tangent", "bang-bang", "sipp"] {
        let n = clean(kind, &settings);
        assert!(n >= 9, "{kind}: {n} of 10");
    }
}
