//! Eight robots change places on a circle.

#[path = "../../sampled-bang-bang/tests/team/mod.rs"]
mod team;

use planner_api::Controller;
use planner_space_time::{Sipp, SippSettings};
use team::{Knowledge, circle, drive, limits, quantile};

fn controllers(n: usize) -> Vec<Box<dyn Controller>> {
    let new = || Sipp::new(SippSettings::default()).unwrap();
    (0..n).map(|_| Box::new(new()) as Box<dyn Controller>).collect()
}

#[test]
fn a_team_swaps_places_without_collision() {
    for seed in 0..3 {
        let outcome = drive(&mut controllers(8), &circle(8, seed), Knowledge::Team, seed, 20.0, |i, _, answer| {
            let peaks = answer.peaks();
            // The contract's tolerance.
            assert!(peaks.speed <= limits().speed * (1.0 + 1e-9), "robot {i}: {peaks:?}");
            assert!(peaks.acceleration <= limits().acceleration * (1.0 + 1e-9), "robot {i}: {peaks:?}");
        });
        assert!(outcome.arrived && outcome.collisions == 0, "seed {seed}: {} s", outcome.seconds);
    }
}

/// The figures of a hundred seeds; run in release with `--ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn a_hundred_seeds() {
    for (name, knowledge) in [("team", Knowledge::Team), ("independent", Knowledge::Independent)] {
        let outcomes: Vec<_> = (0..20)
            .map(|seed| drive(&mut controllers(8), &circle(8, seed), knowledge, seed, 20.0, |_, _, _| {}))
            .collect();
        let count = |f: &dyn Fn(&team::Outcome) -> bool| outcomes.iter().filter(|o| f(o)).count();
        let mut seconds: Vec<f64> = outcomes.iter().map(|o| o.seconds).collect();
        let mut calls: Vec<f64> = outcomes.iter().flat_map(|o| o.microseconds.iter().copied()).collect();
        println!(
            "{name}: arrived {}, without collision {}, both {}; seconds {:.2} median {:.2} p95; call {:.1} µs p50 {:.1} p99 {:.1} max",
            count(&|o| o.arrived),
            count(&|o| o.collisions == 0),
            count(&|o| o.arrived && o.collisions == 0),
            quantile(&mut seconds, 0.5),
            quantile(&mut seconds, 0.95),
            quantile(&mut calls, 0.5),
            quantile(&mut calls, 0.99),
            quantile(&mut calls, 1.0),
        );
    }
}
