//! Where a moving scene is drawn: the part of the field that its robots use, with the field's lines.

use std::fmt::Write as _;

use env_model::{Aabb, Point, Vector};
use strategy::{League, RobotRecord, Trace};

use super::super::camera::{BOTTOM, Camera, LEFT, RIGHT, TOP, WIDTH};
use super::super::svg::{clipped, escape};

/// Shown round the outermost place of any robot, in metres.
const AROUND: f64 = 0.45;
/// Half the height of a picture is at least this part of half its width: neither ribbons nor towers.
const FLATTEST: f64 = 0.5;
/// Radius of the centre circle, in metres.
const CENTRE_CIRCLE: f64 = 0.5;

/// Height of a picture below the drawing area: the scale.
pub const FOOT: f64 = BOTTOM;

/// What all pictures of one scene share.
pub struct Stage {
    /// From metres to picture units.
    pub camera: Camera,
    league: League,
}

impl Stage {
    /// Sees all that moves in `clips`.
    pub fn new<'a>(clips: impl Iterator<Item = (&'a Trace, &'a [RobotRecord])>, league: League) -> Self {
        let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut see = |p: &[f64; 2]| {
            for k in 0..2 {
                (min[k], max[k]) = (min[k].min(p[k]), max[k].max(p[k]));
            }
        };
        for (trace, robots) in clips {
            trace.frames.iter().flatten().filter(|p| p.iter().all(|v| v.is_finite())).for_each(&mut see);
            robots.iter().flat_map(|r| [&r.start, &r.goal]).for_each(&mut see);
        }
        let seen = (0..2).all(|k| min[k] <= max[k]);
        let (min, max) = if seen { (min, max) } else { ([-1.0; 2], [1.0; 2]) };
        let size = Vector::new(max[0] - min[0], max[1] - min[1]) + Vector::repeat(2.0 * AROUND);
        let (w, h) = (size.x.max(size.y), size.y.max(FLATTEST * size.x));
        let middle = Point::new(0.5 * (min[0] + max[0]), 0.5 * (min[1] + max[1]));
        let half = Vector::new(0.5 * w, 0.5 * h);
        let region = Aabb { min: middle - half, max: middle + half };
        Self { camera: Camera::of(region), league }
    }

    /// Picture coordinates of a place in metres.
    pub fn at(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        self.camera.map(Point::new(x, y))
    }

    /// A length in picture units.
    pub fn length(&self, metres: f64) -> f64 {
        metres * self.camera.scale
    }

    /// The view box of a picture.
    pub fn view(&self) -> String {
        // Without numbers on the left the margin there is as wide as on the right.
        let left = LEFT - RIGHT;
        format!("{left} 0 {} {:.0}", WIDTH + 2.0 * RIGHT, TOP + self.camera.height() + FOOT)
    }

    /// Ground, lines and scale; `id` is unique in the page.
    pub fn backdrop(&self, id: &str) -> String {
        let h = self.camera.height();
        let mut out = format!(r#"<rect class="ground" x="{LEFT}" y="{TOP}" width="{WIDTH}" height="{h:.1}"/>"#);
        out += &clipped(id, &self.camera, &self.lines());
        let (y, metre) = (TOP + h + 15.0, self.length(1.0));
        let _ = write!(
            out,
            r#"<path class="edge" d="M{LEFT} {:.1}v6v-3h{metre:.1}v-3v6"/><text class="unit" x="{:.1}" y="{:.1}">{}</text>"#,
            y - 3.0,
            LEFT + metre + 8.0,
            y + 5.0,
            escape("1\u{a0}m")
        );
        out
    }

    /// Touch and goal lines, halfway line, centre circle and defence areas.
    fn lines(&self) -> String {
        let [x, y] = self.league.half_size();
        let [deep, wide] = self.league.defence_area();
        let rectangle = |a: [f64; 2], b: [f64; 2]| {
            let ((x0, y0), (x1, y1)) = (self.at(a), self.at(b));
            format!("M{x0:.1} {y0:.1}H{x1:.1}V{y1:.1}H{x0:.1}z")
        };
        let (cx, cy) = self.at([0.0, 0.0]);
        let half = self.length(y);
        let halfway = format!("M{cx:.1} {:.1}v{:.1}", cy - half, 2.0 * half);
        let lines = [
            rectangle([-x, y], [x, -y]),
            halfway,
            rectangle([-x, 0.5 * wide], [deep - x, -0.5 * wide]),
            rectangle([x - deep, 0.5 * wide], [x, -0.5 * wide]),
        ];
        format!(
            r#"<path class="lines" d="{}"/><circle class="lines" cx="{cx:.1}" cy="{cy:.1}" r="{:.1}"/>"#,
            lines.concat(),
            self.length(CENTRE_CIRCLE)
        )
    }
}
