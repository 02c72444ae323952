//! The comparison table, the table of scenes, and the table of runs.

use minijinja::{Value, context};

use super::evidence::Evidence;
use super::language::Strings;
use super::palette;
use crate::analysis::{Measure, Summary, counted_length, summarise};
use crate::format;
use crate::results::{Results, RunRecord, SceneResult, SceneSet};
use crate::statistics::median;
use crate::statistics::median_interval::median_interval;
use crate::statistics::wilson;

/// A cell: what is shown, what sorting reads, whether it is the best of its column.
fn cell(shown: String, key: f64, best: bool) -> Value {
    context! { shown, key => format::sort_key(key), best, small => "" }
}

/// The comparison table of one scene, or (`None`) of all test scenes; `unit` is empty when scenes differ in it.
pub fn comparison(evidence: &Evidence<'_>, scene: Option<&str>, unit: &str, t: &Strings) -> Value {
    let results = evidence.results;
    let rows: Vec<(usize, Summary, Figures)> = results
        .planners
        .iter()
        .enumerate()
        .filter_map(|(i, p)| {
            let summary = summarise(results, &p.label, scene)?;
            let figures = figures(evidence, i, scene, &summary);
            Some((i, summary, figures))
        })
        .collect();
    let least = |f: &dyn Fn(&Summary, &Figures) -> f64| {
        rows.iter().map(|(_, s, m)| f(s, m)).filter(|v| v.is_finite()).fold(f64::INFINITY, f64::min)
    };
    // Being fast at failing is no merit: times compete among planners that mostly succeed.
    let judged_time = |s: &Summary, m: &Figures| if s.length_median.is_finite() { m.time.0 } else { f64::INFINITY };
    let gap = |m: &Figures| m.gap.map_or(f64::INFINITY, |g| g.0);
    let best_gap = least(&|_, m| gap(m));
    let (best_length, best_time) = (least(&|s, _| s.length_median), least(&judged_time));
    // Equal to as many digits as the table shows is equal.
    let ties = |v: f64, best: f64| v.is_finite() && v <= best + 1e-9 * best.abs();
    let body: Vec<Value> = rows
        .iter()
        .map(|(i, s, m)| {
            let share = s.valid as f64 / s.runs.max(1) as f64;
            let (low, high) = wilson(s.valid, s.runs);
            let [q1, q3] = s.length_quartiles;
            let [low_shown, high_shown] = [q1, q3].map(format::length);
            let range = if low_shown == high_shown { low_shown } else { format!("{low_shown}\u{a0}– {high_shown}") };
            context! {
                label => s.planner.as_str(), swatch => Value::from_safe_string(palette::swatch(*i)),
                valid => cell(format!("{}/{}", s.valid, s.runs), share, false),
                percent => format!("{:.1}", 100.0 * share),
                interval => format::share_interval(low, high),
                length => estimate((s.length_median, m.length), &format::length, ties(s.length_median, best_length)),
                gap => m.gap.map_or_else(
                    || cell(format::NONE.to_owned(), f64::INFINITY, false),
                    |g| estimate(g, &format::percent, ties(g.0, best_gap))),
                range => cell(range, if q1.is_finite() { q3 - q1 } else { f64::INFINITY }, false),
                time => estimate(m.time, &format::time, ties(judged_time(s, m), best_time)),
                evaluations => cell(format::count(s.evaluations_median), s.evaluations_median, false),
            }
        })
        .collect();
    let note_failures = rows.iter().any(|(_, s, _)| s.valid < s.runs);
    let note_gap = rows.iter().any(|(_, _, m)| m.gap.is_none());
    context! {
        rows => body, note_failures, note_gap, several => scene.is_none(),
        length_head => with_unit(t.get("head_length"), unit), range_head => with_unit(t.get("head_range"), unit),
    }
}

/// A median and the ends of its interval.
type Estimate = (f64, Option<[f64; 2]>);

/// A planner's medians: over runs in one scene, over scenes of their medians in all.
struct Figures {
    gap: Option<Estimate>,
    time: Estimate,
    length: Option<[f64; 2]>,
}

