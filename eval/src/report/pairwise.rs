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
    let mut heads = vec!["A", "B", &a, &b, t.get("pairwise_ratio"), t.get("pairwise_p"), t.get("pairwise_a12")];
    if evidence.times_compare() {
        heads.extend([t.get("pairwise_time_ratio"), t.get("pairwise_time_p")]);
    }
    heads.push(blocks);
    Some(table("pairwise-table", t.get("pairwise_title"), &heads, rows))
}

fn line(evidence: &Evidence<'_>, quality: &Pair, time: &Pair, measure: Measure) -> Value {
    let ratio = |pair: &Pair| {
        // Two failures are equal, which is no ratio of what either needs.
        let ratio = pair.ratio.filter(|_| pair.medians.iter().all(|m| m.is_finite()));
        number(ratio.map_or(format::NONE.to_owned(), phrases::times), ratio.map_or(f64::INFINITY, |r| r.value))
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
    let mut cells = vec![
        words(evidence.label(quality.a)),
        words(evidence.label(quality.b)),
        median(x),
        median(y),
        ratio(quality),
        p(quality),
        a12,
    ];
    if evidence.times_compare() {
        cells.extend([ratio(time), p(time)]);
    }
    cells.push(number(quality.blocks.to_string(), quality.blocks as f64));
    row(cells)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Language;
    use crate::report::tests::results;

    #[test]
    fn two_that_mostly_fail_have_no_ratio_of_times() {
        let t = Strings::new(Language::English);
        let mut results = results(&["a", "b"], &["one"], 12);
        results.runs.iter_mut().enumerate().for_each(|(k, r)| (r.valid, r.time_us) = (true, 10.0 + k as f64));
        let shown = |evidence: &Evidence<'_>| {
            let row = figure(evidence, &t).unwrap().get_attr("rows").unwrap().get_item_by_index(0).unwrap();
            let cell = row.get_attr("cells").unwrap().get_item_by_index(7).unwrap();
            cell.get_attr("shown").unwrap().to_string()
        };
        let evidence = Evidence::new(&results);
        assert_eq!(shown(&evidence), phrases::times(evidence.times.pairs[0].ratio.unwrap()));
        results.runs.iter_mut().for_each(|r| r.valid = false);
        let evidence = Evidence::new(&results);
        assert_eq!(evidence.times.pairs[0].medians, [f64::INFINITY; 2]);
        assert!(evidence.times.pairs[0].ratio.is_some(), "equal, but of nothing");
        assert_eq!(shown(&evidence), format::NONE);
    }
}
