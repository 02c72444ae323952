//! The end of every move: speed limit, new position, border of the search rectangle.
//!
//! Common to all update rules: x ← x + v with |v| ≤ the limit, then what
//! [`Bounds`] says of particles past |y'| = H.

use crate::choices::Bounds;
use crate::swarm::{Ground, Swarm};
use crate::width::{Kernel, Vectors};

/// Where particles may be and how fast they may fly.
#[derive(Debug, Clone, Copy)]
pub struct Border {
    /// What happens at the border.
    pub bounds: Bounds,
    /// H, scene units.
    pub half_width: f64,
    /// Largest speed a dimension, scene units an iteration; may be +∞.
    pub max_speed: f64,
}

impl Border {
    /// That of a run.
    pub fn of(ground: Ground<'_>) -> Self {
        let half_width = ground.columns.half_width();
        Self {
            bounds: ground.settings.bounds.unwrap_or_default(),
            half_width,
            max_speed: ground.settings.max_speed(half_width),
        }
    }

    /// (new position, new velocity) of particles at `x` that want to fly with `v`.
    #[inline(always)]
    pub fn advance<V: Vectors>(self, unit: V, x: V::f64s, v: V::f64s) -> (V::f64s, V::f64s) {
        let splat = |value: f64| unit.splat_f64s(value);
        let clamp = |value, limit: f64| unit.max_f64s(unit.min_f64s(value, splat(limit)), splat(-limit));
        let v = clamp(v, self.max_speed);
        let flown = unit.add_f64s(x, v);
        if matches!(self.bounds, Bounds::None | Bounds::Invisible) {
            return (flown, v);
        }
        let clipped = clamp(flown, self.half_width);
        let within = unit.equal_f64s(clipped, flown);
        // Tests instead of a `match`: the default comes first, and no table of jumps.
        if self.bounds == Bounds::Stop {
            (clipped, unit.select_f64s(within, v, splat(0.0)))
        } else if self.bounds == Bounds::Rebound {
            (clipped, unit.select_f64s(within, v, unit.mul_f64s(splat(-0.5), v)))
        } else if self.bounds == Bounds::Reflect {
            let mirrored = unit.sub_f64s(unit.add_f64s(clipped, clipped), flown);
            (clamp(mirrored, self.half_width), unit.select_f64s(within, v, unit.neg_f64s(v)))
        } else {
            (clipped, v)
        }
    }
}

/// Advances all particles with the velocities they have.
pub struct Advance<'a> {
    /// The swarm.
    pub swarm: &'a mut Swarm,
    /// Where it may fly.
    pub border: Border,
}

impl Kernel for Advance<'_> {
    #[inline(always)]
    fn run<V: Vectors>(self, unit: V) {
        let Swarm { x, v, .. } = self.swarm;
        for (x, v) in V::as_mut_simd_f64s(x).0.iter_mut().zip(V::as_mut_simd_f64s(v).0) {
            (*x, *v) = self.border.advance(unit, *x, *v);
        }
    }
}
