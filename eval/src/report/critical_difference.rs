//! Critical-difference diagram: mean ranks, and bars that join planners which cannot be told apart.
//!
//! Demšar, *Statistical comparisons of classifiers over multiple data sets*, JMLR 7 (2006) 1–30. One row a planner
//! instead of labels on two sides, its name over its mark in as many lines as it needs, so that long labels and many
//! planners have room.

use std::fmt::Write as _;

use minijinja::{Value, context};

use super::axis::Axis;
use super::data_table::{figure as cell, planner_row, table};
use super::evidence::Evidence;
use super::language::Strings;
use super::phrases;
use super::svg::escape;
use super::{chart, palette};
use crate::analysis::ranking::{ALPHA, Ranking, rank};
use crate::analysis::{Measure, Over};
use crate::format;

const ID: &str = "critical";
const LEFT: f64 = 30.0;
const TOP: f64 = 92.0;
/// Height of one line of a name; on narrow screens letters are 22 units high.
const NAME: f64 = 26.0;
/// Height of the band that a mark stands in, below its name.
const MARK: f64 = 24.0;
/// Width of one column of bars.
const BAR: f64 = 12.0;
/// Width of a bold letter of 22 units, on average, and a little.
const LETTER: f64 = 13.5;

/// The figure by quality; `None` where there is nothing to rank.
pub fn figure(evidence: &Evidence<'_>, t: &Strings) -> Option<Value> {
    let ranking = rank(&evidence.grid, evidence.quality.measure)?;
    let columns = columns(&ranking.groups);
    let gutter = BAR * columns.iter().max().map_or(0.0, |c| (c + 1) as f64) + 12.0;
    let k = ranking.order.len();
    let x = Axis::linear(1.0, k as f64, LEFT, chart::WIDTH - LEFT - gutter);
    let letters = ((chart::WIDTH - 2.0 * LEFT - gutter) / LETTER) as usize;
    let names: Vec<Vec<String>> = ranking.order.iter().map(|p| lines(evidence.label(*p), letters)).collect();
    let mut tops = vec![TOP];
    tops.extend(names.iter().scan(TOP, |top, name| {
        *top += NAME * name.len() as f64 + MARK;
        Some(*top)
    }));
    let bottom = tops[k];
    let title = t.get("critical_title");
    let text = text(&ranking, t);
    let mut svg = chart::open(ID, bottom + 48.0, title, &text);
    svg += &chart::x_grid(&x, TOP, bottom, &|v| format::significant(v, 3));
    let (from, to) = (x.at(1.0), x.at(1.0 + ranking.critical));
    let said = t.fill("critical_bar", &[("value", &format::significant(ranking.critical, 3))]);
    let _ = write!(
        svg,
        r#"<text class="axis" x="{from:.1}" y="30">{}</text><path class="difference" d="M{from:.1} 42v12M{from:.1} 48H{to:.1}M{to:.1} 42v12"/><text class="axis" x="{LEFT}" y="{:.1}">{}</text>"#,
        escape(&said),
        TOP - 14.0,
        escape(t.get("critical_x"))
    );
    for (place, planner) in ranking.order.iter().enumerate() {
        let py = tops[place + 1] - 0.5 * MARK;
        let _ = write!(
            svg,
            r#"<g data-series="{planner}"><title>{}</title><path class="grid" d="M{LEFT} {py:.1}H{:.1}"/>{}"#,
            escape(evidence.label(*planner)),
            x.at(k as f64),
            palette::marker(*planner, x.at(ranking.test.mean_ranks[*planner]), py)
        );
        for (n, line) in names[place].iter().enumerate() {
            let base = tops[place] + NAME * (n as f64 + 0.8);
            let _ = write!(svg, r#"<text class="row" x="{LEFT}" y="{base:.1}">{}</text>"#, escape(line));
        }
        svg += "</g>";
    }
    for ([first, last], column) in ranking.groups.iter().zip(&columns) {
        let px = chart::WIDTH - LEFT - gutter + 18.0 + BAR * *column as f64;
        let (y0, y1) = (tops[*first] + 6.0, tops[*last + 1] - 4.0);
        let _ = write!(svg, r#"<path class="group" d="M{px:.1} {y0:.1}V{y1:.1}"/>"#);
    }
    svg += "</svg>";
    let rows = ranking.order.iter().enumerate().map(|(place, planner)| {
        let alike: Vec<String> = ranking
            .order
            .iter()
            .enumerate()
            .filter(|(other, _)| {
                *other != place
                    && ranking.groups.iter().any(|[a, b]| (*a..=*b).contains(&place) && (*a..=*b).contains(other))
            })
            .map(|(_, p)| evidence.label(*p).to_owned())
            .collect();
        let cells = vec![
            cell(format::significant(ranking.test.mean_ranks[*planner], 4)),
            super::data_table::words(if alike.is_empty() { format::NONE.to_owned() } else { t.list(&alike) }),
        ];
        planner_row(evidence.label(*planner), *planner, cells)
    });
    let heads = [t.get("head_planner"), t.get("critical_rank"), t.get("critical_alike")];
    let data = table("critical-data", t.get("critical_table"), &heads, rows.collect());
    let keys: Vec<Value> = Vec::new();
    Some(context! { id => ID, title, svg => Value::from_safe_string(svg), text, keys, table => data })
}

fn text(ranking: &Ranking, t: &Strings) -> String {
    let blocks = ranking.test.blocks.to_string();
    let measure = match ranking.measure {
        Measure::Gap => "critical_gap",
        Measure::Length => "critical_length",
        Measure::Time => "critical_time",
    };
    let over = match ranking.over {
        Over::Repeats => t.fill("critical_repeats", &[("n", &blocks)]),
        Over::Scenes => t.fill("critical_scenes", &[("n", &blocks)]),
    };
    let p = phrases::p_value(ranking.test.p);
    let mut sentences = vec![
        t.fill("critical_text", &[("measure", t.get(measure)), ("over", &over)]),
        t.fill("critical_friedman", &[("p", &p)]),
        t.fill("critical_nemenyi", &[("alpha", &ALPHA.to_string())]),
    ];
    if ranking.incomplete > 0 {
        sentences.push(t.fill("critical_incomplete", &[("n", &ranking.incomplete.to_string())]));
    }
    sentences.join(t.get("sentence_gap"))
}

/// For each bar the first column in which nothing is in its way.
fn columns(groups: &[[usize; 2]]) -> Vec<usize> {
    let mut ends: Vec<usize> = Vec::new();
    let mut out = Vec::new();
    for [first, last] in groups {
        let column = ends.iter().position(|end| end < first).unwrap_or(ends.len());
        if column == ends.len() {
            ends.push(*last);
        } else {
            ends[column] = *last;
        }
        out.push(column);
    }
    out
}

/// `label` in lines of at most `letters` Latin letters, broken after spaces and brackets where it has any.
fn lines(label: &str, letters: usize) -> Vec<String> {
    // Chinese characters are about twice as wide.
    let width = |c: char| if c.is_ascii() { 1 } else { 2 };
    let (mut lines, mut line, mut used) = (Vec::new(), String::new(), 0);
    for c in label.chars() {
        if used + width(c) > letters && !line.is_empty() {
            let rest = line.rfind([' ', '[']).map_or(String::new(), |at| line.split_off(at + 1));
            used = rest.chars().map(width).sum();
            lines.push(std::mem::replace(&mut line, rest));
        }
        line.push(c);
        used += width(c);
    }
    lines.push(line);
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_that_overlap_stand_beside_each_other() {
        assert_eq!(columns(&[[0, 2], [1, 4], [3, 5], [5, 6], [7, 8]]), [0, 1, 0, 1, 0]);
    }

    #[test]
    fn names_are_broken_not_cut() {
        assert_eq!(lines("pso", 20), ["pso"]);
        assert_eq!(
            lines("pso[velocity_limit=0.25, 2000 evaluations]", 26),
            ["pso[velocity_limit=0.25, ", "2000 evaluations]"]
        );
        assert_eq!(lines("一二三四五", 4), ["一二", "三四", "五"]);
        assert_eq!(lines(&"x".repeat(45), 20).iter().map(String::len).collect::<Vec<_>>(), [20, 20, 5]);
        assert_eq!(lines("", 20), [""]);
    }
}
