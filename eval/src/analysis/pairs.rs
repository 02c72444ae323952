//! Every planner against every other one.

use super::blocks::{Blocks, Measure, Over, values_in};
use super::grid::Grid;
use crate::statistics::bootstrap::{Resamples, ratio_interval};
use crate::statistics::effect_size::a12;
use crate::statistics::holm::holm;
use crate::statistics::median;
use crate::statistics::median_interval::median_interval;
use crate::statistics::wilcoxon::{SignedRank, Zeros, signed_rank};

/// Resamples behind a bootstrap interval.
pub const RESAMPLES: usize = 2000;
const SEED: u64 = 0;
/// With fewer blocks an interval of 95 % does not exist without assumptions, and a bootstrap's is too narrow.
const FEWEST: usize = 6;

/// A ratio of two planners' figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ratio {
    /// The ratio, a over b; positive and finite.
    pub value: f64,
    /// Its 95 % interval, ends 0 and +∞ possible; `None` for fewer than six blocks.
    pub interval: Option<[f64; 2]>,
}

impl Ratio {
    /// b over a.
    pub fn inverse(self) -> Self {
        Self { value: 1.0 / self.value, interval: self.interval.map(|[low, high]| [1.0 / high, 1.0 / low]) }
    }
}

/// One planner against another.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// One planner.
    pub a: usize,
    /// The other one, after it in the grid.
    pub b: usize,
    /// Blocks in which both have runs.
    pub blocks: usize,
    /// Medians of a and b over these blocks: 0 is at the optimum, +∞ half failed.
    pub medians: [f64; 2],
    /// How many times b's figure a's is. Gap and length: of the medians, with a paired bootstrap interval. Time: the
    /// median of the blocks' ratios, with an order-statistic interval. `None` where a figure is 0 or +∞.
    pub ratio: Option<Ratio>,
    /// Wilcoxon's signed-rank test of the differences a − b, of logarithms for times, with Pratt's zeros; `None`
    /// without evidence: no common blocks, or the repeats of both are all alike, which is one observation.
    pub test: Option<SignedRank>,
    /// Its p-value after Holm's correction over all pairs of this measure.
    pub p: Option<f64>,
    /// Vargha and Delaney's A₁₂: how probably a run of a beats one of b in the same scene, ties halved, mean over
    /// scenes; `None` where they share no scene.
    pub a12: Option<f64>,
}

impl Pair {
    /// The medians, those of `planner`, a or b, first.
    pub fn medians_of(&self, planner: usize) -> [f64; 2] {
        let [x, y] = self.medians;
        if planner == self.a { [x, y] } else { [y, x] }
    }

    /// How many times the other one's figure that of `planner`, a or b, is.
    pub fn ratio_of(&self, planner: usize) -> Option<Ratio> {
        if planner == self.a { self.ratio } else { self.ratio.map(Ratio::inverse) }
    }
}

/// All pairs of planners by one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Pairs {
    /// What is compared.
    pub measure: Measure,
    /// What the blocks are.
    pub over: Over,
    /// The pairs a < b, sorted.
    pub pairs: Vec<Pair>,
}

impl Pairs {
    /// Compares every pair.
    pub fn new(grid: &Grid<'_>, measure: Measure) -> Self {
        let blocks = Blocks::new(grid, measure);
        let planners = grid.planners.len();
        let mut wins = Wins::new(planners);
        for scene in 0..grid.scenes.len() {
            wins.add(&values_in(grid, scene, measure));
        }
        let bootstrap = Bootstrap::new(&blocks, measure);
        let couples = (0..planners).flat_map(|a| (a + 1..planners).map(move |b| (a, b)));
        let mut pairs: Vec<Pair> = couples
            .map(|(a, b)| Pair { a12: wins.share(a, b), ..compare(&blocks, &bootstrap, measure, a, b) })
            .collect();
        let tested: Vec<f64> = pairs.iter().filter_map(|pair| pair.test.map(|t| t.p)).collect();
        let mut adjusted = holm(&tested).into_iter();
        for pair in pairs.iter_mut().filter(|pair| pair.test.is_some()) {
            pair.p = adjusted.next();
        }
        Self { measure, over: blocks.over, pairs }
    }

