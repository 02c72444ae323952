//! The answer in one paragraph, computed from the runs.

use super::language::Strings;
use crate::analysis::{Summary, summarise};
use crate::format;
use crate::results::Results;

/// More names than this are counted instead of listed.
const NAMED: usize = 4;

/// Who was valid how often, who came closest, who was fastest. Plain text.
pub fn headline(results: &Results, t: &Strings) -> String {
    let rows: Vec<Summary> = results.planners.iter().filter_map(|p| summarise(results, &p.label, None)).collect();
    if rows.is_empty() {
        return t.get("headline_empty").to_owned();
    }
    let mut sentences = vec![size(results, t)];
    let names = |pick: &dyn Fn(&Summary) -> bool| -> Vec<String> {
        rows.iter().filter(|s| pick(s)).map(|s| s.planner.clone()).collect()
    };
    let mut say = |key: &str, who: &[String]| {
        if who.is_empty() {
            return;
        }
        let who = if who.len() > NAMED { t.plural(who.len(), "planners_one", "planners") } else { t.list(who) };
        sentences.push(t.fill(key, &[("planners", &who)]));
    };
    let always = names(&|s| s.valid == s.runs);
    say("headline_always", &always);
    let never = names(&|s| s.valid == 0);
    say("headline_never", &never);
    let mut between: Vec<&Summary> = rows.iter().filter(|s| s.valid > 0 && s.valid < s.runs).collect();
    if !between.is_empty() {
        let share = |s: &Summary| s.valid as f64 / s.runs as f64;
        between.sort_by(|a, b| share(b).total_cmp(&share(a)));
        let shown: Vec<String> =
            between.iter().take(NAMED).map(|s| format!("{} ({}/{})", s.planner, s.valid, s.runs)).collect();
        let key = if between.len() > NAMED { "headline_between_more" } else { "headline_between" };
        sentences.push(t.fill(key, &[("planners", &t.list(&shown))]));
    }
    sentences.extend(closest(&rows, results, t));
    sentences.extend(fastest(&rows, t));
    sentences.join(t.get("sentence_gap"))
}

fn size(results: &Results, t: &Strings) -> String {
    let (p, s, r) = (results.planners.len(), results.scenes.len(), results.repeats as usize);
    t.fill(
        if results.runs.len() < results.planned() { "headline_size_part" } else { "headline_size" },
        &[
            ("planners", &t.plural(p, "planners_one", "planners")),
            ("scenes", &t.plural(s, "scenes_one", "scenes")),
            ("repeats", &t.plural(r, "repeats_one", "repeats")),
            ("runs", &t.plural(results.runs.len(), "runs_one", "runs")),
        ],
    )
}

/// Least median gap, or without optima least median length, and the runner-up.
fn closest(rows: &[Summary], results: &Results, t: &Strings) -> Option<String> {
    // Gaps of some planners alone, or of other scenes for each, name nobody the closest.
    let by_gap = rows.iter().all(|s| s.gap_median.is_some());
    // Lengths of different scenes have no common median worth a headline.
    if !by_gap && results.scenes.len() != 1 {
        return None;
    }
    let value = |s: &Summary| if by_gap { s.gap_median.unwrap_or(f64::INFINITY) } else { s.length_median };
    let mut order: Vec<&Summary> = rows.iter().filter(|s| value(s).is_finite()).collect();
    order.sort_by(|a, b| value(a).total_cmp(&value(b)));
    let shown = |s: &Summary| if by_gap { format::percent(value(s)) } else { format::length(value(s)) };
    let unit = results.scenes.first().map_or("", |s| s.scene.unit.as_str());
    let first = order.first()?;
    let key = if by_gap { "headline_gap" } else { "headline_length" };
    let mut out = t.fill(key, &[("planner", &first.planner), ("value", &shown(first)), ("unit", unit)]);
    if let Some(second) = order.get(1) {
        out += &t.fill("headline_then", &[("planner", &second.planner), ("value", &shown(second))]);
    }
    Some(out + t.get("full_stop"))
}

fn fastest(rows: &[Summary], t: &Strings) -> Option<String> {
    let fast = rows
        .iter()
        .filter(|s| s.length_median.is_finite())
        .min_by(|a, b| a.time_us_median.total_cmp(&b.time_us_median))?;
    Some(t.fill("headline_time", &[("planner", &fast.planner), ("value", &format::time(fast.time_us_median))]))
}
