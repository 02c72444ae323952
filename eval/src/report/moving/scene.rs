//! One moving scene: every planner's representative simulation, the first that failed beside it, and all its runs.

use minijinja::{Value, context};
use strategy::{League, RobotRecord, Settings, Trace};

use super::super::language::Strings;
use super::super::palette;
use super::super::strip::{self, Row};
use super::animation::{self, Clip};
use super::stage::Stage;
use super::{ByScene, counted_ratio, legend, moving, runs, tables, times};
use crate::format;
use crate::results::{MovingTrace, Results, RunRecord, SceneResult, SceneSet, TraceOf};

/// Arrival over least time is 1 at best.
const RATIO_FLOOR: f64 = 1.0;
/// Errors of one planner that are told.
const ERRORS: usize = 3;

/// The section of scene `index`; pictures only where `full`, the rest has its table alone.
pub fn section(results: &Results, index: usize, full: bool, t: &Strings) -> Value {
    let scene = &results.scenes[index];
    let name = scene.scene.name.as_str();
    let by_planner: Vec<ByScene<'_>> =
        results.planners.iter().map(|p| vec![results.runs_of(&p.label, Some(name)).collect()]).collect();
    let one = results.scenes.len() == 1;
    let shown = full.then(|| pictures(results, index, &by_planner, t));
    context! {
        name, anchor => super::super::scene_anchor(index), only => one,
        facts => scene.simulation.as_ref().map_or_else(String::new, |s| facts(s, t)),
        table => (!one).then(|| tables::comparison(results, &by_planner, &format!("scene-{index}-table"), t)),
        moving => true, shown, spread => full.then(|| spread(results, &[scene], &format!("s{index}-spread"), t)).flatten(),
        tuning => scene.set == SceneSet::Tuning, full, runs => by_planner.iter().flatten().map(Vec::len).sum::<usize>(),
    }
}

fn facts(s: &Settings, t: &Strings) -> String {
    let number = |v: f64| format::significant(v, 3);
    let mut parts = vec![
        t.plural(s.robots, "moving_robots_one", "moving_robots"),
        t.plural(s.opponents, "moving_opponents_one", "moving_opponents"),
        t.fill("moving_limits", &[("speed", &number(s.speed)), ("acceleration", &number(s.acceleration))]),
        t.fill("moving_frames", &[("rate", &number(s.frame_rate)), ("duration", &number(s.duration_s))]),
    ];
    if s.latency_ms > 0.0 {
        parts.push(t.fill("moving_latency", &[("latency", &number(s.latency_ms))]));
    }
    parts.join(" · ")
}