    /// The comparison of two planners, whichever comes first.
    pub fn of(&self, a: usize, b: usize) -> Option<&Pair> {
        self.pairs.iter().find(|pair| (pair.a, pair.b) == (a.min(b), a.max(b)))
    }
}

fn compare(blocks: &Blocks, bootstrap: &Bootstrap, measure: Measure, a: usize, b: usize) -> Pair {
    let (x, y) = blocks.both(a, b);
    let middle = |v: &[f64]| median(v).unwrap_or(f64::INFINITY);
    let medians = [middle(&x), middle(&y)];
    let time = measure == Measure::Time;
    let settled = blocks.settled[a] && blocks.settled[b];
    let difference = |(x, y): (&f64, &f64)| match (time, x == y) {
        // Two failures as well: infinity less infinity.
        (_, true) => 0.0,
        (false, _) => x - y,
        (true, _) => libm::log(*x) - libm::log(*y),
    };
    let differences: Vec<f64> = x.iter().zip(&y).map(difference).collect();
    let ratio = if time { ratio_of_times(&x, &y) } else { bootstrap.ratio(a, b, &x, &y, medians) };
    let test = if settled { None } else { signed_rank(&differences, Zeros::Pratt) };
    Pair { a, b, blocks: x.len(), medians, ratio, test, p: None, a12: None }
}

fn ratio_of_times(x: &[f64], y: &[f64]) -> Option<Ratio> {
    let ratios: Vec<f64> = x.iter().zip(y).map(|(x, y)| if x == y { 1.0 } else { x / y }).collect();
    let value = median(&ratios).filter(|r| *r > 0.0 && r.is_finite())?;
    Some(Ratio { value, interval: median_interval(&ratios).map(|i| [i.low, i.high]) })
}

/// Resampled medians of the planners that have every block, drawn together.
struct Bootstrap {
    medians: Vec<Option<Vec<f64>>>,
}

impl Bootstrap {
    fn new(blocks: &Blocks, measure: Measure) -> Self {
        let n = blocks.values.first().map_or(0, Vec::len);
        if measure == Measure::Time || n < FEWEST {
            return Self { medians: vec![None; blocks.values.len()] };
        }
        let resamples = Resamples::new(n, RESAMPLES, SEED);
        let whole = |column: &Vec<Option<f64>>| column.iter().copied().collect::<Option<Vec<f64>>>();
        Self { medians: blocks.values.iter().map(|c| whole(c).map(|v| resamples.medians(&v))).collect() }
    }

    fn ratio(&self, a: usize, b: usize, x: &[f64], y: &[f64], medians: [f64; 2]) -> Option<Ratio> {
        if medians.iter().any(|m| *m == 0.0 || m.is_infinite()) {
            return None;
        }
        let interval = match (&self.medians[a], &self.medians[b]) {
            _ if x.len() < FEWEST => None,
            (Some(a), Some(b)) => ratio_interval(a, b),
            // One of them lacks blocks: the common ones are resampled on their own.
            _ => {
                let resamples = Resamples::new(x.len(), RESAMPLES, SEED);
                ratio_interval(&resamples.medians(x), &resamples.medians(y))
            }
        };
        Some(Ratio { value: medians[0] / medians[1], interval })
    }
}

/// Sums of A₁₂ over scenes.
struct Wins {
    planners: usize,
    sums: Vec<f64>,
    scenes: Vec<usize>,
}

impl Wins {
    fn new(planners: usize) -> Self {
        Self { planners, sums: vec![0.0; planners * planners], scenes: vec![0; planners * planners] }
    }

    /// Adds a scene with the values of each planner.
    fn add(&mut self, values: &[Vec<f64>]) {
        for a in 0..self.planners {
            for b in a + 1..self.planners {
                // The lesser value wins.
                if let Some(share) = a12(&values[b], &values[a]) {
                    self.sums[a * self.planners + b] += share;
                    self.scenes[a * self.planners + b] += 1;
                }
            }
        }
    }

    fn share(&self, a: usize, b: usize) -> Option<f64> {
        let at = a * self.planners + b;
        (self.scenes[at] > 0).then(|| self.sums[at] / self.scenes[at] as f64)
    }
}
