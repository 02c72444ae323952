//! Length against risk: one point a planner, and the Pareto front of them all.
//!
//! Both are the planner's own terms of its objective (Wang & Zhu 2018: L and W), so only planners
//! that report both take part. A planner is on the front when none other is at least as good in
//! both and better in one; the staircase bounds what is no better than some planner here.

use std::fmt::Write as _;

use minijinja::{Value, context};

use super::convergence::Series;
use super::language::Strings;
use super::svg::escape;
use super::{axis::Axis, chart, palette};
use crate::format;
use crate::statistics::median;

const TOP: f64 = 34.0;
const BOTTOM: f64 = 392.0;
const HEIGHT: f64 = 452.0;

struct Dot<'a> {
    label: &'a str,
    index: usize,
    length: f64,
    risk: f64,
    runs: usize,
    valid: usize,
    front: bool,
}

/// The figure: chart, paragraph and table; `None` with fewer than two points.
pub fn figure(id: &str, series: &[Series<'_>], t: &Strings) -> Option<Value> {
    let mut dots: Vec<Dot<'_>> = series.iter().filter_map(dot).collect();
    if dots.len() < 2 {
        return None;
    }
    let all: Vec<(f64, f64)> = dots.iter().map(|d| (d.length, d.risk)).collect();
    for d in &mut dots {
        d.front = !all.iter().any(|other| dominates(*other, (d.length, d.risk)));
    }
    let padded = |value: &dyn Fn(&Dot<'_>) -> f64, from: f64, to: f64| {
        let values = || dots.iter().map(value);
        let (lo, hi) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        let pad = 0.06 * (hi - lo);
        Axis::linear(lo - pad, hi + pad, from, to)
    };
    let x = padded(&|d| d.length, chart::LEFT, chart::RIGHT);
    let y = padded(&|d| d.risk, BOTTOM, TOP);
    let title = t.get("pareto_title");
    let text = t.get("pareto_text").to_owned();
    let number = |v: f64| format::significant(v, 5);
    let mut svg = chart::open(id, HEIGHT, title, &text);
    svg += &chart::x_grid(&x, TOP, BOTTOM, &number);
    svg += &chart::y_grid(&y, 8, &number);
    let _ = write!(
        svg,
        r#"<text class="axis" x="4" y="24">{}</text><text class="axis end" x="{}" y="{:.0}">{}</text>"#,
        escape(t.get("pareto_risk")),
        chart::RIGHT,
        HEIGHT - 10.0,
        escape(t.get("pareto_length"))
    );
    let stairs = staircase(&dots, &x, &y);
    svg += &draw(&stairs);
    let places: Vec<(f64, f64)> = dots.iter().map(|d| (x.at(d.length), y.at(d.risk))).collect();
    for (d, (px, py)) in dots.iter().zip(&places) {
        let _ = write!(svg, r#"<g data-series="{}"><title>{}</title>"#, d.index, escape(d.label));
        if d.front {
            let _ = write!(svg, r#"<circle class="front" cx="{px:.1}" cy="{py:.1}" r="9"/>"#);
        }
        svg += &palette::marker(d.index, *px, *py);
        svg += "</g>";
    }
    svg += &labels(&dots, &places, &stairs);
    svg += "</svg>";
    dots.sort_by(|a, b| a.length.total_cmp(&b.length).then(a.index.cmp(&b.index)));
    let rows: Vec<Value> = dots
        .iter()
        .map(|d| {
            let cells = vec![
                format::length(d.length),
                format::significant(d.risk, 6),
                t.get(if d.front { "yes" } else { "no" }).to_owned(),
                format!("{}/{}", d.valid, d.runs),
            ];
            context! { label => d.label, swatch => Value::from_safe_string(palette::swatch(d.index)), cells }
        })
        .collect();
    Some(context! { svg => Value::from_safe_string(svg), text, rows, length_head => t.get("pareto_length") })
}

/// Medians over the runs that report both terms.
fn dot<'a>(series: &Series<'a>) -> Option<Dot<'a>> {
    let both: Vec<(f64, f64)> = series.runs.iter().filter_map(|r| r.term("length").zip(r.term("risk"))).collect();
    let [lengths, risks]: [Vec<f64>; 2] = [both.iter().map(|b| b.0).collect(), both.iter().map(|b| b.1).collect()];
    let valid = series.runs.iter().filter(|r| r.valid).count();
    let (length, risk) = (median(&lengths)?, median(&risks)?);
    Some(Dot { label: series.label, index: series.index, length, risk, runs: series.runs.len(), valid, front: false })
}

/// Whether `a` is at least as good as `b` in both and better in one; less is better.
fn dominates(a: (f64, f64), b: (f64, f64)) -> bool {
    a.0 <= b.0 && a.1 <= b.1 && a != b
}

/// The corners of the border of what the front's points dominate.
fn staircase(dots: &[Dot<'_>], x: &Axis, y: &Axis) -> Vec<(f64, f64)> {
    let mut front: Vec<(f64, f64)> = dots.iter().filter(|d| d.front).map(|d| (d.length, d.risk)).collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut corners = Vec::new();
    let mut above = TOP;
    for (px, py) in front.iter().map(|(length, risk)| (x.at(*length), y.at(*risk))) {
        corners.extend([(px, above), (px, py)]);
        above = py;
    }
    corners.push((chart::RIGHT, above));
    corners
}

fn draw(stairs: &[(f64, f64)]) -> String {
    let corners: Vec<String> = stairs.iter().map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
    format!(r#"<path class="stairs" d="M{}"/>"#, corners.join("L"))
}

/// A name beside each point, of points at one place together, where there is room, on the
/// dashed steps only where there is none elsewhere; the table has them all.
fn labels(dots: &[Dot<'_>], places: &[(f64, f64)], stairs: &[(f64, f64)]) -> String {
    let mut out = String::new();
    let mut taken: Vec<[f64; 4]> = places.iter().map(|(x, y)| [x - 9.0, y - 9.0, x + 9.0, y + 9.0]).collect();
    for (i, (px, py)) in places.iter().enumerate() {
        let here = |j: usize| (places[j].0 - px).hypot(places[j].1 - py) < 3.0;
        if (0..i).any(here) {
            continue; // named with the first
        }
        let names: Vec<&str> = (i..dots.len()).filter(|j| here(*j)).map(|j| dots[j].label).collect();
        let name = names.join(" · ");
        // Wide enough for most fonts; CJK characters are about twice as wide.
        let width: f64 = name.chars().map(|c| if c.is_ascii() { 8.2 } else { 15.0 }).sum();
        let spots = [
            (px + 14.0, py + 5.0, ""),
            (px - 14.0, py + 5.0, "end"),
            (*px, py - 14.0, "middle"),
            (*px, py + 26.0, "middle"),
            (px + 11.0, py - 10.0, ""),
            (px + 11.0, py + 20.0, ""),
            (px - 11.0, py - 10.0, "end"),
            (px - 11.0, py + 20.0, "end"),
        ];
        let fit = |on_stairs: bool| {
            spots.iter().find_map(|(x, y, anchor)| {
                let left = match *anchor {
                    "end" => x - width,
                    "middle" => x - 0.5 * width,
                    _ => *x,
                };
                let b = [left, y - 13.0, left + width, y + 4.0];
                let inside = b[0] > chart::LEFT && b[2] < chart::WIDTH && b[1] > TOP - 14.0 && b[3] < BOTTOM;
                let clear = taken.iter().all(|o| b[0] > o[2] || b[2] < o[0] || b[1] > o[3] || b[3] < o[1]);
                let crossed = !on_stairs
                    && stairs.windows(2).any(|s| {
                        let ([(x0, y0), (x1, y1)], pad) = ([s[0], s[1]], 2.0);
                        b[0] < x0.max(x1) + pad
                            && b[2] > x0.min(x1) - pad
                            && b[1] < y0.max(y1) + pad
                            && b[3] > y0.min(y1) - pad
                    });
                (inside && clear && !crossed).then_some((b, *x, *y, *anchor))
            })
        };
        if let Some((b, x, y, anchor)) = fit(false).or_else(|| fit(true)) {
            taken.push(b);
            let _ = write!(out, r#"<text class="label {anchor}" x="{x:.1}" y="{y:.1}">{}</text>"#, escape(&name));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Language;
    use crate::report::tests::run;

    #[test]
    fn labels_keep_off_the_steps() {
        let dot = |label, index, length, risk| Dot { label, index, length, risk, runs: 1, valid: 1, front: true };
        let dots = [dot("low", 0, 0.0, 0.0)];
        let places = [(300.0, 200.0)];
        // Down to the point and on to the right: the usual place, right of the point, is taken.
        let stairs = [(300.0, TOP), (300.0, 200.0), (chart::RIGHT, 200.0)];
        assert!(labels(&dots, &places, &[]).contains("class=\"label \" x=\"314.0\""));
        assert!(labels(&dots, &places, &stairs).contains("class=\"label end\" x=\"286.0\""));
        // Steps everywhere: better on them than nowhere.
        let everywhere: Vec<(f64, f64)> =
            (0..40).map(|k| (20.0 * f64::from(k), if k % 4 < 2 { 0.0 } else { 400.0 })).collect();
        assert!(labels(&dots, &places, &everywhere).contains(">low<"));
    }

    #[test]
    fn the_front_is_what_nothing_dominates() {
        assert!(dominates((1.0, 1.0), (1.0, 2.0)) && dominates((1.0, 1.0), (2.0, 2.0)));
        assert!(!dominates((1.0, 1.0), (1.0, 1.0)), "equals do not beat each other");
        assert!(!dominates((1.0, 3.0), (2.0, 2.0)));
        let points = [(10.0, 9.0), (12.0, 5.0), (12.5, 6.0), (15.0, 1.0), (15.0, 1.0), (16.0, 1.0)];
        let labels = ["a", "b", "c", "d", "e", "f"];
        let runs: Vec<_> = points
            .iter()
            .map(|(length, risk)| {
                let mut r = run("s", "p", 0, Some(11.0));
                r.terms = vec![("length".to_owned(), *length), ("risk".to_owned(), *risk)];
                r
            })
            .collect();
        let series: Vec<Series<'_>> =
            runs.iter().enumerate().map(|(index, r)| Series { label: labels[index], index, runs: vec![r] }).collect();
        let t = Strings::new(Language::English);
        let value = figure("x", &series, &t).unwrap();
        let rows: Vec<Value> = value.get_attr("rows").unwrap().try_iter().unwrap().collect();
        let on: Vec<String> = rows
            .iter()
            .filter(|r| r.get_attr("cells").unwrap().get_item(&2.into()).unwrap().as_str() == Some("yes"))
            .map(|r| r.get_attr("label").unwrap().to_string())
            .collect();
        assert_eq!(on, ["a", "b", "d", "e"], "and points at one place are both on it");
        let svg = value.get_attr("svg").unwrap().to_string();
        assert!(svg.contains(">d · e</text>"), "{svg}");
        assert_eq!(svg.matches("class=\"front\"").count(), 4);
        assert!(figure("x", &series[..1], &t).is_none(), "one point is no scatter");
        let plain = run("s", "p", 0, Some(11.0));
        assert!(dot(&Series { label: "plain", index: 0, runs: vec![&plain] }).is_none(), "without the terms");
    }
}