fn figures(evidence: &Evidence<'_>, planner: usize, scene: Option<&str>, summary: &Summary) -> Figures {
    let Some(scene) = scene else {
        let scenes = evidence.scenes();
        let by_gap = evidence.quality.measure == Measure::Gap;
        let gap = evidence.quality_of(planner, &scenes).filter(|_| by_gap);
        let time = evidence.time_of(planner, &scenes);
        return Figures {
            gap: gap.map(|g| (g.median, g.ends())),
            time: time.map_or((summary.time_us_median, None), |time| (time.median, time.ends())),
            length: None,
        };
    };
    let runs: Vec<&RunRecord> = evidence.results.runs_of(&summary.planner, Some(scene)).collect();
    let ends = |value: &dyn Fn(&RunRecord) -> f64| {
        let values: Vec<f64> = runs.iter().map(|r| value(r)).collect();
        median_interval(&values).map(|i| [i.low, i.high])
    };
    Figures {
        gap: summary.gap_median.map(|gap| (gap, ends(&|r| r.gap.unwrap_or(f64::INFINITY)))),
        time: (summary.time_us_median, ends(&|r| r.time_us)),
        length: ends(&counted_length),
    }
}

fn estimate((value, ends): Estimate, shown: &dyn Fn(f64) -> String, best: bool) -> Value {
    let [low, high] = ends.unwrap_or([value, value]).map(shown);
    // Deterministic planners have no interval worth a line.
    let small = if low == high { String::new() } else { format!("[{low}, {high}]") };
    context! { shown => shown(value), key => format::sort_key(value), best, small }
}

/// "median length (cm)"; without unit just the words.
pub fn with_unit(words: &str, unit: &str) -> String {
    if unit.is_empty() { words.to_owned() } else { format!("{words} ({unit})") }
}

/// Scenes down, planners across: valid runs and median gap (or length).
pub fn matrix(results: &Results) -> Value {
    let rows: Vec<Value> = results
        .scenes
        .iter()
        .enumerate()
        .map(|(i, s)| {
            let name = s.scene.name.as_str();
            let cells: Vec<Value> = results
                .planners
                .iter()
                .map(|p| match summarise(results, &p.label, Some(name)) {
                    None => context! { valid => format::NONE, value => "", full => false, none => false, failed => true, key => "Infinity" },
                    Some(sum) => context! {
                        failed => sum.valid < results.repeats as usize,
                        key => format::sort_key(sum.gap_median.unwrap_or(sum.length_median)),
                        valid => format!("{}/{}", sum.valid, sum.runs),
                        value => sum.gap_median.map_or_else(|| format::length(sum.length_median), format::percent),
                        full => sum.valid == sum.runs, none => sum.valid == 0,
                    },
                })
                .collect();
            context! { name, anchor => super::scene_anchor(i), optimum => optimum(reference(results, s)), cells, tuning => s.set == SceneSet::Tuning,
                key => format::sort_key(reference(results, s).unwrap_or(f64::INFINITY)) }
        })
        .collect();
    Value::from(rows)
}

/// What a scene's lengths are measured against: its optimum, of a moving one the median lower bound on arrival.
fn reference(results: &Results, scene: &SceneResult) -> Option<f64> {
    let runs = results.runs.iter().filter(|r| r.scene == scene.scene.name);
    let least: Vec<f64> = runs.filter_map(|r| Some(r.moving.as_ref()?.metrics.least_s)).collect();
    scene.optimum.length.or_else(|| median(&least))
}

fn optimum(length: Option<f64>) -> String {
    length.map_or(format::NONE.to_owned(), format::length)
}

/// One row a run of one planner in one scene.
pub fn runs(runs: &[&RunRecord], t: &Strings) -> Value {
    let optional = |v: Option<f64>, f: &dyn Fn(f64) -> String| v.map_or(format::NONE.to_owned(), f);
    let rows: Vec<Value> = runs
        .iter()
        .map(|r| {
            let cells = vec![
                r.repeat.to_string(),
                r.seed.to_string(),
                t.get(&format!("status_{}", r.status.name())).to_owned(),
                t.get(if r.valid { "yes" } else { "no" }).to_owned(),
                optional(r.length, &format::length),
                optional(r.gap, &format::percent),
                optional(r.clearance_min, &|v| format::significant(v, 3)),
                optional(r.turning, &format::angle),
                format::time(r.time_us),
                format::count(r.evaluations as f64),
            ];
            context! { cells, valid => r.valid }
        })
        .collect();
    Value::from(rows)
}
