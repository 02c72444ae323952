//! Colours and how series differ: Okabe–Ito colours, dash and marker together.
//!
//! Okabe & Ito, *Color Universal Design* (2008). Vermillion is left out: failures are red,
//! and dashed; yellow is darkened on white, where the original cannot be seen.

use std::fmt::Write as _;

/// Name, value on light, value on dark ground.
const COLOURS: [(&str, &str, &str); 17] = [
    ("paper", "#ffffff", "#14171a"),
    ("panel", "#f5f6f8", "#1c2024"),
    ("ink", "#1b1f23", "#e8eaed"),
    ("muted", "#59636e", "#a3adb8"),
    ("rule", "#dde1e6", "#333a42"),
    ("link", "#0b5c94", "#7cc4f2"),
    ("obstacle", "#c4cad1", "#4a525b"),
    ("ring", "#98a1ab", "#79838e"),
    ("optimum", "#4d5761", "#c3cbd3"),
    ("warn", "#b3121d", "#ff7d78"),
    ("c0", "#0072b2", "#4aa8e0"),
    ("c1", "#e69f00", "#e69f00"),
    ("c2", "#009e73", "#1fbf92"),
    ("c3", "#cc79a7", "#d78fb8"),
    ("c4", "#56b4e9", "#8fd0f5"),
    ("c5", "#a89400", "#f0e442"),
    ("c6", "#1b1f23", "#e8eaed"),
];

/// Colours of series.
const SERIES: usize = 7;
/// Dash patterns; SERIES and DASHES have no common factor, so 28 series differ in the pair.
const DASHES: [&str; 4] = ["", "8 4", "2 4", "10 4 2 4"];
/// Marker outlines in a box from −1 to 1.
const MARKERS: [&str; 6] = [
    "M-.9 0a.9.9 0 1 0 1.8 0a.9.9 0 1 0-1.8 0z",
    "M-.8-.8h1.6v1.6h-1.6z",
    "M0-1.05L1 .8H-1z",
    "M0-1.15L1.05 0L0 1.15L-1.05 0z",
    "M-1-.35h.65V-1h.7v.65H1v.7H.35V1h-.7V.35H-1z",
    "M0 1.05L1-.8H-1z",
];

/// The page's colour variables, for both grounds, the viewer's choice and paper.
pub fn css_variables() -> String {
    let list = |dark: bool| {
        COLOURS.iter().fold(String::new(), |mut out, (name, l, d)| {
            let _ = write!(out, "--{name}:{};", if dark { d } else { l });
            out
        })
    };
    let (light, dark) = (list(false), list(true));
    format!(
        ":root{{color-scheme:light;{light}}}\n\
         @media (prefers-color-scheme:dark){{:root:not([data-theme=light]){{color-scheme:dark;{dark}}}}}\n\
         :root[data-theme=dark]{{color-scheme:dark;{dark}}}\n\
         @media print{{:root:root:root{{color-scheme:light;{light}}}}}\n"
    )
}

/// Style rules of series, in terms of the variables.
pub fn series_css() -> String {
    let mut out = String::new();
    for i in 0..SERIES {
        let _ = writeln!(out, ".line.c{i}{{stroke:var(--c{i})}}.fill.c{i}{{fill:var(--c{i})}}");
    }
    for (i, dash) in DASHES.iter().enumerate().skip(1) {
        let _ = writeln!(out, ".d{i}{{stroke-dasharray:{dash}}}");
    }
    out
}

/// `css` with every variable replaced by its value on light ground: for pictures
/// that other programs open, which often know no variables.
pub fn on_light(css: &str) -> String {
    COLOURS.iter().fold(css.to_owned(), |css, (name, light, _)| css.replace(&format!("var(--{name})"), light))
}

/// Class of the colour of series `i`.
pub fn colour(i: usize) -> String {
    format!("c{}", i % SERIES)
}

/// Classes of colour and dash of series `i`.
pub fn line(i: usize) -> String {
    format!("line c{} d{}", i % SERIES, i % DASHES.len())
}

/// The marker of series `i` at (x, y), about 10 units wide.
pub fn marker(i: usize, x: f64, y: f64) -> String {
    let shape = MARKERS[i % MARKERS.len()];
    format!(r#"<path class="fill mark c{}" transform="translate({x:.1} {y:.1}) scale(5)" d="{shape}"/>"#, i % SERIES)
}

/// A legend key: line and marker of series `i`, by reference to one of [`keys`].
pub fn swatch(i: usize) -> String {
    format!(r##"<svg class="swatch" viewBox="0 0 36 14" aria-hidden="true"><use href="#key{i}"/></svg>"##)
}

/// The keys of the first `n` series, once in the page: tables have them by the thousand.
pub fn keys(n: usize) -> String {
    let mut out = String::from(r#"<svg class="defs keys" width="0" height="0" aria-hidden="true"><defs>"#);
    for i in 0..n {
        let _ = write!(out, r#"<g id="key{i}"><path class="{}" d="M1 7H35"/>{}</g>"#, line(i), marker(i, 18.0, 7.0));
    }
    out + "</defs></svg>"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twenty_series_look_different() {
        let looks: std::collections::BTreeSet<_> =
            (0..20).map(|i| (i % SERIES, i % DASHES.len(), i % MARKERS.len())).collect();
        assert_eq!(looks.len(), 20);
    }

    #[test]
    fn pictures_on_light_ground_hold_no_variables() {
        let css = on_light(&series_css());
        assert!(!css.contains("var("), "{css}");
    }
}
