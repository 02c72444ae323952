//! `touchline worker`, and the hidden command that ties a process to the bench.

use std::ffi::OsString;
use std::io;
use std::process::ExitCode;

use crate::error::Error;
use crate::worker::{serve, tether};

pub(super) fn worker() -> Result<ExitCode, Error> {
    serve(io::stdin().lock(), io::stdout().lock()).map_err(|e| Error::Usage(format!("cannot go on: {e}")))?;
    Ok(ExitCode::SUCCESS)
}

pub(super) fn tethered(parent: u32, command: &[OsString]) -> ExitCode {
    tether::run(parent, command).unwrap_or_else(|error| {
        eprintln!("{}{command:?}: {error}", tether::SORRY);
        ExitCode::from(if tether::is_shortage(&error) { tether::SHORT } else { 2 })
    })
}
