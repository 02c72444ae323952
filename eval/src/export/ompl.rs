//! OMPL benchmark logs, which `ompl_benchmark_statistics` reads into the database of Planner Arena.
//!
//! A log an experiment, and a scene is an experiment. The format: Moll, Şucan & Kavraki, *Benchmarking
//! Motion Planning Algorithms*, IEEE Robotics & Automation Magazine 22(3) (2015) 96–102,
//! [doi](https://doi.org/10.1109/MRA.2015.2448276), and OMPL's own reader. Numbers are written so that they
//! read back the same; what there is not is left empty, which that reader stores as NULL.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use crate::results::{PlannerInfo, Results, RunRecord, RunStatus, SceneResult};

/// OMPL's `PlannerStatus`, in its order, with its words; 8 and 9 are `ABORT` and `INFEASIBLE` there.
const STATUSES: &str = "status|Unknown status|Invalid start|Invalid goal|Unrecognized goal type|Timeout|\
    Approximate solution|Exact solution|Crash|Abort|Infeasible";

/// What is said of each run, in this order. The clearance and the turning are not under OMPL's names, whose
/// clearance is a mean over waypoints and whose smoothness is another sum.
const PROPERTIES: [(&str, &str); 15] = [
    ("correct solution", "BOOLEAN"),
    ("solved", "BOOLEAN"),
    ("status", "ENUM"),
    ("time", "REAL"),
    ("processor time", "REAL"),
    ("solution length", "REAL"),
    ("gap to optimum", "REAL"),
    ("least clearance", "REAL"),
    ("total turning", "REAL"),
    ("best cost", "REAL"),
    ("iterations", "INTEGER"),
    ("evaluations", "INTEGER"),
    ("collision checks", "INTEGER"),
    ("repetition", "INTEGER"),
    ("run seed", "INTEGER"),
];

/// The logs, one a scene in the comparison's order, each with a name for its file (without an ending) and for the
/// experiment: unique even where case does not count. Limits of memory are read from the resolved `comparison`.
pub fn logs(results: &Results, comparison: &str) -> Vec<(String, String)> {
    let names = unique(results.scenes.iter().map(|s| word(&s.scene.name)));
    let planners = unique(results.planners.iter().map(|p| format!("geometric_{}", word(&p.label))));
    let memory = Memory::of(results, comparison);
    let log = |(scene, name): (&SceneResult, String)| {
        let text = log(results, scene, &name, &planners, &memory);
        (name, text)
    };
    results.scenes.iter().zip(names).map(log).collect()
}

/// What the planners' processes might hold.
struct Memory {
    /// The limit of all planners, MiB; 0 without one.
    common: i64,
    /// The limits in words.
    said: String,
}

impl Memory {
    fn of(results: &Results, comparison: &str) -> Self {
        let comparison: toml::Table = comparison.parse().expect("written by this program");
        let limit = |p: &PlannerInfo| comparison.get("planner")?.get(&p.label)?.get("memory_mb")?.as_integer();
        let limits: Vec<Option<i64>> = results.planners.iter().map(limit).collect();
        let first = limits.first().copied().flatten();
        if limits.iter().any(|limit| *limit != first) {
            let words = |mb: &Option<i64>| mb.map_or("no limit".to_owned(), |mb| format!("{mb} MiB"));
            let each = results.planners.iter().zip(&limits).map(|(p, mb)| format!("{} {}", clean(&p.label), words(mb)));
            return Self { common: 0, said: format!("Memory: {}", each.collect::<Vec<_>>().join(", ")) };
        }
        let said =
            first.map_or("Memory was not limited".to_owned(), |mb| format!("Memory: {mb} MiB for every planner"));
        Self { common: first.unwrap_or(0), said }
    }
}

fn log(results: &Results, scene: &SceneResult, name: &str, planners: &[String], memory: &Memory) -> String {
    let manifest = &results.manifest;
    let every = results.planners.iter().zip(planners).map(|(planner, name)| {
        (planner, name, results.runs_of(&planner.label, Some(&scene.scene.name)).collect::<Vec<_>>())
    });
    let present: Vec<(&PlannerInfo, &String, Vec<&RunRecord>)> = every.filter(|(.., runs)| !runs.is_empty()).collect();
    let times: Vec<f64> = present.iter().flat_map(|(.., runs)| runs.iter().map(|r| 1e-6 * r.time_us)).collect();
    // Where no budget limits the time, the longest run tells what the axis must hold.
    let limits = results.planners.iter().filter_map(|p| p.budget.time_ms).map(|ms| 1e-3 * ms);
    let limit = limits.chain(times.iter().copied()).fold(0.0, f64::max);
    let mut out = format!("touchline version {}\nExperiment {name}\n", manifest.version);
    let mut properties = vec![format!("num_obstacles INTEGER = {}", scene.scene.obstacles.len())];
    properties.extend(scene.optimum.length.map(|optimum| format!("optimum REAL = {optimum}")));
    let mut line = |text: String| {
        out.push_str(&text);
        out.push('\n');
    };
    line(format!("{} experiment properties", properties.len()));
    properties.into_iter().for_each(&mut line);
    line(format!("Running on {}", word(&manifest.platform)));
    line(format!("Starting at {}", manifest.started.replace('T', " ").trim_end_matches('Z')));
    line(format!(
        "<<<|\nComparison {}, scene {}, lengths in {}\n{}; times are limited where a planner's budget says so\n|>>>",
        clean(&results.name),
        clean(&scene.scene.name),
        clean(&scene.scene.unit),
        memory.said,
    ));
    line(format!(
        "<<<|\n{}, {} processors, {} jobs, {} build\n|>>>",
        clean(&manifest.cpu),
        manifest.cores,
        manifest.jobs,
        manifest.profile
    ));
    line(format!("{} is the random seed", results.seed));
    line(format!("{limit} seconds per run\n{} MB per run\n{} runs per planner", memory.common, results.repeats));
    line(format!("{} seconds spent to collect the data", times.iter().sum::<f64>()));
    line(format!("1 enum type\n{STATUSES}\n{} planners", present.len()));
    for (planner, name, runs) in present {
        out.push_str(&planner_section(planner, name, &runs));
    }
    out
}

