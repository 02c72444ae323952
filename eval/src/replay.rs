//! Watches some runs again, untimed, for the pictures of what planners did.
//!
//! A planner shows its state after every iteration, and only the last frame is wanted; copying
//! each would cost as much as the frames are long (quadratic for a growing tree). So a run is
//! replayed twice with its seed: first frames with a state are counted, stage by stage, then the
//! last one of each is copied. Count budgets make both replays the run again; a run that had a
//! deadline is replayed with its recorded iterations instead.

mod moving;

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use planner_api::{Budget, Frame, Observer, Plan, PopulationView, Run, View};

use crate::campaign::{Arena, Campaign};
use crate::config::PlannerEntry;
use crate::report::FULL;
use crate::results::{RunRecord, RunStatus, Subject};
use crate::snapshot::{MOST_GENERATIONS, Ruler, Snapshot, has_state, state};
use crate::statistics::quantile;

pub use moving::traces;

/// Snapshots of every planner in the scenes that reports show in full, in the order of scenes
/// and planners. `runs` are the campaign's, sorted by repeat within scene and planner.
pub fn snapshots(campaign: &Campaign, runs: &[RunRecord]) -> Vec<Snapshot> {
    let mut all = Vec::new();
    if campaign.comparison.subject != Subject::Paths {
        return all;
    }
    for arena in campaign.arenas.iter().take(FULL) {
        for entry in &campaign.comparison.planners {
            let of: Vec<&RunRecord> =
                runs.iter().filter(|r| r.scene == arena.scene.name && r.planner == entry.label).collect();
            // What ended its own process would end this one too.
            if let Some(run) = typical(&of).filter(|run| !run.status.is_killed()) {
                all.extend(of_run(entry, arena, run));
            }
        }
    }
    all
}

/// The run whose length is nearest to the median of the valid ones (the earliest of several);
/// without valid runs the first that did not end its process: here it would end the bench.
fn typical<'r>(runs: &[&'r RunRecord]) -> Option<&'r RunRecord> {
    use RunStatus::{Crashed, OutOfMemory, Timeout};
    let valid: Vec<(&RunRecord, f64)> =
        runs.iter().filter(|r| r.valid).filter_map(|r| r.length.map(|l| (*r, l))).collect();
    let lengths: Vec<f64> = valid.iter().map(|(_, length)| *length).collect();
    let Some(median) = quantile(&lengths, 0.5) else {
        let fatal = |run: &RunRecord| matches!(run.status, Crashed | Timeout | OutOfMemory);
        return runs.iter().copied().find(|run| !fatal(run));
    };
    valid.into_iter().min_by(|(_, a), (_, b)| (a - median).abs().total_cmp(&(b - median).abs())).map(|(run, _)| run)
}

/// The last state of each stage of `run`; empty where the planner shows none, or panics.
pub fn of_run(entry: &PlannerEntry, arena: &Arena, run: &RunRecord) -> Vec<Snapshot> {
    let mut watcher = Watcher { ruler: Ruler::new(&arena.scene), stages: Vec::new(), copying: false };
    if !watcher.ruler.step.is_normal() {
        return Vec::new(); // a scene of a size beyond all measure
    }
    let counted = replay(entry, arena, run, &mut watcher);
    if counted.is_none() || watcher.stages.is_empty() {
        return Vec::new();
    }
    watcher.copying = true;
    let faithful = replay(entry, arena, run, &mut watcher) == Some(true);
    let ruler = watcher.ruler;
    let snapshot = |stage: Stage| {
        let (iteration, evaluations, state) = stage.last?;
        Some(Snapshot {
            scene: run.scene.clone(),
            planner: run.planner.clone(),
            repeat: run.repeat,
            seed: run.seed,
            stage: stage.name.to_owned(),
            iteration,
            evaluations,
            faithful,
            ruler,
            state,
            generations: thinned(stage.generations),
        })
    };
    watcher.stages.into_iter().filter_map(snapshot).collect()
}

/// Whether the replay returned the run's path; `None` where it failed.
fn replay(entry: &PlannerEntry, arena: &Arena, record: &RunRecord, watcher: &mut Watcher) -> Option<bool> {
    let problem = arena.problem().ok()?;
    let spec = &entry.budget;
    let iterations = if spec.time_ms.is_some() { Some(record.iterations) } else { spec.iterations };
    let budget = Budget { iterations, evaluations: spec.evaluations, deadline: None };
    let mut plan = Plan::new();
    let mut planner = entry.instance()?;
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let mut run = Run::new(record.seed).with_budget(budget).with_observer(watcher);
        planner.plan_into(&problem, &mut run, &mut plan)
    }));
    outcome.ok()?.ok()?;
    Some(plan.path == record.path)
}

struct Watcher {
    ruler: Ruler,
    stages: Vec<Stage>,
    /// In the second replay.
    copying: bool,
}

struct Stage {
    name: &'static str,
    /// Frames with a state, in the first replay; those still to come, in the second.
    frames: u64,
    last: Option<(u64, u64, crate::snapshot::State)>,
    generations: Vec<(u64, f64, f64)>,
}

impl Observer for Watcher {
    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
        if !has_state(&frame.view) {
            return ControlFlow::Continue(());
        }
        let place = self.stages.iter().position(|s| s.name == frame.stage);
        if self.copying {
            if let Some(stage) = place.map(|i| &mut self.stages[i]) {
                stage.frames = stage.frames.saturating_sub(1);
                if stage.frames == 0 {
                    let state = state(frame, &self.ruler);
                    stage.last = state.map(|state| (frame.iteration, frame.evaluations, state));
                }
            }
            return ControlFlow::Continue(());
        }
        let place = place.unwrap_or_else(|| {
            self.stages.push(Stage { name: frame.stage, frames: 0, last: None, generations: Vec::new() });
            self.stages.len() - 1
        });
        let stage = &mut self.stages[place];
        stage.frames += 1;
        if let View::Population(view) = frame.view {
            stage.generations.extend(fitness(&view).map(|(best, mean)| (frame.iteration, best, mean)));
        }
        ControlFlow::Continue(())
    }
}

