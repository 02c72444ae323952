//! One process that answers requests, and everything that may go wrong with it.
//!
//! Three threads hold its pipes, so that nothing it does or fails to do blocks the caller: one writes requests, one
//! reads lines, one keeps the last words on standard error. On Unix it leads a process group of its own, which is
//! killed as a whole.

use std::collections::VecDeque;
use std::ffi::OsStr;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender, SyncSender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::{protocol, tether};
use crate::campaign::micros;
use crate::results::RunStatus;

/// The longest line that is read, bytes.
const LONGEST: u64 = 64 << 20;
/// How often a silent process is looked at.
const TICK: Duration = Duration::from_millis(10);
/// How long a process whose pipe closed may take to end, and one that ended to deliver what it wrote.
const GRACE: Duration = Duration::from_millis(200);
/// How much of its standard error is kept, bytes.
const WORDS: usize = 2048;

/// Limits of one request.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Time to answer.
    pub time: Duration,
    /// Time on top of that, to start.
    pub start: Duration,
    /// Most resident memory of all its processes, MiB; Linux only.
    pub memory_mb: Option<u64>,
}

/// Why there is no answer. The process is dead.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure {
    /// Error, crashed, timeout or out of memory.
    pub status: RunStatus,
    /// What happened.
    pub error: String,
    /// How long after the request, µs.
    pub time_us: f64,
}

/// Why there is no answer, and whose fault that is.
#[derive(Debug)]
pub enum Trouble {
    /// The planner's: the run's result.
    Planner(Failure),
    /// The bench's, which has no means to start a process.
    Bench(io::Error),
}

impl From<Failure> for Trouble {
    fn from(failure: Failure) -> Self {
        Self::Planner(failure)
    }
}

/// A running process.
pub struct Process {
    child: Child,
    /// Dropping it closes the process's standard input.
    requests: Option<Sender<Vec<u8>>>,
    lines: Receiver<Line>,
    words: Arc<Mutex<VecDeque<u8>>>,
    /// Whether it has said more than its last answer.
    ahead: bool,
    /// Disconnects when its standard error closes.
    mute: Receiver<()>,
    /// Set when it is dead and reaped: its number may be another's by then.
    ended: Option<ExitStatus>,
}

enum Line {
    Whole {
        line: Vec<u8>,
        /// Whether something came with it.
        more: bool,
    },
    TooLong,
}

impl Process {
    /// Starts `program` in `folder`.
    pub fn start(program: impl AsRef<OsStr>, arguments: &[impl AsRef<OsStr>], folder: &Path) -> io::Result<Self> {
        let mut command = tether::command(program, arguments)?;
        command.current_dir(folder).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command.spawn()?;
        let (stdin, stdout, stderr) = (child.stdin.take(), child.stdout.take(), child.stderr.take());
        let (Some(mut stdin), Some(stdout), Some(mut stderr)) = (stdin, stdout, stderr) else {
            unreachable!("all three are piped")
        };
        let (requests, waiting) = mpsc::channel::<Vec<u8>>();
        // Whoever talks without being asked is stopped by the full pipe.
        let (sender, lines) = mpsc::sync_channel(1);
        let words = Arc::new(Mutex::new(VecDeque::with_capacity(WORDS)));
        let (speaking, mute) = mpsc::channel();
        let kept = Arc::clone(&words);
        // It ends with this value, if a thread is not to be had.
        let process = Self { child, requests: Some(requests), lines, ahead: false, words, mute, ended: None };
        // A closed pipe shows on the other side.
        background(move || drop(waiting.iter().try_for_each(|request| stdin.write_all(&request))))?;
        background(move || read_lines(stdout, &sender))?;
        background(move || {
            keep_last(&mut stderr, &kept);
            drop(speaking);
        })?;
        Ok(process)
    }

