//! What of a campaign is done and what is missing, before any score; also while it runs.

use std::collections::BTreeMap;

use comfy_table::{CellAlignment, LineStyle, Table, TableStyle};
use serde::Serialize;

use crate::error::Error;
use crate::estimate::duration;
use crate::results::RunStatus;
use crate::store::Store;

/// Rows up to which complete ones are shown too.
const ALL_ROWS: usize = 24;
/// More rows are not read by people.
const MOST_ROWS: usize = 200;

/// The state of a campaign.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Status {
    /// Name of the comparison.
    pub name: String,
    /// Identity of the campaign.
    pub identity: String,
    /// What part of it this is, as I/N; empty for all of it.
    pub shard: String,
    /// When it began.
    pub started: String,
    /// When it ended; empty before.
    pub finished: String,
    /// How often it was taken up again.
    pub resumed: u32,
    /// Whether a process is working on it.
    pub running: bool,
    /// Runs when it is complete.
    pub planned: usize,
    /// Runs that are there.
    pub done: usize,
    /// Runs a second since it was begun or last taken up, while it runs.
    pub runs_per_second: Option<f64>,
    /// Seconds that the rest takes at that rate.
    pub seconds_left: Option<f64>,
    /// How many runs ended how.
    pub statuses: BTreeMap<&'static str, usize>,
    /// Every scene and planner, in the comparison's order.
    pub cells: Vec<Cell>,
}

/// One planner in one scene.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Cell {
    /// Name of the scene.
    pub scene: String,
    /// Label of the planner.
    pub planner: String,
    /// Runs when it is complete.
    pub planned: usize,
    /// Runs that are there.
    pub done: usize,
    /// Of these, how many ended in an error, a crash, or by a limit of their process.
    pub failed: usize,
}

impl Status {
    /// Of the campaign in `store`; `running` says whether a process is working on it.
    pub fn new(store: &Store, running: bool) -> Result<Self, Error> {
        let results = store.head()?.results;
        let manifest = &results.manifest;
        let (mut statuses, mut of) = (BTreeMap::new(), BTreeMap::<(String, String), [usize; 2]>::new());
        for count in store.counts()? {
            *statuses.entry(count.status.name()).or_default() += count.runs;
            let [done, failed] = of.entry((count.scene, count.planner)).or_default();
            *done += count.runs;
            if count.status == RunStatus::Error || count.status.is_killed() {
                *failed += count.runs;
            }
        }
        let done = statuses.values().sum();
        let mut repeats = vec![0; results.scenes.len()];
        manifest.part().units(results.scenes.len(), results.repeats).for_each(|(scene, _)| repeats[scene] += 1);
        let mut cells = Vec::new();
        for (scene, planned) in results.scenes.iter().zip(repeats) {
            for planner in &results.planners {
                let (scene, planner) = (scene.scene.name.clone(), planner.label.clone());
                let [done, failed] = of.remove(&(scene.clone(), planner.clone())).unwrap_or_default();
                cells.push(Cell { scene, planner, planned, done, failed });
            }
        }
        let rate = match manifest.sessions.last() {
            Some(session) if running && done > session.runs_before => {
                let seconds = store.seconds_since(&session.started)?;
                // The start is known to the second.
                Some((done - session.runs_before) as f64 / seconds.max(1.0))
            }
            _ => None,
        };
        let planned = results.planned();
        Ok(Self {
            planned,
            done,
            running,
            statuses,
            cells,
            runs_per_second: rate,
            seconds_left: rate.map(|rate| planned.saturating_sub(done) as f64 / rate),
            name: results.name,
            identity: results.manifest.identity,
            shard: results.manifest.shard,
            started: results.manifest.started,
            finished: results.manifest.finished,
            resumed: results.manifest.resumed,
        })
    }

    /// For people.
    pub fn render(&self) -> String {
        let part = if self.shard.is_empty() { String::new() } else { format!(", part {}", self.shard) };
        let state = match (self.finished.is_empty(), self.running) {
            (false, _) => format!("finished {}", self.finished),
            (true, true) => "running".to_owned(),
            (true, false) => "interrupted: go on with --resume".to_owned(),
        };
        let resumed = match self.resumed {
            0 => String::new(),
            1 => ", resumed once".to_owned(),
            n => format!(", resumed {n} times"),
        };
        let mut out =
            format!("{}{part} (identity {})\nbegun {}{resumed}; {state}\n", self.name, self.identity, self.started);
        let missing = self.planned.saturating_sub(self.done);
        out.push_str(&format!("{} of {} runs are there, {missing} missing\n", self.done, self.planned));
        if let (Some(rate), Some(left)) = (self.runs_per_second, self.seconds_left) {
            out.push_str(&format!("{rate:.1} runs a second: about {} left\n", duration(left)));
        }
        let statuses: Vec<String> = self.statuses.iter().map(|(name, n)| format!("{name} {n}")).collect();
        if !statuses.is_empty() {
            out.push_str(&format!("ended as: {}\n", statuses.join(", ")));
        }
        out.push_str(&self.table());
        out
    }

    fn table(&self) -> String {
        let notable = |cell: &&Cell| self.cells.len() <= ALL_ROWS || cell.done < cell.planned || cell.failed > 0;
        let rows: Vec<&Cell> = self.cells.iter().filter(notable).collect();
        let mut table = Table::new();
        let line = LineStyle::none().fill('─').junction('─');
        table.load_style(TableStyle::new().header_separator(line).bottom_border(line));
        table.set_header(["scene", "planner", "done", "missing", "failed"]);
        for cell in rows.iter().take(MOST_ROWS) {
            let Cell { scene, planner, planned, done, failed } = cell;
            let missing = planned.saturating_sub(*done).to_string();
            table.add_row([scene.clone(), planner.clone(), format!("{done}/{planned}"), missing, failed.to_string()]);
        }
        for column in table.column_iter_mut().skip(2) {
            column.set_cell_alignment(CellAlignment::Right);
        }
        let mut out = if rows.is_empty() { String::new() } else { format!("\n{table}\n") };
        if let Some(more @ 1..) = rows.len().checked_sub(MOST_ROWS) {
            out.push_str(&format!("and {more} more rows: see --json\n"));
        }
        if let Some(complete @ 1..) = self.cells.len().checked_sub(rows.len()) {
            out.push_str(&format!("{complete} more pairs of scene and planner are complete and without failures\n"));
        }
        out
    }
}
