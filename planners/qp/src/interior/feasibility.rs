//! Proofs that no heights keep all arcs.

use super::{Interior, PATIENCE, TURN, Target};

/// Heights within which infeasibility is proved, in lengths of start → goal.
const HORIZON: f64 = 100.0;

/// Weight of ½‖η − η₀‖² beside ½‖min(c, 0)‖² in the search for the least violation.
pub(super) const ANCHOR: f64 = 1e-10;

impl Interior {
    /// Whether the multipliers prove that nothing within the horizon is feasible to `within`: by concavity
    /// Σ zₖcₖ(w) ≤ zᵀc(η) + (Jᵀz)·(w − η) for every w.
    pub(super) fn infeasible(&self, within: f64) -> bool {
        let inner = 1..self.heights.len() - 1;
        let horizon = HORIZON * inner.end as f64;
        let sum: f64 = self.rows.iter().map(|row| row.dual * (row.pass.room + within)).sum();
        let pull = |i: usize| (self.gradient[i] - self.residual[i]).abs() * (horizon + self.heights[i].abs());
        sum < 0.0 && sum + inner.map(pull).sum::<f64>() < 0.0
    }

    /// Whether the heights of least ½‖min(c, 0)‖² prove that none are feasible: there z = −min(c, 0) has Jᵀz ≈ 0.
    /// Leaves the heights there.
    pub(super) fn least_violation(&mut self, within: f64) -> bool {
        self.heights.clone_from(&self.first);
        self.tangents.fill(0.0);
        for _ in 0..PATIENCE {
            for i in 0..self.rows.len() {
                let room = self.pass(&self.rows[i].arc).room;
                self.rows[i].dual = (-room).max(0.0);
                self.rows[i].slack = room;
            }
            // Only for passes, curvatures and Jᵀz: f has no part in it.
            self.evaluate(Target::Length);
            if self.infeasible(within) {
                return true;
            }
            self.assemble(Target::Anchor, |row| if row.dual > 0.0 { 1.0 } else { 0.0 });
            if !self.matrix.factor() {
                return false;
            }
            self.step.clear();
            self.step.extend(self.heights.iter().zip(&self.first).map(|(y, first)| ANCHOR * (first - y)));
            for (step, (gradient, residual)) in self.step.iter_mut().zip(self.gradient.iter().zip(&self.residual)) {
                *step += gradient - residual;
            }
            self.solve_step();
            let (mut reach, before) = ((TURN / self.turn()).min(1.0), self.violation());
            self.go(reach);
            while self.violation() > before && reach > 1e-3 {
                reach *= 0.5;
                self.go(-reach);
            }
        }
        false
    }

    /// ‖min(c, 0)‖².
    fn violation(&self) -> f64 {
        self.rows.iter().map(|row| self.pass(&row.arc).room.min(0.0)).map(|room| room * room).sum()
    }
}
