//! What each planner minimised itself, beside the length that all are judged by.

use minijinja::Value;

use super::data_table::{number, planner_row, table, words};
use super::evidence::Evidence;
use super::language::Strings;
use crate::analysis::{counted_cost, counted_length};
use crate::format;
use crate::results::RunRecord;

/// The table; `None` where no planner tells its cost.
pub fn figure(evidence: &Evidence<'_>, t: &Strings) -> Option<Value> {
    let scenes = evidence.scenes();
    let told = |p: &usize| evidence.grid.runs_in(*p, None).any(|r| r.cost.is_some());
    let typical = |p: usize, value: &dyn Fn(&RunRecord) -> f64| {
        evidence.typical(p, &scenes, &|r, _| value(r)).map_or(f64::INFINITY, |m| m.median)
    };
    let planners: Vec<usize> = (0..evidence.results.planners.len()).filter(told).collect();
    if planners.is_empty() {
        return None;
    }
    let rows = planners.into_iter().map(|p| {
        let mut names: Vec<&str> = Vec::new();
        for (name, _) in evidence.grid.runs_in(p, None).flat_map(|r| &r.terms) {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        let terms = names.iter().map(|name| {
            let term = |r: &RunRecord| r.term(name).filter(|_| r.valid).unwrap_or(f64::INFINITY);
            let value = typical(p, &term);
            format!("{name} {}", format::significant(value, 5))
        });
        let terms = terms.collect::<Vec<_>>().join(" · ");
        let length = typical(p, &counted_length);
        let number = |v: f64| number(format::length(v), v);
        let terms = words(if terms.is_empty() { format::NONE.to_owned() } else { terms });
        planner_row(evidence.label(p), p, vec![number(length), number(typical(p, &counted_cost)), terms])
    });
    let heads = [t.get("head_planner"), t.get("head_length"), t.get("own_cost"), t.get("own_terms")];
    Some(table("own-table", t.get("own_objective_title"), &heads, rows.collect()))
}
