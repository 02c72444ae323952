//! Whether times are to be trusted: outliers and drift over the repeats of equal work.
//!
//! A series is one planner's runs in one scene, in the order of repeats. Where every run did the same work by all of
//! its counters, times are compared as they are; otherwise times per evaluation, so that a search which ended early is
//! not called noise. Outliers are judged on logarithms: a factor is a factor whatever the planner's speed.

use std::fmt;

use super::grid::Grid;
use crate::results::RunRecord;
use crate::statistics::holm::holm;
use crate::statistics::outliers::{THRESHOLD, modified_z_scores};
use crate::statistics::quantile;
use crate::statistics::spearman::{Spearman, spearman};

/// Shorter series say nothing.
const FEWEST: usize = 6;
/// A drift that matters: smaller ones are real at times, but no comparison turns on them.
const NOTABLE: f64 = 0.05;
/// Largest p-value of a drift, after Holm's correction over all series.
const ALPHA: f64 = 0.05;

/// The times of one planner in one scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// The planner.
    pub planner: usize,
    /// The scene.
    pub scene: usize,
    /// Runs whose times are compared.
    pub runs: usize,
    /// Whether times are per evaluation because work varied.
    pub per_evaluation: bool,
    /// Repeats whose time is an outlier.
    pub outliers: Vec<u32>,
    /// Rank correlation of time and repeat; `None` where all times are equal.
    pub drift: Option<Spearman>,
    /// The drift's p-value after Holm's correction over all series; 1 without correlation.
    pub p: f64,
    /// Median of the last third of the repeats over that of the first third.
    pub last_over_first: f64,
    /// Interquartile range over median.
    pub spread: f64,
}

impl Series {
    /// Whether times changed in the course of the repeats, beyond chance and by a notable share.
    pub fn drifted(&self) -> bool {
        self.p < ALPHA && (self.last_over_first - 1.0).abs() > NOTABLE
    }
}

/// The times of a campaign.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Noise {
    /// Every series of six runs or more, by planner, then scene.
    pub series: Vec<Series>,
}

impl Noise {
    /// Examines all times.
    pub fn new(grid: &Grid<'_>) -> Self {
        let cells = (0..grid.planners.len()).flat_map(|p| (0..grid.scenes.len()).map(move |s| (p, s)));
        let mut series: Vec<Series> = cells.filter_map(|(p, s)| examine(p, s, grid.runs(p, s))).collect();
        let adjusted = holm(&series.iter().map(|s| s.p).collect::<Vec<_>>());
        series.iter_mut().zip(adjusted).for_each(|(s, p)| s.p = p);
        Self { series }
    }

    /// The sum of it.
    pub fn verdict(&self) -> Verdict {
        let runs: usize = self.series.iter().map(|s| s.runs).sum();
        if runs == 0 {
            return Verdict::Unknown;
        }
        let outliers = self.series.iter().map(|s| s.outliers.len()).sum();
        let drifted: Vec<&Series> = self.series.iter().filter(|s| s.drifted()).collect();
        let size = |s: &Series| libm::fabs(libm::log(s.last_over_first));
        let worst = drifted.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
        let drift = worst.map(|s| Drift {
            planner: s.planner,
            scene: s.scene,
            change: s.last_over_first - 1.0,
            drifted: drifted.len(),
            series: self.series.len(),
        });
        Verdict::Known { runs, outliers, drift }
    }
}

/// The greatest drift of a campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct Drift {
    /// Whose times.
    pub planner: usize,
    /// Where.
    pub scene: usize,
    /// Relative change of the median time from the first third of the repeats to the last: 0.18 is 18 % slower.
    pub change: f64,
    /// Series that drifted.
    pub drifted: usize,
    /// Series examined.
    pub series: usize,
}

/// What to say of a campaign's times.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// No planner has enough runs in a scene.
    Unknown,
    /// Times were examined.
    Known {
        /// Runs whose times were compared.
        runs: usize,
        /// Runs whose time is an outlier.
        outliers: usize,
        /// The greatest drift, if any.
        drift: Option<Drift>,
    },
}

impl fmt::Display for Verdict {
    /// English, without names.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Known { runs, outliers, drift } = self else {
            return write!(f, "too few repeats to judge the noise of times");
        };
        match drift {
            None => write!(f, "no drift of times between repeats")?,
            Some(d) => {
                let (percent, way) = (100.0 * d.change.abs(), if d.change > 0.0 { "rose" } else { "fell" });
                write!(f, "times {way} by up to {percent:.0} % between the first and the last third of the repeats ")?;
                write!(f, "({} of {} series)", d.drifted, d.series)?;
            }
        }
        write!(f, "; {outliers} of {runs} times are outliers")
    }
}

