//! Behaviour control of one robot, frame by frame.
//!
//! The behaviours' sum times full speed is the wished velocity. The robot turns its velocity into that one as fast as
//! its limits allow, holds it for one period, and brakes: more a reactive robot does not know. Near the goal it wishes
//! to be no faster than it can brake from; where nothing repels there it goes straight to the goal and stands.

use env_model::motion::{Mover, Side, Trajectory, bang_bang, change_velocity, slow_down, stop};
use env_model::{Aabb, Point, Vector};
use planner_api::{ControlError, Controller, Outcome, Run, SettingError, Situation};

use crate::formation::oriented;
use crate::noise::Noise;
use crate::settings::BehaviourSettings;
use crate::steering::Steering;

/// The controller of the thesis's chapter 5.
pub struct Behaviour {
    settings: BehaviourSettings,
    noise: Noise,
    formation: Pairing,
}

impl Behaviour {
    /// A robot with these settings.
    ///
    /// # Errors
    /// A setting out of its range.
    pub fn new(settings: BehaviourSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, noise: Noise::default(), formation: Pairing::default() })
    }

    /// The sum of the behaviours.
    fn steering(&mut self, situation: &Situation<'_>, seed: u64) -> Steering<'_> {
        let Self { settings, noise, formation } = self;
        let BehaviourSettings { parameters, formation: kind, spacing } = settings;
        let Situation { world, movers, goal, .. } = *situation;
        let here = situation.state.position;
        let mut steering = Steering::new(parameters, goal - here);
        steering.noise(noise.next(parameters.noise_steps, seed));
        let seen = Aabb { min: here, max: here }.inflated(parameters.obstacle_sphere);
        world.for_each_overlapping(&seen, |i| {
            let (clearance, away) = world.obstacles()[i].clearance_direction(here);
            steering.obstacle(clearance, away);
        });
        if let Some(field) = world.inner_field() {
            let (low, high) = (here - field.min, field.max - here);
            for (clearance, away) in
                [(low.x, Vector::x()), (low.y, Vector::y()), (high.x, -Vector::x()), (high.y, -Vector::y())]
            {
                steering.obstacle(clearance, away);
            }
        }
        for mover in movers {
            let (clearance, away) = mover.shape.clearance_direction(here);
            match mover.side {
                Side::Mate | Side::Opponent => steering.robot(clearance - mover.margin, away),
                Side::Other => steering.obstacle(clearance - mover.margin, away),
            }
        }
        let way = goal - here;
        // Nearer the goal is where to stand, and the direction to it no longer that of the team.
        if let Some(kind) = kind.filter(|_| way.norm() > *spacing) {
            formation.meet(here, movers);
            kind.slots(formation.team.len(), &mut formation.slots);
            steering.slot(formation.own_slot(way.normalize(), *spacing) - here);
        }
        steering
    }
}

impl Controller for Behaviour {
    fn control(
        &mut self,
        situation: &Situation<'_>,
        run: &mut Run<'_>,
        trajectory: &mut Trajectory,
    ) -> Result<Outcome, ControlError> {
        let Situation { state, goal, limits, period, .. } = *situation;
        let steering = self.steering(situation, run.seed);
        let left = (goal - state.position).norm();
        if steering.is_undisturbed() && left <= limits.braking_distance(limits.speed) {
            bang_bang(state, goal, limits, trajectory);
            return Ok(Outcome::Arrives);
        }
        let wished = steering.sum() * limits.speed;
        let (speed, most) = (wished.norm(), libm::sqrt(2.0 * limits.acceleration * left));
        let wished = if speed > most { wished * (most / speed) } else { wished };
        trajectory.begin(state);
        slow_down(trajectory, limits.speed, limits);
        change_velocity(trajectory, wished, limits);
        trajectory.push(period, Vector::zeros());
        stop(trajectory, limits);
        Ok(Outcome::Partial)
    }

    fn reset(&mut self) {
        self.noise = Noise::default();
    }
}

/// Who takes which slot: the source numbers its robots; here each finds its own from where all stand.
#[derive(Debug, Default)]
struct Pairing {
    /// The robot itself, then its mates.
    team: Vec<Point>,
    slots: Vec<Vector>,
}

impl Pairing {
    fn meet(&mut self, here: Point, movers: &[Mover<'_>]) {
        self.team.clear();
        self.team.push(here);
        let mates = movers.iter().filter(|m| m.side == Side::Mate);
        self.team.extend(mates.map(|m| m.shape.aabb().centre()));
    }

    /// The slot of the robot itself, round the centre of the team: time and again the nearest pair of a robot and a
    /// slot that are both left. Robots that head the same way come to the same pairs. O(n³).
    fn own_slot(&mut self, heading: Vector, spacing: f64) -> Point {
        let Self { team, slots } = self;
        let centre = team.iter().map(|p| p.coords).sum::<Vector>() / team.len() as f64;
        slots.iter_mut().for_each(|slot| *slot = centre + oriented(*slot, heading) * spacing);
        // The robot itself stays first.
        loop {
            let (mut best, mut nearest) = ((0, 0), f64::INFINITY);
            for (i, robot) in team.iter().enumerate() {
                for (j, slot) in slots.iter().enumerate() {
                    let d = (robot.coords - slot).norm_squared();
                    if d < nearest {
                        (best, nearest) = ((i, j), d);
                    }
                }
            }
            let (robot, slot) = best;
            if robot == 0 {
                return slots[slot].into();
            }
            team.remove(robot);
            slots.remove(slot);
        }
    }
}

#[cfg(test)]
mod tests {
    use env_model::motion::{Limits, Path, State};
    use env_model::{Scene, World};

