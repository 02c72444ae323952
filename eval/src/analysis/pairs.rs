//! Every planner against every other one.

use super::blocks::{Blocks, Measure, Over, rounded, values_in};
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
    /// The least p-value that so many blocks and tests allow, min(1, m·2·2⁻ⁿ) with n blocks and m tests: all
    /// differences of one sign. Where it is no evidence, nothing that the planners do is.
    pub least_p: Option<f64>,
    /// Vargha and Delaney's A₁₂: how probably a run of a beats one of b in the same scene, ties halved, mean over
    /// scenes; `None` where they share no scene.
    pub a12: Option<f64>,
}

impl Pair {
    /// A₁₂ of `planner`, a or b, over the other one.
    pub fn a12_of(&self, planner: usize) -> Option<f64> {
        if planner == self.a { self.a12 } else { self.a12.map(|share| 1.0 - share) }
    }

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
        for (pair, p) in pairs.iter_mut().filter(|pair| pair.test.is_some()).zip(holm(&tested)) {
            pair.p = Some(p);
            pair.least_p = Some((2.0 * tested.len() as f64 * libm::exp2(-(pair.blocks as f64))).min(1.0));
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
        // Rounded, equal differences of rounded values are ties.
        (false, _) => rounded(x - y),
        (true, _) => libm::log(*x) - libm::log(*y),
    };
    let differences: Vec<f64> = x.iter().zip(&y).map(difference).collect();
    let ratio = if time { ratio_of_times(&x, &y) } else { bootstrap.ratio(a, b, &x, &y, medians) };
    let test = if settled { None } else { signed_rank(&differences, Zeros::Pratt) };
    Pair { a, b, blocks: x.len(), medians, ratio, test, p: None, least_p: None, a12: None }
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

#[cfg(test)]
mod tests {
    use super::super::testing::{one_scene, results, run};
    use super::*;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn a_clear_difference() {
        let a: Vec<f64> = (0..10).map(|i| 1.0 + 0.1 * f64::from(i)).collect();
        let b: Vec<f64> = a.iter().map(|g| 4.0 * g).collect();
        let results = one_scene(&[("a", &a), ("b", &b), ("c", &[4.0; 10])]);
        let pairs = Pairs::new(&Grid::new(&results), Measure::Gap);
        assert_eq!((pairs.pairs.len(), pairs.over), (3, Over::Repeats));
        let pair = pairs.of(1, 0).unwrap();
        assert_eq!((pair.a, pair.b, pair.blocks, pair.a12), (0, 1, 10, Some(1.0)));
        let ratio = pair.ratio_of(1).unwrap();
        let [low, high] = ratio.interval.unwrap();
        // Every resample's ratio is 4; gaps are multiples of 10⁻⁹, so good to 1e-7 of their 1 %.
        assert!([ratio.value, low, high].iter().all(|r| (r - 4.0).abs() < 4e-7), "{ratio:?}");
        // Ten differences of one sign: p = 2/2¹⁰, the least of three, times three.
        assert_eq!((pair.test.unwrap().p, pair.p), (2.0 / 1024.0, Some(6.0 / 1024.0)));
        assert_eq!(pair.least_p, pair.p);
        assert!(pairs.pairs.iter().all(|p| p.p.is_some_and(|q| q <= 6.0 / 1024.0)));
    }

    #[test]
    fn what_never_varies_is_one_observation() {
        let results = one_scene(&[("a", &[1.0; 30]), ("b", &[2.0; 30]), ("c", &[INF; 30]), ("d", &[0.0; 30])]);
        let pairs = Pairs::new(&Grid::new(&results), Measure::Gap);
        assert!(pairs.pairs.iter().all(|p| p.test.is_none() && p.p.is_none()));
        assert!(pairs.of(0, 1).unwrap().ratio.is_some());
        assert!(pairs.of(0, 2).unwrap().ratio.is_none() && pairs.of(0, 3).unwrap().ratio.is_none());
        assert_eq!(pairs.of(2, 3).unwrap().medians, [INF, 0.0]);
        // Their times may well vary.
        let times = Pairs::new(&Grid::new(&results), Measure::Time);
        assert_eq!(times.of(0, 2).unwrap().a12, Some(1.0), "fast failure is no merit");
    }

