//! One simulation as a picture that tells its story as it stands, and that a script can set in motion.
//!
//! As written it is the end: robots where they came to rest, behind each its way, which fades towards the start and has
//! a tick each second, and a cross wherever two touched. The script moves the discs along [`Tracks`].

use std::fmt::Write as _;

use env_model::Point;
use minijinja::{Value, context};
use strategy::{Event, RobotRecord, Trace};

use super::super::camera::{LEFT, TOP, WIDTH, polyline};
use super::super::language::Strings;
use super::super::palette;
use super::super::svg::{clipped, cross_mark, escape};
use super::events;
use super::labels::Labels;
use super::stage::Stage;
use super::tracks::Tracks;
use crate::format;

/// Pieces of a way, each more opaque than the one before.
const PIECES: usize = 6;
/// Half the length of a tick, in picture units.
const TICK: f64 = 3.6;
/// Slower than this, in m/s, a robot stands and seconds leave no tick.
const STANDS: f64 = 0.05;
/// Half the width of a collision's cross.
const CROSS: f64 = 7.0;

/// What is drawn.
pub struct Clip<'a> {
    /// Unique in the page.
    pub id: &'a str,
    /// Above the picture.
    pub heading: &'a str,
    /// What assistive software reads first.
    pub title: &'a str,
    /// The paragraph below.
    pub text: &'a str,
    /// Where everybody was.
    pub trace: &'a Trace,
    /// The own robots.
    pub robots: &'a [RobotRecord],
}

/// The figure; `None` of a trace without frames.
pub fn figure(clip: &Clip<'_>, stage: &Stage, t: &Strings) -> Option<Value> {
    let last = clip.trace.frames.last()?;
    let own: Vec<usize> = bodies(clip.trace, "own");
    let mut ways = String::new();
    for (body, _) in clip.trace.bodies.iter().enumerate() {
        let number = own.iter().position(|b| *b == body);
        ways += &way(clip.trace, stage, body, number);
    }
    let mut goals = String::new();
    for (k, robot) in clip.robots.iter().enumerate() {
        let (x, y) = stage.at(robot.goal);
        let _ = write!(
            goals,
            r#"<path class="line target {}" d="M{:.1} {y:.1}h12m-6-6v12"/>"#,
            palette::colour(k),
            x - 6.0
        );
    }
    let bottom = TOP + stage.camera.height();
    let mut labels = Labels::new([LEFT, TOP, LEFT + WIDTH, bottom]);
    let radius = |body: usize| clip.trace.bodies.get(body).map_or(0.0, |b| stage.length(b.radius));
    last.iter().enumerate().for_each(|(body, p)| labels.avoid(stage.at(*p), radius(body)));
    clip.trace.events.iter().for_each(|e| labels.avoid(stage.at(e.at), CROSS));
    let discs: String = last
        .iter()
        .enumerate()
        .filter(|(_, p)| p.iter().all(|v| v.is_finite()))
        .map(|(body, p)| {
            let number = own.iter().position(|b| *b == body);
            disc(clip.trace, body, number, stage.at(*p), radius(body), &mut labels)
        })
        .collect();
    let hits: String = clip.trace.events.iter().map(|e| hit(e, stage, &mut labels)).collect();
    let (id, view) = (clip.id, stage.view());
    let (title, desc, backdrop) = (escape(clip.title), escape(clip.text), stage.backdrop(&format!("{id}-b")));
    let inner = clipped(id, &stage.camera, &[goals, ways, discs, hits].concat());
    let svg = format!(
        r#"<svg class="fig moving" viewBox="{view}" role="img" aria-labelledby="{id}-t {id}-d"><title id="{id}-t">{title}</title><desc id="{id}-d">{desc}</desc>{backdrop}{inner}</svg>"#
    );
    Some(context! {
        id, heading => clip.heading, text => clip.text, svg => Value::from_safe_string(svg),
        data => Value::from_safe_string(data(clip.trace, stage)),
        events => events::table(clip.trace, &format!("{id}-events"), t),
    })
}

/// Indices of the bodies of that side.
pub fn bodies(trace: &Trace, side: &str) -> Vec<usize> {
    trace.bodies.iter().enumerate().filter(|(_, b)| b.side == side).map(|(i, _)| i).collect()
}

/// What the script needs: the tracks, and how millimetres become picture units. Numbers alone, so nothing to escape.
fn data(trace: &Trace, stage: &Stage) -> String {
    let (x, y) = stage.at([0.0, 0.0]);
    let tracks = serde_json::to_value(Tracks::new(trace)).unwrap_or_default();
    serde_json::json!({ "origin": [x, y], "scale": stage.length(1e-3), "tracks": tracks }).to_string()
}

