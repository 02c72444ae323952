//! One crossing in closed loop: the team steers by its behaviours, step by step.

use env_model::{Point, Vector};

use crate::formation::oriented;
use crate::parameters::Parameters;
use crate::protocol::Protocol;
use crate::scenario::Scenario;
use crate::steering::Steering;

/// A robot of the team, and what has happened to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Robot {
    /// Where it is, in metres.
    pub position: Point,
    /// Metres per second.
    pub velocity: Vector,
    /// Length of its way, in metres.
    pub travelled: f64,
    /// Steps that it was under way.
    pub steps: usize,
    /// Sum over these of the greatest danger, clip((S − d)/(S − M), 0, 1) with d the clearance of the nearest thing.
    pub danger: f64,
    /// Sum over these of the distance to its slot, in spacings, at most 1 each.
    pub astray: f64,
    /// Whether it stands at its goal.
    pub arrived: bool,
    /// Whether it ran into anything, or anything into it, before it arrived.
    pub collided: bool,
}

/// The buffers of episodes.
#[derive(Debug, Clone, Default)]
pub struct Episode {
    robots: Vec<Robot>,
    opponents: Vec<(Point, Vector)>,
    /// Which robots are so near to something that this step may collide.
    near: Vec<bool>,
}

impl Episode {
    /// Plays `scenario` to its end: all have arrived, or the time is up. O(steps · robots · (robots + opponents +
    /// obstacles)).
    pub fn play(&mut self, protocol: &Protocol, scenario: &Scenario, parameters: &Parameters) -> &[Robot] {
        self.robots.clear();
        self.robots.extend(scenario.starts.iter().map(|start| Robot {
            position: *start,
            velocity: Vector::zeros(),
            travelled: 0.0,
            steps: 0,
            danger: 0.0,
            astray: 0.0,
            arrived: false,
            collided: false,
        }));
        self.opponents.clone_from(&scenario.opponents);
        self.near.resize(self.robots.len(), false);
        let mut heading = scenario.heading;
        for step in 0..protocol.steps {
            if self.robots.iter().all(|r| r.arrived) {
                break;
            }
            self.bounce(protocol);
            let centre = self.robots.iter().map(|r| r.position.coords).sum::<Vector>() / self.robots.len() as f64;
            let ahead = scenario.goal.coords - centre;
            // Near the goal the direction to it says nothing any more.
            if ahead.norm() > protocol.spacing {
                heading = ahead.normalize();
            }
            let hold = usize::try_from(parameters.noise_steps).map_or(0, |steps| step / steps);
            for i in 0..self.robots.len() {
                if !self.robots[i].arrived {
                    let slot = Point::from(centre + oriented(scenario.slots[i], heading));
                    let noise = scenario.noise[hold * self.robots.len() + i];
                    self.steer(i, protocol, scenario, parameters, slot, noise);
                }
            }
            self.collide(protocol, scenario);
            self.advance(protocol, scenario);
        }
        &self.robots
    }

    /// Turns opponents that would leave the field.
    fn bounce(&mut self, protocol: &Protocol) {
        for (position, velocity) in &mut self.opponents {
            for axis in 0..2 {
                let next = position[axis] + velocity[axis] * protocol.step_s;
                if next.abs() > 0.5 * protocol.field[axis] && next * velocity[axis] > 0.0 {
                    velocity[axis] = -velocity[axis];
                }
            }
        }
    }

    /// Sets the velocity of robot `i` for this step.
    fn steer(
        &mut self,
        i: usize,
        protocol: &Protocol,
        scenario: &Scenario,
        parameters: &Parameters,
        slot: Point,
        noise: Vector,
    ) {
        let Robot { position, velocity, .. } = self.robots[i];
        let mut steering = Steering::new(parameters, scenario.goals[i] - position);
        steering.slot(slot - position);
        steering.noise(noise);
        // Farther apart two robots cannot meet within the step.
        let approach = (protocol.speed + protocol.speed.max(protocol.opponent_speed)) * protocol.step_s;
        let seen = approach.max(protocol.danger_sphere);
        let mut clearest = f64::INFINITY;
        let mut sees = |centre: Point, radii: f64, sphere: f64| {
            let away = position - centre;
            let squared = away.norm_squared();
            let reach = radii + sphere.max(seen);
            (squared < reach * reach).then(|| {
                let distance = squared.sqrt();
                clearest = clearest.min(distance - radii);
                let away = if distance > 0.0 { away / distance } else { Vector::x() };
                (distance - radii, away)
            })
        };
        for (centre, radius) in &scenario.obstacles {
            if let Some((clearance, away)) = sees(*centre, radius + protocol.robot_radius, parameters.obstacle_sphere) {
                steering.obstacle(clearance, away);
            }
        }
        let mates = self.robots.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, mate)| mate.position);
        for centre in mates.chain(self.opponents.iter().map(|(p, _)| *p)) {
            if let Some((clearance, away)) = sees(centre, 2.0 * protocol.robot_radius, parameters.robot_sphere) {
                steering.robot(clearance, away);
            }
        }
        let wished = steering.sum() * protocol.speed;
        let robot = &mut self.robots[i];
        robot.velocity = match protocol.acceleration {
            None => wished,
            Some(limit) => {
                let (change, most) = (wished - velocity, limit * protocol.step_s);
                velocity + if change.norm() > most { change * (most / change.norm()) } else { change }
            }
        };
        let (s, m) = (protocol.danger_sphere, protocol.danger_margin);
        robot.danger += ((s - clearest) / (s - m)).clamp(0.0, 1.0);
        robot.astray += ((slot - position).norm() / protocol.spacing).min(1.0);
        self.near[i] = clearest <= approach;
    }

    /// Finds who touches what in this step. Within it all motion is linear, so the closest approach is exact.
    fn collide(&mut self, protocol: &Protocol, scenario: &Scenario) {
        let (own, dt) = (protocol.robot_radius, protocol.step_s);
        for i in 0..self.robots.len() {
            let Robot { position, velocity, arrived, collided, .. } = self.robots[i];
            if arrived || collided || !self.near[i] {
                continue;
            }
            let touches =
                |p: Point, v: Vector, radii: f64| closest_squared(position - p, velocity - v, dt) < radii * radii;
            let still = Vector::zeros();
            let mates = self.robots.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, r)| (r.position, r.velocity));
            self.robots[i].collided = scenario.obstacles.iter().any(|(c, r)| touches(*c, still, r + own))
                || mates.chain(self.opponents.iter().copied()).any(|(p, v)| touches(p, v, 2.0 * own));
        }
    }

    fn advance(&mut self, protocol: &Protocol, scenario: &Scenario) {
        for (robot, goal) in self.robots.iter_mut().zip(&scenario.goals) {
            if !robot.arrived {
                let step = robot.velocity * protocol.step_s;
                robot.position += step;
                robot.travelled += step.norm();
                robot.steps += 1;
                if (goal - robot.position).norm() <= protocol.arrival {
                    robot.arrived = true;
                    robot.velocity = Vector::zeros();
                }
            }
        }
        for (position, velocity) in &mut self.opponents {
            *position += *velocity * protocol.step_s;
        }
    }
}

