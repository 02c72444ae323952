//! The potential field among obstacles that move in closed loop.

#[path = "../../orca/tests/closed_loop/mod.rs"]
mod closed_loop;

use closed_loop::{contract, crossing};
use planner_api::Controller;
use planner_potential_field::{MovingPotentialField, MovingPotentialFieldSettings};

fn controller() -> Box<dyn Controller> {
    Box::new(MovingPotentialField::new(MovingPotentialFieldSettings::default()).unwrap())
}

#[test]
fn passes_opponents_that_give_no_way() {
    for seed in 0..3 {
        let outcome = crossing(&controller, 4, seed);
        assert!(outcome.arrived && outcome.collisions == 0, "{seed}: {outcome:?}");
        assert_eq!(outcome, crossing(&controller, 4, seed), "the same seed, the same bits");
    }
}

#[test]
fn keeps_the_contract() {
    contract::keeps_limits_repeats_and_allocates_nothing(&controller);
    contract::survives_hostile_input(&controller);
}

#[test]
#[ignore = "a measurement: cargo test --release -- --ignored --nocapture"]
fn measure() {
    contract::measure(&controller);
}
