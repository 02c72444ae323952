//! `touchline status`.

use std::process::ExitCode;

use super::{StatusArgs, say};
use crate::error::Error;
use crate::lock::Lock;
use crate::status::Status;
use crate::store::Store;

pub(super) fn status(args: &StatusArgs) -> Result<ExitCode, Error> {
    // Before it is read: a campaign that ends meanwhile is then not taken for an interrupted one.
    let running = Lock::is_taken(&args.dir);
    let status = Status::new(&Store::open(&args.dir)?, running)?;
    if args.json {
        say(serde_json::to_string_pretty(&status).expect("plain data with string keys"));
    } else {
        say(status.render().trim_end());
    }
    Ok(ExitCode::SUCCESS)
}
