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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::RunRecord;

    const SCENE: &str = "name = \"odd \\\"names\\\" 球\"\nunit = \"cm\"\nrobot_radius = 0.1\nstart = [0.1, -0.0]
        goal = [10.000000000000002, 1e-17]\nfield = { min = [-1.0, -5.5], max = [11.0, 5.25] }
        [[obstacle]]\ndisc = { centre = [5.123456789012345, 0.1], radius = 0.30000000000000004 }\nlabel = \"7\"
        [[obstacle]]\ncapsule = { from = [2.0, 2.0], to = [3.0, 3.0], radius = 0.5 }\nvelocity = [0.0, 0.0]
        [[obstacle]]\npolygon = [[7.0, 2.0], [8.0, 2.0], [8.0, 3.3333333333333335]]\n";

    fn answers(requests: &str) -> Vec<Vec<u8>> {
        let mut output = Vec::new();
        serve(requests.as_bytes(), &mut output).unwrap();
        output.split_inclusive(|b| *b == b'\n').map(<[u8]>::to_vec).collect()
    }

    fn request(id: u64, kind: &str, scene: &str, rest: &str) -> String {
        format!("{{\"protocol\":1,\"id\":{id},\"kind\":\"{kind}\",\"scene\":{scene},\"seed\":7{rest}}}\n")
    }

    #[test]
    fn runs_are_those_of_the_bench_bit_for_bit() {
        let scene = Scene::from_toml("scene.toml", SCENE).unwrap();
        let json = serde_json::to_string(&scene).unwrap();
        assert_eq!(serde_json::from_str::<Scene>(&json).unwrap().to_toml(), scene.to_toml());
        let rest = ",\"settings\":{\"particles\":5},\"budget\":{\"evaluations\":100}";
        let text = [request(1, "pso", &json, rest), request(2, "tangent", &json, ""), request(3, "pso", &json, rest)];
        let entry = config::single("settings", "pso", "particles = 5\nbudget = { evaluations = 100 }").unwrap();
        let arena = Arena::new(scene).unwrap();
        let (mut plan, mut recorder) = (Plan::new(), Recorder::new());
        let mut planner = entry.instance().unwrap();
        let (here, _) = runner::run_once(planner.as_mut(), "", &entry.budget, &arena, 7, &mut plan, &mut recorder);
        let timeless = |mut run: RunRecord| {
            (run.time_us, run.cpu_us, run.scene) = (0.0, 0.0, String::new());
            run.progress.iter_mut().for_each(|p| p.time_us = 0.0);
            run
        };
        let answers = answers(&text.concat());
        assert!(here.path.len() > 2 && answers.len() == 3);
        for id in [1, 3] {
            let mut there = RunRecord::empty("", "", 0, 7);
            Answer::read(&answers[id as usize - 1], id).unwrap().tell(&mut there);
            assert_eq!(timeless(there), timeless(here.clone()));
        }
    }

    #[test]
    fn mistakes_are_answered_and_the_next_request_is_none_the_worse() {
        let good = r#"{"name":"one","start":[0,0],"goal":[10,0]}"#;
        let moving = r#"{"name":"one","start":[0,0],"goal":[10,0],
            "obstacle":[{"disc":{"centre":[5,5],"radius":1},"velocity":[1,0]}]}"#
            .replace('\n', "");
        let cases = [
            ("hello\n".to_owned(), "\"id\":null,\"error\":\"not a request: expected value"),
            ("{\"id\":8}\n".to_owned(), "\"id\":8,\"error\":\"not a request: missing field `protocol`"),
            (request(2, "pso", good, ",\"bugdet\":{}"), "unknown field `bugdet`"),
            (request(3, "pso", good, ",\"budget\":{\"iteration\":1}"), "unknown field `iteration`"),
            (request(4, "psi", good, ""), "unknown planner \\\"psi\\\"; expected one of"),
            (request(5, "pso", good, ",\"settings\":{\"particles\":0}"), "particles = 0; expected"),
            (request(6, "pso", good, ",\"settings\":{\"particle\":9}"), "unknown field `particle`"),
            (request(7, "pso", r#"{"name":"one","start":[0,0]}"#, ""), "scene: missing field `goal`"),
            (
                request(8, "pso", r#"{"name":"one","start":[0,0],"goal":[0,0]}"#, ""),
                "scene: start and goal are the same",
            ),
            (request(9, "pso", &moving, ""), "scene: "),
            (request(10, "pso", good, "").replace("\"protocol\":1", "\"protocol\":2"), "protocol = 2; expected 1"),
            (request(11, "pso", good, "").replace("\"kind\":\"pso\",", ""), "no kind; expected a planner"),
        ];
        for (line, expected) in cases {
            let answers = answers(&format!("{line}\n{}", request(77, "straight-line", good, "")));
            let said = String::from_utf8_lossy(&answers[0]);
            assert!(said.contains("\"error\"") && said.contains(expected), "{line}{said}");
            let mut run = RunRecord::empty("", "", 0, 7);
            Answer::read(&answers[1], 77).unwrap().tell(&mut run);
            assert_eq!(run.path.len(), 2, "{line}");
        }
    }
}
