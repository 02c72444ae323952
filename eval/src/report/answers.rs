//! The answer in one screen: which planner, for which scenes, at which budget.

use std::collections::BTreeSet;

use minijinja::{Value, context};

use super::data_table::swatch;
use super::evidence::Evidence;
use super::language::Strings;
use super::phrases;
use crate::analysis::fixed_budget::fixed_budget;
use crate::analysis::sentences::{Sentence, against_best, validity};
use crate::analysis::targets::SHOWN;
use crate::analysis::{Effort, Measure};
use crate::format;
use crate::statistics::median_interval::median_interval;
use crate::statistics::{median, wilson};

/// More names than this are counted instead of listed.
const NAMED: usize = 4;
/// Gaps that differ by less are rounding.
const SAME: f64 = 1e-9;
/// Good enough for the question of the fastest.
const NEAR: f64 = 0.01;
/// Differences stated below the answers; the others are with the evidence.
const QUOTED: usize = 3;

/// Who is best by something.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The best planners; several where they are equal.
    pub planners: Vec<usize>,
    /// What their figure is, and its interval.
    pub figure: (f64, Option<[f64; 2]>),
    /// What it measures.
    pub measure: Measure,
}

impl Answer {
    /// `pso and tangent: 0.12 %`.
    pub fn text(&self, evidence: &Evidence<'_>, t: &Strings) -> String {
        format!("{}: {}", names(evidence, &self.planners, t), phrases::value(self.measure, self.figure.0))
    }

    fn detail(&self, key: &str, t: &Strings) -> String {
        let shown = |v: f64| phrases::value(self.measure, v);
        let ends = self.figure.1.map(|ends| ends.map(shown)).filter(|[low, high]| low != high);
        let interval = ends.map(|[low, high]| format!(" [{low}, {high}]"));
        t.fill(key, &[("value", &(shown(self.figure.0) + &interval.unwrap_or_default()))])
    }
}

fn names(evidence: &Evidence<'_>, planners: &[usize], t: &Strings) -> String {
    let mut labels: Vec<String> = planners.iter().take(NAMED).map(|p| evidence.label(*p).to_owned()).collect();
    if planners.len() > NAMED {
        labels.truncate(NAMED - 1);
        labels.push(t.fill("more", &[("n", &(planners.len() - labels.len()).to_string())]));
    }
    t.list(&labels)
}

/// The planners that have runs in every one of `scenes`, or where none has, all: figures of other scenes do not compare.
fn eligible(evidence: &Evidence<'_>, scenes: &[usize]) -> Vec<usize> {
    let all: Vec<usize> = (0..evidence.results.planners.len()).collect();
    let complete = |p: &usize| scenes.iter().all(|s| !evidence.grid.runs(*p, *s).is_empty());
    let some: Vec<usize> = all.iter().copied().filter(complete).collect();
    if some.is_empty() { all } else { some }
}

/// Those of `candidates` with the least figure.
fn least(candidates: Vec<(usize, f64, Option<[f64; 2]>)>, measure: Measure) -> Option<Answer> {
    let best = candidates.iter().map(|c| c.1).fold(f64::INFINITY, f64::min);
    let equal: Vec<_> =
        candidates.into_iter().filter(|c| c.1.is_finite() && c.1 <= best + SAME * best.max(1.0)).collect();
    let figure = equal.first().map(|c| (c.1, c.2))?;
    Some(Answer { planners: equal.iter().map(|c| c.0).collect(), figure, measure })
}

/// Who of `among` has the best paths.
pub fn best(evidence: &Evidence<'_>, scenes: &[usize], among: &dyn Fn(usize) -> bool) -> Option<Answer> {
    let figure = |p: usize| evidence.quality_of(p, scenes).map(|q| (p, q.median, q.ends()));
    let candidates = eligible(evidence, scenes).into_iter().filter(|p| among(*p)).filter_map(figure).collect();
    least(candidates, evidence.quality.measure)
}

