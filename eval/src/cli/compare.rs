//! `touchline compare`.

use std::process::ExitCode;

use comfy_table::{CellAlignment, LineStyle, Table, TableStyle};

use super::{CompareArgs, Gate, say, warn};
use crate::compare::{Change, Changes, Quality, Side, Speed, compare as compared};
use crate::error::Error;
use crate::format;

pub(super) fn compare(args: &CompareArgs) -> Result<ExitCode, Error> {
    let changes = compared(&Side::read(&args.old)?, &Side::read(&args.new)?)?;
    if args.json {
        say(serde_json::to_string_pretty(&changes).expect("plain data"));
    } else {
        print(&changes);
    }
    let failed = args.fail_on.iter().any(|gate| match gate {
        Gate::Worse => changes.worse(),
        Gate::Slower => changes.slower(),
        Gate::Changed => changes.changed(),
    });
    Ok(ExitCode::from(u8::from(failed)))
}

fn print(changes: &Changes) {
    changes.notes.iter().for_each(|note| warn(format_args!("note: {note}")));
    for (what, list) in [("missing in NEW", &changes.missing), ("only in NEW", &changes.added)] {
        if !list.is_empty() {
            say(format!("{what}: {}", list.join(", ")));
        }
    }
    let worth_a_row = |c: &&Change| c.differing > 0 || matches!(c.speed, Speed::Faster | Speed::Slower);
    let rows: Vec<&Change> = changes.changes.iter().filter(worth_a_row).collect();
    if !rows.is_empty() {
        say(table(&rows));
        say("A12: how often a run of NEW is worse than one of OLD. Failures count as ∞. p after Holm's correction.");
        if rows.iter().any(|c| c.scene.is_none()) {
            say("In \"all\", medians, p, A12 and time are of the scenes' medians: a scene counts as one.");
        }
    }
    let scenes: Vec<&Change> = changes.changes.iter().filter(|c| c.scene.is_some()).collect();
    let same = scenes.iter().filter(|c| c.quality == Quality::Same).count();
    let untimed = scenes.iter().filter(|c| matches!(c.speed, Speed::TooFew | Speed::Untimed)).count();
    say(format!("{same} of {} planners × scenes are the same in every count.", scenes.len()));
    if untimed > 0 {
        say(format!("Of {untimed} the times say nothing: fewer than 6 runs, or none told."));
    }
}

fn table(rows: &[&Change]) -> String {
    let mut table = Table::new();
    let line = LineStyle::none().fill('─').junction('─');
    table.load_style(TableStyle::new().header_separator(line).bottom_border(line));
    table.set_header(["planner", "scene", "differ", "valid", "median gap", "paths", "p", "A12", "time", "speed"]);
    for c in rows {
        let median = |side: usize| c.median[side].map_or(format::INFINITE.to_owned(), |m| format::significant(m, 4));
        let ratio = |r: f64| format!("× {}", format::significant(r, 3));
        let interval =
            |[low, high]: [f64; 2]| format!(" [{}, {}]", format::significant(low, 3), format::significant(high, 3));
        table.add_row([
            c.planner.clone(),
            c.scene.clone().unwrap_or_else(|| "all".to_owned()),
            format!("{}/{}", c.differing, c.pairs),
            format!("{} → {}", c.valid[0], c.valid[1]),
            format!("{} → {}", median(0), median(1)),
            quality(c.quality).to_owned(),
            c.p.map_or(format::NONE.to_owned(), |p| format::significant(p, 2)),
            format::significant(c.a12, 2),
            c.time_ratio.map_or(format::NONE.to_owned(), ratio) + &c.time_interval.map_or(String::new(), interval),
            speed(c.speed).to_owned(),
        ]);
    }
    for column in table.column_iter_mut().skip(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

fn quality(verdict: Quality) -> &'static str {
    match verdict {
        Quality::Same => "same",
        Quality::Better => "better",
        Quality::Worse => "WORSE",
        Quality::Unclear => "within noise",
        Quality::TooFew => "too few to tell",
    }
}

fn speed(verdict: Speed) -> &'static str {
    match verdict {
        Speed::Unchanged => "unchanged",
        Speed::Faster => "faster",
        Speed::Slower => "SLOWER",
        Speed::TooFew => "too few to tell",
        Speed::Untimed => "no times",
    }
}
