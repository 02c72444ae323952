//! One scene: what it is, its table, its figures.

use env_model::World;
use minijinja::{Value, context};

use super::backdrop::{backdrop, obstacles};
use super::camera::Camera;
use super::convergence::{self, Series};
use super::evidence::Evidence;
use super::language::Strings;
use super::planner_card::{Stage, card, miniature, reference};
use super::strip::{self, Row};
use super::{fitness, pareto, tables};
use crate::analysis::counted_length;
use crate::format;
use crate::results::{Results, RunRecord, SceneResult, SceneSet};
use crate::snapshot::Snapshot;

/// Runs drawn into one full picture; the page stays within some megabytes.
const DRAWN: usize = 250;
/// Runs drawn into one miniature.
pub const DRAWN_SMALL: usize = 60;
/// Beyond this many obstacles in all pictures together these share one copy of them.
const SHARED: usize = 150;
/// Gaps below this are drawn on the edge of a logarithmic axis.
const GAP_FLOOR: f64 = 1e-8;

/// How much of a scene to show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Every figure.
    Full,
    /// Table and small pictures.
    Small,
    /// Table alone.
    Table,
}

/// The section of scene `index`.
pub fn section(evidence: &Evidence<'_>, index: usize, extent: Extent, t: &Strings) -> Value {
    let results = evidence.results;
    let scene = &results.scenes[index];
    let name = scene.scene.name.as_str();
    let by_planner: Vec<Vec<&RunRecord>> =
        results.planners.iter().map(|p| results.runs_of(&p.label, Some(name)).collect()).collect();
    let with_runs = || results.planners.iter().enumerate().zip(&by_planner).filter(|(_, runs)| !runs.is_empty());
    let shared = scene.scene.obstacles.len() * results.planners.len() > SHARED;
    let paths = by_planner.iter().flatten().map(|r| r.path.as_slice());
    let camera = Camera::new(&scene.scene, paths.chain([scene.optimum.path.as_slice()]));
    let own = |id: &str, words: bool| backdrop(&scene.scene, &camera, t, id, words);
    let refer = |_: &str, words: bool| reference(&format!("scene-{index}-{}", if words { "full" } else { "bare" }));
    let world = World::new(&scene.scene).ok();
    let own_obstacles = |id: &str| obstacles(&scene.scene, &camera, id);
    let refer_obstacles = |_: &str| reference(&format!("scene-{index}-full-o-obstacles"));
    let snapshots: Vec<&Snapshot> = results.snapshots.iter().filter(|s| s.scene == name).collect();
    let stage = Stage {
        scene,
        world: world.as_ref(),
        camera,
        backdrop: if shared { &refer } else { &own },
        obstacles: if shared { &refer_obstacles } else { &own_obstacles },
        snapshots: &snapshots,
        drawn: if extent == Extent::Full { DRAWN } else { DRAWN_SMALL },
    };
    let copies = if shared && extent != Extent::Table {
        let copy = |kind: &str, words: bool| {
            let id = format!("scene-{index}-{kind}");
            format!(r#"<g id="{id}">{}</g>"#, own(&format!("{id}-o"), words))
        };
        let defs = if extent == Extent::Full { copy("full", true) } else { copy("bare", false) };
        format!(r#"<svg class="defs" width="0" height="0" aria-hidden="true"><defs>{defs}</defs></svg>"#)
    } else {
        String::new()
    };
    let id = |kind: &str, i: usize| format!("s{index}-{kind}{i}");
    let cards: Vec<Value> = if extent == Extent::Full {
        with_runs().map(|((i, p), runs)| card(&stage, &p.label, i, runs, &id("p", i), t)).collect()
    } else {
        Vec::new()
    };
    let miniatures: Vec<Value> = if extent == Extent::Small {
        with_runs().map(|((i, p), runs)| miniature(&stage, &p.label, i, runs, &id("m", i), t)).collect()
    } else {
        Vec::new()
    };
    let mut charts = (None, None, None);
    let mut own = (None, None);
    let mut no_convergence = None;
    if extent == Extent::Full {
        let series: Vec<Series<'_>> =
            with_runs().map(|((index, p), runs)| Series { label: &p.label, index, runs: runs.clone() }).collect();
        let unit = scene.scene.unit.as_str();
        charts.0 = convergence::figure(&id("convergence", 0), &series, scene.optimum.length, unit, t);
        no_convergence = charts.0.is_none().then(|| convergence::nothing(&series, t));
        charts.1 = spread(results, &[scene], &id("spread", 0), t);
        charts.2 = times(results, Some(name), &id("time", 0), t);
        own.0 = pareto::figure(&id("pareto", 0), &series, t);
        let place = |label: &str| results.planners.iter().position(|p| p.label == label);
        own.1 = fitness::figure(&id("fitness", 0), &snapshots, place, t);
    }
    let one = results.scenes.len() == 1;
    context! {
        name, anchor => super::scene_anchor(index), facts => facts(scene, t),
        optimum => optimum(scene, t), only => one, ring => scene.scene.robot_radius > 0.0,
        known => !scene.optimum.path.is_empty(),
        table => if one { Value::from(()) } else { tables::comparison(evidence, Some(name), &scene.scene.unit, t) },
        copies => Value::from_safe_string(copies),
        cards, miniatures, convergence => charts.0, no_convergence, pareto => own.0, fitness => own.1, spread => charts.1, times => charts.2,
        more => by_planner.iter().any(|r| r.len() > DRAWN_SMALL), small_drawn => DRAWN_SMALL,
        moving => false, tuning => scene.set == SceneSet::Tuning,
        full => extent == Extent::Full, runs => by_planner.iter().map(Vec::len).sum::<usize>(),
    }
}

fn facts(scene: &SceneResult, t: &Strings) -> String {
    let s = &scene.scene;
    let distance = format::length((s.goal() - s.start()).norm());
    let mut parts = vec![
        t.plural(s.obstacles.len(), "obstacles_one", "obstacles"),
        t.fill("facts_distance", &[("distance", &distance), ("unit", &s.unit)]),
    ];
    if s.robot_radius > 0.0 {
        let radius = format::significant(s.robot_radius, 4);
        parts.push(t.fill("facts_radius", &[("radius", &radius), ("unit", &s.unit)]));
    }
    if let Some(field) = s.field {
        let [w, h] = [0, 1].map(|k| format::significant(field.max[k] - field.min[k], 5));
        parts.push(t.fill("facts_field", &[("width", &w), ("height", &h), ("unit", &s.unit)]));
    }
    parts.join(" · ")
}

fn optimum(scene: &SceneResult, t: &Strings) -> String {
    match (scene.optimum.length, &scene.optimum.reason) {
        // Nine digits: it is the yardstick, and published to as many.
        (Some(length), _) => {
            t.fill("optimum_known", &[("length", &format::significant(length, 9)), ("unit", &scene.scene.unit)])
        }
        (None, Some(reason)) => t.fill("optimum_because", &[("reason", reason)]),
        (None, None) => t.get("optimum_unknown").to_owned(),
    }
}

/// How gaps (or, without an optimum, lengths) spread over the runs in `scenes`.
pub fn spread(results: &Results, scenes: &[&SceneResult], id: &str, t: &Strings) -> Option<Value> {
    let known: Vec<&str> =
        scenes.iter().filter(|s| s.optimum.length.is_some()).map(|s| s.scene.name.as_str()).collect();
    let by_gap = !known.is_empty();
    // Lengths of different scenes do not compare.
    if !by_gap && scenes.len() != 1 {
        return None;
    }
    let names = if by_gap { known } else { scenes.iter().map(|s| s.scene.name.as_str()).collect() };
    let rows = rows(results, |r| names.contains(&r.scene.as_str()), &|r| {
        if by_gap { r.gap.unwrap_or(f64::INFINITY) } else { counted_length(r) }
    });
    let runs = rows.iter().map(|r| r.values.len()).max().unwrap_or(0);
    let title = t.get(if by_gap { "gap_title" } else { "length_title" });
    let axis = if by_gap {
        t.get("gap_axis").to_owned()
    } else {
        tables::with_unit(t.get("length_axis"), scenes.first().map_or("", |s| s.scene.unit.as_str()))
    };
    let mut text = if by_gap {
        t.plural(runs, "gap_text_one", "gap_text")
    } else {
        t.plural(runs, "length_text_one", "length_text")
    };
    if scenes.len() > 1 {
        text += t.get("sentence_gap");
        text += t.get("strip_pooled");
    }
    let shown: usize = rows.iter().map(|r| r.values.len()).sum();
    let left = results.runs.iter().filter(|r| scenes.iter().any(|s| s.scene.name == r.scene)).count() - shown;
    if left > 0 {
        let [shown, left] = [shown, left].map(|n| t.plural(n, "runs_one", "runs"));
        text += t.get("sentence_gap");
        text += &t.fill("gap_left_out", &[("runs", &shown), ("left", &left)]);
    }
    let number = if by_gap { format::percent } else { format::length };
    strip::figure(&rows, &strip::Kind { id, title, axis: &axis, text: &text, number, floor: GAP_FLOOR }, t)
}

/// How wall times spread, over one scene or all test scenes; every run counts, failed or not.
pub fn times(results: &Results, scene: Option<&str>, id: &str, t: &Strings) -> Option<Value> {
    let tuning = |name: &str| results.scenes.iter().any(|s| s.set == SceneSet::Tuning && s.scene.name == name);
    let wanted = |r: &RunRecord| scene.map_or_else(|| !tuning(&r.scene), |s| r.scene == s);
    let rows = rows(results, wanted, &|r| r.time_us);
    let runs = rows.iter().map(|r| r.values.len()).max().unwrap_or(0);
    let mut text = t.plural(runs, "time_text_one", "time_text");
    if scene.is_none() {
        text += t.get("sentence_gap");
        text += t.get("strip_pooled");
    }
    let (title, axis) = (t.get("time_title"), t.get("time_axis"));
    strip::figure(&rows, &strip::Kind { id, title, axis, text: &text, number: format::time, floor: 1e-3 }, t)
}

fn rows<'a>(
    results: &'a Results,
    keep: impl Fn(&RunRecord) -> bool,
    value: &dyn Fn(&RunRecord) -> f64,
) -> Vec<Row<'a>> {
    let of = |(index, label): (usize, &'a str)| {
        let runs: Vec<&RunRecord> = results.runs_of(label, None).filter(|r| keep(r)).collect();
        let values = runs.iter().map(|r| value(r)).map(|v| if v.is_nan() { f64::INFINITY } else { v }).collect();
        Row { label, index, values, failed: runs.iter().filter(|r| !r.valid).count() }
    };
    results.planners.iter().map(|p| p.label.as_str()).enumerate().map(of).collect()
}
