//! The parameters that were judged, and the weights of the fitness that judged them.

use minijinja::{Value, context};

use super::super::data_table::{number, row, table, words};
use super::super::language::Strings;
use super::{is_tuned, middle, tunings};
use crate::format;
use crate::results::Results;

/// Parameters down, planners across: a given value, or of tuned ones the median with quartiles, least and greatest.
pub fn parameters(results: &Results, t: &Strings) -> Option<Value> {
    let all: Vec<_> = (0..results.planners.len()).map(|p| tunings(results, p)).collect();
    let judged: Vec<usize> = (0..all.len()).filter(|p| !all[*p].is_empty()).collect();
    let names: Vec<&str> = {
        let longest = all.iter().flatten().max_by_key(|run| run.parameters.len())?;
        longest.parameters.iter().map(|(name, _)| name.as_str()).collect()
    };
    let line = |name: &&str| {
        let cell = |p: &usize| {
            let values: Vec<f64> = all[*p]
                .iter()
                .filter_map(|run| run.parameters.iter().find(|(n, _)| n == name).map(|(_, v)| *v))
                .collect();
            spread(&values)
        };
        row([words(*name)].into_iter().chain(judged.iter().map(cell)).collect())
    };
    let rows: Vec<Value> = names.iter().map(line).collect();
    let heads: Vec<String> = judged
        .iter()
        .map(|p| {
            let key = if is_tuned(&all[*p]) { "parameters_tuned" } else { "parameters_given" };
            t.fill(key, &[("planner", &results.planners[*p].label)])
        })
        .collect();
    let heads: Vec<&str> = [t.get("parameters_name")].into_iter().chain(heads.iter().map(String::as_str)).collect();
    (!rows.is_empty()).then(|| table("parameters-table", t.get("parameters_title"), &heads, rows))
}

/// `0.84` or `0.84` over `[0.71, 0.93], 0.4 to 1.2`.
fn spread(values: &[f64]) -> Value {
    let shown = |v: f64| format::significant(v, 3);
    let Some([median, low, high]) = middle(values) else { return number(format::NONE, f64::INFINITY) };
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let small = if least == most {
        String::new()
    } else {
        format!("[{}, {}] {}\u{a0}… {}", shown(low), shown(high), shown(least), shown(most))
    };
    context! { shown => shown(median), key => format::sort_key(median), kind => "num", small }
}

/// The weights of the fitness, as the protocol has them; `None` where it says nothing of them.
pub fn weights(results: &Results, t: &Strings) -> Option<Value> {
    let protocol: toml::Table = results.protocol.parse().ok()?;
    let weights = find(&protocol, "weights")?;
    let line = |(name, value): (&String, &toml::Value)| {
        let value = value.as_float().or_else(|| value.as_integer().map(|v| v as f64))?;
        let key = format!("weight_{name}");
        let meaning = if t.has(&key) { t.get(&key).to_owned() } else { String::new() };
        Some(row(vec![words(name.as_str()), number(format::significant(value, 4), value), words(meaning)]))
    };
    let rows: Vec<Value> = weights.iter().filter_map(line).collect();
    let heads = ["weights_part", "weights_weight", "weights_meaning"].map(|key| t.get(key));
    (!rows.is_empty()).then(|| table("weights-table", t.get("weights_title"), &heads, rows))
}

/// The table of that name, at any depth.
fn find<'a>(table: &'a toml::Table, name: &str) -> Option<&'a toml::Table> {
    table
        .get(name)
        .and_then(toml::Value::as_table)
        .or_else(|| table.values().filter_map(toml::Value::as_table).find_map(|inner| find(inner, name)))
}
