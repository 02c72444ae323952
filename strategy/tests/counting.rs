//! What is counted of answers.

use strategy::rules::Command;
use strategy::{CallBudget, Metrics, PlayKind, Record, Settings, simulate};

fn record(settings: &Settings, planner: (&str, &str), budget: CallBudget) -> Record {
    simulate(settings, planner, budget, 1, &|| 0.0).unwrap()
}

fn settings() -> Settings {
    Settings { play: PlayKind::CircleSwap, robots: 4, duration_s: 0.5, ..Settings::default() }
}

/// Robots times frames.
const ALL: u64 = 4 * 30;

#[test]
fn halts_are_no_calls() {
    let halted = Settings { command: Some(Command::Halt), ..settings() };
    let Metrics { calls, brakes, emergency_brakes, halts, errors, .. } =
        record(&halted, ("tangent", ""), CallBudget::default()).metrics;
    assert_eq!([calls, brakes, emergency_brakes, halts, errors], [0, 0, 0, ALL, 0]);
}

#[test]
fn nothing_found_is_no_emergency() {
    let none = CallBudget { iterations: Some(0), ..CallBudget::default() };
    let settings = Settings { emergency_brake: true, ..settings() };
    let Metrics { calls, brakes, emergency_brakes, halts, errors, .. } =
        record(&settings, ("rrt-connect", ""), none).metrics;
    assert_eq!([calls, brakes, emergency_brakes, halts, errors], [ALL, ALL, 0, 0, 0]);
}

#[test]
fn no_time_left_to_stop_is_an_emergency() {
    let run = |emergency_brake| {
        let settings = Settings { emergency_brake, duration_s: 2.0, ..settings() };
        record(&settings, ("straight-line", ""), CallBudget::default()).metrics
    };
    let (without, with) = (run(false), run(true));
    assert_eq!(without.emergency_brakes, 0);
    assert!(with.emergency_brakes > 0 && with.emergency_brakes <= with.brakes, "{with:?}");
}

#[test]
fn the_first_error_is_told() {
    let settings = Settings { play: PlayKind::Attack, ..settings() };
    let Record { metrics, first_error, .. } = record(&settings, ("theta-star", "cells = 1"), CallBudget::default());
    assert_eq!((metrics.calls, metrics.brakes, metrics.errors), (ALL, 0, ALL));
    let told = first_error.unwrap();
    assert!(told.starts_with("robot 0: cells = 1: the grid is coarser than the gaps: start"), "{told}");
}
