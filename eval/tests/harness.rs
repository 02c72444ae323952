//! What the bench itself costs. The figures of the machine at hand, in release:
//! `cargo test -p eval --release --test harness -- --ignored --nocapture`.

mod common;

use std::time::Instant;

use common::Place;
use eval::campaign::{Campaign, micros};
use eval::config::{Comparison, Disk};
use eval::runner;
use eval::store::Store;
use eval::verdict::Judge;
use eval::work::Work;

/// A place with the scene of 2012.
fn furnished(name: &str) -> Place {
    let place = Place::new(name);
    place.write("scene.toml", include_str!("../../configs/scenes/lu-sun-2012.toml"));
    place
}

impl Place {
    /// One planner in the scene of 2012.
    fn comparison(&self, planner: &str, repeats: u32) -> String {
        let text = format!(
            "name = \"harness\"\nrepeats = {repeats}\nscenes = [\"scene.toml\"]\n
            [planner.{planner}]\n"
        );
        self.write("harness.toml", &text);
        text
    }

    fn campaign(&self, planner: &str, repeats: u32) -> Campaign {
        let file = self.0.join("harness.toml");
        let text = self.comparison(planner, repeats);
        Campaign::new(Comparison::from_toml("harness.toml", &text, &Disk::beside(&file)).unwrap()).unwrap()
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
fn reaching_a_process_takes_less_than_a_millisecond() {
    let place = furnished("overhead");
    place.comparison("straight-line", 1000);
    let run = ["run", "harness.toml", "--out", "out", "--quiet", "--isolate"];
    place.ok(&run);
    let runs = Store::open(&place.0.join("out")).unwrap().read().unwrap().results.runs;
    let overheads: Vec<f64> = runs.iter().map(|run| run.overhead_us.expect("isolated")).collect();
    assert_eq!(overheads.len(), 1000);
    let median = median(overheads);
    println!("overhead of isolation: median {median:.0} µs");
    // The promise is for a release build on a machine of its own; another build, and tests beside it, get ten times.
    let most = if cfg!(debug_assertions) { 10_000.0 } else { 1000.0 };
    assert!(median <= most, "{median} µs");
}

#[test]
#[ignore = "a figure for a quiet machine, in release"]
fn a_run_costs_the_bench_less_than_a_tenth_of_a_millisecond() {
    let place = furnished("own-time");
    let campaign = place.campaign("straight-line", 10_000);
    let results = campaign.empty_results(1);
    let optima: Vec<Option<f64>> = results.scenes.iter().map(|s| s.optimum.length).collect();
    let mut store = Store::create(&place.0, &campaign, &results).unwrap();
    let mut runs = Vec::with_capacity(10_000);
    let mut stored_us = 0.0;
    let began = Instant::now();
    runner::run(&campaign, &optima, &Work::all(1), |run| {
        let began = Instant::now();
        let stored = store.add(&run);
        stored_us += micros(began);
        runs.push(run);
        stored
    })
    .unwrap();
    let all_us = micros(began);
    let began = Instant::now();
    for run in &runs {
        let judge = Judge::new(&campaign.arenas[0].scene);
        std::hint::black_box(runner::judged(run.clone(), &judge, optima[0]));
    }
    let judged_us = micros(began);
    let planned_us: f64 = runs.iter().map(|run| run.time_us).sum();
    let count = runs.len() as f64;
    let own_us = (all_us - planned_us - judged_us) / count;
    println!(
        "a run: {:.1} µs in all, {:.1} planning, {:.1} verification, {:.1} storing, {own_us:.1} the bench's own with storing",
        all_us / count,
        planned_us / count,
        judged_us / count,
        stored_us / count,
    );
    assert!(own_us <= 100.0, "{own_us} µs");
}

#[test]
#[ignore = "a figure for a quiet machine, in release"]
fn two_jobs_do_nearly_twice_the_work() {
    let place = furnished("throughput");
    let campaign = place.campaign("pso", 400);
    let seconds = |jobs| {
        let began = Instant::now();
        runner::run(&campaign, &[None], &Work::all(jobs), |_| Ok(())).unwrap();
        began.elapsed().as_secs_f64()
    };
    // Best of three: others' work only ever makes it slower.
    let best = |jobs| (0..3).map(|_| seconds(jobs)).fold(f64::INFINITY, f64::min);
    let (one, two) = (best(1), best(2));
    println!("400 runs of pso: {one:.2} s with one job, {two:.2} s with two: {:.2} times the throughput", one / two);
    assert!(one / two >= 1.8, "{}", one / two);
}
