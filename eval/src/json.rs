//! Values as JSON.

use env_model::Point;
use serde_json::{Map, Value, json};

use crate::results::RunRecord;

/// A TOML value; what JSON lacks (dates, NaN, infinity) as text.
pub fn from_toml(value: &toml::Value) -> Value {
    match value {
        toml::Value::String(text) => text.as_str().into(),
        toml::Value::Integer(n) => (*n).into(),
        toml::Value::Float(x) if x.is_finite() => (*x).into(),
        toml::Value::Boolean(b) => (*b).into(),
        toml::Value::Array(values) => values.iter().map(from_toml).collect(),
        toml::Value::Table(table) => table.iter().map(|(key, value)| (key.clone(), from_toml(value))).collect(),
        other => other.to_string().into(),
    }
}

/// A polyline.
pub fn points(path: &[Point]) -> Vec<[f64; 2]> {
    path.iter().map(|p| [p.x, p.y]).collect()
}

/// What every document tells of a run.
pub fn run(r: &RunRecord) -> Map<String, Value> {
    let value = json!({
        "scene": r.scene,
        "seed": r.seed,
        "status": r.status,
        "valid": r.valid,
        "length": r.length,
        "gap": r.gap,
        "clearance_min": r.clearance_min,
        "turning": r.turning,
        "iterations": r.iterations,
        "evaluations": r.evaluations,
        "collision_checks": r.collision_checks,
        "time_us": r.time_us,
        "cpu_us": r.cpu_us,
        "error": r.error,
        "cost": r.cost,
        "path": points(&r.path),
        "progress": r.progress,
    });
    let Value::Object(map) = value else { unreachable!("written as an object") };
    map
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_kept_and_what_json_lacks_becomes_text() {
        let table = "a = 1\nb = 1.0\nc = [inf, nan, 0.1]\nd = 2012-05-01\ne = { f = \"x\", g = true }".parse().unwrap();
        let expected = r#"{"a":1,"b":1.0,"c":["inf","nan",0.1],"d":"2012-05-01","e":{"f":"x","g":true}}"#;
        assert_eq!(from_toml(&toml::Value::Table(table)).to_string(), expected);
    }
}
