//! Own robots hold a formation that moves up the field while opponents drift across.
//!
//! Unit-centre-referenced formations (Balch & Arkin 1998, doi:10.1109/70.736776): places are fixed relative to the
//! unit's centre, which runs up the field at a quarter of the robots' speed and stops there. Its motion is a
//! program, not the mean of the robots, so that who lags behind pays for it and nobody slows the others.

use env_model::motion::{State, Trajectory, bang_bang};
use env_model::{Point, Vector};
use planner_api::SettingError;
use rand_chacha::ChaCha8Rng;

use super::placing::Placing;
use super::{Play, Setup, limits, middle_ball};
use crate::league::ROBOT_RADIUS;
use crate::roles::Assignment;
use crate::rules::DEFENCE_AREA_DISTANCE;
use crate::{Settings, Task, View, draw};

/// Speed of the unit's centre as part of the robots' speed.
const SPEED: f64 = 0.25;
/// Its acceleration as part of theirs.
const ACCELERATION: f64 = 0.5;
/// Opponents drift with up to this part of the robots' speed.
const DRIFT: f64 = 0.2;
/// The centre goes at least so far, in metres.
const LEAST_WAY: f64 = 1.0;

/// Places of `n` robots relative to the unit's centre, the mean of all, facing +x.
///
/// Line and column: `spacing` between neighbours. Wedge: the leader in front, the others by turns left and right, each
/// `spacing` further back on its arm at 45°. Diamond: evenly round a square on its corner whose corners are
/// max(1, n/4) · `spacing` from the middle; with four, one on each corner.
pub fn slots(formation: crate::Formation, n: usize, spacing: f64) -> Vec<Vector> {
    use crate::Formation;
    let place = |i: usize| match formation {
        Formation::Line => Vector::new(0.0, i as f64 * spacing),
        Formation::Column => Vector::new(-(i as f64) * spacing, 0.0),
        Formation::Wedge => {
            let (rank, side) = (i.div_ceil(2) as f64, if i.is_multiple_of(2) { -1.0 } else { 1.0 });
            Vector::new(-rank, side * rank) * spacing * std::f64::consts::FRAC_1_SQRT_2
        }
        Formation::Diamond => {
            let corner =
                |k: usize| [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].map(|c| Vector::new(c[0], c[1]))[k % 4];
            let (side, part) = (4 * i / n, (4 * i % n) as f64 / n as f64);
            (corner(side) * (1.0 - part) + corner(side + 1) * part) * spacing * (0.25 * n as f64).max(1.0)
        }
    };
    let places: Vec<Vector> = (0..n).map(place).collect();
    let mean = places.iter().sum::<Vector>() / n as f64;
    places.into_iter().map(|p| p - mean).collect()
}

/// The play.
#[derive(Debug, Default)]
pub struct Formation {
    slots: Vec<Vector>,
    /// Motion of the unit's centre.
    centre: Trajectory,
    acceleration: f64,
    assignment: Assignment,
    /// By robot.
    places: Vec<Point>,
    goals: Vec<Point>,
}

impl Play for Formation {
    fn setup(&mut self, settings: &Settings, rng: &mut ChaCha8Rng) -> Result<Setup, SettingError> {
        let (n, m) = (settings.robots, settings.opponents);
        self.slots = slots(settings.formation, n, settings.spacing);
        let reach = |axis: usize| self.slots.iter().map(|s| s[axis].abs()).fold(0.0, f64::max) + ROBOT_RADIUS;
        let [x, y] = settings.league.half_size();
        // Between the defence areas, within the lines.
        let depth = settings.league.defence_area()[0] + DEFENCE_AREA_DISTANCE;
        let (run, room) = (x - depth - reach(0), y - reach(1));
        SettingError::check(
            2.0 * run >= LEAST_WAY && room >= 0.0,
            "spacing",
            settings.spacing,
            "less, or fewer robots: the formation has no room to move up the field",
        )?;
        let across = draw::between(rng, -1.0, 1.0) * room.min(0.3 * y);
        let [begin, end] = [-run, run].map(|x| Point::new(x, across));
        let unit = limits(settings, SPEED, ACCELERATION);
        bang_bang(State::at_rest(begin), end, unit, &mut self.centre);
        self.acceleration = settings.acceleration;
        let mut placing = Placing::new(settings, None);
        let mut own = Vec::new();
        for slot in &self.slots {
            own.push(State::at_rest(placing.near("robots", n, begin + slot, settings.jitter, rng)?));
        }
        let mut opponents = Vec::new();
        for _ in 0..m {
            let (rng, key) = (&mut *rng, "opponents");
            let position =
                placing.put(key, m, |_| Point::new(draw::between(rng, begin.x, x), draw::between(rng, -y, y)))?;
            // Mostly across.
            let across = draw::between(rng, 0.3, 1.0) * DRIFT * settings.speed;
            let sign = if position.y > 0.0 { -1.0 } else { 1.0 };
            let along = draw::between(rng, -0.3, 0.3) * DRIFT * settings.speed;
            opponents.push(State { position, velocity: Vector::new(along, sign * across) });
        }
        let starts: Vec<Point> = own.iter().map(|state| state.position).collect();
        self.deal(0.0, &starts);
        Ok(Setup { own, opponents, ball: middle_ball(settings), placement: None })
    }

