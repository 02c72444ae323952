//! Planners in processes of their own: what goes wrong in one ends that run alone, as what it was.

#![cfg(unix)]

mod common;

use std::collections::BTreeMap;
use std::fs;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use common::{Place, SCENE};
use eval::results::{RunRecord, RunStatus};
use eval::store::Store;

/// Reads a request and keeps its id, as every planner below begins.
const READ: &str = "read -r line || exit 0; id=${line#*\\\"id\\\":}; id=${id%%,*}\n";

/// A place with `one.toml`.
fn furnished(name: &str) -> Place {
    let place = Place::new(name);
    place.write("one.toml", SCENE);
    place
}

impl Place {
    fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_touchline"));
        command.args(args).current_dir(&self.0);
        command
    }

    /// A comparison of three planners of the catalogue and the external `planners` in the scene: (label, shell
    /// script that answers again and again, further keys).
    fn comparison(&self, name: &str, planners: &[(&str, &str, &str)]) {
        let mut text = format!(
            "name = \"{name}\"\nrepeats = 2\nscenes = [\"one.toml\"]\nbudget = {{ evaluations = 400 }}\n
            [planner.straight-line]\n[planner.pso]\nparticles = 5\n[planner.tangent]\n"
        );
        for (label, script, keys) in planners {
            self.write(&format!("{label}.sh"), &format!("while :; do\n{READ}{script}\ndone\n"));
            text.push_str(&format!(
                "[planner.{label}]\nkind = \"external\"\ncommand = [\"sh\", \"{label}.sh\"]\n{keys}\n"
            ));
        }
        self.write(&format!("{name}.toml"), &text);
    }

    /// The runs of a campaign by planner, times apart.
    fn runs(&self, out: &str) -> BTreeMap<String, Vec<RunRecord>> {
        let mut runs: BTreeMap<String, Vec<RunRecord>> = BTreeMap::new();
        for run in Store::open(&self.0.join(out)).unwrap().read().unwrap().results.runs {
            runs.entry(run.planner.clone()).or_default().push(run);
        }
        runs
    }
}

fn timeless(mut runs: Vec<RunRecord>) -> Vec<RunRecord> {
    for run in &mut runs {
        (run.time_us, run.cpu_us, run.overhead_us) = (0.0, 0.0, None);
        run.progress.iter_mut().for_each(|p| p.time_us = 0.0);
    }
    runs
}

