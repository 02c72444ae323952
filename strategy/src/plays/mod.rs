//! Situations: where all stand at first, and what every robot is to do in each frame.

mod circle_swap;
mod crossing;

use env_model::motion::State;
use env_model::{Point, Vector};
use rand_chacha::ChaCha8Rng;

use crate::{PlayKind, Settings, Task, View};

/// How an opponent behaves until the next frame. Opponents give way to nobody.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Conduct {
    /// With constant velocity; turned back at the field's border.
    Drift,
    /// As fast as it can to this point.
    RunTo(Point),
}

/// How it begins.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Setup {
    /// Own robots, as many as the settings say.
    pub own: Vec<State>,
    /// Opponents, as many as the settings say.
    pub opponents: Vec<State>,
    /// The ball, where there is one.
    pub ball: Option<State>,
    /// Where own robots are to stand in the end: what arrival means.
    pub goals: Vec<Point>,
}

/// A situation.
pub trait Play: Send {
    /// Draws the beginning.
    fn setup(&mut self, settings: &Settings, rng: &mut ChaCha8Rng) -> Setup;

    /// Gives every own robot its task, in the order of the robots.
    fn direct(&mut self, view: &View<'_>, tasks: &mut [Task]);

    /// Says how opponents behave; they drift unless told otherwise.
    fn oppose(&mut self, _view: &View<'_>, _conducts: &mut [Conduct]) {}
}

/// The play of that kind.
pub fn play(kind: PlayKind) -> Box<dyn Play> {
    match kind {
        PlayKind::CircleSwap => Box::new(circle_swap::CircleSwap::default()),
        PlayKind::Crossing => Box::new(crossing::Crossing::default()),
    }
}

/// The point at `angle` on the circle of `radius` round the origin.
fn on_circle(radius: f64, angle: f64) -> Point {
    Point::from(Vector::new(libm::cos(angle), libm::sin(angle)) * radius)
}
