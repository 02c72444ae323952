//! Progress of a campaign on standard error: a bar with the time left on a terminal, plain lines otherwise.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::warn;

/// Plain lines come at least this far apart.
const PAUSE: Duration = Duration::from_secs(5);

/// Counts runs.
pub enum Progress {
    /// Says nothing.
    Quiet,
    /// A bar.
    Bar(ProgressBar),
    /// A line now and then.
    Lines {
        /// Runs in all.
        total: usize,
        /// Runs that were there before.
        before: usize,
        /// Runs so far, those included.
        done: usize,
        /// When it began.
        began: Instant,
        /// When it last spoke.
        spoke: Instant,
    },
}

impl Progress {
    /// For `total` runs, of which `done` are there already.
    pub fn new(total: usize, done: usize, quiet: bool) -> Self {
        let now = Instant::now();
        if quiet {
            return Self::Quiet;
        }
        if !std::io::stderr().is_terminal() {
            return Self::Lines { total, before: done, done, began: now, spoke: now };
        }
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} runs, {elapsed} gone, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::new(total as u64).with_style(style).with_position(done as u64);
        bar.reset_eta();
        Self::Bar(bar)
    }

    /// One more run is done.
    pub fn step(&mut self) {
        match self {
            Self::Quiet => {}
            Self::Bar(bar) => bar.inc(1),
            Self::Lines { total, before, done, began, spoke } => {
                *done += 1;
                if spoke.elapsed() >= PAUSE && done < total {
                    *spoke = Instant::now();
                    let gone = began.elapsed().as_secs_f64();
                    let left = gone / (*done - *before) as f64 * (*total - *done) as f64;
                    warn(format_args!("{done}/{total} runs, {gone:.0} s gone, about {left:.0} s left"));
                }
            }
        }
    }

    /// Takes the bar away.
    pub fn finish(self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}
