//! What benchmarks print and keep: tables in Markdown, CSV, the machine in words.

use std::fs;
use std::path::{Path, PathBuf};

/// Prints a Markdown table, columns aligned: the first to the left, the others to the right.
pub fn print_table<const N: usize>(head: [&str; N], rows: &[[String; N]]) {
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells.chain([head[column].chars().count(), 2]).max().unwrap_or(0)
    };
    let widths: [usize; N] = std::array::from_fn(width);
    let line = |cells: [&str; N]| {
        let pad = |(i, cell): (usize, &str)| match i {
            0 => format!(" {cell:<0$} |", widths[i]),
            _ => format!(" {cell:>0$} |", widths[i]),
        };
        println!("|{}", cells.into_iter().enumerate().map(pad).collect::<String>());
    };
    line(head);
    let rule = |i: usize| if i == 0 { "-".repeat(widths[i]) } else { "-".repeat(widths[i] - 1) + ":" };
    let rules: [String; N] = std::array::from_fn(rule);
    line(rules.each_ref().map(String::as_str));
    for row in rows {
        line(row.each_ref().map(String::as_str));
    }
}

/// A time of `us` microseconds in the unit that suits it, three digits.
pub fn time(us: f64) -> String {
    let digits = |v: f64| match v {
        v if v >= 99.95 => format!("{v:.0}"),
        v if v >= 9.995 => format!("{v:.1}"),
        v => format!("{v:.2}"),
    };
    match us {
        us if us < 0.5 => format!("{} ns", digits(us * 1e3)),
        us if us < 10_000.0 => format!("{} µs", digits(us)),
        us => format!("{} ms", digits(us * 1e-3)),
    }
}

/// The processor's model where the system tells it in a file (Linux), else its architecture.
pub fn cpu() -> String {
    let model = |text: String| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    fs::read_to_string("/proc/cpuinfo").ok().and_then(model).unwrap_or_else(|| std::env::consts::ARCH.to_owned())
}

/// Vector units that the running program finds, narrowest first.
pub fn vector_units() -> Vec<&'static str> {
    #[cfg(target_arch = "x86_64")]
    let found = [
        ("SSE2", is_x86_feature_detected!("sse2")),
        ("AVX", is_x86_feature_detected!("avx")),
        ("AVX2", is_x86_feature_detected!("avx2")),
        ("FMA", is_x86_feature_detected!("fma")),
        (
            "AVX-512",
            is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl"),
        ),
    ];
    #[cfg(target_arch = "aarch64")]
    let found = [("NEON", std::arch::is_aarch64_feature_detected!("neon"))];
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    let found: [(&str, bool); 0] = [];
    found.into_iter().filter(|(_, there)| *there).map(|(name, _)| name).collect()
}

/// A path inside this repository.
pub fn in_repository(relative: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(relative)
}

/// Writes a file of this repository and says so.
///
/// # Panics
/// When the file cannot be written.
pub fn write(relative: &str, text: &str) {
    let path = in_repository(relative);
    let folder = path.parent().unwrap_or(&path);
    fs::create_dir_all(folder).and_then(|()| fs::write(&path, text)).unwrap_or_else(|e| panic!("{relative}: {e}"));
    println!("wrote {relative}");
}

/// The values after `--name` on the command line; `None` without that option.
pub fn option(name: &str) -> Option<String> {
    let mut arguments = std::env::args().skip_while(|a| a != name);
    arguments.next()?;
    arguments.next()
}

/// Whether `--name` is on the command line.
pub fn flag(name: &str) -> bool {
    std::env::args().any(|a| a == name)
}

#[cfg(test)]
mod tests {
    use super::time;

    #[test]
    fn times_have_three_digits_and_a_unit() {
        let given = [0.0084, 0.0999, 0.6, 9.999, 99.96, 9_000.0, 595_000.0];
        assert_eq!(given.map(time), ["8.40 ns", "99.9 ns", "0.60 µs", "10.0 µs", "100 µs", "9000 µs", "595 ms"]);
    }
}
