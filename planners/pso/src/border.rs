//! The end of every move: speed limit, new position, border of the search rectangle.
//!
//! Common to all update rules: x ← x + v with |v| ≤ the limit, then what
//! [`Bounds`] says of particles past |y'| = H.

use pulp::{Simd, WithSimd};

use crate::choices::Bounds;
use crate::swarm::{Ground, Swarm};

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
    pub fn advance<S: Simd>(self, simd: S, x: S::f64s, v: S::f64s) -> (S::f64s, S::f64s) {
        let splat = |value: f64| simd.splat_f64s(value);
        let clamp = |value, limit: f64| simd.max_f64s(simd.min_f64s(value, splat(limit)), splat(-limit));
        let v = clamp(v, self.max_speed);
        let flown = simd.add_f64s(x, v);
        if matches!(self.bounds, Bounds::None | Bounds::Invisible) {
            return (flown, v);
        }
        let clipped = clamp(flown, self.half_width);
        let within = simd.equal_f64s(clipped, flown);
        match self.bounds {
            Bounds::None | Bounds::Invisible | Bounds::Clip => (clipped, v),
            Bounds::Stop => (clipped, simd.select_f64s(within, v, splat(0.0))),
            Bounds::Rebound => (clipped, simd.select_f64s(within, v, simd.mul_f64s(splat(-0.5), v))),
            Bounds::Reflect => {
                let mirrored = simd.sub_f64s(simd.add_f64s(clipped, clipped), flown);
                (clamp(mirrored, self.half_width), simd.select_f64s(within, v, simd.neg_f64s(v)))
            }
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

impl WithSimd for Advance<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Swarm { x, v, .. } = self.swarm;
        for (x, v) in S::as_mut_simd_f64s(x).0.iter_mut().zip(S::as_mut_simd_f64s(v).0) {
            (*x, *v) = self.border.advance(simd, *x, *v);
        }
    }
}
