//! Seeded scene generators: always solvable, start and goal always free.
//!
//! A scene is a function of (generator, obstacles, seed, index) and of nothing
//! else, bit for bit on any machine: one `ChaCha8` stream a scene, `+ − × ÷ √` only.
//! A draw that fails a check is thrown away and the stream goes on: ends in an
//! obstacle, a straight line that should be blocked and is not, or no path
//! that a conservative grid search (`reach`) can prove.
//!
//! All scenes are in metres, for a robot of radius 0.09 m (SSL, the Small Size
//! League), the origin in the middle of the pitch, own goal on the left.

mod crowd;
mod draw;
mod open;
mod reach;
mod scrum;
mod ssl;
mod wall;

use serde::{Deserialize, Serialize};

use crate::{Scene, World};
use draw::Draw;

/// Radius of every robot, m (Small Size League rules).
pub const ROBOT_RADIUS: f64 = 0.09;

/// Side of the cells in which solvability is proved, m: two thirds of the
/// robot's radius, so gaps 0.17 m (two diagonals) wider than the robot are always found.
const CELL: f64 = 0.06;

/// More would take gigabytes for the solvability check alone.
const MOST_OBSTACLES: usize = 100_000;

/// Draws before a generator gives up. Games take two on average, the others hardly ever more than one.
const ATTEMPTS: u32 = 1000;

/// A family of scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Generator {
    /// Robots scattered over the pitch.
    Open,
    /// Walls of defenders across the straight line, the rest scattered.
    Wall,
    /// A dense cluster in the middle, like robots fighting for the ball.
    Scrum,
    /// An instant of an 11-against-11 game, Division A.
    SslA,
    /// An instant of a 6-against-6 game, Division B.
    SslB,
}

/// What a comparison asks for: `count` scenes of one family.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Request {
    /// The family.
    pub generator: Generator,
    /// Number of scenes.
    pub count: u32,
    /// Obstacles in each; `None` for the family's default.
    pub obstacles: Option<usize>,
    /// Scenes of different seeds are unrelated.
    pub seed: u64,
}

impl Request {
    /// The scenes, index 0 first.
    pub fn scenes(&self) -> impl Iterator<Item = Result<Scene, GenerateError>> + use<> {
        let Self { generator, count, obstacles, seed } = *self;
        (0..count).map(move |index| generate(generator, obstacles, seed, index))
    }
}

/// Why there is no scene.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are what the messages print")]
pub enum GenerateError {
    /// No family of that name.
    #[error("unknown generator \"{name}\"; expected one of {}", Generator::ALL.map(Generator::name).join(", "))]
    Unknown { name: String },
    /// The family does not make sense with so few.
    #[error("generator {} with {obstacles} obstacles; expected at least {least}", generator.name())]
    TooFew { generator: Generator, obstacles: usize, least: usize },
    /// More than a scene may have.
    #[error("generator {} with {obstacles} obstacles; expected at most {most}", generator.name())]
    TooMany { generator: Generator, obstacles: usize, most: usize },
    /// The rules of the league fix the number.
    #[error("generator {} with {obstacles} obstacles; expected no number: a game always has {fixed}", generator.name())]
    FixedCount { generator: Generator, obstacles: usize, fixed: usize },
    /// Every draw failed a check.
    #[error("generator {} found no usable scene in {attempts} draws (seed {seed}, index {index})", generator.name())]
    NoScene { generator: Generator, seed: u64, index: u32, attempts: u32 },
}

impl Generator {
    /// Every family.
    pub const ALL: [Self; 5] = [Self::Open, Self::Wall, Self::Scrum, Self::SslA, Self::SslB];

