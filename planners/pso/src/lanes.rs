//! Lane-parallel random numbers: one xoroshiro128++ (Blackman & Vigna 2021) a lane.

use planner_api::seed::splitmix64;
use pulp::{Simd, WithSimd};

/// 2⁻³²: a 32-bit word times this lies in [0, 1).
const INV_2_32: f64 = 1.0 / 4_294_967_296.0;
/// 2⁻⁵³: a 53-bit word times this lies in [0, 1).
const INV_2_53: f64 = 1.0 / 9_007_199_254_740_992.0;

/// The bits of 2⁵².
const EXPONENT: u64 = 0x4330_0000_0000_0000;

/// Lanes come in whole blocks of the widest vector unit.
pub const BLOCK: usize = 8;

/// The generators' states, one a lane.
#[derive(Debug, Clone, Default)]
pub struct Lanes {
    s0: Vec<u64>,
    s1: Vec<u64>,
}

impl Lanes {
    /// Seeds lane i with words 2i and 2i + 1 of the `SplitMix64` sequence that `state` has reached.
    pub fn seed(&mut self, state: &mut u64, lanes: usize) {
        self.s0.clear();
        self.s1.clear();
        for _ in 0..lanes {
            self.s0.push(splitmix64(state));
            self.s1.push(splitmix64(state));
        }
    }

    /// The next number of the only lane, uniform on [0, 1).
    pub fn one(&mut self) -> f64 {
        let mut number = [0.0];
        self.uniform(&mut number);
        number[0]
    }

    /// Fills a matrix of rows of lanes with numbers uniform on [0, 1), 53 bits each.
    pub fn uniform(&mut self, rows: &mut [f64]) {
        let lanes = self.s0.len();
        for lane in 0..lanes {
            let mut generator = [[self.s0[lane]], [self.s1[lane]]];
            for number in rows[lane..].iter_mut().step_by(lanes) {
                *number = (next(&mut generator)[0] >> 11) as f64 * INV_2_53;
            }
            [[self.s0[lane]], [self.s1[lane]]] = generator;
        }
    }
}

/// Fills two matrices of rows of lanes with numbers uniform on [0, 1), from the
/// upper and the lower 32 bits of one word: they share no bit.
pub struct UniformPairs<'a> {
    /// The generators.
    pub lanes: &'a mut Lanes,
    /// The matrices, of the same size.
    pub rows: [&'a mut [f64]; 2],
}

impl WithSimd for UniformPairs<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Lanes { s0, s1 } = self.lanes;
        let [first, second] = self.rows;
        let lanes = s0.len();
        let blocks = s0.as_chunks_mut::<BLOCK>().0.iter_mut().zip(s1.as_chunks_mut::<BLOCK>().0);
        for (block, (s0, s1)) in blocks.enumerate() {
            let mut generator = [*s0, *s1];
            let at = block * BLOCK..(block + 1) * BLOCK;
            for (first, second) in first.chunks_exact_mut(lanes).zip(second.chunks_exact_mut(lanes)) {
                let word = next(&mut generator);
                let (upper, lower) = (word.map(|w| EXPONENT | (w >> 32)), word.map(|w| EXPONENT | (w & 0xffff_ffff)));
                first[at.clone()].copy_from_slice(&upper.map(f64::from_bits));
                second[at.clone()].copy_from_slice(&lower.map(f64::from_bits));
            }
            [*s0, *s1] = generator;
        }
        // A 32-bit word in the mantissa of 2⁵², less 2⁵², is exact, and vectorises where a conversion would not.
        let (offset, scale) = (simd.splat_f64s(f64::from_bits(EXPONENT)), simd.splat_f64s(INV_2_32));
        for number in S::as_mut_simd_f64s(first).0.iter_mut().chain(S::as_mut_simd_f64s(second).0) {
            *number = simd.mul_f64s(simd.sub_f64s(*number, offset), scale);
        }
    }
}

/// The next 64-bit word of W generators.
#[inline(always)]
fn next<const W: usize>([s0, s1]: &mut [[u64; W]; 2]) -> [u64; W] {
    let mut word = [0; W];
    for k in 0..W {
        let (a, mut b) = (s0[k], s1[k]);
        word[k] = a.wrapping_add(b).rotate_left(17).wrapping_add(a);
        b ^= a;
        s0[k] = a.rotate_left(49) ^ b ^ (b << 21);
        s1[k] = b.rotate_left(28);
    }
    word
}

#[cfg(test)]
mod tests {
    use rand::Rng;
    use rand::SeedableRng;
    use rand_xoshiro::Xoroshiro128PlusPlus;

    use super::*;

    #[test]
    fn every_lane_is_the_reference_generator() {
        let mut lanes = Lanes::default();
        lanes.seed(&mut 42, 16);
        let mut references: Vec<Xoroshiro128PlusPlus> = (0..16)
            .map(|lane| {
                let state = [lanes.s0[lane].to_le_bytes(), lanes.s1[lane].to_le_bytes()].concat();
                Xoroshiro128PlusPlus::from_seed(state.try_into().unwrap())
            })
            .collect();
        let (mut first, mut second) = (vec![0.0; 160], vec![0.0; 160]);
        lanes.uniform(&mut first);
        for (i, number) in first.iter().enumerate() {
            assert_eq!(*number, (references[i % 16].next_u64() >> 11) as f64 / 2f64.powi(53));
        }
        pulp::Arch::new().dispatch(UniformPairs { lanes: &mut lanes, rows: [&mut first, &mut second] });
        for i in 0..160 {
            let word = references[i % 16].next_u64();
            assert_eq!(first[i], (word >> 32) as f64 / 2f64.powi(32));
            assert_eq!(second[i], (word & 0xffff_ffff) as f64 / 2f64.powi(32));
        }
    }

    #[test]
    fn numbers_lie_in_the_unit_interval_and_average_one_half() {
        let mut lanes = Lanes::default();
        lanes.seed(&mut 7, 8);
        let n = 100_000;
        let (mut first, mut second) = (vec![0.0; n], vec![0.0; n]);
        pulp::Arch::new().dispatch(UniformPairs { lanes: &mut lanes, rows: [&mut first, &mut second] });
        let mean = |v: &[f64]| v.iter().sum::<f64>() / n as f64;
        let product: Vec<f64> = first.iter().zip(&second).map(|(a, b)| a * b).collect();
        // Standard error of a mean of 10⁵ uniforms is 0.0009; five of them.
        assert!((mean(&first) - 0.5).abs() < 0.005 && (mean(&second) - 0.5).abs() < 0.005);
        assert!((mean(&product) - 0.25).abs() < 0.005, "the two numbers of a word are uncorrelated");
    }
}
