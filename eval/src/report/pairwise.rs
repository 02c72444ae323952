//! Every planner against every other one, as a table.

use minijinja::Value;

use super::data_table::{number, row, table, words};
use super::evidence::Evidence;
use super::language::Strings;
use super::phrases;
use crate::analysis::pairs::Pair;
use crate::analysis::{Measure, Over};
use crate::format;

/// The table; `None` for fewer than two planners with common runs.
pub fn figure(evidence: &Evidence<'_>, t: &Strings) -> Option<Value> {
    let measure = evidence.quality.measure;
    let pairs = evidence.quality.pairs.iter().zip(&evidence.times.pairs).filter(|(q, _)| q.blocks > 0);
    let rows: Vec<Value> = pairs.map(|(q, time)| line(evidence, q, time, measure)).collect();
    if rows.is_empty() {
        return None;
    }
    let quality = t.get(if measure == Measure::Gap { "head_gap" } else { "head_length" });
    let (a, b) = (format!("{quality} A"), format!("{quality} B"));
    let blocks = t.get(match evidence.quality.over {
        Over::Repeats => "pairwise_repeats",
        Over::Scenes => "pairwise_scenes",
    });
    let heads = [
        "A",
        "B",
        &a,
        &b,
        t.get("pairwise_ratio"),
        t.get("pairwise_p"),
        t.get("pairwise_a12"),
        t.get("pairwise_time_ratio"),
        t.get("pairwise_time_p"),
        blocks,
    ];
    Some(table("pairwise-table", t.get("pairwise_title"), &heads, rows))
}

fn line(evidence: &Evidence<'_>, quality: &Pair, time: &Pair, measure: Measure) -> Value {
    let ratio = |pair: &Pair| {
        number(
            pair.ratio.map_or(format::NONE.to_owned(), phrases::times),
            pair.ratio.map_or(f64::INFINITY, |r| r.value),
        )
    };
    let p = |pair: &Pair| {
        let shown = |p: f64| if p < 0.001 { "< 0.001".to_owned() } else { format::significant(p, 2) };
        number(pair.p.map_or(format::NONE.to_owned(), shown), pair.p.unwrap_or(f64::INFINITY))
    };
    let median = |v: f64| number(phrases::value(measure, v), v);
    let a12 = number(
        quality.a12.map_or(format::NONE.to_owned(), |a| format::significant(a, 2)),
        quality.a12.unwrap_or(f64::INFINITY),
    );
    let [x, y] = quality.medians;
    row(vec![
        words(evidence.label(quality.a)),
        words(evidence.label(quality.b)),
        median(x),
        median(y),
        ratio(quality),
        p(quality),
        a12,
        ratio(time),
        p(time),
        number(quality.blocks.to_string(), quality.blocks as f64),
    ])
}