fn planner_section(planner: &PlannerInfo, name: &str, runs: &[&RunRecord]) -> String {
    let mut out = String::new();
    let settings: Vec<&str> = planner.settings.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    let _ = writeln!(out, "{name}\n{} common properties\nkind = {}", settings.len() + 1, clean(&planner.kind));
    settings.iter().for_each(|setting| out.push_str(&format!("{}\n", clean(setting))));
    let _ = writeln!(out, "{} properties for each run", PROPERTIES.len());
    PROPERTIES.iter().for_each(|(name, kind)| out.push_str(&format!("{name} {kind}\n")));
    let _ = writeln!(out, "{} runs", runs.len());
    for run in runs {
        values(run).iter().for_each(|value| out.push_str(&format!("{value}; ")));
        out.push('\n');
    }
    if runs.iter().any(|run| !run.progress.is_empty()) {
        let _ = writeln!(out, "3 progress properties for each run\nbest cost REAL\ntime REAL\nevaluations INTEGER");
        let _ = writeln!(out, "{} runs", runs.len());
        for run in runs {
            // A time is a key of the database: of several improvements at one time the last one counts.
            let last_of_its_time = |(i, p): &(usize, &crate::results::Progress)| {
                run.progress.get(i + 1).is_none_or(|next| next.time_us != p.time_us)
            };
            for (_, p) in run.progress.iter().enumerate().filter(last_of_its_time) {
                let _ = write!(out, "{},{},{},;", p.cost, 1e-6 * p.time_us, p.evaluations);
            }
            out.push('\n');
        }
    }
    out.push_str(".\n");
    out
}

/// The values of [`PROPERTIES`].
fn values(run: &RunRecord) -> [String; PROPERTIES.len()] {
    let number = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    let flag = |value: bool| u8::from(value).to_string();
    [
        flag(run.valid),
        flag(run.valid),
        status(run).to_string(),
        (1e-6 * run.time_us).to_string(),
        (1e-6 * run.cpu_us).to_string(),
        if run.valid { number(run.length) } else { "inf".to_owned() },
        if run.valid { number(run.gap) } else { "inf".to_owned() },
        number(run.clearance_min),
        number(run.turning),
        number(run.cost),
        run.iterations.to_string(),
        run.evaluations.to_string(),
        run.collision_checks.to_string(),
        run.repeat.to_string(),
        run.seed.to_string(),
    ]
}

/// OMPL's number for how a run ended. A path that the judge accepts is an exact solution, whatever ended the
/// run; one that it refuses is but an approximate one.
fn status(run: &RunRecord) -> u8 {
    match run.status {
        _ if run.valid => 6,
        RunStatus::Solved | RunStatus::BudgetSpent if !run.path.is_empty() => 5,
        RunStatus::BudgetSpent | RunStatus::Timeout => 4,
        RunStatus::Crashed | RunStatus::OutOfMemory => 7,
        RunStatus::NotFound => 8,
        RunStatus::Infeasible => 9,
        RunStatus::Solved | RunStatus::Error => 0,
    }
}

/// A name as one word that is also a file's.
fn word(name: &str) -> String {
    let safe = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    let word: String = name.chars().map(safe).collect();
    if word.starts_with('.') { format!("_{word}") } else { word }
}

/// Text on one line.
fn clean(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// The names, numbered where they would meet if case did not count.
fn unique(names: impl Iterator<Item = String>) -> Vec<String> {
    let mut taken = BTreeSet::new();
    let mut number = |name: String| {
        let numbered = (2..).map(|n| format!("{name}_{n}"));
        let free = std::iter::once(name.clone()).chain(numbered).find(|n| taken.insert(n.to_lowercase()));
        free.expect("there are more numbers than names")
    };
    names.map(&mut number).collect()
}

#[cfg(test)]
mod tests;
