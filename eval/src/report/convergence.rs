//! Convergence: the best cost so far against evaluations, median and quartiles over runs.
//!
//! A run's curve is a step function: its cost at x evaluations is that of its last
//! improvement at or before x, +∞ before the first, and after the last it stays.
//! Medians and quartiles are taken over all runs, those that never became valid included.
//! The chart shows cost/optimum − 1 (Hansen et al., *COCO*, Optim. Methods Softw. 36
//! (2021) 114–144, plot the like precision); where the optimum is not known, the least
//! cost that any run reached takes its place. Only costs that are lengths compare with either,
//! so planners whose objective is something else are named and left out.

use std::fmt::Write as _;

use minijinja::{Value, context};

use super::language::Strings;
use super::svg::escape;
use super::{axis::Axis, chart, palette};
use crate::format;
use crate::results::RunRecord;
use crate::statistics::quantile;

/// The runs of one planner.
pub struct Series<'a> {
    /// Label of the planner.
    pub label: &'a str,
    /// Its place in the comparison.
    pub index: usize,
    /// Its runs in one scene.
    pub runs: Vec<&'a RunRecord>,
}

const TOP: f64 = 34.0;
const BOTTOM: f64 = 352.0;
const HEIGHT: f64 = 412.0;
/// Places along the axis at which curves are evaluated.
const SAMPLES: usize = 240;
/// Below this excess the cost equals the optimum as far as a report goes.
const FLOOR: f64 = 1e-8;
/// A valid path's cost that differs from its length by more than this share is not a length:
/// arcs stored as polylines differ from the arc's length by up to 10⁻⁶, sums by their rounding.
const OTHER: f64 = 1e-5;

/// Cost of `run` at `x` evaluations.
fn cost_at(run: &RunRecord, x: f64) -> f64 {
    let done = run.progress.partition_point(|p| p.evaluations as f64 <= x);
    done.checked_sub(1).map_or(f64::INFINITY, |i| finite_or_infinite(run.progress[i].cost))
}

fn finite_or_infinite(cost: f64) -> f64 {
    if cost.is_nan() { f64::INFINITY } else { cost }
}

/// Quartiles of the cost over `runs` at `x` evaluations.
fn quartiles(runs: &[&RunRecord], x: f64) -> [f64; 3] {
    let costs: Vec<f64> = runs.iter().map(|r| cost_at(r, x)).collect();
    [0.25, 0.5, 0.75].map(|q| quantile(&costs, q).unwrap_or(f64::INFINITY))
}

/// Evaluations that the longest run of a series made.
fn end(runs: &[&RunRecord]) -> f64 {
    let last = |r: &&RunRecord| r.evaluations.max(r.progress.last().map_or(0, |p| p.evaluations));
    runs.iter().map(last).max().unwrap_or(0) as f64
}

/// Whether the planner's cost is something else than the path's length: some valid run tells.
fn is_other(series: &Series<'_>) -> bool {
    let mut ends = series.runs.iter().filter(|r| r.valid).filter_map(|r| r.cost.zip(r.length));
    ends.any(|(cost, length)| (cost - length).abs() > OTHER * length.abs())
}

fn reports(series: &Series<'_>) -> bool {
    series.runs.iter().any(|r| !r.progress.is_empty())
}