/// Whether the process whose number the file holds is gone, waiting for it if need be.
#[cfg(target_os = "linux")]
fn gone(place: &Place, file: &str) -> bool {
    let began = Instant::now();
    // Long enough for a loaded machine; the planners that are looked for would live a thousand seconds.
    while began.elapsed() < Duration::from_secs(20) {
        if let Ok(pid) = fs::read_to_string(place.0.join(file)) {
            // A dead process that nobody has reaped yet is a zombie: `number (name) Z …`.
            match fs::read_to_string(format!("/proc/{}/stat", pid.trim())) {
                Ok(stat) if !stat.contains(") Z ") => {}
                _ => return true,
            }
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    false
}

const GOOD: &str = r#"echo "{\"id\":$id,\"status\":\"solved\",\"path\":[[0,0],[5,3],[10,0]],\"iterations\":4,\
\"evaluations\":9,\"cost\":11.5,\"terms\":[[\"length\",11.5]],\"progress\":[[3,1.5,12.0],[6,2.0,12.5],[9,2.5,11.5]]}""#;

/// Makes a script answer its first request, the one that may take a minute longer, as `GOOD` does.
fn at_first_good(script: &str) -> String {
    format!("if [ -z \"$warm\" ]; then warm=1; {GOOD}; continue; fi; {script}")
}

/// (label, script, further keys, status, what the error says)
type Bad = (&'static str, &'static str, &'static str, RunStatus, &'static str);

const BAD: &[Bad] = {
    use RunStatus::{Crashed, Error, Timeout};
    &[
        ("aborts", "echo 'no more memory for me' >&2; kill -ABRT $$", "", Crashed, "SIGABRT"),
        ("segfaults", "kill -SEGV $$", "", Crashed, "SIGSEGV"),
        ("quits", "exit 75", "", Crashed, "exit status: 75"),
        ("explains", "echo 'division by zero' >&2; exit 3", "", Crashed, "its last words: division by zero"),
        ("hangs", "sleep 1000", "hard_limit_ms = 300", Timeout, "no answer within its hard limit, 0.3 s"),
        (
            "late",
            r#"sleep 1; echo "{\"id\":$id,\"error\":\"late\"}""#,
            "hard_limit_ms = 300",
            Timeout,
            "no answer within its hard limit",
        ),
        ("rubbish", "echo hello", "", Error, r#"expected {"id":N,"status":"solved","path":[[x,y],…]}"#),
        ("array", "echo '[1]'", "", Error, r#"it said "[1]""#),
        (
            "not-a-number",
            r#"echo "{\"id\":$id,\"status\":\"solved\",\"path\":[[0,0],[NaN,1],[10,0]]}""#,
            "",
            Error,
            "expected value at line 1 column",
        ),
        (
            "not-a-number-text",
            r#"echo "{\"id\":$id,\"status\":\"solved\",\"path\":[[0,0],[\"NaN\",1],[10,0]]}""#,
            "",
            Error,
            "invalid type: string \"NaN\", expected f64",
        ),
        (
            "three-numbers",
            r#"echo "{\"id\":$id,\"status\":\"solved\",\"path\":[[0,0,0],[10,0,0]]}""#,
            "",
            Error,
            "expected {\"id\":N",
        ),
        ("closes", "exec 1>&-; sleep 1000", "", Crashed, "it closed its standard output before it answered"),
        ("other-id", r#"echo "{\"id\":777,\"error\":\"who?\"}""#, "", Error, "id 777 in answer to request 1; expected"),
        ("half", r#"printf '{"id":'; exit 0"#, "", Crashed, "its process ended before it answered"),
        ("orphans", "sleep 1000 & echo $! > orphan.pid; exit 0", "", Crashed, "its process ended before it answered"),
        (
            "family",
            "sleep 1000 & echo $! > family.pid; wait",
            "hard_limit_ms = 300",
            Timeout,
            "no answer within its hard limit",
        ),
        ("pathless", r#"echo "{\"id\":$id,\"status\":\"solved\"}""#, "", Error, "status solved without path; expected"),
        ("triumph", r#"echo "{\"id\":$id,\"status\":\"won\"}""#, "", Error, "unknown variant `won`, expected one of"),
        ("mute", r#"echo "{\"id\":$id}""#, "", Error, "neither status nor error; expected"),
        ("endless", "yes | tr -d '\\n'", "", Error, "a line of more than 64 MiB; expected an answer"),
        (
            "eager",
            r#"printf '%s\n%s\n' "{\"id\":$id,\"error\":\"a\"}" "{\"id\":$((id+1)),\"error\":\"b\"}""#,
            "",
            Error,
            "a line before it was asked; expected one for each request",
        ),
        (
            "boastful",
            r#"echo "{\"id\":$id,\"error\":\"\",\"evaluations\":1,\"progress\":[[2,0,1]]}""#,
            "",
            Error,
            "progress up to 2 evaluations of 1 in all; expected",
        ),
        ("refuses", r#"echo "{\"id\":$id,\"error\":\"too hard\"}""#, "", Error, "too hard"),
        (
            "elsewhere",
            r#"echo "{\"id\":$id,\"status\":\"solved\",\"path\":[[0,0],[5,3],[9,0]]}""#,
            "",
            Error,
            "the path ends at (9, 0), not at the goal",
        ),
    ]
};

#[test]
fn every_way_to_fail_ends_that_run_alone() {
    let place = furnished("bad");
    let mut planners = vec![("good", GOOD, "")];
    place.comparison("clean", &planners);
    let bad: Vec<String> = BAD
        .iter()
        .map(|(_, script, _, status, _)| match status {
            RunStatus::Timeout => at_first_good(script),
            _ => (*script).to_owned(),
        })
        .collect();
    planners.extend(BAD.iter().zip(&bad).map(|((label, _, keys, ..), script)| (*label, script.as_str(), *keys)));
    place.comparison("hostile", &planners);
    place.write("hostile.toml", &{
        let text = fs::read_to_string(place.0.join("hostile.toml")).unwrap();
        format!("{text}[planner.missing]\nkind = \"external\"\ncommand = [\"./no-such-program\"]\n")
    });
    place.ok(&["run", "clean.toml", "--out", "clean", "--quiet"]);
    place.ok(&["run", "hostile.toml", "--out", "hostile", "--quiet", "--jobs", "2"]);
    let clean = place.runs("clean");
    let mut runs = place.runs("hostile");
    for (planner, expected) in clean {
        assert_eq!(timeless(runs.remove(&planner).unwrap()), timeless(expected.clone()), "{planner}");
        if planner == "good" {
            for run in &expected {
                assert!(run.valid && run.status == RunStatus::Solved && run.error.is_none(), "{run:?}");
                assert_eq!((run.iterations, run.evaluations, run.cost), (4, 9, Some(11.5)));
                assert_eq!(run.terms, [("length".to_owned(), 11.5)]);
                let curve: Vec<_> = run.progress.iter().map(|p| (p.evaluations, p.time_us, p.cost)).collect();
                let end = run.time_us;
                assert_eq!(curve, [(3, end, 12.0), (9, end, 11.5)], "improvements alone, by the bench's clock");
                assert!(run.time_us > 0.0 && run.overhead_us.is_none(), "the round trip is its time");
            }
        }
    }
    let missing = ("missing", "", "", RunStatus::Crashed, "cannot start [\"./no-such-program\"]: No such file");
    for (label, _, _, status, error) in BAD.iter().chain([&missing]) {
        let runs = runs.remove(*label).unwrap();
        assert_eq!(runs.len(), 2);
        for run in runs {
            assert_eq!(run.status, *status, "{run:?}");
            assert!(run.error.as_deref().is_some_and(|e| e.contains(error)), "{label}: {:?}", run.error);
            assert!(!run.valid, "{label}");
            if *status == RunStatus::Timeout {
                // It is killed at the limit, and not long after it; the other bound is for a loaded machine.
                assert!((3e5..5e6).contains(&run.time_us), "{label}: {} µs", run.time_us);
            }
        }
    }
    assert!(runs.is_empty(), "no planner more");
    #[cfg(target_os = "linux")]
    assert!(gone(&place, "orphan.pid") && gone(&place, "family.pid"), "grandchildren are killed too");
}

#[test]
#[cfg(target_os = "linux")]
fn memory_is_limited_while_planning_and_after() {
    let place = furnished("memory");
    // A mebibyte more in each turn, so that nobody's machine suffers if the limit does not work.
    let megabyte = "m=0123456789abcdef; for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do m=$m$m; done";
    let eat = |turns: u32| format!("{megabyte}; x=; i=0; while [ $i -lt {turns} ]; do x=$x$m; i=$((i+1)); done");
    // Five children of some 8 MiB, none of which is too large, copies of text included.
    let child = format!("({}; sleep 1000) &", eat(6));
    let family = format!("{} wait", child.repeat(5));
    let (greedy, hasty) = (format!("{}; sleep 1000", eat(60)), format!("{}; {GOOD}", eat(60)));
    let planners = [
        ("greedy", greedy.as_str(), "memory_mb = 30"),
        ("hasty", hasty.as_str(), "memory_mb = 30"),
        ("family", &family, "memory_mb = 30"),
        ("modest", GOOD, "memory_mb = 30"),
    ];
    place.comparison("memory", &planners);
    place.ok(&["run", "memory.toml", "--out", "out", "--quiet"]);
    let runs = place.runs("out");
    for run in ["greedy", "hasty", "family"].iter().flat_map(|label| &runs[*label]) {
        assert_eq!(run.status, RunStatus::OutOfMemory, "{run:?}");
        assert!(run.error.as_deref().is_some_and(|e| e.ends_with("expected at most memory_mb = 30")), "{run:?}");
    }
    assert!(runs["modest"].iter().all(|run| run.valid), "{:?}", runs["modest"]);
}

#[test]
fn a_process_that_fails_once_is_started_again() {
    let place = furnished("again");
    // Crashes whenever a file says so, which it removes first.
    let script = format!("if [ -f crash ]; then rm crash; kill -KILL $$; fi; echo go >> asked; {GOOD}");
    place.comparison("again", &[("moody", &script, "")]);
    place.write("crash", "");
    place.ok(&["run", "again.toml", "--out", "out", "--quiet", "--repeats", "3"]);
    let runs = &place.runs("out")["moody"];
    let statuses: Vec<_> = runs.iter().map(|r| r.status).collect();
    assert_eq!(statuses, [RunStatus::Crashed, RunStatus::Solved, RunStatus::Solved]);
    let asked = fs::read_to_string(place.0.join("asked")).unwrap();
    assert_eq!(asked.lines().count(), 3, "the first request twice, so that the start is not timed; then once a run");
}

#[test]
fn a_slow_start_is_allowed_for() {
    let place = furnished("slow");
    let script = format!("[ -n \"$warm\" ] || sleep 1; warm=1; {GOOD}");
    place.comparison("slow", &[("slow", &script, "hard_limit_ms = 500")]);
    place.ok(&["run", "slow.toml", "--out", "out", "--quiet"]);
    let runs = &place.runs("out")["slow"];
    assert!(runs.iter().all(|run| run.valid && run.time_us < 1e6), "{runs:?}");
}

#[test]
fn isolation_changes_nothing_but_times() {
    let place = furnished("same");
    place.write(
        "same.toml",
        "name = \"same\"\nrepeats = 3\nbudget = { evaluations = 600 }
        scenes = [\"one.toml\", { generate = \"wall\", count = 2, obstacles = 9, seed = 2 }]
        [planner.straight-line]\n[planner.tangent]\n[planner.random-search]
        [planner.pso]\nparticles = 5\nc1 = { sweep = [0.7, 1.49445] }
        [planner.pso-qp]\nparticles = 5\n[planner.rrt-star]\n[planner.theta-star]\n[planner.potential-field]\n",
    );
    place.ok(&["run", "same.toml", "--out", "here", "--quiet"]);
    place.ok(&["run", "same.toml", "--out", "apart", "--quiet", "--isolate", "--jobs", "2"]);
    let (here, apart) = (place.runs("here"), place.runs("apart"));
    assert_eq!(here.len(), 9);
    for (planner, here) in here {
        let apart = apart[&planner].clone();
        assert!(here.iter().all(|run| run.overhead_us.is_none()));
        assert!(apart.iter().all(|run| run.time_us > 0.0 && run.overhead_us.is_some_and(|us| us > 0.0)));
        assert_eq!(timeless(here), timeless(apart), "{planner}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_killed_bench_leaves_no_process() {
    let place = furnished("killed");
    // Of the three processes only the last is looked for: neither bench nor tether has started it.
    place.comparison("killed", &[("hangs", "sleep 1000 & echo $! > hang.pid; wait", "")]);
    let mut bench = place
        .command(&["run", "killed.toml", "--out", "out", "--quiet", "--isolate", "--planner", "hangs"])
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let began = Instant::now();
    while fs::read_to_string(place.0.join("hang.pid")).map_or(true, |pid| !pid.ends_with('\n')) {
        assert!(began.elapsed() < Duration::from_secs(60), "the planner never began");
        std::thread::sleep(Duration::from_millis(10));
    }
    bench.kill().unwrap();
    bench.wait().unwrap();
    assert!(gone(&place, "hang.pid"));
}

/// Makes `touchline run many.toml` with at most `files` open files in the bench.
fn run_with_files(place: &Place, files: u32, more: &str) -> Output {
    let line = format!("ulimit -n {files}; exec \"$0\" run many.toml --out out --quiet {more}");
    let mut shell = Command::new("sh");
    shell.args(["-c", &line, env!("CARGO_BIN_EXE_touchline")]).current_dir(&place.0).output().unwrap()
}

#[test]
fn processes_are_few_and_none_is_missed() {
    let place = furnished("many");
    let labels: Vec<String> = (0..40).map(|n| format!("p{n}")).collect();
    let planners: Vec<_> = labels.iter().map(|label| (label.as_str(), GOOD, "")).collect();
    place.comparison("many", &planners);
    // 32 processes have 96 pipes, and 40 would have 120.
    let output = run_with_files(&place, 118, "");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let runs = place.runs("out");
    assert_eq!(runs.len(), 43);
    assert!(runs.iter().all(|(label, runs)| label == "straight-line" || runs.iter().all(|run| run.valid)));
}

#[test]
fn a_bench_without_means_is_no_result() {
    let place = furnished("poor");
    let labels: Vec<String> = (0..10).map(|n| format!("p{n}")).collect();
    let planners: Vec<_> = labels.iter().map(|label| (label.as_str(), GOOD, "")).collect();
    place.comparison("many", &planners);
    let output = run_with_files(&place, 34, "");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("error: cannot start [\"sh\", \"p") && said.contains("Too many open files"), "{said}");
    assert!(said.contains("runs are kept in out; allow more open files"), "{said}");
    assert!(said.contains("touchline run --out out --resume"), "{said}");
    let kept = place.runs("out");
    assert!(kept.values().flatten().all(|run| run.error.is_none()), "{kept:?}");
    place.ok(&["run", "many.toml", "--out", "out", "--quiet", "--resume"]);
    assert!(labels.iter().all(|label| place.runs("out")[label].iter().all(|run| run.valid)));
}

#[test]
fn plan_tries_a_planner_by_hand() {
    let place = furnished("plan");
    place.comparison("plan", &[("good", GOOD, "")]);
    let plan = ["plan", "one.toml", "--planner", "external", "--set", "command=[\"sh\", \"good.sh\"]"];
    let said = place.ok(&[&plan[..], &["--json"]].concat());
    let said: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!((&said["valid"], &said["status"]), (&true.into(), &"solved".into()));
    let output = place.command(&[&plan[..], &["--trace", "trace.jsonl"]].concat()).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("--trace: an external planner shows no frames"));
}

#[test]
fn a_worker_answers_until_its_input_ends() {
    use std::io::Write;
    let place = furnished("worker");
    let mut worker = place.command(&["worker"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let scene = r#"{"name":"one","start":[0,0],"goal":[10,0]}"#;
    let request = |kind: &str| format!(r#"{{"protocol":1,"id":5,"kind":"{kind}","scene":{scene},"seed":7}}"#);
    let requests = ["nonsense".to_owned(), request("no-such"), request("straight-line")];
    worker.stdin.take().unwrap().write_all(requests.join("\n").as_bytes()).unwrap();
    let output = worker.wait_with_output().unwrap();
    assert!(output.status.success());
    let answers: Vec<serde_json::Value> = output
        .stdout
        .split(|b| *b == b'\n')
        .filter(|l| !l.is_empty())
        .map(|l| serde_json::from_slice(l).unwrap())
        .collect();
    assert_eq!(answers.len(), 3);
    assert!(answers[0]["id"].is_null() && answers[0]["error"].as_str().unwrap().starts_with("not a request"));
    assert!(answers[1]["id"] == 5 && answers[1]["error"].as_str().unwrap().contains("unknown planner \"no-such\""));
    assert_eq!((&answers[2]["status"], &answers[2]["path"][1][0]), (&"solved".into(), &10.0.into()));
}
