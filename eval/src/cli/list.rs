//! `touchline list`.

use std::process::ExitCode;

use env_model::generate::Generator;
use planner_catalogue::kinds;
use serde_json::json;

use super::{ListArgs, Listed, say};
use crate::error::Error;
use crate::metrics::METRICS;

pub(super) fn list(args: &ListArgs) -> Result<ExitCode, Error> {
    // Name, what it is, a word more; the keys of the JSON objects.
    let (keys, rows): ([&str; 3], Vec<[String; 3]>) = match args.what {
        Listed::Planners => {
            let row = |k: &planner_catalogue::Kind| [k.name, k.summary, k.source].map(str::to_owned);
            (["name", "summary", "source"], kinds().iter().map(row).collect())
        }
        Listed::Generators => {
            let row = |g: Generator| {
                [g.name().to_owned(), g.description().to_owned(), format!("{} obstacles", g.default_obstacles())]
            };
            (["name", "summary", "default"], Generator::ALL.into_iter().map(row).collect())
        }
        Listed::Metrics => {
            let row = |m: &crate::metrics::Metric| [m.name, m.definition, m.unit].map(str::to_owned);
            (["name", "definition", "unit"], METRICS.iter().map(row).collect())
        }
    };
    if args.json {
        let object = |row: &[String; 3]| json!({ keys[0]: row[0], keys[1]: row[1], keys[2]: row[2] });
        say(json!(rows.iter().map(object).collect::<Vec<_>>()));
        return Ok(ExitCode::SUCCESS);
    }
    let width = rows.iter().map(|row| row[0].len()).max().unwrap_or(0);
    for [name, what, more] in rows {
        say(format!("{name:width$}  {what} [{more}]"));
    }
    Ok(ExitCode::SUCCESS)
}
