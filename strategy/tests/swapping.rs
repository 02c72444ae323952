//! Any planner may take over from any other between two frames.

use std::collections::BTreeSet;

use planner_catalogue::controller_names;
use strategy::{CallBudget, Cooperation, PlayKind, Settings, Simulation, simulate};

/// A cyclic sequence of numbers below `k` in which every ordered pair of them are neighbours once: the Lyndon words of
/// length one and two in their order (de Bruijn 1946; Fredricksen & Maiorana 1978).
fn every_pair(k: usize) -> Vec<usize> {
    (0..k).flat_map(|i| std::iter::once(i).chain((i + 1..k).flat_map(move |j| [i, j]))).collect()
}

#[test]
fn every_planner_takes_over_from_every_other() {
    let names = controller_names();
    let order = every_pair(names.len());
    let pairs: BTreeSet<(usize, usize)> =
        order.iter().zip(order.iter().cycle().skip(1)).map(|(a, b)| (*a, *b)).collect();
    assert_eq!(pairs.len(), names.len() * names.len(), "the sequence has every pair");
    // Up and down the field until the sequence is over; one frame more closes the circle.
    let settings = Settings {
        play: PlayKind::Crossing,
        robots: 2,
        opponents: 3,
        duration_s: 60.0,
        cooperation: Cooperation::Priority,
        emergency_brake: true,
        ..Settings::default()
    };
    let budget = CallBudget { iterations: Some(20), evaluations: Some(400), time: None };
    let mut simulation = Simulation::new(&settings, ("straight-line", ""), budget, 1).unwrap();
    let period = settings.period();
    for kind in order.iter().chain(&order[..1]) {
        let kind = names[*kind];
        simulation.swap(kind, "").unwrap();
        let before: Vec<_> = simulation.bodies().iter().map(|body| body.state).collect();
        simulation.step(&|| 0.0).unwrap();
        for (robot, (body, before)) in simulation.bodies().iter().zip(&before).take(2).enumerate() {
            let change = (body.state.velocity - before.velocity).norm();
            // Motion goes on within the limits, whoever plans: rounding apart.
            assert!(change <= 3.0 * period * (1.0 + 1e-9), "{kind}: robot {robot} jerks by {change} m/s");
            assert!(body.state.velocity.norm() <= 3.0 * (1.0 + 1e-9), "{kind}: robot {robot} is too fast");
            let way = (body.state.position - before.position).norm();
            assert!(way <= 3.0 * period * (1.0 + 1e-9), "{kind}: robot {robot} jumps by {way} m");
        }
    }
    let record = simulation.record();
    assert_eq!(record.metrics.violations, 0, "nobody left the field: {:?}", record.metrics);
    let mates = record.trace.events.iter().filter(|e| e.bodies[1] < 2).count();
    assert_eq!(mates, 0, "mates do not touch: {:?}", record.trace.events);
}

#[test]
fn a_team_that_brakes_in_time_never_collides_whoever_plans() {
    let settings = Settings {
        robots: 4,
        duration_s: 2.0,
        cooperation: Cooperation::Priority,
        emergency_brake: true,
        ..Settings::default()
    };
    let budget = CallBudget { iterations: Some(20), evaluations: Some(400), time: None };
    for kind in controller_names() {
        let metrics = simulate(&settings, (kind, ""), budget, 1, &|| 0.0).unwrap().metrics;
        assert_eq!((metrics.collisions, metrics.violations), (0, 0), "{kind}: {metrics:?}");
    }
}
