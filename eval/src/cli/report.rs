//! `touchline report`.

use std::process::ExitCode;

use super::{Format, ReportArgs, Tongue, say};
use crate::error::Error;
use crate::export::{self, Formats};
use crate::report::Language;
use crate::store::Store;

pub(super) fn report(args: &ReportArgs) -> Result<ExitCode, Error> {
    let formats = if args.format.is_empty() {
        Formats::OWN
    } else {
        let has = |format| args.format.contains(&format);
        Formats {
            html: has(Format::Html),
            csv: has(Format::Csv),
            json: has(Format::Json),
            document: has(Format::Json),
            ompl: has(Format::Ompl),
            ioh: has(Format::Ioh),
            toml: false,
        }
    };
    let language = match args.language {
        Tongue::En => Language::English,
        Tongue::Zh => Language::Chinese,
    };
    let stored = Store::open(&args.dir)?.read()?;
    export::write(&args.dir, &stored, formats, language)?;
    let results = &stored.results;
    let planned = results.planned();
    if results.runs.len() < planned {
        say(format!("{} of {planned} runs are there: the campaign did not finish", results.runs.len()));
    }
    say(format!("Made again from {} runs: {}", results.runs.len(), args.dir.display()));
    Ok(ExitCode::SUCCESS)
}
