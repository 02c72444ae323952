//! A scene compiled for its robot: exact continuous collision behind a broad phase.

use crate::bvh::{Bvh, touching};
use crate::near::{Few, Near};
use crate::{Aabb, Inflated, Point, Scene, SceneError};

/// A compiled scene: inflated obstacles, broad phase, tolerance. Immutable.
///
/// Clearances are signed and in scene units: positive outside, 0 touching,
/// negative inside. The field counts like an obstacle round everything.
#[derive(Debug, Clone)]
pub struct World {
    obstacles: Vec<Inflated>,
    labels: Vec<Option<String>>,
    bvh: Bvh,
    near: Near,
    /// Where the robot's centre may be.
    inner_field: Option<Aabb>,
    aabb: Aabb,
    epsilon: f64,
}

/// Where a path first enters an obstacle or leaves the field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Violation {
    /// The segment, counted from 0.
    pub segment: usize,
    /// Where it enters.
    pub at: Point,
    /// The obstacle, counted from 0; `None` for the border of the field.
    pub obstacle: Option<usize>,
    /// The deepest that this segment goes into it, in scene units, > 0.
    pub depth: f64,
}

impl World {
    /// Compiles a scene. Start and goal need not be free.
    pub fn new(scene: &Scene) -> Result<Self, SceneError> {
        scene.validate()?;
        let obstacles = (0..scene.obstacles.len()).map(|i| scene.inflated(i)).collect::<Result<Vec<_>, _>>()?;
        let epsilon = scene.epsilon();
        // Grown by ε, so that rounding in box tests never hides an obstacle.
        let boxes: Vec<Aabb> = obstacles.iter().map(|o| o.aabb().inflated(epsilon)).collect();
        let field = scene.field.map(Aabb::from);
        let bvh = Bvh::build(&boxes);
        Ok(Self {
            near: Near::new(&obstacles, &boxes, &bvh, 0.5 * epsilon),
            bvh,
            obstacles,
            labels: scene.obstacles.iter().map(|o| o.label.clone()).collect(),
            inner_field: field.map(|f| f.inflated(-scene.robot_radius)),
            aabb: scene.aabb(),
            epsilon,
        })
    }

    /// The same world with more obstacles after its own, inflated already and unlabelled; its tolerance stays.
    #[must_use]
    pub fn with_obstacles(&self, more: impl IntoIterator<Item = Inflated>) -> Self {
        let mut obstacles = self.obstacles.clone();
        obstacles.extend(more);
        let mut labels = self.labels.clone();
        labels.resize(obstacles.len(), None);
        let boxes: Vec<Aabb> = obstacles.iter().map(|o| o.aabb().inflated(self.epsilon)).collect();
        let bvh = Bvh::build(&boxes);
        Self {
            near: Near::new(&obstacles, &boxes, &bvh, self.slack()),
            aabb: boxes.iter().fold(self.aabb, |all, b| all.union(*b)),
            bvh,
            obstacles,
            labels,
            ..*self
        }
    }

    /// The inflated obstacles, in the scene's order.
    pub fn obstacles(&self) -> &[Inflated] {
        &self.obstacles
    }

    /// What the scene calls an obstacle, e.g. `"opponent 3"`.
    pub fn label(&self, obstacle: usize) -> Option<&str> {
        self.labels[obstacle].as_deref()
    }

    /// The scene's tolerance ε, in scene units: see [`Scene::epsilon`].
    pub fn epsilon(&self) -> f64 {
        self.epsilon
    }

    /// Penetration that planners may ignore, ε/2: what [`World::segment_free`]
    /// accepts stays valid for the judge, who allows ε, after rounding.
    pub fn slack(&self) -> f64 {
        0.5 * self.epsilon
    }

    /// Where the robot's centre may be: the field less the robot's radius.
    pub fn inner_field(&self) -> Option<&Aabb> {
        self.inner_field.as_ref()
    }

