//! Own robots run to positions all over the field while opponents drift; in every wave to new ones.

use env_model::Point;
use env_model::motion::State;
use planner_api::SettingError;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::placing::Placing;
use super::{Play, Setup, middle_ball};
use crate::roles::assign;
use crate::{Dealing, Settings, draw};

/// Opponents drift with up to this part of the speed limit.
const DRIFT: f64 = 0.3;

/// The play.
#[derive(Debug)]
pub struct Positions {
    goals: Vec<Point>,
    settings: Settings,
    /// Of its own, so that targets do not depend on what else is drawn.
    rng: ChaCha8Rng,
}

impl Default for Positions {
    fn default() -> Self {
        Self { goals: Vec::new(), settings: Settings::default(), rng: ChaCha8Rng::seed_from_u64(0) }
    }
}

/// A point anywhere on the field.
fn anywhere(settings: &Settings, rng: &mut ChaCha8Rng) -> Point {
    let [x, y] = settings.league.half_size();
    Point::new(draw::between(rng, -x, x), draw::between(rng, -y, y))
}

impl Positions {
    /// New goals for robots that are at `from`.
    fn deal(&mut self, from: &[Point]) -> Result<(), SettingError> {
        let Self { settings, rng, .. } = self;
        let n = settings.robots;
        let mut placing = Placing::new(settings, middle_ball(settings).map(|ball| ball.position));
        let spots =
            (0..n).map(|_| placing.put("robots", n, |_| anywhere(settings, rng))).collect::<Result<Vec<_>, _>>()?;
        self.goals = match settings.dealing {
            Dealing::Drawn => spots,
            Dealing::Optimal => {
                assign(n, |i, j| (from[i] - spots[j]).norm_squared()).into_iter().map(|j| spots[j]).collect()
            }
        };
        Ok(())
    }
}

impl Play for Positions {
    fn setup(&mut self, settings: &Settings, rng: &mut ChaCha8Rng) -> Result<Setup, SettingError> {
        self.settings = settings.clone();
        self.rng = ChaCha8Rng::from_rng(rng);
        let (n, m) = (settings.robots, settings.opponents);
        let ball = middle_ball(settings);
        let mut placing = Placing::new(settings, ball.map(|ball| ball.position));
        let mut draw = |key, count: usize| {
            (0..count).map(|_| placing.put(key, count, |_| anywhere(settings, rng))).collect::<Result<Vec<_>, _>>()
        };
        let (starts, places) = (draw("robots", n)?, draw("opponents", m)?);
        self.deal(&starts)?;
        let drift = |position| State { position, velocity: draw::in_disc(rng, DRIFT * settings.speed) };
        Ok(Setup {
            opponents: places.into_iter().map(drift).collect(),
            own: starts.into_iter().map(State::at_rest).collect(),
            ball,
            placement: None,
        })
    }

    fn goals(&self) -> &[Point] {
        &self.goals
    }

    fn next_wave(&mut self) {
        let from = std::mem::take(&mut self.goals);
        if self.deal(&from).is_err() {
            // No room was found this once: they stay.
            self.goals = from;
        }
    }
}
