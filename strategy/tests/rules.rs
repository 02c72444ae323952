//! Rules in closed loop.

use env_model::Point;
use strategy::rules::{Command, STOP_SPEED};
use strategy::{CallBudget, PlayKind, Settings, Simulation};

fn under(command: Command, play: PlayKind) -> Simulation {
    let settings = Settings { command: Some(command), play, robots: 4, opponents: 2, ..Settings::default() };
    Simulation::new(&settings, ("tangent", ""), CallBudget::default(), 7).unwrap()
}

#[test]
fn in_stop_robots_are_slow_and_away_from_the_ball() {
    let mut simulation = under(Command::Stop, PlayKind::CircleSwap);
    while !simulation.is_over() {
        simulation.step(&|| 0.0).unwrap();
        for body in &simulation.bodies()[..4] {
            assert!(body.state.velocity.norm() < STOP_SPEED, "{}", body.state.velocity.norm());
            let ball = (body.state.position - Point::origin()).norm();
            // Half a metre to the robot's hull. Ways timed from a moving start may bow off the path by
            // millimetres, and the guard leads out again; without the rule all would meet at the ball.
            assert!(ball > 0.59 - 0.01, "{ball}");
        }
    }
    let metrics = simulation.record().metrics;
    assert_eq!(metrics.arrived, 4, "{metrics:?}");
}

#[test]
fn in_play_they_are_fast() {
    let mut simulation = under(Command::Running, PlayKind::CircleSwap);
    let mut fastest = 0.0_f64;
    for _ in 0..120 {
        simulation.step(&|| 0.0).unwrap();
        fastest = simulation.bodies()[..4].iter().map(|body| body.state.velocity.norm()).fold(fastest, f64::max);
    }
    assert!(fastest > STOP_SPEED, "{fastest}");
}

#[test]
fn halted_robots_stand() {
    let mut simulation = under(Command::Halt, PlayKind::Positions);
    let before: Vec<Point> = simulation.bodies()[..4].iter().map(|body| body.state.position).collect();
    for _ in 0..60 {
        simulation.step(&|| 0.0).unwrap();
    }
    let after: Vec<Point> = simulation.bodies()[..4].iter().map(|body| body.state.position).collect();
    assert_eq!(before, after);
}

#[test]
fn a_defence_area_is_passed_round() {
    // Without rules robots cut through the areas, with them they do not.
    let violations = |command| {
        let settings = Settings {
            command: Some(command),
            play: PlayKind::Positions,
            robots: 6,
            waves: 4,
            wave_s: 8.0,
            duration_s: 40.0,
            ..Settings::default()
        };
        let mut simulation = Simulation::new(&settings, ("tangent", ""), CallBudget::default(), 3).unwrap();
        let (mut inside, mut n) = (0, 0);
        while !simulation.is_over() {
            simulation.step(&|| 0.0).unwrap();
            for body in &simulation.bodies()[..6] {
                let p = body.state.position;
                // By 1 mm at least.
                inside += usize::from(p.x.abs() > 4.2 - 0.089 && p.y.abs() < 1.8);
                n += 1;
            }
        }
        assert!(n > 0);
        (inside, simulation.record().metrics.violations)
    };
    assert_eq!(violations(Command::Running), (0, 0));
    assert!(violations(Command::Off).0 > 0);
}

#[test]
fn commands_are_spelt_as_the_referee_does() {
    let of = |command: &str| toml::from_str::<Settings>(&format!("command = {command:?}")).map(|s| s.command());
    assert_eq!(of("stop").unwrap(), Command::Stop);
    assert_eq!(of("force-start").unwrap(), Command::Running);
    assert_eq!(of("ball-placement-own").unwrap(), Command::BallPlacementOwn);
    assert!(of("stopp").is_err());
    let placement = Settings { play: PlayKind::BallPlacement, ..Settings::default() };
    assert_eq!(placement.command(), Command::BallPlacementOwn);
    assert_eq!(Settings::default().command(), Command::Running);
}