    /// The region that planners which need an extent search: where the robot's
    /// centre may be, or without a field the box round start, goal and
    /// obstacles plus 25 % of its size (half on either side).
    pub fn extent(&self) -> Aabb {
        self.inner_field.unwrap_or_else(|| {
            let margin = self.aabb.size() * 0.125;
            Aabb { min: self.aabb.min - margin, max: self.aabb.max + margin }
        })
    }

    /// Clearance of `p` to the border of the field; +∞ without a field.
    pub fn field_clearance(&self, p: Point) -> f64 {
        self.inner_field.map_or(f64::INFINITY, |f| f.depth_of(p))
    }

    /// The obstacle with the least clearance at `p`, and that clearance. O(log n) for spread-out obstacles.
    pub fn nearest_obstacle(&self, p: Point) -> Option<(f64, usize)> {
        let at = Aabb { min: p, max: p };
        self.bvh.least_clearance(&at, |i| self.obstacles[i].point_clearance(p))
    }

    /// Signed clearance at `p`: d = minᵢ dᵢ(p), the field included; +∞ in an empty world.
    pub fn point_clearance(&self, p: Point) -> f64 {
        self.nearest_obstacle(p).map_or(f64::INFINITY, |(d, _)| d).min(self.field_clearance(p))
    }

    /// Whether the robot may stand at `p` (clearance ≥ −ε/2).
    pub fn point_free(&self, p: Point) -> bool {
        self.segment_free(p, p)
    }

    /// Whether the robot may move along `a b`: clearance ≥ −ε/2 on the whole segment.
    /// Never when a coordinate is not finite.
    pub fn segment_free(&self, a: Point, b: Point) -> bool {
        let d = b - a;
        if !(d.x + d.y).is_finite() {
            return false;
        }
        let region = Aabb::of_segment(a, b);
        // The field is convex: the corners of the segment's box decide.
        if let Some(field) = &self.inner_field {
            let (low, high) = (region.min - field.min, field.max - region.max);
            let most = -self.slack();
            if !((low.x >= most) & (low.y >= most) & (high.x >= most) & (high.y >= most)) {
                return false;
            }
        }
        match &self.near {
            Near::Few(few) => match few.meeting(&region) {
                0 => true,
                near => !self.enters_few(few, near, a, b),
            },
            Near::Many(discs, rest) => !discs.any_entered(a, b, &region) && !self.enters_any(rest, a, b),
            Near::Tree => !self.enters_any(&self.bvh, a, b),
        }
    }

    // Apart from `segment_free`, whose short way needs few registers and no stack.
    #[inline(never)]
    fn enters_few(&self, few: &Few, near: u64, a: Point, b: Point) -> bool {
        few.any_entered(near, a, b, |k| self.enters(self.bvh.items()[k] as usize, a, b))
    }

    #[inline(never)]
    fn enters_any(&self, tree: &Bvh, a: Point, b: Point) -> bool {
        tree.any_along(a, b, |i| self.enters(i, a, b))
    }

    #[inline(never)]
    fn enters(&self, obstacle: usize, a: Point, b: Point) -> bool {
        !self.obstacles[obstacle].segment_free(a, b, self.slack())
    }

    /// Least signed clearance over the points of segment `a b`, the field included.
    pub fn segment_clearance(&self, a: Point, b: Point) -> f64 {
        let region = Aabb::of_points([&a, &b]);
        let border = self.field_clearance(a).min(self.field_clearance(b));
        self.bvh
            .least_clearance(&region, |i| self.obstacles[i].segment_clearance(a, b))
            .map_or(f64::INFINITY, |(d, _)| d)
            .min(border)
    }

    /// Whether every segment of `path` is free.
    pub fn path_free(&self, path: &[Point]) -> bool {
        path.windows(2).all(|w| self.segment_free(w[0], w[1]))
    }

