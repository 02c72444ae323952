//! The worker protocol: one line of JSON for each request and each answer.
//!
//! ```text
//! → {"protocol":1,"id":1,"kind":"pso","scene":{…},"settings":{…},"seed":7,"budget":{"iterations":400}}
//! ← {"id":1,"status":"solved","path":[[x,y],…],"evaluations":8000,"progress":[[evaluations,time_us,cost],…]}
//! ← {"id":1,"error":"why there is no plan"}
//! ```
//!
//! `scene` has the keys of the scene file, `budget` those of a comparison's budget, `settings` those of the planner's
//! table without the reserved ones. `kind` names a planner of the catalogue and is absent for external planners. NaN
//! and infinity are no JSON: in an external planner's settings they are text, as dates are. Floats round-trip.

use env_model::Point;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use crate::config::BudgetSpec;
use crate::results::{Progress, RunRecord, RunStatus};

/// The version that this program speaks.
pub const VERSION: u32 = 1;

/// What an answer may look like, for messages.
pub const EXPECTED: &str = r#"{"id":N,"status":"solved","path":[[x,y],…]} or {"id":N,"error":"…"} on one line"#;

/// The longest path that is taken from an external planner, points.
const MOST_POINTS: usize = 100_000;
/// The longest text that is taken from it, bytes.
const MOST_TEXT: usize = 2048;

/// `text` with control characters escaped, cut where it is too long.
pub fn plain(text: &str) -> String {
    let mut plain = String::new();
    for c in text.chars() {
        let length = plain.len();
        if c.is_control() {
            plain.extend(c.escape_default());
        } else {
            plain.push(c);
        }
        if plain.len() > MOST_TEXT {
            plain.truncate(length);
            plain.push('…');
            break;
        }
    }
    plain
}

/// Asks for one run.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request<'a> {
    /// [`VERSION`].
    pub protocol: u32,
    /// The answer carries it too.
    pub id: u64,
    /// A planner of the catalogue; `None` for an external planner, which is its own kind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
    /// The scene as JSON.
    #[serde(borrow)]
    pub scene: &'a RawValue,
    /// The planner's settings as JSON; `None` for defaults.
    #[serde(borrow, default, skip_serializing_if = "Option::is_none")]
    pub settings: Option<&'a RawValue>,
    /// The run's seed.
    pub seed: u64,
    /// What the run may spend.
    #[serde(default)]
    pub budget: BudgetSpec,
}

/// How a planner may say that its run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Ending {
    Solved,
    BudgetSpent,
    NotFound,
    Infeasible,
}

impl Ending {
    fn of(status: RunStatus) -> Option<Self> {
        match status {
            RunStatus::Solved => Some(Self::Solved),
            RunStatus::BudgetSpent => Some(Self::BudgetSpent),
            RunStatus::NotFound => Some(Self::NotFound),
            RunStatus::Infeasible => Some(Self::Infeasible),
            RunStatus::Error | RunStatus::Crashed | RunStatus::Timeout | RunStatus::OutOfMemory => None,
        }
    }

    fn status(self) -> RunStatus {
        match self {
            Self::Solved => RunStatus::Solved,
            Self::BudgetSpent => RunStatus::BudgetSpent,
            Self::NotFound => RunStatus::NotFound,
            Self::Infeasible => RunStatus::Infeasible,
        }
    }
}

/// Tells of one run. Unknown keys are ignored.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Answer {
    /// That of the request; `None` only for a request that could not be read.
    id: Option<u64>,
    #[serde(skip_serializing_if = "is_default")]
    status: Option<Ending>,
    #[serde(skip_serializing_if = "is_default")]
    error: Option<String>,
    #[serde(skip_serializing_if = "is_default")]
    path: Option<Vec<[f64; 2]>>,
    #[serde(skip_serializing_if = "is_default")]
    iterations: u64,
    #[serde(skip_serializing_if = "is_default")]
    evaluations: u64,
    #[serde(skip_serializing_if = "is_default")]
    collision_checks: u64,
    #[serde(skip_serializing_if = "is_default")]
    time_us: f64,
    #[serde(skip_serializing_if = "is_default")]
    cpu_us: f64,
    #[serde(skip_serializing_if = "is_default")]
    cost: Option<f64>,
    #[serde(skip_serializing_if = "is_default")]
    terms: Vec<(String, f64)>,
    #[serde(skip_serializing_if = "is_default")]
    progress: Vec<(u64, f64, f64)>,
}

