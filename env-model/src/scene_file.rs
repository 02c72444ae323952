//! The stable scene format: TOML to [`Scene`] with exact places in errors, and back.

use std::fmt::Write as _;
use std::ops::Range;

use serde::{Deserialize, Deserializer, Serialize};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::scene::{Obstacle, Place, Scene, SceneError, Shape};
use crate::source::{Key, Source, span_of};
use crate::{FileError, World};

/// An obstacle as the file spells it: exactly one of the three shapes.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ObstacleFields {
    #[serde(skip_serializing_if = "Option::is_none")]
    disc: Option<Disc>,
    #[serde(skip_serializing_if = "Option::is_none")]
    capsule: Option<Capsule>,
    #[serde(skip_serializing_if = "Option::is_none")]
    polygon: Option<Vec<Pair>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    velocity: Option<Pair>,
    #[serde(skip_serializing_if = "Option::is_none")]
    label: Option<String>,
}

/// Exactly two numbers; a plain `[f64; 2]` would read the first two of more.
#[derive(Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>")]
struct Pair([f64; 2]);

impl TryFrom<Vec<f64>> for Pair {
    type Error = String;

    fn try_from(numbers: Vec<f64>) -> Result<Self, String> {
        let count = numbers.len();
        numbers.try_into().map(Self).map_err(|_| format!("{count} numbers; expected two, [x, y]"))
    }
}

