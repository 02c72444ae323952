//! Critical-difference diagram: mean ranks, and bars that join planners which cannot be told apart.
//!
//! Demšar, *Statistical comparisons of classifiers over multiple data sets*, JMLR 7 (2006) 1–30. One row a planner
//! instead of labels on two sides, so that long labels and many planners have room.

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
const ROW: f64 = 28.0;
/// Width of one column of bars.
const BAR: f64 = 12.0;
/// Letters of a label that have room beside its mark.
const LETTERS: usize = 26;

/// The figure by quality; `None` where there is nothing to rank.
pub fn figure(evidence: &Evidence<'_>, t: &Strings) -> Option<Value> {
    let ranking = rank(&evidence.grid, evidence.quality.measure)?;
    let columns = columns(&ranking.groups);
    let gutter = BAR * columns.iter().max().map_or(0.0, |c| (c + 1) as f64) + 12.0;
    let k = ranking.order.len();
    let x = Axis::linear(1.0, k as f64, LEFT, chart::WIDTH - LEFT - gutter);
    let bottom = TOP + ROW * k as f64;
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
    let middle = 0.5 * (x.at(1.0) + x.at(k as f64));
    for (place, planner) in ranking.order.iter().enumerate() {
        let (px, py) = (x.at(ranking.test.mean_ranks[*planner]), TOP + ROW * (place as f64 + 0.5));
        let (class, at) = if px < middle { ("row", px + 13.0) } else { ("row last", px - 13.0) };
        let label = evidence.label(*planner);
        let _ = write!(
            svg,
            r#"<g data-series="{planner}"><title>{}</title>{}<text class="{class}" x="{at:.1}" y="{:.1}">{}</text></g>"#,
            escape(label),
            palette::marker(*planner, px, py),
            py + 5.0,
            escape(&shortened(label))
        );
    }
    for ([first, last], column) in ranking.groups.iter().zip(&columns) {
        let px = chart::WIDTH - LEFT - gutter + 18.0 + BAR * *column as f64;
        let (y0, y1) = (TOP + ROW * (*first as f64 + 0.2), TOP + ROW * (*last as f64 + 0.8));
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

fn shortened(label: &str) -> String {
    if label.chars().count() <= LETTERS {
        return label.to_owned();
    }
    label.chars().take(LETTERS - 1).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_that_overlap_stand_beside_each_other() {
        assert_eq!(columns(&[[0, 2], [1, 4], [3, 5], [5, 6], [7, 8]]), [0, 1, 0, 1, 0]);
        assert_eq!(shortened("pso"), "pso");
        assert_eq!(shortened(&"é".repeat(40)).chars().count(), LETTERS);
    }
}
