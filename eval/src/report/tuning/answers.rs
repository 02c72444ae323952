//! Whether tuning was worth it, in one screen.

use minijinja::{Value, context};

use super::super::data_table::swatch;
use super::super::evidence::Evidence;
use super::super::language::Strings;
use super::super::phrases;
use super::{fitness, is_tuned, tunings};
use crate::analysis::sentences::ALPHA;
use crate::statistics::median;

/// Median fitness of a planner on held-out scenarios.
fn held_out(evidence: &Evidence<'_>, planner: usize) -> Option<f64> {
    median(&tunings(evidence.results, planner).iter().map(|run| run.held_out).collect::<Vec<f64>>())
}

/// The entry of the page.
pub fn answers(evidence: &Evidence<'_>, size: String, t: &Strings) -> Value {
    let planners: Vec<(usize, f64)> =
        (0..evidence.results.planners.len()).filter_map(|p| Some((p, held_out(evidence, p)?))).collect();
    let mut rows = Vec::new();
    if let Some((best, value)) = planners.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)) {
        let who = vec![context! { label => evidence.label(best), swatch => swatch(best) }];
        let detail = t.fill("tuning_best_detail", &[("value", &fitness(value))]);
        rows.push(context! { question => t.get("tuning_best"), who, more => (), detail, href => "#overall-table" });
    }
    let tuned = |p: usize| is_tuned(&tunings(evidence.results, p));
    let given = || planners.iter().filter(|(p, _)| !tuned(*p));
    let searched = planners.iter().filter(|(p, _)| tuned(*p));
    let quotes: Vec<String> = searched.flat_map(|a| given().map(|b| verdict(evidence, *a, *b, t))).collect();
    context! { size, rows, quotes }
}

/// Tuned parameters against given ones, by the paired test over seeds.
fn verdict(evidence: &Evidence<'_>, (a, x): (usize, f64), (b, y): (usize, f64), t: &Strings) -> String {
    let pair = evidence.quality.of(a, b);
    let p = pair.and_then(|pair| pair.p);
    let key = match p {
        None => "tuning_untested",
        Some(p) if p >= ALPHA => "tuning_alike",
        Some(_) if x > y => "tuning_better",
        Some(_) => "tuning_worse",
    };
    let pairs = pair.map_or(0, |pair| pair.blocks).to_string();
    let p = p.map_or_else(String::new, phrases::p_value);
    let (x, y) = (fitness(x), fitness(y));
    t.fill(
        key,
        &[("a", evidence.label(a)), ("b", evidence.label(b)), ("x", &x), ("y", &y), ("p", &p), ("pairs", &pairs)],
    )
}
