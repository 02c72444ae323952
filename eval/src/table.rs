//! The comparison as a table for the terminal.

use comfy_table::{Cell, CellAlignment, LineStyle, Table, TableStyle};

use crate::results::Results;
use crate::stats::{Summary, summarise};

/// With more scenes only the table over all of them is printed.
const MOST_SCENES: usize = 4;

/// The tables: over all scenes when there are several, and one for each of a few.
pub fn render(results: &Results) -> String {
    let scenes: Vec<&str> = results.scenes.iter().map(|s| s.scene.name.as_str()).collect();
    let mut out = String::new();
    if scenes.len() > 1 {
        out.push_str(&format!("All {} scenes together\n{}\n", scenes.len(), one(results, None)));
    }
    if scenes.len() <= MOST_SCENES {
        for scene in &results.scenes {
            let name = &scene.scene.name;
            let optimum = match &scene.optimum.length {
                Some(length) => format!("optimum {}", length_text(*length)),
                None => format!("optimum unknown: {}", scene.optimum.reason.as_deref().unwrap_or("not computed")),
            };
            out.push_str(&format!("{name} ({}; {optimum})\n{}\n", scene.scene.unit, one(results, Some(name))));
        }
    } else {
        out.push_str("Scene by scene: see summary.csv and report.html.\n");
    }
    out.push_str("Runs without a valid path count as ∞. IQR: quartiles of the length. Median time of all runs.\n");
    out
}

fn one(results: &Results, scene: Option<&str>) -> String {
    let mut table = Table::new();
    let line = LineStyle::none().fill('─').junction('─');
    table.load_style(TableStyle::new().header_separator(line).bottom_border(line));
    let header = ["planner", "valid", "median length", "gap", "IQR", "median time", "evaluations"];
    table.set_header(header);
    for planner in &results.planners {
        if let Some(summary) = summarise(results, &planner.label, scene) {
            table.add_row(row(&summary));
        }
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

fn row(s: &Summary) -> Vec<Cell> {
    let [q1, q3] = s.length_quartiles.map(length_text);
    let cells = [
        s.planner.clone(),
        format!("{}/{}", s.valid, s.runs),
        length_text(s.length_median),
        s.gap_median.map_or_else(|| "–".to_owned(), percent_text),
        format!("{q1} … {q3}"),
        time_text(s.time_us_median),
        format!("{:.0}", s.evaluations_median),
    ];
    cells.into_iter().map(Cell::new).collect()
}

/// A length with six significant digits.
pub fn length_text(length: f64) -> String {
    if !length.is_finite() {
        return "∞".to_owned();
    }
    let whole = (length.abs().max(1e-9).log10().floor() as i32).clamp(-9, 5);
    format!("{length:.*}", (5 - whole) as usize)
}

/// A share in percent, two digits and enough of them to show small gaps.
pub fn percent_text(share: f64) -> String {
    let percent = 100.0 * share;
    match percent.abs() {
        p if !p.is_finite() => "∞".to_owned(),
        p if p >= 0.01 || p == 0.0 => format!("{percent:.2} %"),
        _ => format!("{percent:.1e} %"),
    }
}

/// A time in its natural unit.
pub fn time_text(us: f64) -> String {
    match us {
        t if t < 10.0 => format!("{t:.2} µs"),
        t if t < 1e3 => format!("{t:.0} µs"),
        t if t < 1e6 => format!("{:.2} ms", t / 1e3),
        t => format!("{:.2} s", t / 1e6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::Optimum;
    use crate::runner;
    use crate::testing::{campaign, detour, entry, straight};

    #[test]
    fn numbers_are_short_and_failures_infinite() {
        assert_eq!(length_text(231.588_978_257), "231.589");
        assert_eq!(length_text(0.012_345_678), "0.0123457");
        assert_eq!(length_text(1_234_567.8), "1234568");
        assert_eq!(length_text(f64::INFINITY), "∞");
        assert_eq!(percent_text(0.0444), "4.44 %");
        assert_eq!(percent_text(2.3e-9), "2.3e-7 %");
        assert_eq!(percent_text(f64::INFINITY), "∞");
        assert_eq!(time_text(0.612), "0.61 µs");
        assert_eq!(time_text(950.4), "950 µs");
        assert_eq!(time_text(1950.0), "1.95 ms");
    }

    #[test]
    fn the_table_as_printed() {
        let campaign = campaign(vec![entry("straight", straight), entry("detour", detour)]);
        let mut results = campaign.empty_results(1);
        results.scenes.truncate(1);
        results.scenes[0].optimum = Optimum { length: Some(10.25), path: Vec::new(), reason: None };
        runner::run(&campaign, &[Some(10.25), None], 1, |mut run| {
            (run.time_us, run.repeat) = (1250.0, 0);
            // One number for all, so that the picture is the same whatever the seeds.
            run.gap = run.gap.map(|_| 0.0625);
            run.length = run.length.map(|_| 10.890_625);
            results.runs.push(run);
            Ok::<(), ()>(())
        })
        .unwrap();
        let expected = "\
b-scene (m; optimum 10.2500)
 planner    valid   median length      gap                 IQR   median time   evaluations
───────────────────────────────────────────────────────────────────────────────────────────
 straight     0/5               ∞        ∞               ∞ … ∞       1.25 ms             4
 detour       5/5         10.8906   6.25 %   10.8906 … 10.8906       1.25 ms             4
───────────────────────────────────────────────────────────────────────────────────────────
Runs without a valid path count as ∞. IQR: quartiles of the length. Median time of all runs.
";
        let printed: Vec<String> = render(&results).lines().map(|l| l.trim_end().to_owned() + "\n").collect();
        assert_eq!(printed.concat(), expected, "\n{}", printed.concat());
    }
}
