//! `touchline list`.

use std::process::ExitCode;

use env_model::generate::Generator;
use planner_catalogue::kinds;
use serde_json::json;

use super::{ListArgs, Listed, say};
use crate::error::Error;
use crate::metrics::{METRICS, MOVING};

pub(super) fn list(args: &ListArgs) -> Result<ExitCode, Error> {
    // Name, what it is, a word more (the keys of the JSON objects); a planner's settings at their defaults.
    let (keys, rows): ([&str; 3], Vec<Row>) = match args.what {
        Listed::Planners => {
            let row = |k: &planner_catalogue::Kind| Row {
                cells: [k.name, k.summary, k.source].map(str::to_owned),
                settings: Some(k.defaults()),
                real_time: k.real_time,
                controller: false,
            };
            let controller = |k: &planner_catalogue::ControllerKind| Row {
                cells: [k.name, k.summary, k.source].map(str::to_owned),
                settings: planner_catalogue::build_controller_str(k.name, "").ok().map(|built| built.settings),
                real_time: false,
                controller: true,
            };
            let all = kinds().iter().map(row).chain(planner_catalogue::controllers().iter().map(controller));
            (["name", "summary", "source"], all.collect())
        }
        Listed::Generators => {
            let row = |g: Generator| {
                let number = format!("{} obstacles", g.default_obstacles());
                Row { cells: [g.name().to_owned(), g.description().to_owned(), number], ..Row::default() }
            };
            (["name", "summary", "default"], Generator::ALL.into_iter().map(row).collect())
        }
        Listed::Metrics => {
            let row = |m: &crate::metrics::Metric, prefix: &str| Row {
                cells: [m.name.to_owned(), format!("{prefix}{}", m.definition), m.unit.to_owned()],
                ..Row::default()
            };
            let paths = METRICS.iter().map(|m| row(m, ""));
            let moving = MOVING.iter().map(|m| row(&m.metric, "of a simulation: "));
            (["name", "definition", "unit"], paths.chain(moving).collect())
        }
    };
    if args.json {
        let object = |Row { cells, settings, real_time, controller }: &Row| {
            let mut object = json!({ keys[0]: cells[0], keys[1]: cells[1], keys[2]: cells[2] });
            if let Some(settings) = settings {
                object["settings"] = json!(settings);
                object["real_time"] = json!(real_time);
                object["controller"] = json!(controller);
            }
            object
        };
        say(json!(rows.iter().map(object).collect::<Vec<_>>()));
        return Ok(ExitCode::SUCCESS);
    }
    let width = rows.iter().map(|row| row.cells[0].len()).max().unwrap_or(0);
    for Row { cells: [name, what, more], settings, real_time, controller } in rows {
        let claim = match (real_time, controller) {
            (true, _) => "; real time",
            (_, true) => "; for moving scenes",
            _ => "",
        };
        say(format!("{name:width$}  {what} [{more}{claim}]"));
        let settings = settings.unwrap_or_default();
        let settings: Vec<String> = settings.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        if !settings.is_empty() {
            say(format!("{:width$}    {}", "", settings.join(", ")));
        }
    }
    Ok(ExitCode::SUCCESS)
}

#[derive(Default)]
struct Row {
    cells: [String; 3],
    settings: Option<toml::Table>,
    /// Whether a planner claims real time.
    real_time: bool,
    /// Whether it moves a robot rather than plans a path.
    controller: bool,
}
