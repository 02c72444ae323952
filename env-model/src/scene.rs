//! Scenes as data: what the TOML file says, what generators produce.

use serde::{Deserialize, Serialize};

use crate::scene_file::{ObstacleFields, pair};
use crate::{Aabb, Core, FileError, Inflated, Point, Polygon, PolygonError, World};

/// The shape of an obstacle, before inflation.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// All points nearer than `radius` to `centre`.
    Disc {
        /// Middle point.
        centre: [f64; 2],
        /// Radius ≥ 0, in scene units.
        radius: f64,
    },
    /// All points nearer than `radius` to the segment `from`–`to`.
    Capsule {
        /// One end of the axis.
        from: [f64; 2],
        /// The other end; may equal `from`.
        to: [f64; 2],
        /// Radius ≥ 0, in scene units.
        radius: f64,
    },
    /// The interior of a simple polygon, either winding, convex or not.
    Polygon(Vec<[f64; 2]>),
}

/// One obstacle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "ObstacleFields", into = "ObstacleFields")]
pub struct Obstacle {
    /// Its shape.
    pub shape: Shape,
    /// Scene units per second; static comparisons refuse anything but zero.
    pub velocity: Option<[f64; 2]>,
    /// What to call it in messages and pictures.
    pub label: Option<String>,
}

impl Obstacle {
    /// An unnamed disc at rest.
    pub fn disc(centre: Point, radius: f64) -> Self {
        Shape::Disc { centre: [centre.x, centre.y], radius }.into()
    }
}

impl From<Shape> for Obstacle {
    fn from(shape: Shape) -> Self {
        Self { shape, velocity: None, label: None }
    }
}

/// The limits of the playing field: the robot's whole disc stays inside.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// Lower left corner.
    #[serde(deserialize_with = "pair")]
    pub min: [f64; 2],
    /// Upper right corner.
    #[serde(deserialize_with = "pair")]
    pub max: [f64; 2],
}

impl From<Field> for Aabb {
    fn from(field: Field) -> Self {
        Self { min: field.min.into(), max: field.max.into() }
    }
}

/// A planning problem as data. All lengths share one unit.
///
/// Serialises to the stable scene format. To read a file use [`Scene::from_toml`],
/// which says where a mistake is; `Deserialize` (for the worker protocol) does not.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// What results call it.
    pub name: String,
    /// A label for the unit of length, e.g. `"m"`.
    #[serde(default = "metre")]
    pub unit: String,
    /// Obstacles are inflated by this.
    #[serde(default)]
    pub robot_radius: f64,
    /// Where the path begins.
    #[serde(deserialize_with = "pair")]
    pub start: [f64; 2],
    /// Where it ends.
    #[serde(deserialize_with = "pair")]
    pub goal: [f64; 2],
    /// Limits of the field, if it has any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<Field>,
    /// What stands in the way.
    #[serde(default, rename = "obstacle", skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<Obstacle>,
}

pub(crate) fn metre() -> String {
    "m".to_owned()
}

/// Which part of a scene an error is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// The obstacle, counted from 0; `None` for the scene's own keys.
    pub obstacle: Option<usize>,
    /// The key as the scene file spells it.
    pub key: &'static str,
}

