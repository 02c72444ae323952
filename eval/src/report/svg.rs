//! Pictures of a scene and paths in it.

use std::fmt::Write as _;

use env_model::{Point, Scene};

use super::backdrop::{backdrop, ends};
use super::camera::{BOTTOM, Camera, LEFT, RIGHT, TOP, WIDTH, polyline};
use super::language::{Language, Strings};
use super::palette;

/// Rules that pages and stand-alone pictures share.
pub(super) const FIGURE_CSS: &str = include_str!("figure.css");

/// A path to draw.
#[derive(Debug, Clone, Copy)]
pub struct PathLayer<'a> {
    /// What to call it.
    pub label: &'a str,
    /// Its points in scene units; points that are not finite are left out.
    pub points: &'a [Point],
    /// Whether the judge accepts it; if not it is dashed, in the colour of warnings.
    pub valid: bool,
    /// Which colour: the planner's place in the comparison.
    pub series: usize,
}

/// `text` safe in markup and in attribute values; control characters, which XML forbids, left out.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c if c.is_control() && c != '\n' && c != '\t' => {}
            c => out.push(c),
        }
    }
    out
}

/// A stand-alone SVG of `scene`: obstacles grey with the robot's inflation as a
/// thin ring, the field's border, start and goal, the optimum as a neutral
/// line, and `paths` over it, with a legend. Light ground, no scripts, fonts or links.
pub fn scene_svg(scene: &Scene, optimum: Option<&[Point]>, paths: &[PathLayer<'_>]) -> String {
    let t = Strings::new(Language::English);
    let every = paths.iter().map(|p| p.points).chain(optimum);
    let camera = Camera::new(scene, every);
    let css = palette::on_light(&format!("{FIGURE_CSS}{}", palette::series_css()));
    let class = |path: &PathLayer<'_>| {
        if path.valid { format!("{} best", palette::line(path.series)) } else { "line invalid best".to_owned() }
    };
    let mut keys: Vec<(String, String)> = Vec::new();
    if optimum.is_some() {
        keys.push(("optimum".to_owned(), t.get("optimum").to_owned()));
    }
    for path in paths {
        let label = if path.valid { path.label.to_owned() } else { t.fill("invalid_label", &[("label", path.label)]) };
        keys.push((class(path), label));
    }
    let mut body = backdrop(scene, &camera, &t, "scene", true);
    let mut inner = String::new();
    if let Some(points) = optimum {
        inner += &optimum_line(&camera, points);
    }
    for path in paths {
        let _ = write!(
            inner,
            r#"<path class="{}" d="{}"><title>{}</title></path>"#,
            class(path),
            polyline(&camera, path.points),
            escape(path.label)
        );
    }
    body += &clipped("scene-paths", &camera, &inner);
    body += &ends(scene, &camera, &t, true);
    let bottom = TOP + camera.height() + BOTTOM;
    for (i, (class, label)) in keys.iter().enumerate() {
        let y = bottom + 16.0 + 22.0 * i as f64;
        let _ = write!(
            body,
            r#"<g transform="translate({LEFT} {y:.1})"><path class="{class}" d="M0 0H34"/><text x="44" y="4">{}</text></g>"#,
            escape(label)
        );
    }
    let height = bottom + 22.0 * keys.len() as f64 + 8.0;
    let (w, name) = (LEFT + WIDTH + RIGHT, escape(&scene.name));
    let desc =
        escape(&t.fill("alt_scene", &[("scene", &scene.name), ("obstacles", &scene.obstacles.len().to_string())]));
    format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" class="fig" viewBox="0 0 {w} {height:.0}" width="{w}" height="{height:.0}" role="img" aria-labelledby="scene-title scene-desc"><title id="scene-title">{name}</title><desc id="scene-desc">{desc}</desc><style>{}</style><rect width="100%" height="100%" fill="#ffffff"/>{body}</svg>"##,
        css.replace('\n', "")
    )
}

/// What one figure of a page shows.
pub(super) struct Picture<'a> {
    /// Unique in the page.
    pub id: &'a str,
    /// What assistive software reads first.
    pub title: &'a str,
    /// What it reads then.
    pub desc: &'a str,
    /// The obstacles, from [`backdrop`] or a reference to it.
    pub backdrop: &'a str,
    /// Lines, already markup.
    pub lines: &'a str,
    /// Whether to write numbers and words into it.
    pub words: bool,
    /// What is drawn last, and how much room it takes below the drawing area.
    pub foot: (&'a str, f64),
}

/// A figure inside a page, which holds the style rules.
pub(super) fn picture(scene: &Scene, camera: &Camera, t: &Strings, what: &Picture<'_>) -> String {
    let (w, h) = (LEFT + WIDTH + RIGHT, TOP + camera.height() + BOTTOM + what.foot.1);
    // Without numbers at the border the margins are empty: cut them off.
    let view = if what.words {
        format!("0 0 {w} {h:.0}")
    } else {
        format!("{} {} {} {:.0}", LEFT - 2.0, TOP - 2.0, WIDTH + 4.0, camera.height() + 4.0)
    };
    let id = what.id;
    format!(
        r#"<svg class="fig" viewBox="{view}" role="img" aria-labelledby="{id}-t {id}-d"><title id="{id}-t">{}</title><desc id="{id}-d">{}</desc>{}{}{}{}</svg>"#,
        escape(what.title),
        escape(what.desc),
        what.backdrop,
        clipped(id, camera, what.lines),
        ends(scene, camera, t, what.words),
        what.foot.0,
    )
}

/// `lines` cut off at the border of the drawing area; `id` is unique in the page.
pub(super) fn clipped(id: &str, camera: &Camera, lines: &str) -> String {
    let h = camera.height();
    format!(
        r##"<clipPath id="{id}-c"><rect x="{LEFT}" y="{TOP}" width="{WIDTH}" height="{h:.1}"/></clipPath><g clip-path="url(#{id}-c)">{lines}</g>"##
    )
}

/// The optimum's line.
pub(super) fn optimum_line(camera: &Camera, points: &[Point]) -> String {
    format!(r#"<path class="optimum" d="{}"/>"#, polyline(camera, points))
}

/// A cross where something went wrong.
pub(super) fn cross_mark(camera: &Camera, at: Point) -> String {
    let (x, y) = camera.map(at);
    format!(r#"<path class="cross" d="M{:.1} {:.1}l12 12m0-12l-12 12"/>"#, x - 6.0, y - 6.0)
}
