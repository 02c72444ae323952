//! What a situation refuses.

use env_model::motion::{Limits, MotionError, Mover, Path, Side, State};
use env_model::{Obstacle, Point, Scene, Vector, World};
use planner_api::{ControlError, Situation};

fn world() -> World {
    World::new(&Scene {
        name: "field".into(),
        unit: "m".into(),
        robot_radius: 0.09,
        start: [0.0, 0.0],
        goal: [6.0, 4.0],
        field: None,
        obstacles: vec![Obstacle::disc(Point::new(3.0, 2.0), 0.5)],
    })
    .unwrap()
}

fn refusal(state: State, goal: Point, movers: &[Mover<'_>], horizon: f64, period: f64) -> Option<String> {
    let limits = Limits::new(3.0, 3.0).unwrap();
    Situation::new(&world(), movers, state, goal, limits, horizon, period).err().map(|error| error.to_string())
}

#[test]
fn unusable_numbers_are_named() {
    let (state, goal) = (State::at_rest(Point::new(1.0, 1.0)), Point::new(5.0, 4.0));
    assert_eq!(refusal(state, goal, &[], 2.0, 0.016), None);
    // Where the robot stands, and what it may touch, is for others to judge.
    assert_eq!(refusal(State::at_rest(Point::new(3.0, 2.0)), Point::new(99.0, 0.0), &[], 2.0, 0.016), None);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let says = |what: &str, refusal: Option<String>| {
            assert!(refusal.as_ref().is_some_and(|r| r.contains(what)), "{bad} {what}: {refusal:?}");
        };
        says("position", refusal(State::at_rest(Point::new(bad, 1.0)), goal, &[], 2.0, 0.016));
        says("velocity", refusal(State { velocity: Vector::new(0.0, bad), ..state }, goal, &[], 2.0, 0.016));
        says("goal", refusal(state, Point::new(1.0, bad), &[], 2.0, 0.016));
        says("prediction horizon", refusal(state, goal, &[], bad, 0.016));
        says("period", refusal(state, goal, &[], 2.0, bad));
        let still = Path::Velocity(Vector::zeros());
        let fine = Mover::disc(Point::origin(), 0.18, still, Side::Opponent);
        let lost = Mover::disc(Point::new(bad, 0.0), 0.18, still, Side::Opponent);
        says("mover 1: ", refusal(state, goal, &[fine, lost], 2.0, 0.016));
    }
    for bad in [0.0, -1.0] {
        assert!(refusal(state, goal, &[], bad, 0.016).is_some_and(|r| r.contains("prediction horizon")));
        assert!(refusal(state, goal, &[], 2.0, bad).is_some_and(|r| r.contains("period")));
    }
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let [mut slow, mut weak] = [Limits::new(3.0, 3.0).unwrap(); 2];
        (slow.speed, weak.acceleration) = (bad, bad);
        for (limits, what) in [(slow, "speed limit"), (weak, "acceleration limit")] {
            let refused = Situation::new(&world(), &[], state, goal, limits, 2.0, 0.016).err().map(|e| e.to_string());
            assert!(refused.as_ref().is_some_and(|r| r.contains(what)), "{bad}: {refused:?}");
        }
    }
    let flat = [Mover::disc(Point::origin(), 0.0, Path::Velocity(Vector::zeros()), Side::Other)];
    let world = world();
    let refused = Situation::new(&world, &flat, state, goal, Limits::new(3.0, 3.0).unwrap(), 2.0, 0.016);
    assert!(matches!(
        refused,
        Err(ControlError::Mover { index: 0, error: MotionError::NotPositive { what: "radius", value: 0.0 } })
    ));
}

#[test]
fn two_robots_at_one_spot_are_a_situation() {
    let state = State::at_rest(Point::new(1.0, 1.0));
    let same = [Mover::disc(state.position, 0.18, Path::Velocity(Vector::zeros()), Side::Mate)];
    assert_eq!(refusal(state, Point::new(5.0, 4.0), &same, 2.0, 0.016), None);
}
