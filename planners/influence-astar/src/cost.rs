//! Costs in whole quanta.
//!
//! a·L + b·W in floating point depends on the order of summation, which would
//! blur the ties of equally long (or equally safe) paths and make A* and Dijkstra
//! differ in the last digits. So every step's cost is rounded once, to 2⁻⁴⁰ of
//! the dearest step, and sums are exact from there on. With at most 10⁶ cells
//! (2²⁰) no sum leaves 64 bits. Lengths of at most 10³ moves differ by
//! |s + √2·d| > 10⁻⁴ steps or not at all, which 2⁻⁴⁰ keeps apart.

use std::f64::consts::SQRT_2;
use std::ops::Add;

use crate::Settings;

/// A cost: the objective a·L + b·W first, then the term that the objective
/// leaves open: the risk W, or at a = 0, where the risk is all there is, the length L.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct Cost {
    /// a·L + b·W in quanta of [`Scale::objective`].
    pub objective: u64,
    /// W or L in quanta of its own.
    pub tie: u64,
}

impl Cost {
    /// Of what has not been reached.
    pub const UNREACHED: Self = Self { objective: u64::MAX, tie: u64::MAX };
}

impl Add for Cost {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { objective: self.objective + other.objective, tie: self.tie + other.tie }
    }
}

/// How many quanta the dearest step has.
const QUANTA: f64 = (1_u64 << 40) as f64;

/// The size of the quanta for one risk map.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scale {
    a: f64,
    b: f64,
    /// Quanta of a·L + b·W a unit.
    objective: f64,
    /// Quanta of the second term a unit.
    tie: f64,
}

impl Scale {
    /// `most` is the largest risk of a cell.
    pub fn new(settings: &Settings, most: f64) -> Self {
        let (a, b) = (settings.a, settings.b);
        let diagonal = SQRT_2 * settings.dis;
        // A term that is nothing everywhere needs no quanta.
        let quanta = |dearest: f64| if dearest > 0.0 { QUANTA / dearest } else { 0.0 };
        let tie = if a > 0.0 { quanta(most) } else { quanta(diagonal) };
        Self { a, b, objective: quanta((a * diagonal).max(b * most)), tie }
    }

    /// The cost of moving by `length`, in units of L.
    pub fn length(&self, length: f64) -> Cost {
        let tie = if self.a > 0.0 { 0 } else { whole(length * self.tie) };
        Cost { objective: whole(self.a * length * self.objective), tie }
    }

    /// The cost of entering a cell of this risk.
    pub fn risk(&self, risk: f64) -> Cost {
        let tie = if self.a > 0.0 { whole(risk * self.tie) } else { 0 };
        Cost { objective: whole(self.b * risk * self.objective), tie }
    }
}

/// The nearest whole number of quanta.
fn whole(quanta: f64) -> u64 {
    quanta.round() as u64
}

/// What the moves on a grid cost.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Moves {
    pub straight: Cost,
    pub diagonal: Cost,
}

impl Moves {
    pub fn new(scale: &Scale, dis: f64) -> Self {
        let straight = scale.length(dis);
        let mut diagonal = scale.length(SQRT_2 * dis);
        // Where a is next to nothing, rounding must not make two straight moves
        // cheaper than a diagonal one: octile distances would not be least costs.
        diagonal.objective = diagonal.objective.min(2 * straight.objective);
        Self { straight, diagonal }
    }
}