    /// Sends the line `request` and waits for one line, which is returned with the time that both took, µs.
    pub fn ask(&mut self, request: Vec<u8>, bounds: Bounds) -> Result<(Vec<u8>, f64), Trouble> {
        let began = Instant::now();
        if self.ahead || self.lines.try_recv().is_ok() {
            let error = "a line before it was asked; expected one for each request".to_owned();
            return Err(self.end(RunStatus::Error, began, error).into());
        }
        if let Some(requests) = &self.requests {
            // Fails when the process has closed its standard input: then it will not answer either.
            let _ = requests.send(request);
        }
        loop {
            let left = (bounds.time + bounds.start).saturating_sub(began.elapsed());
            if left.is_zero() {
                let mut error = format!("no answer within its hard limit, {} s", bounds.time.as_secs_f64());
                if !bounds.start.is_zero() {
                    error.push_str(&format!(", and {} s to start", bounds.start.as_secs_f64()));
                }
                return Err(self.end(RunStatus::Timeout, began, error).into());
            }
            let answer = match self.lines.recv_timeout(left.min(TICK)) {
                // What it wrote before it died may still be on its way.
                Err(RecvTimeoutError::Timeout) if self.is_dead() => self.lines.recv_timeout(GRACE),
                answer => answer,
            };
            let time_us = micros(began);
            if let Some(most) = bounds.memory_mb
                && let Some(used) = self.memory_mib().filter(|used| *used > most as f64)
            {
                let error = format!("{used:.1} MiB of memory; expected at most memory_mb = {most}");
                return Err(self.end(RunStatus::OutOfMemory, began, error).into());
            }
            match answer {
                Ok(Line::Whole { line, more }) => {
                    self.ahead = more;
                    return Ok((line, time_us));
                }
                Ok(Line::TooLong) => {
                    let error = format!("a line of more than {} MiB; expected an answer", LONGEST >> 20);
                    return Err(self.end(RunStatus::Error, began, error).into());
                }
                Err(RecvTimeoutError::Timeout) if !self.is_dead() => {}
                Err(_) => return Err(self.crashed(began)),
            }
        }
    }

    /// Its death by its own doing, in words.
    fn crashed(&mut self, began: Instant) -> Trouble {
        let died = self.dies_within(GRACE);
        let mut failure = self.end(RunStatus::Crashed, began, String::new());
        let words = self.last_words();
        if died && tether::was_short(self.ended, &words) {
            return Trouble::Bench(io::Error::other(words));
        }
        failure.error = match self.ended {
            Some(status) if died => format!("its process ended before it answered: {status}"),
            _ => "it closed its standard output before it answered".to_owned(),
        };
        if !words.is_empty() {
            failure.error.push_str("; its last words: ");
            let lines: Vec<_> = words.lines().map(protocol::plain).collect();
            failure.error.push_str(&lines.join("\n"));
        }
        failure.into()
    }

    fn end(&mut self, status: RunStatus, began: Instant, error: String) -> Failure {
        let time_us = micros(began);
        self.kill();
        Failure { status, error, time_us }
    }

    /// The end of its standard error.
    fn last_words(&self) -> String {
        let _ = self.mute.recv_timeout(GRACE);
        let words = self.words.lock().unwrap_or_else(PoisonError::into_inner);
        let (a, b) = words.as_slices();
        String::from_utf8_lossy(&[a, b].concat()).trim().to_owned()
    }

    fn dies_within(&mut self, time: Duration) -> bool {
        let began = Instant::now();
        while !self.is_dead() {
            if began.elapsed() >= time {
                return false;
            }
            thread::sleep(Duration::from_millis(1));
        }
        true
    }