    /// Calls `visit` with the index of every obstacle whose box overlaps `region`.
    pub fn for_each_overlapping(&self, region: &Aabb, mut visit: impl FnMut(usize)) {
        let mut every = |i| {
            visit(i);
            false
        };
        if let Near::Few(few) = &self.near {
            few.any(region, |aabb| region.overlaps(aabb), |k| every(self.bvh.items()[k] as usize));
        } else {
            self.bvh.any_overlapping(region, every);
        }
    }

    /// Calls `visit` with the index of every obstacle whose box the segment `a b` may touch.
    pub fn for_each_along(&self, a: Point, b: Point, mut visit: impl FnMut(usize)) {
        self.any_along(a, b, |i| {
            visit(i);
            false
        });
    }

    /// Whether `test` holds for the index of an obstacle whose box the segment `a b` may touch; asks no
    /// further once it does.
    pub fn any_along(&self, a: Point, b: Point, mut test: impl FnMut(usize) -> bool) -> bool {
        if let Near::Few(few) = &self.near {
            let region = Aabb::of_points([&a, &b]);
            few.any(&region, touching(a, b), |k| test(self.bvh.items()[k] as usize))
        } else {
            self.bvh.any_along(a, b, test)
        }
    }

    /// Calls `visit` with the index of every obstacle whose box may touch the rectangle with the axis
    /// `a b`, a ≠ b, and `half_width` (perhaps +∞) to either side.
    pub fn for_each_beside(&self, a: Point, b: Point, half_width: f64, mut visit: impl FnMut(usize)) {
        self.bvh.any_beside(a, b, half_width, |i| {
            visit(i);
            false
        });
    }

    /// Where `path` first goes deeper than ε into an obstacle or over the border; `None` for a valid path.
    /// A point that is not finite is outside everything: depth +∞, no obstacle.
    pub fn first_violation(&self, path: &[Point]) -> Option<Violation> {
        path.windows(2).enumerate().find_map(|(segment, w)| {
            let lost = w.iter().find(|p| !(p.x.is_finite() && p.y.is_finite()));
            match lost {
                Some(&at) => Some(Violation { segment, at, obstacle: None, depth: f64::INFINITY }),
                None => self.segment_violation(segment, w[0], w[1]),
            }
        })
    }