    /// The name in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Wall => "wall",
            Self::Scrum => "scrum",
            Self::SslA => "ssl-a",
            Self::SslB => "ssl-b",
        }
    }

    /// The family of that name.
    pub fn from_name(name: &str) -> Result<Self, GenerateError> {
        Self::ALL
            .into_iter()
            .find(|generator| generator.name() == name)
            .ok_or_else(|| GenerateError::Unknown { name: name.to_owned() })
    }

    /// One line for lists.
    pub const fn description(self) -> &'static str {
        match self {
            Self::Open => "robots scattered over a 12 x 9 m pitch, which grows beyond 370 of them",
            Self::Wall => "walls of defenders always block the straight line, the other robots are scattered",
            Self::Scrum => "two thirds of the robots crowd the middle and block the straight line",
            Self::SslA => "an instant of an 11-against-11 game on the Division A field, defence areas forbidden",
            Self::SslB => "an instant of a 6-against-6 game on the Division B field, defence areas forbidden",
        }
    }

    /// Obstacles when none are asked for.
    pub const fn default_obstacles(self) -> usize {
        match self {
            Self::Open | Self::Wall | Self::Scrum => 21,
            Self::SslA => ssl::DIVISION_A.obstacles(),
            Self::SslB => ssl::DIVISION_B.obstacles(),
        }
    }

    /// The fewest obstacles, or `None` when the number is fixed. An empty pitch is a scene of `open`;
    /// three make the smallest wall and the smallest crowd.
    const fn least_obstacles(self) -> Option<usize> {
        match self {
            Self::Open => Some(0),
            Self::Wall | Self::Scrum => Some(3),
            Self::SslA | Self::SslB => None,
        }
    }

    /// Whether the straight line must be blocked.
    const fn blocks_the_line(self) -> bool {
        matches!(self, Self::Wall | Self::Scrum)
    }
}

/// Scene `index` of (`generator`, `seed`), named like `wall-s2-00`.
///
/// `obstacles`: how many, `None` for the default; 0 … 10⁵ for `open`, 3 … 10⁵ for `wall`
/// and `scrum`, fixed for the game scenes. Every scene passes [`Scene::validate_ends`],
/// and a path from start to goal exists.
pub fn generate(generator: Generator, obstacles: Option<usize>, seed: u64, index: u32) -> Result<Scene, GenerateError> {
    if let Some(obstacles) = obstacles {
        match generator.least_obstacles() {
            None => {
                return Err(GenerateError::FixedCount { generator, obstacles, fixed: generator.default_obstacles() });
            }
            Some(least) if obstacles < least => return Err(GenerateError::TooFew { generator, obstacles, least }),
            Some(_) if obstacles > MOST_OBSTACLES => {
                return Err(GenerateError::TooMany { generator, obstacles, most: MOST_OBSTACLES });
            }
            Some(_) => {}
        }
    }
    let count = obstacles.unwrap_or(generator.default_obstacles());
    let mut draw = Draw::new(generator, seed, index);
    for _ in 0..ATTEMPTS {
        let candidate = match generator {
            Generator::Open => open::draw(&mut draw, count),
            Generator::Wall => wall::draw(&mut draw, count),
            Generator::Scrum => scrum::draw(&mut draw, count),
            Generator::SslA => ssl::draw(&mut draw, &ssl::DIVISION_A),
            Generator::SslB => ssl::draw(&mut draw, &ssl::DIVISION_B),
        };
        let Some(mut scene) = candidate else { continue };
        scene.name = format!("{}-s{seed}-{index:02}", generator.name());
        if is_usable(&scene, generator.blocks_the_line()) {
            return Ok(scene);
        }
    }
    Err(GenerateError::NoScene { generator, seed, index, attempts: ATTEMPTS })
}

fn is_usable(scene: &Scene, line_must_be_blocked: bool) -> bool {
    let Ok(world) = World::new(scene) else { return false };
    let (start, goal) = (scene.start(), scene.goal());
    scene.validate_ends(&world).is_ok()
        && !(line_must_be_blocked && world.segment_free(start, goal))
        && reach::connected(&world, start, goal, CELL)
}
