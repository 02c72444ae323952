//! The genes: numbers between 0 and 1, each a place in the range of one quantity.
//!
//! Where one length must exceed another the gene is their difference, so that every chromosome is valid.

use crate::parameters::Parameters;

/// How many genes a chromosome has.
pub const GENES: usize = 11;

/// The genes of a chromosome, each in [0, 1].
pub type Genes = [f64; GENES];

/// The ranges of the quantities, ours: gains from nothing to half as much again as the largest published one, lengths
/// from touching to a metre or so. All published values lie inside.
const RANGES: [(f64, f64); GENES] = [
    (0.1, 3.0),  // goal gain; without any the team would stand
    (0.0, 3.0),  // obstacle gain
    (0.0, 0.2),  // obstacle margin M
    (0.02, 1.0), // obstacle sphere less margin, S − M
    (0.0, 3.0),  // robot gain
    (0.0, 0.2),  // robot margin M
    (0.02, 1.0), // robot sphere less margin, S − M
    (0.0, 3.0),  // formation gain
    (0.0, 0.25), // dead zone
    (0.02, 1.0), // controlled zone less dead zone
    (0.0, 0.5),  // noise gain
];

/// The parameters that genes stand for; what has no gene is as published.
pub fn decode(genes: &Genes) -> Parameters {
    let mut q = [0.0; GENES];
    for ((q, gene), (low, high)) in q.iter_mut().zip(genes).zip(RANGES) {
        *q = low + (high - low) * gene;
    }
    Parameters {
        goal_gain: q[0],
        obstacle_gain: q[1],
        obstacle_margin: q[2],
        obstacle_sphere: q[2] + q[3],
        robot_gain: q[4],
        robot_margin: q[5],
        robot_sphere: q[5] + q[6],
        formation_gain: q[7],
        formation_dead: q[8],
        formation_control: q[8] + q[9],
        noise_gain: q[10],
        ..Parameters::default()
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// The genes of parameters within the ranges.
    pub fn encode(p: &Parameters) -> Genes {
        let q = [
            p.goal_gain,
            p.obstacle_gain,
            p.obstacle_margin,
            p.obstacle_sphere - p.obstacle_margin,
            p.robot_gain,
            p.robot_margin,
            p.robot_sphere - p.robot_margin,
            p.formation_gain,
            p.formation_dead,
            p.formation_control - p.formation_dead,
            p.noise_gain,
        ];
        std::array::from_fn(|i| (q[i] - RANGES[i].0) / (RANGES[i].1 - RANGES[i].0))
    }

    #[test]
    fn every_corner_of_the_ranges_is_valid() {
        for bits in 0..1_u32 << GENES {
            let genes = std::array::from_fn(|i| f64::from(bits >> i & 1));
            let parameters = decode(&genes);
            assert_eq!(parameters.validate(), Ok(()), "{genes:?}");
        }
    }

    #[test]
    fn published_gains_survive_a_round_trip() {
        let published = Parameters::default();
        let genes = encode(&published);
        assert!(genes.iter().all(|g| (0.0..=1.0).contains(g)), "{genes:?}");
        for ((name, value), (_, expected)) in decode(&genes).named().into_iter().zip(published.named()) {
            assert!((value - expected).abs() < 1e-15, "{name}: {value} for {expected}: a few roundings");
        }
    }
}
