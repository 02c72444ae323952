//! A strategy layer of one's own in a hundred lines, on the catalogue crate alone: three robots run across the field
//! among opponents, sixty frames a second, and change their planner by name between two frames.
//!
//!     cargo run --release -p planner-catalogue --example strategy [FIRST [SECOND]]

use planner_catalogue::api::{Budget, Run, Situation};
use planner_catalogue::build_controller_str;
use planner_catalogue::control::{Answer, Guard};
use planner_catalogue::env_model::motion::{Limits, Mover, Path, Side, State, Trajectory, brake, least_time};
use planner_catalogue::env_model::{Point, Scene, Vector, World};

const RADIUS: f64 = 0.09;
const PERIOD: f64 = 1.0 / 60.0;
const HORIZON: f64 = 2.0;

struct Robot {
    state: State,
    goal: Point,
    guard: Guard,
    answer: Answer,
}

/// A controller by name, its settings as TOML. The guard answers whatever the controller does: it escapes, adapts the
/// goal, or brakes.
fn by_name(kind: &str) -> Result<Guard, Box<dyn std::error::Error>> {
    let settings = if kind == "pso-qp" { "iterations = 40" } else { "" };
    Ok(Guard::new(build_controller_str(kind, settings)?.controller).with_emergency_brake(true))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1);
    let first = args.next().unwrap_or_else(|| "tangent".into());
    let second = args.next().unwrap_or_else(|| "pso-qp".into());

    // What stands still: the field, and our defence area, which field players keep out of.
    let world = World::new(&Scene::from_toml(
        "pitch",
        r#"
        name = "pitch"
        robot_radius = 0.09
        start = [-3.0, 0.0]
        goal = [3.0, 0.0]
        field = { min = [-4.8, -3.3], max = [4.8, 3.3] }
        obstacle = [{ polygon = [[-4.8, -1.0], [-3.5, -1.0], [-3.5, 1.0], [-4.8, 1.0]], label = "defence area" }]
        "#,
    )?)?;
    let limits = Limits::new(3.0, 3.0)?;
    let mut robots = Vec::new();
    for y in [-1.5, 0.0, 1.5] {
        let (state, goal) = (State::at_rest(Point::new(-3.0, y)), Point::new(3.0, -y));
        println!("robot {}: {:.2} s at best", robots.len(), least_time(state, goal, limits));
        robots.push(Robot { state, goal, guard: by_name(&first)?, answer: Answer::default() });
    }
    let opponents: Vec<State> = (0..6)
        .map(|i| State {
            position: Point::new(f64::from(i) * 0.8 - 2.0, if i % 2 == 0 { -2.0 } else { 2.0 }),
            velocity: Vector::new(0.0, if i % 2 == 0 { 0.8 } else { -0.8 }),
        })
        .collect();

    for frame in 0..300_u32 {
        let time = f64::from(frame) * PERIOD;
        if frame == 60 {
            println!("{time:.2} s: {first} → {second}");
            for robot in &mut robots {
                robot.guard = by_name(&second)?;
            }
        }
        // All plan from one moment: mates before them move as they have just said, those after them are taken to brake, and
        // opponents to go on.
        let mut ways = vec![Trajectory::default(); robots.len()];
        robots.iter().zip(&mut ways).for_each(|(robot, way)| brake(robot.state, limits, way));
        for i in 0..robots.len() {
            let mates = robots.iter().zip(&ways).enumerate().filter(|(j, _)| *j != i);
            let mates = mates.map(|(_, (mate, way))| {
                Mover::disc(mate.state.position, 2.0 * RADIUS, Path::Trajectory(way), Side::Mate)
            });
            let others = opponents.iter().map(|o| {
                let at = o.position + o.velocity * time;
                Mover::disc(at, 2.0 * RADIUS, Path::Velocity(o.velocity), Side::Opponent)
            });
            let movers: Vec<Mover> = mates.chain(others).map(|m| m.with_margin(0.03)).collect();
            let Robot { state, goal, guard, answer } = &mut robots[i];
            let situation = Situation::new(&world, &movers, *state, *goal, limits, HORIZON, PERIOD)?;
            let budget = Budget { iterations: Some(400), ..Budget::default() };
            let seed = u64::from(frame) << 8 | i as u64;
            guard.answer(&situation, &mut Run::new(seed).with_budget(budget), answer)?;
            ways[i].copy_from(&answer.trajectory);
        }
        robots.iter_mut().for_each(|robot| robot.state = robot.answer.trajectory.state(PERIOD));
        if frame % 30 == 0 {
            let words = robots.iter().map(|r| {
                let Point { coords: p } = r.state.position;
                format!("({:5.2}, {:5.2}) {:7}", p.x, p.y, r.answer.safety.name())
            });
            println!("{time:.2} s: {}", words.collect::<Vec<_>>().join("  "));
        }
    }
    Ok(())
}
