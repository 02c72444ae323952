//! One fused pass of moving and evaluating: the swarm's inner loop.
//!
//! Written once for any vector unit; `pulp` chooses one at run time. Particles
//! sit in lanes, and no lane looks at another.

use pulp::{Simd, WithSimd};

use crate::border::Border;
use crate::choices::RandomNumbers;
use crate::rules::Weights;
use crate::swarm::{Ground, Swarm};

/// Moves all particles, by the rule of inertia if told to, and writes their costs.
///
/// `OTHERS` tells whether there are capsules or polygons: their tests are calls,
/// and a loop with calls in it cannot keep its vectors in registers.
pub struct Pass<'a, const OTHERS: bool> {
    /// The swarm.
    pub swarm: &'a mut Swarm,
    /// What stays the same during a run.
    pub ground: Ground<'a>,
    /// How to move; `None`: they are where they should be.
    pub motion: Option<(Weights, Border)>,
}

impl<const OTHERS: bool> WithSimd for Pass<'_, OTHERS> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { swarm, ground, motion } = self;
        // In locals: the compiler then knows that no store changes them.
        let dims = swarm.dims;
        let Swarm { x, v, best, global, social, cost, random, stride, neighbours, .. } = swarm;
        let width = size_of::<S::f64s>() / size_of::<f64>();
        let vectors = *stride / width;
        let x = S::as_mut_simd_f64s(x).0;
        let v = S::as_mut_simd_f64s(v).0;
        let best = S::as_simd_f64s(best).0;
        let social = S::as_simd_f64s(social).0;
        let [random1, random2] = random;
        let (random1, random2) = (S::as_simd_f64s(random1).0, S::as_simd_f64s(random2).0);
        let cost = S::as_mut_simd_f64s(cost).0;

        let splat = |value: f64| simd.splat_f64s(value);
        let (terrain, settings) = (ground.terrain, ground.settings);
        let local = !neighbours.leaders.is_empty();
        let per_particle = settings.random_numbers.unwrap_or_default() == RandomNumbers::PerParticle;
        let zero = splat(0.0);
        let (dx, dx2) = (splat(terrain.dx), splat(terrain.dx * terrain.dx));
        let penalty = splat(settings.penalty);
        let nowhere = simd.less_than_f64s(zero, zero);

        #[allow(clippy::needless_range_loop, reason = "columns of several matrices, strips one more than columns")]
        for c in 0..vectors {
            let (mut left, mut left_hit, mut sum) = (zero, nowhere, zero);
            for j in 0..=dims {
                let right = if j == dims {
                    zero
                } else {
                    let at = j * vectors + c;
                    if let Some((weights, border)) = &motion {
                        let numbers = if per_particle { c } else { at };
                        let attractor = if local { social[at] } else { splat(global[j]) };
                        let random = (random1[numbers], random2[numbers]);
                        let v_at = weights.velocity(simd, random, (x[at], v[at]), (best[at], attractor));
                        (x[at], v[at]) = border.advance(simd, x[at], v_at);
                    }
                    x[at]
                };

                // Which lanes are inside a disc, or off the field, at the right column.
                let mut right_hit = nowhere;
                for gap in terrain.gaps_right_of(j) {
                    let off = simd.abs_f64s(simd.sub_f64s(right, splat(gap.cy)));
                    right_hit = simd.or_m64s(right_hit, simd.less_than_f64s(off, splat(gap.half)));
                }
                if terrain.has_field && j < dims {
                    let (low, high) = terrain.inside[j];
                    right_hit = simd.or_m64s(right_hit, simd.less_than_f64s(right, splat(low)));
                    right_hit = simd.or_m64s(right_hit, simd.greater_than_f64s(right, splat(high)));
                }

                let dy = simd.sub_f64s(right, left);
                let length2 = simd.add_f64s(dx2, simd.mul_f64s(dy, dy));
                let mut hit = simd.or_m64s(left_hit, right_hit);
                for disc in terrain.strip(j) {
                    // f is the centre seen from the left end; the foot of its perpendicular lies inside
                    // the segment when 0 < f·d < |d|², nearer than r when (f × d)² < r²|d|².
                    let fx = splat(disc.fx);
                    let fy = simd.sub_f64s(splat(disc.cy), left);
                    let along = simd.add_f64s(simd.mul_f64s(fx, dx), simd.mul_f64s(fy, dy));
                    let across = simd.sub_f64s(simd.mul_f64s(fx, dy), simd.mul_f64s(fy, dx));
                    let near =
                        simd.less_than_f64s(simd.mul_f64s(across, across), simd.mul_f64s(splat(disc.r2), length2));
                    let inner = simd.and_m64s(simd.greater_than_f64s(along, zero), simd.less_than_f64s(along, length2));
                    hit = simd.or_m64s(hit, simd.and_m64s(near, inner));
                }
                let length = simd.sqrt_f64s(length2);
                let mut factor = simd.select_f64s(hit, penalty, splat(1.0));
                if OTHERS && terrain.has_others(j) {
                    let (a, b) = (lanes::<S>(&left), lanes::<S>(&right));
                    for (k, factor) in lanes_mut::<S>(&mut factor).iter_mut().enumerate() {
                        if terrain.hits_other(ground.world, ground.columns, j, a[k], b[k]) {
                            *factor = settings.penalty;
                        }
                    }
                }
                sum = simd.add_f64s(sum, simd.mul_f64s(factor, length));
                left = right;
                left_hit = right_hit;
            }
            cost[c] = sum;
        }
    }
}

/// Personal bests of the lanes that improved in the last pass.
pub struct KeepBetter<'a>(pub &'a mut Swarm);

impl WithSimd for KeepBetter<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Swarm { x, best, cost, best_cost, stride, .. } = self.0;
        let cost = S::as_simd_f64s(cost).0;
        let best_cost = S::as_mut_simd_f64s(best_cost).0;
        for (best, x) in best.chunks_exact_mut(*stride).zip(x.chunks_exact(*stride)) {
            let (best, x) = (S::as_mut_simd_f64s(best).0, S::as_simd_f64s(x).0);
            for (((best, x), cost), best_cost) in best.iter_mut().zip(x).zip(cost).zip(&*best_cost) {
                *best = simd.select_f64s(simd.less_than_f64s(*cost, *best_cost), *x, *best);
            }
        }
        for (best, cost) in best_cost.iter_mut().zip(cost) {
            *best = simd.min_f64s(*cost, *best);
        }
    }
}

/// A vector's numbers.
fn lanes<S: Simd>(vector: &S::f64s) -> &[f64] {
    pulp::bytemuck::cast_slice(std::slice::from_ref(vector))
}

fn lanes_mut<S: Simd>(vector: &mut S::f64s) -> &mut [f64] {
    pulp::bytemuck::cast_slice_mut(std::slice::from_mut(vector))
}
