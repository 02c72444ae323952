//! Lengths on the grid, kept as counts of moves so that ties are exact.

use std::f64::consts::SQRT_2;
use std::ops::Add;

/// r + (s + √2·d)·size: a real part in scene units, straight and diagonal moves.
///
/// Two paths of the same moves in another order have the same length bit for bit,
/// which sums of rounded steps have not. On a grid of at most 2048² cells the counts
/// of two different pairs (s, d) give lengths at least |Δs + √2·Δd| ≥
/// 1/(|Δs| + √2·|Δd|) > 10⁻⁸ cells apart, more than rounding moves them: the order of
/// the rounded lengths is the true one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Length {
    /// What is not made of moves, in scene units.
    pub rest: f64,
    /// Straight moves.
    pub straight: u32,
    /// Diagonal moves.
    pub diagonal: u32,
}

impl Length {
    /// One move.
    pub fn of_move(diagonal: bool) -> Self {
        Self { rest: 0.0, straight: u32::from(!diagonal), diagonal: u32::from(diagonal) }
    }

    /// A length that no moves make up, in scene units.
    pub fn real(rest: f64) -> Self {
        Self { rest, straight: 0, diagonal: 0 }
    }

    /// In scene units, for cells of side `size`.
    pub fn value(self, size: f64) -> f64 {
        self.rest + size * (f64::from(self.straight) + SQRT_2 * f64::from(self.diagonal))
    }
}

impl Add for Length {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            rest: self.rest + other.rest,
            straight: self.straight + other.straight,
            diagonal: self.diagonal + other.diagonal,
        }
    }
}
