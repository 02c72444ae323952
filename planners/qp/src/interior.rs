//! A primal-dual interior point for heights on columns: the structured solver.
//!
//! min f(η) subject to c_k(η) ≥ 0, f the length Σ √(1 + (ηᵢ₊₁ − ηᵢ)²) or a
//! quadratic of half-bandwidth 2, c_k the room that a segment leaves an arc
//! (`arc`). With slacks s = c(η) > 0 and multipliers z > 0 the conditions
//!
//! ∇f − Jᵀz = 0, c(η) − s = 0, s_k z_k = 0, J the rows ∂c_k,
//!
//! are approached by Newton steps on s_k z_k = σμ, μ = sᵀz/K, with Mehrotra's
//! predictor, centring σ = (μ_affine/μ)³ and corrector:
//!
//! (∇²f − Σ z_k ∇²c_k + Jᵀ(Z/S)J) Δη = −∇f + Jᵀ((σμ − δ − z·p)/s), p = c(η) − s,
//! Δs = J Δη + p, Δz = (σμ − δ − z·Δs)/s − z, δ = Δs·Δz of the predictor.
//!
//! Every arc touches two neighbouring heights, so the matrix is tridiagonal
//! (pentadiagonal for a quadratic) and a step costs O(columns + arcs). An arc
//! is drawn anew as a cut at every step, its curvature in ∇²c: where cutting
//! planes would need rounds of programmes this is one.
//!
//! Mehrotra, *On the implementation of a primal-dual interior point method*
//! (1992), doi 10.1137/0802028; for curved constraints Nocedal & Wright,
//! *Numerical Optimization* (2nd ed., 2006), §19.2–19.3.

use crate::arc::{Arc, Pass};
use crate::banded::Banded;
use crate::program::Quadratic;

/// Newton steps before it gives up; 8 to 15 are usual.
const MOST_STEPS: usize = 80;

/// Share of the way to the boundary that a step may go.
const TO_BOUNDARY: f64 = 0.995;

/// First slacks are at least this, in Δ: what a start between the cuts violates.
const LEAST_SLACK: f64 = 0.02;

/// First products s_k z_k.
const FIRST_PRODUCT: f64 = 2e-3;

/// Stationarity: largest entry of ∇f − Jᵀz, where ∇f is of the order of 1.
const STATIONARY: f64 = 1e-9;

/// Heights within which infeasibility is proved, in lengths of start → goal.
const HORIZON: f64 = 100.0;

/// f.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Target<'a> {
    /// Σ √(1 + (ηᵢ₊₁ − ηᵢ)²).
    Length,
    /// ½ηᵀPη + qᵀη of half-bandwidth 2, of the order of 1.
    Quadratic(&'a Quadratic),
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
    /// σμ − δ, less what the predictor was told.
    aim: f64,
    step: (f64, f64),
}

