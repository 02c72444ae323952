//! `cargo bench --bench deadlines`: do planners that claim real time keep a deadline?
//!
//! 10⁵ calls of `plan_into` a planner, on 100 generated instants of an 11-against-11
//! game in turn, a new seed each call, with a deadline of 1 ms. Wall time of a call
//! is what a robot sees; what other processes took from this thread meanwhile (wall
//! time less the thread's processor time) is no planner's doing, so an overshoot is
//! given without it as well. Before, calls without deadline let buffers grow to their size;
//! allocations are counted from then on.
//!
//! `-- --calls 2000` is a quick look, `-- --planner pso` one planner of the
//! catalogue, whether it claims real time or not.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use cpu_time::ThreadTime;
use planner_api::{Budget, Plan, Planner, Problem, Run, Status};
use planner_catalogue::{build_str, kinds};
use touchline_tests::report::{cpu, option, print_table, time};
use touchline_tests::scenes;
use touchline_tests::statistics::quantile;

const CALLS: usize = 100_000;
const SCENES: u32 = 100;
/// Calls without deadline on each scene, before anything is counted.
const WARM_UP: u64 = 3;
const DEADLINE: Duration = Duration::from_millis(1);
/// How often progress is printed.
const PROGRESS: Duration = Duration::from_secs(10);

/// What a planner's calls were like; times in µs.
#[derive(Default)]
struct Calls {
    /// From the call to its end.
    wall: Vec<f64>,
    /// Beyond the deadline, 0 for calls in time.
    late: Vec<f64>,
    /// The same less the time in which the thread did not run.
    late_own: Vec<f64>,
    /// Calls that returned a free path, finished or not.
    free: usize,
    allocations: u64,
}

fn call(planner: &mut dyn Planner, problem: &Problem<'_>, seed: u64, plan: &mut Plan, calls: &mut Calls) {
    let us = |time: Duration| time.as_secs_f64() * 1e6;
    let mut status = Ok(Status::NotFound);
    let processor = ThreadTime::now();
    let begin = Instant::now();
    let deadline = begin + DEADLINE;
    let allocations = allocation_counter::measure(|| {
        let budget = Budget { deadline: Some(deadline), ..Budget::default() };
        status = planner.plan_into(problem, &mut Run::new(seed).with_budget(budget), plan);
    });
    let end = Instant::now();
    let taken = (end - begin).saturating_sub(processor.elapsed());
    calls.wall.push(us(end - begin));
    calls.late.push(us(end.saturating_duration_since(deadline)));
    calls.late_own.push(us(end.saturating_duration_since(deadline).saturating_sub(taken)));
    calls.allocations += allocations.count_total;
    status.expect("a problem that it supports");
    calls.free += usize::from(!plan.path.is_empty() && problem.world.path_free(&plan.path));
}

fn measure(name: &str, number: usize, problems: &[Problem<'_>]) -> Calls {
    let mut planner = build_str(name, "").unwrap_or_else(|e| panic!("{e}")).planner;
    let mut plan = Plan::new();
    for (problem, seed) in problems.iter().flat_map(|problem| (0..WARM_UP).map(move |seed| (problem, seed))) {
        let status = planner.plan_into(problem, &mut Run::new(seed), &mut plan);
        status.expect("a problem that it supports");
    }
    let mut calls = Calls::default();
    let (begin, mut printed) = (Instant::now(), Instant::now());
    for (made, problem) in (0..number).zip(problems.iter().cycle()) {
        call(planner.as_mut(), problem, WARM_UP + made as u64, &mut plan, &mut calls);
        if printed.elapsed() > PROGRESS {
            printed = Instant::now();
            let left = begin.elapsed().as_secs_f64() * (number - made) as f64 / (made + 1) as f64;
            println!("{name}: {made} of {number} calls, {left:.0} s left");
        }
    }
    calls
}

fn complain(what: &str) -> ExitCode {
    eprintln!("error: {what}");
    ExitCode::from(2)
}

fn main() -> ExitCode {
    let number = match option("--calls").map(|n| n.parse()) {
        None => CALLS,
        Some(Ok(number)) if number > 0 => number,
        Some(_) => return complain("--calls takes a whole number above 0"),
    };
    let only = option("--planner");
    if let Some(name) = &only
        && kinds().iter().all(|kind| kind.name != name)
    {
        let names: Vec<_> = kinds().iter().map(|kind| kind.name).collect();
        return complain(&format!("unknown planner {name:?}; expected one of {}", names.join(", ")));
    }
    let scenes = scenes::games(SCENES);
    let worlds: Vec<_> = scenes.iter().map(scenes::world).collect();
    let problems: Vec<Problem<'_>> = worlds
        .iter()
        .zip(&scenes)
        .map(|(world, scene)| Problem::new(world, scene.start(), scene.goal()).expect("a free start and goal"))
        .collect();
    let mut rows = Vec::new();
    for kind in kinds() {
        if !only.as_ref().map_or(kind.real_time, |name| kind.name == name) {
            continue;
        }
        let Calls { mut wall, mut late, mut late_own, free, allocations } = measure(kind.name, number, &problems);
        let overshot = late.iter().filter(|us| **us > 0.0).count();
        for times in [&mut wall, &mut late, &mut late_own] {
            times.sort_by(f64::total_cmp);
        }
        let share = |count: usize| format!("{:.1} %", 100.0 * count as f64 / number as f64);
        let at = |times: &[f64], q: f64| match quantile(times, q) {
            0.0 => "–".to_owned(),
            us => time(us),
        };
        rows.push([
            kind.name.to_owned(),
            at(&wall, 0.5),
            at(&wall, 0.99),
            at(&wall, 0.999),
            at(&wall, 1.0),
            share(free),
            share(overshot),
            at(&late_own, 0.99),
            at(&late_own, 0.999),
            at(&late_own, 1.0),
            at(&late, 1.0),
            allocations.to_string(),
        ]);
        println!("{}: {number} calls done", kind.name);
    }
    println!("\n{}; {number} calls a planner, deadline {}\n", cpu(), time(DEADLINE.as_secs_f64() * 1e6));
    print_table(
        [
            "planner",
            "p50",
            "p99",
            "p99.9",
            "maximum",
            "free path",
            "late",
            "late by: p99",
            "p99.9",
            "maximum",
            "with others’ work",
            "allocations",
        ],
        &rows,
    );
    ExitCode::SUCCESS
}
