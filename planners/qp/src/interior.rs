//! A primal-dual interior point for heights on columns: the structured solver.
//!
//! min f(η) subject to cₖ(η) ≥ 0, f the length Σ √(1 + (ηᵢ₊₁ − ηᵢ)²) or a
//! quadratic of half-bandwidth 2, cₖ the room that a segment leaves an arc
//! (`arc`). With slacks s = c(η) > 0 and multipliers z > 0 the conditions
//!
//! ∇f − Jᵀz = 0, p = c(η) − s = 0, sₖzₖ = 0, J the rows ∂cₖ,
//!
//! are approached by Newton steps on sₖzₖ = σμ, μ = sᵀz/K, with Mehrotra's
//! predictor (σ = 0), centring σ = (μ of the predictor/μ)³ and corrector δ = Δs·Δz:
//!
//! (∇²f − Σ zₖ∇²cₖ + Jᵀ(Z/S)J) Δη = −∇f + Jᵀ((σμ − δ − z·p)/s),
//! Δs = J Δη + p, Δz = (σμ − δ − z·Δs)/s − z.
//!
//! Every arc touches two neighbouring heights, so the matrix is tridiagonal
//! (pentadiagonal for a quadratic) and a step costs O(columns + arcs). An arc
//! is drawn anew as a cut at every step, with its curvature in ∇²c: where cutting
//! planes take rounds of programmes this is one.
//!
//! Far from the optimum √(1 + μ²) is hardly curved where a segment is steep,
//! and Newton steps on it run away. So its curvature is κ = (1 − τμ/√(1 + μ²))/√(1 + μ²)
//! with the direction τ ∈ [−1, 1] an unknown of its own, which the steps lead
//! to μ/√(1 + μ²): from κ = 1/√(1 + μ²), an upper bound, to the true (1 + μ²)^{−3/2}.
//!
//! The answer is certified: for every feasible w, by convexity,
//! f(w) ≥ f(η) − zᵀc(η) + (∇f − Jᵀz)·(w − η), and the stopping test bounds all that is subtracted.
//!
//! Mehrotra, *On the implementation of a primal-dual interior point method*
//! (1992), doi 10.1137/0802028; for curved constraints Nocedal & Wright,
//! *Numerical Optimization* (2nd ed., 2006), §19.2–19.3; for τ Chan, Golub & Mulet, *A nonlinear
//! primal-dual method for total variation-based image restoration* (1999), doi 10.1137/S1064827596299767.

mod feasibility;

use crate::arc::{Arc, Pass};
use crate::banded::Banded;
use crate::program::Quadratic;

/// Newton steps before it gives up; 4 to 15 are usual.
const MOST_STEPS: usize = 100;

/// Newton steps before feasibility is looked into, and half as far a turn allowed.
const PATIENCE: usize = 25;

/// Share of the way to the boundary that a step may go.
const TO_BOUNDARY: f64 = 0.995;

/// The farthest that a slope may turn in a step, as a share of √(1 + μ²): beyond, curvatures say nothing.
const TURN: f64 = 1.0;

/// First slacks are at least this, in Δ: what a start between the cuts violates.
const LEAST_SLACK: f64 = 0.02;

/// First products sₖzₖ.
const FIRST_PRODUCT: f64 = 2e-3;

/// Products are aimed no lower than this times the square of what the other conditions lack:
/// complementarity must not be met long before them.
const FLOOR: f64 = 1e-2;

/// Stationarity: largest entry of ∇f − Jᵀz, relative to that of ∇f or 1.
const STATIONARY: f64 = 1e-9;

/// f.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Target<'a> {
    /// Σ √(1 + (ηᵢ₊₁ − ηᵢ)²).
    Length,
    /// ½ηᵀPη + qᵀη of half-bandwidth 2, of the order of 1.
    Quadratic(&'a Quadratic),
    /// ½`ANCHOR`‖η − η₀‖², of the search for feasible heights.
    Anchor,
}

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// At heights that keep c ≥ −`within` and are optimal to the gap asked for.
    Optimal,
    /// Proved: no heights within the horizon keep all arcs.
    Infeasible,
    /// Neither, for numerical reasons.
    Failed,
    /// By the clock.
    Stopped,
}

/// One constraint under way.
#[derive(Debug, Clone, Copy)]
struct Row {
    arc: Arc,
    pass: Pass,
    slack: f64,
    dual: f64,
    /// p.
    error: f64,
    /// σμ − δ; 0 in the predictor.
    aim: f64,
    step: (f64, f64),
}

/// Buffers of the solver, kept from solve to solve, and the solution.
#[derive(Debug, Clone, Default)]
pub(crate) struct Interior {
    /// Start, heights, goal, in Δ; both ends 0.
    pub(crate) heights: Vec<f64>,
    /// η₀.
    first: Vec<f64>,
    rows: Vec<Row>,
    /// 1/√(1 + μ²) a segment.
    inverse: Vec<f64>,
    /// τ a segment.
    tangents: Vec<f64>,
    /// κ a segment.
    curvatures: Vec<f64>,
    /// ∇f, ends included, as in the next two.
    gradient: Vec<f64>,
    /// ∇f − Jᵀz.
    residual: Vec<f64>,
    step: Vec<f64>,
    matrix: Banded,
}

