//! Lane-parallel random numbers: one xoroshiro128++ (Blackman & Vigna 2021) a lane.

use planner_api::seed::splitmix64;

/// 2⁻³²: a 32-bit word times this lies in [0, 1).
const INV_2_32: f64 = 1.0 / 4_294_967_296.0;
/// 2⁻⁵³: a 53-bit word times this lies in [0, 1).
const INV_2_53: f64 = 1.0 / 9_007_199_254_740_992.0;

/// The generators' states, one a lane.
#[derive(Debug, Clone, Default)]
pub struct Lanes {
    s0: Vec<u64>,
    s1: Vec<u64>,
}

impl Lanes {
    /// Seeds lane i with words 2i and 2i + 1 of the `SplitMix64` sequence of `seed`.
    pub fn seed(&mut self, seed: u64, lanes: usize) {
        let mut state = seed;
        self.s0.clear();
        self.s1.clear();
        for _ in 0..lanes {
            self.s0.push(splitmix64(&mut state));
            self.s1.push(splitmix64(&mut state));
        }
    }

    /// The generators of lanes `first` … `first + W − 1`.
    #[inline(always)]
    pub fn load<const W: usize>(&self, first: usize) -> Generators<W> {
        let take = |s: &[u64]| -> [u64; W] { s[first..first + W].try_into().expect("W words") };
        Generators { s0: take(&self.s0), s1: take(&self.s1) }
    }

    /// Puts them back.
    #[inline(always)]
    pub fn store<const W: usize>(&mut self, first: usize, generators: &Generators<W>) {
        self.s0[first..first + W].copy_from_slice(&generators.s0);
        self.s1[first..first + W].copy_from_slice(&generators.s1);
    }
}

/// W generators in registers.
#[derive(Debug, Clone, Copy)]
pub struct Generators<const W: usize> {
    s0: [u64; W],
    s1: [u64; W],
}

impl<const W: usize> Generators<W> {
    /// The next 64-bit word of every lane.
    #[inline(always)]
    pub fn next_words(&mut self) -> [u64; W] {
        let mut word = [0; W];
        #[allow(clippy::needless_range_loop, reason = "three arrays in step")]
        for k in 0..W {
            let (a, mut b) = (self.s0[k], self.s1[k]);
            word[k] = a.wrapping_add(b).rotate_left(17).wrapping_add(a);
            b ^= a;
            self.s0[k] = a.rotate_left(49) ^ b ^ (b << 21);
            self.s1[k] = b.rotate_left(28);
        }
        word
    }

    /// The next number of every lane, uniform on [0, 1) with 53 bits.
    #[inline(always)]
    pub fn uniform(&mut self) -> [f64; W] {
        self.next_words().map(|word| (word >> 11) as f64 * INV_2_53)
    }

    /// The next two numbers of every lane, uniform on [0, 1), from the upper
    /// and the lower 32 bits of one word: they share no bit.
    #[inline(always)]
    pub fn uniform_pair(&mut self) -> ([f64; W], [f64; W]) {
        let word = self.next_words();
        (word.map(|w| unit32(w >> 32)), word.map(|w| unit32(w & 0xffff_ffff)))
    }
}

/// A 32-bit word as a number in [0, 1). Placing it in the mantissa of 2⁵² and
/// subtracting 2⁵² is exact, and vectorises where a conversion would not.
#[inline(always)]
fn unit32(word: u64) -> f64 {
    const TWO_52: f64 = 4_503_599_627_370_496.0;
    (f64::from_bits(TWO_52.to_bits() | word) - TWO_52) * INV_2_32
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
        lanes.seed(42, 12);
        let mut generators = lanes.load::<8>(4);
        let words: Vec<[u64; 8]> = (0..1000).map(|_| generators.next_words()).collect();
        for lane in 0..8 {
            let mut seed = [0u8; 16];
            seed[..8].copy_from_slice(&lanes.s0[4 + lane].to_le_bytes());
            seed[8..].copy_from_slice(&lanes.s1[4 + lane].to_le_bytes());
            let mut reference = Xoroshiro128PlusPlus::from_seed(seed);
            for word in &words {
                assert_eq!(word[lane], reference.next_u64());
            }
        }
    }

    #[test]
    fn numbers_lie_in_the_unit_interval_and_average_one_half() {
        assert_eq!(unit32(0), 0.0);
        assert_eq!(unit32(0xffff_ffff), 1.0 - INV_2_32);
        assert_eq!(unit32(0x8000_0000), 0.5);
        let mut lanes = Lanes::default();
        lanes.seed(7, 4);
        let mut g = lanes.load::<4>(0);
        let n = 25_000;
        let (mut a, mut b, mut ab) = (0.0, 0.0, 0.0);
        for _ in 0..n {
            let (u, v) = g.uniform_pair();
            for k in 0..4 {
                a += u[k];
                b += v[k];
                ab += u[k] * v[k];
            }
        }
        let n = f64::from(4 * n);
        // Standard error of a mean of 10⁵ uniforms is 0.0009; five of them.
        assert!((a / n - 0.5).abs() < 0.005 && (b / n - 0.5).abs() < 0.005);
        assert!((ab / n - 0.25).abs() < 0.005, "the two numbers of a word are uncorrelated");
    }
}
