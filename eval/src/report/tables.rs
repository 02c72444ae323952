//! The comparison table, the table of scenes, and the table of runs.

use minijinja::{Value, context};

use super::language::Strings;
use super::palette;
use crate::format;
use crate::results::{Results, RunRecord};
use crate::stats::{Summary, summarise};

/// A cell: what is shown, what sorting reads, whether it is the best of its column.
fn cell(shown: String, key: f64, best: bool) -> Value {
    context! { shown, key => format::sort_key(key), best }
}

/// 95 % interval of a share k/n. Wilson, *J. Am. Stat. Assoc.* 22 (1927) 209–212.
pub fn wilson(k: usize, n: usize) -> (f64, f64) {
    if n == 0 {
        return (0.0, 1.0);
    }
    let (none, all) = (k == 0, k == n);
    let (n, p, z) = (n as f64, k as f64 / n as f64, 1.959_963_985);
    let middle = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let scale = 1.0 + z * z / n;
    // These two ends are exact; rounding would leave them a little off.
    let low = if none { 0.0 } else { ((middle - half) / scale).max(0.0) };
    let high = if all { 1.0 } else { ((middle + half) / scale).min(1.0) };
    (low, high)
}

/// An interval of shares as percent, with as many digits as it takes to tell its ends from each other, from 0 and
/// from 100 %.
fn interval(low: f64, high: f64) -> String {
    let text = |share: f64, digits: usize| match share {
        0.0 => "0".to_owned(),
        1.0 => "100".to_owned(),
        _ => format!("{:.digits$}", 100.0 * share),
    };
    let clear = |&digits: &usize| {
        let shown = |share: f64| text(share, digits).parse::<f64>().unwrap_or(share);
        let inside = |share: f64| share == 0.0 || share == 1.0 || (shown(share) > 0.0 && shown(share) < 100.0);
        inside(low) && inside(high) && (low == high || shown(low) < shown(high))
    };
    // Nine digits tell any ends apart that runs in their millions can have.
    let digits = (0..9).find(clear).unwrap_or(9);
    format!("{}–{}\u{a0}%", text(low, digits), text(high, digits))
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
                interval => interval(low, high),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_interval() {
        // 30 of 30: lower end n/(n + z²) = 30/33.8415; half a unit of the last digit given.
        let (low, high) = wilson(30, 30);
        assert!((low - 0.886_49).abs() < 5e-6 && high == 1.0, "{low} {high}");
        assert_eq!(wilson(0, 0), (0.0, 1.0));
        assert!(wilson(0, 30).0 == 0.0);
    }

    #[test]
    fn intervals_are_never_points() {
        let shown = |k, n| {
            let (low, high) = wilson(k, n);
            interval(low, high)
        };
        assert_eq!(shown(30, 30), "89–100\u{a0}%");
        // n/(n + z²) = 2000/2003.84 = 0.998 08.
        assert_eq!(shown(2000, 2000), "99.8–100\u{a0}%");
        assert_eq!(shown(0, 2000), "0–0.2\u{a0}%");
        assert_eq!(shown(500_000, 1_000_000), "49.9–50.1\u{a0}%");
        assert_eq!(shown(0, 0), "0–100\u{a0}%");
        for n in [1, 7, 1000, 28_000, 10_000_000] {
            for k in [0, 1, n / 2, n - 1, n] {
                let text = shown(k, n);
                let (low, high) = text.trim_end_matches("\u{a0}%").split_once('–').unwrap();
                assert!(low != high && (low != "0" || k == 0) && (high != "100" || k == n), "{k}/{n}: {text}");
            }
        }
    }
}