impl Interior {
    /// Forgets all constraints, and begins at `heights` over `spacing`.
    pub(crate) fn begin(&mut self, heights: &[f64], spacing: f64) {
        self.rows.clear();
        self.heights.clear();
        self.heights.push(0.0);
        self.heights.extend(heights.iter().map(|y| y / spacing));
        self.heights.push(0.0);
    }

    /// Adds a constraint.
    pub(crate) fn add(&mut self, arc: Arc) {
        let pass = Pass { room: 0.0, gradient: (0.0, 0.0), rolling: 0.0 };
        self.rows.push(Row { arc, pass, slack: 0.0, dual: 0.0, error: 0.0, aim: 0.0, step: (0.0, 0.0) });
    }

    /// Where the polyline passes `arc`.
    pub(crate) fn pass(&self, arc: &Arc) -> Pass {
        let (left, right) = (self.heights[arc.segment], self.heights[arc.segment + 1]);
        arc.pass(left, right, 1.0 / (1.0 + (right - left) * (right - left)).sqrt())
    }

    /// Minimises from the present heights, until sᵀz ≤ `gap`·max(|f|, 1), |p| ≤ `within` and stationarity;
    /// asks `in_time` before every step.
    pub(crate) fn minimise(
        &mut self,
        target: Target<'_>,
        gap: f64,
        within: f64,
        mut in_time: impl FnMut() -> bool,
    ) -> Outcome {
        self.first.clone_from(&self.heights);
        self.set_out();
        let mut turn = TURN;
        for steps in 1..=MOST_STEPS {
            if !in_time() {
                return Outcome::Stopped;
            }
            let (value, product) = self.evaluate(target);
            let error = self.rows.iter().fold(0.0, |m: f64, row| m.max(row.error.abs()));
            let (largest, residual) = (self.largest(&self.gradient).max(1.0), self.largest(&self.residual));
            if !(value + product + residual).is_finite() {
                return Outcome::Failed;
            }
            if product <= gap * value.abs().max(1.0) && error <= within && residual <= STATIONARY * largest {
                return Outcome::Optimal;
            }
            if self.infeasible(within) {
                return Outcome::Infeasible;
            }
            if steps % PATIENCE == 0 {
                if self.least_violation(within) {
                    return Outcome::Infeasible;
                }
                turn *= 0.5;
                self.set_out();
                continue;
            }
            let lack = error.max(residual / self.rows.iter().fold(largest, |m, row| m.max(row.dual)));
            if !self.step(target, product, FLOOR * lack * lack, turn) {
                return Outcome::Failed;
            }
        }
        Outcome::Failed
    }

    /// Slacks, multipliers and τ for the present heights.
    fn set_out(&mut self) {
        self.tangents.clear();
        self.tangents.resize(self.heights.len() - 1, 0.0);
        for i in 0..self.rows.len() {
            let room = self.pass(&self.rows[i].arc).room;
            let row = &mut self.rows[i];
            row.slack = room.max(LEAST_SLACK);
            row.dual = FIRST_PRODUCT / row.slack;
        }
    }

    /// One predictor and corrector step; false when the matrix cannot be factored.
    fn step(&mut self, target: Target<'_>, product: f64, floor: f64, turn: f64) -> bool {
        self.assemble(target, |row| row.dual / row.slack);
        if !self.matrix.factor() {
            return false;
        }
        self.direction(|_| 0.0);
        if !self.rows.is_empty() {
            let reach = self.reach(1.0);
            let affine: f64 =
                self.rows.iter().map(|r| (r.slack + reach * r.step.0) * (r.dual + reach * r.step.1)).sum();
            let share = affine / product;
            let centre = (share * share * share * product / self.rows.len() as f64).max(floor);
            self.direction(|row| centre - row.step.0 * row.step.1);
        }
        let reach = self.reach(TO_BOUNDARY).min(turn / self.turn());
        self.go(reach);
        for row in &mut self.rows {
            row.slack += reach * row.step.0;
            row.dual += reach * row.step.1;
        }
        true
    }

    /// Heights and τ along the step.
    fn go(&mut self, reach: f64) {
        for (i, tangent) in self.tangents.iter_mut().enumerate() {
            let slope = self.heights[i + 1] - self.heights[i];
            let change = self.curvatures[i] * (self.step[i + 1] - self.step[i]);
            *tangent = (*tangent + reach * (slope * self.inverse[i] + change - *tangent)).clamp(-1.0, 1.0);
        }
        for (height, step) in self.heights.iter_mut().zip(&self.step) {
            *height += reach * step;
        }
    }

    /// The largest turn of a slope in the step, relative to √(1 + μ²).
    fn turn(&self) -> f64 {
        let turns = self.step.windows(2).zip(&self.inverse).map(|(w, inverse)| (w[1] - w[0]).abs() * inverse);
        turns.fold(0.0, f64::max)
    }