    /// Resident memory of its group now, or the most that one process of it has held if that is more, MiB. `VmRSS` and
    /// `VmHWM` of `proc_pid_status(5)`; memory that processes share counts in each.
    #[cfg(target_os = "linux")]
    fn memory_mib(&self) -> Option<f64> {
        let group = self.child.id();
        let numbers = std::fs::read_dir("/proc").ok()?.flatten();
        let numbers = numbers.filter_map(|entry| entry.file_name().to_str()?.parse::<u32>().ok());
        // The group's leader is the tether.
        let members = numbers.filter(|pid| *pid != group && group_of(*pid) == Some(group));
        let (mut now, mut peak) = (0.0, 0.0_f64);
        for pid in members {
            // Gone meanwhile, or dead and without memory.
            let Ok(status) = std::fs::read_to_string(format!("/proc/{pid}/status")) else { continue };
            now += mib(&status, "VmRSS:").unwrap_or(0.0);
            peak = peak.max(mib(&status, "VmHWM:").unwrap_or(0.0));
        }
        Some(peak.max(now))
    }

    #[cfg(not(target_os = "linux"))]
    fn memory_mib(&self) -> Option<f64> {
        None
    }

    /// Whether it has ended by itself. Does not reap it, so that its group keeps its number.
    #[cfg(unix)]
    fn is_dead(&mut self) -> bool {
        use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
        let look = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
        self.ended.is_some() || !matches!(waitid(WaitId::Pid(Pid::from_child(&self.child)), look), Ok(None))
    }

    #[cfg(not(unix))]
    fn is_dead(&mut self) -> bool {
        self.ended = self.ended.or_else(|| self.child.try_wait().ok().flatten());
        self.ended.is_some()
    }

    /// Kills what is left of it and its group, and reaps it.
    fn kill(&mut self) {
        if self.ended.is_none() {
            #[cfg(unix)]
            let _ = rustix::process::kill_process_group(
                rustix::process::Pid::from_child(&self.child),
                rustix::process::Signal::KILL,
            );
            #[cfg(not(unix))]
            let _ = self.child.kill();
            self.ended = self.child.wait().ok();
        }
    }
}

impl Drop for Process {
    /// Closes its standard input, which asks it to end, and helps if it does not.
    fn drop(&mut self) {
        self.requests = None;
        if self.ended.is_none() {
            self.dies_within(GRACE);
            self.kill();
        }
    }
}

/// The process group of process `pid`: the third field after its name, which may hold anything. `proc_pid_stat(5)`.
#[cfg(target_os = "linux")]
fn group_of(pid: u32) -> Option<u32> {
    let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    stat.rsplit_once(')')?.1.split_ascii_whitespace().nth(2)?.parse().ok()
}

/// The value of `key` in a status file of `/proc`, MiB.
#[cfg(target_os = "linux")]
fn mib(status: &str, key: &str) -> Option<f64> {
    let line = status.lines().find_map(|line| line.strip_prefix(key))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib / 1024.0)
}

/// Unlike [`thread::spawn`], does not panic where there is no thread to be had.
fn background(work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    thread::Builder::new().spawn(work).map(drop)
}

fn read_lines(stdout: impl Read, sender: &SyncSender<Line>) {
    let mut stdout = BufReader::new(stdout);
    loop {
        let mut line = Vec::new();
        // An end without a line's end is no line.
        let line = match stdout.by_ref().take(LONGEST).read_until(b'\n', &mut line) {
            Ok(_) if line.ends_with(b"\n") => Line::Whole { line, more: !stdout.buffer().is_empty() },
            Ok(length) if length as u64 == LONGEST => Line::TooLong,
            _ => return,
        };
        if sender.send(line).is_err() {
            return;
        }
    }
}

fn keep_last(stderr: &mut impl Read, words: &Mutex<VecDeque<u8>>) {
    let mut chunk = [0; WORDS];
    while let Ok(length @ 1..) = stderr.read(&mut chunk) {
        let mut words = words.lock().unwrap_or_else(PoisonError::into_inner);
        words.extend(&chunk[..length]);
        let excess = words.len().saturating_sub(WORDS);
        words.drain(..excess);
    }
}
