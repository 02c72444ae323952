//! What the figures over all test scenes start from, computed once.

use super::language::Strings;
use crate::analysis::pairs::Pairs;
use crate::analysis::{Curves, Effort, Grid, Measure, counted_gap, counted_length, quality};
use crate::results::{Results, RunRecord, Subject};
use crate::statistics::median;
use crate::statistics::median_interval::{MedianInterval, median_interval};

/// The runs by planner and scene, and what follows from them.
pub struct Evidence<'a> {
    /// The campaign.
    pub results: &'a Results,
    /// Its runs in test scenes.
    pub grid: Grid<'a>,
    /// Their gaps against effort.
    pub curves: Curves,
    /// Planners against each other by quality.
    pub quality: Pairs,
    /// Planners against each other by time.
    pub times: Pairs,
    /// For each scene what lengths are measured against: its optimum, else the least valid length in it.
    references: Vec<f64>,
}

/// A planner's figure: a median over runs in one scene, over scenes of their medians in several.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Typical {
    /// The median; +∞ where half of the values or more are.
    pub median: f64,
    /// Its order-statistic interval; `None` below six values.
    pub interval: Option<MedianInterval>,
}

impl Typical {
    /// The ends of the interval.
    pub fn ends(&self) -> Option<[f64; 2]> {
        self.interval.map(|i| [i.low, i.high])
    }
}

impl<'a> Evidence<'a> {
    /// Examines `results`.
    pub fn new(results: &'a Results) -> Self {
        let grid = Grid::new(results);
        let curves = Curves::new(&grid);
        let quality = Pairs::new(&grid, quality(&grid));
        let times = Pairs::new(&grid, Measure::Time);
        let shortest = |scene: usize| {
            let runs = (0..grid.planners.len()).flat_map(|p| grid.runs(p, scene)).filter(|r| r.valid);
            runs.filter_map(|r| r.length).fold(f64::INFINITY, f64::min)
        };
        let known = |scene: usize| grid.scenes[scene].optimum.length.unwrap_or_else(|| shortest(scene));
        let references = (0..grid.scenes.len()).map(known).collect();
        Self { results, grid, curves, quality, times, references }
    }

    /// Whether times of different planners compare: of tunings they do not, where one searches and another is given.
    pub fn times_compare(&self) -> bool {
        self.results.subject != Subject::Behaviour
    }

    /// Label of a planner.
    pub fn label(&self, planner: usize) -> &'a str {
        &self.results.planners[planner].label
    }

    /// The scenes of the grid that any planner has runs in; an unfinished campaign lacks some.
    pub fn scenes(&self) -> Vec<usize> {
        let run = |s: &usize| (0..self.grid.planners.len()).any(|p| !self.grid.runs(p, *s).is_empty());
        (0..self.grid.scenes.len()).filter(run).collect()
    }

    /// The figure of `planner` by `value` in `scenes`; `None` where it has no runs there.
    pub fn typical(
        &self,
        planner: usize,
        scenes: &[usize],
        value: &dyn Fn(&RunRecord, usize) -> f64,
    ) -> Option<Typical> {
        let in_scene = |s: usize| -> Vec<f64> { self.grid.runs(planner, s).iter().map(|r| value(r, s)).collect() };
        let values = match scenes {
            [scene] => in_scene(*scene),
            _ => scenes.iter().filter_map(|s| median(&in_scene(*s))).collect(),
        };
        Some(Typical { median: median(&values)?, interval: median_interval(&values) })
    }

    /// Its quality: gap, or where an optimum is not known the length, of several scenes in multiples of the shortest.
    pub fn quality_of(&self, planner: usize, scenes: &[usize]) -> Option<Typical> {
        let one = self.grid.scenes.len() == 1;
        self.typical(planner, scenes, &|r, s| match self.quality.measure {
            Measure::Gap => counted_gap(r, self.references[s]),
            _ if one => counted_length(r),
            _ => counted_length(r) / self.references[s],
        })
    }

    /// Its time; failed runs take time too.
    pub fn time_of(&self, planner: usize, scenes: &[usize]) -> Option<Typical> {
        self.typical(planner, scenes, &|r, _| r.time_us)
    }

    /// Its valid runs and all its runs in `scenes`.
    pub fn valid(&self, planner: usize, scenes: &[usize]) -> (usize, usize) {
        let runs = || scenes.iter().flat_map(|s| self.grid.runs(planner, *s));
        (runs().filter(|r| r.valid).count(), runs().count())
    }

    /// What a caption of curves against effort says of planners: of `absent` ones with words for them, and of those of
    /// which only the whole run is known.
    pub fn unlike(&self, drawn: &dyn Fn(usize) -> bool, absent: &str, t: &Strings) -> Vec<String> {
        let known = |p: &usize| self.curves.scenes().iter().any(|s| !self.grid.runs(*p, *s).is_empty());
        let planners: Vec<usize> = (0..self.grid.planners.len()).filter(known).collect();
        let said = |key: &str, of: &dyn Fn(usize) -> bool| {
            let names: Vec<String> = planners.iter().filter(|p| of(**p)).map(|p| self.label(*p).to_owned()).collect();
            (!names.is_empty()).then(|| t.fill(key, &[("planners", &t.list(&names))]))
        };
        let charged = |p: usize| drawn(p) && self.curves.charged(p);
        [said("curve_whole", &charged), said(absent, &|p| !drawn(p))].into_iter().flatten().collect()
    }

    /// Least and greatest effort at which anything happens, both above 0; `None` where nothing is spent.
    pub fn range(&self, effort: Effort) -> Option<[f64; 2]> {
        let every = || (0..self.grid.planners.len()).flat_map(|p| self.grid.runs_in(p, None));
        let end = |r: &RunRecord| match effort {
            Effort::Evaluations => r.evaluations as f64,
            Effort::Time => r.time_us,
        };
        let first = |r: &RunRecord| match (effort, r.progress.first()) {
            (Effort::Evaluations, Some(p)) => p.evaluations as f64,
            (Effort::Time, Some(p)) => p.time_us,
            (_, None) => end(r),
        };
        let positive = |v: &f64| *v > 0.0 && v.is_finite();
        let low = every().flat_map(|r| [first(r), end(r)]).filter(positive).fold(f64::INFINITY, f64::min);
        let high = every().map(end).filter(positive).fold(0.0, f64::max);
        (low <= high).then_some([low, high])
    }
}
