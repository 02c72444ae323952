//! Which parts of a circle other obstacles, or the outside of the field, cover,
//! and so how far a path can follow it.

use std::f64::consts::{PI, TAU};

use env_model::{Aabb, Point, Vector};

use crate::bitangent::{NO_TURN, perp};
use crate::terrain::{BroadPhase, Piece, Site, Terrain};

/// A covered interval of a circle.
#[derive(Debug, Clone, Copy)]
struct Cover {
    /// Direction of its middle from the centre, radians in [−π, π].
    middle: f64,
    /// Half its angle.
    half: f64,
    /// Site where the piece begins that covers it; none for the outside of the field.
    by: Option<u32>,
}

/// How far one can go along a circle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    /// Angle in [0, 2π], in the circle's sense.
    pub angle: f64,
    /// Where the piece begins that ends it.
    pub by: Option<u32>,
}

impl Reach {
    /// All round.
    pub const WHOLE: Self = Self { angle: TAU, by: None };
}

/// The covers of all circles that were asked for, computed once a query.
#[derive(Debug, Default)]
pub(crate) struct Covers {
    /// Range in `list` of every site; `None` as long as nobody has asked.
    ranges: Vec<Option<(u32, u32)>>,
    list: Vec<Cover>,
    /// Buffer: where a circle crosses a piece's border.
    crossings: Vec<f64>,
}

impl Covers {
    /// Forgets all covers, of `sites` sites.
    pub fn reset(&mut self, sites: usize) {
        self.ranges.clear();
        self.ranges.resize(sites, None);
        self.list.clear();
    }

    /// How far a path that arrives on the circle of `site` with heading `u` can
    /// follow it, in the sense of `sense` = ±1.
    pub fn reach<B: BroadPhase>(&mut self, terrain: &Terrain, near: &B, site: usize, sense: f64, u: Vector) -> Reach {
        let (begin, end) = match self.ranges[site] {
            Some(range) => range,
            None => self.find(terrain, near, site),
        };
        let covers = &self.list[begin as usize..end as usize];
        if covers.is_empty() {
            return Reach::WHOLE;
        }
        let out = perp(u) * -sense;
        let at = libm::atan2(out.y, out.x);
        covers.iter().fold(Reach::WHOLE, |reach, cover| {
            let to_middle = (cover.middle - at) * sense;
            let to_middle = if to_middle < 0.0 { to_middle + TAU } else { to_middle };
            let to_middle = if to_middle >= TAU { to_middle - TAU } else { to_middle };
            // Negative: just past the border, by rounding.
            let angle = (to_middle - cover.half).max(0.0) + NO_TURN;
            if angle < reach.angle { Reach { angle, by: cover.by } } else { reach }
        })
    }

    fn find<B: BroadPhase>(&mut self, terrain: &Terrain, near: &B, site: usize) -> (u32, u32) {
        let Site { centre, radius, .. } = *terrain.site(site);
        let begin = self.list.len() as u32;
        let tolerance = terrain.tolerance();
        terrain.pieces_near(near, &Aabb { min: centre, max: centre }.inflated(radius), |first| {
            if let Some(piece) = terrain.piece(first) {
                let shallow = Piece { radius: piece.radius - tolerance, ..piece };
                let itself = first == site && piece.is_disc();
                if shallow.radius > 0.0 && !itself {
                    if piece.is_disc() {
                        self.cover_by_disc(centre, radius, &shallow, first as u32);
                    } else {
                        self.cover_by_capsule(centre, radius, &shallow, first as u32);
                    }
                }
            }
        });
        if let Some(bounds) = terrain.bounds() {
            let sides = [
                (bounds.max.x - centre.x, 0.0),
                (bounds.max.y - centre.y, 0.5 * PI),
                (centre.x - bounds.min.x, PI),
                (centre.y - bounds.min.y, -0.5 * PI),
            ];
            for (room, middle) in sides {
                if room + tolerance < radius {
                    let cosine = ((room + tolerance) / radius).max(-1.0);
                    self.list.push(Cover { middle, half: libm::acos(cosine), by: None });
                }
            }
        }
        let range = (begin, self.list.len() as u32);
        self.ranges[site] = Some(range);
        range
    }

    fn cover_by_disc(&mut self, centre: Point, r: f64, disc: &Piece, by: u32) {
        let d = disc.from - centre;
        let d2 = d.norm_squared();
        let distance = d2.sqrt();
        if distance >= r + disc.radius || distance + disc.radius <= r {
            return;
        }
        // Law of cosines; below −1 the circle lies within the disc.
        let cosine = ((r * r - disc.radius * disc.radius + d2) / (2.0 * r * distance)).clamp(-1.0, 1.0);
        self.list.push(Cover { middle: libm::atan2(d.y, d.x), half: libm::acos(cosine), by: Some(by) });
    }

    /// The circle may enter and leave a capsule twice. Its border is two arcs
    /// and two lines; between neighbouring crossings with their circles and
    /// lines the circle is covered as a whole or not at all.
    fn cover_by_capsule(&mut self, centre: Point, r: f64, piece: &Piece, by: u32) {
        if piece.core_distance(centre) >= r + piece.radius {
            return;
        }
        let Self { crossings, list, .. } = self;
        crossings.clear();
        let mut cross_at = |middle: Vector, cosine: f64| {
            if cosine.abs() <= 1.0 {
                let (at, half) = (libm::atan2(middle.y, middle.x), libm::acos(cosine));
                crossings.extend([at - half, at + half].map(|a| if a < 0.0 { a + TAU } else { a }));
            }
        };
        for end in [piece.from, piece.to] {
            let d = end - centre;
            let d2 = d.norm_squared();
            if d2 > 0.0 {
                cross_at(d, (r * r - piece.radius * piece.radius + d2) / (2.0 * r * d2.sqrt()));
            }
        }
        let normal = perp((piece.to - piece.from).normalize());
        let offset = (centre - piece.from).dot(&normal);
        for line in [-piece.radius, piece.radius] {
            cross_at(normal, (line - offset) / r);
        }
        crossings.sort_unstable_by(f64::total_cmp);
        let mut test = |from: f64, to: f64| {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let (sin, cos) = libm::sincos(middle);
            if piece.core_distance(centre + Vector::new(cos, sin) * r) < piece.radius {
                list.push(Cover { middle: if middle > PI { middle - TAU } else { middle }, half, by: Some(by) });
            }
        };
        let (Some(&first), Some(&last)) = (crossings.first(), crossings.last()) else { return test(0.0, TAU) };
        for w in crossings.windows(2) {
            test(w[0], w[1]);
        }
        test(last, first + TAU);
    }
}
