//! Makes the runs of a campaign, fairly.
//!
//! The unit of work is (scene, repeat): every planner runs in it once, with the
//! same seed, in an order shuffled for that unit ([`seeds::turn_order`]). Each
//! planner is reset before each run and has one warm-up in each scene (and on
//! each thread), which does not count. The timed call is `plan_into` alone.
//! Judging and storing come after the clock has stopped. Every thread has its
//! own planners, here or in processes of their own ([`Seat`]), so results but for
//! times depend neither on the number of jobs nor on isolation. Processes are
//! kept, up to a bound; those that were not asked for the longest time end first.

use std::any::Any;
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

use cpu_time::ThreadTime;
use planner_api::{Plan, Planner, Problem, Run, Status};

use crate::campaign::{Arena, Campaign, micros};
use crate::config::BudgetSpec;
use crate::error::Error;
use crate::recorder::Recorder;
use crate::results::{RunRecord, RunStatus, Subject};
use crate::verdict::{Fault, Judge};
use crate::work::Work;
use crate::worker::Seat;
use crate::{behaviour, metrics, seeds, simulate};

/// How many processes the bench keeps, all threads together: each holds three descriptors, of which many systems
/// allow 1024 by default.
const PROCESSES: usize = 256;
/// How many of them one thread keeps.
const PROCESSES_OF_A_THREAD: usize = 32;

/// Makes the runs of `work` and hands each to `sink` on the calling thread, in no particular order. `optima` are the
/// scenes' optimal lengths.
///
/// # Errors
/// Ends early with the sink's error, and when the bench has no means to start a process or thread.
pub fn run(
    campaign: &Campaign,
    optima: &[Option<f64>],
    work: &Work,
    mut sink: impl FnMut(RunRecord) -> Result<(), Error>,
) -> Result<(), Error> {
    let units: Vec<(usize, u32)> = work.shard.units(campaign.arenas.len(), campaign.comparison.repeats).collect();
    if work.jobs == 1 {
        let mut worker = Worker::new(campaign, optima, work);
        return units.iter().try_for_each(|(scene, repeat)| worker.unit(*scene, *repeat, &mut |run| sink(run?)));
    }
    let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
    std::thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..work.jobs.min(units.len()) {
            let (sender, next, stop, units) = (sender.clone(), &next, &stop, &units);
            let work_on = move || {
                let mut worker = Worker::new(campaign, optima, work);
                while !stop.load(Ordering::Relaxed) {
                    // Nothing comes after an error.
                    let mut send = |run: Result<_, _>| {
                        let last = run.is_err();
                        sender.send(run).ok().filter(|()| !last).ok_or(())
                    };
                    let Some((scene, repeat)) = units.get(next.fetch_add(1, Ordering::Relaxed)) else { break };
                    if worker.unit(*scene, *repeat, &mut send).is_err() {
                        break;
                    }
                }
            };
            if let Err(source) = std::thread::Builder::new().spawn_scoped(scope, work_on) {
                stop.store(true, Ordering::Relaxed);
                return Err(Error::Start { what: format!("{} threads", work.jobs), source });
            }
        }
        drop(sender);
        let outcome = receiver.iter().try_for_each(|run| sink(run?));
        stop.store(true, Ordering::Relaxed);
        outcome
    })
}

/// One thread's planners.
struct Worker<'c> {
    campaign: &'c Campaign,
    optima: &'c [Option<f64>],
    work: &'c Work,
    seats: Vec<Seat<'c>>,
    /// Seats with a process, the one that was asked last at the end.
    alive: VecDeque<usize>,
}

impl<'c> Worker<'c> {
    fn new(campaign: &'c Campaign, optima: &'c [Option<f64>], work: &'c Work) -> Self {
        // What moves has no seat: it is built anew for every run.
        let still = campaign.comparison.subject == Subject::Paths;
        let planners = campaign.comparison.planners.iter().filter(|_| still);
        let seats = planners.map(|entry| Seat::new(entry, work.isolate)).collect();
        Self { campaign, optima, work, seats, alive: VecDeque::new() }
    }

    /// Makes the runs that are missing of one unit. The `sink` fails on an error.
    fn unit<E>(
        &mut self,
        scene: usize,
        repeat: u32,
        sink: &mut impl FnMut(Result<RunRecord, Error>) -> Result<(), E>,
    ) -> Result<(), E> {
        let comparison = &self.campaign.comparison;
        let arena = &self.campaign.arenas[scene];
        let seed = seeds::run_seed(comparison.seed, &arena.scene.name, repeat);
        let order = seeds::turn_order(comparison.seed, &arena.scene.name, repeat, comparison.planners.len());
        let judge = Judge::new(&arena.scene);
        for index in order {
            if self.work.done.contains(&(scene, index, repeat)) {
                continue;
            }
            let (entry, name) = (&comparison.planners[index], &arena.scene.name);
            let run = match (&arena.simulation, &comparison.protocol) {
                (Some(settings), _) => Ok(simulate::run(entry, name, settings, seed).0),
                (None, Some(protocol)) => Ok(behaviour::run(entry, name, protocol, seed)),
                (None, None) => {
                    self.make_room(index);
                    let run = self.seats[index].run(scene, arena, seed);
                    run.map(|run| judged(run, &judge, self.optima[scene]))
                }
            };
            sink(run.map(|run| RunRecord { repeat, ..run }))?;
        }
        Ok(())
    }

