//! `touchline run`.

use std::path::Path;
use std::process::ExitCode;

use super::output::{self, Claim, Found};
use super::session::{self, Place};
use super::{FailOn, RunArgs, say, warn};
use crate::campaign::Campaign;
use crate::config::{Comparison, Disk, EMBEDDED_NAME, Embedded, External, Maker, play_name};
use crate::differences::{Signature, differences};
use crate::error::Error;
use crate::estimate::{self, Estimate};
use crate::results::{Results, RunStatus, Subject};
use crate::store::{Store, Stored};
use crate::table;
use crate::work::{Shard, Work};

pub(super) fn run(args: &RunArgs) -> Result<ExitCode, Error> {
    let campaign = campaign(args)?;
    if args.isolate && campaign.comparison.subject != Subject::Paths {
        let message = "--isolate: what moves runs in the bench's own process; expected a comparison of paths";
        return Err(Error::Usage(message.to_owned()));
    }
    let mut work = Work { isolate: args.isolate, ..Work::all(usize::from(args.jobs)) };
    work.shard = args.shard.unwrap_or(Shard::WHOLE);
    let (folder, place) = if args.resume {
        let folder = args.out.clone().unwrap_or_else(|| output::usual(&part_name(args, &campaign)));
        // A dry run locks and creates nothing.
        let found = if args.dry_run { None } else { Some(output::find(&folder)?) };
        let kept = if Store::is_blank(&folder)? { None } else { Some(Store::open(&folder)?) };
        let head = kept.as_ref().map(|store| going_on(&folder, store, args, &campaign, &mut work)).transpose()?;
        let place = match (found, head) {
            (Some(Found::Nothing(claim)), _) => Some(Place::New(claim)),
            (Some(Found::Campaign(lock)), Some(head)) => Some(Place::Old(lock, Box::new(head))),
            _ => None,
        };
        (folder, place)
    } else {
        (output::choose(args.out.as_deref(), &part_name(args, &campaign))?, None)
    };
    if !args.quiet {
        introduce(&campaign, &work);
    }
    let units = work.shard.size(campaign.arenas.len() * campaign.comparison.repeats as usize);
    if work.done.len() < units * campaign.comparison.planners.len() {
        find_programs(&campaign.comparison)?;
    }
    if args.dry_run {
        if !args.quiet {
            describe(&campaign, &work, &folder);
        }
        return Ok(ExitCode::SUCCESS);
    }
    let (folder, place) = match place {
        Some(place) => (folder, place),
        None => {
            let claim = Claim::new(args.out.as_deref(), &part_name(args, &campaign))?;
            (claim.folder().to_owned(), Place::New(claim))
        }
    };
    let results = session::carry_out(&campaign, &folder, place, &work, args.quiet)?;
    if !args.quiet {
        say("");
        say(table::render(&results));
        doubts(&results);
        say(format!("Results: {}", folder.join("report.html").display()));
    }
    let failed = args.fail_on.is_some_and(|what| {
        results.runs.iter().any(|run| match what {
            FailOn::Invalid => !run.valid,
            FailOn::Error => run.status == RunStatus::Error || run.status.is_killed(),
        })
    });
    Ok(ExitCode::from(u8::from(failed)))
}

/// The campaign that is asked for: of a file, of the folder in which to go on, or the embedded one.
fn campaign(args: &RunArgs) -> Result<Campaign, Error> {
    let mut comparison = match &args.out {
        Some(out) if args.resume && args.comparison.is_none() => {
            if Store::is_blank(out)? {
                // Not the embedded comparison: the folder's name may be mistyped.
                let nothing = format!("nothing to go on with in {}; name the comparison", out.display());
                return Err(Error::Usage(nothing));
            }
            Comparison::from_stored(&Store::open(out)?.head()?)?
        }
        _ => read(args.comparison.as_deref())?,
    };
    comparison.seed = args.seed.unwrap_or(comparison.seed);
    comparison.repeats = args.repeats.unwrap_or(comparison.repeats);
    if !args.planner.is_empty() {
        comparison.keep_planners(&args.planner).map_err(Error::Usage)?;
    }
    Campaign::new(comparison).map_err(|e| Error::Usage(e.to_string()))
}

/// External planners of a campaign from elsewhere cannot run here: an error, before that becomes their result.
fn find_programs(comparison: &Comparison) -> Result<(), Error> {
    for planner in &comparison.planners {
        if let Maker::External(External { folder, .. }) = &planner.maker
            && !folder.is_dir()
        {
            let (label, folder) = (&planner.label, folder.display());
            return Err(Error::Usage(format!(
                "planner {label}: no folder {folder}, in which its command is to run; name the comparison, \
                 whose folder then counts"
            )));
        }
    }
    Ok(())
}

