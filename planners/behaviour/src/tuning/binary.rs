//! Binary coding: ten bits a gene, plain binary numbers, gene 0 in the lowest bits.

use super::Tuning;
use super::coding::Chromosome;
use super::genes::{GENES, Genes};
use crate::dice::Dice;

/// Bits of a gene.
const BITS: usize = 10;
/// Bits of a chromosome.
const LENGTH: usize = BITS * GENES;
/// The largest value of a gene.
const LARGEST: u128 = (1 << BITS) - 1;

/// A string of 110 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Binary(u128);

impl Chromosome for Binary {
    fn draw(dice: &mut Dice) -> Self {
        let bits = u128::from(dice.word()) << 64 | u128::from(dice.word());
        Self(bits & ((1 << LENGTH) - 1))
    }

    /// One-point crossover: below the cut one parent's bits, from it on the other's.
    fn cross([a, b]: [Self; 2], _: &Tuning, dice: &mut Dice) -> [Self; 2] {
        let below = (1 << (1 + dice.below(LENGTH - 1))) - 1;
        [Self(a.0 & below | b.0 & !below), Self(b.0 & below | a.0 & !below)]
    }

    /// Each bit flips with the same probability.
    fn mutate(self, tuning: &Tuning, dice: &mut Dice) -> Self {
        let rate = tuning.mutation / LENGTH as f64;
        let flips = (0..LENGTH).filter(|_| dice.chance(rate)).fold(0, |flips, bit| flips | 1 << bit);
        Self(self.0 ^ flips)
    }

    fn genes(&self) -> Genes {
        std::array::from_fn(|i| (self.0 >> (BITS * i) & LARGEST) as f64 / LARGEST as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(genes: &Genes) -> Binary {
        let bits = genes.iter().enumerate().map(|(i, g)| ((g * LARGEST as f64).round() as u128) << (BITS * i));
        Binary(bits.fold(0, |all, gene| all | gene))
    }

    #[test]
    fn bits_and_genes_are_the_same() {
        let mut dice = Dice::new(1, 0);
        for _ in 0..100 {
            let drawn = Binary::draw(&mut dice);
            assert_eq!(of(&drawn.genes()), drawn);
            assert!(drawn.genes().iter().all(|g| (0.0..=1.0).contains(g)));
        }
        assert_eq!(Binary(0).genes(), [0.0; GENES]);
        assert_eq!(Binary((1 << LENGTH) - 1).genes(), [1.0; GENES]);
        let third = Binary(512 << 20).genes();
        assert_eq!((third[1], third[2], third[3]), (0.0, 512.0 / 1023.0, 0.0));
    }

    #[test]
    fn children_have_a_head_and_a_tail() {
        let (zeros, ones) = (Binary(0), Binary((1 << LENGTH) - 1));
        let mut dice = Dice::new(2, 0);
        for _ in 0..500 {
            let [a, b] = Binary::cross([zeros, ones], &Tuning::default(), &mut dice);
            assert_eq!((a.0 ^ b.0, a.0 & b.0), (ones.0, 0), "every bit of both parents is somewhere");
            assert!((1..LENGTH).contains(&(b.0.count_ones() as usize)), "either gives something");
            assert_eq!(b.0.count_ones(), b.0.trailing_ones(), "one cut");
        }
    }

    #[test]
    fn as_many_bits_flip_as_asked() {
        let tuning = Tuning { mutation: 2.0, ..Tuning::default() };
        let mut dice = Dice::new(3, 0);
        let flips: u32 = (0..1000).map(|_| Binary(0).mutate(&tuning, &mut dice).0.count_ones()).sum();
        // 2000 expected, standard deviation 44; five of them.
        assert!(flips.abs_diff(2000) < 220, "{flips}");
        let never = Tuning { mutation: 0.0, ..tuning };
        assert_eq!(Binary(5).mutate(&never, &mut dice), Binary(5));
    }
}
