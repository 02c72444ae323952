//! The comparison table, the table of scenes, and the table of runs.

use minijinja::{Value, context};

use super::language::Strings;
use super::palette;
use crate::analysis::{Summary, summarise};
use crate::format;
use crate::results::{Results, RunRecord};
use crate::statistics::wilson;

/// A cell: what is shown, what sorting reads, whether it is the best of its column.
fn cell(shown: String, key: f64, best: bool) -> Value {
    context! { shown, key => format::sort_key(key), best }
}

/// The comparison table of one scene, or (`None`) of all; `unit` is empty when scenes differ in it.
pub fn comparison(results: &Results, scene: Option<&str>, unit: &str, t: &Strings) -> Value {
    let rows: Vec<(usize, Summary)> = results
        .planners
        .iter()
        .enumerate()
        .filter_map(|(i, p)| summarise(results, &p.label, scene).map(|s| (i, s)))
        .collect();
    let least = |f: &dyn Fn(&Summary) -> f64| {
        rows.iter().map(|(_, s)| f(s)).filter(|v| v.is_finite()).fold(f64::INFINITY, f64::min)
    };
    // Being fast at failing is no merit: times compete among planners that mostly succeed.
    let judged_time = |s: &Summary| if s.length_median.is_finite() { s.time_us_median } else { f64::INFINITY };
    let gap = |s: &Summary| s.gap_median.unwrap_or(f64::INFINITY);
    let (best_gap, best_length, best_time) = (least(&gap), least(&|s| s.length_median), least(&judged_time));
    // Equal to as many digits as the table shows is equal.
    let ties = |v: f64, best: f64| v.is_finite() && v <= best + 1e-9 * best.abs();
    let body: Vec<Value> = rows
        .iter()
        .map(|(i, s)| {
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
                length => cell(format::length(s.length_median), s.length_median, ties(s.length_median, best_length)),
                gap => cell(
                    s.gap_median.map_or(format::NONE.to_owned(), format::percent), gap(s), ties(gap(s), best_gap)),
                range => cell(range, if q1.is_finite() { q3 - q1 } else { f64::INFINITY }, false),
                time => cell(format::time(s.time_us_median), s.time_us_median, ties(judged_time(s), best_time)),
                evaluations => cell(format::count(s.evaluations_median), s.evaluations_median, false),
            }
        })
        .collect();
    let note_failures = rows.iter().any(|(_, s)| s.valid < s.runs);
    let note_gap = rows.iter().any(|(_, s)| s.gap_median.is_none());
    context! {
        rows => body, note_failures, note_gap,
        length_head => with_unit(t.get("head_length"), unit), range_head => with_unit(t.get("head_range"), unit),
    }
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
                    None => context! { valid => format::NONE, value => "", full => false, none => false },
                    Some(sum) => context! {
                        valid => format!("{}/{}", sum.valid, sum.runs),
                        value => sum.gap_median.map_or_else(|| format::length(sum.length_median), format::percent),
                        full => sum.valid == sum.runs, none => sum.valid == 0,
                    },
                })
                .collect();
            context! { name, anchor => format!("scene-{i}"), optimum => optimum(s.optimum.length), cells }
        })
        .collect();
    Value::from(rows)
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
