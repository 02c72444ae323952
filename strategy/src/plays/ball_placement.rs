//! One robot, the taker, pushes the ball to where it is to be placed; the others keep out of the way.
//!
//! Half of the others stand within the keep-out capsule round the ball's way and have to leave it, the other half
//! have to go to its other side, and so round it. The ball sticks to the taker from when it has come behind it.

use env_model::motion::State;
use env_model::{Point, Vector};
use planner_api::SettingError;
use rand_chacha::ChaCha8Rng;

use super::placing::Placing;
use super::{Play, Setup};
use crate::league::{BALL_RADIUS, ROBOT_RADIUS};
use crate::roles::Role;
use crate::rules::PLACEMENT_DISTANCE;
use crate::{Body, Settings, Task, View, draw};

/// Speed of the taker with the ball, in m/s: what a robot can push without losing it.
const PUSH_SPEED: f64 = 0.6;
/// The taker has the ball when it is no further from behind it, in metres, and slower, in m/s.
const CAUGHT: [f64; 2] = [0.03, 0.1];
/// Opponents drift with up to this part of the speed limit.
const DRIFT: f64 = 0.1;
/// From a taker's centre to the ball's.
const REACH: f64 = ROBOT_RADIUS + BALL_RADIUS;

/// The play.
#[derive(Debug, Default)]
pub struct BallPlacement {
    /// From the ball to its target, of length 1.
    direction: Vector,
    /// Where the taker catches the ball.
    behind: Point,
    caught: bool,
    goals: Vec<Point>,
}

impl Play for BallPlacement {
    fn setup(&mut self, settings: &Settings, rng: &mut ChaCha8Rng) -> Result<Setup, SettingError> {
        let [x, y] = settings.league.half_size();
        let (n, m) = (settings.robots, settings.opponents);
        let ball = Point::new(draw::between(rng, -0.3, 0.3) * x, draw::between(rng, -0.5, 0.5) * y);
        let target = loop {
            let angle = std::f64::consts::TAU * draw::uniform(rng);
            let way = Vector::new(libm::cos(angle), libm::sin(angle)) * draw::between(rng, 0.4, 0.7) * y;
            let target = ball + way;
            if target.x.abs() <= 0.5 * x && target.y.abs() <= 0.6 * y {
                break target;
            }
        };
        let length = (target - ball).norm();
        let along = (target - ball) / length;
        let side = Vector::new(-along.y, along.x);
        let at = |part: f64, off: f64| ball + along * (part * length) + side * off;
        self.direction = along;
        self.behind = ball - along * REACH;
        self.goals = vec![target - along * REACH];
        let mut placing = Placing::new(settings, None);
        let mut starts = vec![placing.put("robots", n, |_| ball - along * draw::between(rng, 0.4, 1.0))?];
        // What is free of the capsule by a hand, and further away the more robots there are.
        let least = PLACEMENT_DISTANCE + ROBOT_RADIUS + 0.06;
        let mut ends = Placing::new(settings, None).cleared();
        ends.take(self.goals[0]);
        for i in 1..n {
            let sign = if draw::uniform(rng) < 0.5 { 1.0 } else { -1.0 };
            let beside = |tried: f64, rng: &mut ChaCha8Rng| {
                let spread = 0.4 + 2.0 * tried;
                (draw::between(rng, 0.1 - tried, 0.9 + tried), least + draw::between(rng, 0.0, spread))
            };
            let inside = i % 2 == 1;
            let start = placing.put("robots", n, |tried| {
                // Once the capsule is full, beside it.
                if inside && tried < 0.5 {
                    return at(draw::between(rng, 0.0, 1.0), sign * draw::between(rng, 0.15, 0.45));
                }
                let (part, off) = beside(tried, rng);
                at(part, sign * off)
            })?;
            let other = if inside { sign } else { -sign };
            starts.push(start);
            self.goals.push(ends.put("robots", n, |tried| {
                let (part, off) = beside(tried, rng);
                // At the very edge of the field there may be no room on that side.
                at(part, if tried < 0.7 { other * off } else { -other * off })
            })?);
        }
        let mut opponents = Vec::new();
        for _ in 0..m {
            let rng = &mut *rng;
            let position = placing.put("opponents", m, |_| {
                Point::new(draw::between(rng, -0.7 * x, 0.7 * x), draw::between(rng, -y, y))
            })?;
            opponents.push(State { position, velocity: draw::in_disc(rng, DRIFT * settings.speed) });
        }
        Ok(Setup {
            own: starts.into_iter().map(State::at_rest).collect(),
            opponents,
            ball: Some(State::at_rest(ball)),
            placement: Some(target),
        })
    }

    fn goals(&self) -> &[Point] {
        &self.goals
    }

    fn direct(&mut self, _view: &View<'_>, tasks: &mut [Task]) {
        for (task, goal) in tasks.iter_mut().zip(&self.goals) {
            task.goal = *goal;
        }
        let taker = &mut tasks[0];
        taker.role = Role::Taker;
        if self.caught {
            taker.limits.speed = taker.limits.speed.min(PUSH_SPEED);
        } else {
            taker.goal = self.behind;
        }
    }

    fn carry(&mut self, own: &[Body], ball: &mut Option<State>) {
        let State { position, velocity } = own[0].state;
        self.caught |= (position - self.behind).norm() <= CAUGHT[0] && velocity.norm() <= CAUGHT[1];
        if self.caught {
            *ball = Some(State { position: position + self.direction * REACH, velocity });
        }
    }
}
