//! Lane-parallel random numbers: one xoroshiro128++ (Blackman & Vigna 2021) a lane.

use aligned_vec::{AVec, ConstAlign};
use planner_api::seed::splitmix64;
use pulp::Scalar;

use crate::width::{Kernel, Vectors};

/// 2⁻³²: a 32-bit word times this lies in [0, 1).
pub const INV_2_32: f64 = 1.0 / 4_294_967_296.0;
/// 2⁻⁵³: a 53-bit word times this lies in [0, 1).
const INV_2_53: f64 = 1.0 / 9_007_199_254_740_992.0;

/// The bits of 2⁵².
const EXPONENT: u64 = 0x4330_0000_0000_0000;

/// Lanes come in whole blocks of the widest vector unit.
pub const BLOCK: usize = 8;

/// Words aligned to the widest vectors.
type Words = AVec<u64, ConstAlign<64>>;

/// The generators' states, one a lane.
#[derive(Debug, Clone)]
pub struct Lanes {
    s0: Words,
    s1: Words,
}

impl Default for Lanes {
    fn default() -> Self {
        // `ConstAlign` knows the alignment; the argument is a formality.
        Self { s0: Words::new(0), s1: Words::new(0) }
    }
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
            let mut generator = Generator::<Scalar> { s0: self.s0[lane], s1: self.s1[lane] };
            for number in rows[lane..].iter_mut().step_by(lanes) {
                *number = (generator.next(Scalar) >> 11) as f64 * INV_2_53;
            }
            (self.s0[lane], self.s1[lane]) = (generator.s0, generator.s1);
        }
    }

    /// The generators' states as vectors.
    #[inline(always)]
    pub fn states<V: Vectors>(&mut self) -> (&mut [V::u64s], &mut [V::u64s]) {
        (V::as_mut_simd_u64s(&mut self.s0).0, V::as_mut_simd_u64s(&mut self.s1).0)
    }
}

/// One generator a lane of a vector.
pub struct Generator<V: Vectors> {
    /// The first word of the states.
    pub s0: V::u64s,
    /// The second one.
    pub s1: V::u64s,
}

impl<V: Vectors> Generator<V> {
    /// The next 64-bit words.
    #[inline(always)]
    fn next(&mut self, unit: V) -> V::u64s {
        let (a, b) = (self.s0, unit.xor_u64s(self.s0, self.s1));
        let word = unit.add_u64s(unit.rotl(unit.add_u64s(a, self.s1), 17), a);
        self.s0 = unit.xor_u64s(unit.xor_u64s(unit.rotl(a, 49), b), unit.shl(b, 21));
        self.s1 = unit.rotl(b, 28);
        word
    }

    /// The upper and the lower 32 bits of the next words, as numbers uniform on
    /// 0 … 2³² − 1: they share no bit.
    #[inline(always)]
    pub fn next_halves(&mut self, unit: V) -> (V::f64s, V::f64s) {
        let word = self.next(unit);
        // A 32-bit word in the mantissa of 2⁵², less 2⁵², is exact, and is quick where a conversion is not.
        let exponent = unit.splat_u64s(EXPONENT);
        let number = |half| {
            let shifted = unit.transmute_f64s_u64s(unit.or_u64s(half, exponent));
            unit.sub_f64s(shifted, unit.splat_f64s(f64::from_bits(EXPONENT)))
        };
        (number(unit.shr(word, 32)), number(unit.and_u64s(word, unit.splat_u64s(0xffff_ffff))))
    }
}

/// Fills two matrices of rows of lanes with numbers uniform on [0, 1), from the
/// two halves of one word.
pub struct UniformPairs<'a> {
    /// The generators.
    pub lanes: &'a mut Lanes,
    /// The matrices, of the same size.
    pub rows: [&'a mut [f64]; 2],
}

impl Kernel for UniformPairs<'_> {
    #[inline(always)]
    fn run<V: Vectors>(self, unit: V) {
        let [first, second] = self.rows.map(|rows| V::as_mut_simd_f64s(rows).0);
        let (s0, s1) = self.lanes.states::<V>();
        let vectors = s0.len();
        let scale = unit.splat_f64s(INV_2_32);
        for (c, (s0, s1)) in s0.iter_mut().zip(s1).enumerate() {
            let mut generator = Generator::<V> { s0: *s0, s1: *s1 };
            for (first, second) in first.chunks_exact_mut(vectors).zip(second.chunks_exact_mut(vectors)) {
                let (upper, lower) = generator.next_halves(unit);
                (first[c], second[c]) = (unit.mul_f64s(upper, scale), unit.mul_f64s(lower, scale));
            }
            (*s0, *s1) = (generator.s0, generator.s1);
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::Rng;
    use rand::SeedableRng;
    use rand_xoshiro::Xoroshiro128PlusPlus;

    use super::*;
    use crate::width::Width;

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
        Width::widest().run(UniformPairs { lanes: &mut lanes, rows: [&mut first, &mut second] });
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
        Width::widest().run(UniformPairs { lanes: &mut lanes, rows: [&mut first, &mut second] });
        let mean = |v: &[f64]| v.iter().sum::<f64>() / n as f64;
        let product: Vec<f64> = first.iter().zip(&second).map(|(a, b)| a * b).collect();
        // Standard error of a mean of 10⁵ uniforms is 0.0009; five of them.
        assert!((mean(&first) - 0.5).abs() < 0.005 && (mean(&second) - 0.5).abs() < 0.005);
        assert!((mean(&product) - 0.25).abs() < 0.005, "the two numbers of a word are uncorrelated");
    }
}