/// The least ‖p + vt‖² for 0 ≤ t ≤ `duration`.
fn closest_squared(p: Vector, v: Vector, duration: f64) -> f64 {
    let (along, speed) = (-p.dot(&v), v.norm_squared());
    // Where it only goes away, or stands, it is nearest now.
    let t = if along > 0.0 { (along / speed).min(duration) } else { 0.0 };
    (p + v * t).norm_squared()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closest_approach_by_hand() {
        let p = Vector::new(-3.0, 1.0);
        assert_eq!(closest_squared(p, Vector::new(1.0, 0.0), 5.0), 1.0, "passes at 1");
        assert_eq!(closest_squared(p, Vector::new(1.0, 0.0), 2.0), 2.0, "ends at (−1, 1)");
        assert_eq!(closest_squared(p, Vector::new(-1.0, 0.0), 2.0), 10.0, "goes away");
        assert_eq!(closest_squared(p, Vector::zeros(), 2.0), 10.0);
    }

    /// One robot from the origin to (4, 0), nothing else, no noise.
    fn alone() -> (Protocol, Scenario, Parameters) {
        let protocol = Protocol { robots: 1, opponents: 0, obstacles: 0, ..Protocol::default() };
        let scenario = Scenario {
            starts: vec![Point::origin()],
            goals: vec![Point::new(4.0, 0.0)],
            slots: vec![Vector::zeros()],
            goal: Point::new(4.0, 0.0),
            heading: Vector::x(),
            noise: vec![Vector::y(); protocol.steps],
            ..Scenario::default()
        };
        (protocol, scenario, Parameters { noise_gain: 0.0, ..Parameters::default() })
    }

    #[test]
    fn a_free_robot_goes_straight() {
        let (protocol, scenario, parameters) = alone();
        let robot = Episode::default().play(&protocol, &scenario, &parameters)[0];
        // 0.8 of 2 m/s, 0.08 m a step: 49 steps make 3.92 m, the first distance within 0.1 m.
        assert!(robot.arrived && !robot.collided && robot.steps == 49, "{robot:?}");
        assert!((robot.travelled - 3.92).abs() < 1e-12 && robot.danger == 0.0 && robot.astray < 1e-12, "49 additions");
    }

    #[test]
    fn acceleration_is_limited_where_asked() {
        let (protocol, scenario, parameters) = alone();
        let protocol = Protocol { acceleration: Some(2.0), steps: 4, ..protocol };
        let robot = Episode::default().play(&protocol, &scenario, &parameters)[0];
        // 0.1, 0.2, 0.3, 0.4 m/s for 0.05 s each.
        assert!((robot.travelled - 0.05).abs() < 1e-12 && (robot.velocity.x - 0.4).abs() < 1e-12);
    }

    #[test]
    fn a_fast_opponent_is_not_tunnelled_through() {
        let (protocol, mut scenario, parameters) = alone();
        // 10 m/s, 0.5 m a step: at no step's ends nearer than 0.18 m to a robot that stands at the origin.
        scenario.opponents = vec![(Point::new(0.25, 0.0), Vector::new(-10.0, 0.0))];
        let still = Parameters { goal_gain: 0.0, robot_gain: 0.0, formation_gain: 0.0, ..parameters };
        let protocol = Protocol { steps: 1, opponent_speed: 10.0, ..protocol };
        assert!(Episode::default().play(&protocol, &scenario, &still)[0].collided);
        scenario.opponents[0].0.y = 0.19;
        assert!(!Episode::default().play(&protocol, &scenario, &still)[0].collided, "passes beside");
    }

    #[test]
    fn danger_is_that_of_the_nearest() {
        let (protocol, mut scenario, parameters) = alone();
        // Hull to hull 0.11 m and 0.17 m: (0.2 − 0.11)/0.15 = 0.6.
        scenario.opponents = vec![(Point::new(0.0, 0.29), Vector::zeros()), (Point::new(0.0, -0.35), Vector::zeros())];
        let still = Parameters { goal_gain: 0.0, robot_gain: 0.0, ..parameters };
        let protocol = Protocol { steps: 5, ..protocol };
        let robot = Episode::default().play(&protocol, &scenario, &still)[0];
        assert!((robot.danger - 5.0 * 0.6).abs() < 1e-12, "{robot:?}");
    }
}
