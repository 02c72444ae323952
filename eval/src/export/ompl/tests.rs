//! A strict reader of the format, written from its description and not from the writer.

use super::*;
use crate::export::summaries;
use crate::results::Progress;
use crate::testing::{campaign, detour, entry, nothing, refusal, runs_of};

struct Read {
    experiment: String,
    planners: Vec<ReadPlanner>,
}

struct ReadPlanner {
    name: String,
    properties: Vec<String>,
    runs: Vec<Vec<Option<String>>>,
    progress: Vec<Vec<[Option<f64>; 3]>>,
}

impl ReadPlanner {
    /// The median of a property of all runs, NULL counted as +∞.
    fn median(&self, property: &str) -> f64 {
        let index = self.properties.iter().position(|p| p == property).unwrap();
        let values = self.runs.iter().map(|run| run[index].as_ref().map_or(f64::INFINITY, |v| v.parse().unwrap()));
        crate::statistics::median(&values.collect::<Vec<f64>>()).unwrap()
    }
}

/// Lines with their numbers; every helper panics with the line that breaks a rule.
struct Lines<'a>(std::iter::Peekable<std::iter::Enumerate<std::str::Lines<'a>>>);

impl<'a> Lines<'a> {
    fn next(&mut self) -> &'a str {
        let (number, line) = self.0.next().expect("the log ends too early");
        assert!(!line.trim().is_empty() || line.is_empty(), "line {}", number + 1);
        line
    }

    fn expect(&mut self, exact: &str) {
        assert_eq!(self.next(), exact);
    }

    /// What is left of a line between `before` and `after`.
    fn between(&mut self, before: &str, after: &str) -> &'a str {
        let line = self.next();
        line.strip_prefix(before).and_then(|l| l.strip_suffix(after)).unwrap_or_else(|| panic!("{line:?}: {after:?}"))
    }

    fn count(&mut self, after: &str) -> usize {
        self.between("", after).parse().unwrap()
    }

    fn block(&mut self) {
        self.expect("<<<|");
        while self.next() != "|>>>" {}
    }
}

fn is_word(text: &str) -> bool {
    !text.is_empty() && !text.contains(char::is_whitespace)
}

fn value(text: &str) -> Option<String> {
    assert!(!text.contains("-inf") && !text.contains("-nan") && !text.contains([';', ',']), "{text:?}");
    (!["", "inf", "nan"].contains(&text)).then(|| text.to_owned())
}

fn property(line: &str) -> (String, String) {
    let (name, kind) = line.rsplit_once(' ').unwrap();
    assert!(name.chars().all(|c| c.is_ascii_alphanumeric() || c == ' '), "{name:?}");
    assert!(!["id", "experimentid", "plannerid"].contains(&name), "a column of its own");
    assert!(["REAL", "INTEGER", "BOOLEAN", "ENUM"].contains(&kind), "{kind:?}");
    (name.to_owned(), kind.to_owned())
}

fn read(log: &str) -> Read {
    assert!(log.ends_with(".\n"));
    let mut lines = Lines(log.lines().enumerate().peekable());
    let version: Vec<&str> = lines.next().split(' ').collect();
    assert!(matches!(version[..], [library, "version", number] if is_word(library) && is_word(number)));
    let experiment = lines.between("Experiment ", "");
    for _ in 0..lines.count(" experiment properties") {
        let (name, _) = lines.next().split_once(" = ").unwrap();
        property(name.replace('_', " ").as_str());
    }
    assert!(is_word(experiment) && is_word(lines.between("Running on ", "")));
    assert_eq!(lines.between("Starting at ", "").len(), "2026-08-09 12:00:00".len());
    lines.block();
    lines.block();
    let _: u64 = lines.between("", " is the random seed").parse().unwrap();
    for after in [" seconds per run", " MB per run"] {
        assert!(lines.between("", after).parse::<f64>().unwrap() >= 0.0);
    }
    lines.count(" runs per planner");
    assert!(lines.between("", " seconds spent to collect the data").parse::<f64>().unwrap() >= 0.0);
    lines.expect("1 enum type");
    let statuses = lines.between("status|", "").split('|').count();
    let planners = (0..lines.count(" planners")).map(|_| planner(&mut lines, statuses)).collect();
    assert_eq!(lines.0.next(), None, "nothing follows");
    Read { experiment: experiment.to_owned(), planners }
}