    use super::*;
    use crate::{Formation, Parameters};

    fn world() -> World {
        World::new(&Scene {
            name: "open".into(),
            unit: "m".into(),
            robot_radius: 0.09,
            start: [0.0, 0.0],
            goal: [1.0, 0.0],
            field: None,
            obstacles: Vec::new(),
        })
        .unwrap()
    }

    fn behaviour(formation: Option<Formation>) -> Behaviour {
        let parameters = Parameters { noise_gain: 0.0, ..Parameters::default() };
        Behaviour::new(BehaviourSettings { parameters, formation, ..BehaviourSettings::default() }).unwrap()
    }

    fn limits() -> Limits {
        Limits::new(2.0, 4.0).unwrap()
    }

    /// Drives to `goal` at 60 Hz among `movers` that stand; where it is after at most `frames`.
    fn drive(behaviour: &mut Behaviour, movers: &[Mover<'_>], goal: Point, frames: usize) -> State {
        let (world, mut state) = (world(), State::at_rest(Point::origin()));
        let (mut trajectory, mut run) = (Trajectory::default(), Run::new(1));
        let period = 1.0 / 60.0;
        for _ in 0..frames {
            let situation = Situation::new(&world, movers, state, goal, limits(), 1.0, period).unwrap();
            behaviour.control(&situation, &mut run, &mut trajectory).unwrap();
            let peaks = trajectory.peaks();
            assert!(peaks.speed <= 2.0 * (1.0 + 1e-9) && peaks.acceleration <= 4.0 * (1.0 + 1e-9), "{peaks:?}");
            assert_eq!(trajectory.start(), state);
            assert_eq!(trajectory.end().velocity, Vector::zeros(), "every answer ends at rest");
            state = trajectory.state(period);
        }
        state
    }

    #[test]
    fn a_free_robot_arrives() {
        let goal = Point::new(4.0, 3.0);
        let end = drive(&mut behaviour(None), &[], goal, 360);
        assert_eq!(end, State::at_rest(goal));
    }

    #[test]
    fn it_goes_round_what_is_beside_its_way() {
        let goal = Point::new(4.0, 0.0);
        let other = |side| Mover::disc(Point::new(2.0, 0.05), 0.18, Path::Velocity(Vector::zeros()), side);
        for side in [Side::Mate, Side::Opponent, Side::Other] {
            let movers = [other(side)];
            assert_eq!(drive(&mut behaviour(None), &movers, goal, 600).position, goal, "{side:?}");
        }
    }

    #[test]
    fn a_start_above_the_limit_brakes_first() {
        let world = world();
        let state = State { position: Point::origin(), velocity: Vector::new(0.0, 3.0) };
        let situation = Situation::new(&world, &[], state, Point::new(9.0, 0.0), limits(), 1.0, 0.1).unwrap();
        let mut trajectory = Trajectory::default();
        let outcome = behaviour(None).control(&situation, &mut Run::new(1), &mut trajectory).unwrap();
        assert_eq!(outcome, Outcome::Partial);
        // 3 to 2 m/s at 4 m/s².
        assert!((trajectory.pieces()[0].duration - 0.25).abs() < 1e-15);
        assert_eq!(trajectory.acceleration(0.1), Vector::new(0.0, -4.0));
        assert!(trajectory.peaks().acceleration <= 4.0 * (1.0 + 1e-9));
    }

    #[test]
    fn slots_are_found_from_where_all_stand() {
        // A column, heading east, spacing 1: slots at x = −1.5 … 1.5 round the centre (0, 0).
        let mates = [Point::new(1.4, 0.0), Point::new(-1.3, 0.2), Point::new(-0.6, -0.2)];
        let movers = mates.map(|p| Mover::disc(p, 0.18, Path::Velocity(Vector::zeros()), Side::Mate));
        let mut pairing = Pairing::default();
        pairing.meet(Point::new(0.5, 0.0), &movers);
        Formation::Column.slots(4, &mut pairing.slots);
        let slot = pairing.own_slot(Vector::x(), 1.0);
        assert!((slot - Point::new(0.5, 0.0)).norm() < 1e-15, "{slot}");
    }

    #[test]
    fn formation_pulls_towards_the_slot() {
        let mate = Mover::disc(Point::new(0.0, 1.0), 0.18, Path::Velocity(Vector::zeros()), Side::Mate);
        let y = |formation| {
            drive(&mut behaviour(formation), std::slice::from_ref(&mate), Point::new(20.0, 0.0), 20).position.y
        };
        assert_eq!(y(None), 0.0);
        assert!(y(Some(Formation::Line)) > 0.05, "the mate is too far aside");
    }

    #[test]
    fn hostile_settings_are_typed_errors() {
        let new = |settings| Behaviour::new(settings).err().map(|e| e.key);
        assert_eq!(new(BehaviourSettings { spacing: f64::NAN, ..BehaviourSettings::default() }), Some("spacing"));
        let parameters = Parameters { robot_sphere: 0.0, ..Parameters::default() };
        assert_eq!(new(BehaviourSettings { parameters, ..BehaviourSettings::default() }), Some("robot_sphere"));
    }
}