/// Buffers of the solver, kept from solve to solve, and the solution.
#[derive(Debug, Clone, Default)]
pub(crate) struct Interior {
    /// Start, heights, goal, in Δ; both ends 0.
    pub(crate) heights: Vec<f64>,
    rows: Vec<Row>,
    /// 1/√(1 + μ²) a segment.
    inverse: Vec<f64>,
    /// ∇f − Jᵀz, ends included.
    residual: Vec<f64>,
    gradient: Vec<f64>,
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
        let pass = Pass { room: 0.0, gradient: (0.0, 0.0), bend: 0.0 };
        self.rows.push(Row { arc, pass, slack: 0.0, dual: 0.0, error: 0.0, aim: 0.0, step: (0.0, 0.0) });
    }

    /// Where the polyline passes `arc`.
    pub(crate) fn pass(&self, arc: &Arc) -> Pass {
        let (left, right) = (self.heights[arc.segment], self.heights[arc.segment + 1]);
        arc.pass(left, right, 1.0 / (1.0 + (right - left) * (right - left)).sqrt())
    }

    /// Minimises from the present heights, until sᵀz ≤ `gap`·max(f, 1), c ≥ −`within` and stationarity;
    /// asks `in_time` before every step.
    pub(crate) fn minimise(
        &mut self,
        target: Target<'_>,
        gap: f64,
        within: f64,
        mut in_time: impl FnMut() -> bool,
    ) -> Outcome {
        for i in 0..self.rows.len() {
            let room = self.pass(&self.rows[i].arc).room;
            let row = &mut self.rows[i];
            row.slack = room.max(LEAST_SLACK);
            row.dual = FIRST_PRODUCT / row.slack;
        }
        for _ in 0..MOST_STEPS {
            if !in_time() {
                return Outcome::Stopped;
            }
            let (value, product) = self.evaluate(target);
            let error = self.rows.iter().fold(0.0, |m: f64, row| m.max(row.error.abs()));
            let inner = 1..self.heights.len() - 1;
            let residual = self.residual[inner.clone()].iter().fold(0.0, |m: f64, r| m.max(r.abs()));
            if !(value + product + residual).is_finite() {
                return Outcome::Failed;
            }
            if product <= gap * value.abs().max(1.0) && error <= within && residual <= STATIONARY {
                return Outcome::Optimal;
            }
            if self.infeasible() {
                return Outcome::Infeasible;
            }
            self.assemble(target);
            if !self.matrix.factor() {
                return Outcome::Failed;
            }
            let mean = product / self.rows.len().max(1) as f64;
            if !self.rows.is_empty() {
                self.direction(|_| 0.0);
                let (primal, dual) = self.reach(1.0);
                let affine: f64 =
                    self.rows.iter().map(|r| (r.slack + primal * r.step.0) * (r.dual + dual * r.step.1)).sum();
                let share = affine / product;
                let centre = share * share * share * mean;
                self.direction(|row| centre - row.step.0 * row.step.1);
            } else {
                self.direction(|_| 0.0);
            }
            let (primal, dual) = self.reach(TO_BOUNDARY);
            for i in inner {
                self.heights[i] += primal * self.step[i];
            }
            for row in &mut self.rows {
                row.slack += primal * row.step.0;
                row.dual += dual * row.step.1;
            }
        }
        Outcome::Failed
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

    /// Whether the multipliers prove that nothing within the horizon is feasible: by concavity
    /// Σ z_k c_k(w) ≤ zᵀc(η) + (Jᵀz)·(w − η) for every w, and feasible w need ≥ 0.
    fn infeasible(&self) -> bool {
        let n = self.heights.len();
        let horizon = HORIZON * (n - 1) as f64;
        let sum: f64 = self.rows.iter().map(|row| row.dual * row.pass.room).sum();
        if sum >= 0.0 {
            return false;
        }
        let pull: f64 =
            (1..n - 1).map(|i| (self.gradient[i] - self.residual[i]).abs() * (horizon + self.heights[i].abs())).sum();
        sum + pull < 0.0
    }

    /// ∇²f − Σ z ∇²c + Jᵀ(Z/S)J over the inner heights.
    fn assemble(&mut self, target: Target<'_>) {
        let Self { heights, rows, inverse, matrix, .. } = self;
        let n = heights.len();
        matrix.clear(n);
        let band = &mut matrix.rows;
        let mut couple = |i: usize, left: f64, across: f64, right: f64| {
            band[i][0] += left;
            band[i + 1][1] += across;
            band[i + 1][0] += right;
        };
        if matches!(target, Target::Length) {
            for (i, inverse) in inverse.iter().enumerate() {
                let curvature = inverse * inverse * inverse;
                couple(i, curvature, -curvature, curvature);
            }
        }
        for row in rows {
            let (a, b) = row.pass.gradient;
            let (weight, bend) = (row.dual / row.slack, row.dual * row.pass.bend);
            couple(row.arc.segment, weight * a * a + bend, weight * a * b - bend, weight * b * b + bend);
        }
        if let Target::Quadratic(quadratic) = target {
            quadratic.add_to(&mut band[1..n - 1]);
        }
        // Start and goal are fixed.
        band[0] = [1.0, 0.0, 0.0];
        band[1][1] = 0.0;
        band[n - 1] = [1.0, 0.0, 0.0];
        if n > 2 {
            band[2][2] = 0.0;
        }
    }

    /// The Newton step for products `aim`, which may use the step before.
    fn direction(&mut self, aim: impl Fn(&Row) -> f64) {
        let n = self.heights.len();
        self.step.clear();
        self.step.extend(self.gradient.iter().map(|g| -g));
        for row in &mut self.rows {
            row.aim = aim(row);
            let pull = (row.aim - row.dual * row.error) / row.slack;
            self.step[row.arc.segment] += pull * row.pass.gradient.0;
            self.step[row.arc.segment + 1] += pull * row.pass.gradient.1;
        }
        self.step[0] = 0.0;
        self.step[n - 1] = 0.0;
        self.matrix.solve(&mut self.step);
        for row in &mut self.rows {
            let i = row.arc.segment;
            let slack = row.pass.gradient.0 * self.step[i] + row.pass.gradient.1 * self.step[i + 1] + row.error;
            row.step = (slack, (row.aim - row.dual * slack) / row.slack - row.dual);
        }
    }

    /// The largest steps ≤ 1 of slacks and multipliers that keep them positive, when `share` of the way to 0 is allowed.
    fn reach(&self, share: f64) -> (f64, f64) {
        let (mut primal, mut dual) = (1.0_f64, 1.0_f64);
        for row in &self.rows {
            if row.step.0 < 0.0 {
                primal = primal.min(-share * row.slack / row.step.0);
            }
            if row.step.1 < 0.0 {
                dual = dual.min(-share * row.dual / row.step.1);
            }
        }
        (primal, dual)
    }
}