    fn segment_violation(&self, segment: usize, a: Point, b: Point) -> Option<Violation> {
        let mut first: Option<(f64, Violation)> = None;
        let mut consider = |obstacle: Option<usize>, prefix: &dyn Fn(Point) -> f64| {
            let least = prefix(b);
            if least >= -self.epsilon {
                return;
            }
            // The least clearance over a prefix of the segment never rises with
            // the prefix, so bisection finds where it first drops below −ε.
            let (mut lo, mut hi) = (0.0, 1.0);
            if prefix(a) < -self.epsilon {
                hi = 0.0;
            }
            while hi - lo > 1e-15 {
                let mid = 0.5 * (lo + hi);
                if prefix(a + (b - a) * mid) < -self.epsilon { hi = mid } else { lo = mid }
            }
            if first.as_ref().is_none_or(|(t, _)| hi < *t) {
                first = Some((hi, Violation { segment, at: a + (b - a) * hi, obstacle, depth: -least }));
            }
        };
        consider(None, &|q| self.field_clearance(a).min(self.field_clearance(q)));
        // Ascending order, so that ties go to the lower index whatever the tree.
        let mut near = Vec::new();
        self.for_each_along(a, b, |i| near.push(i));
        near.sort_unstable();
        for i in near {
            consider(Some(i), &|q| self.obstacles[i].segment_clearance(a, q));
        }
        first.map(|(_, violation)| violation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Obstacle;

    fn paper() -> Scene {
        Scene {
            name: "paper".into(),
            unit: "cm".into(),
            robot_radius: 0.0,
            start: [200.0, 150.0],
            goal: [400.0, 260.0],
            field: None,
            obstacles: [[240.0, 160.0], [280.0, 200.0], [320.0, 230.0]]
                .map(|c| Obstacle::disc(c.into(), 16.0))
                .to_vec(),
        }
    }

    #[test]
    fn straight_line_of_the_paper_hits_the_first_disc() {
        let scene = paper();
        let world = World::new(&scene).unwrap();
        let v = world.first_violation(&[scene.start(), scene.goal()]).unwrap();
        assert_eq!((v.segment, v.obstacle), (0, Some(0)));
        assert!((world.obstacles()[0].point_clearance(v.at)).abs() < 1e-6);
        assert!(!world.segment_free(scene.start(), scene.goal()));
        // Entered first, but not deepest: the line passes 15.3 from the centre of disc 0.
        let depth = -world.obstacles()[0].segment_clearance(scene.start(), scene.goal());
        assert_eq!(v.depth, depth);
        let deepest = world.obstacles().iter().map(|o| o.segment_clearance(scene.start(), scene.goal()));
        assert_eq!(world.segment_clearance(scene.start(), scene.goal()), deepest.fold(f64::INFINITY, f64::min));
    }

    #[test]
    fn grazing_touching_zero_length_and_start_inside() {
        let scene = paper();
        let world = World::new(&scene).unwrap();
        let p = Point::new;
        assert!(world.segment_free(p(200.0, 176.0), p(239.0, 176.0)), "grazing the top of disc 0");
        assert!(!world.segment_free(p(200.0, 175.999), p(250.0, 175.999)));
        assert!(world.segment_free(p(200.0, 160.0), p(224.0, 160.0)), "ending on its border");
        assert!(world.segment_free(p(224.0, 160.0), p(224.0, 160.0)), "zero length on its border");
        assert!(!world.segment_free(p(240.0, 161.0), p(240.0, 161.0)), "zero length inside");
        let v = world.first_violation(&[p(240.0, 160.0), p(0.0, 160.0)]).unwrap();
        assert_eq!((v.at, v.depth), (p(240.0, 160.0), 16.0), "start inside");
    }

    #[test]
    fn what_is_not_finite_is_not_free() {
        let scene = paper();
        let world = World::new(&scene).unwrap();
        for lost in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let p = Point::new(lost, 0.0);
            assert!(!world.segment_free(scene.start(), p) && !world.segment_free(p, p));
            assert!(!world.path_free(&[scene.start(), p, scene.goal()]));
            assert!(world.first_violation(&[scene.start(), p, scene.goal()]).is_some());
        }
    }

    #[test]
    fn scenes_that_floating_point_cannot_carry_are_refused() {
        use crate::SceneError;
        let moved = |factor: f64, offset: f64| {
            let mut scene = paper();
            scene.obstacles.clear();
            for end in [&mut scene.start, &mut scene.goal] {
                *end = end.map(|v| v * factor + offset);
            }
            scene.validate()
        };
        assert_eq!(moved(1.0, 0.0), Ok(()));
        assert_eq!(moved(1e-6, 0.0), Ok(()));
        assert_eq!(moved(1.0, 1e8), Ok(()));
        assert!(matches!(moved(1.0, 1e10), Err(SceneError::FarAway { .. })));
        assert!(matches!(moved(1e-160, 0.0), Err(SceneError::Size { .. })));
        assert!(matches!(moved(1e160, 0.0), Err(SceneError::Size { .. })));
    }

    #[test]
    fn leaving_the_field_is_a_violation_for_the_whole_disc() {
        let mut scene = paper();
        scene.robot_radius = 2.0;
        scene.field = Some(crate::scene::Field { min: [0.0, 0.0], max: [600.0, 400.0] });
        let world = World::new(&scene).unwrap();
        let p = Point::new;
        assert!(world.segment_free(p(2.0, 2.0), p(2.0, 398.0)));
        let v = world.first_violation(&[p(100.0, 10.0), p(100.0, 1.0)]).unwrap();
        assert_eq!((v.obstacle, v.depth), (None, 1.0));
        assert!((v.at.y - 2.0).abs() < 1e-5);
    }
}
