//! A folder with a small comparison, and the command run in it.

// Every test binary uses its own part of this.
#![allow(dead_code)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of its own for each test, gone afterwards.
pub struct Place(pub PathBuf);

impl Place {
    /// A new one.
    pub fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("touchline-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    /// What `touchline args…` does.
    pub fn run(&self, args: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_touchline")).args(args).current_dir(&self.0).output().unwrap()
    }

    /// Exit code, standard output and standard error of `touchline args…`.
    pub fn told(&self, args: &[&str]) -> (i32, String, String) {
        let output = self.run(args);
        (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
    }

    /// Writes a file.
    pub fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).unwrap();
    }

    /// A file's text.
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Every file below, sorted.
    pub fn files(&self) -> Vec<String> {
        fn walk(folder: &Path, root: &Path, files: &mut Vec<String>) {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                files.push(path.strip_prefix(root).unwrap().display().to_string());
                if path.is_dir() {
                    walk(&path, root, files);
                }
            }
        }
        let mut files = Vec::new();
        walk(&self.0, &self.0, &mut files);
        files.sort();
        files
    }

    /// Expects success; what was printed.
    pub fn ok(&self, args: &[&str]) -> String {
        let output = self.run(args);
        assert!(output.status.success(), "{args:?}: {}", text(&output.stderr));
        text(&output.stdout)
    }

    /// Expects exit code 2, `message` on standard error and no new file.
    pub fn refused(&self, args: &[&str], message: &str) {
        let before = self.files();
        let output = self.run(args);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {error}");
        assert!(error.contains(message), "{args:?}:\n{error}\nexpected: {message}");
        assert_eq!(self.files(), before, "{args:?} wrote something");
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Output as text.
pub fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// One disc between start and goal.
pub const SCENE: &str = "name = \"one\"\nunit = \"cm\"\nstart = [0.0, 0.0]\ngoal = [10.0, 0.0]\n
[[obstacle]]\ndisc = { centre = [5.0, 0.5], radius = 1.0 }\n";
/// Nine runs.
pub const COMPARISON: &str = "name = \"small\"\nrepeats = 3\nscenes = [\"one.toml\"]\n
[planner.straight-line]\n[planner.pso]\niterations = 20\n[planner.tangent]\n";

/// A place with `one.toml` and `small.toml`.
pub fn furnished(name: &str) -> Place {
    let place = Place::new(name);
    place.write("one.toml", SCENE);
    place.write("small.toml", COMPARISON);
    place
}

/// `runs.csv` without its time columns.
pub fn timeless(csv: &str) -> String {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let keep: Vec<bool> = reader.headers().unwrap().iter().map(|h| h != "time_us" && h != "cpu_us").collect();
    assert_eq!(keep.iter().filter(|k| !**k).count(), 2);
    let rows = reader.records().map(|row| {
        let row = row.unwrap();
        let cells: Vec<&str> = row.iter().zip(&keep).filter(|(_, k)| **k).map(|(c, _)| c).collect();
        cells.join(",") + "\n"
    });
    rows.collect()
}
