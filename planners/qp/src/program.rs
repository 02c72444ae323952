//! One conic programme: min ½xᵀPx + qᵀx, Ax + s = b, s ∈ K, by clarabel.
//!
//! Goulart & Chen, *Clarabel: An interior-point solver for conic programs with
//! quadratic objectives* (2024), arXiv 2405.12762. Data should be scaled to
//! the order of 1: tolerances are 1e-10.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT, SolverStatus, SupportedConeT,
};

/// A banded quadratic ½xᵀPx + qᵀx, built from squares.
#[derive(Debug, Clone)]
pub(crate) struct Quadratic {
    unknowns: usize,
    /// Entries of a column: the diagonal and those above it.
    depth: usize,
    /// Column by column; `band[j * depth + k]` is P(j − k, j).
    band: Vec<f64>,
    linear: Vec<f64>,
}

impl Quadratic {
    /// Zero, in `unknowns` variables, to couple those at most `bandwidth` apart.
    pub(crate) fn new(unknowns: usize, bandwidth: usize) -> Self {
        let depth = bandwidth + 1;
        Self { unknowns, depth, band: vec![0.0; unknowns * depth], linear: vec![0.0; unknowns] }
    }

    /// Adds w(Σ cₖ xₖ + constant)²; `terms` are (k, cₖ), each k once.
    pub(crate) fn add_square(&mut self, w: f64, terms: &[(usize, f64)], constant: f64) {
        for &(j, cj) in terms {
            self.linear[j] += 2.0 * w * constant * cj;
            for &(i, ci) in terms {
                if i <= j {
                    self.band[j * self.depth + (j - i)] += 2.0 * w * ci * cj;
                }
            }
        }
    }

    /// Adds c times unknown j.
    pub(crate) fn add_linear(&mut self, j: usize, c: f64) {
        self.linear[j] += c;
    }

    /// ½xᵀPx + qᵀx, and its gradient Px + q into `gradient`.
    pub(crate) fn evaluate(&self, x: &[f64], gradient: &mut [f64]) -> f64 {
        gradient.copy_from_slice(&self.linear);
        for j in 0..self.unknowns {
            gradient[j] += self.band[j * self.depth] * x[j];
            for k in 1..self.depth.min(j + 1) {
                let v = self.band[j * self.depth + k];
                gradient[j] += v * x[j - k];
                gradient[j - k] += v * x[j];
            }
        }
        // xᵀ(Px + q) + qᵀx, halved.
        0.5 * x.iter().zip(gradient.iter().zip(&self.linear)).map(|(x, (g, q))| x * (g + q)).sum::<f64>()
    }

    /// Adds P to the rows of a matrix of half-bandwidth 2, which is P's own at most.
    pub(crate) fn add_to(&self, rows: &mut [[f64; 3]]) {
        for (row, band) in rows.iter_mut().zip(self.band.chunks_exact(self.depth)) {
            for (entry, v) in row.iter_mut().zip(band) {
                *entry += v;
            }
        }
    }

    /// The upper triangle: clarabel reads a lower one as its diagonal.
    fn upper(&self) -> CscMatrix<f64> {
        let n = self.unknowns;
        let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for j in 0..n {
            for k in (0..self.depth.min(j + 1)).rev() {
                let v = self.band[j * self.depth + k];
                if v != 0.0 {
                    rows.push(j - k);
                    values.push(v);
                }
            }
            starts.push(rows.len());
        }
        CscMatrix::new(n, n, starts, rows, values)
    }
}

/// Rows of A and b, row by row.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rows {
    terms: Vec<(usize, f64)>,
    ends: Vec<usize>,
    rhs: Vec<f64>,
}

impl Rows {
    /// Appends Σ aₖ xₖ + s = b.
    pub(crate) fn push(&mut self, terms: impl IntoIterator<Item = (usize, f64)>, b: f64) {
        self.terms.extend(terms);
        self.ends.push(self.terms.len());
        self.rhs.push(b);
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.rhs.len()
    }

