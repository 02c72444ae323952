//! The exported document against its schema, by a validator that refuses words of schemas it does not know.

use serde_json::Value;

use super::*;
use crate::config::BudgetSpec;
use crate::testing::{campaign, climber, detour, entry, refusal, runs_of, short_of_goal};

/// What is wrong with `value`, if anything: JSON Schema 2020-12, as far as our schema uses it.
fn fault(schema: &Value, root: &Value, value: &Value, at: &str) -> Result<(), String> {
    for (word, rule) in schema.as_object().ok_or("a schema is an object")? {
        let wrong = |what: &str| Err(format!("{at}: {value} is not {what} {rule}"));
        match (&word[..], value) {
            ("$schema" | "$defs" | "title" | "description", _) => {}
            ("$ref", _) => {
                let name = rule.as_str().and_then(|r| r.strip_prefix("#/$defs/")).ok_or("a reference")?;
                fault(&root["$defs"][name], root, value, at)?;
            }
            ("type", _) => {
                let is = |kind: &Value| match kind.as_str().unwrap_or_default() {
                    "object" => value.is_object(),
                    "array" => value.is_array(),
                    "string" => value.is_string(),
                    "number" => value.is_number(),
                    "integer" => value.is_u64() || value.is_i64(),
                    "boolean" => value.is_boolean(),
                    "null" => value.is_null(),
                    other => panic!("type {other}"),
                };
                if !rule.as_array().map_or_else(|| is(rule), |kinds| kinds.iter().any(is)) {
                    return wrong("of type");
                }
            }
            ("enum", _) => {
                if !rule.as_array().ok_or("enum")?.contains(value) {
                    return wrong("one of");
                }
            }
            ("minimum", Value::Number(n)) if n.as_f64() < rule.as_f64() => return wrong("at least"),
            ("maximum", Value::Number(n)) if n.as_f64() > rule.as_f64() => return wrong("at most"),
            ("minItems", Value::Array(items)) if (items.len() as u64) < rule.as_u64().ok_or("minItems")? => {
                return wrong("as long as");
            }
            ("maxItems", Value::Array(items)) if items.len() as u64 > rule.as_u64().ok_or("maxItems")? => {
                return wrong("as short as");
            }
            ("items", Value::Array(items)) => {
                for (i, item) in items.iter().enumerate() {
                    fault(rule, root, item, &format!("{at}/{i}"))?;
                }
            }
            ("prefixItems", Value::Array(items)) => {
                for (i, (item, rule)) in items.iter().zip(rule.as_array().ok_or("prefixItems")?).enumerate() {
                    fault(rule, root, item, &format!("{at}/{i}"))?;
                }
            }
            ("properties", Value::Object(object)) => {
                for (key, rule) in rule.as_object().ok_or("properties")? {
                    if let Some(item) = object.get(key) {
                        fault(rule, root, item, &format!("{at}/{key}"))?;
                    }
                }
            }
            ("required", Value::Object(object)) => {
                if let Some(key) =
                    rule.as_array().ok_or("required")?.iter().find(|k| !object.contains_key(k.as_str().unwrap()))
                {
                    return Err(format!("{at}: no {key}"));
                }
            }
            ("additionalProperties", Value::Object(object)) => {
                assert_eq!(rule, false);
                let known = schema["properties"].as_object().ok_or("properties")?;
                if let Some(key) = object.keys().find(|k| !known.contains_key(*k)) {
                    return Err(format!("{at}: unknown key {key}"));
                }
            }
            ("minimum" | "maximum" | "minItems" | "maxItems" | "items" | "prefixItems" | "properties", _)
            | ("required" | "additionalProperties", _) => {}
            (other, _) => panic!("the validator does not know {other:?}"),
        }
    }
    Ok(())
}

fn document() -> (Results, Value) {
    let budget = BudgetSpec { iterations: Some(7), ..BudgetSpec::default() };
    let planners =
        vec![climber(budget), entry("detour", detour), entry("refusal", refusal), entry("short", short_of_goal)];
    let campaign = campaign(planners);
    let mut results = campaign.empty_results(1);
    results.runs = runs_of(&campaign);
    let document = serde_json::from_str(&results_json(&results)).unwrap();
    (results, document)
}

#[test]
fn the_document_follows_its_schema() {
    let schema: Value = serde_json::from_str(SCHEMA).unwrap();
    let (results, document) = document();
    assert_eq!(fault(&schema, &schema, &document, ""), Ok(()));
    assert_eq!(document["runs"].as_array().unwrap().len(), results.runs.len());

    let mut broken = document.clone();
    broken["runs"][3]["status"] = "fine".into();
    assert!(fault(&schema, &schema, &broken, "").unwrap_err().starts_with("/runs/3/status: \"fine\" is not one of"));
    let mut broken = document.clone();
    broken["scenes"][0]["optimum"]["path"][0] = json!([1.0]);
    assert!(fault(&schema, &schema, &broken, "").is_err());
    let mut broken = document;
    broken["manifest"].as_object_mut().unwrap().remove("jobs");
    assert_eq!(fault(&schema, &schema, &broken, "").unwrap_err(), "/manifest: no \"jobs\"");
}

#[test]
fn numbers_and_settings_come_back_as_they_were() {
    let (results, document) = document();
    for (run, read) in results.runs.iter().zip(document["runs"].as_array().unwrap()) {
        assert_eq!(read["length"].as_f64(), run.length);
        assert_eq!(read["time_us"].as_f64(), Some(run.time_us));
        let path: Vec<[f64; 2]> = serde_json::from_value(read["path"].clone()).unwrap();
        assert_eq!(path, run.path.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>());
        assert_eq!(read["progress"].as_array().unwrap().len(), run.progress.len());
    }
    let scene: env_model::Scene = serde_json::from_value(document["scenes"][0]["scene"].clone()).unwrap();
    assert_eq!(scene, results.scenes[0].scene);
    assert_eq!(document["planners"][0]["budget"], json!({ "iterations": 7 }));
    assert_eq!(document["planners"][0]["settings"], json!({ "gain": 0.5 }), "the budget is not a setting");
}
