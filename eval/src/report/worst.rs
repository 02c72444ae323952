//! The worst cases: runs that failed, paths that go through something, and the largest gaps.
//!
//! One a planner and kind, so that one planner's failures do not hide another's; tuning scenes come last.

use std::collections::BTreeSet;

use env_model::World;
use minijinja::{Value, context};

use super::backdrop::backdrop;
use super::camera::Camera;
use super::data_table::swatch;
use super::language::Strings;
use super::planner_card::{Stage, one_run};
use super::{replay_command, scene_anchor};
use crate::config::scene_files;
use crate::format;
use crate::results::{Results, RunRecord, RunStatus, SceneSet};

/// Cases drawn.
const DRAWN: usize = 12;
/// Cases listed below them.
const LISTED: usize = 40;
/// Gaps below this are nobody's worst case.
const FLOOR: f64 = 1e-6;

/// What is bad about a run, worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    /// It ended in an error, a crash, or beyond its limits.
    Failed,
    /// Its path is not valid.
    Invalid,
    /// It gave no path.
    NoPath,
    /// Its path is long.
    Gap,
}

struct Case<'a> {
    kind: Kind,
    /// The larger, the worse among its kind.
    badness: f64,
    run: &'a RunRecord,
    planner: usize,
    tuning: bool,
}

fn judge(run: &RunRecord) -> Option<(Kind, f64)> {
    use RunStatus::{Crashed, Error, OutOfMemory, Timeout};
    if matches!(run.status, Error | Crashed | Timeout | OutOfMemory) {
        return Some((Kind::Failed, 0.0));
    }
    if run.valid {
        return run.gap.filter(|gap| *gap > FLOOR).map(|gap| (Kind::Gap, gap));
    }
    if run.path.is_empty() {
        Some((Kind::NoPath, 0.0))
    } else {
        Some((Kind::Invalid, -run.clearance_min.unwrap_or(0.0)))
    }
}

/// Each planner's worst run of each kind, in test scenes and in tuning scenes; of equals the first.
fn cases(results: &Results) -> Vec<Case<'_>> {
    let tuning_scenes: BTreeSet<&str> =
        results.scenes.iter().filter(|s| s.set == SceneSet::Tuning).map(|s| s.scene.name.as_str()).collect();
    let mut cases: Vec<Case<'_>> = Vec::new();
    for (planner, info) in results.planners.iter().enumerate() {
        let first = cases.len();
        for run in results.runs_of(&info.label, None) {
            let Some((kind, badness)) = judge(run) else { continue };
            let tuning = tuning_scenes.contains(run.scene.as_str());
            match cases[first..].iter_mut().find(|c| c.kind == kind && c.tuning == tuning) {
                Some(known) if badness > known.badness => (known.run, known.badness) = (run, badness),
                Some(_) => {}
                None => cases.push(Case { kind, badness, run, planner, tuning }),
            }
        }
    }
    cases.sort_by(|a, b| (a.tuning, a.kind).cmp(&(b.tuning, b.kind)).then(b.badness.total_cmp(&a.badness)));
    cases
}

/// The cases to draw: of each kind some, so that failures leave room for gaps; the rest is listed.
fn picked(cases: Vec<Case<'_>>) -> (Vec<Case<'_>>, Vec<Case<'_>>) {
    let share = |kind: Kind| cases.iter().filter(|c| c.kind == kind).count().min(DRAWN / 4);
    let reserved = [Kind::Failed, Kind::Invalid, Kind::NoPath, Kind::Gap].map(share);
    let mut free = DRAWN - reserved.iter().sum::<usize>();
    let mut taken = [0; 4];
    cases.into_iter().partition(|c| {
        let kind = c.kind as usize;
        taken[kind] += 1;
        let draw = taken[kind] <= reserved[kind] || free > 0;
        free -= usize::from(draw && taken[kind] > reserved[kind]);
        draw
    })
}

