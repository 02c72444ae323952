//! Splitting seeds: `SplitMix64` (Steele, Lea & Flood 2014), the usual seeder of xoshiro generators.

/// The state's increment, 2⁶⁴/φ rounded to odd.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// Advances `state` and returns the next 64-bit word.
pub fn splitmix64(state: &mut u64) -> u64 {
    *state = state.wrapping_add(GOLDEN);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The number in [0, 1) that the upper 53 bits of `word` are: a multiple of 2⁻⁵³, uniform if `word` is.
pub fn unit(word: u64) -> f64 {
    (word >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

#[cfg(test)]
mod tests {
    #[test]
    fn matches_the_published_sequence() {
        // First outputs for seed 1234567 (Rosetta Code, "Pseudo-random numbers/Splitmix64").
        let mut state = 1_234_567;
        assert_eq!(super::splitmix64(&mut state), 6_457_827_717_110_365_317);
        assert_eq!(super::splitmix64(&mut state), 3_203_168_211_198_807_973);
    }
    #[test]
    fn units_are_multiples_of_two_to_the_minus_53() {
        assert_eq!(super::unit(0), 0.0);
        assert_eq!(super::unit(1 << 63), 0.5);
        assert_eq!(super::unit(1 << 11), 2f64.powi(-53));
        assert_eq!(super::unit(u64::MAX), 1.0 - 2f64.powi(-53), "never 1");
    }
}
