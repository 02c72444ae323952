//! Numbers as people read them: lengths to six digits, gaps to three, times with a unit that fits.

/// Shown for +∞, which is what a failure counts as.
pub const INFINITE: &str = "∞";
/// Shown where there is no value.
pub const NONE: &str = "—";

/// `value` with `digits` significant digits in plain decimals, trailing zeros kept
/// out; 1e-15 < |value| < 1e15 assumed, other values fall back to scientific notation.
pub fn significant(value: f64, digits: usize) -> String {
    if value.is_nan() {
        return NONE.to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { INFINITE.to_owned() } else { format!("−{INFINITE}") };
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    // Rounding first: 9.999 with three digits is 10.0, one decimal fewer.
    let scientific = format!("{:.*e}", digits.saturating_sub(1), value.abs());
    let exponent: i32 = scientific.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0);
    let sign = if value < 0.0 { "−" } else { "" };
    if !(-15..15).contains(&exponent) {
        return format!("{sign}{scientific}");
    }
    let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
    let plain = format!("{:.decimals$}", value.abs());
    let plain = if plain.contains('.') { plain.trim_end_matches('0').trim_end_matches('.') } else { &plain };
    format!("{sign}{}", grouped(plain))
}

/// Thousands parted by narrow no-break spaces from 10 000 on (ISO 80000-1).
fn grouped(plain: &str) -> String {
    let (whole, fraction) = plain.split_once('.').map_or((plain, None), |(w, f)| (w, Some(f)));
    let mut out = String::new();
    for (i, c) in whole.chars().enumerate() {
        if i > 0 && whole.len() > 4 && (whole.len() - i) % 3 == 0 {
            out.push('\u{202f}');
        }
        out.push(c);
    }
    if let Some(fraction) = fraction {
        out.push('.');
        out.push_str(fraction);
    }
    out
}

/// A length in scene units, six significant digits.
pub fn length(value: f64) -> String {
    significant(value, 6)
}

/// A ratio as percent, three significant digits; below 1e-9 it is rounding, not a gap.
pub fn percent(ratio: f64) -> String {
    if ratio.is_infinite() {
        return significant(ratio, 3);
    }
    if ratio != 0.0 && ratio.abs() < 1e-9 {
        return "≈ 0\u{a0}%".to_owned();
    }
    format!("{}\u{a0}%", significant(100.0 * ratio, 3))
}

/// An interval of shares as percent, with as many digits as it takes to tell its ends from each other, from 0 and
/// from 100 %.
pub fn share_interval(low: f64, high: f64) -> String {
    let text = |share: f64, digits: usize| match share {
        0.0 => "0".to_owned(),
        1.0 => "100".to_owned(),
        _ => format!("{:.digits$}", 100.0 * share),
    };
    let clear = |&digits: &usize| {
        let shown = |share: f64| text(share, digits).parse::<f64>().unwrap_or(share);
        let inside = |share: f64| share == 0.0 || share == 1.0 || (shown(share) > 0.0 && shown(share) < 100.0);
        inside(low) && inside(high) && (low == high || shown(low) < shown(high))
    };
    // Nine digits tell any ends apart that runs in their millions can have.
    let digits = (0..9).find(clear).unwrap_or(9);
    format!("{}–{}\u{a0}%", text(low, digits), text(high, digits))
}

/// A ratio as percent for a tick: long powers of ten as such.
pub fn percent_tick(ratio: f64) -> String {
    power(100.0 * ratio).map_or_else(|| percent(ratio), |power| format!("{power}\u{a0}%"))
}

/// 10ⁿ for a power of ten with n > 3 or n < −2, where plain decimals are the longer ones, else `None`.
pub fn power(value: f64) -> Option<String> {
    let exponent = value.log10();
    let whole = exponent.round();
    (value > 0.0 && (exponent - whole).abs() < 1e-9 && !(-2.0..=3.0).contains(&whole))
        .then(|| format!("10{}", format!("{whole:.0}").chars().map(superscript).collect::<String>()))
}

fn superscript(c: char) -> char {
    match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        d => d.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(d),
    }
}

/// A time given in µs, three significant digits, as ns, µs, ms or s.
pub fn time(us: f64) -> String {
    if !us.is_finite() {
        return significant(us, 3);
    }
    // 999.6 µs would round to 1000 µs; the bounds are where three digits overflow.
    let (value, unit) = match us.abs() {
        t if t < 0.9995 => (us * 1e3, "ns"),
        t if t < 999.5 => (us, "µs"),
        t if t < 999.5e3 => (us / 1e3, "ms"),
        _ => (us / 1e6, "s"),
    };
    format!("{}\u{a0}{unit}", significant(value, 3))
}

