//! `touchline run`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::{FailOn, RunArgs, output, say};
use crate::campaign::Campaign;
use crate::config::{Comparison, Disk, EMBEDDED_NAME, Embedded};
use crate::error::Error;
use crate::export::{self, Formats};
use crate::progress::Progress;
use crate::report::Language;
use crate::results::{Results, RunStatus};
use crate::store::Store;
use crate::work::Work;
use crate::{machine, replay, runner, table};

pub(super) fn run(args: &RunArgs) -> Result<ExitCode, Error> {
    for (asked, what) in [(args.resume, "--resume"), (args.shard.is_some(), "--shard")] {
        if asked {
            return Err(Error::NotYet(what.to_owned()));
        }
    }
    let mut comparison = read(args.comparison.as_deref())?;
    comparison.seed = args.seed.unwrap_or(comparison.seed);
    comparison.repeats = args.repeats.unwrap_or(comparison.repeats);
    if !args.planner.is_empty() {
        comparison.keep_planners(&args.planner).map_err(Error::Usage)?;
    }
    let campaign = Campaign::new(comparison).map_err(|e| Error::Usage(e.to_string()))?;
    let jobs = usize::from(args.jobs);
    let folder = output::choose(args.out.as_deref(), &campaign.comparison.name)?;
    if !args.quiet {
        campaign.comparison.notes.iter().for_each(|note| eprintln!("note: {note}"));
        say(campaign.size(jobs));
    }
    if args.dry_run {
        if !args.quiet {
            dry_run(&campaign, &folder);
        }
        return Ok(ExitCode::SUCCESS);
    }
    let work = Work { isolate: args.isolate, ..Work::all(jobs) };
    let (folder, results) = carry_out(&campaign, args.out.as_deref(), &work, args.quiet)?;
    if !args.quiet {
        say("");
        say(table::render(&results));
        doubts(&results, jobs);
        say(format!("Results: {}", folder.join("report.html").display()));
    }
    let failed = args.fail_on.is_some_and(|what| {
        results.runs.iter().any(|run| match what {
            FailOn::Invalid => !run.valid,
            FailOn::Error => {
                use RunStatus::{Crashed, Error, OutOfMemory, Timeout};
                matches!(run.status, Error | Crashed | Timeout | OutOfMemory)
            }
        })
    });
    Ok(ExitCode::from(u8::from(failed)))
}

/// Reads a comparison file, or the embedded one.
pub(super) fn read(file: Option<&Path>) -> Result<Comparison, Error> {
    let Some(file) = file else {
        return Ok(Comparison::from_toml(EMBEDDED_NAME, Embedded::COMPARISON, &Embedded)?);
    };
    let text = std::fs::read_to_string(file).map_err(Error::io("read", file))?;
    Ok(Comparison::from_toml(&file.display().to_string(), &text, &Disk::beside(file))?)
}

fn dry_run(campaign: &Campaign, folder: &Path) {
    for planner in &campaign.comparison.planners {
        say(format!("  planner {} (kind {})", planner.label, planner.kind));
    }
    for arena in &campaign.arenas {
        say(format!("  scene {} ({} obstacles)", arena.scene.name, arena.scene.obstacles.len()));
    }
    say(format!("Would write to {}; nothing was run.", folder.display()));
}

fn carry_out(campaign: &Campaign, out: Option<&Path>, work: &Work, quiet: bool) -> Result<(PathBuf, Results), Error> {
    let claim = output::Claim::new(out, &campaign.comparison.name)?;
    let results = campaign.empty_results(work.jobs);
    let mut store = Store::create(claim.folder(), campaign, &results)?;
    let folder = claim.keep();
    let optima: Vec<Option<f64>> = results.scenes.iter().map(|s| s.optimum.length).collect();
    let mut progress = Progress::new(campaign.run_count(), quiet);
    runner::run(campaign, &optima, work, |record| {
        progress.step();
        store.add(&record)
    })?;
    progress.finish();
    let mut manifest = results.manifest;
    manifest.finished = machine::now();
    // After the last timed run, so that no picture is taken at its expense.
    store.add_snapshots(&replay::snapshots(campaign, &store.read()?.results.runs))?;
    store.finish(&manifest)?;
    // From the store, as `report` does it: what is exported is what was kept.
    let stored = store.read()?;
    export::write(&folder, &stored, Formats::OWN, Language::English)?;
    Ok((folder, stored.results))
}

/// What a reader of the table ought to know.
fn doubts(results: &Results, jobs: usize) {
    if jobs > 1 {
        say(format!("Times were taken with {jobs} jobs at once: compare them with care."));
    }
    if results.manifest.profile == "debug" {
        say("Times are of a debug build.");
    }
    // 1e-9 is far above the rounding of a sum of a hundred lengths, and below any gap of interest.
    if let Some(run) = results.runs.iter().find(|r| r.gap.is_some_and(|gap| gap < -1e-9)) {
        eprintln!(
            "warning: {} found a valid path shorter than the optimum in {} (repeat {}): please report this",
            run.planner, run.scene, run.repeat
        );
    }
    let errors = results.runs.iter().filter(|r| r.error.is_some()).count();
    if errors > 0 {
        eprintln!("warning: {errors} runs ended in errors: see the column error of runs.csv");
    }
}
