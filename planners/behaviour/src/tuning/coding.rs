//! What a coding of chromosomes is to the evolution.

use super::Tuning;
use super::genes::Genes;
use crate::dice::Dice;

/// A chromosome of one coding.
pub trait Chromosome: Copy {
    /// A random one.
    fn draw(dice: &mut Dice) -> Self;
    /// The two children of two parents.
    fn cross(parents: [Self; 2], tuning: &Tuning, dice: &mut Dice) -> [Self; 2];
    /// One with some changes.
    #[must_use]
    fn mutate(self, tuning: &Tuning, dice: &mut Dice) -> Self;
    /// The genes that it stands for.
    fn genes(&self) -> Genes;
}
