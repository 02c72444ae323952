//! `touchline merge`.

use std::path::PathBuf;
use std::process::ExitCode;

use super::output::Claim;
use super::{MergeArgs, say, session};
use crate::campaign::Campaign;
use crate::config::Comparison;
use crate::error::Error;
use crate::merge::{self, Part};
use crate::shell::quoted;
use crate::store::Store;
use crate::{replay, table};

pub(super) fn merge(args: &MergeArgs) -> Result<ExitCode, Error> {
    let part = |folder: &PathBuf| Ok(Part { stored: Store::open(folder)?.read()?, folder: folder.clone() });
    let parts: Vec<Part> = args.dirs.iter().map(part).collect::<Result<_, Error>>()?;
    let mut merged = merge::merge(parts)?;
    if merged.missing.is_empty() {
        let comparison = Comparison::from_stored(&merged.stored)?;
        let campaign = Campaign::new(comparison).map_err(|e| Error::Usage(e.to_string()))?;
        let results = &mut merged.stored.results;
        results.snapshots = replay::snapshots(&campaign, &results.runs);
        results.traces = replay::traces(&campaign, &results.runs);
    }
    let name = &merged.stored.results.name;
    let claim = Claim::new(Some(&args.out), name)?;
    drop(Store::write(claim.folder(), &merged.stored)?);
    let _lock = claim.keep();
    let results = &merged.stored.results;
    say(format!("{name}: {} of {} runs from {} folders", results.runs.len(), results.planned(), args.dirs.len()));
    if !merged.missing.is_empty() {
        merged.missing.iter().for_each(|line| say(format!("  missing: {line}")));
        say(format!("Make them with: touchline run --out {} --resume", quoted(&args.out.display().to_string())));
        return Ok(ExitCode::SUCCESS);
    }
    let results = session::write_exports(&args.out)?;
    say("");
    say(table::render(&results));
    say(format!("Results: {}", args.out.join("report.html").display()));
    Ok(ExitCode::SUCCESS)
}
