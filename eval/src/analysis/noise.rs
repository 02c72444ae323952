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
