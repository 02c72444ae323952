//! Growth of time with size: a table on disk, exponents, a picture.
//!
//! The picture has logarithmic axes, on which a power is a straight line and its
//! exponent the slope. It is drawn from the table alone.

use std::fmt::Write as _;

use crate::statistics::exponent;

/// A curve of the picture.
pub struct Curve {
    /// What it is, in words.
    pub name: &'static str,
    /// The exponent is fitted to sizes from here …
    pub fit_from: f64,
    /// … to here.
    pub fit_to: f64,
}

/// Curves over one quantity.
pub struct Panel {
    /// The quantity, as in the table: one of the words under the axis.
    pub size: &'static str,
    /// What the axis says.
    pub axis: &'static str,
    /// Sizes marked on the axis.
    pub ticks: &'static [f64],
    /// The curves, top of the legend first.
    pub curves: &'static [Curve],
}

/// A measured time.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The curve's name.
    pub curve: String,
    /// The panel's quantity.
    pub size: String,
    /// How much of it.
    pub count: f64,
    /// Median time of a call, µs.
    pub time_us: f64,
    /// How many scenes the median is over.
    pub scenes: usize,
}

const HEAD: &str = "work,size,count,median_us,scenes";

/// The table as CSV.
pub fn to_csv(points: &[Point]) -> String {
    let mut out = format!("{HEAD}\n");
    for Point { curve, size, count, time_us, scenes } in points {
        let _ = writeln!(out, "{curve},{size},{count},{time_us:.4},{scenes}");
    }
    out
}

/// The table from CSV.
///
/// # Errors
/// The line that is none of the table's.
pub fn from_csv(text: &str) -> Result<Vec<Point>, String> {
    let rows = text.strip_prefix(HEAD).ok_or_else(|| format!("expected the head {HEAD}"))?;
    let parse = |line: &str| {
        let mut cells = line.split(',');
        let mut next = || cells.next();
        let (curve, size) = (next()?.to_owned(), next()?.to_owned());
        let (count, time_us, scenes) = (next()?.parse().ok()?, next()?.parse().ok()?, next()?.parse().ok()?);
        Some(Point { curve, size, count, time_us, scenes })
    };
    rows.lines().filter(|line| !line.is_empty()).map(|line| parse(line).ok_or_else(|| line.to_owned())).collect()
}

/// Sizes and times of a curve.
fn of(points: &[Point], panel: &Panel, curve: &Curve) -> Vec<(f64, f64)> {
    let own = points.iter().filter(|p| p.size == panel.size && p.curve == curve.name);
    own.map(|p| (p.count, p.time_us)).collect()
}

/// The exponent p of time ∝ countᵖ over the curve's range; `None` with fewer than two sizes in it.
pub fn exponent_of(points: &[Point], panel: &Panel, curve: &Curve) -> Option<f64> {
    let mut fitted = of(points, panel, curve);
    fitted.retain(|(count, _)| (curve.fit_from..=curve.fit_to).contains(count));
    exponent(&fitted)
}

const WIDTH: f64 = 900.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 540.0;
const TOP: f64 = 34.0;
const PLOT: f64 = 250.0;
const PANEL: f64 = 350.0;
/// Room for a label of two lines.
const LABEL: f64 = 42.0;

/// Colours after Okabe & Ito, *Color Universal Design* (2008), on light and on dark ground.
const COLOURS: [(&str, &str); 4] =
    [("#0072b2", "#4aa8e0"), ("#b35c00", "#e69f00"), ("#00795a", "#1fbf92"), ("#a3447f", "#d78fb8")];
/// Marker outlines in a box from −1 to 1, so that curves differ without colour.
const MARKERS: [&str; 4] = [
    "M-1 0a1 1 0 1 0 2 0a1 1 0 1 0-2 0z",
    "M-.9-.9h1.8v1.8h-1.8z",
    "M0-1.1L1.1 .9H-1.1z",
    "M0-1.2L1.1 0L0 1.2L-1.1 0z",
];

