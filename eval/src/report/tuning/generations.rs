//! Greatest and mean fitness by generation, a panel for each planner that searches, all on one scale.
//!
//! Each line is the median over seeds and each band the middle half. Fang (2009) shows convergence at generations 4
//! and 9; so does the table.

use std::fmt::Write as _;

use minijinja::{Value, context};

use super::super::axis::Axis;
use super::super::data_table::{number, planner_row, table};
use super::super::language::Strings;
use super::super::svg::escape;
use super::super::{chart, palette};
use super::{fitness, is_tuned, middle, tunings};
use crate::format;
use crate::results::{GenerationRecord, Results, TuningRun};

/// Generations that Fang (2009, chapter 5) shows; the first population is generation 0.
const MILESTONES: [usize; 2] = [4, 9];
/// Height of a panel, its heading included.
const PANEL: f64 = 230.0;
/// Room for the heading and the names of milestones.
const HEAD: f64 = 52.0;
const TOP: f64 = 8.0;

/// One planner's curves: for each generation median and quartiles over seeds.
struct Curves<'a> {
    label: &'a str,
    index: usize,
    best: Vec<[f64; 3]>,
    mean: Vec<[f64; 3]>,
    seeds: usize,
}

impl<'a> Curves<'a> {
    fn new(label: &'a str, index: usize, runs: &[&TuningRun]) -> Self {
        let most = runs.iter().map(|r| r.generations.len()).max().unwrap_or(0);
        let over = |value: &dyn Fn(&GenerationRecord) -> f64| {
            let at = |g: usize| runs.iter().filter_map(|r| r.generations.get(g)).map(value).collect::<Vec<f64>>();
            (0..most).filter_map(|g| middle(&at(g))).collect::<Vec<[f64; 3]>>()
        };
        let seeds = runs.iter().filter(|r| !r.generations.is_empty()).count();
        Self { label, index, best: over(&|g| g.max), mean: over(&|g| g.mean), seeds }
    }
}

/// The figure with its table; `None` where nothing was searched.
pub fn figure(results: &Results, t: &Strings) -> Option<Value> {
    let of = |index: usize| {
        let runs = tunings(results, index);
        is_tuned(&runs).then(|| Curves::new(&results.planners[index].label, index, &runs))
    };
    let curves: Vec<Curves<'_>> = (0..results.planners.len()).filter_map(of).collect();
    let last = curves.iter().map(|c| c.best.len()).max()?.saturating_sub(1);
    let values =
        || curves.iter().flat_map(|c| c.best.iter().chain(&c.mean)).flatten().copied().filter(|v| v.is_finite());
    let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let pad = 0.05 * (high - low);
    let x = Axis::linear(0.0, last.max(1) as f64, chart::LEFT, chart::RIGHT);
    let bottom = TOP + PANEL * curves.len() as f64 - 14.0;
    let seeds = curves.iter().map(|c| c.seeds).max().unwrap_or(0);
    let title = t.get("generations_title");
    let text = t.plural(seeds, "generations_text_one", "generations_text");
    let id = "generations";
    let mut svg = chart::open(id, bottom + 58.0, title, &text);
    svg += &chart::x_grid(&x, TOP + HEAD, bottom, &format::count);
    for (k, c) in curves.iter().enumerate() {
        let top = TOP + PANEL * k as f64;
        let y = Axis::linear(low - pad, high + pad, top + PANEL - 14.0, top + HEAD);
        svg += &panel(c, top, &x, &y, last, t);
    }
    let _ = write!(
        svg,
        r#"<text class="axis end" x="{}" y="{:.1}">{}</text></svg>"#,
        chart::RIGHT,
        bottom + 48.0,
        escape(t.get("fitness_x"))
    );
    Some(context! {
        id, title, text, svg => Value::from_safe_string(svg), keys => Vec::<Value>::new(), table => data(&curves, last, t),
    })
}

fn panel(c: &Curves<'_>, top: f64, x: &Axis, y: &Axis, last: usize, t: &Strings) -> String {
    let mut out = format!(
        r#"<g data-series="{}">{}<text class="row" x="24" y="{:.1}">{}</text>"#,
        c.index,
        palette::marker(c.index, 12.0, top + 15.0),
        top + 20.0,
        escape(c.label)
    );
    let (upper, lower) = (top + HEAD, top + PANEL - 14.0);
    out += &chart::y_grid(y, 5, &fitness);
    for g in MILESTONES.into_iter().filter(|g| *g <= last) {
        let at = x.at(g as f64);
        let words = t.fill("generations_mark", &[("n", &g.to_string())]);
        let _ = write!(
            out,
            r#"<path class="milestone" d="M{at:.1} {upper:.1}V{lower:.1}"/><text class="middle milestone-name" x="{at:.1}" y="{:.1}">{}</text>"#,
            upper - 6.0,
            escape(&words)
        );
    }
    let colour = palette::colour(c.index);
    for (curve, class) in [(&c.mean, "mean"), (&c.best, "best")] {
        let place = |g: usize, k: usize| format!("{:.1} {:.1}", x.at(g as f64), y.at(curve[g][k]));
        let upper: Vec<String> = (0..curve.len()).map(|g| place(g, 2)).collect();
        let under: Vec<String> = (0..curve.len()).rev().map(|g| place(g, 1)).collect();
        let line: Vec<String> = (0..curve.len()).map(|g| place(g, 0)).collect();
        // A lone generation is a dot.
        let dot = if line.len() == 1 { "h.1" } else { "" };
        let _ = write!(
            out,
            r#"<path class="band fill {colour}" d="M{}L{}z"/><path class="line {colour} {class}" d="M{}{dot}"/>"#,
            upper.join("L"),
            under.join("L"),
            line.join("L")
        );
    }
    for g in MILESTONES.into_iter().filter(|g| *g < c.best.len()) {
        out += &palette::marker(c.index, x.at(g as f64), y.at(c.best[g][0]));
        out += &palette::marker(c.index, x.at(g as f64), y.at(c.mean[g][0]));
    }
    out + "</g>"
}

/// Generations that the table reads: the first, those of the thesis, and the last.
fn columns(last: usize) -> Vec<usize> {
    let mut columns = vec![0];
    columns.extend(MILESTONES.into_iter().filter(|g| *g < last));
    columns.push(last);
    columns.dedup();
    columns
}

fn data(curves: &[Curves<'_>], last: usize, t: &Strings) -> Value {
    let columns = columns(last);
    let heads: Vec<String> = ["generations_max", "generations_mean"]
        .iter()
        .flat_map(|key| columns.iter().map(|g| t.fill(key, &[("n", &g.to_string())])))
        .collect();
    let heads: Vec<&str> = [t.get("head_planner")].into_iter().chain(heads.iter().map(String::as_str)).collect();
    let cell = |curve: &[[f64; 3]], g: usize| {
        curve.get(g).map_or_else(
            || number(format::NONE, f64::INFINITY),
            |[median, low, high]| {
                let small =
                    if low == high { String::new() } else { format!("[{}, {}]", fitness(*low), fitness(*high)) };
                context! { shown => fitness(*median), key => format::sort_key(*median), kind => "num", small }
            },
        )
    };
    let rows = curves.iter().map(|c| {
        let both = [&c.best, &c.mean];
        let cells = both.iter().flat_map(|curve| columns.iter().map(|g| cell(curve, *g))).collect();
        planner_row(c.label, c.index, cells)
    });
    table("generations-data", t.get("generations_table"), &heads, rows.collect())
}