    #[test]
    fn failures_count() {
        // a is nearer where it succeeds but fails in 8 of 10.
        let mut a = [INF; 10];
        (a[0], a[1]) = (0.1, 0.1);
        let b: Vec<f64> = (0..10).map(|i| 5.0 + f64::from(i)).collect();
        let results = one_scene(&[("a", &a), ("b", &b)]);
        let pairs = Pairs::new(&Grid::new(&results), Measure::Gap);
        let pair = &pairs.pairs[0];
        let test = pair.test.unwrap();
        // Two small negative differences, ranks 1 and 2; the eight failures share the ranks 3 … 10.
        assert_eq!((test.negative, test.positive), (3.0, 52.0));
        assert_eq!(pair.medians[0], INF);
        assert_eq!(pair.ratio, None);
        assert!((pair.a12.unwrap() - 0.2).abs() < 1e-15, "two of ten beat every one of b's");
    }

    #[test]
    fn scenes_not_repeats_are_the_evidence() {
        let names: Vec<String> = (0..4).map(|i| format!("s{i}")).collect();
        let scenes: Vec<(&str, Option<f64>)> = names.iter().map(|n| (n.as_str(), Some(10.0))).collect();
        let cells = scenes.iter().flat_map(|s| (0..50).flat_map(|r| [(s.0, "a", r, 11.0), (s.0, "b", r, 12.0)]));
        let runs = cells.map(|(s, p, r, l)| run(s, p, r, l + 0.001 * f64::from(r))).collect();
        let results = results(&["a", "b"], &scenes, runs);
        let pairs = Pairs::new(&Grid::new(&results), Measure::Gap);
        let pair = &pairs.pairs[0];
        // Two of 2⁴ signs, however many repeats.
        assert_eq!((pairs.over, pair.blocks, pair.p, pair.least_p), (Over::Scenes, 4, Some(0.125), Some(0.125)));
        assert_eq!(pair.ratio.unwrap().interval, None);
    }

    #[test]
    fn times_are_compared_by_their_ratios() {
        let mut results = one_scene(&[("a", &[1.0; 9]), ("b", &[1.0; 9])]);
        for r in &mut results.runs {
            let factor = if r.planner == "a" { 1.0 } else { f64::from(10 + r.repeat) };
            r.time_us = factor * f64::from(1 + r.repeat);
        }
        let pair = &Pairs::new(&Grid::new(&results), Measure::Time).pairs[0];
        // Ratios 10 … 18: median 14, second and eighth of nine; all differences of one sign.
        let ratio = pair.ratio_of(0).unwrap();
        assert!((pair.ratio_of(1).unwrap().value - 14.0).abs() < 1e-12, "b over a is the other way");
        assert!((ratio.value * 14.0 - 1.0).abs() < 1e-12, "{ratio:?}");
        let [low, high] = ratio.interval.unwrap();
        assert!((low * 17.0 - 1.0).abs() < 1e-12 && (high * 11.0 - 1.0).abs() < 1e-12, "{ratio:?}");
        assert_eq!(pair.p, Some(2.0 / 512.0));
    }

    #[test]
    fn missing_runs_leave_their_blocks_out() {
        let a: Vec<f64> = (0..12).map(|i| 1.0 + 0.1 * f64::from(i)).collect();
        let b: Vec<f64> = a.iter().map(|g| 2.0 * g).collect();
        let results = one_scene(&[("a", &a), ("b", &b[..8]), ("c", &[])]);
        let pairs = Pairs::new(&Grid::new(&results), Measure::Gap);
        let pair = pairs.of(0, 1).unwrap();
        assert_eq!(pair.blocks, 8);
        assert!((pair.ratio.unwrap().interval.unwrap()[0] - 0.5).abs() < 1e-6);
        let nobody = pairs.of(0, 2).unwrap();
        assert_eq!((nobody.blocks, nobody.ratio, nobody.p, nobody.a12), (0, None, None, None));
    }
}