/// Reads a comparison file, or the embedded one.
pub(super) fn read(file: Option<&Path>) -> Result<Comparison, Error> {
    let Some(file) = file else {
        return Ok(Comparison::from_toml(EMBEDDED_NAME, Embedded::COMPARISON, &Embedded)?);
    };
    let text = std::fs::read_to_string(file).map_err(Error::io("read", file))?;
    Ok(Comparison::from_toml(&file.display().to_string(), &text, &Disk::beside(file))?)
}

fn part_name(args: &RunArgs, campaign: &Campaign) -> String {
    output::part_name(&campaign.comparison.name, args.shard.unwrap_or(Shard::WHOLE))
}

/// Makes sure that `folder` holds this campaign and this part of it, and takes what is done out of `work`.
fn going_on(
    folder: &Path,
    store: &Store,
    args: &RunArgs,
    campaign: &Campaign,
    work: &mut Work,
) -> Result<Stored, Error> {
    let head = store.head()?;
    let manifest = &head.results.manifest;
    let foreign = |message: String| Err(Error::Foreign { path: folder.to_owned(), message });
    if manifest.identity != campaign.identity() {
        return foreign(format!(
            "holds another campaign, {:?} of {} (identity {}); asked for was: {}",
            head.results.name,
            manifest.started,
            manifest.identity,
            differences(&Signature::of(campaign), &Signature::of_stored(&head))
        ));
    }
    if let Some(asked) = args.shard.filter(|asked| *asked != manifest.part()) {
        return foreign(format!("holds part {} of the campaign; asked for was part {asked}", manifest.part()));
    }
    work.shard = manifest.part();
    work.done = campaign.done(&store.keys()?);
    if !args.quiet && manifest.finished.is_empty() && manifest.jobs > work.jobs {
        let jobs = manifest.jobs;
        warn(format_args!("note: runs were made with {jobs} jobs before: all times count as taken with as many"));
    }
    Ok(head)
}

/// Size, part, what is there already, and how long the rest may take.
fn introduce(campaign: &Campaign, work: &Work) {
    campaign.comparison.notes.iter().for_each(|note| warn(format_args!("note: {note}")));
    say(campaign.size(work.jobs));
    let estimate = Estimate::new(campaign, work);
    if !work.shard.is_whole() {
        say(format!("Part {}: {} of these runs.", work.shard, estimate.runs + work.done.len()));
    }
    if !work.done.is_empty() {
        say(format!("Going on: {} runs are there, {} are to be made.", work.done.len(), estimate.runs));
    }
    if estimate.runs > 0 {
        say(format!("Time: {}.", estimate.words()));
    }
}

fn describe(campaign: &Campaign, work: &Work, folder: &Path) {
    for planner in &campaign.comparison.planners {
        let budget = match planner.budget.words() {
            words if words.is_empty() => "no budget".to_owned(),
            words => format!("budget {words}"),
        };
        let limit = match work.isolate || planner.isolated() {
            true => format!(", ended after {}", estimate::duration(planner.hard_limit().as_secs_f64())),
            false => String::new(),
        };
        say(format!("  planner {} (kind {}; {budget}{limit})", planner.label, planner.kind));
    }
    for arena in &campaign.arenas {
        let (name, count) = (&arena.scene.name, arena.scene.obstacles.len());
        let what = match (&arena.simulation, &campaign.comparison.protocol) {
            (Some(s), _) => format!(
                "{} with {} robots and {} opponents, at most {} s at {} Hz",
                play_name(s),
                s.robots,
                s.opponents,
                s.duration_s,
                s.frame_rate
            ),
            (None, Some(p)) => format!("{} scenarios a run, {} to tune on", p.held_out, p.training),
            (None, None) => format!("{count} obstacles"),
        };
        say(format!("  scene {name} ({what}; {} set)", arena.set.name()));
    }
    say(format!("Would write to {}; nothing was run.", folder.display()));
}

/// What a reader of the table ought to know.
fn doubts(results: &Results) {
    let manifest = &results.manifest;
    if !manifest.shard.is_empty() {
        say(format!("This is part {} of the campaign; touchline merge joins the parts.", manifest.shard));
    }
    if manifest.jobs > 1 {
        say(format!("Times were taken with {} jobs at once: compare them with care.", manifest.jobs));
    }
    if manifest.profile == "debug" {
        say("Times are of a debug build.");
    }
    // 1e-9 is far above the rounding of a sum of a hundred lengths, and below any gap of interest.
    if let Some(run) = results.runs.iter().find(|r| r.gap.is_some_and(|gap| gap < -1e-9)) {
        let what = match results.subject {
            Subject::Simulation => "arrived sooner than the lower bound allows",
            _ => "found a valid path shorter than the optimum",
        };
        let (planner, scene, repeat) = (&run.planner, &run.scene, run.repeat);
        warn(format_args!("warning: {planner} {what} in {scene} (repeat {repeat}): please report this"));
    }
    let errors = results.runs.iter().filter(|r| r.error.is_some()).count();
    if errors > 0 {
        warn(format_args!("warning: {errors} runs ended in errors: see the column error of runs.csv"));
    }
}