/// What makes a scene unusable. `what` names the part; obstacles are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are what the messages print")]
pub enum SceneError {
    /// A name that tables and file names cannot carry.
    #[error("name {name:?}; expected 1 to 100 printable characters")]
    Name { name: String },
    /// A coordinate or radius is NaN or infinite.
    #[error("{what} is {value}; expected a finite number")]
    NotFinite { place: Place, what: String, value: f64 },
    /// A radius below zero.
    #[error("{what} is {value}; expected a radius of at least 0")]
    NegativeRadius { place: Place, what: String, value: f64 },
    /// An obstacle without interior would block nothing.
    #[error("{what} is 0 and so is robot_radius: it would block nothing; expected a sum above 0")]
    NoInterior { place: Place, what: String },
    /// A polygon that is not simple.
    #[error("{what}: {source}")]
    Polygon { place: Place, what: String, source: PolygonError },
    /// A field without interior for the robot.
    #[error("field min ({}, {}) must lie below and left of max ({}, {}) by more than the robot's diameter {diameter}",
        min[0], min[1], max[0], max[1])]
    EmptyField { min: [f64; 2], max: [f64; 2], diameter: f64 },
    /// Start and goal coincide, up to the scene's ε.
    #[error("start and goal are the same point ({x}, {y}); expected two different points")]
    StartIsGoal { x: f64, y: f64 },
    /// Sizes whose squares f64 cannot hold.
    #[error("the scene measures {diagonal:e} across; expected between 1e-100 and 1e100 units")]
    Size { diagonal: f64 },
    /// Coordinates so large that f64 cannot resolve the scene's tolerance.
    #[error(
        "a scene {diagonal:e} across with coordinates up to {largest:e} cannot be resolved to its tolerance \
        {epsilon:e}; expected an origin nearer to the scene"
    )]
    FarAway { diagonal: f64, largest: f64, epsilon: f64 },
    /// Start or goal in an obstacle.
    #[error("{end} ({x:.3}, {y:.3}) is {depth:.4} inside {obstacle} (robot radius included); expected a free point")]
    InsideObstacle { end: &'static str, x: f64, y: f64, depth: f64, obstacle: String },
    /// Start or goal too near the border of the field or outside.
    #[error("{end} ({x:.3}, {y:.3}) leaves the field by {depth:.4} (robot radius included); expected a point inside")]
    OutsideField { end: &'static str, x: f64, y: f64, depth: f64 },
}

impl SceneError {
    /// The part of the scene that must change.
    pub fn place(&self) -> Place {
        match self {
            Self::NotFinite { place, .. }
            | Self::NegativeRadius { place, .. }
            | Self::NoInterior { place, .. }
            | Self::Polygon { place, .. } => *place,
            Self::Name { .. } => Place { obstacle: None, key: "name" },
            Self::EmptyField { .. } => Place { obstacle: None, key: "field" },
            Self::StartIsGoal { .. } | Self::Size { .. } | Self::FarAway { .. } => {
                Place { obstacle: None, key: "start" }
            }
            Self::InsideObstacle { end, .. } | Self::OutsideField { end, .. } => Place { obstacle: None, key: end },
        }
    }
}

impl Scene {
    /// Reads a scene file. `path` is only named in errors, which give line and column.
    ///
    /// Everything that [`Scene::validate`] checks is checked, and the ends must be free.
    pub fn from_toml(path: &str, text: &str) -> Result<Self, FileError> {
        crate::scene_file::parse(path, text)
    }

    /// Writes the scene file; floats round-trip.
    pub fn to_toml(&self) -> String {
        crate::scene_file::write(self)
    }

    /// Start as a point.
    pub fn start(&self) -> Point {
        self.start.into()
    }

    /// Goal as a point.
    pub fn goal(&self) -> Point {
        self.goal.into()
    }

    /// `obstacle 3 ("opponent 3")`: how messages name obstacle `index`, counted from 0.
    pub fn describe(&self, index: usize) -> String {
        match &self.obstacles[index].label {
            Some(label) => format!("obstacle {index} (\"{label}\")"),
            None => format!("obstacle {index}"),
        }
    }

    /// The smallest box round start, goal, uninflated obstacles and field.
    pub fn aabb(&self) -> Aabb {
        let mut aabb = Aabb::of_points([&self.start(), &self.goal()]);
        for obstacle in &self.obstacles {
            match &obstacle.shape {
                Shape::Disc { centre, radius } => {
                    let c = Point::from(*centre);
                    aabb = aabb.union(Aabb { min: c, max: c }.inflated(*radius));
                }
                Shape::Capsule { from, to, radius } => {
                    aabb = aabb.union(Aabb::of_points([&(*from).into(), &(*to).into()]).inflated(*radius));
                }
                Shape::Polygon(corners) => {
                    aabb = corners.iter().fold(aabb, |b, c| b.including((*c).into()));
                }
            }
        }
        self.field.map_or(aabb, |field| aabb.union(field.into()))
    }

    /// Length tolerance ε = 1e-9 × diagonal of [`Scene::aabb`], in scene units.
    ///
    /// A path is valid when it keeps every clearance ≥ −ε.
    pub fn epsilon(&self) -> f64 {
        1e-9 * self.aabb().diagonal()
    }

    /// Whether any obstacle moves.
    pub fn moves(&self) -> bool {
        self.obstacles.iter().any(|o| o.velocity.is_some_and(|v| v != [0.0, 0.0]))
    }

    fn finite(&self, obstacle: Option<usize>, key: &'static str, values: &[f64]) -> Result<(), SceneError> {
        match values.iter().find(|v| !v.is_finite()) {
            Some(&value) => {
                Err(SceneError::NotFinite { place: Place { obstacle, key }, what: self.name_of(obstacle, key), value })
            }
            None => Ok(()),
        }
    }

    fn radius(&self, obstacle: Option<usize>, key: &'static str, value: f64) -> Result<(), SceneError> {
        self.finite(obstacle, key, &[value])?;
        if value < 0.0 {
            let place = Place { obstacle, key };
            return Err(SceneError::NegativeRadius { place, what: self.name_of(obstacle, key), value });
        }
        Ok(())
    }

    fn name_of(&self, obstacle: Option<usize>, key: &str) -> String {
        obstacle.map_or_else(|| key.to_owned(), |i| format!("{} {key}", self.describe(i)))
    }

    /// The obstacle's shape grown by the robot's radius.
    pub fn inflated(&self, index: usize) -> Result<Inflated, SceneError> {
        let at = Some(index);
        let rounded = |core: Core, radius: f64| {
            self.radius(at, "radius", radius)?;
            let radius = radius + self.robot_radius;
            if radius > 0.0 {
                return Ok(Inflated { core, radius });
            }
            let place = Place { obstacle: at, key: "radius" };
            Err(SceneError::NoInterior { place, what: self.name_of(at, "radius") })
        };
        match &self.obstacles[index].shape {
            Shape::Disc { centre, radius } => {
                self.finite(at, "centre", centre)?;
                rounded(Core::Point((*centre).into()), *radius)
            }
            Shape::Capsule { from, to, radius } => {
                self.finite(at, "from", from)?;
                self.finite(at, "to", to)?;
                rounded(Core::Segment((*from).into(), (*to).into()), *radius)
            }
            Shape::Polygon(corners) => {
                self.finite(at, "polygon", corners.as_flattened())?;
                let place = Place { obstacle: at, key: "polygon" };
                let polygon = Polygon::new(corners.iter().map(|c| (*c).into()).collect())
                    .map_err(|source| SceneError::Polygon { place, what: self.describe(index), source })?;
                Ok(Inflated { core: Core::Polygon(polygon), radius: self.robot_radius })
            }
        }
    }

    /// Checks every number and shape; says nothing about start and goal being free.
    pub fn validate(&self) -> Result<(), SceneError> {
        let printable = !self.name.trim().is_empty() && !self.name.chars().any(char::is_control);
        if !printable || self.name.chars().count() > 100 {
            return Err(SceneError::Name { name: self.name.clone() });
        }
        self.radius(None, "robot_radius", self.robot_radius)?;
        self.finite(None, "start", &self.start)?;
        self.finite(None, "goal", &self.goal)?;
        if let Some(Field { min, max }) = self.field {
            self.finite(None, "field", &[min, max].concat())?;
            let diameter = 2.0 * self.robot_radius;
            if max[0] - min[0] <= diameter || max[1] - min[1] <= diameter {
                return Err(SceneError::EmptyField { min, max, diameter });
            }
        }
        for index in 0..self.obstacles.len() {
            self.inflated(index)?;
            if let Some(velocity) = self.obstacles[index].velocity {
                self.finite(Some(index), "velocity", &velocity)?;
            }
        }
        if self.start == self.goal {
            return Err(SceneError::StartIsGoal { x: self.start[0], y: self.start[1] });
        }
        let aabb = self.aabb();
        let (diagonal, epsilon) = (aabb.diagonal(), self.epsilon());
        if !(1e-100..=1e100).contains(&diagonal) {
            return Err(SceneError::Size { diagonal });
        }
        if (self.goal() - self.start()).norm() <= epsilon {
            return Err(SceneError::StartIsGoal { x: self.start[0], y: self.start[1] });
        }
        let largest = aabb.min.coords.amax().max(aabb.max.coords.amax());
        // Distances are good to about two units in the last place of the coordinates; planners keep ε/2.
        if epsilon < 4.0 * f64::EPSILON * largest {
            return Err(SceneError::FarAway { diagonal, largest, epsilon });
        }
        Ok(())
    }

    /// [`Scene::validate`], and start and goal must be free in `world`, the scene compiled.
    pub fn validate_ends(&self, world: &World) -> Result<(), SceneError> {
        for (end, p) in [("start", self.start()), ("goal", self.goal())] {
            let outside = world.field_clearance(p);
            if outside < -world.slack() {
                return Err(SceneError::OutsideField { end, x: p.x, y: p.y, depth: -outside });
            }
            if let Some((d, index)) = world.nearest_obstacle(p)
                && d < -world.slack()
            {
                let obstacle = self.describe(index);
                return Err(SceneError::InsideObstacle { end, x: p.x, y: p.y, depth: -d, obstacle });
            }
        }
        Ok(())
    }
}