    fn goals(&self) -> &[Point] {
        &self.goals
    }

    fn direct(&mut self, view: &View<'_>, tasks: &mut [Task]) {
        let own: Vec<Point> = view.own.iter().map(|state| state.position).collect();
        self.deal(view.time, &own);
        // Who can stop at its goal follows a goal of speed v at its braking distance, v²/2a: so far ahead it is set.
        let velocity = self.centre.state(view.time).velocity;
        let ahead = velocity * (0.5 * velocity.norm() / self.acceleration);
        for (task, place) in tasks.iter_mut().zip(&self.places) {
            task.goal = place + ahead;
        }
    }

    fn places(&self) -> &[Point] {
        &self.places
    }
}

impl Formation {
    /// Deals the places of `time` to robots that are at `own`.
    fn deal(&mut self, time: f64, own: &[Point]) {
        let at = |centre: Point| -> Vec<Point> { self.slots.iter().map(|slot| centre + slot).collect() };
        let (now, last) = (at(self.centre.state(time).position), at(self.centre.end().position));
        // Who is nowhere keeps its place.
        let known = own.iter().all(|p| p.x.is_finite() && p.y.is_finite());
        if !known && !self.places.is_empty() {
            return;
        }
        let spots = self.assignment.update(own, &now);
        self.places.clear();
        self.places.extend(spots.iter().map(|j| now[*j]));
        self.goals.clear();
        self.goals.extend(spots.iter().map(|j| last[*j]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Formation as Shape;

    fn near(actual: &[Vector], expected: &[[f64; 2]]) {
        assert_eq!(actual.len(), expected.len());
        for (a, e) in actual.iter().zip(expected) {
            // Rounding of coordinates of order 1.
            assert!((a - Vector::new(e[0], e[1])).norm() < 1e-12, "{a} {e:?}");
        }
    }

    #[test]
    fn slots_by_hand() {
        near(&slots(Shape::Line, 3, 0.5), &[[0.0, -0.5], [0.0, 0.0], [0.0, 0.5]]);
        near(&slots(Shape::Column, 4, 1.0), &[[1.5, 0.0], [0.5, 0.0], [-0.5, 0.0], [-1.5, 0.0]]);
        near(&slots(Shape::Diamond, 4, 2.0), &[[2.0, 0.0], [0.0, 2.0], [-2.0, 0.0], [0.0, -2.0]]);
        // Eight: corners 2 from the middle, one more in the middle of each side.
        let eight = [[2., 0.], [1., 1.], [0., 2.], [-1., 1.], [-2., 0.], [-1., -1.], [0., -2.], [1., -1.]];
        near(&slots(Shape::Diamond, 8, 1.0), &eight);
        // √2 apart: ranks 1 apart in x and y; the mean of 0, −1, −1 is taken off.
        let back = 2.0 / 3.0;
        near(&slots(Shape::Wedge, 3, 2f64.sqrt()), &[[back, 0.0], [back - 1.0, 1.0], [back - 1.0, -1.0]]);
        for shape in [Shape::Line, Shape::Column, Shape::Diamond, Shape::Wedge] {
            near(&slots(shape, 1, 0.5), &[[0.0, 0.0]]);
        }
    }

    #[test]
    fn neighbours_are_never_nearer_than_the_spacing() {
        for shape in [Shape::Line, Shape::Column, Shape::Diamond, Shape::Wedge] {
            for n in 1..=16 {
                let places = slots(shape, n, 0.4);
                for (i, p) in places.iter().enumerate() {
                    for q in &places[..i] {
                        assert!((p - q).norm() > 0.4 * (1.0 - 1e-12), "{shape:?} {n}: {p} {q}");
                    }
                }
                assert!(places.iter().sum::<Vector>().norm() < 1e-12, "round the centre");
            }
        }
    }
}
