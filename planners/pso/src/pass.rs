//! One fused pass of moving and evaluating: the swarm's inner loop.
//!
//! Written once for any vector unit. Particles sit in lanes, and no lane looks at
//! another. A vector of particles goes through all columns before the next one
//! starts, so that its generators, the left ends of its segments and its sums stay
//! in registers.

use std::ops::Range;

use crate::border::Border;
use crate::choices::{Bounds, RandomNumbers};
use crate::lanes::Generator;
use crate::rules::Weights;
use crate::swarm::{Ground, Swarm};
use crate::terrain::{Gap, Other, Strip, StripDisc, Terrain, hits_other};
use crate::width::{Kernel, Vectors};

/// Moves all particles, by the rule of inertia if told to, writes their costs, and
/// keeps what is better than their personal bests.
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

impl<const OTHERS: bool> Kernel for Pass<'_, OTHERS> {
    #[inline(always)]
    fn run<V: Vectors>(mut self, unit: V) {
        let (lanes, half) = (V::F64_LANES, <V::Half as pulp::Simd>::F64_LANES);
        let (whole, left) = (self.swarm.particles / lanes, self.swarm.particles % lanes);
        // Twenty particles on eight lanes: two vectors, and one of half the width.
        let halves = half < lanes && (1..=half).contains(&left);
        self.sweep(unit, 0..if halves || left == 0 { whole } else { whole + 1 });
        if halves {
            let first = whole * (lanes / half);
            self.sweep(unit.half(), first..first + 1);
        }
    }
}

impl<const OTHERS: bool> Pass<'_, OTHERS> {
    /// The pass over some vectors of particles.
    #[inline(always)]
    fn sweep<V: Vectors>(&mut self, unit: V, vectors: Range<usize>) {
        let Self { swarm, ground, motion } = self;
        let dims = swarm.dims;
        let Swarm { x, v, best, best_cost, global, social, cost, improved, rng, stride, neighbours, .. } = &mut **swarm;
        let row = *stride / V::F64_LANES;
        let x = V::as_mut_simd_f64s(x).0;
        let v = V::as_mut_simd_f64s(v).0;
        let best = V::as_mut_simd_f64s(best).0;
        let best_cost = V::as_mut_simd_f64s(best_cost).0;
        let social = V::as_simd_f64s(social).0;
        let cost = V::as_mut_simd_f64s(cost).0;
        let improved = V::as_mut_simd_f64s(improved).0;
        let (s0, s1) = rng.states::<V>();

        let splat = |value: f64| unit.splat_f64s(value);
        let motion = motion.map(|(weights, border)| (weights.for_words(), border));
        let local = !neighbours.leaders.is_empty();
        let per_particle = ground.settings.random_numbers.unwrap_or_default() == RandomNumbers::PerParticle;
        let hidden = ground.settings.bounds.unwrap_or_default() == Bounds::Invisible;
        let half_width = splat(ground.columns.half_width());
        let zero = splat(0.0);
        let (behind, ahead) = ground.terrain.strips.split_at(dims);

        for c in vectors {
            let mut generator = Generator::<V> { s0: s0[c], s1: s1[c] };
            let mut numbers = (zero, zero);
            if per_particle && motion.is_some() {
                numbers = generator.next_halves(unit);
            }
            let mut flight = Flight::<V, OTHERS>::begin(unit, ground, best_cost[c]);
            let mut outside = unit.less_than_f64s(zero, zero);
            let own = x.chunks_exact_mut(row).zip(v.chunks_exact_mut(row)).zip(best.chunks_exact(row));
            let shared = global.iter().zip(social.chunks_exact(row)).zip(behind);
            // Evaluation runs one column behind: both then have work while the other waits for a result.
            let mut height = zero;
            for (((x, v), best), ((global, social), strip)) in own.zip(shared) {
                let mut x_at = x[c];
                if let Some((weights, border)) = &motion {
                    if !per_particle {
                        numbers = generator.next_halves(unit);
                    }
                    let attractor = if local { social[c] } else { splat(*global) };
                    let v_at = weights.velocity(unit, numbers, (x_at, v[c]), (best[c], attractor));
                    (x_at, v[c]) = border.advance(unit, x_at, v_at);
                    x[c] = x_at;
                }
                if hidden {
                    outside = unit.or_m64s(outside, unit.greater_than_f64s(unit.abs_f64s(x_at), half_width));
                }
                flight.proceed(unit, strip, height);
                height = x_at;
            }
            for strip in ahead {
                flight.proceed(unit, strip, height);
                height = zero;
            }
            (s0[c], s1[c]) = (generator.s0, generator.s1);

            cost[c] = unit.select_f64s(outside, splat(f64::INFINITY), flight.cost);
            let better = unit.less_than_f64s(cost[c], best_cost[c]);
            improved[c] = unit.select_f64s(better, splat(1.0), zero);
            if unit.any(better) {
                best_cost[c] = unit.select_f64s(better, cost[c], best_cost[c]);
                for (best, x) in best.chunks_exact_mut(row).zip(x.chunks_exact(row)) {
                    best[c] = unit.select_f64s(better, x[c], best[c]);
                }
            }
        }
    }
}

