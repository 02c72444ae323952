//! The `touchline` command line.
//!
//! Exit codes: 0 done, whatever the planners achieved; 1 a check that was asked
//! for failed (`--fail-on`); 2 bad usage or input, and then nothing was written, or
//! an interruption (a full disk), and then what was recorded is kept.

mod check;
mod compare;
mod list;
mod merge;
mod output;
mod plan;
mod report;
mod run;
mod session;
mod status;
mod worker;

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::work::Shard;
use crate::worker::tether;

const EXAMPLES: &str = "\
Examples:
  touchline                                       the 2012 experiment into results/lu-sun-2012
  touchline run my.toml --out out --jobs 2        a comparison of your own
  touchline run my.toml --planner pso,tangent     only these two of its planners
  touchline plan scene.toml --planner pso-qp --svg path.svg
  touchline plan scene.toml --planner pso --set particles=30 --seed 7 --trace swarm.jsonl
  touchline check configs/scenes/*.toml           is it well-formed?
  touchline run my.toml --dry-run                 what it would run, and how long at most
  touchline run --out out --resume                go on after an interruption, in whatever way it came
  touchline status out                            what is done and what is missing, also while it runs
  touchline run my.toml --shard 2/3 --out part-2  the second third, say on another machine
  touchline merge part-1 part-2 part-3 --out all  one campaign of all thirds
  touchline report out                            report.html and tables again from out/runs.db
  touchline report out --format ompl,ioh          logs for Planner Arena, a table for IOHanalyzer
  touchline compare before after --fail-on worse  what changed, beyond noise?

Exit codes: 0 done, whatever the planners achieved; 1 --fail-on found something; 2 bad usage or input, or
an interruption such as a full disk: then what is recorded is kept, and --resume goes on.";

const SHARDS: &str = "\
Every part is a campaign of its own, which can be resumed; all must come from the same comparison,
scenes and version of the program. What external planners do is no part of that: see to it that the
same programs are everywhere. Parts that overlap, or belong to another campaign, are refused; where
runs are missing, the result can be completed:

  touchline run my.toml --shard 1/2 --out part-1      on one machine
  touchline run my.toml --shard 2/2 --out part-2      on another
  touchline merge part-1 part-2 --out all
  touchline run --out all --resume                    only if merge says that runs are missing";

/// Compares 2D path planners for robot soccer: every path is judged by an
/// independent exact test and scored against the true optimum.
#[derive(Parser)]
#[command(name = "touchline", version, after_help = EXAMPLES, args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    run: RunArgs,
}

#[derive(Subcommand)]
enum Command {
    /// Run a comparison; without a file, the embedded experiment of Lu & Sun (2012)
    #[command(after_help = EXAMPLES)]
    Run(RunArgs),
    /// Plan once in one scene
    Plan(PlanArgs),
    /// Make report and exports again from the stored runs of a campaign
    Report(ReportArgs),
    /// List what there is
    List(ListArgs),
    /// Validate scenes and comparisons without running them
    Check(CheckArgs),
    /// What of a campaign is done and what is missing, also while it runs
    Status(StatusArgs),
    /// Join the parts of a campaign that were made with --shard
    #[command(after_help = SHARDS)]
    Merge(MergeArgs),
    /// What changed between two campaigns, beyond noise
    Compare(CompareArgs),
    /// Plan for another process: requests on standard input, answers on standard output, as lines of JSON
    Worker,
    /// Become COMMAND, and end with the process PARENT
    #[command(name = tether::COMMAND, hide = true)]
    Tethered {
        parent: u32,
        #[arg(last = true, required = true)]
        command: Vec<OsString>,
    },
}

/// When a completed campaign counts as failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FailOn {
    /// A run without a valid path
    Invalid,
    /// A run that ended in an error
    Error,
}

#[derive(Args)]
struct RunArgs {
    /// Comparison file (TOML); default: the embedded 2012 experiment
    comparison: Option<PathBuf>,
    /// Folder for the results; default results/NAME, numbered when taken
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seed instead of the comparison's
    #[arg(long, value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    seed: Option<u64>,
    /// Repeats instead of the comparison's
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    repeats: Option<u32>,
    /// Threads; results are the same, but times are only fair with 1
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: u16,
    /// Only the planners of these labels, each an argument, or separated by commas
    #[arg(long, value_name = "LABEL", num_args = 1..)]
    planner: Vec<String>,
    /// Say what would be run, and run nothing
    #[arg(long)]
    dry_run: bool,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
    /// Exit with 1 when any run is without a valid path, or ended in an error
    #[arg(long, value_name = "WHAT")]
    fail_on: Option<FailOn>,
    /// Go on with the campaign in the folder: make what is missing and nothing twice; begin it where there is none.
    /// Without COMPARISON the one that the folder DIR holds is taken. Jobs and isolation may be others than before
    #[arg(long)]
    resume: bool,
    /// Only part I of N, counted from 1; `touchline merge` joins the parts
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Every planner in a process of its own: a crash, a hang or hunger for memory ends one run alone
    #[arg(long)]
    isolate: bool,
}

#[derive(Args)]
struct PlanArgs {
    /// Scene file (TOML)
    scene: PathBuf,
    /// Kind of planner, see `touchline list planners`
    #[arg(long, value_name = "KIND")]
    planner: String,
    /// A setting, as in a comparison: a TOML value, else text; dots reach into tables (budget.iterations=10)
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Seed of the run, e.g. from the seed column of runs.csv
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Draw scene, optimum and path
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write one JSON line for every frame (particles, cells, trees, individuals, forces), from a second, untimed run
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// report.html
    Html,
    /// runs.csv and summary.csv
    Csv,
    /// paths.jsonl, manifest.json, and everything in results.json, with its schema
    Json,
    /// ompl/SCENE.log: logs that OMPL's statistics script reads, for Planner Arena
    Ompl,
    /// ioh.csv for `IOHanalyzer`: a row an improvement, its value the gap to the optimum, 1e9 for a failed run
    Ioh,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Tongue {
    /// English
    En,
    /// Chinese
    Zh,
}

#[derive(Args)]
struct ReportArgs {
    /// Folder of a campaign
    dir: PathBuf,
    /// What to make; default: what a run leaves
    #[arg(long, value_name = "FORMAT", value_delimiter = ',')]
    format: Vec<Format>,
    /// Language of report.html
    #[arg(long, default_value = "en")]
    language: Tongue,
}

#[derive(Args)]
struct StatusArgs {
    /// Folder of a campaign
    dir: PathBuf,
    /// As JSON
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct MergeArgs {
    /// Folders of the parts
    #[arg(required = true, value_name = "DIR")]
    dirs: Vec<PathBuf>,
    /// New folder for the whole campaign
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Listed {
    Planners,
    Generators,
    Metrics,
}

#[derive(Args)]
struct ListArgs {
    /// Of what
    what: Listed,
    /// As JSON
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct CheckArgs {
    /// Scene and comparison files
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Say the exact shortest length in every scene as well
    #[arg(long)]
    optimum: bool,
}

/// What makes `compare` fail.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Gate {
    /// Paths are worse beyond noise, or runs are missing in NEW
    Worse,
    /// A planner is slower: by 10 % at least, and its interval leaves 1 out
    Slower,
    /// Anything but times differs, in any run
    Changed,
}

#[derive(Args)]
struct CompareArgs {
    /// Folder of a campaign, or a runs.csv, in which the time columns may be missing
    old: PathBuf,
    /// The same, later; runs are paired by scene, planner and repeat, and must have the same seeds
    new: PathBuf,
    /// As JSON
    #[arg(long)]
    json: bool,
    /// Exit with 1 when it is so
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    fail_on: Vec<Gate>,
}

/// Parses the command line, does the work, prints errors to standard error.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    let outcome = match cli.command {
        None => run::run(&cli.run),
        Some(Command::Run(args)) => run::run(&args),
        Some(Command::Plan(args)) => plan::plan(&args),
        Some(Command::Report(args)) => report::report(&args),
        Some(Command::List(args)) => list::list(&args),
        Some(Command::Check(args)) => check::check(&args),
        Some(Command::Status(args)) => status::status(&args),
        Some(Command::Merge(args)) => merge::merge(&args),
        Some(Command::Compare(args)) => compare::compare(&args),
        Some(Command::Worker) => worker::worker(),
        Some(Command::Tethered { parent, command }) => Ok(worker::tethered(parent, &command)),
    };
    outcome.unwrap_or_else(|error| {
        warn(format_args!("error: {error}"));
        ExitCode::from(2)
    })
}

/// Prints a line to standard output; a closed pipe (`| head`) is no failure.
fn say(line: impl std::fmt::Display) {
    use std::io::Write;
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Prints a line to standard error; that it is closed or full is no reason to give up a campaign.
pub(crate) fn warn(line: impl std::fmt::Display) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr(), "{line}");
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        super::Cli::command().debug_assert();
    }
}