/// Whether a key may be left out.
fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl Answer {
    /// Tells that request `id` was no good.
    pub fn refusal(id: Option<u64>, error: String) -> Self {
        Self { id, error: Some(error), ..Self::default() }
    }

    /// Tells of a run that [`run_once`](crate::runner::run_once) made.
    pub fn of_run(id: u64, run: RunRecord) -> Self {
        let status = Ending::of(run.status);
        Self {
            id: Some(id),
            status,
            error: run.error,
            path: status.map(|_| run.path.iter().map(|p| [p.x, p.y]).collect()),
            iterations: run.iterations,
            evaluations: run.evaluations,
            collision_checks: run.collision_checks,
            time_us: run.time_us,
            cpu_us: run.cpu_us,
            cost: run.cost,
            terms: run.terms,
            progress: run.progress.iter().map(|p| (p.evaluations, p.time_us, p.cost)).collect(),
        }
    }

    /// Reads the answer to request `id`; else what is wrong with it.
    pub fn read(line: &[u8], id: u64) -> Result<Self, String> {
        let answer: Self = serde_json::from_slice(line).map_err(|e| e.to_string())?;
        if answer.id != Some(id) {
            let found = answer.id.map_or_else(|| "no id".to_owned(), |found| format!("id {found}"));
            return Err(format!("{found} in answer to request {id}"));
        }
        match (answer.status, &answer.error, &answer.path) {
            (None, None, _) => return Err("neither status nor error".to_owned()),
            (Some(Ending::Solved), _, None) => return Err("status solved without path".to_owned()),
            _ => {}
        }
        // What a clock and a counter would say: neither runs backwards.
        let rising = |w: &[(u64, f64, f64)]| w[0].0 <= w[1].0 && w[0].1 <= w[1].1;
        if answer.progress.first().is_some_and(|p| p.1 < 0.0) || !answer.progress.windows(2).all(rising) {
            return Err("progress whose evaluations or times fall".to_owned());
        }
        Ok(answer)
    }

    /// The answer of an external planner, which the bench saw `round_trip` µs after the request. Nothing is too large,
    /// text is plain, counters agree, and no improvement is earlier than the bench can believe: it came as long before
    /// the end of the round trip as it did before the end of the planner's own total time, or, without a possible one,
    /// at the end of the round trip. Else what is wrong with it.
    pub fn vetted(mut self, round_trip: f64) -> Result<Self, String> {
        let points = self.path.as_ref().map_or(0, Vec::len);
        if points > MOST_POINTS {
            return Err(format!("a path of {points} points, more than {MOST_POINTS}"));
        }
        for (key, time) in [("time_us", self.time_us), ("cpu_us", self.cpu_us)] {
            if time < 0.0 {
                return Err(format!("{key} = {time}, less than 0"));
            }
        }
        if let Some((last, ..)) = self.progress.last() {
            if self.evaluations == 0 {
                self.evaluations = *last;
            }
            if *last > self.evaluations {
                return Err(format!("progress up to {last} evaluations of {} in all", self.evaluations));
            }
        }
        let own = Some(self.time_us).filter(|own| *own > 0.0 && *own <= round_trip);
        for (_, time, _) in &mut self.progress {
            *time = own.map_or(round_trip, |own| round_trip - (own - *time).max(0.0));
        }
        self.error = self.error.as_deref().map(plain);
        for (name, _) in &mut self.terms {
            *name = plain(name);
        }
        Ok(self)
    }

    /// Puts what it tells into `record`. An error outweighs a status.
    pub fn tell(self, record: &mut RunRecord) {
        record.status = match (&self.error, self.status) {
            (None, Some(ending)) => ending.status(),
            _ => RunStatus::Error,
        };
        record.error = self.error;
        record.path = self.path.unwrap_or_default().into_iter().map(Point::from).collect();
        record.iterations = self.iterations;
        record.evaluations = self.evaluations;
        record.collision_checks = self.collision_checks;
        record.time_us = self.time_us;
        record.cpu_us = self.cpu_us;
        record.cost = self.cost;
        record.terms = self.terms;
        let mut best = f64::INFINITY;
        let better = self.progress.into_iter().filter(|p| {
            let better = p.2 < best;
            best = best.min(p.2);
            better
        });
        record.progress = better.map(|(evaluations, time_us, cost)| Progress { evaluations, time_us, cost }).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_comes_back_as_it_was() {
        let mut run = RunRecord::empty("scene", "planner", 0, 7);
        run.status = RunStatus::BudgetSpent;
        // Numbers that only the shortest round-tripping decimal keeps, and the sign of zero.
        run.path = vec![Point::new(0.1 + 0.2, -0.0), Point::new(5e-324, 1.797_693_134_862_315_7e308)];
        (run.iterations, run.evaluations, run.collision_checks) = (3, u64::MAX, 5);
        (run.time_us, run.cpu_us, run.cost) = (1.001, 0.999, Some(1.0 / 3.0));
        run.terms = vec![("risk".to_owned(), 0.1)];
        run.progress = vec![
            Progress { evaluations: 1, time_us: 0.1, cost: 2.0 / 3.0 },
            Progress { evaluations: 1, time_us: 0.1, cost: 1.0 / 3.0 },
        ];
        let line = serde_json::to_vec(&Answer::of_run(4, run.clone())).unwrap();
        let mut back = RunRecord::empty("scene", "planner", 0, 7);
        Answer::read(&line, 4).unwrap().tell(&mut back);
        assert_eq!(back, run);
        assert!(back.path[0].y.is_sign_negative());
    }

    #[test]
    fn an_error_keeps_its_counters() {
        let mut run = RunRecord::empty("scene", "planner", 0, 7);
        (run.error, run.iterations, run.time_us) = (Some("point 1 of the path is not finite".to_owned()), 3, 2.5);
        let line = serde_json::to_string(&Answer::of_run(4, run.clone())).unwrap();
        let expected = r#"{"id":4,"error":"point 1 of the path is not finite","iterations":3,"time_us":2.5}"#;
        assert_eq!(line, expected);
        let mut back = RunRecord::empty("scene", "planner", 0, 7);
        Answer::read(line.as_bytes(), 4).unwrap().tell(&mut back);
        assert_eq!(back, run);
    }

    fn vetted(rest: &str) -> Result<Answer, String> {
        let line = format!(r#"{{"id":1,"status":"solved","path":[],{rest}}}"#);
        Answer::read(line.as_bytes(), 1).unwrap().vetted(1000.0)
    }

    #[test]
    fn no_improvement_is_earlier_than_the_bench_believes() {
        let times = |rest: &str| {
            let answer = vetted(&format!(r#"{rest}"progress":[[1,0,9],[4,150,8]]"#)).unwrap();
            (answer.evaluations, answer.progress.iter().map(|p| p.1).collect::<Vec<_>>())
        };
        // By hand: 1000 − (200 − 0) and 1000 − (200 − 150).
        assert_eq!(times(r#""evaluations":4,"time_us":200,"#), (4, vec![800.0, 950.0]));
        assert_eq!(times(r#""evaluations":9,"#), (9, vec![1000.0; 2]), "no time of its own");
        assert_eq!(times(r#""time_us":1e9,"#), (4, vec![1000.0; 2]), "longer than it can have taken");
        assert_eq!(times(r#""time_us":100,"#), (4, vec![900.0, 1000.0]), "an improvement after its own end");
    }

    #[test]
    fn an_external_answer_keeps_within_bounds() {
        let point = "[0,0],".repeat(MOST_POINTS);
        for (rest, expected) in [
            (r#""evaluations":3,"progress":[[4,1,9]]"#, "progress up to 4 evaluations of 3 in all"),
            (r#""time_us":-1"#, "time_us = -1, less than 0"),
            (r#""cpu_us":-0.5"#, "cpu_us = -0.5, less than 0"),
        ] {
            assert_eq!(vetted(rest).unwrap_err(), expected);
        }
        let path = format!(r#"{{"id":1,"status":"solved","path":[{point}[1,1]]}}"#);
        let long = Answer::read(path.as_bytes(), 1).unwrap().vetted(1.0).unwrap_err();
        assert_eq!(long, "a path of 100001 points, more than 100000");
        let answer = vetted(&format!(r#""error":"\u001b[2J{}","terms":[["a\u0007",1]]"#, "é".repeat(5000))).unwrap();
        assert_eq!(answer.terms[0].0, "a\\u{7}");
        let error = answer.error.unwrap();
        assert!(error.starts_with("\\u{1b}[2Jé") && error.ends_with("é…"), "{error}");
        // The last character that does not fit is left out, and the ellipsis has three bytes.
        assert!((MOST_TEXT..MOST_TEXT + 3).contains(&error.len()), "{}", error.len());
    }

    #[test]
    fn nonsense_is_named() {
        let cases = [
            ("", "EOF"),
            ("{\"id\":1", "EOF"),
            ("7", "invalid type: integer `7`"),
            (r#"{"status":"solved","path":[]}"#, "no id in answer to request 1"),
            (r#"{"id":2,"status":"solved","path":[]}"#, "id 2 in answer to request 1"),
            (r#"{"id":-1,"error":""}"#, "invalid value: integer `-1`"),
            (r#"{"id":1,"status":"crashed"}"#, "unknown variant `crashed`"),
            (r#"{"id":1,"status":"solved"}"#, "status solved without path"),
            (r#"{"id":1,"status":"solved","path":null}"#, "status solved without path"),
            (r#"{"id":1}"#, "neither status nor error"),
            (r#"{"id":1,"status":"solved","path":[[0,1e999]]}"#, "number out of range"),
            (r#"{"id":1,"status":"solved","path":[[0]]}"#, "invalid length 1"),
            (r#"{"id":1,"status":"solved","path":[0,1]}"#, "invalid type: integer `0`"),
            (r#"{"id":1,"status":"solved","path":[],"evaluations":1.5}"#, "invalid type: floating point"),
            (
                r#"{"id":1,"status":"solved","path":[],"progress":[[2,1,9],[1,2,8]]}"#,
                "progress whose evaluations or times",
            ),
            (
                r#"{"id":1,"status":"solved","path":[],"progress":[[1,2,9],[1,1,8]]}"#,
                "progress whose evaluations or times",
            ),
        ];
        for (line, expected) in cases {
            let fault = Answer::read(line.as_bytes(), 1).unwrap_err();
            assert!(fault.contains(expected), "{line}: {fault}");
        }
    }
}
