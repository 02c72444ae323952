//! The comparison as a table for the terminal.

mod moving;

use comfy_table::{CellAlignment, LineStyle, Table, TableStyle};

use crate::analysis::{Summary, summarise};
use crate::format;
use crate::results::{Results, SceneSet, Subject};

/// With more scenes only the table over all of them is printed.
const MOST_SCENES: usize = 4;

/// The tables: over all scenes when there are several, and one for each of a few.
pub fn render(results: &Results) -> String {
    if results.subject == Subject::Behaviour {
        let note = "Medians over repeats, each with scenarios of its own; fitness is better the nearer it is to 1.\n";
        return format!("{}\n{note}", moving::tunings(results));
    }
    let moves = results.subject == Subject::Simulation;
    let scenes: Vec<&str> = results.scenes.iter().map(|s| s.scene.name.as_str()).collect();
    let mut out = String::new();
    let tuning = results.scenes.iter().filter(|s| s.set == SceneSet::Tuning).count();
    let what = if tuning == 0 { "scenes" } else { "test scenes" };
    if scenes.len() - tuning > 1 {
        out.push_str(&format!("All {} {what} together\n{}\n", scenes.len() - tuning, one(results, None)));
    }
    if tuning > 0 {
        out.push_str(&format!("Settings were chosen on {tuning} more (tuning): no figure over scenes counts them.\n"));
    }
    if scenes.len() <= MOST_SCENES {
        for scene in &results.scenes {
            let name = &scene.scene.name;
            let optimum = match &scene.optimum.length {
                _ if moves => "moving".to_owned(),
                Some(length) => format!("optimum {}", format::length(*length)),
                None => format!("no valid path: {}", scene.optimum.reason.as_deref().unwrap_or("not computed")),
            };
            let tuning = if scene.set == SceneSet::Tuning { "; tuning" } else { "" };
            out.push_str(&format!("{name} ({}; {optimum}{tuning})\n{}\n", scene.scene.unit, one(results, Some(name))));
        }
    } else {
        out.push_str("Scene by scene: see summary.csv and report.html.\n");
    }
    if moves {
        out.push_str(moving::LEGEND);
        return out;
    }
    if scenes.len() - tuning > 1 {
        out.push_str("Over several scenes: medians and quartiles of the scenes' medians.\n");
    }
    out.push_str("Runs without a valid path count as ∞. IQR: quartiles of the length. Median time of all runs.\n");
    out
}

fn one(results: &Results, scene: Option<&str>) -> String {
    if results.subject == Subject::Simulation {
        return moving::simulations(results, scene);
    }
    let header = ["planner", "valid", "median length", "gap", "IQR", "median time", "evaluations"];
    let rows = results.planners.iter().filter_map(|planner| summarise(results, &planner.label, scene));
    framed(&header, rows.map(|summary| row(&summary)))
}

/// A table whose first column is text and whose others are figures.
fn framed(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut table = Table::new();
    let line = LineStyle::none().fill('─').junction('─');
    table.load_style(TableStyle::new().header_separator(line).bottom_border(line));
    table.set_header(header);
    for row in rows {
        table.add_row(row);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

fn row(s: &Summary) -> Vec<String> {
    let [q1, q3] = s.length_quartiles.map(format::length);
    vec![
        s.planner.clone(),
        format!("{}/{}", s.valid, s.runs),
        format::length(s.length_median),
        s.gap_median.map_or_else(|| "–".to_owned(), format::percent),
        format!("{q1} … {q3}"),
        format::time(s.time_us_median),
        format::count(s.evaluations_median),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::Optimum;
    use crate::runner;
    use crate::testing::{campaign, detour, entry, straight};
    use crate::work::Work;

    #[test]
    fn the_table_as_printed() {
        let campaign = campaign(vec![entry("straight", straight), entry("detour", detour)]);
        let mut results = campaign.empty_results(1);
        results.scenes.truncate(1);
        results.scenes[0].optimum = Optimum { length: Some(10.25), path: Vec::new(), reason: None };
        runner::run(&campaign, &[Some(10.25), None], &Work::all(1), |mut run| {
            (run.time_us, run.repeat) = (1250.0, 0);
            // One number for all, so that the picture is the same whatever the seeds.
            run.gap = run.gap.map(|_| 0.0625);
            run.length = run.length.map(|_| 10.890_625);
            results.runs.push(run);
            Ok(())
        })
        .unwrap();
        let expected = "\
b-scene (m; optimum 10.25)
 planner    valid   median length      gap                 IQR   median time   evaluations
───────────────────────────────────────────────────────────────────────────────────────────
 straight     0/5               ∞        ∞               ∞ … ∞       1.25\u{a0}ms             4
 detour       5/5         10.8906   6.25\u{a0}%   10.8906 … 10.8906       1.25\u{a0}ms             4
───────────────────────────────────────────────────────────────────────────────────────────
Runs without a valid path count as ∞. IQR: quartiles of the length. Median time of all runs.
";
        let printed: Vec<String> = render(&results).lines().map(|l| l.trim_end().to_owned() + "\n").collect();
        assert_eq!(printed.concat(), expected, "\n{}", printed.concat());
    }
}
