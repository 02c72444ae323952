//! Collisions of one simulation as a table.

use minijinja::Value;
use strategy::Trace;

use super::super::data_table::{self, number, row, words};
use super::super::language::Strings;
use super::animation::bodies;
use crate::format;

/// The table; `None` where nothing touched.
pub fn table(trace: &Trace, id: &str, t: &Strings) -> Option<Value> {
    let rows: Vec<Value> = trace
        .events
        .iter()
        .map(|e| {
            row(vec![
                number(format!("{}\u{a0}s", format::significant(e.time_s, 4)), e.time_s),
                words(
                    t.fill("moving_who", &[("a", &name(trace, e.bodies[0], t)), ("b", &name(trace, e.bodies[1], t))]),
                ),
                number(format!("{}\u{a0}m/s", format::significant(e.closing, 3)), e.closing),
                words(t.get(if e.foul { "yes" } else { "no" })),
            ])
        })
        .collect();
    let heads = ["moving_time", "moving_bodies", "moving_closing", "moving_foul"].map(|key| t.get(key));
    (!rows.is_empty()).then(|| data_table::table(id, t.get("moving_events"), &heads, rows))
}

/// What a body is called: own robots by the number in the picture.
pub fn name(trace: &Trace, body: usize, t: &Strings) -> String {
    let number = |side: &str| bodies(trace, side).iter().position(|b| *b == body).map(|k| (k + 1).to_string());
    match (number("own"), number("opponent")) {
        (Some(n), _) => n,
        (_, Some(n)) => t.fill("moving_opponent", &[("n", &n)]),
        _ => t.get("moving_ball").to_owned(),
    }
}