/// A vector of particles' paths, evaluated strip by strip.
struct Flight<'a, V: Vectors, const OTHERS: bool> {
    ground: Ground<'a>,
    /// What the strips ahead have.
    discs: &'a [StripDisc],
    gaps: &'a [Gap],
    others: &'a [Other],
    /// The column that comes next; 0 is the start.
    next: usize,
    /// Heights on its left column, and which lanes are inside a disc there, or off the field.
    left: V::f64s,
    left_hit: V::m64s,
    /// The personal bests' costs.
    rival: V::f64s,
    /// Cost of the strips behind; with capsules or polygons, no more than that once it exceeds `rival`.
    cost: V::f64s,
}

impl<'a, V: Vectors, const OTHERS: bool> Flight<'a, V, OTHERS> {
    /// At the start.
    #[inline(always)]
    fn begin(unit: V, ground: &Ground<'a>, rival: V::f64s) -> Self {
        let Terrain { discs, gaps, others, .. } = ground.terrain;
        let zero = unit.splat_f64s(0.0);
        let nowhere = unit.less_than_f64s(zero, zero);
        Self { ground: *ground, discs, gaps, others, next: 0, left: zero, left_hit: nowhere, rival, cost: zero }
    }

    /// Through the next strip, to the heights `right` on its right column.
    #[inline(always)]
    fn proceed(&mut self, unit: V, strip: &Strip, right: V::f64s) {
        let (terrain, left) = (self.ground.terrain, self.left);
        let splat = |value: f64| unit.splat_f64s(value);
        let (dx, zero) = (splat(terrain.dx), splat(0.0));

        let mut right_hit = unit.less_than_f64s(zero, zero);
        for gap in next(&mut self.gaps, strip.gaps) {
            let off = unit.abs_f64s(unit.sub_f64s(right, splat(gap.cy)));
            right_hit = unit.or_m64s(right_hit, unit.less_than_f64s(off, splat(gap.half)));
        }
        if terrain.has_field {
            let (low, high) = strip.inside;
            right_hit = unit.or_m64s(right_hit, unit.less_than_f64s(right, splat(low)));
            right_hit = unit.or_m64s(right_hit, unit.greater_than_f64s(right, splat(high)));
        }

        let dy = unit.sub_f64s(right, left);
        let length2 = unit.add_f64s(splat(strip.dx2), unit.mul_f64s(dy, dy));
        let mut hit = unit.or_m64s(self.left_hit, right_hit);
        for disc in next(&mut self.discs, strip.discs) {
            // f is the centre seen from the left end; the foot of its perpendicular lies inside
            // the segment when 0 < f·d < |d|², nearer than r when (f × d)² < r²|d|².
            let fy = unit.sub_f64s(splat(disc.cy), left);
            let along = unit.add_f64s(splat(disc.fx_dx), unit.mul_f64s(fy, dy));
            let across = unit.sub_f64s(unit.mul_f64s(splat(disc.fx), dy), unit.mul_f64s(fy, dx));
            let near = unit.less_than_f64s(unit.mul_f64s(across, across), unit.mul_f64s(splat(disc.r2), length2));
            let inner = unit.and_m64s(unit.greater_than_f64s(along, zero), unit.less_than_f64s(along, length2));
            hit = unit.or_m64s(hit, unit.and_m64s(near, inner));
        }

        if OTHERS && strip.others > 0 {
            let others = next(&mut self.others, strip.others);
            // A lane that is lost anyway needs no verdict: its cost stays above its personal best.
            let open = unit.and_m64s(unit.not_m64s(hit), unit.less_than_f64s(self.cost, self.rival));
            let (low, high) = (unit.min_f64s(left, right), unit.max_f64s(left, right));
            let mut near = unit.less_than_f64s(zero, zero);
            for other in others {
                let below = unit.less_than_f64s(low, splat(other.high));
                near = unit.or_m64s(near, unit.and_m64s(below, unit.greater_than_f64s(high, splat(other.low))));
            }
            let ask = unit.and_m64s(open, near);
            if unit.any(ask) {
                let mut flags = unit.select_f64s(ask, splat(1.0), zero);
                let (a, b, world, columns) =
                    (lanes::<V>(&left), lanes::<V>(&right), self.ground.world, self.ground.columns);
                for (k, flag) in lanes_mut::<V>(&mut flags).iter_mut().enumerate().filter(|(_, flag)| **flag > 0.0) {
                    *flag = f64::from(hits_other(world, columns, others, self.next - 1, a[k], b[k]));
                }
                hit = unit.or_m64s(hit, unit.greater_than_f64s(flags, zero));
            }
        }
        let length = unit.sqrt_f64s(length2);
        let weighted = unit.select_f64s(hit, unit.mul_f64s(length, splat(self.ground.settings.penalty)), length);
        self.cost = unit.add_f64s(self.cost, weighted);
        (self.left, self.left_hit) = (right, right_hit);
        self.next += 1;
    }
}

/// Takes the first `count` of `list`.
#[inline(always)]
fn next<'a, T>(list: &mut &'a [T], count: usize) -> &'a [T] {
    let (first, rest) = list.split_at(count);
    *list = rest;
    first
}

/// A vector's numbers.
fn lanes<V: Vectors>(vector: &V::f64s) -> &[f64] {
    pulp::bytemuck::cast_slice(std::slice::from_ref(vector))
}

fn lanes_mut<V: Vectors>(vector: &mut V::f64s) -> &mut [f64] {
    pulp::bytemuck::cast_slice_mut(std::slice::from_mut(vector))
}
