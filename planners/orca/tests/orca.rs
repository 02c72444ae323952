//! ORCA in closed loop.

mod closed_loop;

use closed_loop::{circle_swap, contract, crossing};
use env_model::motion::{Trajectory, bang_bang};
use planner_api::{ControlError, Controller, Outcome, Run, Situation};
use planner_orca::{Orca, OrcaSettings};

fn orca() -> Box<dyn Controller> {
    Box::new(Orca::new(OrcaSettings::default()).unwrap())
}

/// Straight to the goal, whoever is in the way.
struct Blind;

impl Controller for Blind {
    fn control(
        &mut self,
        situation: &Situation<'_>,
        _: &mut Run<'_>,
        trajectory: &mut Trajectory,
    ) -> Result<Outcome, ControlError> {
        bang_bang(situation.state, situation.goal, situation.limits, trajectory);
        Ok(Outcome::Arrives)
    }
}

#[test]
fn eight_robots_change_places_without_touching() {
    let blind = || -> Box<dyn Controller> { Box::new(Blind) };
    for (seed, jitter) in [(1, 0.0), (2, 0.001), (3, 0.05), (4, 0.3)] {
        let outcome = circle_swap(&orca, 8, 2.0, jitter, seed);
        assert!(outcome.arrived && outcome.collisions == 0, "{seed}: {outcome:?}");
        assert_eq!(outcome, circle_swap(&orca, 8, 2.0, jitter, seed), "the same seed, the same bits");
        assert!(circle_swap(&blind, 8, 2.0, jitter, seed).collisions > 0, "the scene is no test");
    }
}

#[test]
fn passes_opponents_that_give_no_way() {
    for seed in 0..5 {
        let outcome = crossing(&orca, 8, seed);
        assert!(outcome.arrived && outcome.collisions == 0, "{seed}: {outcome:?}");
    }
}

#[test]
fn keeps_the_contract() {
    contract::keeps_limits_repeats_and_allocates_nothing(&orca);
    contract::survives_hostile_input(&orca);
}

#[test]
#[ignore = "a measurement: cargo test --release -- --ignored --nocapture"]
fn measure() {
    contract::measure(&orca);
}
