//! The referee against plain sampling of what bodies did, and bodies against their limits.

use env_model::motion::Limits;
use strategy::league::ROBOT_RADIUS;
use strategy::{CallBudget, Cooperation, Metrics, PlayKind, Settings, Simulation};

const SAMPLES: u32 = 50;

/// Steps through a simulation and looks at every pair fifty times a frame. Returns what the referee says, and the
/// least clearance and number of collisions that sampling sees.
fn watched(settings: &Settings, planner: &str, seed: u64) -> (Metrics, f64, u32) {
    let mut simulation = Simulation::new(settings, (planner, ""), CallBudget::default(), seed).unwrap();
    let period = settings.period();
    let limits = Limits::new(settings.speed, settings.acceleration).unwrap();
    let (mut least, mut collisions) = (f64::INFINITY, 0);
    let n = settings.robots;
    let mut touching = vec![false; n * (n + settings.opponents)];
    while !simulation.is_over() {
        let before: Vec<_> = simulation.bodies().iter().map(|b| b.state).collect();
        simulation.step(&|| 0.0).unwrap();
        let bodies = simulation.bodies();
        for (body, before) in bodies[..n].iter().zip(&before) {
            // Rounding of positions of metres, and of their sums.
            assert!((body.motion.start().position - before.position).norm() < 1e-12, "motion has no gaps");
            assert!((body.motion.start().velocity - before.velocity).norm() < 1e-12, "velocity has no jumps");
            let peaks = body.motion.peaks();
            assert!(peaks.speed <= limits.speed * (1.0 + 1e-9), "{planner}: {peaks:?}");
            assert!(peaks.acceleration <= limits.acceleration * (1.0 + 1e-9), "{planner}: {peaks:?}");
        }
        for a in 0..n {
            for b in a + 1..bodies.len() {
                let apart = |k: u32| {
                    let t = period * f64::from(k) / f64::from(SAMPLES);
                    let [p, q] = [a, b].map(|i| bodies[i].motion.state(t).position);
                    (p - q).norm() - 2.0 * ROBOT_RADIUS
                };
                let nearest = (0..=SAMPLES).map(apart).fold(f64::INFINITY, f64::min);
                least = least.min(nearest);
                let was = std::mem::replace(&mut touching[a * bodies.len() + b], nearest < 0.0);
                collisions += u32::from(nearest < 0.0 && !was);
            }
        }
    }
    (simulation.record().metrics, least, collisions)
}

#[test]
fn the_referee_sees_what_sampling_sees() {
    let exact = Settings { robots: 6, opponents: 2, duration_s: 6.0, ..Settings::default() };
    let noisy = Settings {
        position_noise: 0.004,
        velocity_noise: 0.05,
        actuation_noise: 0.03,
        latency_ms: 40.0,
        play: PlayKind::Crossing,
        opponents: 6,
        ..exact.clone()
    };
    let mut seen = 0;
    for (settings, seeds) in [(&exact, 0..4), (&noisy, 4..8)] {
        for seed in seeds {
            for planner in ["straight-line", "tangent"] {
                let (metrics, least, collisions) = watched(settings, planner, seed);
                let exact = metrics.least_clearance.unwrap();
                // Between two samples a pair nears by 6 m/s for a six-thousandth of a second at most.
                assert!(exact <= least + 1e-12 && exact > least - 6.0 / 60.0 / f64::from(SAMPLES), "{exact} {least}");
                // A contact of less than a sample may be missed by sampling.
                assert!(metrics.collisions >= collisions && metrics.collisions <= collisions + 1, "{planner} {seed}");
                seen += collisions;
            }
        }
    }
    assert!(seen > 20, "straight lines through the middle collide: {seen}");
}

#[test]
fn cooperation_by_priority_keeps_a_braking_team_apart() {
    for seed in 0..6 {
        let settings = Settings {
            robots: 6,
            duration_s: 8.0,
            cooperation: Cooperation::Priority,
            emergency_brake: true,
            ..Settings::default()
        };
        let (metrics, ..) = watched(&settings, "tangent", seed);
        assert_eq!(metrics.collisions, 0, "seed {seed}: everybody can always stop: {metrics:?}");
    }
}
