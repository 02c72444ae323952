//! The commands in a report replay the runs that they stand beside.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Output};

const COMPARISON: &str = r#"
name = "replayed"
seed = 5
repeats = 2
scenes = [{ generate = "wall", count = 1, obstacles = 9, seed = 4 }]
[planner.swarm]
kind = "pso"
particles = 7
inertia = 0.6
velocity_limit = "none"
budget = { iterations = 20 }
refine = [{ kind = "qp", solver = "structured" }]
[planner.rrt-connect]
[planner.grid]
kind = "astar"
refine = ["qp"]
[planner.mine]
kind = "external"
command = ["sh", "mine.sh"]
bend = 3
"#;

/// An external planner that is found in its own folder alone, and answers with what it was asked.
const MINE: &str = r#"while IFS= read -r line; do
id=${line#*\"id\":}; id=${id%%,*}; bend=${line#*\"bend\":}; bend=${bend%%[,\}]*}
ends=$(echo "$line" | sed 's/.*"start":\(\[[^]]*\]\),"goal":\(\[[^]]*\]\).*/\1 \2/')
echo "{\"id\":$id,\"status\":\"solved\",\"path\":[${ends% *},[$bend,4],${ends#* }]}"
done
"#;

fn touchline(folder: &Path, words: &[&str]) -> Output {
    let output = Command::new(env!("CARGO_BIN_EXE_touchline")).current_dir(folder).args(words).output().unwrap();
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    output
}

/// The words of a command, as a POSIX shell reads them where it has no more than single quotes.
fn words(command: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for c in command.chars() {
        match c {
            '\'' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            c => words.last_mut().unwrap().push(c),
        }
    }
    words
}

#[test]
fn commands_replay_their_runs_to_the_last_bit() {
    let root = std::env::temp_dir().join(format!("touchline-replay-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&root);
    std::fs::create_dir_all(&root).unwrap();
    std::fs::write(root.join("replayed.toml"), COMPARISON).unwrap();
    std::fs::write(root.join("mine.sh"), MINE).unwrap();
    touchline(&root, &["run", "replayed.toml", "--out", "out", "--quiet"]);
    let out = root.join("out");
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let paths: Vec<serde_json::Value> = std::fs::read_to_string(out.join("paths.jsonl"))
        .unwrap()
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let mut rows = csv::Reader::from_path(out.join("runs.csv")).unwrap();
    let seeds: BTreeMap<(String, String), String> =
        rows.records().map(|r| r.unwrap()).map(|r| ((r[1].to_owned(), r[3].to_owned()), r[2].to_owned())).collect();
    let worst = page.split_once("id=\"worst\"").unwrap().1.split_once("id=\"missing\"").unwrap().0;
    let mut replayed = 0;
    for figure in worst.split("<figure").skip(1) {
        let between = |a: &str, b: &str| figure.split_once(a).unwrap().1.split_once(b).unwrap().0;
        let planner = between("</svg><span>", "</span>");
        let command =
            between("<code>", "</code>").replace("&#x27;", "'").replace("&quot;", "\"").replace("&#x2f;", "/");
        let words = words(&command);
        assert_eq!(words[0], "touchline", "{command}");
        let arguments: Vec<&str> = words[1..].iter().map(String::as_str).chain(["--json"]).collect();
        let again: serde_json::Value = serde_json::from_slice(&touchline(&out, &arguments).stdout).unwrap();
        let repeat: u64 = seeds[&(planner.to_owned(), words.last().unwrap().clone())].parse().unwrap();
        let run = paths.iter().find(|p| p["planner"] == planner && p["repeat"] == repeat).unwrap();
        assert_eq!(again["path"], run["path"], "{command}");
        assert!(run["path"].as_array().unwrap().len() >= 2);
        replayed += 1;
    }
    assert_eq!(replayed, 4, "each planner's largest gap");
    std::fs::remove_dir_all(&root).unwrap();
}