    /// The largest entry of a vector at the inner heights.
    fn largest(&self, vector: &[f64]) -> f64 {
        vector[1..self.heights.len() - 1].iter().fold(0.0, |m: f64, v| m.max(v.abs()))
    }

    /// Passes, errors, ∇f and residual at the present heights. Returns f and sᵀz.
    fn evaluate(&mut self, target: Target<'_>) -> (f64, f64) {
        let Self { heights, rows, inverse, residual, gradient, .. } = self;
        let n = heights.len();
        inverse.clear();
        inverse.extend(heights.windows(2).map(|w| 1.0 / (1.0 + (w[1] - w[0]) * (w[1] - w[0])).sqrt()));
        gradient.clear();
        gradient.resize(n, 0.0);
        let value = match target {
            Target::Length => {
                let mut length = 0.0;
                for (i, inverse) in inverse.iter().enumerate() {
                    let slope = heights[i + 1] - heights[i];
                    length += (1.0 + slope * slope) * inverse;
                    gradient[i] -= slope * inverse;
                    gradient[i + 1] += slope * inverse;
                }
                length
            }
            Target::Quadratic(quadratic) => quadratic.evaluate(&heights[1..n - 1], &mut gradient[1..n - 1]),
            Target::Anchor => unreachable!("never evaluated"),
        };
        residual.clone_from(gradient);
        let mut product = 0.0;
        for row in rows {
            let i = row.arc.segment;
            row.pass = row.arc.pass(heights[i], heights[i + 1], inverse[i]);
            row.error = row.pass.room - row.slack;
            residual[i] -= row.dual * row.pass.gradient.0;
            residual[i + 1] -= row.dual * row.pass.gradient.1;
            product += row.slack * row.dual;
        }
        (value, product)
    }

    /// ∇²f − Σ z ∇²c + Jᵀ W J over the inner heights; W has `weight` of each row.
    fn assemble(&mut self, target: Target<'_>, weight: impl Fn(&Row) -> f64) {
        let Self { heights, rows, inverse, tangents, curvatures, matrix, .. } = self;
        let n = heights.len();
        curvatures.clear();
        curvatures.extend(
            heights
                .windows(2)
                .zip(inverse.iter().zip(tangents))
                .map(|(w, (inverse, tangent))| (1.0 - *tangent * (w[1] - w[0]) * inverse) * inverse),
        );
        matrix.clear(n);
        let band = &mut matrix.rows;
        let mut couple = |i: usize, left: f64, across: f64, right: f64| {
            band[i][0] += left;
            band[i + 1][1] += across;
            band[i + 1][0] += right;
        };
        if matches!(target, Target::Length) {
            for (i, &curvature) in curvatures.iter().enumerate() {
                couple(i, curvature, -curvature, curvature);
            }
        }
        for row in rows {
            let (i, (a, b), weight) = (row.arc.segment, row.pass.gradient, weight(row));
            let bend = row.dual * row.pass.rolling * curvatures[i];
            couple(i, weight * a * a + bend, weight * a * b - bend, weight * b * b + bend);
        }
        match target {
            Target::Length => {}
            Target::Quadratic(quadratic) => quadratic.add_to(&mut band[1..n - 1]),
            Target::Anchor => band.iter_mut().for_each(|row| row[0] += feasibility::ANCHOR),
        }
        // Start and goal are fixed.
        band[0] = [1.0, 0.0, 0.0];
        band[1][1] = 0.0;
        band[2][2] = 0.0;
        band[n - 1] = [1.0, 0.0, 0.0];
    }

    /// The Newton step for products `aim`, which may use the step before.
    fn direction(&mut self, aim: impl Fn(&Row) -> f64) {
        self.step.clear();
        self.step.extend(self.gradient.iter().map(|g| -g));
        for row in &mut self.rows {
            row.aim = aim(row);
            let pull = (row.aim - row.dual * row.error) / row.slack;
            self.step[row.arc.segment] += pull * row.pass.gradient.0;
            self.step[row.arc.segment + 1] += pull * row.pass.gradient.1;
        }
        self.solve_step();
        for row in &mut self.rows {
            let i = row.arc.segment;
            let slack = row.pass.gradient.0 * self.step[i] + row.pass.gradient.1 * self.step[i + 1] + row.error;
            row.step = (slack, (row.aim - row.dual * slack) / row.slack - row.dual);
        }
    }

    /// The step from its right-hand side; start and goal stay.
    fn solve_step(&mut self) {
        let last = self.step.len() - 1;
        self.step[0] = 0.0;
        self.step[last] = 0.0;
        self.matrix.solve(&mut self.step);
    }

    /// The largest step ≤ 1 that keeps slacks and multipliers positive when `share` of the way to 0 is allowed.
    fn reach(&self, share: f64) -> f64 {
        let mut reach = 1.0_f64;
        for row in &self.rows {
            for (value, step) in [(row.slack, row.step.0), (row.dual, row.step.1)] {
                if step < 0.0 {
                    reach = reach.min(-share * value / step);
                }
            }
        }
        reach
    }
}

#[cfg(test)]
mod tests;
