//! The independent judge: is a path valid, and how near does it come?
//!
//! It shares nothing with the planners but the scene (and its ε). Shapes and
//! distances are parry's, every obstacle is tried (no broad phase), inflation is
//! the judge's own. parry compares with absolute tolerances, so it gets to see
//! the scene from the start, scaled by a power of two to a common size: that
//! changes no digit but the exponent's.
//!
//! A path is valid when it starts and ends exactly at start and goal, every
//! segment keeps a distance of at least (inflated radius − ε) from every
//! obstacle, and the robot's whole disc stays inside the field but for ε, with
//! ε = [`Scene::epsilon`]. A comparison with NaN is never a pass.

mod body;

use std::fmt;

use env_model::{Point, Scene, Shape};
use parry2d_f64::math::Vector;

use body::Body;

/// Judges paths in one scene.
pub struct Judge<'s> {
    scene: &'s Scene,
    bodies: Vec<Body>,
    epsilon: f64,
    lens: Lens,
}

/// From scene coordinates to those that parry computes in.
#[derive(Clone, Copy)]
struct Lens {
    origin: [f64; 2],
    scale: f64,
}

impl Lens {
    /// Sees the scene from its start, its diagonal between 2¹⁰ and 2¹¹.
    fn new(scene: &Scene) -> Self {
        let exponent = scene.aabb().diagonal().log2().floor();
        Self { origin: scene.start, scale: (10.0 - exponent).exp2() }
    }

    fn see(&self, [x, y]: [f64; 2]) -> Vector {
        Vector::new((x - self.origin[0]) * self.scale, (y - self.origin[1]) * self.scale)
    }

    fn segment(&self, w: &[Point]) -> (Vector, Vector) {
        (self.see([w[0].x, w[0].y]), self.see([w[1].x, w[1].y]))
    }
}

/// Why a path is not valid.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault {
    /// There is no path (fewer than two points).
    NoPath,
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Index of the point.
        point: usize,
    },
    /// The first point is not exactly the start.
    WrongStart(Point),
    /// The last point is not exactly the goal.
    WrongGoal(Point),
    /// The robot's disc leaves the field.
    Field {
        /// Index of the segment.
        segment: usize,
    },
    /// The robot's disc enters an obstacle.
    Obstacle {
        /// Index of the segment.
        segment: usize,
        /// How the scene names the obstacle.
        obstacle: String,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPath => write!(f, "there is no path"),
            Self::NotFinite { point } => write!(f, "point {point} of the path is not finite"),
            Self::WrongStart(p) => write!(f, "the path begins at ({}, {}), not at the start", p.x, p.y),
            Self::WrongGoal(p) => write!(f, "the path ends at ({}, {}), not at the goal", p.x, p.y),
            Self::Field { segment } => write!(f, "segment {segment} leaves the field"),
            Self::Obstacle { segment, obstacle } => write!(f, "segment {segment} enters {obstacle}"),
        }
    }
}

impl<'s> Judge<'s> {
    /// The judge of a scene whose numbers are finite ([`Scene::validate`]).
    pub fn new(scene: &'s Scene) -> Self {
        let lens = Lens::new(scene);
        let grown = |radius: f64| (radius + scene.robot_radius) * lens.scale;
        let bodies = scene.obstacles.iter().map(|o| match &o.shape {
            Shape::Disc { centre, radius } => Body::disc(lens.see(*centre), grown(*radius)),
            Shape::Capsule { from, to, radius } => Body::capsule(lens.see(*from), lens.see(*to), grown(*radius)),
            Shape::Polygon(corners) => Body::polygon(corners.iter().map(|c| lens.see(*c)).collect(), grown(0.0)),
        });
        Self { scene, bodies: bodies.collect(), epsilon: scene.epsilon(), lens }
    }

    /// The verdict: `Ok` for a valid path, else its first fault. O(segments × corners of all obstacles).
    pub fn verdict(&self, path: &[Point]) -> Result<(), Fault> {
        if let Some(point) = path.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
            return Err(Fault::NotFinite { point });
        }
        if path.len() < 2 {
            return Err(Fault::NoPath);
        }
        let (first, last) = (path[0], path[path.len() - 1]);
        if [first.x, first.y] != self.scene.start {
            return Err(Fault::WrongStart(first));
        }
        if [last.x, last.y] != self.scene.goal {
            return Err(Fault::WrongGoal(last));
        }
        for (segment, w) in path.windows(2).enumerate() {
            if !(self.border(w[0]) >= -self.epsilon && self.border(w[1]) >= -self.epsilon) {
                return Err(Fault::Field { segment });
            }
            let (a, b) = self.lens.segment(w);
            let epsilon = self.epsilon * self.lens.scale;
            if let Some(index) = self.bodies.iter().position(|body| !body.lets_pass(a, b, epsilon)) {
                return Err(Fault::Obstacle { segment, obstacle: self.scene.describe(index) });
            }
        }
        Ok(())
    }

    /// Least signed clearance of the path to an inflated obstacle or to the border of the field, in
    /// scene units; `None` without a path or where there is nothing to keep clear of.
    ///
    /// Inside a non-convex polygon the depth is the distance to its nearest side.
    pub fn clearance(&self, path: &[Point]) -> Option<f64> {
        if path.len() < 2 || (self.bodies.is_empty() && self.scene.field.is_none()) {
            return None;
        }
        let border = path.iter().map(|p| self.border(*p)).fold(f64::INFINITY, f64::min);
        let bodies = path.windows(2).flat_map(|w| {
            let (a, b) = self.lens.segment(w);
            self.bodies.iter().map(move |body| body.clearance(a, b) / self.lens.scale)
        });
        Some(bodies.fold(border, f64::min))
    }

    /// How far the robot's disc at `p` stays inside the field, negative outside; +∞ without a field.
    /// The field is convex: the ends of a segment decide.
    fn border(&self, p: Point) -> f64 {
        self.scene.field.map_or(f64::INFINITY, |field| {
            let sides = [p.x - field.min[0], p.y - field.min[1], field.max[0] - p.x, field.max[1] - p.y];
            sides.into_iter().fold(f64::INFINITY, f64::min) - self.scene.robot_radius
        })
    }
}

#[cfg(test)]
mod tests;