/// The section; `None` where nothing is bad.
pub fn figure(results: &Results, t: &Strings) -> Option<Value> {
    let (drawn, rest) = picked(cases(results));
    if drawn.is_empty() {
        return None;
    }
    let files = scene_files(results.scenes.iter().map(|s| s.scene.name.as_str()));
    let describe = |case: &Case<'_>| {
        let scene = results.scenes.iter().position(|s| s.scene.name == case.run.scene)?;
        let command = replay_command::command(&results.planners[case.planner], &files[scene], case.run.seed);
        let all_runs = command.starts_with("touchline run");
        Some((scene, words(case, results, scene, t), command, all_runs))
    };
    let drawn = drawn.iter().enumerate().filter_map(|(n, case)| {
        let (scene, text, command, all_runs) = describe(case)?;
        let title = format!("{} · {}", results.planners[case.planner].label, case.run.scene);
        let svg = draw(results, scene, case, &format!("worst{n}"), &title, &text, t);
        Some(context! {
            label => results.planners[case.planner].label.as_str(), swatch => swatch(case.planner),
            anchor => format!("worst-{n}"), scene => case.run.scene.as_str(), href => scene_anchor(scene),
            svg => Value::from_safe_string(svg), text, command, all_runs, tuning => case.tuning,
        })
    });
    let drawn: Vec<Value> = drawn.collect();
    let more = rest.len().saturating_sub(LISTED);
    let rest = rest.iter().take(LISTED).filter_map(|case| {
        let (scene, text, command, all_runs) = describe(case)?;
        Some(context! {
            label => results.planners[case.planner].label.as_str(), swatch => swatch(case.planner),
            scene => case.run.scene.as_str(), href => scene_anchor(scene), text, command, all_runs, tuning => case.tuning,
        })
    });
    Some(context! { drawn, rest => rest.collect::<Vec<_>>(), more })
}

/// What happened, in words.
fn words(case: &Case<'_>, results: &Results, scene: usize, t: &Strings) -> String {
    let run = case.run;
    let unit = results.scenes[scene].scene.unit.as_str();
    let status = || t.get(&format!("status_{}", run.status.name())).to_owned();
    let what = match (case.kind, run.error.as_deref()) {
        // Of a path that ends elsewhere the message says more than its depth.
        (Kind::Failed | Kind::Invalid | Kind::NoPath, Some(message)) => format!("{}: {message}", status()),
        (Kind::Failed, None) => status(),
        (Kind::Invalid, None) => {
            let depth = format::significant(case.badness.max(0.0), 3);
            t.fill("worst_invalid", &[("depth", &depth), ("unit", unit)])
        }
        (Kind::NoPath, None) => t.fill("worst_no_path", &[("status", &status())]),
        (Kind::Gap, _) => t.fill("worst_gap", &[("gap", &format::percent(case.badness))]),
    };
    let which = t.fill("worst_run", &[("repeat", &run.repeat.to_string()), ("seed", &run.seed.to_string())]);
    which + t.get("sentence_gap") + &what
}

fn draw(results: &Results, scene: usize, case: &Case<'_>, id: &str, title: &str, text: &str, t: &Strings) -> String {
    let scene = &results.scenes[scene];
    let world = World::new(&scene.scene).ok();
    let camera = Camera::new(&scene.scene, [case.run.path.as_slice(), scene.optimum.path.as_slice()].into_iter());
    let stage = Stage {
        scene,
        world: world.as_ref(),
        camera,
        backdrop: &|id: &str, words: bool| backdrop(&scene.scene, &camera, t, id, words),
        obstacles: &|_: &str| String::new(),
        drawn: 1,
        snapshots: &[],
    };
    one_run(&stage, case.planner, case.run, id, title, text, t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::tests::run;

    fn case(kind: Kind, run: &RunRecord) -> Case<'_> {
        Case { kind, badness: 0.0, run, planner: 0, tuning: false }
    }

    #[test]
    fn every_kind_has_its_room() {
        let run = run("a", "p", 0, None);
        let many = |failed: usize, gaps: usize| -> Vec<Case<'_>> {
            let of = |kind, n| (0..n).map(move |_| kind);
            of(Kind::Failed, failed).chain(of(Kind::Gap, gaps)).map(|kind| case(kind, &run)).collect()
        };
        let count = |cases: &[Case<'_>], kind| cases.iter().filter(|c| c.kind == kind).count();
        let (drawn, rest) = picked(many(30, 30));
        assert_eq!((count(&drawn, Kind::Failed), count(&drawn, Kind::Gap), rest.len()), (9, 3, 48));
        let (drawn, rest) = picked(many(1, 30));
        assert_eq!((count(&drawn, Kind::Failed), count(&drawn, Kind::Gap), rest.len()), (1, 11, 19));
        let (drawn, rest) = picked(many(0, 5));
        assert_eq!((drawn.len(), rest.len()), (5, 0));
    }

    #[test]
    fn runs_are_judged_by_what_is_worst() {
        let mut r = run("a", "p", 0, Some(12.0));
        assert_eq!(judge(&r).map(|(kind, _)| kind), Some(Kind::Gap));
        r.gap = Some(0.0);
        assert!(judge(&r).is_none(), "at the optimum");
        (r.valid, r.gap, r.clearance_min) = (false, None, Some(-0.25));
        assert_eq!(judge(&r), Some((Kind::Invalid, 0.25)));
        r.path.clear();
        assert_eq!(judge(&r).map(|(kind, _)| kind), Some(Kind::NoPath));
        r.status = RunStatus::OutOfMemory;
        assert_eq!(judge(&r).map(|(kind, _)| kind), Some(Kind::Failed));
    }
}