/// The picture: one panel below the other, an exponent beside every curve. Follows the viewer's light or dark ground.
pub fn svg(title: &str, panels: &[Panel], points: &[Point]) -> String {
    let height = PANEL * panels.len() as f64;
    let mut out = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}" role="img" aria-labelledby="title"><title id="title">{title}</title><style>{}</style><rect class="ground" width="100%" height="100%"/>"#,
        css()
    );
    for (i, panel) in panels.iter().enumerate() {
        let _ = write!(out, "\n<g transform=\"translate(0 {})\">{}</g>", PANEL * i as f64, draw(panel, points));
    }
    out + "\n</svg>\n"
}

fn css() -> String {
    let ground = |paper: &str, ink: &str, muted: &str, rule: &str, colours: &dyn Fn(usize) -> &'static str| {
        let mut out = format!(".ground{{fill:{paper}}}text{{fill:{ink}}}.muted{{fill:{muted}}}.grid{{stroke:{rule}}}");
        for i in 0..COLOURS.len() {
            let _ = write!(out, ".line.c{i}{{stroke:{0}}}.mark.c{i}{{fill:{0}}}", colours(i));
        }
        out
    };
    format!(
        "text{{font:14px system-ui,sans-serif}}.axis{{font-weight:600}}.muted{{font-size:13px}}.end{{text-anchor:end}}\
         .middle{{text-anchor:middle}}.line{{fill:none;stroke-width:1.8}}.grid{{stroke-width:1}}{}\
         @media(prefers-color-scheme:dark){{{}}}",
        ground("#ffffff", "#1b1f23", "#59636e", "#dde1e6", &|i| COLOURS[i].0),
        ground("#14171a", "#e8eaed", "#a3adb8", "#333a42", &|i| COLOURS[i].1),
    )
}

/// A whole number, its thousands apart from 10 000 on, where it must be whole thousands.
fn grouped(count: f64) -> String {
    if count < 1e4 { format!("{count}") } else { format!("{}\u{a0}000", count / 1e3) }
}

/// `10^exponent` µs in words.
fn decade(exponent: i32) -> String {
    let (unit, shift) = match exponent {
        ..0 => ("ns", 3),
        0..3 => ("µs", 0),
        3..6 => ("ms", -3),
        _ => ("s", -6),
    };
    format!("{} {unit}", 10f64.powi(exponent + shift))
}

