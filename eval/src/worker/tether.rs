//! Processes that do not outlive the bench, however it ends.
//!
//! On Linux this program stands between the bench and a planner's command: it leads their process group, holds none
//! of the planner's pipes, ends as the command ends, and kills the whole group when its own parent is gone. Nothing
//! else reaches what a planner has started in its turn: a death signal (`prctl(2)`, `PR_SET_PDEATHSIG`) is for one
//! process. Elsewhere a killed bench leaves its planners with a closed standard input, which ends well-behaved ones.

use std::ffi::OsStr;
use std::process::{Command, ExitCode, ExitStatus};
#[cfg(target_os = "linux")]
use std::time::Duration;

/// The hidden command that [`run`] does.
pub const COMMAND: &str = "tethered";
/// How often [`run`] looks for its parent.
#[cfg(target_os = "linux")]
const WATCH: Duration = Duration::from_millis(50);

/// A command that starts this very program, even when its file was replaced meanwhile.
pub fn own_program() -> std::io::Result<std::path::PathBuf> {
    if cfg!(target_os = "linux") { Ok("/proc/self/exe".into()) } else { std::env::current_exe() }
}

/// A command that starts `program` tethered to this process.
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

/// Whether `error` tells of too few descriptors, processes or memory, which is nobody's fault but this machine's.
pub fn is_shortage(error: &std::io::Error) -> bool {
    #[cfg(unix)]
    {
        use rustix::io::Errno;
        let short = [Errno::MFILE, Errno::NFILE, Errno::AGAIN, Errno::NOMEM];
        Errno::from_io_error(error).is_some_and(|errno| short.contains(&errno))
    }
    #[cfg(not(unix))]
    {
        error.kind() == std::io::ErrorKind::OutOfMemory
    }
}

/// How [`run`] fails for a shortage: `EX_TEMPFAIL` of `sysexits.h`.
pub const SHORT: u8 = 75;
/// How the words begin that explain any failure of [`run`].
pub const SORRY: &str = "error: cannot start ";

/// Whether a tether that ended with `status` and `words` had not the means to start its command.
pub fn was_short(status: Option<ExitStatus>, words: &str) -> bool {
    status.and_then(|status| status.code()) == Some(SHORT.into()) && words.starts_with(SORRY)
}

/// Runs the command `words` in this process's group until it ends or the process `parent` does, which kills the
/// group. Returns how the command ended, if by an exit code; a signal that ended it ends this process too.
#[cfg(target_os = "linux")]
pub fn run(parent: u32, words: &[std::ffi::OsString]) -> std::io::Result<ExitCode> {
    use rustix::process::{Signal, getppid, kill_current_process_group};
    use rustix::stdio::{dup2_stderr, dup2_stdin, dup2_stdout};
    use std::io::Error;

    let has_parent = move || getppid().map(|pid| pid.as_raw_nonzero().get()) == i32::try_from(parent).ok();
    if !has_parent() {
        return Err(Error::other("the bench is gone"));
    }
    let [program, arguments @ ..] = words else { return Err(Error::other("no command")) };
    let nothing = std::fs::File::options().read(true).write(true).open("/dev/null")?;
    std::thread::Builder::new().spawn(move || {
        while has_parent() {
            std::thread::sleep(WATCH);
        }
        let _ = kill_current_process_group(Signal::KILL);
    })?;
    let mut child = Command::new(program).args(arguments).spawn()?;
    // The pipes are the command's alone, so that the bench sees when it closes them.
    dup2_stdin(&nothing)?;
    dup2_stdout(&nothing)?;
    dup2_stderr(&nothing)?;
    Ok(end_like(child.wait()?))
}

/// Ends this process by the signal in `status`, or tells the exit code; 128 + signal where that signal is harmless.
#[cfg(target_os = "linux")]
fn end_like(status: ExitStatus) -> ExitCode {
    use rustix::process::{Resource, Rlimit, Signal, getpid, kill_process, setrlimit};
    use std::os::unix::process::ExitStatusExt;

    let Some(number) = status.signal() else {
        return ExitCode::from(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(u8::MAX));
    };
    if let Some(signal) = Signal::from_named_raw(number) {
        // The command's own core is enough.
        let _ = setrlimit(Resource::Core, Rlimit { current: Some(0), maximum: Some(0) });
        // The first SIGSEGV or SIGBUS only ends Rust's own handler of it.
        for _ in 0..2 {
            let _ = kill_process(getpid(), signal);
        }
    }
    ExitCode::from(128 + u8::try_from(number).unwrap_or(127))
}

/// Only Linux has need of it.
#[cfg(not(target_os = "linux"))]
pub fn run(_: u32, _: &[std::ffi::OsString]) -> std::io::Result<ExitCode> {
    Err(std::io::ErrorKind::Unsupported.into())
}