/// What to say where there is no chart.
pub fn nothing(series: &[Series<'_>], t: &Strings) -> String {
    let other: Vec<String> = series.iter().filter(|s| reports(s) && is_other(s)).map(|s| s.label.to_owned()).collect();
    if other.is_empty() {
        t.get("convergence_none").to_owned()
    } else {
        t.fill("convergence_other", &[("planners", &t.list(&other))])
    }
}

/// The figure: chart, paragraph and table; `None` when no run reported progress towards a length.
pub fn figure(id: &str, series: &[Series<'_>], optimum: Option<f64>, unit: &str, t: &Strings) -> Option<Value> {
    let (other, with): (Vec<&Series<'_>>, Vec<&Series<'_>>) =
        series.iter().filter(|s| reports(s)).partition(|s| is_other(s));
    let other: Vec<String> = other.iter().map(|s| s.label.to_owned()).collect();
    let most = with.iter().map(|s| end(&s.runs)).fold(0.0, f64::max).max(1.0);
    let silent: Vec<String> = series
        .iter()
        .filter(|s| !s.runs.is_empty() && s.runs.iter().all(|r| r.progress.is_empty()))
        .map(|s| s.label.to_owned())
        .collect();
    // The yardstick: the optimum, else the least cost that any run reached.
    let last = |s: &Series<'_>| quartiles(&s.runs, most)[1];
    let costs = || with.iter().flat_map(|s| &s.runs).flat_map(|r| &r.progress).map(|p| finite_or_infinite(p.cost));
    let least = costs().fold(f64::INFINITY, f64::min);
    let reference = Some(optimum.unwrap_or(least)).filter(|o| *o > 0.0 && o.is_finite());
    // A cost below the optimum is not the length of a free path: its excess would say nothing.
    let (with, below): (Vec<&Series<'_>>, Vec<&Series<'_>>) =
        with.into_iter().partition(|s| reference.is_none_or(|o| last(s) >= o * (1.0 - 1e-6)));
    let below: Vec<String> = below.iter().map(|s| s.label.to_owned()).collect();
    let shown = |cost: f64| reference.map_or(cost, |o| (cost / o - 1.0).max(0.0));

    // Planners that iterate decide: one evaluation of a straight line should not squeeze the rest.
    let shortest = with.iter().map(|s| end(&s.runs)).filter(|e| *e > 10.0).fold(f64::INFINITY, f64::min);
    let x = if most > 20.0 * shortest {
        Axis::log(1.0, most, chart::LEFT, chart::RIGHT)
    } else {
        Axis::linear(0.0, most, chart::LEFT, chart::RIGHT)
    };
    // The ends as well, where a refinement may do in five evaluations what matters most.
    let mut places: Vec<f64> = (0..=SAMPLES).map(|k| x.value_at(k as f64 / SAMPLES as f64)).collect();
    places.extend(with.iter().map(|s| end(&s.runs)).filter(|e| *e > x.value_at(0.0)));
    places.sort_by(f64::total_cmp);
    let curves: Vec<(&Series<'_>, Vec<[f64; 3]>)> = with
        .iter()
        .map(|s| (*s, places.iter().map(|p| quartiles(&s.runs, p * (1.0 + 1e-9)).map(shown)).collect()))
        .collect();
    let values = || curves.iter().flat_map(|(_, c)| c).flatten().copied();
    let y = Axis::fitting(values(), 10.0, FLOOR, BOTTOM, TOP)?;

    let title = t.get("convergence_title");
    let (y_name, meaning) = match (reference, optimum) {
        (Some(_), Some(_)) => (t.get("convergence_y_excess").to_owned(), "convergence_excess"),
        (Some(_), None) => (t.get("convergence_y_best").to_owned(), "convergence_best"),
        (None, _) => (t.fill("convergence_y_cost", &[("unit", unit)]), "convergence_cost"),
    };
    let number = |v: f64| if reference.is_some() { format::percent_tick(v) } else { format::significant(v, 6) };
    let mut text = text(series, meaning, y.is_log(), t);
    if y.is_log() && values().any(|v| v < y.value_at(0.0)) {
        text += t.get("sentence_gap");
        text += t.get("convergence_edge");
    }
    for (key, who) in [("convergence_other", &other), ("convergence_below", &below), ("convergence_silent", &silent)] {
        if !who.is_empty() {
            text += t.get("sentence_gap");
            text += &t.fill(key, &[("planners", &t.list(who))]);
        }
    }
    let mut svg = chart::open(id, HEIGHT, title, &text);
    svg += &chart::x_grid(&x, TOP, BOTTOM, &format::count);
    svg += &chart::y_grid(&y, 8, &number);
    let _ = write!(
        svg,
        r#"<text class="axis" x="{}" y="24">{}</text><text class="axis end" x="{}" y="{:.0}">{}</text>"#,
        4,
        escape(&y_name),
        chart::RIGHT,
        HEIGHT - 10.0,
        escape(t.get("convergence_x"))
    );
    let lines: Vec<String> = curves.iter().map(|(s, curve)| draw(s, curve, &places, &x, &y)).collect();
    svg += &lines.concat();
    svg += "</svg>";

    let columns = table_places(most);
    let rows: Vec<Value> = series
        .iter()
        .filter(|s| reports(s) && !is_other(s))
        .map(|s| {
            let cells: Vec<String> = columns
                .iter()
                .map(|c| {
                    let [low, middle, high] = quartiles(&s.runs, *c).map(|v| format::significant(v, 6));
                    if low == high { middle } else { format!("{middle} [{low}, {high}]") }
                })
                .collect();
            context! { label => s.label, swatch => Value::from_safe_string(palette::swatch(s.index)), cells }
        })
        .collect();
    let keys: Vec<Value> = with
        .iter()
        .map(|s| context! { label => s.label, index => s.index, swatch => Value::from_safe_string(palette::swatch(s.index)) })
        .collect();
    Some(context! {
        svg => Value::from_safe_string(svg), title, text, keys, rows,
        columns => columns.iter().map(|c| format::count(*c)).collect::<Vec<_>>(),
    })
}

fn text(series: &[Series<'_>], meaning: &str, log: bool, t: &Strings) -> String {
    let n = series.iter().map(|s| s.runs.len()).max().unwrap_or(0);
    let mut sentences = vec![t.plural(n, "convergence_text_one", "convergence_text"), t.get(meaning).to_owned()];
    if log {
        sentences.push(t.get("convergence_log").to_owned());
    }
    sentences.join(t.get("sentence_gap"))
}

/// Evaluations at which the table reads the curves: powers of ten and the end.
fn table_places(most: f64) -> Vec<f64> {
    let mut places: Vec<f64> = (0..18).map(|e| 10f64.powi(e)).take_while(|p| *p < 0.7 * most).collect();
    places.push(most);
    places
}

/// Band, median, its continuation after the planner's own end, and a marker there.
fn draw(series: &Series<'_>, curve: &[[f64; 3]], places: &[f64], x: &Axis, y: &Axis) -> String {
    let end = end(&series.runs).max(places[0]);
    let (i, colour) = (series.index, palette::colour(series.index));
    let last = places.iter().rposition(|p| *p <= end * (1.0 + 1e-9)).unwrap_or(0);
    let steps = |q: usize, range: &mut dyn Iterator<Item = usize>| {
        let mut out = String::new();
        let (mut pen_y, mut before) = (f64::NAN, f64::NAN);
        for k in range {
            let (px, py) = (x.at(places[k]), y.at(curve[k][q]));
            if out.is_empty() {
                let _ = write!(out, "{px:.1} {py:.1}");
                pen_y = py;
            } else if (py - pen_y).abs() >= 0.05 {
                // A curve changes at the right one of two places, whichever way it is drawn.
                let _ = write!(out, "H{:.1}V{py:.1}", px.max(before));
                pen_y = py;
            }
            before = px;
        }
        let _ = write!(out, "H{before:.1}");
        out
    };
    let known = |q: usize| (0..=last).find(|&k| curve[k][q].is_finite());
    let mut out = format!(r#"<g data-series="{i}"><title>{}</title>"#, escape(series.label));
    if let Some(first) = known(0).filter(|&f| f < last) {
        let upper = steps(2, &mut (first..=last));
        let lower = steps(0, &mut (first..=last).rev());
        let _ = write!(out, r#"<path class="band fill {colour}" d="M{upper}L{lower}z"/>"#);
    }
    if let Some(first) = known(1) {
        let _ = write!(out, r#"<path class="{} best" d="M{}"/>"#, palette::line(i), steps(1, &mut (first..=last)));
        if last + 1 < places.len() {
            let _ = write!(out, r#"<path class="line {colour} after" d="M{}"/>"#, steps(1, &mut (last..places.len())));
        }
        out += &palette::marker(i, x.at(places[last]), y.at(curve[last][1]));
    }
    out + "</g>"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::tests::run;
    use crate::results::Progress;

    #[test]
    fn a_run_holds_its_last_cost() {
        let mut r = run("a", "p", 0, None);
        let at = |evaluations, cost| Progress { evaluations, time_us: 0.0, cost };
        r.progress = vec![at(20, 9.0), at(40, 5.0)];
        assert_eq!([19.0, 20.0, 39.0, 40.0, 1e9].map(|x| cost_at(&r, x)), [f64::INFINITY, 9.0, 9.0, 5.0, 5.0]);
    }

    #[test]
    fn costs_that_are_no_lengths_are_named_and_not_drawn() {
        let of = |label: &'static str, cost: f64, valid: bool| {
            let mut r = run("a", label, 0, Some(12.0));
            (r.valid, r.cost) = (valid, Some(cost));
            r.progress = vec![Progress { evaluations: 1, time_us: 0.0, cost }];
            r
        };
        let runs = [
            of("metre", 12.0, true),
            of("arcs", 12.0 * (1.0 - 9e-7), true),
            of("weighted", 2412.0, true),
            of("less", 11.99, true),
            of("penalised", 1e4, false),
        ];
        let series: Vec<Series<'_>> =
            runs.iter().enumerate().map(|(index, r)| Series { label: &r.planner, index, runs: vec![r] }).collect();
        let t = Strings::new(crate::report::Language::English);
        for optimum in [Some(10.0), None] {
            let value = figure("x", &series, optimum, "m", &t).unwrap();
            let svg = value.get_attr("svg").unwrap().to_string();
            let text = value.get_attr("text").unwrap().to_string();
            assert!(text.contains("is not its length: weighted and less."), "{text}");
            for (index, drawn) in [true, true, false, false, true].into_iter().enumerate() {
                assert_eq!(svg.contains(&format!("data-series=\"{index}\"")), drawn, "{}", series[index].label);
            }
            assert_eq!(value.get_attr("rows").unwrap().len(), Some(3), "nor are they in the table");
        }
        assert!(figure("x", &series[2..4], Some(10.0), "m", &t).is_none());
        assert!(nothing(&series[2..4], &t).contains("weighted and less"));
        assert_eq!(nothing(&[], &t), t.get("convergence_none"));
    }

    #[test]
    fn medians_count_runs_that_have_nothing_yet() {
        let mut early = run("a", "p", 0, None);
        early.progress = vec![Progress { evaluations: 1, time_us: 0.0, cost: 3.0 }];
        let late = run("a", "p", 1, None);
        assert_eq!(quartiles(&[&early, &late, &late], 5.0)[1], f64::INFINITY);
        assert_eq!(quartiles(&[&early, &early, &late], 5.0)[1], 3.0);
    }
}
