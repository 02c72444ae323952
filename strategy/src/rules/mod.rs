//! The rules of the game (SSL, 2026), outside of all planners: what the referee commands becomes obstacles and speed
//! limits of the tasks, by role.
//!
//! A robot that is in a zone, perhaps because the command has just come, is led out by the guard of its controller. A
//! goal in a zone is moved to the nearest legal point ([`Rules::legal`]).

mod command;
pub mod crash;
mod zones;

use env_model::motion::{Limits, State};
use env_model::{Point, Scene, SceneError, World};
use planner_control::nearest_free;

pub use command::{Command, STOP_ROOM, STOP_SPEED};
pub(crate) use zones::defence_area;
pub use zones::{BALL_DISTANCE, Ball, CENTRE_CIRCLE, DEFENCE_AREA_DISTANCE, PLACEMENT_DISTANCE, zones};

use crate::league::ROBOT_RADIUS;
use crate::roles::Role;
use crate::{League, Task};

/// Zones follow the ball when it has moved by more than this, in metres.
const BALL_MOVED: f64 = 0.01;

/// The rules in force, compiled into one world for each role.
pub struct Rules {
    league: League,
    command: Command,
    ball: Option<Ball>,
    field: World,
    worlds: Vec<World>,
}

impl Rules {
    /// The rules of `league` at `command`.
    ///
    /// # Errors
    /// [`SceneError`] where the field itself is unusable.
    pub fn new(league: League, command: Command, ball: Option<Ball>) -> Result<Self, SceneError> {
        let field = empty(league)?;
        let mut rules = Self { league, command, ball, field, worlds: Vec::new() };
        rules.compile();
        Ok(rules)
    }

    /// What the referee commands now and where the ball is now; worlds are compiled anew only where that moves zones.
    /// Returns whether they were.
    pub fn update(&mut self, command: Command, ball: Option<Ball>) -> bool {
        let same_ball = match (self.ball, ball) {
            (Some(old), Some(new)) => (old.at - new.at).norm() <= BALL_MOVED && old.target == new.target,
            (old, new) => old.is_none() && new.is_none(),
        };
        let minds = command.minds_ball();
        let changed = command != self.command || (minds && !same_ball);
        if changed {
            (self.command, self.ball) = (command, ball);
            self.compile();
        }
        changed
    }

    fn compile(&mut self) {
        let Self { league, command, ball, ref field, ref mut worlds } = *self;
        worlds.clear();
        worlds.extend(Role::ALL.map(|role| field.with_obstacles(zones(league, command, role, ball))));
    }

    /// The worlds that [`Task::world`] counts, one for each role.
    pub fn worlds(&self) -> &[World] {
        &self.worlds
    }

    /// What the referee commands.
    pub fn command(&self) -> Command {
        self.command
    }

    /// `limits`, no faster than the rules allow.
    pub fn limits(&self, limits: Limits) -> Limits {
        let mut allowed = limits;
        allowed.speed = limits.speed.min(self.command.cap());
        allowed
    }

    /// Puts tasks under the rules: worlds by role, limits, and halting.
    pub fn apply(&self, tasks: &mut [Task]) {
        for task in tasks {
            task.world = task.role as usize;
            task.limits = self.limits(task.limits);
            task.halt = self.command == Command::Halt;
        }
    }

    /// The nearest point to `goal` where a robot in `role` may stand; `goal` itself if it may stand there.
    pub fn legal(&self, role: Role, goal: Point) -> Point {
        nearest_free(&self.worlds[role as usize], &[], goal).unwrap_or(goal)
    }

    /// Whether the rules allow a robot in `role` to be in this state.
    pub fn allows(&self, role: Role, state: State) -> bool {
        state.velocity.norm() <= self.command.speed() && self.worlds[role as usize].point_free(state.position)
    }
}

/// The empty field.
fn empty(league: League) -> Result<World, SceneError> {
    let field = league.field();
    World::new(&Scene {
        name: "field".into(),
        unit: "m".into(),
        robot_radius: ROBOT_RADIUS,
        start: field.min,
        goal: field.max,
        field: Some(field),
        obstacles: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use env_model::Vector;

    use super::*;

    #[test]
    fn worlds_are_compiled_only_when_zones_move() {
        let at = |x: f64| Some(Ball { at: Point::new(x, 0.0), target: None });
        let mut rules = Rules::new(League::DivisionA, Command::Running, at(0.0)).unwrap();
        assert!(!rules.update(Command::Running, at(1.0)), "nobody minds the ball in play");
        assert!(rules.update(Command::Stop, at(1.0)));
        assert!(!rules.update(Command::Stop, at(1.009)));
        assert!(rules.update(Command::Stop, at(1.011)));
        assert!(rules.update(Command::Stop, None), "the ball is gone");
        assert!(!rules.update(Command::Stop, None));
    }

    #[test]
    fn limits_and_halting() {
        let limits = Limits::new(3.0, 2.0).unwrap();
        let mut rules = Rules::new(League::DivisionA, Command::Stop, None).unwrap();
        assert_eq!(rules.limits(limits).speed, STOP_SPEED - STOP_ROOM);
        assert_eq!(rules.limits(Limits::new(0.5, 2.0).unwrap()).speed, 0.5, "slower is allowed");
        let mut task = [Task { role: Role::Keeper, ..Task::new(Point::origin(), limits) }];
        rules.apply(&mut task);
        assert!(!task[0].halt && task[0].limits.speed < STOP_SPEED && task[0].limits.acceleration == 2.0);
        rules.update(Command::Halt, None);
        rules.apply(&mut task);
        assert!(task[0].halt);
        rules.update(Command::Off, None);
        assert_eq!(rules.limits(limits), limits);
    }

    #[test]
    fn what_is_allowed() {
        let rules = Rules::new(League::DivisionA, Command::Stop, None).unwrap();
        let state = |x: f64, v: f64| State { position: Point::new(x, 0.0), velocity: Vector::new(v, 0.0) };
        assert!(rules.allows(Role::Field, state(0.0, 1.5)));
        assert!(!rules.allows(Role::Field, state(0.0, 1.5f64.next_up())));
        assert!(!rules.allows(Role::Field, state(-5.0, 0.0)));
        assert!(rules.allows(Role::Keeper, state(-5.0, 0.0)));
    }

    #[test]
    fn a_goal_in_a_zone_moves_to_its_edge() {
        let rules = Rules::new(League::DivisionA, Command::Running, None).unwrap();
        let p = Point::new(-4.3, 0.5);
        assert_eq!(rules.legal(Role::Keeper, p), p);
        let q = rules.legal(Role::Field, p);
        // A millionth of the field is what nearest points keep from edges.
        assert!((q - Point::new(-4.11, 0.5)).norm() < 1e-4, "{q}");
    }
}