/// Best and mean fitness of the individuals whose fitness is a number.
fn fitness(view: &PopulationView<'_>) -> Option<(f64, f64)> {
    let finite = || view.fitness.iter().copied().filter(|f| f.is_finite());
    let (count, sum, best) = finite().fold((0_u32, 0.0, f64::NEG_INFINITY), |(n, s, b), f| (n + 1, s + f, f.max(b)));
    let mean = sum / f64::from(count);
    (count > 0 && mean.is_finite()).then_some((best, mean))
}

/// Every k-th entry of a long history, and the last.
fn thinned(history: Vec<(u64, f64, f64)>) -> Vec<(u64, f64, f64)> {
    let (step, last) = (history.len().div_ceil(MOST_GENERATIONS).max(1), history.len().wrapping_sub(1));
    history.into_iter().enumerate().filter(|(i, _)| i % step == 0 || *i == last).map(|(_, entry)| entry).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::BudgetSpec;
    use crate::snapshot::State;
    use crate::testing::{campaign, climber, detour, entry, panic_on_odd, runs_of};

    #[test]
    fn the_typical_run_is_the_valid_one_nearest_the_median() {
        let campaign = campaign(vec![entry("detour", detour)]);
        let mut runs = runs_of(&campaign);
        for (run, length) in runs.iter_mut().zip([5.0, 1.0, 9.0, 4.0, 2.0]) {
            run.length = Some(length);
        }
        let of: Vec<&RunRecord> = runs.iter().take(5).collect();
        assert_eq!(typical(&of).map(|r| r.repeat), Some(3), "1 2 4 5 9");
        for run in &mut runs {
            run.valid = run.repeat == 2;
        }
        let of: Vec<&RunRecord> = runs.iter().take(5).collect();
        assert_eq!(typical(&of).map(|r| r.repeat), Some(2));
        runs.iter_mut().for_each(|r| r.valid = false);
        let of: Vec<&RunRecord> = runs.iter().take(5).collect();
        assert_eq!(typical(&of).map(|r| r.repeat), Some(0), "the first");
        assert!(typical(&[]).is_none());
    }

    #[test]
    fn the_last_state_of_each_stage_is_kept() {
        let campaign = campaign(vec![climber(BudgetSpec::default()), entry("plain", detour)]);
        let runs = runs_of(&campaign);
        let snapshots = snapshots(&campaign, &runs);
        // Two scenes; the climber shows a population, then a tree; the other planner shows no state.
        let shown: Vec<(&str, &str, u64)> =
            snapshots.iter().map(|s| (s.scene.as_str(), s.stage.as_str(), s.iteration)).collect();
        let expected =
            [("b-scene", "climb", 10), ("b-scene", "grow", 12), ("a-scene", "climb", 10), ("a-scene", "grow", 12)];
        assert_eq!(shown, expected);
        assert!(snapshots.iter().all(|s| s.faithful && s.planner == "climber"));
        let run = runs.iter().find(|r| r.scene == "b-scene" && r.repeat == snapshots[0].repeat).unwrap();
        assert_eq!((run.seed, run.iterations), (snapshots[0].seed, 12));
        // Fitness k, k/2 and NaN in generation k: the NaN counts for nothing.
        let expected: Vec<_> = (0..=10).map(|k| (k, k as f64, 0.75 * k as f64)).collect();
        assert_eq!(snapshots[0].generations, expected);
        let State::Population { paths, total, .. } = &snapshots[0].state else { panic!("{:?}", snapshots[0].state) };
        assert_eq!((paths.len(), *total), (3, 3));
        let State::Trees(trees) = &snapshots[1].state else { panic!("{:?}", snapshots[1].state) };
        assert_eq!(trees[0].nodes.len(), 13, "a node an iteration, the root first");
        assert_eq!(snapshots[1].generations, []);
    }

    #[test]
    fn a_deadline_becomes_the_recorded_iterations() {
        let spec = BudgetSpec { time_ms: Some(60_000.0), ..BudgetSpec::default() };
        let campaign = campaign(vec![climber(spec)]);
        let mut runs = runs_of(&campaign);
        // As if the deadline had come after four iterations.
        runs.iter_mut().for_each(|r| r.iterations = 4);
        let stopped = snapshots(&campaign, &runs);
        assert_eq!(stopped.iter().map(|s| (s.stage.as_str(), s.iteration)).collect::<Vec<_>>(), [("climb", 4); 2]);
        runs.iter_mut().for_each(|r| r.path.truncate(1));
        assert!(snapshots(&campaign, &runs).iter().all(|s| !s.faithful), "another path than the record's");
    }

    #[test]
    fn planners_that_panic_have_no_picture() {
        let campaign = campaign(vec![entry("panic", panic_on_odd)]);
        assert_eq!(snapshots(&campaign, &runs_of(&campaign)), []);
    }

    #[test]
    fn long_histories_are_thinned_to_their_end() {
        let history = |n: u64| (0..n).map(|k| (k, 0.0, 0.0)).collect::<Vec<_>>();
        assert_eq!(thinned(history(500)).len(), 500);
        let thin: Vec<u64> = thinned(history(1202)).into_iter().map(|g| g.0).collect();
        assert_eq!((thin.len(), thin[1], thin[thin.len() - 1]), (402, 3, 1201));
        assert_eq!(thinned(Vec::new()), []);
    }
}
