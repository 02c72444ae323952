//! `cargo bench --bench instructions`: instructions a call of the hot kernels, which repeat exactly.
//!
//! Runs itself under `valgrind --tool=callgrind` with N and with 2 N calls; (I(2N) − I(N))/N
//! leaves out the building of scenes and the first growth of buffers, since the
//! second N calls repeat the seeds of the first. Each figure stands beside that of
//! `tests/reference/instructions.csv`, with the change in percent; `-- --write` replaces
//! that file. Valgrind emulates AVX2 at most, so wider kernels are not counted; figures
//! change with the compiler as well as with the code, and say nothing of cache misses.

use std::env;
use std::fmt::Write as _;
use std::fs;
use std::hint::black_box;
use std::process::{Command, ExitCode};

use planner_api::{Plan, Problem, Run};
use planner_catalogue::build_str;
use touchline_tests::random::Robots;
use touchline_tests::report::{flag, in_repository, option, print_table, vector_units, write};
use touchline_tests::scenes;

const CSV: &str = "tests/reference/instructions.csv";

/// What one call does.
enum Work {
    /// [`env_model::World::segment_free`] among so many robots.
    Segment { robots: usize },
    /// A planner of the catalogue on a reference scene.
    Plan { kind: &'static str, settings: &'static str, scene: &'static str },
}

struct Kernel {
    name: &'static str,
    work: Work,
    /// N: so many that a call more or less of the buffers' growth is nothing.
    calls: u64,
}

const fn plan(
    name: &'static str,
    kind: &'static str,
    settings: &'static str,
    scene: &'static str,
    calls: u64,
) -> Kernel {
    Kernel { name, work: Work::Plan { kind, settings, scene }, calls }
}

/// The convex refinement of a straight line, on the swarm's columns.
const CLARABEL: &str = "refine = [{ kind = \"qp\", columns = 20 }]";
const STRUCTURED: &str = "refine = [{ kind = \"qp\", columns = 20, solver = \"structured\" }]";

const KERNELS: &[Kernel] = &[
    Kernel { name: "segment_free: 22 discs", work: Work::Segment { robots: 22 }, calls: 4096 },
    Kernel { name: "segment_free: 100000 discs", work: Work::Segment { robots: 100_000 }, calls: 4096 },
    plan("pso: 20 particles and 400 iterations", "pso", "", "paper", 10),
    plan("tangent: paper", "tangent", "", "paper", 100),
    plan("tangent: wall-00", "tangent", "", "wall-00", 50),
    plan("tangent: dense-0", "tangent", "", "dense-0", 20),
    plan("rrt-connect: paper", "rrt-connect", "", "paper", 200),
    plan("qp with clarabel: paper", "straight-line", CLARABEL, "paper", 10),
    plan("qp with structured: paper", "straight-line", STRUCTURED, "paper", 10),
];

impl Kernel {
    /// Makes `calls` calls, which cycle through this kernel's N inputs.
    fn run(&self, calls: u64) -> Result<(), String> {
        match self.work {
            Work::Segment { robots } => {
                let Robots { world, segments, .. } = Robots::new(robots);
                for call in 0..calls {
                    let (a, b) = segments[(call % self.calls) as usize];
                    black_box(world.segment_free(black_box(a), black_box(b)));
                }
            }
            Work::Plan { kind, settings, scene } => {
                let mut planner = build_str(kind, settings).map_err(|e| e.to_string())?.planner;
                let scene = scenes::reference(scene);
                let world = scenes::world(&scene);
                let problem = Problem::new(&world, scene.start(), scene.goal()).map_err(|e| e.to_string())?;
                let mut plan = Plan::new();
                for call in 0..calls {
                    let mut run = Run::new(call % self.calls);
                    let _ = black_box(planner.plan_into(black_box(&problem), &mut run, &mut plan));
                }
            }
        }
        Ok(())
    }

    /// All instructions of a process that makes `calls` calls.
    fn count(&self, calls: u64) -> Result<u64, String> {
        let own = env::current_exe().map_err(|e| e.to_string())?;
        let output = Command::new("valgrind")
            .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
            .arg(own)
            .args(["--kernel", self.name, "--times", &calls.to_string()])
            .output()
            .map_err(|e| e.to_string())?;
        let said = String::from_utf8_lossy(&output.stderr);
        if !output.status.success() {
            return Err(said.lines().find(|line| !line.starts_with("==")).unwrap_or("valgrind failed").to_owned());
        }
        let collected = said.lines().find_map(|line| line.split_once("Collected :")?.1.trim().parse().ok());
        collected.ok_or_else(|| "valgrind counted nothing".to_owned())
    }

    /// Instructions a call.
    fn per_call(&self) -> Result<u64, String> {
        Ok((self.count(2 * self.calls)? - self.count(self.calls)?) / self.calls)
    }
}

/// What a program prints of its version; `None` when it is not there.
fn version(program: &str) -> Option<String> {
    let output = Command::new(program).arg("--version").output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    Some(text.split(" (").next()?.trim().to_owned())
}

/// The vector units that a program under valgrind finds.
fn emulated_units() -> Option<String> {
    let own = env::current_exe().ok()?;
    let output = Command::new("valgrind").args(["--tool=none", "-q"]).arg(own).arg("--units").output().ok()?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}

/// What the committed table says of `kernel`.
fn committed(table: &str, kernel: &str) -> Option<u64> {
    table.lines().find_map(|line| line.strip_prefix(kernel)?.strip_prefix(',')?.split(',').next()?.parse().ok())
}

fn all() -> Result<(), String> {
    let Some(valgrind) = version("valgrind") else {
        println!("valgrind is not installed: no instructions counted");
        return Ok(());
    };
    let compiler = version("rustc").unwrap_or_else(|| "rustc".to_owned());
    let units = emulated_units().ok_or("valgrind does not start this program")?;
    println!("{valgrind}, {compiler}, vector units {units}");
    let before = fs::read_to_string(in_repository(CSV)).unwrap_or_default();
    let mut table = "kernel,instructions a call,valgrind,compiler,vector units\n".to_owned();
    let mut rows = Vec::new();
    for kernel in KERNELS {
        let count = match kernel.per_call() {
            Ok(count) => count,
            Err(why) => {
                println!("{}: left out, {}", kernel.name, why.split(", expected").next().unwrap_or(&why));
                continue;
            }
        };
        let _ = writeln!(table, "{},{count},{valgrind},{compiler},{units}", kernel.name);
        let (old, change) = match committed(&before, kernel.name) {
            Some(old) => (old.to_string(), format!("{:+.2} %", 100.0 * (count as f64 / old as f64 - 1.0))),
            None => ("–".to_owned(), "–".to_owned()),
        };
        println!("{}: {count}", kernel.name);
        rows.push([kernel.name.to_owned(), count.to_string(), old, change]);
    }
    println!();
    print_table(["kernel", "instructions a call", "committed", "change"], &rows);
    if flag("--write") {
        write(CSV, &table);
    }
    Ok(())
}

fn main() -> ExitCode {
    let done = match option("--kernel") {
        Some(name) => KERNELS
            .iter()
            .find(|kernel| kernel.name == name)
            .ok_or_else(|| format!("no kernel {name}"))
            .and_then(|kernel| kernel.run(option("--times").and_then(|n| n.parse().ok()).unwrap_or(kernel.calls))),
        None if flag("--units") => {
            println!("{}", vector_units().join(" "));
            Ok(())
        }
        None => all(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}
