//! The paper's numbers, and a setting for every gap it leaves.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of [`InfluenceAstar`](crate::InfluenceAstar). Defaults are the paper's
/// values and, where it is silent, the reading marked so.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Weight a of the length L, 0 or 10⁻⁹ … 10⁶; a + b > 0. Where both weights count,
    /// a·dis is at least 10⁻¹⁰ of b times the largest of `delta` and `kernel`: costs
    /// are compared in whole quanta, in which a smaller a would be nothing (a = 0 is
    /// exact: the least length among the safest). Paper: 0.4, the best of its sweep.
    pub a: f64,
    /// Weight b of the risk W, 0 or 10⁻⁹ … 10⁶. Paper: 0.6; b = 1 − a throughout.
    pub b: f64,
    /// Columns of cells over the pitch, 1 … 1000. Paper: 61. Cells are squares of
    /// side max(width/columns, height/rows), so on pitches of another shape than
    /// 61 : 36 some rows or columns lie outside and are not entered (reading).
    pub columns: usize,
    /// Rows of cells, 1 … 1000. Paper: 36.
    pub rows: usize,
    /// What a cell's side counts in L, 10⁻⁶ … 10⁶. Paper: 30. L is measured
    /// in these units and not in the scene's, so that the balance of L and W is
    /// the paper's on a pitch of any size and unit.
    pub dis: f64,
    /// Risk δ of a level, 0 or 10⁻⁹ … 10⁶. Paper: 5.
    pub delta: f64,
    /// Risk added on the square rings round a defender's cell, the cell itself
    /// first: at most 100 values, 0 or 10⁻⁹ … 10⁶, never rising. The paper states 100 for
    /// the cell and a fall outwards; 60 and 30 are read from a picture.
    pub kernel: Vec<f64>,
    /// How the cost that remains is estimated. Paper: `"paper"`.
    pub heuristic: Heuristic,
    /// What cells under an obstacle are. Default `"blocked"`; the paper keeps away
    /// by risk alone, `"soft"`.
    pub obstacles: Obstacles,
    /// Where the search begins. Paper: `"rectangle"`.
    pub search_space: SearchSpace,
    /// Largest mean risk per cell of a path that is safe enough, ≥ 0: above it the
    /// rectangle is widened. Ignored with `search_space = "pitch"`. Not in the paper;
    /// default 15, three levels: lower values widen nearly always, since hardly any path
    /// to the goal avoids all defenders' regions.
    ///
    /// The rectangle saves work where it is widened little: against five defenders
    /// `heuristic = "ring"` expands 278 cells in it and 344 on the whole pitch, in the mean.
    /// Against more it is widened often, each time searching anew, and the whole pitch
    /// is cheaper: means over ten `wall` scenes of one seed are 15 000 to 21 000
    /// evaluations against 5 500 to 7 200, in about twice the time, and four
    /// instants of a recorded game take 1896, 627, 691 and 100 expansions against 1288,
    /// 393, 568 and 34, for paths that cost as much or more.
    pub theta: f64,
    /// The rectangle is widened again only if the last widening lowered the cost
    /// by more than this share of it, 0 … 1. Ignored with `search_space = "pitch"`. Not in the paper; default 0.01.
    pub eta: f64,
    /// Cells by which each side of the rectangle moves outwards at a time,
    /// 1 … 1000. Ignored with `search_space = "pitch"`. Not in the paper; default 3.
    pub widening: usize,
}

/// How the cost from a cell n to the goal D is estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Heuristic {
    /// The paper's h = a·M·dis + b·M·w̄: M the Manhattan distance in cells, w̄ the
    /// mean risk of the search space. (The paper writes one L for both; a length in
    /// the first term and a number of cells in the second is a reading.) Neither
    /// admissible nor consistent: closed cells are reopened, and the path
    /// may cost more than it need. The default, being what the paper does.
    Paper,
    /// h = a·dis·octile + b·Σₖ (least risk on the square ring of radius k round D),
    /// k = 0 … M∞ − 1, M∞ the Chebyshev distance: every path enters a cell of each
    /// ring. Consistent, so the path is optimal on the grid.
    Ring,
    /// h = 0: Dijkstra's algorithm. Optimal, and the yardstick for the others.
    None,
}

/// What a cell under an obstacle is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Obstacles {
    /// A cell that an inflated obstacle touches cannot be entered.
    Blocked,
    /// Only risk keeps the path away, as in the paper. A path that collides all
    /// the same is not found.
    Soft,
}

/// Where the search begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SearchSpace {
    /// In the rectangle between start and goal, widened as need be.
    Rectangle,
    /// On the whole pitch.
    Pitch,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            a: 0.4,
            b: 0.6,
            columns: 61,
            rows: 36,
            dis: 30.0,
            delta: 5.0,
            kernel: vec![100.0, 60.0, 30.0],
            heuristic: Heuristic::Paper,
            obstacles: Obstacles::Blocked,
            search_space: SearchSpace::Rectangle,
            theta: 15.0,
            eta: 0.01,
            widening: 3,
        }
    }
}

impl Settings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        const MOST: f64 = 1e6;
        // Products of two values within these bounds, and quanta of them, are far from under- and overflow.
        let sound = |value: f64| value == 0.0 || (1e-9..=MOST).contains(&value);
        for (key, value) in [("a", self.a), ("b", self.b), ("delta", self.delta)] {
            SettingError::check(sound(value), key, value, "0, or 1e-9 to 1e6")?;
        }
        SettingError::check(self.a + self.b > 0.0, "b", self.b, "a + b above 0")?;
        for (key, count) in [("columns", self.columns), ("rows", self.rows), ("widening", self.widening)] {
            SettingError::check((1..=1000).contains(&count), key, count, "1 to 1000")?;
        }
        SettingError::check((1e-6..=MOST).contains(&self.dis), "dis", self.dis, "1e-6 to 1e6")?;
        let falls = self.kernel.windows(2).all(|w| w[0] >= w[1]);
        SettingError::check(
            falls && self.kernel.len() <= 100 && self.kernel.iter().all(|w| sound(*w)),
            "kernel",
            format!("{:?}", self.kernel),
            "at most 100 values, each 0 or from 1e-9 to 1e6, none above the one before",
        )?;
        // A kernel never rises: its first value is its largest.
        let dearest = self.kernel.first().copied().unwrap_or(0.0).max(self.delta);
        let balanced = self.a == 0.0 || self.a * self.dis >= 1e-10 * self.b * dearest;
        SettingError::check(
            balanced,
            "a",
            self.a,
            "0, or a dis at least 1e-10 b times the largest of delta and kernel",
        )?;
        SettingError::check(self.theta >= 0.0 && self.theta.is_finite(), "theta", self.theta, "0 or more, finite")?;
        SettingError::check((0.0..=1.0).contains(&self.eta), "eta", self.eta, "0 to 1")
    }
}
