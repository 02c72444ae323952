//! The runs of a campaign, made from its beginning or from where it was interrupted, down to the exports.

use std::path::Path;

use super::say;
use crate::campaign::Campaign;
use crate::error::Error;
use crate::export::{self, Formats};
use crate::lock::Lock;
use crate::progress::Progress;
use crate::report::Language;
use crate::results::{Manifest, Results, Session};
use crate::shell::quoted;
use crate::store::{Store, Stored};
use crate::work::Work;
use crate::{machine, replay, runner};

use super::output::Claim;

/// A campaign's folder, which no other process writes into.
pub(super) enum Place {
    /// Nothing is there yet.
    New(Claim),
    /// A campaign, without its runs, that may lack some; unlocked only where it is complete and nothing can be written.
    Old(Option<Lock>, Box<Stored>),
}

/// Makes the runs of `work` and whatever else is missing in `folder`.
pub(super) fn carry_out(
    campaign: &Campaign,
    folder: &Path,
    place: Place,
    work: &Work,
    quiet: bool,
) -> Result<Results, Error> {
    // Not to be given back before everything is written.
    let (head, mut store, _lock) = match place {
        Place::New(claim) => {
            let mut results = campaign.empty_results(work.jobs);
            begin(&mut results.manifest, work);
            let store = Store::create(claim.folder(), campaign, &results)?;
            (campaign.stored(&results), store, claim.keep())
        }
        Place::Old(lock, mut head) => {
            let manifest = &mut head.results.manifest;
            if !manifest.finished.is_empty() {
                return finished(folder, quiet);
            }
            resume(manifest, work);
            let store = Store::resume(folder, manifest).map_err(|e| interrupted(e, &head.results, work, folder, 0))?;
            (*head, store, lock)
        }
    };
    let mut made = 0;
    make(campaign, &head.results, &mut store, work, quiet, &mut made)
        .map_err(|e| interrupted(e, &head.results, work, folder, made))?;
    drop(store);
    write_exports(folder)
}

/// The runs, the pictures, and last of all the mark that the campaign is complete.
fn make(
    campaign: &Campaign,
    head: &Results,
    store: &mut Store,
    work: &Work,
    quiet: bool,
    made: &mut usize,
) -> Result<(), Error> {
    let optima: Vec<Option<f64>> = head.scenes.iter().map(|s| s.optimum.length).collect();
    let mut progress = Progress::new(head.planned(), work.done.len(), quiet);
    runner::run(campaign, &optima, work, |record| {
        store.add(&record)?;
        *made += 1;
        progress.step();
        Ok(())
    })?;
    progress.finish();
    let mut manifest = head.manifest.clone();
    manifest.finished = machine::now();
    if let Some(session) = manifest.sessions.last_mut() {
        session.finished.clone_from(&manifest.finished);
    }
    // After the last timed run, so that no picture is taken at its expense.
    let runs = store.read()?.results.runs;
    store.add_snapshots(&replay::snapshots(campaign, &runs))?;
    store.add_traces(&replay::traces(campaign, &runs))?;
    store.finish(&manifest)
}

fn begin(manifest: &mut Manifest, work: &Work) {
    manifest.shard = work.shard.name();
    manifest.isolated = work.isolate;
    manifest.sessions = vec![session(work, manifest.started.clone())];
}

fn session(work: &Work, started: String) -> Session {
    let (finished, runs_before) = (String::new(), work.done.len());
    Session { started, finished, runs_before, jobs: work.jobs, isolated: work.isolate }
}

/// The manifest of a campaign that goes on, here and now.
fn resume(manifest: &mut Manifest, work: &Work) {
    let here = machine::manifest(work.jobs);
    manifest.resumed += 1;
    manifest.jobs = manifest.jobs.max(work.jobs);
    manifest.isolated &= work.isolate;
    manifest.sessions.push(session(work, here.started.clone()));
    let [now, before] =
        [&here, &*manifest].map(|m| format!("{} ({} cores, {}, {})", m.cpu, m.cores, m.platform, m.profile));
    let note = format!("Resumed on {now} after {before}: times of different machines are not comparable.");
    if now != before && !manifest.notes.contains(&note) {
        manifest.notes.push(note);
    }
}

/// What is there of a campaign that is complete; exports are made again unless they are there.
fn finished(folder: &Path, quiet: bool) -> Result<Results, Error> {
    let stored = Store::open(folder)?.read()?;
    if !quiet {
        say(format!("Nothing is missing: it was finished at {}.", stored.results.manifest.finished));
    }
    if export::are_made(folder, &stored) { Ok(stored.results) } else { write_exports(folder) }
}

/// Makes every export from the store, as `report` does it: what is exported is what was kept.
pub(super) fn write_exports(folder: &Path) -> Result<Results, Error> {
    let stored = Store::open(folder)?.read()?;
    let written = export::write(folder, &stored, Formats::OWN, Language::English);
    written.map_err(|source| Error::Interrupted {
        source: Box::new(source),
        kept: format!("all {} runs are kept in {}", stored.results.runs.len(), folder.display()),
        what: "make the exports",
        command: format!("touchline report {}", quoted(&folder.display().to_string())),
    })?;
    Ok(stored.results)
}

/// What ended a campaign early, and how to go on.
fn interrupted(source: Error, head: &Results, work: &Work, folder: &Path, made: usize) -> Error {
    let isolate = if work.isolate { " --isolate" } else { "" };
    let jobs = if work.jobs > 1 { format!(" --jobs {}", work.jobs) } else { String::new() };
    Error::Interrupted {
        source: Box::new(source),
        kept: format!("{} of {} runs are kept in {}", work.done.len() + made, head.planned(), folder.display()),
        what: "go on",
        command: format!("touchline run --out {} --resume{jobs}{isolate}", quoted(&folder.display().to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_campaign_that_goes_on_keeps_its_history() {
        let done = (0..3).map(|repeat| (0, 0, repeat)).collect();
        let first = Work { isolate: true, ..Work::all(4) };
        let mut manifest = machine::manifest(4);
        begin(&mut manifest, &first);
        let started = manifest.started.clone();
        resume(&mut manifest, &Work { done, ..Work::all(2) });
        assert_eq!((manifest.jobs, manifest.resumed, manifest.isolated), (4, 1, false));
        assert_eq!((&manifest.started, manifest.notes.len()), (&started, 0), "the same machine");
        let sessions: Vec<_> = manifest.sessions.iter().map(|s| (s.runs_before, s.jobs, s.isolated)).collect();
        assert_eq!(sessions, [(0, 4, true), (3, 2, false)]);
        manifest.cpu = "another".into();
        resume(&mut manifest, &first);
        assert!(manifest.notes[0].contains("after another ("), "{:?}", manifest.notes);
    }
}
