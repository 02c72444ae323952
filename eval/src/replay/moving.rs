//! Simulates some runs again, untimed, and keeps who was where when.

use strategy::Trace;

use crate::campaign::Campaign;
use crate::results::{MovingTrace, RunRecord, TraceOf};
use crate::simulate;
use crate::statistics::quantile;

/// Scenes of which traces are kept: each is tens of kilobytes.
pub const SCENES: usize = 3;

/// Of every planner in the first few scenes its first failure and its median clean run, in the order of scenes and
/// planners. `runs` are the campaign's, sorted by repeat within scene and planner.
pub fn traces(campaign: &Campaign, runs: &[RunRecord]) -> Vec<MovingTrace> {
    let mut all = Vec::new();
    for arena in campaign.arenas.iter().take(SCENES) {
        let Some(settings) = &arena.simulation else { continue };
        for entry in &campaign.comparison.planners {
            let of: Vec<&RunRecord> =
                runs.iter().filter(|r| r.scene == arena.scene.name && r.planner == entry.label).collect();
            for (of, run) in typical(&of) {
                let (again, trace) = simulate::run(entry, &run.scene, settings, run.seed);
                let Some(trace) = trace else { continue };
                let faithful = again.moving.map(|m| m.metrics) == run.moving.as_ref().map(|m| m.metrics);
                let (scene, planner) = (run.scene.clone(), run.planner.clone());
                let (repeat, seed) = (run.repeat, run.seed);
                all.push(MovingTrace { scene, planner, repeat, seed, of, faithful, trace: rounded(trace) });
            }
        }
    }
    all
}

/// The first failure, and the clean run whose time of arrival is nearest the median of such.
fn typical<'r>(runs: &[&'r RunRecord]) -> Vec<(TraceOf, &'r RunRecord)> {
    let failure = runs.iter().copied().find(|r| !r.valid && r.moving.is_some());
    let clean: Vec<(&RunRecord, f64)> =
        runs.iter().filter(|r| r.valid).filter_map(|r| r.length.map(|t| (*r, t))).collect();
    let times: Vec<f64> = clean.iter().map(|(_, t)| *t).collect();
    let middle = quantile(&times, 0.5)
        .and_then(|median| clean.iter().min_by(|(_, a), (_, b)| (a - median).abs().total_cmp(&(b - median).abs())));
    let failure = failure.map(|run| (TraceOf::FirstFailure, run));
    failure.into_iter().chain(middle.map(|(run, _)| (TraceOf::Median, *run))).collect()
}

/// Positions to the millimetre: no picture shows more.
fn rounded(mut trace: Trace) -> Trace {
    let millimetres = |x: f64| (x * 1e3).round() / 1e3;
    trace.frames.iter_mut().flatten().for_each(|p| *p = p.map(millimetres));
    trace
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_failure_and_the_middle_of_the_clean_runs() {
        let run = |repeat: u32, clean: Option<f64>| {
            let mut run = RunRecord::empty("s", "a", repeat, 0);
            let (metrics, compute) = (strategy::Metrics::default(), strategy::Compute::default());
            run.moving = Some(crate::results::Moving { metrics, compute, robots: Vec::new() });
            (run.valid, run.length) = (clean.is_some(), clean);
            run
        };
        let of = |runs: &[RunRecord]| -> Vec<(TraceOf, u32)> {
            typical(&runs.iter().collect::<Vec<_>>()).iter().map(|(of, run)| (*of, run.repeat)).collect()
        };
        let runs = [run(0, Some(9.0)), run(1, None), run(2, Some(4.0)), run(3, None), run(4, Some(5.0))];
        assert_eq!(of(&runs), [(TraceOf::FirstFailure, 1), (TraceOf::Median, 4)]);
        assert_eq!(of(&runs[2..3]), [(TraceOf::Median, 2)]);
        let mut broken = run(0, None);
        broken.moving = None;
        assert_eq!(of(&[broken]), [], "nothing moved");
    }
}
