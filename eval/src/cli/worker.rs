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

/// Returns only on failure.
pub(super) fn tethered(parent: u32, command: &[OsString]) -> Error {
    let error = tether::run(parent, command);
    Error::Usage(format!("cannot start {command:?}: {error}"))
}
