//! Sentences a person can quote, as data; [`Sentence::english`] writes them out.
//!
//! Each planner is set against the best one. A difference is stated where Holm's correction over all pairs leaves
//! p < 0.05; otherwise the two cannot be told apart, or where no data in so few blocks could have left that, there
//! is no test to speak of and the figures stand alone.
//!
//! Of times only planners are spoken of that are valid in more than half of their runs and of their blocks: a median
//! of ∞ is not slow. Where some of a planner's runs failed all the same, the sentence says that these count as ∞.

use super::blocks::{Measure, Over};
use super::grid::Grid;
use super::pairs::{Pair, Pairs, Ratio};
use crate::format;
use crate::statistics::wilson;

/// Largest adjusted p-value of a difference that is stated.
pub const ALPHA: f64 = 0.05;

/// One statement. Planners are positions in the grid.
#[derive(Debug, Clone, PartialEq)]
pub enum Sentence {
    /// How often a planner was valid.
    Valid {
        /// The planner.
        planner: usize,
        /// Valid runs.
        valid: usize,
        /// Runs.
        runs: usize,
        /// Wilson's 95 % interval of the share.
        interval: (f64, f64),
    },
    /// One planner is better than another.
    Better {
        /// By what.
        measure: Measure,
        /// The better one.
        better: usize,
        /// The worse one.
        worse: usize,
        /// How many times the better one's figure the worse one's is, > 1; `None` where there is no number: a figure
        /// is 0 (at the optimum) or +∞ (half failed), or medians and ranks point different ways.
        ratio: Option<Ratio>,
        /// Their figures.
        medians: [f64; 2],
        /// Adjusted p-value.
        p: f64,
        /// Blocks.
        pairs: usize,
        /// What the blocks are.
        over: Over,
        /// Whether some times are failures, which count as ∞.
        failures: bool,
    },
    /// Two planners cannot be told apart.
    Alike {
        /// By what.
        measure: Measure,
        /// The best planner.
        best: usize,
        /// The other one.
        other: usize,
        /// Adjusted p-value.
        p: f64,
        /// Blocks.
        pairs: usize,
        /// What the blocks are.
        over: Over,
        /// Whether some times are failures, which count as ∞.
        failures: bool,
    },
    /// So few blocks that no data in them could have told two planners apart.
    TooFew {
        /// By what.
        measure: Measure,
        /// The best planner.
        best: usize,
        /// The other one.
        other: usize,
        /// Their figures.
        medians: [f64; 2],
        /// How probably a run of the best one beats one of the other in the same scene.
        a12: Option<f64>,
        /// Blocks.
        pairs: usize,
        /// What the blocks are.
        over: Over,
        /// Whether some times are failures, which count as ∞.
        failures: bool,
    },
    /// The repeats of both are all alike: their figures stand as they are, for this scene, without any p-value.
    Settled {
        /// By what.
        measure: Measure,
        /// The best planner.
        best: usize,
        /// The other one.
        other: usize,
        /// Their figures.
        medians: [f64; 2],
    },
}

/// How often each planner was valid.
pub fn validity(grid: &Grid<'_>) -> Vec<Sentence> {
    let one = |planner: usize| {
        let runs = grid.runs_in(planner, None).count();
        let valid = grid.runs_in(planner, None).filter(|r| r.valid).count();
        (runs > 0).then(|| Sentence::Valid { planner, valid, runs, interval: wilson(valid, runs) })
    };
    (0..grid.planners.len()).filter_map(one).collect()
}

/// Each planner against the best one by the pairs' measure. The best one has the least median over all pairs' blocks;
/// of equals the one that wins more runs (A₁₂), then the first. Empty where none is finite.
pub fn against_best(grid: &Grid<'_>, pairs: &Pairs) -> Vec<Sentence> {
    let time = pairs.measure == Measure::Time;
    let counts = |p: usize| (grid.runs_in(p, None).filter(|r| r.valid).count(), grid.runs_in(p, None).count());
    let compared = |p: &usize| {
        let (valid, runs) = counts(*p);
        !time || 2 * valid > runs
    };
    let failed = |p: usize| {
        let (valid, runs) = counts(p);
        valid < runs
    };
    let planners: Vec<usize> = (0..grid.planners.len()).filter(compared).collect();
    let Some(best) = best(&planners, pairs) else { return Vec::new() };
    let against = |other: &usize| {
        let pair = pairs.of(best, *other)?;
        let known = !time || pair.medians.iter().all(|m| m.is_finite());
        known.then(|| sentence(pairs, pair, best, *other, time && (failed(best) || failed(*other)))).flatten()
    };
    planners.iter().filter(|p| **p != best).filter_map(against).collect()
}

