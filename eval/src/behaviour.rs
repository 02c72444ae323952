//! Makes the runs of the experiment with behaviour control: tunes parameters where that is asked for, on the training
//! scenarios of the run's seed, and judges them on its held-out ones.

use std::time::Instant;

use cpu_time::ThreadTime;
use planner_api::{Run, SettingError};
use planner_behaviour::{Parameters, Protocol, Set, fitness, tune};

use crate::campaign::micros;
use crate::config::{Maker, PlannerEntry};
use crate::results::{GenerationRecord, RunRecord, RunStatus, TuningRun};

/// The run of `entry` with `seed`; its time is that of search and judgement.
pub fn run(entry: &PlannerEntry, scene: &str, protocol: &Protocol, seed: u64) -> RunRecord {
    let mut run = RunRecord::empty(scene, &entry.label, 0, seed);
    let (cpu, began) = (ThreadTime::now(), Instant::now());
    let outcome = judged(entry, protocol, &mut run);
    run.time_us = micros(began);
    run.cpu_us = cpu.elapsed().as_nanos() as f64 / 1000.0;
    match outcome {
        Ok(tuning) => {
            run.valid = true;
            run.length = Some(1.0 - tuning.held_out);
            run.tuning = Some(tuning);
        }
        Err(e) => (run.status, run.error) = (RunStatus::Error, Some(e.to_string())),
    }
    run
}

/// Searches and judges; work and status go into `record`.
fn judged(entry: &PlannerEntry, protocol: &Protocol, record: &mut RunRecord) -> Result<TuningRun, SettingError> {
    record.status = RunStatus::Solved;
    let (generations, parameters) = match &entry.maker {
        Maker::Parameters(parameters) => (Vec::new(), *parameters),
        Maker::Tuning(tuning) => {
            let mut run = Run::new(record.seed).with_budget(entry.budget.begin());
            let tuned = tune(protocol, tuning, &mut run)?;
            // Generation 0 is drawn, not bred.
            if (tuned.generations.len() as u64) <= tuning.generations {
                record.status = RunStatus::BudgetSpent;
            }
            (record.iterations, record.evaluations) = (run.spent.iterations, tuned.evaluations);
            let of = |g: &planner_behaviour::Generation| GenerationRecord { max: g.maximum, mean: g.mean };
            (tuned.generations.iter().map(of).collect(), tuned.parameters)
        }
        _ => (Vec::new(), Parameters::default()),
    };
    let held_out = fitness(protocol, &parameters, Set::HeldOut, record.seed)?;
    Ok(TuningRun {
        training: generations.last().map(|g| g.max),
        generations,
        parameters: parameters.named().map(|(name, value)| (name.to_owned(), value)).to_vec(),
        held_out: held_out.mean,
        each: held_out.each,
        arrived: held_out.arrived,
        collided: held_out.collided,
    })
}
