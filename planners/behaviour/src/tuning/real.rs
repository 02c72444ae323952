//! Real coding: the genes as they are.

use super::Tuning;
use super::coding::Chromosome;
use super::genes::{GENES, Genes};
use crate::dice::Dice;

/// Eleven numbers in [0, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Real(Genes);

impl Chromosome for Real {
    fn draw(dice: &mut Dice) -> Self {
        Self(std::array::from_fn(|_| dice.unit()))
    }

    /// Blend crossover (BLX-α): each gene of a child uniform between those of its parents, α of their distance beyond
    /// either included; what leaves the range is put on its end.
    fn cross([a, b]: [Self; 2], tuning: &Tuning, dice: &mut Dice) -> [Self; 2] {
        [(); 2].map(|()| {
            Self(std::array::from_fn(|i| {
                let (low, high) = (a.0[i].min(b.0[i]), a.0[i].max(b.0[i]));
                let beyond = tuning.blend * (high - low);
                dice.within(low - beyond, high + beyond).clamp(0.0, 1.0)
            }))
        })
    }

    /// Each gene moves by a normal deviate with the same probability.
    fn mutate(self, tuning: &Tuning, dice: &mut Dice) -> Self {
        let rate = tuning.mutation / GENES as f64;
        Self(self.0.map(|gene| match dice.chance(rate) {
            true => (gene + tuning.deviation * dice.normal()).clamp(0.0, 1.0),
            false => gene,
        }))
    }

    fn genes(&self) -> Genes {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn children_blend_their_parents() {
        let parents = [Real([0.4; GENES]), Real([0.6; GENES])];
        let mut dice = Dice::new(1, 0);
        let genes: Vec<f64> =
            (0..200).flat_map(|_| Real::cross(parents, &Tuning::default(), &mut dice)).flat_map(|c| c.0).collect();
        // α = ½: uniform on 0.3 … 0.7, of 4400 draws.
        let (least, most) = genes.iter().fold((1.0_f64, 0.0_f64), |(l, m), g| (l.min(*g), m.max(*g)));
        assert!((0.3..0.302).contains(&least) && (0.698..0.7 + 1e-15).contains(&most), "{least} {most}");
        let edges = Real::cross([Real([0.0; GENES]), Real([1.0; GENES])], &Tuning::default(), &mut dice);
        assert!(edges.iter().flat_map(|c| c.0).all(|g| (0.0..=1.0).contains(&g)));
    }

    #[test]
    fn as_many_genes_move_as_asked() {
        let tuning = Tuning { mutation: 2.0, ..Tuning::default() };
        let mut dice = Dice::new(3, 0);
        let start = Real([0.5; GENES]);
        let moves: Vec<f64> =
            (0..1000).flat_map(|_| start.mutate(&tuning, &mut dice).0).filter(|g| *g != 0.5).map(|g| g - 0.5).collect();
        // Binomial of 11000 at 2/11: standard deviation 40; five of them.
        assert!(moves.len().abs_diff(2000) < 200, "{}", moves.len());
        let variance = moves.iter().map(|m| m * m).sum::<f64>() / moves.len() as f64;
        // 0.1² within five standard deviations of √(2/2000) relative.
        assert!((variance / 0.01 - 1.0).abs() < 0.16, "{variance}");
    }
}
