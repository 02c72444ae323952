//! Where a planner of a campaign runs, for one thread.

use std::ffi::OsString;
use std::path::Path;
use std::time::Duration;

use planner_api::{Plan, Planner};
use serde_json::value::RawValue;

use super::process::{Bounds, Failure, Process, Trouble};
use super::protocol::{Answer, EXPECTED, Request, VERSION};
use super::tether;
use crate::campaign::{Arena, micros};
use crate::config::{Maker, PlannerEntry};
use crate::error::Error;
use crate::json;
use crate::recorder::Recorder;
use crate::results::{RunRecord, RunStatus};
use crate::runner;

/// What the first request to a new process of an external planner may take on top of its hard limit: interpreters and
/// their libraries load slowly on a cold or busy machine.
const START: Duration = Duration::from_secs(60);

/// A planner's place: in this process, or in one of its own that is started when it is needed and again after it died.
///
/// Planners of the catalogue have one warm-up in each scene. An external planner has its first request twice, so
/// that its start is not timed, and no other warm-up. Neither counts, unless the process fails in it: that is the
/// run's result then.
pub struct Seat<'c> {
    entry: &'c PlannerEntry,
    place: Place,
    /// The scene in which the planner is warm.
    warm: Option<usize>,
}

enum Place {
    Here(Box<Here>),
    Apart(Box<Apart>),
}

/// A planner with buffers of its own.
struct Here {
    planner: Box<dyn Planner>,
    plan: Plan,
    recorder: Recorder,
}

/// A planner in a process, if that runs.
struct Apart {
    process: Option<Process>,
    settings: Box<RawValue>,
    /// The scene that was asked for last, and its JSON.
    scene: Option<(usize, Box<RawValue>)>,
    last_id: u64,
}

impl<'c> Seat<'c> {
    /// A seat in this process, unless `isolate` or the planner itself demand one apart.
    pub fn new(entry: &'c PlannerEntry, isolate: bool) -> Self {
        let place = match entry.instance().filter(|_| !isolate && !entry.isolated()) {
            Some(planner) => Place::Here(Box::new(Here { planner, plan: Plan::new(), recorder: Recorder::new() })),
            None => {
                let settings = raw(&json::from_toml(&toml::Value::Table(entry.settings.clone())));
                Place::Apart(Box::new(Apart { process: None, settings, scene: None, last_id: 0 }))
            }
        };
        Self { entry, place, warm: None }
    }

    /// Whether its runs are made in a process of its own.
    pub fn is_apart(&self) -> bool {
        matches!(self.place, Place::Apart(_))
    }

    /// Ends its process, if it has one. The next run starts another and warms it up.
    pub fn rest(&mut self) {
        if let Place::Apart(apart) = &mut self.place {
            apart.process = None;
            self.warm = None;
        }
    }

    /// Makes one run in `arena`, which is scene number `scene`; not judged yet.
    ///
    /// # Errors
    /// When a process cannot be started for want of the bench's own means, which is no fault of the planner.
    pub fn run(&mut self, scene: usize, arena: &Arena, seed: u64) -> Result<RunRecord, Error> {
        if !self.is_warm(scene) {
            self.warm = Some(scene);
            let record = self.once(scene, arena, seed)?;
            if self.warm.is_none() {
                return Ok(record);
            }
        }
        self.once(scene, arena, seed)
    }

    fn is_warm(&self, scene: usize) -> bool {
        match self.entry.maker {
            Maker::External(_) => self.warm.is_some(),
            _ => self.warm == Some(scene),
        }
    }

    fn once(&mut self, scene: usize, arena: &Arena, seed: u64) -> Result<RunRecord, Error> {
        let entry = self.entry;
        match &mut self.place {
            Place::Here(here) => {
                let Here { planner, plan, recorder } = here.as_mut();
                let (record, broken) =
                    runner::run_once(planner.as_mut(), &entry.label, &entry.budget, arena, seed, plan, recorder);
                if broken && let Some(fresh) = entry.instance() {
                    // Its state is anyone's guess.
                    *planner = fresh;
                }
                Ok(record)
            }
            Place::Apart(apart) => {
                let mut record = RunRecord::empty(&arena.scene.name, &entry.label, 0, seed);
                match apart.ask(entry, scene, arena, &mut record) {
                    Ok(()) => return Ok(record),
                    Err(Trouble::Planner(failure)) => {
                        (record.status, record.error) = (failure.status, Some(failure.error));
                        record.time_us = failure.time_us;
                    }
                    Err(Trouble::Bench(source)) => return Err(Error::Start { what: command(entry), source }),
                }
                self.rest();
                Ok(record)
            }
        }
    }
}