/// Who has the best paths after that much `effort`; nobody whose gap is beyond the easiest target.
pub fn within(evidence: &Evidence<'_>, scenes: &[usize], effort: Effort, at: f64) -> Option<Answer> {
    let known: Vec<usize> = scenes.iter().copied().filter(|s| evidence.curves.scenes().contains(s)).collect();
    let band = |p: usize, scene| fixed_budget(&evidence.curves, p, Some(scene), effort, &[at]).first().copied();
    let figure = |p: usize| match known.as_slice() {
        [scene] => band(p, *scene).map(|b| (p, b.median, b.interval)),
        _ => {
            let medians: Vec<f64> = known.iter().filter_map(|s| band(p, *s)).map(|b| b.median).collect();
            Some((p, median(&medians)?, median_interval(&medians)))
        }
    };
    let figures = eligible(evidence, scenes).into_iter().filter_map(figure).filter(|(_, gap, _)| *gap <= SHOWN[0]);
    least(figures.map(|(p, gap, interval)| (p, gap, interval.map(|i| [i.low, i.high]))).collect(), Measure::Gap)
}

/// Who is fastest of those of `among` that are near enough to the optimum, or without gaps of those mostly valid.
pub fn fastest(evidence: &Evidence<'_>, scenes: &[usize], among: &dyn Fn(usize) -> bool) -> Option<Answer> {
    let limit = if evidence.quality.measure == Measure::Gap { NEAR } else { f64::MAX };
    let good = |p: &usize| among(*p) && evidence.quality_of(*p, scenes).is_some_and(|q| q.median <= limit);
    let figure = |p: usize| evidence.time_of(p, scenes).map(|time| (p, time.median, time.ends()));
    least(eligible(evidence, scenes).into_iter().filter(good).filter_map(figure).collect(), Measure::Time)
}

/// The numbers of evaluations that planners are limited to, where there are several.
fn counts(evidence: &Evidence<'_>) -> BTreeSet<u64> {
    let counts: BTreeSet<u64> = evidence.results.planners.iter().filter_map(|p| p.budget.evaluations).collect();
    if counts.len() > 1 { counts } else { BTreeSet::new() }
}

/// Powers of ten of a microsecond at which the best planner is another one than at the one before.
pub fn decades(evidence: &Evidence<'_>) -> Vec<f64> {
    let scenes = evidence.scenes();
    let mut last = None;
    let mut out = Vec::new();
    for us in (0..8).map(|e| 10f64.powi(e)) {
        let best = within(evidence, &scenes, Effort::Time, us).map(|a| a.planners);
        if best.is_some() && best != last {
            out.push(us);
            last = best;
        }
    }
    out
}

/// The entry of the page.
pub fn answers(evidence: &Evidence<'_>, t: &Strings) -> Value {
    let scenes = evidence.scenes();
    let who = |planners: &[usize]| -> Vec<Value> {
        let named = if planners.len() > NAMED { NAMED - 1 } else { planners.len() };
        planners[..named].iter().map(|p| context! { label => evidence.label(*p), swatch => swatch(*p) }).collect()
    };
    let line = |question: &str, planners: &[usize], detail: String, href: &str| {
        let more = planners
            .len()
            .checked_sub(NAMED)
            .filter(|n| *n > 0)
            .map(|n| t.fill("more", &[("n", &(n + 1).to_string())]));
        context! { question, who => who(planners), more, detail, href }
    };
    let mut rows = Vec::new();
    if let Some(answer) = best(evidence, &scenes, &|_| true) {
        let key = match (answer.measure, evidence.grid.scenes.len()) {
            (Measure::Gap, _) => "answer_best_gap",
            (_, 1) => "answer_best_length",
            _ => "answer_best_ratio",
        };
        rows.push(line(t.get("answer_best"), &answer.planners, answer.detail(key, t), "#overall-table"));
    }
    for n in counts(evidence) {
        if let Some(answer) = within(evidence, &scenes, Effort::Evaluations, n as f64) {
            let question = t.fill("answer_within_count", &[("n", &format::count(n as f64))]);
            rows.push(line(&question, &answer.planners, answer.detail("answer_within_gap", t), "#variants"));
        }
    }
    for us in decades(evidence) {
        if let Some(answer) = within(evidence, &scenes, Effort::Time, us) {
            let question = t.fill("answer_within", &[("time", &format::time(us))]);
            rows.push(line(&question, &answer.planners, answer.detail("answer_within_gap", t), "#fixed"));
        }
    }
    if let Some(answer) = fastest(evidence, &scenes, &|_| true) {
        let key = if evidence.quality.measure == Measure::Gap { "answer_fastest_near" } else { "answer_fastest_valid" };
        rows.push(line(t.get("answer_fastest"), &answer.planners, answer.detail(key, t), "#overall-table"));
    }
    let of = |pick: &dyn Fn(usize, usize) -> bool| -> Vec<usize> {
        let valid = |p: &usize| matches!(evidence.valid(*p, &scenes), (valid, runs) if runs > 0 && pick(valid, runs));
        (0..evidence.results.planners.len()).filter(valid).collect()
    };
    let always = of(&|valid, runs| valid == runs);
    if let Some(first) = always.first() {
        // The interval of the one with the fewest runs holds for all.
        let runs =
            always.iter().map(|p| evidence.valid(*p, &scenes).1).min().unwrap_or(evidence.valid(*first, &scenes).1);
        let (low, high) = wilson(runs, runs);
        let interval = format::share_interval(low, high);
        let detail = t.fill("answer_always_detail", &[("n", &format::count(runs as f64)), ("interval", &interval)]);
        rows.push(line(t.get("answer_always"), &always, detail, "#overall-table"));
    }
    let never = of(&|valid, _| valid == 0);
    if !never.is_empty() {
        let href = if evidence.results.runs.is_empty() { "#overall-table" } else { "#missing" };
        rows.push(line(t.get("answer_never"), &never, String::new(), href));
    }
    context! { size => size(evidence, t), rows, quotes => quotes(evidence, t) }
}

