//! The answer in one screen: which planner loses least.

use minijinja::{Value, context};

use super::super::data_table::swatch;
use super::super::evidence::Evidence;
use super::super::language::Strings;
use super::{ByScene, counted_ratio, events, moving, seconds, times, typical};
use crate::format;
use crate::results::{Results, RunRecord, TraceOf};
use crate::statistics::wilson;

/// Planners that get a sentence of their own.
const TOLD: usize = 12;
/// Equal but for rounding.
const SAME: f64 = 1e-9;

/// What is asked of one planner.
struct Figures<'a> {
    planner: usize,
    runs: Vec<&'a RunRecord>,
    clean: usize,
    /// Median arrival over least time, +∞ where half of the runs failed.
    ratio: f64,
    /// Median over runs of 99 % of all robots' calls in a frame, in microseconds.
    frame_us: f64,
}

impl Figures<'_> {
    fn share(&self) -> f64 {
        self.clean as f64 / self.runs.len().max(1) as f64
    }
}

fn figures<'a>(by_planner: &[ByScene<'a>]) -> Vec<Figures<'a>> {
    let of = |(planner, scenes): (usize, &ByScene<'a>)| {
        let runs: Vec<&RunRecord> = scenes.iter().flatten().copied().collect();
        let middle = |value: &dyn Fn(&RunRecord) -> Option<f64>| typical(scenes, value).map_or(f64::INFINITY, |m| m.0);
        Figures {
            planner,
            clean: runs.iter().filter(|r| r.valid).count(),
            ratio: middle(&|r| Some(counted_ratio(r))),
            frame_us: middle(&|r| Some(moving(r)?.compute.frame_us[1])),
            runs,
        }
    };
    let all = by_planner.iter().enumerate().filter(|(_, scenes)| scenes.iter().any(|runs| !runs.is_empty()));
    let mut all: Vec<Figures<'_>> = all.map(of).collect();
    all.sort_by(|a, b| b.share().total_cmp(&a.share()).then(a.ratio.total_cmp(&b.ratio)));
    all
}

/// The entry of the page.
pub fn answers(evidence: &Evidence<'_>, by_planner: &[ByScene<'_>], size: String, t: &Strings) -> Value {
    let all = figures(by_planner);
    let line = |question: &str, planners: &[usize], detail: String, href: &str| {
        let who: Vec<Value> =
            planners.iter().map(|p| context! { label => evidence.label(*p), swatch => swatch(*p) }).collect();
        context! { question => t.get(question), who, more => (), detail, href }
    };
    let mut rows = Vec::new();
    if let Some(best) = all.first().filter(|best| best.clean > 0) {
        let equal = |f: &&Figures<'_>| f.share() == best.share() && f.ratio <= best.ratio + SAME;
        let equal: Vec<usize> = all.iter().filter(equal).map(|f| f.planner).collect();
        rows.push(line("answer_loses_least", &equal, told(best, t), "#overall-table"));
    }
    let mostly = || all.iter().filter(|f| f.ratio.is_finite());
    if let Some(quickest) = mostly().min_by(|a, b| a.ratio.total_cmp(&b.ratio)) {
        let detail = t.fill("answer_quickest_detail", &[("ratio", &times(quickest.ratio))]);
        rows.push(line("answer_quickest", &[quickest.planner], detail, "#overall-table"));
    }
    if let Some(least) = mostly().filter(|f| f.frame_us.is_finite()).min_by(|a, b| a.frame_us.total_cmp(&b.frame_us)) {
        let detail = t.fill("answer_cheapest_detail", &[("time", &format::time(least.frame_us))]);
        rows.push(line("answer_cheapest", &[least.planner], detail, "#compute"));
    }
    let of =
        |pick: &dyn Fn(&Figures<'_>) -> bool| all.iter().filter(|f| pick(f)).map(|f| f.planner).collect::<Vec<_>>();
    let always = of(&|f| f.clean == f.runs.len());
    if let Some(runs) = all.iter().filter(|f| f.clean == f.runs.len()).map(|f| f.runs.len()).min() {
        let (low, high) = wilson(runs, runs);
        let interval = format::share_interval(low, high);
        let detail = t.fill("answer_always_detail", &[("n", &format::count(runs as f64)), ("interval", &interval)]);
        rows.push(line("answer_always", &always, detail, "#overall-table"));
    }
    let never = of(&|f| f.clean == 0);
    if !never.is_empty() {
        rows.push(line("answer_never", &never, String::new(), "#overall-table"));
    }
    let quotes: Vec<String> = all.iter().take(TOLD).map(|f| quote(f, evidence.results, t)).collect();
    context! { size, rows, quotes }
}

/// `98 of 100 runs clean [93–99 %], 1.31 × the lower bound`.
fn told(f: &Figures<'_>, t: &Strings) -> String {
    let (low, high) = wilson(f.clean, f.runs.len());
    let interval = format::share_interval(low, high);
    let (clean, runs) = (format::count(f.clean as f64), format::count(f.runs.len() as f64));
    let ratio = times(f.ratio);
    let values = [("clean", clean.as_str()), ("runs", &runs), ("interval", &interval), ("ratio", &ratio)];
    t.fill(if f.ratio.is_finite() { "moving_told" } else { "moving_told_share" }, &values)
}

/// That of a planner by name, with its first failure.
fn quote(f: &Figures<'_>, results: &Results, t: &Strings) -> String {
    let label = results.planners[f.planner].label.as_str();
    let mut out = t.fill("moving_quote", &[("planner", label), ("told", &told(f, t))]);
    if let Some(run) = f.runs.iter().find(|r| !r.valid) {
        let what = failure(run, results, t);
        let (scene, repeat) = (run.scene.as_str(), run.repeat.to_string());
        out += &t.fill("moving_quote_failure", &[("scene", scene), ("repeat", &repeat), ("what", &what)]);
    }
    out
}

/// What went wrong first in a run that is not clean.
fn failure(run: &RunRecord, results: &Results, t: &Strings) -> String {
    let Some(m) = moving(run) else {
        return t.get(&format!("status_{}", run.status.name())).to_owned();
    };
    let same = |k: &&crate::results::MovingTrace| {
        k.of == TraceOf::FirstFailure && k.scene == run.scene && k.planner == run.planner && k.repeat == run.repeat
    };
    let kept = results.traces.iter().find(same);
    if let Some((kept, event)) = kept.and_then(|k| Some((k, k.trace.events.first()?))) {
        let [a, b] = event.bodies.map(|body| events::name(&kept.trace, body, t));
        let who = t.fill("moving_who", &[("a", &a), ("b", &b)]);
        let closing = format::significant(event.closing, 2);
        return t
            .fill("moving_failure_touch", &[("time", &seconds(event.time_s)), ("who", &who), ("closing", &closing)]);
    }
    let (arrived, robots) = (m.metrics.arrived.to_string(), m.metrics.robots.to_string());
    let (collisions, violations) = (m.metrics.collisions.to_string(), m.metrics.violations.to_string());
    let counts = [("arrived", &arrived), ("robots", &robots), ("collisions", &collisions), ("violations", &violations)];
    t.fill("moving_failure_counts", &counts.map(|(key, count)| (key, count.as_str())))
}