    /// Ends processes until another may start, and remembers that it is the turn of seat `index`.
    fn make_room(&mut self, index: usize) {
        if self.seats[index].is_apart() {
            let most = (PROCESSES / self.work.jobs).clamp(1, PROCESSES_OF_A_THREAD);
            self.alive.retain(|seat| *seat != index);
            while self.alive.len() >= most
                && let Some(seat) = self.alive.pop_front()
            {
                self.seats[seat].rest();
            }
            self.alive.push_back(index);
        }
    }
}

/// Resets `planner` and times one call. Also says whether the planner panicked. The record is not
/// judged yet: see [`judged`]. Its path is empty where the planner has none.
pub fn run_once(
    planner: &mut dyn Planner,
    label: &str,
    budget: &BudgetSpec,
    arena: &Arena,
    seed: u64,
    plan: &mut Plan,
    recorder: &mut Recorder,
) -> (RunRecord, bool) {
    let mut record = RunRecord::empty(&arena.scene.name, label, 0, seed);
    let problem: Problem<'_> = match arena.problem() {
        Ok(problem) => problem,
        Err(e) => {
            record.error = Some(e.to_string());
            return (record, false);
        }
    };
    plan.clear();
    let cpu_began = ThreadTime::now();
    let began = recorder.begin();
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        planner.reset();
        // The clocks begin again: resetting is not planning.
        let (cpu_began, began) = (ThreadTime::now(), recorder.begin());
        let mut run = Run::new(seed).with_budget(budget.begin()).with_observer(recorder);
        let status = planner.plan_into(&problem, &mut run, plan);
        (status, micros(began), cpu_began.elapsed())
    }));
    let (status, time_us, cpu) = match outcome {
        Ok(outcome) => outcome,
        Err(panic) => {
            record.error = Some(panicked(panic.as_ref()));
            record.time_us = micros(began);
            record.cpu_us = cpu_began.elapsed().as_nanos() as f64 / 1000.0;
            return (record, true);
        }
    };
    record.time_us = time_us;
    record.cpu_us = cpu.as_nanos() as f64 / 1000.0;
    record.iterations = plan.counters.iterations;
    record.evaluations = plan.counters.evaluations;
    record.collision_checks = plan.counters.collision_checks;
    record.progress = recorder.improvements().to_vec();
    match status {
        Ok(status) => {
            record.status = match status {
                Status::Solved => RunStatus::Solved,
                Status::BudgetSpent => RunStatus::BudgetSpent,
                Status::NotFound => RunStatus::NotFound,
                Status::Infeasible => RunStatus::Infeasible,
            };
            match plan.path.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
                None => record.path.clone_from(&plan.path),
                // Such a path cannot be sent, stored, measured or drawn.
                Some(point) => {
                    record.status = RunStatus::Error;
                    record.error = Some(Fault::NotFinite { point }.to_string());
                }
            }
            record.cost = Some(plan.cost).filter(|cost| cost.is_finite());
            let finite = plan.terms.iter().filter(|(_, value)| value.is_finite());
            record.terms = finite.map(|(name, value)| ((*name).to_owned(), *value)).collect();
        }
        Err(e) => record.error = Some(e.to_string()),
    }
    (record, false)
}

/// What is told of a planner that panicked.
pub fn panicked(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    format!("the planner panicked: {}", text.unwrap_or("without a message"))
}

