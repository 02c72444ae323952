//! What the marks in pictures of moving scenes mean.

use minijinja::{Value, context};
use strategy::Trace;

use super::super::language::Strings;
use super::animation::bodies;

/// The keys of what occurs in `traces`.
pub fn keys(traces: &[&Trace], t: &Strings) -> Vec<Value> {
    let any = |side: &str| traces.iter().any(|trace| !bodies(trace, side).is_empty());
    let hit = traces.iter().any(|trace| !trace.events.is_empty());
    let foul = traces.iter().any(|trace| trace.events.iter().any(|e| e.foul));
    let keys = [
        (any("own"), r#"<circle class="own fill c0" cx="18" cy="7" r="6"/>"#, "moving_key_own"),
        (any("opponent"), r#"<circle class="opponent" cx="18" cy="7" r="6"/>"#, "moving_key_opponent"),
        (any("ball"), r#"<circle class="ball" cx="18" cy="7" r="4"/>"#, "moving_key_ball"),
        (any("own"), r#"<path class="line target c0" d="M12 7h12m-6-6v12"/>"#, "moving_key_goal"),
        (
            any("own"),
            r#"<path class="line trail c0" d="M1 7H35"/><path class="line trail second c0" d="M10 3v8m8-8v8m8-8v8"/>"#,
            "moving_key_way",
        ),
        (hit, r#"<path class="cross" d="M12 1l12 12m0-12l-12 12"/>"#, "moving_key_hit"),
        (
            foul,
            r#"<path class="cross" d="M13 2l10 10m0-10l-10 10"/><circle class="foul" cx="18" cy="7" r="8"/>"#,
            "moving_key_foul",
        ),
    ];
    let mark = |svg: &str| {
        Value::from_safe_string(format!(
            r#"<svg class="swatch moving" viewBox="0 0 36 14" aria-hidden="true">{svg}</svg>"#
        ))
    };
    let there = keys.into_iter().filter(|(there, _, _)| *there);
    there.map(|(_, svg, key)| context! { mark => mark(svg), words => t.get(key) }).collect()
}
