//! Numbers on cells as colours, and the bar that says which colour is which number.
//!
//! The colours are every 8.2th of cividis, perceptually uniform and nearly the same to
//! viewers with and without colour-vision deficiency, on light and dark ground alike: Nuñez,
//! Anderton & Renslow, `PLoS` ONE 13(7) (2018) e0199239, doi:10.1371/journal.pone.0199239.

use std::fmt::Write as _;

use super::axis::Axis;
use super::camera::{Camera, LEFT, WIDTH};
use super::svg::escape;
use crate::format;
use crate::snapshot::{Heat, LEVELS, Mesh, NO_LEVEL};

/// cividis(i/31), dark for small numbers.
const CIVIDIS: [&str; 32] = [
    "#00224e", "#00285b", "#002e6a", "#083370", "#1c396f", "#293f6e", "#33446d", "#3d4a6c", "#45506c", "#4d556c",
    "#555b6d", "#5c616e", "#646770", "#6b6d72", "#727274", "#787877", "#807f78", "#888578", "#908b78", "#979177",
    "#a09875", "#a89e73", "#b0a571", "#b9ab6d", "#c1b26a", "#cbb965", "#d3c05f", "#dcc859", "#e5cf52", "#efd748",
    "#f8df3c", "#fee838",
];

/// Room below a picture for the bar.
pub const BAR: f64 = 62.0;

/// A rule for each colour.
pub fn css() -> String {
    CIVIDIS.iter().enumerate().fold(String::new(), |mut out, (i, colour)| {
        let _ = write!(out, ".h{i}{{stroke:{colour}}}");
        out + if i + 1 == CIVIDIS.len() { "\n" } else { "" }
    })
}

fn shade(level: u8) -> usize {
    usize::from(level) * CIVIDIS.len() / usize::from(LEVELS)
}

/// Opens a group whose unit is a cell: the middle of the lowest left one is (0, 0), y up.
pub fn open_cells(mesh: &Mesh, camera: &Camera, class: &str) -> String {
    let half = 0.5 * mesh.size;
    let (x, y) = camera.map(env_model::Point::new(mesh.min[0] + half, mesh.min[1] + half));
    let scale = mesh.size * camera.scale;
    format!(r#"<g class="{class}" transform="translate({x:.2} {y:.2}) scale({scale:.4} -{scale:.4})">"#)
}

/// Calls `found(key, column, row, length)` for every run of equal keys in a row of cells.
pub fn for_each_run<K: PartialEq + Copy>(
    mesh: &Mesh,
    key: impl Fn(usize) -> Option<K>,
    mut found: impl FnMut(K, usize, usize, usize),
) {
    for row in 0..mesh.rows {
        let mut column = 0;
        while column < mesh.columns {
            let begin = column;
            let this = key(row * mesh.columns + begin);
            while column < mesh.columns && key(row * mesh.columns + column) == this {
                column += 1;
            }
            if let Some(this) = this {
                found(this, begin, row, column - begin);
            }
        }
    }
}

/// The coloured cells: equal neighbours in a row are one line as thick as a cell, each colour one path.
pub fn layer(heat: &Heat, mesh: &Mesh, camera: &Camera) -> String {
    let mut paths = vec![String::new(); CIVIDIS.len()];
    let key = |cell: usize| heat.levels.get(cell).filter(|l| **l != NO_LEVEL).map(|l| shade(*l));
    for_each_run(mesh, key, |shade, column, row, length| {
        // Half a cell to the left: the group's origin is the middle of a cell.
        let _ = write!(paths[shade], "M{:.1} {row}h{length}", column as f64 - 0.5);
    });
    let mut out = open_cells(mesh, camera, "heat");
    for (i, d) in paths.iter().enumerate().filter(|(_, d)| !d.is_empty()) {
        let _ = write!(out, r#"<path class="h{i}" d="{}"/>"#, d.replace(".0 ", " "));
    }
    out + "</g>"
}

/// The bar, with its name and numbers, below the picture coordinate `top`.
pub fn bar(heat: &Heat, name: &str, top: f64) -> String {
    let mut out =
        format!(r#"<text class="name" x="{LEFT}" y="{:.1}">{}</text><g class="heat bar">"#, top + 14.0, escape(name));
    let width = WIDTH / CIVIDIS.len() as f64;
    for i in 0..CIVIDIS.len() {
        let x = LEFT + width * i as f64;
        let _ = write!(out, r#"<path class="h{i}" d="M{x:.2} {:.1}h{:.2}"/>"#, top + 28.0, width + 0.05);
    }
    out += r#"</g><g class="ticks">"#;
    let (from, to) = (LEFT, LEFT + WIDTH);
    let axis = if heat.log {
        Axis::log_exact(heat.min, heat.max, from, to)
    } else {
        Axis::linear(heat.min, heat.max, from, to)
    };
    for v in axis.ticks(5) {
        let x = axis.at(v);
        let anchor = match x {
            x if x < LEFT + 20.0 => "",
            x if x > LEFT + WIDTH - 20.0 => "end",
            _ => "middle",
        };
        let _ = write!(
            out,
            r#"<path d="M{x:.1} {:.1}v5"/><text class="{anchor}" x="{x:.1}" y="{:.1}">{}</text>"#,
            top + 34.0,
            top + 54.0,
            escape(&number(v))
        );
    }
    out + "</g>"
}

/// A number of the bar, three significant digits: powers of ten as such where they are large or small.
pub fn number(v: f64) -> String {
    let power = 10f64.powf(v.abs().log10().floor());
    match (format::power(v), format::power(power)) {
        (Some(whole), _) => whole,
        (None, Some(scale)) => format!("{} × {scale}", format::significant(v / power, 3)),
        (None, None) => format::significant(v, 3),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_level_has_a_colour() {
        assert_eq!((shade(0), shade(127), shade(254)), (0, 15, 31));
        assert_eq!(css().matches("stroke").count(), 32);
    }

    #[test]
    fn numbers_beyond_four_digits_are_powers() {
        let shown = [0.0, 120.0, 0.0123, 1e-12, 8.07e-45, -2.5e7, 9_999.0, 12_345.0].map(number);
        assert_eq!(shown, ["0", "120", "0.0123", "10⁻¹²", "8.07 × 10⁻⁴⁵", "−2.5 × 10⁷", "9999", "1.23 × 10⁴"]);
    }

    #[test]
    fn equal_neighbours_are_one_line() {
        let mesh = Mesh { min: [0.0, 0.0], size: 1.0, columns: 4, rows: 2, every: 1, whole: None };
        let levels = [0, 0, 254, 254, 0, NO_LEVEL, NO_LEVEL, 254];
        let mut runs = Vec::new();
        let key = |cell: usize| Some(levels[cell]).filter(|l| *l != NO_LEVEL);
        for_each_run(&mesh, key, |level, column, row, length| runs.push((level, column, row, length)));
        assert_eq!(runs, [(0, 0, 0, 2), (254, 2, 0, 2), (0, 0, 1, 1), (254, 3, 1, 1)], "rows do not run on");
    }
}
