//! What a planner did, drawn from the last frame of one replayed run: a swarm, cells and what
//! they hold, trees, a population, or a field of forces.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use env_model::{Point, Scene};
use minijinja::{Value, context};

use super::backdrop::{ground, numbers};
use super::camera::{BOTTOM, Camera, TOP, polyline};
use super::heat::{BAR, bar, for_each_run, layer, number, open_cells};
use super::language::Strings;
use super::palette;
use super::planner_card::Stage;
use super::streamlines::streamlines;
use super::svg::{Picture, clipped, cross_mark, picture};
use crate::format;
use crate::results::RunRecord;
use crate::snapshot::{CellMark, Heat, Line, Mesh, Snapshot, Spot, State, Tree};

/// Two stripes of the hatching, and the ends of their neighbours, in a square of 5.
const STRIPES: &str = "M-1 1L1 -1M0 5L5 0M4 6L6 4";
/// The same for a legend's key.
const STRIPED_KEY: &str = "M8 7L15 0M8 14L22 0M15 14L28 1M22 14L28 8";
/// Trees of more nodes are drawn with thin lines.
const DENSE: usize = 2_000;
/// Cells smaller than this, in picture units, have no grid lines.
const VISIBLE: f64 = 5.0;

/// The pictures of one planner in one scene: one for each stage that showed its state.
pub fn figures(stage: &Stage<'_>, label: &str, index: usize, runs: &[&RunRecord], id: &str, t: &Strings) -> Vec<Value> {
    let own = stage.snapshots.iter().filter(|s| s.planner == label).enumerate();
    own.map(|(k, snapshot)| figure(stage, snapshot, index, runs, &format!("{id}{k}"), t)).collect()
}

fn figure(stage: &Stage<'_>, snapshot: &Snapshot, index: usize, runs: &[&RunRecord], id: &str, t: &Strings) -> Value {
    let run = runs.iter().find(|r| r.repeat == snapshot.repeat).copied();
    let pen = Pen { camera: &stage.camera, snapshot, index, id, run, t };
    let drawing = pen.drawing();
    let (scene, camera) = (&stage.scene.scene, &stage.camera);
    let backdrop = ground(scene, camera, id)
        + &clipped(&format!("{id}-u"), camera, &(drawing.below + &edge(scene, camera)))
        + &(stage.obstacles)(id)
        + &numbers(scene, camera, t);
    let foot = match &drawing.heat {
        Some((heat, name)) => (bar(heat, name, TOP + camera.height() + BOTTOM), BAR),
        None => (String::new(), 0.0),
    };
    let last = clipped(&format!("{id}-top"), camera, &drawing.top) + &foot.0;
    let text = drawing.sentences.join(t.get("sentence_gap")) + t.get("sentence_gap") + &pen.source(runs);
    let title = t.fill("own_title", &[("planner", &snapshot.planner)]);
    let what = Picture {
        id,
        title: &title,
        desc: &text,
        backdrop: &backdrop,
        lines: &drawing.above,
        words: true,
        foot: (&last, foot.1),
    };
    let mut rows = drawing.rows;
    for (key, n) in [("own_iterations", snapshot.iteration), ("own_evaluations", snapshot.evaluations)] {
        rows.push((t.get(key).to_owned(), format::count(n as f64)));
    }
    let keys: Vec<Value> = drawing
        .keys
        .into_iter()
        .map(|(mark, words)| context! { mark => Value::from_safe_string(mark), words })
        .collect();
    let rows: Vec<Value> = rows.into_iter().map(|(name, value)| context! { name, value }).collect();
    context! { svg => Value::from_safe_string(picture(scene, camera, t, &what)), text, keys, rows, stage => snapshot.stage.as_str() }
}

