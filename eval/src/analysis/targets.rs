//! Gap targets: how much effort until a run is within 100 %, …, 0.01 % of the optimum.
//!
//! Hansen et al., *COCO*, Optim. Methods Softw. 36 (2021) 114–144; expected running time: Auger & Hansen, *CEC* 2005.

use std::collections::BTreeMap;

use super::curves::{Course, Curves, Effort};
use crate::statistics::bootstrap::{Resamples, ratio_interval};

/// The targets of tables.
pub const SHOWN: [f64; 5] = [1.0, 1e-1, 1e-2, 1e-3, 1e-4];
/// Resamples behind an interval of an expected running time.
pub const RESAMPLES: usize = 1000;
const SEED: u64 = 0;
/// Targets in a factor of ten.
const PER_DECADE: u32 = 10;

/// The 41 targets of distributions: 10^(−k/10), k = 0 … 40.
pub fn targets() -> Vec<f64> {
    (0..=4 * PER_DECADE).map(|k| libm::exp10(-f64::from(k) / f64::from(PER_DECADE))).collect()
}

/// Effort until `course` first had a gap of at most `target`; `None` when it never had.
fn hit(course: &Course, target: f64, effort: Effort) -> Option<f64> {
    let first = course.steps.partition_point(|s| s.gap > target);
    course.steps.get(first).map(|s| s.at(effort))
}

/// An expected running time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ert {
    /// Effort until the target, of the whole run where it was missed, summed over runs, per run that reached it:
    /// what restarting until success takes. +∞ without any that did.
    pub value: f64,
    /// 95 % bootstrap interval over runs; `None` without success or for fewer than two runs.
    pub interval: Option<[f64; 2]>,
    /// Runs that reached the target.
    pub reached: usize,
    /// Runs.
    pub runs: usize,
}

/// Expected running times: for each planner, one for each target. In one scene, or of the runs of all together; of no
/// runs where it is not known what the planner's runs spent.
///
/// Runs that crashed, were stopped or ended in an error without telling their evaluations are charged the planner's
/// budget of evaluations, else the most that any of its runs made; where neither is known there is no expected number.
pub fn ert(curves: &Curves, scene: Option<usize>, targets: &[f64], effort: Effort) -> Vec<Vec<Ert>> {
    let mut resamples = BTreeMap::new();
    let mut row = |planner: usize| {
        let known = curves.known(planner, effort);
        let courses: Vec<&Course> = curves.of(planner, scene).filter(|_| known).collect();
        let resamples =
            resamples.entry(courses.len()).or_insert_with(|| Resamples::new(courses.len(), RESAMPLES, SEED));
        targets.iter().map(|t| one(&courses, *t, effort, resamples)).collect()
    };
    (0..curves.planners()).map(&mut row).collect()
}

fn one(courses: &[&Course], target: f64, effort: Effort, resamples: &Resamples) -> Ert {
    let hits: Vec<Option<f64>> = courses.iter().map(|c| hit(c, target, effort)).collect();
    let spent: Vec<f64> = hits.iter().zip(courses).map(|(h, c)| h.unwrap_or(c.end.at(effort))).collect();
    let success: Vec<f64> = hits.iter().map(|h| f64::from(u8::from(h.is_some()))).collect();
    let reached = hits.iter().flatten().count();
    let value = if reached == 0 { f64::INFINITY } else { spent.iter().sum::<f64>() / reached as f64 };
    let bootstrap = || ratio_interval(&resamples.sums(&spent), &resamples.sums(&success));
    let interval = (reached > 0 && courses.len() > 1).then(bootstrap).flatten();
    Ert { value, interval, reached, runs: courses.len() }
}

/// A distribution function as steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Ecdf {
    /// Effort, and the share of all (run, target) pairs reached by then; both increase.
    pub steps: Vec<[f64; 2]>,
    /// Pairs of a run and a target, the never reached ones included.
    pub pairs: usize,
}

impl Ecdf {
    /// The share reached by effort x.
    pub fn at(&self, x: f64) -> f64 {
        let done = self.steps.partition_point(|s| s[0] <= x);
        done.checked_sub(1).map_or(0.0, |i| self.steps[i][1])
    }
}

/// The distribution of one planner's efforts over runs and `targets`, in one scene or over all; without any pair where
/// it is not known what its runs spent.
pub fn ecdf(curves: &Curves, planner: usize, scene: Option<usize>, targets: &[f64], effort: Effort) -> Ecdf {
    let mut pairs = 0;
    let mut efforts = Vec::new();
    for course in curves.of(planner, scene).filter(|_| curves.known(planner, effort)) {
        pairs += targets.len();
        efforts.extend(targets.iter().filter_map(|t| hit(course, *t, effort)));
    }
    efforts.sort_by(f64::total_cmp);
    let mut steps = Vec::new();
    let mut reached = 0;
    for group in efforts.chunk_by(|a, b| a == b) {
        reached += group.len();
        steps.push([group[0], reached as f64 / pairs as f64]);
    }
    Ecdf { steps, pairs }
}

#[cfg(test)]
mod tests {
    use super::super::grid::Grid;
    use super::super::testing::{progress, results, run};
    use super::*;
    use crate::results::{Results, RunRecord, RunStatus};