impl Apart {
    /// Has the run that `record` names made, and writes into it what comes of it.
    fn ask(
        &mut self,
        entry: &PlannerEntry,
        scene: usize,
        arena: &Arena,
        record: &mut RunRecord,
    ) -> Result<(), Trouble> {
        let external = matches!(entry.maker, Maker::External(_));
        let start = if external && self.process.is_none() { START } else { Duration::ZERO };
        let bounds = Bounds { time: entry.hard_limit(), start, memory_mb: entry.limits.memory_mb };
        if bounds.memory_mb.is_some() && !cfg!(target_os = "linux") {
            let error = "memory_mb: only Linux tells how much memory a process holds".to_owned();
            return Err(Failure { status: RunStatus::Error, error, time_us: 0.0 }.into());
        }
        let process = match &mut self.process {
            Some(process) => process,
            None => self.process.insert(begin(entry)?),
        };
        let began = std::time::Instant::now();
        if self.scene.as_ref().is_none_or(|(known, _)| *known != scene) {
            self.scene = Some((scene, raw(&arena.scene)));
        }
        let Some((_, text)) = &self.scene else { unreachable!("set above") };
        self.last_id += 1;
        let request = Request {
            protocol: VERSION,
            id: self.last_id,
            kind: (!external).then(|| entry.kind.clone()),
            scene: text,
            settings: Some(&self.settings),
            seed: record.seed,
            budget: entry.budget,
        };
        let mut line = serde_json::to_vec(&request).expect("finite numbers and text");
        line.push(b'\n');
        let (line, round_trip) = process.ask(line, bounds)?;
        let answer = Answer::read(&line, self.last_id);
        let answer = if external { answer.and_then(|answer| answer.vetted(round_trip)) } else { answer };
        let answer = answer.map_err(|fault| Failure {
            status: RunStatus::Error,
            error: format!("{fault}; expected {EXPECTED}; it said {}", beginning(&line)),
            time_us: round_trip,
        })?;
        answer.tell(record);
        if external {
            record.time_us = round_trip;
        } else {
            record.overhead_us = Some(micros(began) - record.time_us);
        }
        Ok(())
    }
}

fn begin(entry: &PlannerEntry) -> Result<Process, Trouble> {
    let process = match &entry.maker {
        Maker::External(external) => {
            let (program, arguments) = external.command.split_first().expect("checked when it was read");
            Process::start(program, arguments, &external.folder)
        }
        _ => tether::own_program().and_then(|own| Process::start(own, &[OsString::from("worker")], Path::new("."))),
    };
    process.map_err(|e| match tether::is_shortage(&e) {
        true => Trouble::Bench(e),
        false => {
            let error = format!("cannot start {}: {e}", command(entry));
            Failure { status: RunStatus::Crashed, error, time_us: 0.0 }.into()
        }
    })
}

/// How its process is started, for messages.
fn command(entry: &PlannerEntry) -> String {
    match &entry.maker {
        Maker::External(external) => format!("{:?} in {}", external.command, external.folder.display()),
        _ => "touchline worker".to_owned(),
    }
}

fn raw(value: &impl serde::Serialize) -> Box<RawValue> {
    serde_json::value::to_raw_value(value).expect("plain data with string keys")
}

/// The first characters of what came, for messages.
fn beginning(line: &[u8]) -> String {
    const MOST: usize = 120;
    let text = String::from_utf8_lossy(&line[..line.len().min(4 * MOST)]);
    let text = text.trim();
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{:?} …", &text[..end]),
        None => format!("{text:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_came_is_shown_in_part() {
        assert_eq!(beginning(b" hello\x07 \n"), "\"hello\\u{7}\"");
        assert_eq!(beginning("é".repeat(500).as_bytes()), format!("\"{}\" …", "é".repeat(120)));
        assert_eq!(beginning(&[0xff, b'a']), "\"\u{fffd}a\"");
    }
}
