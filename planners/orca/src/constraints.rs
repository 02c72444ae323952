//! The half-planes of velocities that obstacles permit.

use env_model::geometry::closest_point;
use env_model::motion::{Limits, Mover, Side, State};
use env_model::{Aabb, Core, Inflated, Point, Vector, World};

use crate::OrcaSettings;
use crate::program::HalfPlane;

/// The half-plane of velocities that keep the robot clear of `mover`, if that one does its part: ORCA^τ (van den Berg
/// et al. 2011, section 4).
///
/// u is the least change that takes the relative velocity out of (or to the border of) the velocity obstacle of
/// horizon τ. A mate is expected to take over its share of it; anyone else nothing, and all of u is ours. Any shape is
/// seen as the disc round the nearest point of its core; from inside a polygon, as the disc round the mirror image of
/// that point, which leads out by the same way. Where robots touch already, τ is one period, as in RVO2.
pub fn of_mover(mover: &Mover<'_>, state: State, horizon: f64, period: f64, settings: &OrcaSettings) -> HalfPlane {
    let (clearance, away) = mover.shape.clearance_direction(state.position);
    // To the core, or from inside a polygon to its border.
    let distance = (clearance + mover.shape.radius).abs();
    let contact = distance - clearance;
    let to = away * -distance;
    // Robots that are nearer than their margin are not to come nearer yet.
    let radius = (contact * (1.0 + settings.margin) + mover.margin).min(distance.max(contact));
    let relative = state.velocity - mover.velocity();
    let tau = if distance > contact { horizon } else { period };
    let w = relative - to / tau;
    let (along, length) = (w.dot(&to), w.norm());
    let (direction, u) = if distance <= contact || (along < 0.0 && -along > radius * length) {
        let out = if length > 0.0 { w / length } else { Vector::x() };
        (Vector::new(out.y, -out.x), out * (radius / tau - length))
    } else {
        let leg = (distance * distance - radius * radius).max(0.0).sqrt();
        let turned = Vector::new(-to.y, to.x) * radius;
        let left = to.x * w.y - to.y * w.x > 0.0;
        let direction = (if left { to * leg + turned } else { turned - to * leg }) / (distance * distance);
        (direction, direction * relative.dot(&direction) - relative)
    };
    let share = if mover.side == Side::Mate { settings.mates_share } else { 1.0 };
    HalfPlane { point: state.velocity + u * share, direction }
}

/// What stands still, in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Towards it, a unit vector.
    pub normal: Vector,
    /// How far it is.
    pub clearance: f64,
}

impl Wall {
    /// The half-plane of velocities n·v ≤ s after which braking normal to the wall still stops before it.
    ///
    /// With b = a/√2, which two walls at a right angle have each: s Δt + s²/(2b) = clearance.
    pub fn half_plane(&self, limits: Limits, period: f64) -> HalfPlane {
        let b = limits.acceleration * std::f64::consts::FRAC_1_SQRT_2;
        let lost = b * period;
        let fastest = (lost * lost + 2.0 * b * self.clearance.max(0.0)).sqrt() - lost;
        HalfPlane { point: self.normal * fastest, direction: Vector::new(-self.normal.y, self.normal.x) }
    }
}