fn pictures(results: &Results, index: usize, by_planner: &[ByScene<'_>], t: &Strings) -> Value {
    let scene = &results.scenes[index];
    let name = scene.scene.name.as_str();
    let kept: Vec<&MovingTrace> = results.traces.iter().filter(|k| k.scene == name).collect();
    let league = scene.simulation.as_ref().map_or_else(League::default, |s| s.league);
    let stage = Stage::new(kept.iter().map(|k| (&k.trace, robots(results, k))), league);
    let traces: Vec<&Trace> = kept.iter().map(|k| &k.trace).collect();
    let cards: Vec<Value> = results
        .planners
        .iter()
        .enumerate()
        .zip(by_planner)
        .filter(|(_, scenes)| scenes.iter().any(|runs| !runs.is_empty()))
        .map(|((i, planner), scenes)| {
            let runs: Vec<&RunRecord> = scenes.iter().flatten().copied().collect();
            let mut own: Vec<&&MovingTrace> = kept.iter().filter(|k| k.planner == planner.label).collect();
            // The median first, where there is one.
            own.sort_by_key(|k| k.of != TraceOf::Median);
            let clips: Vec<Value> = own
                .iter()
                .enumerate()
                .filter_map(|(n, k)| clip(k, &format!("s{index}-t{i}-{n}"), robots(results, k), &runs, &stage, t))
                .collect();
            context! {
                label => planner.label.as_str(), swatch => Value::from_safe_string(palette::swatch(i)),
                clips, errors => errors(&runs), runs => runs::runs(&runs, &format!("s{index}-r{i}"), t),
            }
        })
        .collect();
    context! { keys => legend::keys(&traces, t), animated => !kept.is_empty(), cards }
}

/// The own robots of a trace.
fn robots<'a>(results: &'a Results, kept: &'a MovingTrace) -> &'a [RobotRecord] {
    let run = results.runs_of(&kept.planner, Some(&kept.scene)).find(|r| r.repeat == kept.repeat);
    run.and_then(moving).map_or(&[], |m| &m.robots)
}

/// One trace as a figure.
fn clip(
    kept: &MovingTrace,
    id: &str,
    robots: &[RobotRecord],
    runs: &[&RunRecord],
    stage: &Stage,
    t: &Strings,
) -> Option<Value> {
    let run = runs.iter().find(|r| r.repeat == kept.repeat);
    let median = kept.of == TraceOf::Median;
    let mut text = t.fill(
        if median { "moving_text_median" } else { "moving_text_failure" },
        &[("repeat", &kept.repeat.to_string()), ("seed", &kept.seed.to_string())],
    );
    if let Some(m) = run.and_then(|r| moving(r)) {
        let m = &m.metrics;
        let counts = [("arrived", m.arrived.to_string()), ("robots", m.robots.to_string())];
        let counts: Vec<(&str, &str)> = counts.iter().map(|(k, v)| (*k, v.as_str())).collect();
        text += t.get("sentence_gap");
        text += &t.fill("moving_text_arrived", &counts);
        if let Some(ratio) = m.time_ratio() {
            text += t.get("sentence_gap");
            text += &t.fill(
                "moving_text_ratio",
                &[("arrival", &super::seconds(m.arrival_s.unwrap_or(0.0))), ("ratio", &times(ratio))],
            );
        }
        text += t.get("sentence_gap");
        text += &match (m.collisions, m.violations) {
            (0, 0) => t.get("moving_text_clean").to_owned(),
            (c, v) => t.fill(
                "moving_text_touched",
                &[("collisions", &c.to_string()), ("violations", &v.to_string()), ("fouls", &m.fouls.to_string())],
            ),
        };
    }
    if !kept.faithful {
        text += t.get("sentence_gap");
        text += t.get("moving_unfaithful");
    }
    let heading = t.get(if median { "moving_heading_median" } else { "moving_heading_failure" });
    let title = t.fill("moving_picture", &[("planner", &kept.planner), ("scene", &kept.scene), ("which", heading)]);
    let clip = Clip { id, heading, title: &title, text: &text, trace: &kept.trace, robots };
    animation::figure(&clip, stage, t)
}

fn errors(runs: &[&RunRecord]) -> Vec<String> {
    let mut errors: Vec<&str> = runs.iter().filter_map(|r| r.error.as_deref()).collect();
    errors.sort_unstable();
    errors.dedup();
    errors.truncate(ERRORS);
    errors.into_iter().map(str::to_owned).collect()
}

/// How arrival over the least time spreads over the runs in `scenes`.
pub fn spread(results: &Results, scenes: &[&SceneResult], id: &str, t: &Strings) -> Option<Value> {
    let inside = |r: &RunRecord| scenes.iter().any(|s| s.scene.name == r.scene);
    let row = |(index, planner): (usize, &'_ crate::results::PlannerInfo)| {
        let runs: Vec<&RunRecord> = results.runs_of(&planner.label, None).filter(|r| inside(r)).collect();
        let failed = runs.iter().filter(|r| !r.valid).count();
        (index, runs.iter().map(|r| counted_ratio(r)).collect::<Vec<f64>>(), failed)
    };
    let rows: Vec<Row<'_>> = results
        .planners
        .iter()
        .enumerate()
        .map(row)
        .map(|(index, values, failed)| Row { label: &results.planners[index].label, index, values, failed })
        .collect();
    let most = rows.iter().map(|r| r.values.len()).max().unwrap_or(0);
    let mut text = t.plural(most, "gap_text_one", "gap_text");
    if scenes.len() > 1 {
        text += t.get("sentence_gap");
        text += t.get("strip_pooled");
    }
    let (title, axis) = (t.get("gap_title"), t.get("gap_axis"));
    strip::figure(&rows, &strip::Kind { id, title, axis, text: &text, number: times, floor: RATIO_FLOOR }, t)
}
