//! The `touchline` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    eval::cli::main()
}
