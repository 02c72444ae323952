//! Situations: where all stand at first, and what every robot is to do in each frame.
//!
//! Positions and goals that plays draw are legal in play and in STOP, with the ball in the middle of the field where
//! the rules mind it and the play has none of its own. Under commands that forbid more, the simulation moves goals to
//! the nearest legal points.

mod attack;
mod ball_placement;
mod circle_swap;
mod crossing;
mod formation;
mod placing;
mod positions;

use env_model::motion::{Limits, State};
use env_model::{Point, Vector};
use planner_api::SettingError;
use rand_chacha::ChaCha8Rng;

use crate::{Body, PlayKind, Settings, Task, View};

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
    /// Where the ball is to be placed.
    pub placement: Option<Point>,
}

/// A situation.
pub trait Play: Send {
    /// Draws the beginning.
    ///
    /// # Errors
    /// [`SettingError`] where the robots do not fit.
    fn setup(&mut self, settings: &Settings, rng: &mut ChaCha8Rng) -> Result<Setup, SettingError>;

    /// Where own robots are to stand in the end, in their order: what arrival means.
    fn goals(&self) -> &[Point];

    /// Gives every own robot its task, in the order of the robots: role, goal, and a lower speed limit where the play
    /// wants one. What the rules add comes later.
    fn direct(&mut self, _view: &View<'_>, tasks: &mut [Task]) {
        for (task, goal) in tasks.iter_mut().zip(self.goals()) {
            task.goal = *goal;
        }
    }

    /// New goals: all stand at the last ones, or their time is up.
    fn next_wave(&mut self) {}

    /// Says how opponents behave; they drift unless told otherwise.
    fn oppose(&mut self, _view: &View<'_>, _conducts: &mut [Conduct]) {}

    /// Moves the ball after the `own` robots have moved; it lies unless told otherwise.
    fn carry(&mut self, _own: &[Body], _ball: &mut Option<State>) {}

    /// The own robots' places in the formation in this frame; none where there is no formation.
    fn places(&self) -> &[Point] {
        &[]
    }
}

/// The play of that kind.
pub fn play(kind: PlayKind) -> Box<dyn Play> {
    match kind {
        PlayKind::CircleSwap => Box::new(circle_swap::CircleSwap::default()),
        PlayKind::Crossing => Box::new(crossing::Crossing::default()),
        PlayKind::Positions => Box::new(positions::Positions::default()),
        PlayKind::Attack => Box::new(attack::Attack::default()),
        PlayKind::Formation => Box::new(formation::Formation::default()),
        PlayKind::BallPlacement => Box::new(ball_placement::BallPlacement::default()),
    }
}

/// The point at `angle` on the circle of `radius` round the origin.
fn on_circle(radius: f64, angle: f64) -> Point {
    Point::from(Vector::new(libm::cos(angle), libm::sin(angle)) * radius)
}

/// Parts of the robots' limits on speed and acceleration.
fn limits(settings: &Settings, speed: f64, acceleration: f64) -> Limits {
    Limits::new(speed * settings.speed, acceleration * settings.acceleration).expect("settings are validated")
}

/// The ball in the middle of the field, if the rules mind a ball.
fn middle_ball(settings: &Settings) -> Option<State> {
    settings.command().minds_ball().then(|| State::at_rest(Point::origin()))
}