/// The one of `planners` that beats or equals every other one by median, then by A₁₂.
fn best(planners: &[usize], pairs: &Pairs) -> Option<usize> {
    let beats = |a: usize, b: usize| {
        let Some(pair) = pairs.of(a, b) else { return false };
        let [x, y] = pair.medians_of(a);
        x < y || (x == y && pair.a12_of(a).is_some_and(|share| share > 0.5))
    };
    let first = planners.iter().copied().reduce(|best, p| if beats(p, best) { p } else { best })?;
    let finite = |pair: &Pair| (pair.a == first || pair.b == first) && pair.medians_of(first)[0].is_finite();
    pairs.pairs.iter().any(finite).then_some(first)
}

fn sentence(pairs: &Pairs, pair: &Pair, best: usize, other: usize, failures: bool) -> Option<Sentence> {
    let Pairs { measure, over, .. } = *pairs;
    if pair.blocks == 0 {
        return None;
    }
    let medians = pair.medians_of(best);
    let (Some(test), Some(p)) = (pair.test, pair.p) else {
        return Some(Sentence::Settled { measure, best, other, medians });
    };
    if p >= ALPHA && pair.least_p.is_some_and(|least| least >= ALPHA) {
        let a12 = pair.a12_of(best);
        return Some(Sentence::TooFew { measure, best, other, medians, a12, pairs: pair.blocks, over, failures });
    }
    if p >= ALPHA {
        return Some(Sentence::Alike { measure, best, other, p, pairs: pair.blocks, over, failures });
    }
    // The test, not the medians, says which way.
    let a_better = test.negative > test.positive;
    let (better, worse) = if a_better { (pair.a, pair.b) } else { (pair.b, pair.a) };
    let ratio = pair.ratio_of(worse).filter(|r| r.value > 1.0);
    Some(Sentence::Better {
        measure,
        better,
        worse,
        ratio,
        medians: pair.medians_of(better),
        p,
        pairs: pair.blocks,
        over,
        failures,
    })
}

impl Sentence {
    /// The sentence in English, with `names` of the planners in the grid's order.
    pub fn english(&self, names: &[&str]) -> String {
        match self {
            Self::Valid { planner, valid, runs, interval: (low, high) } => {
                format!(
                    "{} is valid in {valid} of {runs} runs [{}]",
                    names[*planner],
                    format::share_interval(*low, *high)
                )
            }
            Self::Better { measure, better, worse, ratio, medians, p, pairs, over, failures } => {
                let (a, b) = (names[*better], names[*worse]);
                let said = match ratio {
                    Some(ratio) => {
                        let times = times(*ratio);
                        match measure {
                            Measure::Gap => format!("{a} is {times} times nearer the optimum than {b} (median gap"),
                            Measure::Length => format!("{b}'s paths are {times} times as long as {a}'s (median length"),
                            Measure::Time => format!("{a} is {times} times faster than {b} (median ratio of times"),
                        }
                    }
                    None => format!("{a} is {} than {b} ({}", comparative(*measure), figures(*measure, *medians)),
                };
                format!("{said}, {}, {})", p_value(*p), evidence(*pairs, *over, *failures))
            }
            Self::Alike { measure, best, other, p, pairs, over, failures } => {
                let (a, b, what) = (names[*best], names[*other], noun(*measure));
                format!(
                    "{a} and {b} cannot be told apart by {what} ({}, {})",
                    p_value(*p),
                    evidence(*pairs, *over, *failures)
                )
            }
            Self::TooFew { measure, best, other, medians, a12, pairs, over, failures } => {
                let (a, b) = (names[*best], names[*other]);
                let a12 = a12.map_or(format::NONE.to_owned(), |share| format::significant(share, 2));
                let blocks = match over {
                    Over::Repeats => "pairs",
                    Over::Scenes => "scenes",
                };
                let figures = figures(*measure, *medians);
                format!(
                    "{a} against {b}: too few {blocks} ({pairs}) for a test; {figures}, A₁₂ {a12}{}",
                    counted(*failures)
                )
            }
            Self::Settled { measure, best, other, medians: [x, y] } => {
                let (a, b) = (names[*best], names[*other]);
                let said = if x == y {
                    format!("{a} and {b} are equal by {}", noun(*measure))
                } else {
                    format!("{a} is {} than {b}", comparative(*measure))
                };
                format!("{said} ({}; every repeat gives the same, so there is no p)", figures(*measure, [*x, *y]))
            }
        }
    }
}

