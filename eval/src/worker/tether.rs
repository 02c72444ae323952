//! Processes that do not outlive the bench, however it ends.
//!
//! Linux sends a process a signal when the thread that started it is gone, if the process asked for it and keeps
//! the wish when it becomes another program. So a planner's process begins as this program, wishes to be killed
//! (`prctl(2)`, `PR_SET_PDEATHSIG`), and becomes the planner's command by `execve(2)`. Other systems have no such
//! thing: there a killed bench leaves its planners with a closed standard input, which ends well-behaved ones.

use std::ffi::OsStr;
use std::process::Command;

/// The hidden command that [`run`] does.
pub const COMMAND: &str = "tethered";

/// A command that starts this very program, even when its file was replaced meanwhile.
pub fn own_program() -> std::io::Result<std::path::PathBuf> {
    if cfg!(target_os = "linux") { Ok("/proc/self/exe".into()) } else { std::env::current_exe() }
}

/// A command that starts `program` tethered to the calling thread.
pub fn command(program: impl AsRef<OsStr>, arguments: &[impl AsRef<OsStr>]) -> std::io::Result<Command> {
    let mut command;
    if cfg!(target_os = "linux") {
        command = Command::new(own_program()?);
        command.arg(COMMAND).arg(std::process::id().to_string()).arg("--").arg(program);
    } else {
        command = Command::new(program);
    }
    command.args(arguments);
    Ok(command)
}

/// Becomes the command `words`, tethered to the process `parent`. Returns only on failure.
#[cfg(target_os = "linux")]
pub fn run(parent: u32, words: &[std::ffi::OsString]) -> std::io::Error {
    use rustix::process::{Signal, getppid, set_parent_process_death_signal};
    use std::io::Error;
    use std::os::unix::process::CommandExt;

    if let Err(e) = set_parent_process_death_signal(Some(Signal::KILL)) {
        return e.into();
    }
    // It may have died before the wish.
    if getppid().map(|pid| pid.as_raw_nonzero().get()) != i32::try_from(parent).ok() {
        return Error::other("the bench is gone");
    }
    match words {
        [program, arguments @ ..] => Command::new(program).args(arguments).exec(),
        [] => Error::other("no command"),
    }
}

/// Only Linux has the means.
#[cfg(not(target_os = "linux"))]
pub fn run(_: u32, _: &[std::ffi::OsString]) -> std::io::Error {
    std::io::ErrorKind::Unsupported.into()
}