fn examine(planner: usize, scene: usize, runs: &[&RunRecord]) -> Option<Series> {
    let work = |r: &RunRecord| (r.evaluations, r.collision_checks, r.iterations);
    let per_evaluation = runs.windows(2).any(|w| work(w[0]) != work(w[1]));
    let time = |r: &&RunRecord| {
        let time = if per_evaluation { r.time_us / r.evaluations as f64 } else { r.time_us };
        (time > 0.0 && time.is_finite()).then_some((r.repeat, time))
    };
    let (repeats, times): (Vec<u32>, Vec<f64>) = runs.iter().filter_map(time).unzip();
    if times.len() < FEWEST {
        return None;
    }
    let scores = modified_z_scores(&times.iter().map(|t| libm::log(*t)).collect::<Vec<_>>());
    let outliers = repeats.iter().zip(scores).filter(|(_, z)| z.abs() > THRESHOLD).map(|(r, _)| *r).collect();
    let order: Vec<f64> = repeats.iter().map(|r| f64::from(*r)).collect();
    let drift = spearman(&order, &times);
    let third = times.len() / 3;
    let of = |values: &[f64], q: f64| quantile(values, q).unwrap_or(f64::NAN);
    let last_over_first = of(&times[times.len() - third..], 0.5) / of(&times[..third], 0.5);
    let spread = (of(&times, 0.75) - of(&times, 0.25)) / of(&times, 0.5);
    let (runs, p) = (times.len(), drift.map_or(1.0, |d| d.p));
    Some(Series { planner, scene, runs, per_evaluation, outliers, drift, p, last_over_first, spread })
}

#[cfg(test)]
mod tests {
    use super::super::testing::one_scene;
    use super::*;
    use crate::results::Results;

    /// Thirty runs with times of about 1 ms, unequal by up to 2 % in no order, changed by `change`.
    fn timed(change: impl Fn(&mut RunRecord)) -> Results {
        let mut results = one_scene(&[("a", &[1.0; 30])]);
        for r in &mut results.runs {
            r.time_us += f64::from((r.repeat * 11) % 30) * 20.0 / 30.0;
            change(r);
        }
        results
    }

    fn noise(results: &Results) -> Noise {
        Noise::new(&Grid::new(results))
    }

    #[test]
    fn quiet_times() {
        let quiet = noise(&timed(|_| {}));
        assert_eq!(quiet.verdict(), Verdict::Known { runs: 30, outliers: 0, drift: None });
        assert_eq!(quiet.verdict().to_string(), "no drift of times between repeats; 0 of 30 times are outliers");
        assert!(quiet.series[0].spread > 0.005 && quiet.series[0].spread < 0.02);
        let short = one_scene(&[("a", &[1.0; 5])]);
        assert_eq!(noise(&short).verdict(), Verdict::Unknown);
        let equal = noise(&one_scene(&[("a", &[1.0; 6])]));
        assert_eq!((equal.series[0].drift, equal.series[0].p), (None, 1.0));
    }

    #[test]
    fn interruptions_are_outliers() {
        let noisy = noise(&timed(|r| r.time_us *= if r.repeat == 7 { 3.0 } else { 1.0 }));
        assert_eq!(noisy.series[0].outliers, [7]);
        assert!(!noisy.series[0].drifted());
    }

    #[test]
    fn drift_is_found() {
        let drifting = noise(&timed(|r| r.time_us *= 1.0 + 0.01 * f64::from(r.repeat)));
        assert!(drifting.series[0].drifted() && drifting.series[0].outliers.is_empty());
        let said = drifting.verdict().to_string();
        // The repeats' medians 24.5 and 4.5 make 1.245/1.045 = 1.19, give or take the 2 %.
        let expected = ["18", "19", "20"].map(|n| format!("times rose by up to {n} % between"));
        assert!(expected.iter().any(|e| said.starts_with(e)), "{said}");
        // The same times with as many more evaluations are the same speed.
        let honest = noise(&timed(|r| {
            r.time_us *= f64::from(1 + r.repeat);
            r.evaluations *= u64::from(1 + r.repeat);
        }));
        assert!(honest.series[0].per_evaluation && !honest.series[0].drifted());
        assert!(honest.series[0].outliers.is_empty());
    }
}
