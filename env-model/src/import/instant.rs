//! Robots at an instant of a match, and the scene they make.

use super::Side;
use crate::scene::Field;
use crate::{Obstacle, Point, Scene, Shape, World};

/// Metres. Less is the rounding of a log's decimals.
const WORTH_A_NOTE: f64 = 1e-6;

/// The pitch, its middle at the origin, goals left and right. Scene units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pitch {
    /// From goal line to goal line.
    pub length: f64,
    /// From touch line to touch line.
    pub width: f64,
    /// Free space around the lines.
    pub margin: f64,
}

impl Pitch {
    fn field(&self) -> Field {
        let (x, y) = (0.5 * self.length + self.margin, 0.5 * self.width + self.margin);
        Field { min: [-x, -y], max: [x, y] }
    }

    /// Middle of the goal mouth on that side.
    pub(super) fn goal(&self, side: Side) -> [f64; 2] {
        [side.sign() * 0.5 * self.length, 0.0]
    }
}

/// A robot seen from above.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub centre: [f64; 2],
    pub radius: f64,
    /// What the obstacle is called.
    pub label: String,
}

/// All that a scene needs. Metres.
pub(super) struct Instant {
    pub name: String,
    pub pitch: Pitch,
    pub robot: Body,
    pub others: Vec<Body>,
    pub goal: [f64; 2],
}

impl Instant {
    /// The scene, or why the instant makes none.
    ///
    /// Real bodies do not overlap, but measured ones may, by the noise. Whatever reaches
    /// into the start is drawn smaller until it touches, and `notes` says so: the start stays
    /// where the robot is, and no other distance changes. Nearer than one radius, centre
    /// to centre, it is no noise but an error; so is a goal in an obstacle.
    pub(super) fn scene(self, notes: &mut Vec<String>) -> Result<Scene, String> {
        let Self { name, pitch, robot, others, goal } = self;
        let start = Point::from(robot.centre);
        let mut obstacles = Vec::with_capacity(others.len());
        for Body { centre, radius, label } in others {
            let room = (Point::from(centre) - start).norm() - robot.radius;
            if room <= 0.0 {
                return Err(format!(
                    "{label} at ({:.3}, {:.3}) stands on the start ({:.3}, {:.3}): only {:.3} apart, robots of radius \
                     {}; expected robots side by side, as bodies are",
                    centre[0],
                    centre[1],
                    start.x,
                    start.y,
                    room + robot.radius,
                    robot.radius
                ));
            }
            let overlap = radius - room;
            if overlap >= WORTH_A_NOTE {
                notes.push(format!(
                    "{name}: {label} overlaps the start by {overlap:.6}: radius {room:.6} instead of {radius}"
                ));
            }
            let shape = Shape::Disc { centre, radius: radius.min(room) };
            obstacles.push(Obstacle { label: Some(label), ..shape.into() });
        }
        let scene = Scene {
            name,
            unit: "m".to_owned(),
            robot_radius: robot.radius,
            start: robot.centre,
            goal,
            field: Some(pitch.field()),
            obstacles,
        };
        let world = World::new(&scene).map_err(|e| e.to_string())?;
        scene.validate_ends(&world).map_err(|e| match e.place().key {
            "goal" => format!("{e}; another goal can be given as target = [x, y]"),
            _ => e.to_string(),
        })?;
        Ok(scene)
    }
}