    const INF: f64 = f64::INFINITY;

    /// Optimum 10. Of a, four runs: 5 % with a curve, 5 % without, invalid with a fine curve, 300 %.
    fn four() -> Results {
        let curve = || progress([(5, 50.0, INF), (10, 100.0, 19.0), (40, 400.0, 10.9), (60, 600.0, 10.5)]);
        let runs = vec![
            RunRecord { progress: curve(), ..run("s", "a", 0, 10.5) },
            run("s", "a", 1, 10.5),
            RunRecord { progress: curve(), ..run("s", "a", 2, INF) },
            run("s", "a", 3, 40.0),
        ];
        results(&["a"], &[("s", Some(10.0)), ("t", None)], runs)
    }

    #[test]
    fn shown_targets_are_among_the_targets() {
        let targets = targets();
        assert_eq!(targets.len(), 41);
        assert!(targets.windows(2).all(|w| w[0] > w[1]));
        assert!((0..).step_by(10).zip(SHOWN).all(|(k, t): (usize, f64)| targets[k] == t), "{targets:?}");
    }

    #[test]
    fn expected_running_times_by_hand() {
        let curves = Curves::new(&Grid::new(&four()));
        assert_eq!(curves.scenes(), [0]);
        let table = ert(&curves, Some(0), &[1.0, 0.1, 0.01], Effort::Evaluations);
        // 100 %: 10, 100, and two whole runs of 100 that missed, by two; 10 %: 40 instead of 10.
        let [first, second, third] = &table[0][..] else { panic!() };
        assert_eq!((first.value, first.reached, first.runs), (155.0, 2, 4));
        assert_eq!(second.value, 170.0);
        assert_eq!((third.value, third.reached, third.interval), (INF, 0, None));
        let [low, high] = first.interval.unwrap();
        // A resample with a share s of successes costs at least 10 and at most 100/s; some have none.
        assert!(10.0 < low && low < 155.0 && high == INF, "{low} {high}");
        let time = ert(&curves, None, &[0.1], Effort::Time);
        assert_eq!(time[0][0].value, (400.0 + 3000.0) / 2.0);
    }

    #[test]
    fn crashes_are_not_free() {
        // One run in two crashes after who knows how much.
        let gone = |repeat| RunRecord {
            status: RunStatus::Crashed,
            evaluations: 0,
            time_us: 300.0,
            ..run("s", "a", repeat, INF)
        };
        let good = |repeat| run("s", "a", repeat, 10.5);
        let scenes = [("s", Some(10.0))];
        let of = |results: &Results, effort| ert(&Curves::new(&Grid::new(results)), None, &[0.1], effort)[0][0];
        let mut half = results(&["a"], &scenes, vec![good(0), gone(1), good(2), gone(3)]);
        assert_eq!(of(&half, Effort::Evaluations).value, 200.0, "the most of its runs, 100, for each crash");
        assert_eq!(of(&half, Effort::Time).value, (1000.0 + 300.0 + 1000.0 + 300.0) / 2.0);
        half.planners[0].budget.evaluations = Some(500);
        assert_eq!(of(&half, Effort::Evaluations).value, 600.0);
        // A planner that never tells: solved without a count, or crashed.
        let silent = |run: RunRecord| RunRecord { evaluations: 0, ..run };
        let never = results(&["a"], &scenes, vec![silent(good(0)), gone(1)]);
        assert_eq!(of(&never, Effort::Evaluations).runs, 0);
        assert_eq!(of(&never, Effort::Time).runs, 2);
    }

    #[test]
    fn costs_that_are_no_lengths_say_nothing_of_when() {
        let mut other = four();
        other.runs[1].cost = Some(10.5 * (1.0 + 2e-5));
        let first_hit = |results: &Results| {
            let curves = Curves::new(&Grid::new(results));
            ert(&curves, Some(0), &[1.0], Effort::Evaluations)[0][0].value
        };
        assert_eq!(first_hit(&other), 200.0);
        // A run that tells no cost is judged by its progress, whose last cost is that of its path.
        let mut silent = four();
        silent.runs[0].cost = None;
        assert_eq!(first_hit(&silent), 155.0, "the progress ends at the length");
        silent.runs[0].progress[3].cost = 10.6;
        assert_eq!(first_hit(&silent), 200.0, "it ends elsewhere");
    }

    #[test]
    fn distributions_stay_below_one_where_targets_are_missed() {
        let curves = Curves::new(&Grid::new(&four()));
        let ecdf = ecdf(&curves, 0, None, &[4.0, 1.0, 0.05001], Effort::Evaluations);
        assert_eq!(ecdf.pairs, 12);
        // 10: 400 % and 100 %; 60: 5 %; 100: three of the run without curve and 400 % of the last.
        assert_eq!(ecdf.steps, [[10.0, 2.0 / 12.0], [60.0, 3.0 / 12.0], [100.0, 7.0 / 12.0]]);
        assert_eq!([9.9, 10.0, 1e9].map(|x| ecdf.at(x)), [0.0, 2.0 / 12.0, 7.0 / 12.0]);
    }
}
