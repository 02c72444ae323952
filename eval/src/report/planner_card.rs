//! One planner in one scene: its best path, all its runs, how they ended.

use std::collections::{BTreeMap, BTreeSet};

use env_model::{Point, World};
use minijinja::{Value, context};

use super::camera::{Camera, polyline};
use super::language::Strings;
use super::svg::{Picture, cross_mark, escape, optimum_line, picture};
use super::{own_picture, palette, tables};
use crate::analysis::counted_length;
use crate::format;
use crate::results::{RunRecord, RunStatus, SceneResult};
use crate::snapshot::Snapshot;
use crate::statistics::median;

/// What the cards of one scene share.
pub struct Stage<'a> {
    /// The scene and its optimum.
    pub scene: &'a SceneResult,
    /// The scene compiled, to mark where a path collides; `None` when it does not compile.
    pub world: Option<&'a World>,
    /// The same view in every picture.
    pub camera: Camera,
    /// Obstacles with numbers round them, markup; `{id}` stands for an id.
    pub backdrop: &'a dyn Fn(&str, bool) -> String,
    /// The obstacles alone, for pictures with something below them.
    pub obstacles: &'a dyn Fn(&str) -> String,
    /// Most runs drawn into one picture.
    pub drawn: usize,
    /// Last frames of runs in this scene.
    pub snapshots: &'a [&'a Snapshot],
}

/// The card of planner `index`; `id` is unique in the page.
pub fn card(stage: &Stage<'_>, label: &str, index: usize, runs: &[&RunRecord], id: &str, t: &Strings) -> Value {
    let (best_svg, best_text) = best(stage, label, index, runs, &format!("{id}-best"), t);
    let (all_svg, all_text) = overlay(stage, label, index, runs, &format!("{id}-all"), true, t);
    context! {
        label, swatch => Value::from_safe_string(palette::swatch(index)),
        best_svg => Value::from_safe_string(best_svg), best_text,
        all_svg => Value::from_safe_string(all_svg), all_text,
        own => own_picture::figures(stage, label, index, runs, &format!("{id}-own"), t),
        tally => tally(runs, t), errors => errors(runs, t), rows => tables::runs(runs, t),
        failed => runs.iter().all(|r| !r.valid),
    }
}

/// A small picture of all runs, without words.
pub fn miniature(stage: &Stage<'_>, label: &str, index: usize, runs: &[&RunRecord], id: &str, t: &Strings) -> Value {
    let (svg, _) = overlay(stage, label, index, runs, id, false, t);
    let valid = runs.iter().filter(|r| r.valid).count();
    context! {
        label, swatch => Value::from_safe_string(palette::swatch(index)), svg => Value::from_safe_string(svg),
        valid, runs => runs.len(), more => runs.len() > stage.drawn,
    }
}

fn drawable(run: &RunRecord) -> bool {
    run.path.iter().filter(|p| p.x.is_finite() && p.y.is_finite()).count() >= 2
}

fn optimum(stage: &Stage<'_>) -> String {
    let path: &[Point] = &stage.scene.optimum.path;
    if path.is_empty() { String::new() } else { optimum_line(&stage.camera, path) }
}