/// The record with the judge's verdict and all metrics.
pub fn judged(mut record: RunRecord, judge: &Judge<'_>, optimum: Option<f64>) -> RunRecord {
    let verdict = judge.verdict(&record.path);
    record.valid = verdict.is_ok();
    if let Err(fault @ (Fault::WrongStart(_) | Fault::WrongGoal(_))) = verdict {
        record.status = RunStatus::Error;
        record.error = Some(fault.to_string());
    }
    if record.path.len() >= 2 {
        let length = metrics::length(&record.path);
        record.length = length.is_finite().then_some(length);
        record.turning = Some(metrics::turning(&record.path)).filter(|t| t.is_finite());
        record.clearance_min = judge.clearance(&record.path).filter(|c| c.is_finite());
        if record.valid
            && let (Some(length), Some(optimum)) = (record.length, optimum)
        {
            record.gap = Some(metrics::gap(length, optimum));
        }
    }
    record
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{
        campaign, detour, entry, not_finite, nothing, panic_on_odd, refusal, short_of_goal, straight,
    };

    fn runs(jobs: usize) -> Vec<RunRecord> {
        let planners = vec![
            entry("straight", straight),
            entry("detour", detour),
            entry("nothing", nothing),
            entry("refusal", refusal),
            entry("panic", panic_on_odd),
            entry("nan", not_finite),
            entry("short", short_of_goal),
        ];
        let campaign = campaign(planners);
        let mut runs = Vec::new();
        run(&campaign, &[Some(10.0), None], &Work::all(jobs), |r| {
            runs.push(r);
            Ok(())
        })
        .unwrap();
        runs.sort_by(|a, b| (&a.scene, &a.planner, a.repeat).cmp(&(&b.scene, &b.planner, b.repeat)));
        runs
    }

    #[test]
    fn every_way_to_end_becomes_a_row() {
        let runs = runs(1);
        assert_eq!(runs.len(), 2 * 7 * 5, "nothing is dropped");
        let of = |planner: &'static str| runs.iter().filter(move |r| r.planner == planner);
        assert!(of("straight").all(|r| r.status == RunStatus::Solved && !r.valid && r.length == Some(10.0)));
        assert!(of("straight").all(|r| r.clearance_min == Some(-1.0) && r.turning == Some(0.0) && r.gap.is_none()));
        assert!(of("detour").all(|r| r.status == RunStatus::BudgetSpent && r.valid && r.error.is_none()));
        for r in of("detour") {
            let gap = (r.scene == "b-scene").then(|| r.length.unwrap() / 10.0 - 1.0);
            assert_eq!(r.gap, gap, "only where the optimum is known");
            let curve: Vec<_> = r.progress.iter().map(|p| (p.evaluations, p.cost)).collect();
            assert_eq!(curve, [(2, 9.0), (4, 8.5)], "improvements alone");
            assert_eq!((r.iterations, r.evaluations), (1, 4), "reset before each run");
        }
        assert!(of("nothing").all(|r| r.status == RunStatus::NotFound && r.length.is_none() && r.turning.is_none()));
        assert!(of("refusal").all(|r| r.status == RunStatus::Error && r.error.as_deref() == Some("no, \"thanks\"")));
        for r in of("panic") {
            let odd = r.seed % 2 == 1;
            assert_eq!(r.status == RunStatus::Error, odd);
            assert_eq!(r.error.clone(), odd.then(|| format!("the planner panicked: seed {} is odd", r.seed)));
            assert_eq!(r.valid, !odd, "and the next run is none the worse for it");
        }
        assert!(of("panic").any(|r| r.valid) && of("panic").any(|r| !r.valid), "both happened");
        assert!(of("nan").all(|r| r.status == RunStatus::Error && r.path.is_empty() && r.length.is_none()));
        assert!(of("short").all(|r| r.status == RunStatus::Error));
        assert!(of("short").all(|r| !r.valid && r.error.as_deref().is_some_and(|e| e.contains("not at the goal"))));
        let seeds = |planner| of(planner).map(|r| r.seed).collect::<Vec<_>>();
        assert_eq!(seeds("straight"), seeds("nan"), "paired");
    }

    #[test]
    fn jobs_change_nothing_but_times() {
        let timeless = |jobs| {
            let mut runs = runs(jobs);
            for r in &mut runs {
                (r.time_us, r.cpu_us) = (0.0, 0.0);
                r.progress.iter_mut().for_each(|p| p.time_us = 0.0);
            }
            runs
        };
        assert_eq!(timeless(1), timeless(3));
    }

    #[test]
    fn a_deadline_counts_from_the_call() {
        let mut patient = entry("patient", nothing);
        patient.budget.time_ms = Some(5.0);
        patient.maker = crate::config::Maker::Catalogue(Box::new(|| Box::new(crate::testing::Patient)));
        let mut times = Vec::new();
        run(&campaign(vec![patient]), &[None, None], &Work::all(1), |r| {
            assert_eq!(r.status, RunStatus::BudgetSpent);
            times.push(r.time_us);
            Ok(())
        })
        .unwrap();
        // The clock starts a moment before the deadline is set, so a run lasts at least the budget; the
        // other bound is far away because a loaded machine may stop the thread for a while.
        assert!(times.iter().all(|t| (5e3..1e6).contains(t)), "{times:?}");
    }

    #[test]
    fn a_sink_that_fails_ends_the_campaign() {
        for jobs in [1, 2] {
            let mut seen = 0;
            let outcome = run(&campaign(vec![entry("detour", detour)]), &[None, None], &Work::all(jobs), |_| {
                seen += 1;
                if seen == 3 { Err(Error::Usage("disk full".to_owned())) } else { Ok(()) }
            });
            assert_eq!((outcome.unwrap_err().to_string(), seen), ("disk full".to_owned(), 3));
        }
    }
}