/// The way of one body: of an own robot (`number`) in its colour, of others thin and grey.
fn way(trace: &Trace, stage: &Stage, body: usize, number: Option<usize>) -> String {
    let places: Vec<Point> = trace.frames.iter().filter_map(|f| f.get(body)).map(|p| Point::new(p[0], p[1])).collect();
    if !places.iter().any(|p| p.x.is_finite() && p.y.is_finite()) {
        return String::new();
    }
    let Some(k) = number else {
        return format!(r#"<path class="trail other" d="{}"/>"#, polyline(&stage.camera, &places));
    };
    let colour = palette::colour(k);
    let mut out = String::new();
    let last = places.len().saturating_sub(1);
    for piece in 0..PIECES {
        let (from, to) = (last * piece / PIECES, last * (piece + 1) / PIECES);
        let opacity = 0.25 + 0.75 * (piece as f64 / (PIECES - 1) as f64);
        let d = polyline(&stage.camera, &places[from..=to.min(last)]);
        let _ = write!(out, r#"<path class="line trail {colour}" stroke-opacity="{opacity:.2}" d="{d}"/>"#);
    }
    let ticks = ticks(trace, stage, &places);
    if !ticks.is_empty() {
        let _ = write!(out, r#"<path class="line trail second {colour}" d="{ticks}"/>"#);
    }
    out
}

/// A stroke across the way after each second of motion.
fn ticks(trace: &Trace, stage: &Stage, places: &[Point]) -> String {
    let mut out = String::new();
    let frames_a_second = 1.0 / trace.period_s;
    for second in 1..100_000 {
        let frame = (f64::from(second) * frames_a_second).round() as usize;
        let Some(after) = places.get(frame + 1) else { break };
        let step = after - places[frame - 1];
        if step.norm() < STANDS * 2.0 * trace.period_s {
            continue;
        }
        let (x, y) = stage.camera.map(places[frame]);
        // Across, and y is down in pictures.
        let across = step.normalize() * TICK;
        let (dx, dy) = (across.y, across.x);
        let _ = write!(out, "M{:.1} {:.1}l{:.1} {:.1}", x - dx, y - dy, 2.0 * dx, 2.0 * dy);
    }
    out
}

/// A robot or the ball where it is in the end; own robots with their number.
fn disc(trace: &Trace, body: usize, number: Option<usize>, at: (f64, f64), r: f64, labels: &mut Labels) -> String {
    let (x, y) = at;
    let class = match (number, trace.bodies[body].side.as_str()) {
        (Some(k), _) => format!("own fill {}", palette::colour(k)),
        (None, "ball") => "ball".to_owned(),
        (None, _) => "opponent".to_owned(),
    };
    let mut out = format!(
        r#"<g class="body" data-body="{body}" transform="translate({x:.1} {y:.1})"><circle class="{class}" r="{:.1}"/>"#,
        r.max(2.0)
    );
    if let Some(k) = number {
        let words = (k + 1).to_string();
        let (lx, ly) = labels.place(at, r, words.len()).unwrap_or((x + r, y - r));
        let _ = write!(out, r#"<text class="name" x="{:.1}" y="{:.1}">{words}</text>"#, lx - x, ly - y);
    }
    out + "</g>"
}

/// A collision: a cross, ringed where it is a crash foul, with its time where there is room.
fn hit(event: &Event, stage: &Stage, labels: &mut Labels) -> String {
    let at = stage.at(event.at);
    let mut out = format!(
        r#"<g class="hit" data-ms="{:.0}">{}"#,
        1e3 * event.time_s,
        cross_mark(&stage.camera, Point::new(event.at[0], event.at[1]))
    );
    if event.foul {
        let _ = write!(out, r#"<circle class="foul" cx="{:.1}" cy="{:.1}" r="10"/>"#, at.0, at.1);
    }
    let words = seconds(event.time_s);
    if let Some((x, y)) = labels.place(at, CROSS + if event.foul { 4.0 } else { 0.0 }, words.chars().count()) {
        let _ = write!(out, r#"<text class="name warn" x="{x:.1}" y="{y:.1}">{}</text>"#, escape(&words));
    }
    out + "</g>"
}

/// A time in seconds to a tenth.
pub fn seconds(s: f64) -> String {
    format!("{}\u{a0}s", format::significant((s * 10.0).round() / 10.0, 6))
}
