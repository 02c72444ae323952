//! Where robots can begin and end: on the field, where rules allow it, and apart from each other.

use env_model::{Inflated, Point};
use planner_api::SettingError;
use rand_chacha::ChaCha8Rng;

use crate::league::ROBOT_RADIUS;
use crate::rules::{BALL_DISTANCE, DEFENCE_AREA_DISTANCE, defence_area};
use crate::{Settings, draw};

/// Between the centres of two robots at least, in metres: 5 cm of air.
pub(super) const APART: f64 = 2.0 * ROBOT_RADIUS + 0.05;
/// Draws before giving up.
const TRIES: usize = 2000;

/// Draws places one after the other, each apart from those before.
#[derive(Debug)]
pub(super) struct Placing {
    half: [f64; 2],
    areas: [Inflated; 2],
    ball: Option<Point>,
    taken: Vec<Point>,
}

impl Placing {
    /// An empty field; `ball` has to be kept away from.
    pub(super) fn new(settings: &Settings, ball: Option<Point>) -> Self {
        let league = settings.league;
        Self {
            half: league.half_size().map(|half| half - ROBOT_RADIUS),
            areas: [-1.0, 1.0].map(|side| defence_area(league, side, DEFENCE_AREA_DISTANCE)),
            ball,
            taken: Vec::new(),
        }
    }

    /// The field without anybody on it.
    pub(super) fn cleared(mut self) -> Self {
        self.taken.clear();
        self
    }

    /// Whether a robot may stand at `p` as far as lines and rules go.
    pub(super) fn legal(&self, p: Point) -> bool {
        p.x.abs() <= self.half[0]
            && p.y.abs() <= self.half[1]
            && self.areas.iter().all(|area| area.point_clearance(p) >= 0.0)
            && self.ball.is_none_or(|ball| (p - ball).norm() >= BALL_DISTANCE + ROBOT_RADIUS)
    }

    /// Whether nobody is too near to `p`.
    pub(super) fn apart(&self, p: Point) -> bool {
        self.taken.iter().all(|q| (p - q).norm() >= APART)
    }

    /// Takes `p`, whoever is there.
    pub(super) fn take(&mut self, p: Point) -> Point {
        self.taken.push(p);
        p
    }

    /// Takes the first place that `draw` draws and that is legal and apart from the others; `draw` is told how far
    /// the tries have come, from 0 to 1.
    ///
    /// # Errors
    /// [`SettingError`] names `key`, whose `count` robots do not fit.
    pub(super) fn put(
        &mut self,
        key: &'static str,
        count: usize,
        mut draw: impl FnMut(f64) -> Point,
    ) -> Result<Point, SettingError> {
        let found = (0..TRIES).map(|i| draw(i as f64 / TRIES as f64)).find(|p| self.legal(*p) && self.apart(*p));
        SettingError::check(found.is_some(), key, count, "fewer robots, or a larger field: these do not fit")?;
        Ok(self.take(found.unwrap_or_default()))
    }

    /// Takes a place near `nominal`: up to `jitter` away, nearer and nearer if that fails, or further away where even
    /// `nominal` is taken.
    ///
    /// # Errors
    /// As [`Placing::put`].
    pub(super) fn near(
        &mut self,
        key: &'static str,
        count: usize,
        nominal: Point,
        jitter: f64,
        rng: &mut ChaCha8Rng,
    ) -> Result<Point, SettingError> {
        self.put(key, count, |tried| {
            let reach = if tried < 0.5 { jitter * (1.0 - 2.0 * tried) } else { 4.0 * (tried - 0.5) };
            nominal + draw::in_disc(rng, reach)
        })
    }
}
