//! What the simulations of each planner come to, one row a planner.

use minijinja::{Value, context};

use super::super::data_table::{number, planner_row, table, with_interval};
use super::super::language::Strings;
use super::{ByScene, counted_ratio, millimetres, moving, seconds, times, typical};
use crate::format;
use crate::results::{Moving, Results, RunRecord};
use crate::statistics::wilson;

/// The comparison of all planners that have runs; `by_planner` in their order.
pub fn comparison(results: &Results, by_planner: &[ByScene<'_>], id: &str, t: &Strings) -> Value {
    let formation = results.runs.iter().filter_map(moving).any(|m| m.metrics.formation_error.is_some());
    // By weight: the last ones need a scroll where the window is narrow.
    let mut heads = vec![
        "head_planner",
        "moving_clean",
        "moving_arrived",
        "moving_collisions",
        "moving_fouls",
        "moving_violations",
        "moving_ratio",
        "moving_switches",
        "moving_stuck",
        "moving_length_ratio",
        "moving_clearance",
    ];
    heads.extend(formation.then_some("moving_formation"));
    heads.extend(["moving_brakes", "moving_escapes", "moving_misses"]);
    let heads: Vec<&str> = heads.into_iter().map(|key| t.get(key)).collect();
    let rows = by_planner.iter().enumerate().filter(|(_, scenes)| scenes.iter().any(|runs| !runs.is_empty()));
    let rows = rows.map(|(i, scenes)| planner_row(&results.planners[i].label, i, cells(results, scenes, formation)));
    table(id, t.get("table_caption"), &heads, rows.collect())
}

fn cells(results: &Results, scenes: &ByScene<'_>, formation: bool) -> Vec<Value> {
    let runs: Vec<&RunRecord> = scenes.iter().flatten().copied().collect();
    let all: Vec<&Moving> = runs.iter().filter_map(|r| moving(r)).collect();
    let sum = |value: &dyn Fn(&Moving) -> f64| all.iter().map(|m| value(m)).sum::<f64>();
    let minutes = sum(&|m| m.metrics.duration_s) / 60.0;
    let rate = |count: f64| {
        let rate = if minutes > 0.0 { count / minutes } else { 0.0 };
        with_small(format::significant(rate, 3), rate, format::count(count))
    };
    let calls = sum(&|m| m.metrics.calls as f64).max(1.0);
    let share =
        |count: f64| number(if count == 0.0 { "0".to_owned() } else { format::percent(count / calls) }, count / calls);
    let middle = |value: &dyn Fn(&Moving) -> Option<f64>, shown: &dyn Fn(f64) -> String| {
        let typical = typical(scenes, &|r| value(moving(r)?));
        typical.map_or_else(none, |(median, interval)| with_interval(median, interval, shown))
    };
    let (clean, arrived) = (runs.iter().filter(|r| r.valid).count(), sum(&|m| m.metrics.arrived as f64));
    let robots = sum(&|m| m.metrics.robots as f64).max(1.0);
    let (low, high) = wilson(clean, runs.len());
    let least = all.iter().filter_map(|m| m.metrics.least_clearance).fold(f64::INFINITY, f64::min);
    let ratio = typical(scenes, &|r| Some(counted_ratio(r))).unwrap_or((f64::INFINITY, None));
    let frames = frames(results, &runs).filter(|frames| *frames > 0.0);
    let misses = sum(&|m| m.compute.misses as f64);
    let mut cells = vec![
        with_small(
            format!("{clean}/{}", runs.len()),
            clean as f64 / runs.len().max(1) as f64,
            format::share_interval(low, high),
        ),
        number(format::percent(arrived / robots), arrived / robots),
        rate(sum(&|m| f64::from(m.metrics.collisions))),
        rate(sum(&|m| f64::from(m.metrics.fouls))),
        rate(sum(&|m| f64::from(m.metrics.violations))),
        with_interval(ratio.0, ratio.1, &times),
        middle(&|m| Some(m.metrics.switches_per_s), &|v| format::significant(v, 3)),
        middle(&|m| Some(m.metrics.stuck_s), &seconds),
        middle(&|m| m.metrics.length_ratio, &times),
        if least.is_finite() { number(millimetres(least), least) } else { none() },
    ];
    if formation {
        cells.push(middle(&|m| m.metrics.formation_error, &millimetres));
    }
    cells.extend([
        share(sum(&|m| m.metrics.brakes as f64)),
        share(sum(&|m| m.metrics.escapes as f64)),
        with_small(
            format::count(misses),
            misses,
            frames.filter(|_| misses > 0.0).map_or_else(String::new, |frames| format::percent(misses / frames)),
        ),
    ]);
    cells
}

/// Frames of all `runs`: what each lasted times its scene's frame rate; `None` where a rate is not known.
fn frames(results: &Results, runs: &[&RunRecord]) -> Option<f64> {
    let of = |run: &&RunRecord| {
        let Some(m) = moving(run) else { return Some(0.0) };
        let scene = results.scenes.iter().find(|s| s.scene.name == run.scene)?;
        Some((m.metrics.duration_s * scene.simulation.as_ref()?.frame_rate).round())
    };
    runs.iter().map(of).sum()
}

fn none() -> Value {
    number(format::NONE, f64::INFINITY)
}

fn with_small(shown: String, key: f64, small: String) -> Value {
    context! { shown, key => format::sort_key(key), kind => "num", small }
}