fn planner(lines: &mut Lines<'_>, statuses: usize) -> ReadPlanner {
    let name = lines.next().to_owned();
    assert!(is_word(&name));
    for _ in 0..lines.count(" common properties") {
        assert!(lines.next().contains('='));
    }
    let listed: Vec<_> = (0..lines.count(" properties for each run")).map(|_| property(lines.next())).collect();
    let (properties, kinds): (Vec<String>, Vec<String>) = listed.into_iter().unzip();
    let mut folded: Vec<String> = properties.iter().map(|p| p.to_lowercase()).collect();
    folded.sort();
    folded.dedup();
    assert_eq!(folded.len(), properties.len(), "names that differ in case only");
    let enums: Vec<usize> = (0..kinds.len()).filter(|i| kinds[*i] == "ENUM").collect();
    assert!(enums.len() == 1 && properties[enums[0]] == "status");
    let runs = (0..lines.count(" runs")).map(|_| {
        let line = lines.next();
        assert!(line.ends_with("; "), "{line:?}");
        let mut cells: Vec<&str> = line.split("; ").collect();
        assert_eq!(cells.pop(), Some(""));
        assert_eq!(cells.len(), properties.len(), "{line:?}");
        assert!(cells[enums[0]].parse::<usize>().unwrap() < statuses);
        for (cell, kind) in cells.iter().zip(&kinds) {
            match &kind[..] {
                "BOOLEAN" => assert!(["0", "1"].contains(cell)),
                "INTEGER" => drop(cell.parse::<u64>().unwrap()),
                _ => drop(value(cell).map(|v| v.parse::<f64>().unwrap())),
            }
        }
        cells.into_iter().map(value).collect()
    });
    let runs: Vec<Vec<Option<String>>> = runs.collect();
    let mut progress = Vec::new();
    if lines.0.peek().unwrap().1 != "." {
        assert_eq!(lines.count(" progress properties for each run"), 3);
        let names = [(); 3].map(|()| property(lines.next()).0);
        assert_eq!(names, ["best cost", "time", "evaluations"]);
        assert_eq!(lines.count(" runs"), runs.len());
        for _ in &runs {
            let samples = lines.next().split_terminator(';').map(|sample| {
                let cells: Vec<&str> = sample.split(',').collect();
                let [cost, time, evaluations, ""] = cells[..] else { panic!("{sample:?}") };
                [cost, time, evaluations].map(|v| value(v).map(|v| v.parse().unwrap()))
            });
            progress.push(samples.collect());
        }
    }
    lines.expect(".");
    ReadPlanner { name, properties, runs, progress }
}

fn results() -> Results {
    let planners =
        vec![entry("de tour", detour), entry("DE-tour", detour), entry("nothing", nothing), entry("no", refusal)];
    let campaign = campaign(planners);
    let mut results = campaign.empty_results(1);
    results.manifest.platform = "linux x86_64".into();
    results.runs = runs_of(&campaign);
    results
}

#[test]
fn a_strict_reader_finds_the_same_medians() {
    let results = results();
    let logs = logs(&results, "");
    assert_eq!(logs.len(), 2);
    for (name, log) in &logs {
        let read = read(log);
        assert_eq!(&read.experiment, name);
        let names: Vec<&str> = read.planners.iter().map(|p| &p.name[..]).collect();
        assert_eq!(names, ["geometric_de_tour", "geometric_DE-tour", "geometric_nothing", "geometric_no"]);
        let expected: Vec<_> = summaries(&results).into_iter().filter(|s| s.scene.as_ref() == Some(name)).collect();
        for (planner, summary) in read.planners.iter().zip(&expected) {
            assert_eq!(planner.median("solution length"), summary.length_median);
            assert_eq!(planner.median("evaluations"), summary.evaluations_median);
            // Seconds of microseconds: a rounding each way.
            assert!((planner.median("time") * 1e6 / summary.time_us_median - 1.0).abs() < 1e-14);
            assert_eq!(planner.runs.len(), 5);
        }
    }
}