/// An angle given in rad, as whole degrees.
pub fn angle(radians: f64) -> String {
    if radians.is_finite() { format!("{:.0}°", radians.to_degrees()) } else { significant(radians, 3) }
}

/// A count, or a median of counts: whole numbers in full, halves with their half.
pub fn count(value: f64) -> String {
    if value.is_finite() && value.abs() < 1e15 && (2.0 * value).fract() == 0.0 {
        let halves = if value.fract() == 0.0 { 0 } else { 1 };
        return grouped(&format!("{value:.halves$}"));
    }
    significant(value, 4)
}

/// What sorting reads: the number in full, `Infinity` spelt as JavaScript does.
pub fn sort_key(value: f64) -> String {
    if value.is_nan() || value == f64::INFINITY {
        "Infinity".to_owned()
    } else if value == f64::NEG_INFINITY {
        "-Infinity".to_owned()
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::wilson;

    #[test]
    fn lengths() {
        assert_eq!(length(231.588_978_257), "231.589");
        assert_eq!(length(0.0), "0");
        assert_eq!(length(9.999_999_9), "10");
        assert_eq!(length(f64::INFINITY), "∞");
        assert_eq!(length(-12.5), "−12.5");
        assert_eq!(length(1_234_567.0), "1\u{202f}234\u{202f}567");
        assert_eq!(length(f64::NAN), "—");
        assert_eq!(length(1e300), "1.00000e300");
    }

    #[test]
    fn percents_keep_small_gaps_readable() {
        assert_eq!(percent(2.0e-6), "0.0002\u{a0}%");
        assert_eq!(percent(0.044_41), "4.44\u{a0}%");
        assert_eq!(percent(4.317), "432\u{a0}%");
        assert_eq!(percent(3e-12), "≈ 0\u{a0}%");
        assert_eq!(percent(0.0), "0\u{a0}%");
        assert_eq!(percent(f64::INFINITY), "∞");
        assert_eq!(percent_tick(1e-7), "10⁻⁵\u{a0}%");
        assert_eq!(percent_tick(0.001), "0.1\u{a0}%");
        assert_eq!(percent_tick(1e-5), "10⁻³\u{a0}%");
        assert_eq!(percent_tick(1000.0), "10⁵\u{a0}%");
    }

    #[test]
    fn times_choose_their_unit() {
        assert_eq!(time(0.041), "41\u{a0}ns");
        assert_eq!(time(12.34), "12.3\u{a0}µs");
        assert_eq!(time(999.7), "1\u{a0}ms");
        assert_eq!(time(2_500_000.0), "2.5\u{a0}s");
    }

    #[test]
    fn counts() {
        assert_eq!(count(8020.0), "8020");
        assert_eq!(count(12_345.5), "12\u{202f}345.5");
        assert_eq!(count(0.0), "0");
    }

    #[test]
    fn sort_keys_are_javascript_numbers() {
        assert_eq!(sort_key(f64::INFINITY), "Infinity");
        assert_eq!(sort_key(0.25).parse::<f64>(), Ok(0.25));
    }

    #[test]
    fn intervals_are_never_points() {
        let shown = |k, n| {
            let (low, high) = wilson(k, n);
            share_interval(low, high)
        };
        assert_eq!(shown(30, 30), "89–100\u{a0}%");
        // n/(n + z²) = 2000/2003.84 = 0.998 08.
        assert_eq!(shown(2000, 2000), "99.8–100\u{a0}%");
        assert_eq!(shown(0, 2000), "0–0.2\u{a0}%");
        assert_eq!(shown(500_000, 1_000_000), "49.9–50.1\u{a0}%");
        assert_eq!(shown(0, 0), "0–100\u{a0}%");
        for n in [1, 7, 1000, 28_000, 10_000_000] {
            for k in [0, 1, n / 2, n - 1, n] {
                let text = shown(k, n);
                let (low, high) = text.trim_end_matches("\u{a0}%").split_once('–').unwrap();
                assert!(low != high && (low != "0" || k == 0) && (high != "100" || k == n), "{k}/{n}: {text}");
            }
        }
    }
}