/// How large the comparison is, in words.
pub fn size(evidence: &Evidence<'_>, t: &Strings) -> String {
    let results = evidence.results;
    let (p, s, r) = (results.planners.len(), results.scenes.len(), results.repeats as usize);
    if results.runs.is_empty() {
        return t.get("size_empty").to_owned();
    }
    t.fill(
        if results.runs.len() < results.planned() { "size_part" } else { "size" },
        &[
            ("planners", &t.plural(p, "planners_one", "planners")),
            ("scenes", &t.plural(s, "scenes_one", "scenes")),
            ("repeats", &t.plural(r, "repeats_one", "repeats")),
            ("runs", &t.plural(results.runs.len(), "runs_one", "runs")),
        ],
    )
}

/// The nearest rivals of the best planner by quality, of the variants of one planner the nearest.
fn quotes(evidence: &Evidence<'_>, t: &Strings) -> Vec<String> {
    let mut quality = against_best(&evidence.grid, &evidence.quality);
    let rival = |s: &Sentence| match s {
        Sentence::Better { worse, medians, .. } => (*worse, medians[1]),
        Sentence::Settled { other, medians, .. } => (*other, medians[1]),
        Sentence::TooFew { other, medians, .. } => (*other, medians[1]),
        Sentence::Alike { best, other, .. } => {
            (*other, evidence.quality.of(*best, *other).map_or(f64::INFINITY, |pair| pair.medians_of(*other)[0]))
        }
        Sentence::Valid { planner, .. } => (*planner, f64::INFINITY),
    };
    quality.retain(|s| rival(s).1.is_finite());
    quality.sort_by(|a, b| rival(a).1.total_cmp(&rival(b).1));
    let mut groups = BTreeSet::new();
    quality.retain(|s| groups.insert(evidence.results.planners[rival(s).0].group.as_str()));
    quality.truncate(QUOTED);
    quality.iter().map(|s| phrases::phrase(s, evidence, t)).collect()
}

/// Every sentence that the campaign supports: validity, then quality and, where times compare, time against the best.
pub fn sentences(evidence: &Evidence<'_>, t: &Strings) -> Vec<String> {
    let grid = &evidence.grid;
    let all = validity(grid).into_iter().chain(against_best(grid, &evidence.quality));
    let times = evidence.times_compare().then(|| against_best(grid, &evidence.times));
    all.chain(times.into_iter().flatten()).map(|s| phrases::phrase(&s, evidence, t)).collect()
}
