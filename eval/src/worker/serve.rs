//! `touchline worker`: answers the requests of a bench, or of any other program, until they end.

use std::io::{self, BufRead, Write};

use env_model::Scene;
use planner_api::{Plan, Planner};
use serde::Deserialize;
use serde_json::value::RawValue;

use super::protocol::{Answer, Request, VERSION};
use crate::campaign::Arena;
use crate::config;
use crate::recorder::Recorder;
use crate::runner;

/// Answers every line of `input` on `output`. A bad request is answered with what is wrong with it.
///
/// # Errors
/// Only when reading or writing fails.
pub fn serve(mut input: impl BufRead, mut output: impl Write) -> io::Result<()> {
    let mut worker = Worker::default();
    let mut line = Vec::new();
    while input.read_until(b'\n', &mut line)? > 0 {
        if !line.trim_ascii().is_empty() {
            let mut answer = serde_json::to_vec(&worker.answer(&line)).expect("finite numbers and text");
            answer.push(b'\n');
            output.write_all(&answer)?;
            output.flush()?;
        }
        line.clear();
    }
    Ok(())
}

/// What is kept between requests, so that those of one campaign find scene and planner ready.
#[derive(Default)]
struct Worker {
    scene: Option<(String, Arena)>,
    planner: Option<Ready>,
    plan: Plan,
    recorder: Recorder,
}

/// A planner and what it was built from.
struct Ready {
    kind: String,
    settings: String,
    planner: Box<dyn Planner>,
}

impl Worker {
    fn answer(&mut self, line: &[u8]) -> Answer {
        let request: Request<'_> = match serde_json::from_slice(line) {
            Ok(request) => request,
            Err(e) => {
                #[derive(Deserialize)]
                struct Numbered {
                    id: u64,
                }
                let id = serde_json::from_slice::<Numbered>(line).ok().map(|n| n.id);
                return Answer::refusal(id, format!("not a request: {e}"));
            }
        };
        let id = request.id;
        self.run(request).unwrap_or_else(|error| Answer::refusal(Some(id), error))
    }

    fn run(&mut self, request: Request<'_>) -> Result<Answer, String> {
        let Request { protocol, id, kind, scene, settings, seed, budget } = request;
        if protocol != VERSION {
            return Err(format!("protocol = {protocol}; expected {VERSION}"));
        }
        let kind = kind.ok_or("no kind; expected a planner of the catalogue")?;
        if self.scene.as_ref().is_none_or(|(text, _)| text != scene.get()) {
            self.scene = Some((scene.get().to_owned(), arena(scene.get())?));
        }
        let settings = settings.map_or("{}", RawValue::get);
        if self.planner.as_ref().is_none_or(|p| p.kind != kind || p.settings != settings) {
            let planner = planner(&kind, settings)?;
            self.planner = Some(Ready { kind, settings: settings.to_owned(), planner });
        }
        let (Some((_, arena)), Some(Ready { planner, .. })) = (&self.scene, &mut self.planner) else {
            unreachable!("both were made above")
        };
        let (run, broken) =
            runner::run_once(planner.as_mut(), "", &budget, arena, seed, &mut self.plan, &mut self.recorder);
        if broken {
            // Its state is anyone's guess.
            self.planner = None;
        }
        Ok(Answer::of_run(id, run))
    }
}

fn arena(scene: &str) -> Result<Arena, String> {
    let scene: Scene = serde_json::from_str(scene).map_err(|e| format!("scene: {e}"))?;
    config::refuse_motion(&scene).map_err(|e| format!("scene: {e}"))?;
    Arena::new(scene).map_err(|e| format!("scene: {e}"))
}

fn planner(kind: &str, settings: &str) -> Result<Box<dyn Planner>, String> {
    let table: toml::Table = serde_json::from_str(settings).map_err(|e| format!("settings: {e}"))?;
    config::from_settings(kind, &table.to_string()).map_err(|e| e.to_string())
}
