//! What lies behind the paths: ground, field, obstacles with the robot's inflation, start and goal.

use std::fmt::Write as _;

use env_model::{Obstacle, Point, Scene, Shape};

use super::axis::Axis;
use super::camera::{Camera, LEFT, TOP, WIDTH};
use super::language::Strings;
use super::svg::{clipped, escape};
use crate::format;

/// Ground, border, obstacles and, if wanted, numbers along the border. `id` is unique in the page.
pub fn backdrop(scene: &Scene, camera: &Camera, t: &Strings, id: &str, words: bool) -> String {
    let numbers = if words { numbers(scene, camera, t) } else { String::new() };
    ground(scene, camera, id) + &obstacles(scene, camera, id) + &numbers
}

/// Ground and border of the field.
pub(super) fn ground(scene: &Scene, camera: &Camera, id: &str) -> String {
    let (w, h) = (WIDTH, camera.height());
    let out = format!(r#"<rect class="ground" x="{LEFT}" y="{TOP}" width="{w}" height="{h:.1}"/>"#);
    let mut inside = String::new();
    if let Some(field) = scene.field {
        let rectangle = |class: &str, inset: f64| {
            let (x0, y1) = camera.map(Point::new(field.min[0] + inset, field.max[1] - inset));
            let (x1, y0) = camera.map(Point::new(field.max[0] - inset, field.min[1] + inset));
            let (w, h) = ((x1 - x0).max(0.0), (y0 - y1).max(0.0));
            format!(r#"<rect class="{class}" x="{x0:.1}" y="{y1:.1}" width="{w:.1}" height="{h:.1}"/>"#)
        };
        inside += &rectangle("field", 0.0);
        if scene.robot_radius > 0.0 {
            inside += &rectangle("reach", scene.robot_radius);
        }
    }
    out + &clipped(&format!("{id}-b"), camera, &inside)
}

/// Obstacles with the robot's inflation, as a group of the id `{id}-obstacles`.
pub(super) fn obstacles(scene: &Scene, camera: &Camera, id: &str) -> String {
    let shapes: String = scene.obstacles.iter().enumerate().map(|(i, o)| outline(scene, camera, i, o)).collect();
    let inside = if scene.robot_radius > 0.0 && !scene.obstacles.is_empty() {
        // A stroke of twice the radius, round joins: the exact inflation of any
        // shape. Drawn wider first, then over it the inside: a ring round the union.
        let wide = (2.0 * scene.robot_radius * camera.scale).min(1e9);
        format!(
            r##"<defs><g id="{id}-s">{shapes}</g></defs><use href="#{id}-s" class="ring" style="stroke-width:{:.2}px"/><use href="#{id}-s" class="halo" style="stroke-width:{wide:.2}px"/><use href="#{id}-s" class="obstacle"/>"##,
            wide + 2.4
        )
    } else {
        format!(r#"<g class="obstacle">{shapes}</g>"#)
    };
    format!(r#"<g id="{id}-obstacles">{}</g>"#, clipped(&format!("{id}-o"), camera, &inside))
}

/// Numbers along the border, in scene units.
pub(super) fn numbers(scene: &Scene, camera: &Camera, t: &Strings) -> String {
    let (min, max) = (camera.region.min, camera.region.max);
    let bottom = TOP + camera.height();
    let mut out = String::from(r#"<g class="ticks">"#);
    let across = Axis::linear(min.x, max.x, LEFT, LEFT + WIDTH);
    for v in across.ticks(5) {
        let x = across.at(v);
        let anchor = if x > LEFT + WIDTH - 14.0 { "end" } else { "middle" };
        let _ = write!(
            out,
            r#"<path d="M{x:.1} {bottom:.1}v5"/><text class="{anchor}" x="{x:.1}" y="{:.1}">{}</text>"#,
            bottom + 20.0,
            format::significant(v, 5)
        );
    }
    let up = Axis::linear(min.y, max.y, bottom, TOP);
    let wanted = (5.0 * camera.height() / WIDTH).round().max(2.0);
    for v in up.ticks(wanted as usize) {
        let y = up.at(v);
        let _ = write!(
            out,
            r#"<path d="M{LEFT} {y:.1}h-5"/><text class="end" x="{:.1}" y="{:.1}">{}</text>"#,
            LEFT - 8.0,
            y + 4.5,
            format::significant(v, 5)
        );
    }
    let _ = write!(
        out,
        r#"<text class="end unit" x="{:.1}" y="{:.1}">{}</text></g>"#,
        LEFT + WIDTH - 7.0,
        bottom - 8.0,
        escape(&t.fill("axis_unit", &[("unit", &scene.unit)]))
    );
    out
}

/// Start and goal: marks, and words beside them.
pub(super) fn ends(scene: &Scene, camera: &Camera, t: &Strings, words: bool) -> String {
    let ((sx, sy), (gx, gy)) = (camera.map(scene.start()), camera.map(scene.goal()));
    let mut out = format!(
        r#"<circle class="start" cx="{sx:.1}" cy="{sy:.1}" r="6"/><circle class="goal" cx="{gx:.1}" cy="{gy:.1}" r="7"/><circle class="goal dot" cx="{gx:.1}" cy="{gy:.1}" r="2.5"/>"#
    );
    if !words {
        return out;
    }
    let bottom = TOP + camera.height();
    for ((x, y), other_y, key) in [((sx, sy), gy, "start"), ((gx, gy), sy, "goal")] {
        // On the side that the path does not leave by, as far as two points can tell.
        let below = (y > other_y && y + 32.0 < bottom) || y < TOP + 30.0;
        let (class, x) = match x {
            x if x < LEFT + 40.0 => ("start-at", LEFT + 8.0),
            x if x > LEFT + WIDTH - 40.0 => ("end", LEFT + WIDTH - 8.0),
            x => ("middle", x),
        };
        let y = if below { y + 25.0 } else { y - 14.0 };
        let _ = write!(out, r#"<text class="name {class}" x="{x:.1}" y="{y:.1}">{}</text>"#, escape(t.get(key)));
    }
    out
}

fn outline(scene: &Scene, camera: &Camera, index: usize, obstacle: &Obstacle) -> String {
    // A radius of 0 would not be drawn at all, not even its inflation.
    let visible = |radius: f64| (radius * camera.scale).clamp(0.05, 1e9);
    let title = match &obstacle.label {
        Some(_) => format!("<title>{}</title>", escape(&scene.describe(index))),
        None => String::new(),
    };
    match &obstacle.shape {
        Shape::Disc { centre, radius } => {
            let (x, y) = camera.map((*centre).into());
            format!(r#"<circle cx="{x:.1}" cy="{y:.1}" r="{:.2}">{title}</circle>"#, visible(*radius))
        }
        Shape::Capsule { from, to, radius } => {
            let ((ax, ay), (bx, by), r) = (camera.map((*from).into()), camera.map((*to).into()), visible(*radius));
            let length = (bx - ax).hypot(by - ay);
            let (nx, ny) = if length > 0.0 { (-(by - ay) / length * r, (bx - ax) / length * r) } else { (0.0, r) };
            format!(
                r#"<path d="M{:.2} {:.2}L{:.2} {:.2}A{r:.2} {r:.2} 0 0 0 {:.2} {:.2}L{:.2} {:.2}A{r:.2} {r:.2} 0 0 0 {:.2} {:.2}z">{title}</path>"#,
                ax + nx,
                ay + ny,
                bx + nx,
                by + ny,
                bx - nx,
                by - ny,
                ax - nx,
                ay - ny,
                ax + nx,
                ay + ny,
            )
        }
        Shape::Polygon(corners) => {
            let points: Vec<String> = corners
                .iter()
                .map(|c| {
                    let (x, y) = camera.map((*c).into());
                    format!("{x:.1} {y:.1}")
                })
                .collect();
            format!(r#"<path d="M{}z">{title}</path>"#, points.join("L"))
        }
    }
}