    fn matrix(&self, columns: usize) -> CscMatrix<f64> {
        // Counting sort by column; rows stay ascending within each.
        let mut starts = vec![0; columns + 1];
        for &(j, _) in &self.terms {
            starts[j + 1] += 1;
        }
        for j in 0..columns {
            starts[j + 1] += starts[j];
        }
        let mut next = starts.clone();
        let (mut rows, mut values) = (vec![0; self.terms.len()], vec![0.0; self.terms.len()]);
        let mut begin = 0;
        for (i, &end) in self.ends.iter().enumerate() {
            for &(j, a) in &self.terms[begin..end] {
                rows[next[j]] = i;
                values[next[j]] = a;
                next[j] += 1;
            }
            begin = end;
        }
        CscMatrix::new(self.len(), columns, starts, rows, values)
    }
}

/// What the solver found.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Answer {
    /// A minimiser, perhaps of reduced accuracy: the caller checks it.
    Point {
        /// x.
        x: Vec<f64>,
        /// The multipliers of the rows.
        multipliers: Vec<f64>,
    },
    /// There is no feasible point.
    Infeasible,
    /// Neither, for numerical reasons.
    Failed,
}

/// Solves min ½xᵀPx + qᵀx where the first rows are inequalities (s ≥ 0) and
/// the last 3·`cones` form second-order cones, three rows each.
pub(crate) fn solve(objective: &Quadratic, rows: &Rows, cones: usize) -> Answer {
    let inequalities = rows.len() - 3 * cones;
    let mut kinds: Vec<SupportedConeT<f64>> = Vec::with_capacity(1 + cones);
    if inequalities > 0 {
        kinds.push(NonnegativeConeT(inequalities));
    }
    kinds.extend((0..cones).map(|_| SecondOrderConeT(3)));
    let settings = DefaultSettings {
        verbose: false,
        direct_solve_method: "qdldl".to_owned(),
        presolve_enable: false,
        tol_feas: 1e-10,
        tol_gap_abs: 1e-10,
        tol_gap_rel: 1e-10,
        reduced_tol_feas: 1e-8,
        reduced_tol_gap_abs: 1e-7,
        reduced_tol_gap_rel: 1e-7,
        ..DefaultSettings::default()
    };
    let (p, a) = (objective.upper(), rows.matrix(objective.unknowns));
    let Ok(mut solver) = DefaultSolver::new(&p, &objective.linear, &a, &rows.rhs, &kinds, settings) else {
        return Answer::Failed;
    };
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved if solver.solution.x.iter().all(|x| x.is_finite()) => {
            let solution = &mut solver.solution;
            Answer::Point { x: std::mem::take(&mut solution.x), multipliers: std::mem::take(&mut solution.z) }
        }
        SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => Answer::Infeasible,
        _ => Answer::Failed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// min (x₀ − 1)² + (x₁ − x₀)² with x₁ ≥ 4: x₀ = 2.5.
    #[test]
    fn squares_build_the_upper_triangle() {
        let mut q = Quadratic::new(2, 1);
        q.add_square(1.0, &[(0, 1.0)], -1.0);
        q.add_square(1.0, &[(1, 1.0), (0, -1.0)], 0.0);
        let mut rows = Rows::default();
        rows.push([(1, -1.0)], -4.0);
        let Answer::Point { x, .. } = solve(&q, &rows, 0) else { panic!() };
        // 1e-7: a gap of 1e-10 in the objective is the square of the distance.
        assert!((x[0] - 2.5).abs() < 1e-7 && (x[1] - 4.0).abs() < 1e-7, "{x:?}");
    }

    #[test]
    fn infeasibility_is_told_from_failure() {
        let mut rows = Rows::default();
        rows.push([(0, 1.0)], 0.0);
        rows.push([(0, -1.0)], -1.0);
        let mut q = Quadratic::new(1, 0);
        q.add_square(1.0, &[(0, 1.0)], 0.0);
        assert_eq!(solve(&q, &rows, 0), Answer::Infeasible);
    }

    /// min t with ‖(3, 4)‖ ≤ t.
    #[test]
    fn cones_come_after_inequalities() {
        let mut q = Quadratic::new(1, 0);
        q.add_linear(0, 1.0);
        let mut rows = Rows::default();
        rows.push([(0, 1.0)], 10.0);
        rows.push([(0, -1.0)], 0.0);
        rows.push([], 3.0);
        rows.push([], 4.0);
        let Answer::Point { x, .. } = solve(&q, &rows, 1) else { panic!() };
        assert!((x[0] - 5.0).abs() < 1e-8, "{x:?}; ten times the gap tolerance and more");
    }
}