/// Reads [`Pair`] where a field's type is the bare array.
pub(crate) fn pair<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 2], D::Error> {
    Pair::deserialize(deserializer).map(|pair| pair.0)
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Disc {
    centre: Pair,
    radius: f64,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Capsule {
    from: Pair,
    to: Pair,
    radius: f64,
}

impl TryFrom<ObstacleFields> for Obstacle {
    type Error = String;

    fn try_from(fields: ObstacleFields) -> Result<Self, String> {
        let ObstacleFields { disc, capsule, polygon, velocity, label } = fields;
        let shape = match (disc, capsule, polygon) {
            (Some(Disc { centre, radius }), None, None) => Shape::Disc { centre: centre.0, radius },
            (None, Some(Capsule { from, to, radius }), None) => Shape::Capsule { from: from.0, to: to.0, radius },
            (None, None, Some(corners)) => Shape::Polygon(corners.into_iter().map(|c| c.0).collect()),
            _ => return Err(ONE_SHAPE.to_owned()),
        };
        Ok(Self { shape, velocity: velocity.map(|v| v.0), label })
    }
}

impl From<Obstacle> for ObstacleFields {
    fn from(obstacle: Obstacle) -> Self {
        let Obstacle { shape, velocity, label } = obstacle;
        let mut fields = Self { disc: None, capsule: None, polygon: None, velocity: velocity.map(Pair), label };
        match shape {
            Shape::Disc { centre, radius } => fields.disc = Some(Disc { centre: Pair(centre), radius }),
            Shape::Capsule { from, to, radius } => {
                fields.capsule = Some(Capsule { from: Pair(from), to: Pair(to), radius });
            }
            Shape::Polygon(corners) => fields.polygon = Some(corners.into_iter().map(Pair).collect()),
        }
        fields
    }
}

pub(crate) fn parse(path: &str, text: &str) -> Result<Scene, FileError> {
    let source = Source { path, text };
    let table = source.parse_toml()?;
    let scene = Scene::deserialize(toml::Deserializer::from(table.clone())).map_err(|e| {
        // The library places what `try_from` refuses at the first obstacle, whichever it is.
        let misplaced = e.message().contains(ONE_SHAPE);
        let span = shapeless(&table).filter(|_| misplaced);
        span.map_or_else(|| source.toml_error(&e), |span| source.error_at(span, ONE_SHAPE))
    })?;
    let place = |error: SceneError| {
        let place = error.place();
        let message = error.to_string();
        let span = match place {
            Place { obstacle: None, key } => span_of(&table, &[Key::Name(key)]),
            Place { obstacle: Some(i), key } => {
                let at =
                    |inner: &[Key<'_>]| span_of(&table, &[&[Key::Name("obstacle"), Key::Index(i)], inner].concat());
                let whole = at(&[]);
                [
                    at(&[Key::Name("disc"), Key::Name(key)]),
                    at(&[Key::Name("capsule"), Key::Name(key)]),
                    at(&[Key::Name(key)]),
                ]
                .into_iter()
                .min_by_key(|span| (*span == whole, span.len()))
                .unwrap_or(whole)
            }
        };
        source.error_at(span, message)
    };
    let world = World::new(&scene).map_err(place)?;
    scene.validate_ends(&world).map_err(place)?;
    Ok(scene)
}

const ONE_SHAPE: &str = "an obstacle must have exactly one shape; expected one of disc, capsule, polygon";

/// The first obstacle that has not exactly one shape.
fn shapeless(table: &Spanned<DeTable<'_>>) -> Option<Range<usize>> {
    let obstacles = table.get_ref().get("obstacle")?.get_ref().as_array()?;
    let shapes = |o: &DeValue<'_>| ["disc", "capsule", "polygon"].iter().filter(|k| o.get(**k).is_some()).count();
    obstacles.iter().find(|o| o.get_ref().is_table() && shapes(o.get_ref()) != 1).map(Spanned::span)
}

pub(crate) fn write(scene: &Scene) -> String {
    let text = |s: &str| toml::Value::String(s.to_owned()).to_string();
    // `{:?}` prints the shortest decimal that reads back as the same f64.
    let pair = |p: &[f64; 2]| format!("[{:?}, {:?}]", p[0], p[1]);
    let mut out = String::new();
    let mut line = |s: String| {
        let _ = writeln!(out, "{s}");
    };
    line(format!("name = {}", text(&scene.name)));
    line(format!("unit = {}", text(&scene.unit)));
    line(format!("robot_radius = {:?}", scene.robot_radius));
    line(format!("start = {}", pair(&scene.start)));
    line(format!("goal = {}", pair(&scene.goal)));
    if let Some(field) = &scene.field {
        line(format!("field = {{ min = {}, max = {} }}", pair(&field.min), pair(&field.max)));
    }
    for obstacle in &scene.obstacles {
        line("\n[[obstacle]]".to_owned());
        line(match &obstacle.shape {
            Shape::Disc { centre, radius } => format!("disc = {{ centre = {}, radius = {radius:?} }}", pair(centre)),
            Shape::Capsule { from, to, radius } => {
                format!("capsule = {{ from = {}, to = {}, radius = {radius:?} }}", pair(from), pair(to))
            }
            Shape::Polygon(corners) => {
                format!("polygon = [{}]", corners.iter().map(pair).collect::<Vec<_>>().join(", "))
            }
        });
        if let Some(velocity) = &obstacle.velocity {
            line(format!("velocity = {}", pair(velocity)));
        }
        if let Some(label) = &obstacle.label {
            line(format!("label = {}", text(label)));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"name = "demo"
start = [0.0, 0.0]
goal = [10.0, 0.0]
field = { min = [-1.0, -5.0], max = [11.0, 5.0] }

[[obstacle]]
disc = { centre = [5.0, 0.0], radius = 1.0 }
label = "opponent 3"
[[obstacle]]
capsule = { from = [2.0, 2.0], to = [3.0, 3.0], radius = 0.5 }
velocity = [0.0, 0.0]
[[obstacle]]
polygon = [[7.0, 2.0], [8.0, 2.0], [8.0, 3.0]]
"#;

    fn error(from: &str, to: &str) -> String {
        assert!(GOOD.contains(from), "{from}");
        parse("scene.toml", &GOOD.replacen(from, to, 1)).unwrap_err().to_string()
    }

    #[test]
    fn reads_and_writes_back_the_same() {
        let scene = parse("scene.toml", GOOD).unwrap();
        assert_eq!(scene.obstacles.len(), 3);
        assert_eq!(scene.unit, "m");
        assert_eq!(parse("again", &scene.to_toml()).unwrap(), scene);
    }

    #[test]
    fn mistakes_are_named_with_their_place() {
        let cases = [
            ("radius = 1.0", "radius = -1.0", "scene.toml:7:40: obstacle 0 (\"opponent 3\") radius is -1"),
            ("radius = 1.0", "radius = nan", "scene.toml:7:40: obstacle 0 (\"opponent 3\") radius is NaN"),
            ("radius = 1.0", "radius = inf", "scene.toml:7:40:"),
            ("radius = 0.5", "radius = 0.0", "scene.toml:10:58: obstacle 1 radius is 0 and so is robot_radius"),
            ("radius = 1.0", "radius = \"big\"", "scene.toml:7:40: invalid type: string \"big\", expected f64"),
            ("radius = 1.0", "radios = 1.0", "scene.toml:7:31: unknown field `radios`, expected `centre` or `radius`"),
            ("start = [0.0", "start = [10.0", "scene.toml:2:9: start and goal are the same point (10, 0)"),
            ("start = [0.0", "start = [5.25", "scene.toml:2:9: start (5.250, 0.000) is 0.7500 inside obstacle 0"),
            ("start = [0.0", "start = [-2.0", "scene.toml:2:9: start (-2.000, 0.000) leaves the field by 1.0000"),
            ("start = [0.0", "start = [nan", "scene.toml:2:9: start is NaN; expected a finite number"),
            ("max = [11.0", "max = [-11.0", "scene.toml:4:9: field min"),
            (
                "[8.0, 2.0], [8.0, 3.0]",
                "[8.0, 3.0], [8.0, 2.0], [7.0, 3.0]",
                "scene.toml:13:11: obstacle 2: sides 0 and 2",
            ),
            ("polygon =", "pentagon =", "scene.toml:13:1: unknown field `pentagon`"),
            ("name = \"demo\"", "name = demo", "scene.toml:1:8:"),
            ("label = ", "polygon = [[0.0, 0.0]]\nlabel = ", "scene.toml:6:1: an obstacle must have exactly one shape"),
            ("capsule = {", "label = \"none\" #", "scene.toml:9:1: an obstacle must have exactly one shape"),
            ("goal = [10.0, 0.0]", "goal = [10.0, 0.0, 1.0]", "scene.toml:3:8: 3 numbers; expected two, [x, y]"),
            ("[8.0, 3.0]", "[8.0]", "1 numbers; expected two, [x, y]"),
            ("name = \"demo\"", "name = \"a\\nb\"", "scene.toml:1:8: name \"a\\nb\"; expected 1 to 100 printable"),
        ];
        for (from, to, expected) in cases {
            let message = error(from, to);
            assert!(message.contains(expected), "{to}: {message}");
        }
    }
}