fn draw(panel: &Panel, points: &[Point]) -> String {
    let curves: Vec<_> = (panel.curves.iter().enumerate())
        .map(|(i, curve)| (i, curve, of(points, panel, curve)))
        .filter(|(_, _, own)| !own.is_empty())
        .collect();
    let all = || curves.iter().flat_map(|(_, _, own)| own.iter().copied());
    let range = |values: &dyn Fn((f64, f64)) -> f64| {
        all().map(values).fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)))
    };
    let (x_low, x_high) = range(&|(count, _)| count.ln());
    let (y_low, y_high) = range(&|(_, time)| time.log10());
    if curves.is_empty() || x_low == x_high {
        return String::new();
    }
    let (y_low, y_high) = (y_low.floor(), y_high.ceil().max(y_low.floor() + 1.0));
    let x_at = |count: f64| LEFT + (count.ln() - x_low) / (x_high - x_low) * (RIGHT - LEFT);
    let y_at = |time: f64| TOP + (y_high - time.log10()) / (y_high - y_low) * PLOT;

    let mut out =
        format!(r#"<text class="axis" x="12" y="20">Time of a call against the number of {}</text>"#, panel.axis);
    for exponent in y_low as i32..=y_high as i32 {
        let y = y_at(10f64.powi(exponent));
        let _ = write!(
            out,
            r#"<path class="grid" d="M{LEFT} {y:.1}H{RIGHT}"/><text class="muted end" x="{:.1}" y="{:.1}">{}</text>"#,
            LEFT - 8.0,
            y + 4.5,
            decade(exponent)
        );
    }
    for &tick in panel.ticks {
        let x = x_at(tick);
        let _ = write!(
            out,
            r#"<path class="grid" d="M{x:.1} {TOP}V{0:.1}"/><text class="muted middle" x="{x:.1}" y="{1:.1}">{2}</text>"#,
            TOP + PLOT,
            TOP + PLOT + 19.0,
            grouped(tick)
        );
    }
    // Labels stand at the ends of their curves, moved apart where these meet.
    let mut ends: Vec<(f64, usize, &Curve)> =
        curves.iter().map(|(i, curve, own)| (y_at(own[own.len() - 1].1), *i, *curve)).collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    for k in 0..ends.len() {
        let least = if k == 0 { TOP + 8.0 } else { ends[k - 1].0 + LABEL };
        ends[k].0 = ends[k].0.max(least);
    }
    for k in (0..ends.len()).rev() {
        let most = if k + 1 == ends.len() { TOP + PLOT - 8.0 } else { ends[k + 1].0 - LABEL };
        ends[k].0 = ends[k].0.min(most);
    }
    for (i, _, own) in &curves {
        let places: Vec<String> = own.iter().map(|(n, t)| format!("{:.1} {:.1}", x_at(*n), y_at(*t))).collect();
        let _ = write!(out, r#"<path class="line c{i}" d="M{}"/>"#, places.join("L"));
        for (count, time) in own {
            out += &marker(*i, x_at(*count), y_at(*time));
        }
    }
    for (y, i, curve) in ends {
        let growth = exponent_of(points, panel, curve).map_or(String::new(), |p| {
            format!(
                r#"grows with the power <tspan class="axis">{p:.2}</tspan> ({} to {})"#,
                grouped(curve.fit_from),
                grouped(curve.fit_to)
            )
        });
        out += &marker(i, RIGHT + 18.0, y - 4.0);
        let _ = write!(
            out,
            r#"<text x="{0:.1}" y="{y:.1}">{1}</text><text class="muted" x="{0:.1}" y="{2:.1}">{growth}</text>"#,
            RIGHT + 30.0,
            curve.name,
            y + 17.0
        );
    }
    out
}

fn marker(curve: usize, x: f64, y: f64) -> String {
    let shape = MARKERS[curve % MARKERS.len()];
    format!(r#"<path class="mark c{curve}" transform="translate({x:.1} {y:.1}) scale(4.5)" d="{shape}"/>"#)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PANEL: Panel = Panel {
        size: "discs",
        axis: "discs",
        ticks: &[10.0, 1000.0],
        curves: &[Curve { name: "square", fit_from: 100.0, fit_to: 1000.0 }],
    };

    fn points() -> Vec<Point> {
        // Below the range of the fit it is no square.
        [(10.0, 5.0), (100.0, 10.0), (1000.0, 1000.0)]
            .map(|(count, time_us)| Point { curve: "square".into(), size: "discs".into(), count, time_us, scenes: 3 })
            .to_vec()
    }

    #[test]
    fn tables_come_back() {
        assert_eq!(from_csv(&to_csv(&points())), Ok(points()));
        assert!(from_csv("work,size\n").is_err());
        assert_eq!(from_csv(&format!("{HEAD}\na,b,c,1,1\n")), Err("a,b,c,1,1".into()));
    }

    #[test]
    fn exponents_are_fitted_to_their_range() {
        let p = exponent_of(&points(), &PANEL, &PANEL.curves[0]).unwrap();
        assert!((p - 2.0).abs() < 1e-12, "rounding only: {p}");
    }

    #[test]
    fn pictures_place_points_on_logarithmic_axes() {
        let picture = svg("growth", &[PANEL], &points());
        // The middle of three sizes a decade apart is in the middle; 1 µs to 1 ms are three decades.
        assert!(picture.contains("L312.0 200.7L"), "{picture}");
        assert!(picture.contains(">1 ms<") && picture.contains(">2.00<"), "{picture}");
        assert!(picture.contains("prefers-color-scheme:dark"));
    }
}