/// Calls `visit` with every part of the world nearer to `p` than `reach`: discs, sides of capsules and of polygons, each
/// as the wall through its nearest point (which a convex part never crosses), and the sides of the field.
pub fn for_each_wall(world: &World, p: Point, reach: f64, mut visit: impl FnMut(Wall)) {
    let mut part = |nearest: Point, radius: f64| {
        let to = nearest - p;
        let distance = to.norm();
        if distance > 0.0 && distance - radius < reach {
            visit(Wall { normal: to / distance, clearance: distance - radius });
        }
    };
    world.for_each_overlapping(&Aabb { min: p, max: p }.inflated(reach), |i| {
        let Inflated { core, radius } = &world.obstacles()[i];
        match core {
            Core::Polygon(polygon) => polygon.sides().for_each(|(a, b)| part(closest_point(p, a, b), *radius)),
            core => part(core.nearest(p), *radius),
        }
    });
    if let Some(field) = world.inner_field() {
        let (low, high) = (p - field.min, field.max - p);
        for (clearance, normal) in
            [(low.x, -Vector::x()), (low.y, -Vector::y()), (high.x, Vector::x()), (high.y, Vector::y())]
        {
            if clearance < reach {
                visit(Wall { normal, clearance });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use env_model::motion::Path;

    use super::*;

    fn plane(side: Side, velocity: Vector, theirs: Vector) -> HalfPlane {
        let mover = Mover::disc(Point::new(5.0, 0.0), 3.0, Path::Velocity(theirs), side);
        let state = State { position: Point::origin(), velocity };
        of_mover(&mover, state, 2.0, 0.1, &OrcaSettings { margin: 0.0, ..OrcaSettings::default() })
    }

    #[test]
    fn half_planes_worked_by_hand() {
        // Distance 5, radii 3: the cone's legs have the slope ±3/4. Relative velocity (4, 1): nearest is the left leg
        // (0.8, 0.6), u = ((4·0.8 + 1·0.6) 0.8 − 4, … 0.6 − 1) = (−0.96, 1.28).
        let (v, theirs) = (Vector::new(3.0, 1.0), Vector::new(-1.0, 0.0));
        let full = plane(Side::Opponent, v, theirs);
        assert!((full.direction - Vector::new(0.8, 0.6)).norm() < 1e-15);
        assert!((full.point - Vector::new(2.04, 2.28)).norm() < 1e-14, "{}", full.point);
        let half = plane(Side::Mate, v, theirs);
        assert!((half.point - Vector::new(2.52, 1.64)).norm() < 1e-14, "{}", half.point);
        // The mirror image lies on the right leg.
        let right = plane(Side::Opponent, Vector::new(3.0, -1.0), theirs);
        assert!((right.direction - Vector::new(-0.8, 0.6)).norm() < 1e-15);
        // Slow: the round end of radius 3/2 round (5/2, 0). Relative (1.1, 0) may grow less to 1, by 0.1 for each.
        let end = plane(Side::Other, Vector::new(1.1, 0.0), Vector::zeros());
        assert!((end.point - Vector::new(1.0, 0.0)).norm() < 1e-14, "{}", end.point);
        assert!(end.violation(Vector::new(0.9, 5.0)) < 0.0 && end.violation(Vector::new(1.2, -5.0)) > 0.0);
    }

    #[test]
    fn from_inside_a_polygon_the_nearest_way_leads_out() {
        let square = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]].map(Point::from).to_vec();
        let shape = Inflated { core: Core::Polygon(env_model::Polygon::new(square).unwrap()), radius: 0.5 };
        let mover =
            Mover { shape, path: Path::Velocity(Vector::zeros()), margin: 0.0, side: Side::Other, braking: None };
        let see = |x: f64| {
            let state = State { position: Point::new(x, 2.0), velocity: Vector::zeros() };
            of_mover(&mover, state, 2.0, 0.1, &OrcaSettings { margin: 0.0, ..OrcaSettings::default() })
        };
        // 0.5 before the left side and 0.5 of radius: out by 1 within the period of 0.1, to the left.
        for (x, towards) in [(0.5, -1.0), (3.5, 1.0), (-0.25, -1.0)] {
            let plane = see(x);
            assert!(plane.violation(Vector::new(11.0 * towards, 0.0)) < 0.0, "{x}: {plane:?}");
            assert!(plane.violation(Vector::zeros()) > 0.0 && plane.violation(Vector::new(-9.0 * towards, 0.0)) > 0.0);
        }
    }

    #[test]
    fn mates_who_both_obey_do_not_meet() {
        // Velocities on the borders of both half-planes: the relative velocity is on the velocity obstacle's border.
        for k in 0..200 {
            let angle = 0.0314 * f64::from(k);
            let (v, theirs) = (Vector::new(2.0 * angle.cos(), 0.3), Vector::new(-1.5, angle.sin()));
            let settings = OrcaSettings { margin: 0.0, ..OrcaSettings::default() };
            let (here, there) = (Point::origin(), Point::new(5.0, 0.0));
            let see = |centre, w, position, velocity| {
                let mover = Mover::disc(centre, 3.0, Path::Velocity(w), Side::Mate);
                of_mover(&mover, State { position, velocity }, 2.0, 0.1, &settings)
            };
            let ours = see(there, theirs, here, v);
            let other = see(here, v, there, theirs);
            // Each goes as far as its half-plane permits, in the directions of the borders alike.
            let (v, w) = (ours.point + ours.direction, other.point - other.direction);
            let relative = v - w;
            let least = (0..=2000).map(|i| (Point::from(relative * (0.001 * f64::from(i))) - there).norm());
            let least = least.fold(f64::INFINITY, f64::min);
            assert!(least >= 3.0 - 1e-9, "{k}: {least}");
        }
    }

    #[test]
    fn a_wall_can_be_stopped_before() {
        let limits = Limits::new(3.0, 2.0).unwrap();
        let wall = Wall { normal: Vector::x(), clearance: 0.5 };
        let plane = wall.half_plane(limits, 0.1);
        let s = plane.point.x;
        // Tolerance: a few roundings.
        assert!((s * 0.1 + s * s / (2.0 * 2f64.sqrt()) - 0.5).abs() < 1e-15, "{s}");
        assert!(plane.violation(Vector::new(s + 0.1, 0.0)) > 0.0);
    }
}
