//! Where the numbers come from: machines, isolation, and how far times can be trusted.

use minijinja::{Value, context};

use super::data_table::{row, table, words};
use super::evidence::Evidence;
use super::language::Strings;
use crate::analysis::noise::{Noise, Verdict};
use crate::format;
use crate::results::{Manifest, Results};
use crate::statistics::quantile;

/// Isolation may cost this much a run, µs.
const ALLOWED_US: f64 = 1000.0;

/// What to know of the times, one sentence each.
pub fn times(evidence: &Evidence<'_>, t: &Strings) -> Vec<String> {
    let mut out = vec![noise(&Noise::new(&evidence.grid).verdict(), evidence, t)];
    out.extend(overhead(evidence.results, t));
    out
}

fn noise(verdict: &Verdict, evidence: &Evidence<'_>, t: &Strings) -> String {
    let Verdict::Known { runs, outliers, drift } = verdict else { return t.get("noise_unknown").to_owned() };
    let drift = match drift {
        None => t.get("noise_steady").to_owned(),
        Some(d) => t.fill(
            if d.change > 0.0 { "noise_rose" } else { "noise_fell" },
            &[
                ("change", &format::percent(d.change.abs())),
                ("planner", evidence.label(d.planner)),
                ("scene", &evidence.grid.scenes[d.scene].scene.name),
                ("drifted", &d.drifted.to_string()),
                ("series", &d.series.to_string()),
            ],
        ),
    };
    let counts = [("n", format::count(*outliers as f64)), ("runs", format::count(*runs as f64))];
    let outliers = t.fill("noise_outliers", &[("n", &counts[0].1), ("runs", &counts[1].1)]);
    drift + t.get("sentence_gap") + &outliers
}

/// What reaching planners in their own processes cost beside their time; `None` where all ran in the bench's.
fn overhead(results: &Results, t: &Strings) -> Option<String> {
    let costs: Vec<f64> = results.runs.iter().filter_map(|r| r.overhead_us).collect();
    let (middle, most) = (quantile(&costs, 0.5)?, quantile(&costs, 1.0)?);
    let within = costs.iter().filter(|c| **c <= ALLOWED_US).count();
    let share = format::percent(within as f64 / costs.len() as f64);
    Some(t.fill(
        "overhead",
        &[
            ("runs", &t.plural(costs.len(), "runs_one", "runs")),
            ("median", &format::time(middle)),
            ("most", &format::time(most)),
            ("allowed", &format::time(ALLOWED_US)),
            ("share", &share),
        ],
    ))
}

/// The machines of a merged campaign; `None` where one machine did everything.
pub fn machines(results: &Results, t: &Strings) -> Option<Value> {
    let shards = &results.manifest.shards;
    if shards.is_empty() {
        return None;
    }
    let line = |m: &Manifest| {
        let ended = if m.finished.is_empty() { t.get("machine_unfinished") } else { m.finished.as_str() };
        row(vec![
            words(m.shard.as_str()),
            words(format!("{} × {}", m.cpu, m.cores)),
            words(m.platform.as_str()),
            words(format!("{} ({})", m.version, m.profile)),
            words(m.jobs.to_string()),
            words(m.started.as_str()),
            words(ended),
        ])
    };
    let heads = [
        "machine_shard",
        "machine_cpu",
        "machine_platform",
        "machine_version",
        "machine_jobs",
        "machine_started",
        "machine_finished",
    ]
    .map(|key| t.get(key));
    Some(table("machines-table", t.get("machines_title"), &heads, shards.iter().map(line).collect()))
}

/// How the campaign was run, beside its machine.
pub fn manifest(m: &Manifest, t: &Strings) -> Value {
    context! {
        version => m.version.as_str(), profile => m.profile.as_str(), platform => m.platform.as_str(),
        cpu => m.cpu.as_str(), cores => m.cores, jobs => m.jobs, started => m.started.as_str(),
        finished => m.finished.as_str(), identity => m.identity.as_str(), shard => m.shard.as_str(),
        isolated => t.get(if m.isolated { "machine_isolated_all" } else { "machine_isolated_some" }),
        resumed => m.resumed,
    }
}