/// The field's border once more, over what may hide it.
fn edge(scene: &Scene, camera: &Camera) -> String {
    let corner = |[x, y]: [f64; 2]| Point::new(x, y);
    let border = |field: env_model::scene::Field| {
        let ([x0, y0], [x1, y1]) = (field.min, field.max);
        let round = [[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]].map(corner);
        format!(r#"<path class="edge" d="{}"/>"#, polyline(camera, &round))
    };
    scene.field.map(border).unwrap_or_default()
}

/// A drawing under way.
#[derive(Default)]
struct Drawing<'a> {
    /// Under the obstacles.
    below: String,
    /// Over them.
    above: String,
    /// Over start and goal as well.
    top: String,
    sentences: Vec<String>,
    /// Markup of a swatch, and what it means.
    keys: Vec<(String, String)>,
    /// The data behind the picture.
    rows: Vec<(String, String)>,
    /// Numbers on cells and their name.
    heat: Option<(&'a Heat, String)>,
}

impl Drawing<'_> {
    fn key(&mut self, mark: &str, words: &str) {
        self.keys.push((
            format!(r#"<svg class="swatch fig" viewBox="0 0 36 14" aria-hidden="true">{mark}</svg>"#),
            words.to_owned(),
        ));
    }

    fn line_key(&mut self, class: &str, words: &str) {
        self.key(&format!(r#"<path class="{class}" d="M1 7H35"/>"#), words);
    }
}

struct Pen<'a> {
    camera: &'a Camera,
    snapshot: &'a Snapshot,
    index: usize,
    id: &'a str,
    run: Option<&'a RunRecord>,
    t: &'a Strings,
}

impl<'a> Pen<'a> {
    fn drawing(&self) -> Drawing<'a> {
        let mut d = Drawing::default();
        match &self.snapshot.state {
            State::Swarm { rectangle, particles, bests, best, total } => {
                self.swarm(&mut d, rectangle, [particles, bests], best, *total);
            }
            State::Cells { mesh, marks, counts, heat, borders, path } => {
                self.cells(&mut d, mesh, (marks.as_bytes(), *counts), heat.as_ref(), borders, path);
            }
            State::Trees(trees) => self.trees(&mut d, trees),
            State::Population { paths, mesh, best, total } => {
                self.population(&mut d, paths, mesh.as_ref(), best, *total);
            }
            State::Forces { mesh, directions, trail, stuck } => self.forces(&mut d, mesh, directions, trail, *stuck),
        }
        d
    }

    /// Which run, which frame.
    fn source(&self, runs: &[&RunRecord]) -> String {
        let (t, s) = (self.t, self.snapshot);
        let (repeat, seed) = (s.repeat.to_string(), s.seed.to_string());
        let [iterations, evaluations] = [s.iteration, s.evaluations].map(|n| format::count(n as f64));
        let values = [
            ("repeat", repeat.as_str()),
            ("seed", seed.as_str()),
            ("iterations", iterations.as_str()),
            ("evaluations", evaluations.as_str()),
            ("stage", s.stage.as_str()),
        ];
        let mut text = t.fill("own_source", &values) + t.get("sentence_gap");
        text += t.get(if runs.iter().any(|r| r.valid) { "own_typical" } else { "own_first" });
        if !s.faithful {
            text += t.get("sentence_gap");
            text += t.get("own_unlike");
        }
        text
    }

    fn colour(&self) -> String {
        palette::colour(self.index)
    }

    fn path_data(&self, line: &[Spot]) -> String {
        polyline(self.camera, &self.snapshot.ruler.points(line))
    }

    fn say(&self, d: &mut Drawing<'_>, key: &str, values: &[(&str, &str)]) {
        d.sentences.push(self.t.fill(key, values));
    }

    fn row(&self, d: &mut Drawing<'_>, key: &str, value: String) {
        d.rows.push((self.t.get(key).to_owned(), value));
    }

    /// A heavy line with an edge, so that it is seen on any ground.
    fn heavy(&self, d: &mut Drawing<'_>, data: &str, class: &str, key: &str) {
        if data.is_empty() {
            return;
        }
        let _ = write!(d.above, r#"<path class="casing" d="{data}"/><path class="line {class} best" d="{data}"/>"#);
        d.line_key(&format!("line {class} best"), self.t.get(key));
    }

    /// The path that the run returned, after all its stages.
    fn returned(&self, d: &mut Drawing<'_>) {
        let Some(run) = self.run.filter(|r| r.path.len() >= 2) else { return };
        let class = if run.valid { self.colour() } else { "invalid".to_owned() };
        self.heavy(
            d,
            &polyline(self.camera, &run.path),
            &class,
            if run.valid { "own_returned" } else { "own_returned_invalid" },
        );
    }

    /// Each different line once, translucent. Returns how many differ.
    fn bundle(&self, d: &mut Drawing<'_>, lines: &[Line], class: &str) -> usize {
        let different: BTreeSet<String> =
            lines.iter().map(|l| self.path_data(l)).filter(|data| !data.is_empty()).collect();
        for data in &different {
            let _ = write!(d.above, r#"<path class="line {class}" d="{data}"/>"#);
        }
        different.len()
    }

    fn swarm(
        &self,
        d: &mut Drawing<'_>,
        rectangle: &[Spot],
        [particles, bests]: [&[Line]; 2],
        best: &[Spot],
        total: usize,
    ) {
        let closed: Line = rectangle.iter().chain(rectangle.first()).copied().collect();
        let _ = write!(d.above, r#"<path class="bounds" d="{}"/>"#, self.path_data(&closed));
        let colour = self.colour();
        self.bundle(d, bests, &format!("{colour} memory"));
        self.bundle(d, particles, &format!("{colour} faint"));
        d.line_key(&format!("line {colour} faint"), self.t.get("own_particle"));
        d.line_key(&format!("line {colour} memory"), self.t.get("own_personal"));
        self.heavy(d, &self.path_data(best), &colour, "own_global");
        d.line_key("bounds", self.t.get("own_rectangle"));
        self.say(d, "own_swarm", &[("n", &format::count(total as f64))]);
        self.cut(d, particles.len(), total);
        self.row(d, "own_particles", format::count(total as f64));
    }

    /// Says so when only some are drawn.
    fn cut(&self, d: &mut Drawing<'_>, drawn: usize, total: usize) {
        if drawn < total {
            let [drawn, total] = [drawn, total].map(|n| format::count(n as f64));
            self.say(d, "own_cut", &[("n", &drawn), ("total", &total)]);
        }
    }

    /// Columns and rows of the planner's own grid.
    fn size(&self, mesh: &Mesh) -> [String; 2] {
        mesh.whole.unwrap_or([mesh.columns, mesh.rows]).map(|n| format::count(n as f64))
    }

    fn cells(
        &self,
        d: &mut Drawing<'a>,
        mesh: &Mesh,
        (marks, counts): (&[u8], Option<[usize; 3]>),
        heat: Option<&'a Heat>,
        borders: &[[Spot; 2]],
        path: &[Spot],
    ) {
        let t = self.t;
        let [columns, rows] = self.size(mesh);
        self.say(d, "own_cells", &[("columns", &columns), ("rows", &rows)]);
        self.row(d, "own_grid", format!("{columns} × {rows}"));
        if mesh.every > 1 {
            self.say(d, "own_thinned", &[("n", &mesh.every.to_string())]);
        }
        if let Some(heat) = heat {
            self.heat(d, heat, mesh);
        }
        self.grid(d, mesh);
        let kinds =
            [(CellMark::Blocked, "own_blocked"), (CellMark::Closed, "own_closed"), (CellMark::Open, "own_open")];
        for (k, (mark, key)) in kinds.into_iter().enumerate() {
            let is = |byte: &&u8| CellMark::from_byte(**byte) == mark;
            let drawn = marks.iter().filter(is).count();
            if drawn > 0 {
                self.mark(d, mesh, mark, |cell| marks.get(cell).filter(is).map(|_| ()), t.get(key));
            }
            let count = counts.map_or(drawn, |c| c[k]);
            if count > 0 {
                self.row(d, key, format::count(count as f64));
            }
        }
        if !borders.is_empty() {
            let data: String = borders.iter().map(|b| self.path_data(b)).collect();
            let _ = write!(d.above, r#"<path class="casing thin" d="{data}"/><path class="border" d="{data}"/>"#);
            d.line_key("border", t.get("own_border"));
            self.row(d, "own_borders", format::count(borders.len() as f64));
        }
        self.heavy(d, &self.path_data(path), &self.colour(), "own_path");
    }

    fn heat(&self, d: &mut Drawing<'a>, heat: &'a Heat, mesh: &Mesh) {
        let key = format!("quantity_{}", heat.quantity);
        let name = if self.t.has(&key) { self.t.get(&key).to_owned() } else { heat.quantity.clone() };
        let [min, max] = [heat.min, heat.max].map(number);
        let values = [("quantity", name.as_str()), ("min", min.as_str()), ("max", max.as_str())];
        self.say(d, if heat.log { "own_heat_log" } else { "own_heat" }, &values);
        d.rows.push((name.clone(), format!("{min} … {max}")));
        d.below += &layer(heat, mesh, self.camera);
        d.heat = Some((heat, name));
    }

    /// Thin lines between cells, where they are large enough to be seen.
    fn grid(&self, d: &mut Drawing<'_>, mesh: &Mesh) {
        if mesh.size * self.camera.scale < VISIBLE {
            return;
        }
        d.below += &open_cells(mesh, self.camera, "mesh");
        d.below += r#"<path d=""#;
        for column in 0..=mesh.columns {
            let _ = write!(d.below, "M{:.1} -.5v{}", column as f64 - 0.5, mesh.rows);
        }
        for row in 0..=mesh.rows {
            let _ = write!(d.below, "M-.5 {:.1}h{}", row as f64 - 0.5, mesh.columns);
        }
        d.below += r#""/></g>"#;
    }

    /// Hatches or dots the cells for which `has` says something.
    fn mark(&self, d: &mut Drawing<'_>, mesh: &Mesh, mark: CellMark, has: impl Fn(usize) -> Option<()>, words: &str) {
        // Lines with one dash a cell. Shapes, not shades, tell them apart, with an edge of the
        // other lightness: so they are the same on heat of any colour and on light and dark pages.
        let strokes: &[&str] = match mark {
            CellMark::Open => &["across", "down", "across core", "down core"],
            CellMark::Closed => &["closed", "closed core"],
            CellMark::Blocked | CellMark::None => return self.hatch(d, mesh, has, words),
        };
        let draw = |data: &str| -> String {
            strokes.iter().map(|class| format!(r#"<path class="{class}" d="{data}"/>"#)).collect()
        };
        let mut data = String::new();
        for_each_run(mesh, has, |(), column, row, length| {
            let _ = write!(data, "M{:.1} {row}h{length}", column as f64 - 0.5);
        });
        d.below += &open_cells(mesh, self.camera, "dotted");
        d.below += &draw(&data);
        d.below += "</g>";
        d.key(&format!(r#"<g class="dotted" transform="translate(12 7) scale(12)">{}</g>"#, draw("M-.5 0h2")), words);
    }

    fn hatch(&self, d: &mut Drawing<'_>, mesh: &Mesh, has: impl Fn(usize) -> Option<()>, words: &str) {
        let (id, scale) = (self.id, 1.0 / (mesh.size * self.camera.scale));
        let stripes =
            |data: &str| format!(r#"<path class="stripe under" d="{data}"/><path class="stripe" d="{data}"/>"#);
        let _ = write!(
            d.below,
            r#"<pattern id="{id}-h" width="5" height="5" patternUnits="userSpaceOnUse" patternTransform="scale({scale:.5})">{}</pattern>"#,
            stripes(STRIPES)
        );
        d.below += &open_cells(mesh, self.camera, "hatch");
        let _ = write!(d.below, r#"<path fill="url(#{id}-h)" d=""#);
        for_each_run(mesh, has, |(), column, row, length| {
            let _ = write!(d.below, "M{:.1} {:.1}h{length}v1h-{length}z", column as f64 - 0.5, row as f64 - 0.5);
        });
        d.below += r#""/></g>"#;
        d.key(&stripes(STRIPED_KEY), words);
    }

    fn trees(&self, d: &mut Drawing<'_>, trees: &[Tree]) {
        let nodes: usize = trees.iter().map(|t| t.total).sum();
        let count = |n: usize| format::count(n as f64);
        self.say(d, if trees.len() > 1 { "own_trees" } else { "own_tree" }, &[("nodes", &count(nodes))]);
        for (k, tree) in trees.iter().enumerate() {
            let colour = if k % 2 == 0 { self.colour() } else { "other".to_owned() };
            let class = format!("line tree {colour}{}", if nodes > DENSE { " dense" } else { "" });
            // Under the obstacles, which edges do not enter: they must not be lost in a thicket.
            let _ = write!(d.below, r#"<path class="{class}" d="{}"/>"#, self.branches(tree));
            let number = (k + 1).to_string();
            let name = if trees.len() > 1 {
                self.t.fill("own_tree_of", &[("n", &number)])
            } else {
                self.t.get("own_edges").to_owned()
            };
            d.line_key(&class, &name);
            d.rows.push((name, count(tree.total)));
            self.cut(d, tree.nodes.len(), tree.total);
        }
        self.returned(d);
    }

    /// All edges: from each node not drawn yet towards the root, as far as nothing is drawn.
    fn branches(&self, tree: &Tree) -> String {
        let mut drawn = vec![false; tree.nodes.len()];
        let mut out = String::new();
        for leaf in (0..tree.nodes.len()).rev() {
            let mut line = vec![tree.nodes[leaf]];
            let mut node = leaf;
            while !drawn[node] {
                drawn[node] = true;
                let parent = tree.parents.get(node).map_or(node, |p| *p as usize);
                let Some(spot) = tree.nodes.get(parent).filter(|_| parent != node) else { break };
                line.push(*spot);
                node = parent;
            }
            if line.len() > 1 {
                out += &self.path_data(&line);
            }
        }
        out
    }

    fn population(&self, d: &mut Drawing<'_>, paths: &[Line], mesh: Option<&Mesh>, best: &[Spot], total: usize) {
        if let Some(mesh) = mesh {
            self.grid(d, mesh);
        }
        let colour = self.colour();
        let different = format::count(self.bundle(d, paths, &format!("{colour} faint")) as f64);
        d.line_key(&format!("line {colour} faint"), self.t.get("own_individual"));
        self.heavy(d, &self.path_data(best), &colour, "own_fittest");
        let n = format::count(total as f64);
        self.say(d, "own_population", &[("n", &n), ("different", &different)]);
        self.cut(d, paths.len(), total);
        self.row(d, "own_individuals", n);
        self.row(d, "own_different", different);
        if let Some((_, best, mean)) = self.snapshot.generations.last() {
            let [best, mean] = [*best, *mean].map(|v| format::significant(v, 4));
            self.say(d, "own_fitness", &[("best", &best), ("mean", &mean)]);
            self.row(d, "own_best_fitness", best);
            self.row(d, "own_mean_fitness", mean);
        }
    }

    fn forces(&self, d: &mut Drawing<'_>, mesh: &Mesh, directions: &[[i8; 2]], trail: &[Spot], stuck: Option<Spot>) {
        let (mut lines, mut heads) = (String::new(), String::new());
        let place =
            |(x, y): (f64, f64)| Point::new(mesh.min[0] + (x + 0.5) * mesh.size, mesh.min[1] + (y + 0.5) * mesh.size);
        for line in streamlines(mesh, directions) {
            let points: Vec<Point> = line.into_iter().map(place).collect();
            lines += &polyline(self.camera, &points);
            heads += &self.head(&points);
        }
        let _ = write!(d.below, r#"<path class="flow" d="{lines}"/><path class="flow head" d="{heads}"/>"#);
        d.key(
            r#"<path class="flow" d="M1 7H35"/><path class="flow head" d="M16 3l5 4l-5 4"/>"#,
            self.t.get("own_flow"),
        );
        let [columns, rows] = self.size(mesh);
        self.say(d, "own_forces", &[("columns", &columns), ("rows", &rows)]);
        self.row(d, "own_grid", format!("{columns} × {rows}"));
        self.heavy(d, &self.path_data(trail), &self.colour(), "own_trail");
        self.row(d, "own_trail_points", format::count(trail.len() as f64));
        if let Some(spot) = stuck {
            let p = self.snapshot.ruler.point(spot);
            d.top += &cross_mark(self.camera, p);
            d.key(r#"<path class="cross" d="M12 1l12 12m0-12l-12 12"/>"#, self.t.get("own_stuck"));
            let [x, y] = [p.x, p.y].map(|v| format::significant(v, 4));
            self.say(d, "own_stuck_text", &[("x", &x), ("y", &y)]);
            self.row(d, "own_stuck", format!("({x}, {y})"));
        }
    }

    /// An arrow head in the middle of a line.
    fn head(&self, points: &[Point]) -> String {
        let middle = points.len() / 2;
        let (Some(a), Some(b)) = (points.get(middle.wrapping_sub(1)), points.get(middle)) else { return String::new() };
        let ((ax, ay), (bx, by)) = (self.camera.map(*a), self.camera.map(*b));
        let length = (bx - ax).hypot(by - ay);
        if length <= 0.0 {
            return String::new();
        }
        let (ux, uy) = ((bx - ax) / length, (by - ay) / length);
        let wing = |side: f64| (bx - 4.5 * ux - 3.0 * side * uy, by - 4.5 * uy + 3.0 * side * ux);
        let ((lx, ly), (rx, ry)) = (wing(1.0), wing(-1.0));
        format!("M{lx:.1} {ly:.1}L{bx:.1} {by:.1}L{rx:.1} {ry:.1}")
    }
}