#[test]
fn statuses_are_those_of_ompl() {
    let results = results();
    let (_, log) = &logs(&results, "")[0];
    let of = |planner: usize, property: &str| {
        let planner = &read(log).planners[planner];
        let index = planner.properties.iter().position(|p| p == property).unwrap();
        planner.runs[0][index].clone()
    };
    assert_eq!((of(0, "status").as_deref(), of(0, "solved").as_deref()), (Some("6"), Some("1")), "an exact solution");
    assert_eq!((of(2, "status").as_deref(), of(2, "correct solution").as_deref()), (Some("8"), Some("0")), "abort");
    assert_eq!(of(3, "status").as_deref(), Some("0"), "an error is none of OMPL's");
    assert_eq!(of(2, "solution length"), None);
    let mut run = results.runs[0].clone();
    run.valid = false;
    assert_eq!(status(&run), 5, "a path that the judge refuses");
    run.path.clear();
    for (ours, theirs) in [(RunStatus::BudgetSpent, 4), (RunStatus::Crashed, 7), (RunStatus::Infeasible, 9)] {
        run.status = ours;
        assert_eq!(status(&run), theirs);
    }
}

#[test]
fn times_are_keys_of_progress() {
    let mut results = results();
    let point = |time_us: f64, cost: f64| Progress { evaluations: 1, time_us, cost };
    results.runs.retain(|r| r.planner == "nothing");
    results.runs[0].progress = vec![point(1.0, 3.0), point(1.0, 2.5), point(2.0, 2.25)];
    for run in &mut results.runs[1..] {
        run.progress.clear();
    }
    let scene = results.runs[0].scene.clone();
    let logs = logs(&results, "");
    let (_, log) = logs.iter().find(|(name, _)| *name == scene).unwrap();
    let read = read(log);
    assert_eq!(read.planners.len(), 1, "planners without runs are left out");
    let first: Vec<_> = read.planners[0].progress[0].iter().map(|p| p.map(Option::unwrap)).collect();
    assert_eq!(first, [[2.5, 1e-6, 1.0], [2.25, 2e-6, 1.0]]);
    assert!(read.planners[0].progress[1].is_empty());
}

#[test]
fn names_are_words_and_differ_without_case() {
    let names = unique(["a b", "A_B", "a_b_2", ".x"].iter().map(|n| word(n)));
    assert_eq!(names, ["a_b", "A_B_2", "a_b_2_2", "_.x"]);
}

#[test]
fn limits_of_memory_are_told() {
    let results = results();
    let line = |limits: [&str; 4]| {
        let table = |(p, limit): (&PlannerInfo, &str)| format!("[planner.{:?}]\n{limit}\n", p.label);
        let comparison: String = results.planners.iter().zip(limits).map(table).collect();
        let (_, log) = &logs(&results, &comparison)[0];
        read(log);
        let found = |part: &str| log.lines().find(|l| l.contains(part)).unwrap().to_owned();
        (found("MB per run"), found("Memory").split_once(';').unwrap().0.to_owned())
    };
    let (none, some, more) = ("", "memory_mb = 64", "memory_mb = 100");
    assert_eq!(line([none; 4]), ("0 MB per run".into(), "Memory was not limited".into()));
    assert_eq!(line([some; 4]), ("64 MB per run".into(), "Memory: 64 MiB for every planner".into()));
    let each = "Memory: de tour 64 MiB, DE-tour 100 MiB, nothing no limit, no 64 MiB";
    assert_eq!(line([some, more, none, some]), ("0 MB per run".into(), each.into()));
}