/// The shortest valid path; without one the path that goes least deep, with a cross where it first collides.
fn best(stage: &Stage<'_>, label: &str, index: usize, runs: &[&RunRecord], id: &str, t: &Strings) -> (String, String) {
    let shortest = runs
        .iter()
        .filter(|r| r.valid && drawable(r))
        .min_by(|a, b| counted_length(a).total_cmp(&counted_length(b)))
        .copied();
    let depth = |r: &RunRecord| -r.clearance_min.unwrap_or(f64::NEG_INFINITY);
    let least_bad = || runs.iter().filter(|r| drawable(r)).min_by(|a, b| depth(a).total_cmp(&depth(b))).copied();
    let unit = stage.scene.scene.unit.as_str();
    let n = format::count(runs.len() as f64);
    let only = runs.len() == 1;
    let mut lines = optimum(stage);
    let text = if let Some(run) = shortest {
        lines += &format!(
            r#"<path class="line {} best" d="{}"/>"#,
            palette::colour(index),
            polyline(&stage.camera, &run.path)
        );
        let count = runs.iter().filter(|r| r.valid).count();
        let valid = format::count(count as f64);
        let key = match (runs.len(), count) {
            (1, _) => "best_text_only",
            (_, 1) => "best_text_one",
            _ => "best_text",
        };
        let length = format::length(counted_length(run));
        let (repeat, seed) = (run.repeat.to_string(), run.seed.to_string());
        let mut text = t.fill(
            key,
            &[("valid", &valid), ("n", &n), ("length", &length), ("unit", unit), ("repeat", &repeat), ("seed", &seed)],
        );
        if let Some(gap) = run.gap {
            text += t.get("sentence_gap");
            text += &t.fill("best_gap", &[("gap", &format::percent(gap))]);
        }
        if let (Some(clearance), Some(turning)) = (run.clearance_min, run.turning) {
            let (c, a) = (format::significant(clearance, 3), format::angle(turning));
            text += t.get("sentence_gap");
            text += &t.fill("best_detail", &[("clearance", &c), ("unit", unit), ("turning", &a)]);
        }
        text
    } else if let Some(run) = least_bad() {
        lines += &format!(r#"<path class="line invalid best" d="{}"/>"#, polyline(&stage.camera, &run.path));
        let finite = run.path.iter().all(|p| p.x.is_finite() && p.y.is_finite());
        if let Some(violation) = stage.world.filter(|_| finite).and_then(|w| w.first_violation(&run.path)) {
            lines += &cross_mark(&stage.camera, violation.at);
        }
        let depth = run.clearance_min.map_or(format::NONE.to_owned(), |c| format::significant((-c).max(0.0), 3));
        t.fill(
            if only { "best_none_only" } else { "best_none" },
            &[("n", &n), ("repeat", &run.repeat.to_string()), ("depth", &depth), ("unit", unit)],
        )
    } else {
        t.fill(if only { "best_no_path_only" } else { "best_no_path" }, &[("n", &n)])
    };
    let title = t.fill("best_title", &[("planner", label)]);
    (figure(stage, id, &title, &text, &lines, true, t), text)
}

/// All runs: valid ones in the planner's colour, the others dashed below them.
fn overlay(
    stage: &Stage<'_>,
    label: &str,
    index: usize,
    runs: &[&RunRecord],
    id: &str,
    words: bool,
    t: &Strings,
) -> (String, String) {
    let mut lines = String::new();
    // Runs with the same picture are drawn once: deterministic planners have one line, not thirty.
    let mut drawn: BTreeSet<(bool, String)> = BTreeSet::new();
    for run in runs.iter().filter(|r| drawable(r)).take(stage.drawn) {
        drawn.insert((run.valid, polyline(&stage.camera, &run.path)));
    }
    // Invalid ones come first (false < true): they must not hide what is valid.
    let weight = if drawn.len() == 1 { "best" } else { "run" };
    for (valid, d) in &drawn {
        let class = if *valid { palette::colour(index) } else { "invalid".to_owned() };
        lines += &format!(r#"<path class="line {class} {weight}" d="{d}"/>"#);
    }
    lines += &optimum(stage);
    let valid = runs.iter().filter(|r| r.valid).count();
    let empty = runs.iter().filter(|r| !drawable(r)).count();
    let count = |n: usize| format::count(n as f64);
    let mut sentences = vec![match (runs.len(), valid) {
        (1, 1) => t.get("all_only_valid").to_owned(),
        (1, _) => t.get("all_only_invalid").to_owned(),
        (n, _) => t.fill("all_text", &[("n", &count(n)), ("valid", &count(valid))]),
    }];
    let invalid = runs.len() - valid - runs.iter().filter(|r| !r.valid && !drawable(r)).count();
    if invalid > 0 {
        sentences.push(t.plural(invalid, "all_invalid_one", "all_invalid"));
    }
    if empty > 0 {
        sentences.push(t.plural(empty, "all_empty_one", "all_empty"));
    }
    if drawn.len() == 1 && runs.len() - empty > 1 {
        sentences.push(t.get("all_same").to_owned());
    }
    if runs.len() - empty > stage.drawn {
        sentences.push(t.fill("all_first", &[("n", &count(stage.drawn))]));
    }
    let lengths: Vec<f64> = runs.iter().map(|r| counted_length(r)).collect();
    let finite = lengths.iter().copied().filter(|l| l.is_finite());
    let (low, high) = (finite.clone().fold(f64::INFINITY, f64::min), finite.fold(0.0, f64::max));
    if low.is_finite() && drawn.len() > 1 {
        let middle = median(&lengths).unwrap_or(f64::INFINITY);
        let values = [low, high, middle].map(format::length);
        let unit = stage.scene.scene.unit.as_str();
        sentences.push(
            t.fill("all_lengths", &[("low", &values[0]), ("high", &values[1]), ("median", &values[2]), ("unit", unit)]),
        );
    }
    sentences.push(t.get("all_better").to_owned());
    let text = sentences.join(t.get("sentence_gap"));
    let title = t.fill("all_title", &[("planner", label)]);
    (figure(stage, id, &title, &text, &lines, words, t), text)
}

fn figure(stage: &Stage<'_>, id: &str, title: &str, desc: &str, lines: &str, words: bool, t: &Strings) -> String {
    let backdrop = (stage.backdrop)(id, words);
    let what = Picture { id, title, desc, backdrop: &backdrop, lines, words, foot: ("", 0.0) };
    picture(&stage.scene.scene, &stage.camera, t, &what)
}

/// "27 solved · 3 budget spent": how the runs ended by the planner's own account.
fn tally(runs: &[&RunRecord], t: &Strings) -> String {
    let parts: Vec<String> = RunStatus::ALL
        .iter()
        .map(|status| (status, runs.iter().filter(|r| r.status == *status).count()))
        .filter(|(_, n)| *n > 0)
        .map(|(status, n)| format!("{n}\u{a0}{}", t.get(&format!("status_{}", status.name()))))
        .collect();
    parts.join(" · ")
}

/// Each distinct error message once, with how many runs gave it.
fn errors(runs: &[&RunRecord], t: &Strings) -> Vec<String> {
    let mut counted: BTreeMap<&str, usize> = BTreeMap::new();
    for message in runs.iter().filter_map(|r| r.error.as_deref()) {
        *counted.entry(message).or_default() += 1;
    }
    counted.iter().map(|(m, n)| t.fill("error_line", &[("n", &n.to_string()), ("message", m)])).collect()
}

/// A backdrop by reference, for scenes with so many obstacles that copies would bloat the page.
pub fn reference(id: &str) -> String {
    format!(r##"<use href="#{}"/>"##, escape(id))
}