fn noun(measure: Measure) -> &'static str {
    match measure {
        Measure::Gap => "gap",
        Measure::Length => "length",
        Measure::Time => "time",
    }
}

fn comparative(measure: Measure) -> &'static str {
    match measure {
        Measure::Gap => "nearer the optimum",
        Measure::Length => "shorter",
        Measure::Time => "faster",
    }
}

fn figures(measure: Measure, [x, y]: [f64; 2]) -> String {
    let shown = |v: f64| match measure {
        Measure::Gap => format::percent(v),
        Measure::Length => format::significant(v, 6),
        Measure::Time => format::time(v),
    };
    let of = if measure == Measure::Length { " times the shortest" } else { "" };
    format!("median {} {} against {}{of}", noun(measure), shown(x), shown(y))
}

fn times(ratio: Ratio) -> String {
    // A ratio of lengths near one lives in its later digits.
    let digits = if ratio.value < 1.1 { 4 } else { 2 };
    let shown = |v: f64| if v >= 100.0 { format::significant(v, 3) } else { format::significant(v, digits) };
    let interval = ratio.interval.map(|[low, high]| format!(" [{}, {}]", shown(low), shown(high)));
    shown(ratio.value) + &interval.unwrap_or_default()
}

fn p_value(p: f64) -> String {
    if p < 0.001 { "p < 0.001".to_owned() } else { format!("p = {}", format::significant(p, 2)) }
}

fn evidence(pairs: usize, over: Over, failures: bool) -> String {
    let counted = counted(failures);
    match over {
        Over::Repeats => format!("{pairs} pairs{counted}"),
        Over::Scenes => format!("{pairs} scenes{counted}"),
    }
}

