//! ORCA in closed loop.

mod closed_loop;

use closed_loop::{circle_swap, crossing, shares};
use planner_api::Controller;
use planner_orca::{Orca, OrcaSettings};

fn orca() -> Box<dyn Controller> {
    Box::new(Orca::new(OrcaSettings::default()).unwrap())
}

#[test]
#[ignore = "a measurement: cargo test --release -- --ignored --nocapture"]
fn measure() {
    for (radius, jitter) in [(2.0, 0.0), (2.0, 0.05), (2.5, 0.1), (3.0, 0.1), (3.0, 0.3)] {
        let result = shares(100, |seed| circle_swap(&orca, 8, radius, jitter, seed));
        println!("circle of {radius} m, jitter {jitter}: free, arrived, time {result:.3?}");
    }
    for count in [4, 8, 12] {
        println!("{count} crossing: {:.3?}", shares(200, |seed| crossing(&orca, count, seed)));
    }
}
