//! Seeds of runs and the order of planners: everything random that the bench itself decides.
//!
//! With `S(x)` the first output of `SplitMix64` from state x, `F` the 64-bit
//! FNV-1a hash of the scene's name in UTF-8, and ⊕ the exclusive or, the run
//! `repeat` (from 0) in that scene has the seed
//!
//! ```text
//! S(S(S(comparison seed) ⊕ F(scene name)) ⊕ repeat) >> 11
//! ```
//!
//! which lies below 2⁵³, so that any language reads it exactly. The planner has
//! no part in it: runs are paired. Sources: Steele, Lea & Flood, *Fast splittable
//! pseudorandom number generators* (2014), doi:10.1145/2660193.2660195; FNV-1a:
//! RFC 9923.

use planner_api::seed::splitmix64;

/// The formula, for manifests and reports.
pub const FORMULA: &str =
    "S(S(S(comparison seed) xor FNV-1a-64(scene name)) xor repeat) >> 11, S = first output of SplitMix64";

fn s(mut state: u64) -> u64 {
    splitmix64(&mut state)
}

/// The 64-bit FNV-1a hash.
pub fn fnv1a_64(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &b| (hash ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// The 128-bit FNV-1a hash: tells campaigns apart, resists no adversary.
pub fn fnv1a_128(bytes: &[u8]) -> u128 {
    bytes.iter().fold(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d, |hash, &b| {
        (hash ^ u128::from(b)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b)
    })
}

fn unit(comparison: u64, scene: &str, repeat: u32) -> u64 {
    s(s(s(comparison) ^ fnv1a_64(scene.as_bytes())) ^ u64::from(repeat))
}

/// The seed of one run, the same for every planner; < 2⁵³.
pub fn run_seed(comparison: u64, scene: &str, repeat: u32) -> u64 {
    unit(comparison, scene, repeat) >> 11
}

/// The order in which `planners` planners take their turn in one repeat of one
/// scene: a Fisher–Yates shuffle that depends on nothing else, so that no
/// planner always runs first and jobs do not matter.
pub fn turn_order(comparison: u64, scene: &str, repeat: u32, planners: usize) -> Vec<usize> {
    // Another stream than the run's seed: the golden-ratio increment never maps one state to the other's first output.
    let mut state = !unit(comparison, scene, repeat);
    let mut order: Vec<usize> = (0..planners).collect();
    for i in (1..planners).rev() {
        // The bias of the remainder is below planners/2⁶⁴.
        order.swap(i, (splitmix64(&mut state) % (i as u64 + 1)) as usize);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_match_published_vectors() {
        // RFC 9923, appendix: FNV-1a of "", "a", "foobar".
        assert_eq!(fnv1a_64(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a_64(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a_64(b"foobar"), 0x8594_4171_f739_67e8);
        assert_eq!(fnv1a_128(b"a"), 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964);
    }

    #[test]
    fn run_seeds_follow_the_documented_formula_and_never_change() {
        let s = |mut x: u64| splitmix64(&mut x);
        let expected = s(s(s(1) ^ fnv1a_64(b"lu-sun-2012")) ^ 29) >> 11;
        assert_eq!(run_seed(1, "lu-sun-2012", 29), expected);
        let mut all: Vec<u64> = (0..1000).map(|r| run_seed(1, "a", r)).collect();
        all.extend((0..1000).map(|r| run_seed(1, "b", r)));
        all.extend((0..1000).map(|r| run_seed(2, "a", r)));
        assert!(all.iter().all(|&s| s < 1 << 53));
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), 3000, "no seed twice");
    }

    #[test]
    fn every_planner_gets_every_turn() {
        let mut first = [0u32; 4];
        for repeat in 0..400 {
            let mut order = turn_order(7, "scene", repeat, 4);
            first[order[0]] += 1;
            order.sort_unstable();
            assert_eq!(order, [0, 1, 2, 3]);
        }
        // Binomial(400, 1/4): mean 100, deviation 8.7; five deviations.
        assert!(first.iter().all(|&n| (56..145).contains(&n)), "{first:?}");
    }
}