fn counted(failures: bool) -> &'static str {
    if failures { ", failures count as ∞" } else { "" }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{one_scene, results, run};
    use super::*;

    fn said(planners: &[(&str, &[f64])], measure: Measure) -> Vec<String> {
        let results = one_scene(planners);
        let grid = Grid::new(&results);
        let names: Vec<&str> = planners.iter().map(|p| p.0).collect();
        let sentences = [validity(&grid), against_best(&grid, &Pairs::new(&grid, measure))].concat();
        sentences.iter().map(|s| s.english(&names)).collect()
    }

    #[test]
    fn as_a_person_would_quote_them() {
        let inf = f64::INFINITY;
        let a: Vec<f64> = (0..30).map(|i| 1.0 + 0.1 * f64::from(i)).collect();
        let b: Vec<f64> = a.iter().map(|g| 4.2 * g).collect();
        let like: Vec<f64> = (0..30).map(|i| a[i] + if i % 2 == 0 { 0.05 } else { -0.05 }).collect();
        let mut failing = vec![inf; 30];
        failing[0] = 50.0;
        let lines = said(&[("pso", &b), ("pso-qp", &a), ("like", &like), ("rare", &failing)], Measure::Gap);
        assert_eq!(
            lines,
            [
                "pso is valid in 30 of 30 runs [89–100\u{a0}%]",
                "pso-qp is valid in 30 of 30 runs [89–100\u{a0}%]",
                "like is valid in 30 of 30 runs [89–100\u{a0}%]",
                "rare is valid in 1 of 30 runs [1–17\u{a0}%]",
                "pso-qp is 4.2 [4.2, 4.2] times nearer the optimum than pso (median gap, p < 0.001, 30 pairs)",
                "pso-qp and like cannot be told apart by gap (p = 1, 30 pairs)",
                "pso-qp is nearer the optimum than rare (median gap 2.45\u{a0}% against ∞, p < 0.001, 30 pairs)",
            ]
        );
    }

    #[test]
    fn too_few_for_a_test() {
        let scenes = |n: usize| -> Vec<String> {
            let names: Vec<String> = (0..n).map(|i| format!("s{i}")).collect();
            let scenes: Vec<(&str, Option<f64>)> = names.iter().map(|s| (s.as_str(), Some(10.0))).collect();
            let runs = |s: &String| [run(s, "far", 0, 10.3), run(s, "near", 0, 10.1)];
            let results = results(&["far", "near"], &scenes, names.iter().flat_map(runs).collect());
            let grid = Grid::new(&results);
            let sentences = against_best(&grid, &Pairs::new(&grid, Measure::Gap));
            sentences.iter().map(|s| s.english(&["far", "near"])).collect()
        };
        // One test of n scenes: p ≥ 2/2ⁿ, 0.0625 with five of them and 0.031 with six.
        assert_eq!(
            scenes(5),
            ["near against far: too few scenes (5) for a test; median gap 1\u{a0}% against 3\u{a0}%, A₁₂ 1"]
        );
        assert_eq!(scenes(6), ["near is 3 [3, 3] times nearer the optimum than far (median gap, p = 0.031, 6 scenes)"]);
        // Correction counts: with one test six pairs do, with three they do not, 3·2/2⁶ = 0.094.
        let a = [1.0, 1.1, 1.2, 1.3, 1.4, 1.5];
        let lines = said(&[("a", &a), ("b", &a.map(|g| 2.0 * g)), ("c", &a.map(|g| 3.0 * g))], Measure::Gap);
        assert_eq!(
            lines[3],
            "a against b: too few pairs (6) for a test; median gap 1.25\u{a0}% against 2.5\u{a0}%, A₁₂ 1"
        );
    }

    #[test]
    fn without_evidence_no_p() {
        let lines = said(&[("exact", &[0.0; 5]), ("far", &[3.0; 5]), ("too", &[0.0; 5])], Measure::Gap);
        assert_eq!(
            lines[3..],
            [
                "exact is nearer the optimum than far (median gap 0\u{a0}% against 3\u{a0}%; every repeat gives the \
                 same, so there is no p)",
                "exact and too are equal by gap (median gap 0\u{a0}% against 0\u{a0}%; every repeat gives the same, \
                 so there is no p)",
            ]
        );
        assert!(said(&[("none", &[f64::INFINITY; 9]), ("nor", &[f64::INFINITY; 9])], Measure::Gap).len() == 2);
        assert!(said(&[], Measure::Time).is_empty());
    }

    /// What is said of times where every repeat of `b` takes 12 times as long as that of `a`; with gaps of two planners.
    fn times(fails: [f64; 9], a: [f64; 9]) -> Vec<String> {
        let mut results = one_scene(&[("fails", &fails), ("b", &[1.0; 9]), ("a", &a)]);
        for r in &mut results.runs {
            let speed = [("fails", 1.0), ("b", 24.0), ("a", 2.0)].into_iter().find(|s| s.0 == r.planner).unwrap();
            r.time_us = speed.1 * f64::from(100 + r.repeat);
        }
        let grid = Grid::new(&results);
        let lines = against_best(&grid, &Pairs::new(&grid, Measure::Time));
        lines.iter().map(|s| s.english(&["fails", "b", "a"])).collect()
    }

    #[test]
    fn fast_failure_is_not_quoted() {
        let inf = f64::INFINITY;
        // Its time is not ∞ for anyone who looks at the clock, so nothing is said of it.
        let mostly = [1.0, 1.0, 1.0, 1.0, inf, inf, inf, inf, inf];
        for fails in [[inf; 9], mostly] {
            assert_eq!(
                times(fails, [1.0; 9]),
                ["a is 12 [12, 12] times faster than b (median ratio of times, p = 0.012, 9 pairs)"]
            );
        }
        let one = [inf, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
        let lines = times([inf; 9], one);
        assert!(lines.len() == 1 && lines[0].ends_with("9 pairs, failures count as ∞)"), "{lines:?}");
    }
}
