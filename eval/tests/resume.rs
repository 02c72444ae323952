//! Campaigns that are interrupted: killed, out of disk, in places that cannot be written to.

mod common;

use std::fs;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use common::{COMPARISON, Place, furnished, text, timeless};
use rusqlite::{Connection, OpenFlags};

/// Long enough that it cannot end while the test waits for a few of its runs.
const LONG: &str = "name = \"long\"\nrepeats = 150\nscenes = [\"one.toml\", \"two.toml\"]\n
[planner.straight-line]\n[planner.pso]\niterations = 600\n[planner.tangent]\n[planner.wide]\nkind = \"pso\"
iterations = 240\nparticles = 40\n";

/// Numbers from a fixed beginning (Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        planner_api::seed::splitmix64(&mut self.0) % n
    }
}

fn start(place: &Place, args: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_touchline"));
    command.args(args).current_dir(&place.0).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// SIGKILL on Unix.
fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

fn database(place: &Place, out: &str) -> Option<Connection> {
    let file = place.0.join(out).join("runs.db");
    // Not to be created by the one who looks.
    Connection::open_with_flags(file, OpenFlags::SQLITE_OPEN_READ_WRITE).ok()
}

/// Runs that are there, 0 while the tables are not.
fn rows(place: &Place, out: &str) -> u32 {
    let count = database(place, out).and_then(|db| db.query_row("SELECT count(*) FROM run", [], |row| row.get(0)).ok());
    count.unwrap_or(0)
}

/// Waits until `out` has `least` runs; whether it came to that before the process ended.
fn wait_for(place: &Place, out: &str, least: u32, child: &mut Child) -> bool {
    let began = Instant::now();
    while rows(place, out) < least {
        assert!(began.elapsed() < Duration::from_secs(60), "no progress");
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    true
}

/// `SQLite`'s own word that the database is whole.
fn integrity(place: &Place, out: &str) {
    if let Some(db) = database(place, out) {
        let word: String = db.query_row("PRAGMA integrity_check", [], |row| row.get(0)).unwrap();
        assert_eq!(word, "ok");
    }
}

fn same_results(place: &Place, a: &str, b: &str) {
    let read = |folder: &str, file: &str| place.read(&format!("{folder}/{file}"));
    assert_eq!(timeless(&read(a, "runs.csv")), timeless(&read(b, "runs.csv")));
    for file in ["paths.jsonl", "comparison.toml", "scenes/one.toml"] {
        assert_eq!(read(a, file), read(b, file), "{file}");
    }
}

fn long(name: &str) -> Place {
    let place = furnished(name);
    place.write("long.toml", LONG);
    place.write("two.toml", &common::SCENE.replace("\"one\"", "\"two\"").replace("[5.0, 0.5]", "[4.0, -0.5]"));
    place
}

#[test]
fn twenty_kills_change_nothing() {
    let place = long("kills");
    place.ok(&["run", "long.toml", "--out", "whole", "--jobs", "2", "--isolate", "--quiet"]);
    let planned = rows(&place, "whole");
    assert_eq!(planned, 1200);

    let mut random = Random(20);
    let mut before = 0;
    for number in 0..20 {
        let mut child =
            start(&place, &["run", "long.toml", "--out", "out", "--jobs", "2", "--isolate", "--resume", "--quiet"]);
        // It has begun to plan, and has far more to do than it can do in the time that it is left.
        assert!(
            wait_for(&place, "out", before + 1 + random.below(8) as u32, &mut child),
            "kill {number} came too late"
        );
        std::thread::sleep(Duration::from_micros(random.below(20_000)));
        kill(child);
        integrity(&place, "out");
        let now = rows(&place, "out");
        assert!(before < now && now < planned, "kill {number}: {now} runs after {before}: none was in flight");
        before = now;
    }
    let status: serde_json::Value = serde_json::from_str(&place.ok(&["status", "out", "--json"])).unwrap();
    assert_eq!((&status["done"], &status["planned"]), (&before.into(), &planned.into()));
    assert_eq!((&status["running"], &status["resumed"]), (&false.into(), &19.into()));

    // Without the comparison: it is in the folder.
    let printed = place.ok(&["run", "--out", "out", "--resume", "--jobs", "2", "--isolate"]);
    assert!(printed.contains(&format!("Going on: {before} runs are there, {} are to be made.", planned - before)));
    same_results(&place, "whole", "out");
    let manifest: serde_json::Value = serde_json::from_str(&place.read("out/manifest.json")).unwrap();
    assert_eq!((&manifest["resumed"], &manifest["jobs"]), (&20.into(), &2.into()));
    let sessions = manifest["sessions"].as_array().unwrap();
    assert_eq!(sessions.len(), 21);
    assert!(sessions[..20].iter().all(|s| s["finished"] == "") && sessions[20]["finished"] != "");
}

/// Kills that hit the first moments of a campaign, and its last ones: pictures, the final mark, exports.
#[test]
fn kills_at_the_beginning_and_at_the_end_change_nothing() {
    let place = furnished("edges");
    place.ok(&["run", "small.toml", "--out", "whole", "--quiet"]);
    let mut random = Random(3);
    for number in 0..12 {
        let out = format!("out-{number}");
        let args = ["run", "small.toml", "--out", &out, "--resume", "--quiet"];
        let mut child = start(&place, &args);
        if number % 2 == 1 {
            wait_for(&place, &out, 9, &mut child);
        }
        std::thread::sleep(Duration::from_micros(random.below(30_000)));
        kill(child);
        integrity(&place, &out);
        place.ok(&args);
        same_results(&place, "whole", &out);
        assert!(place.read(&format!("{out}/report.html")).ends_with("</html>"));
        let db = database(&place, &out).unwrap();
        let pictures: u32 = db.query_row("SELECT count(*) FROM snapshot", [], |row| row.get(0)).unwrap();
        assert_eq!(pictures, 2, "the swarm and the tree, once each");
    }
    let left: Vec<String> = place.files().into_iter().filter(|f| f.ends_with(".lock") || f.contains(".part")).collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn what_is_there_decides_what_resuming_means() {
    let place = furnished("resume");
    // Nothing: it begins, by default in the usual folder.
    place.ok(&["run", "small.toml", "--resume", "--quiet"]);
    let runs = place.read("results/small/runs.csv");
    // Complete: nothing is run, exports are made again if they are missing, and only then.
    assert!(place.ok(&["run", "small.toml", "--resume"]).contains("Nothing is missing: it was finished at 20"));
    assert_eq!(place.read("results/small/runs.csv"), runs, "times and all");
    fs::remove_file(place.0.join("results/small/report.html")).unwrap();
    place.ok(&["run", "--out", "results/small", "--resume", "--quiet"]);
    assert!(place.read("results/small/report.html").ends_with("</html>"));
    let code = |args: &[&str]| place.run(args).status.code();
    assert_eq!(code(&["run", "small.toml", "--resume", "--quiet", "--fail-on", "invalid"]), Some(1));

    // Another campaign: refused with what differs.
    let seed = ["run", "small.toml", "--out", "results/small", "--resume", "--seed", "2", "--repeats", "4"];
    place.refused(&seed, "results/small: holds another campaign, \"small\" of 20");
    place.refused(&seed, "asked for was: seed 2 instead of 1; repeats 4 instead of 3");
    let some = ["run", "--out", "results/small", "--resume", "--planner", "pso"];
    place.refused(&some, "asked for was: no planners straight-line, tangent");
    place.write("other.toml", &COMPARISON.replace("iterations = 20", "iterations = 21"));
    let other = ["run", "other.toml", "--out", "results/small", "--resume"];
    place.refused(&other, "planner pso with iterations = 21 instead of 20");
    let shard = ["run", "small.toml", "--out", "results/small", "--resume", "--shard", "1/2"];
    place.refused(&shard, "holds part 1/1 of the campaign; asked for was part 1/2");

    // Not a campaign: left alone. A start that was killed at once: begun afresh.
    place
        .refused(&["run", "small.toml", "--out", ".", "--resume"], "holds other files; expected a new or empty folder");
    place.refused(&["run", "--out", "never", "--resume"], "nothing to go on with in never; name the comparison");
    fs::create_dir(place.0.join("never")).unwrap();
    place.refused(&["run", "--out", "never", "--resume"], "nothing to go on with in never; name the comparison");
    place.write("never/runs.db", "");
    place.write("never/runs.lock", "");
    place.refused(&["status", "never"], "name the comparison: touchline run COMPARISON --resume --out never");
    place.refused(&["run", "small.toml", "--out", "never"], "or --resume and the comparison's file");
    place.refused(&["run", "--out", "never", "--resume"], "nothing to go on with in never; name the comparison");
    place.ok(&["run", "small.toml", "--out", "never", "--resume", "--quiet"]);
    assert_eq!(timeless(&place.read("never/runs.csv")), timeless(&runs));
}

#[test]
fn one_process_at_a_time() {
    let place = long("two-processes");
    let args = ["run", "long.toml", "--out", "out", "--resume", "--quiet"];
    let mut first = start(&place, &args);
    assert!(wait_for(&place, "out", 5, &mut first));
    let second = place.run(&args);
    assert_eq!(second.status.code(), Some(2));
    let message = text(&second.stderr);
    assert!(message.contains("out: another process is working on this campaign"), "{message}");
    // Looking is free.
    let status = place.ok(&["status", "out"]);
    assert!(status.contains("; running\n") && status.contains(" runs a second: about "), "{status}");
    assert!(status.contains("of 1200 runs are there, "), "{status}");
    kill(first);
    let status = place.ok(&["status", "out"]);
    assert!(status.contains("; interrupted: go on with --resume"), "{status}");
    place.refused(&["run", "long.toml", "--out", "out"], "or --resume to go on with it");
    // A dry run says what is there, and locks nothing.
    let dry = place.ok(&["run", "--out", "out", "--resume", "--dry-run", "--isolate", "--jobs", "2"]);
    assert!(dry.contains("Going on: ") && dry.contains("Time: at most about ") && dry.contains("Would write to out;"));
    assert!(dry.contains("planner wide (kind pso; no budget, ended after 1 min 0 s)"), "{dry}");
    assert!(dry.contains("scene two (1 obstacles; test set)"), "{dry}");
    let dry = place.ok(&["run", "--out", "out", "--resume", "--dry-run"]);
    let unbounded = "no limit is known for straight-line, pso, tangent, wide: their time has no bound without";
    assert!(dry.contains(unbounded), "{dry}");
}

/// A file system of 192 KiB where the system allows it, else files of at most as much.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_loses_nothing() {
    let place = long("full");
    let touchline = env!("CARGO_BIN_EXE_touchline");
    let shell = |script: String| {
        let output = Command::new("sh").args(["-c", &script]).current_dir(&place.0).output().unwrap();
        (output.status.code(), text(&output.stderr))
    };
    // A limit on the size of files, met with an error instead of the signal.
    let limited =
        format!("trap '' XFSZ; ulimit -f 256; exec {touchline} run long.toml --repeats 30 --out limited --quiet");
    let (code, error) = shell(limited);
    assert_eq!(code, Some(2), "{error}");
    let kept = rows(&place, "limited");
    assert!(error.contains(&format!("{kept} of 240 runs are kept in limited; ")) && kept > 0, "{error}");
    assert!(error.contains("limited/runs.db: ") && error.contains("touchline run --out limited --resume"), "{error}");
    integrity(&place, "limited");
    place.ok(&["run", "--out", "limited", "--resume", "--quiet"]);
    place.ok(&["run", "long.toml", "--repeats", "30", "--out", "whole", "--quiet"]);
    same_results(&place, "whole", "limited");

    // A disk of which nothing is left; mounted for the shell alone.
    fs::create_dir(place.0.join("disk")).unwrap();
    let mount = "mount -t tmpfs -o size=192k none disk";
    if shell(format!("unshare -rm sh -c '{mount}'")).0 != Some(0) {
        eprintln!("skipped: a really full disk, which needs the right to mount one");
        return;
    }
    let run =
        format!("{touchline} run long.toml --repeats 30 --out disk/out --quiet; echo $? >code; cp -r disk/out kept");
    let (_, error) = shell(format!("unshare -rm sh -c '{mount}; {run}'"));
    assert_eq!(place.read("code").trim(), "2", "{error}");
    assert!(
        error.contains("database or disk is full") && error.contains("free some space, then go on with:"),
        "{error}"
    );
    integrity(&place, "kept");
    assert!(rows(&place, "kept") > 0);
    place.ok(&["run", "--out", "kept", "--resume", "--quiet"]);
    same_results(&place, "whole", "kept");
}

/// Exports are made from what is safe already.
#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_is_full_for_exports_keeps_the_runs() {
    let place = furnished("exports");
    place.ok(&["run", "small.toml", "--out", "whole", "--quiet"]);
    // Writing to this device fails as on a full disk.
    fs::create_dir(place.0.join("out")).unwrap();
    place.ok(&["run", "small.toml", "--out", "out", "--quiet"]);
    fs::remove_file(place.0.join("out/report.html")).unwrap();
    std::os::unix::fs::symlink("/dev/full", place.0.join("out/report.html.part")).unwrap();
    let output = place.run(&["run", "--out", "out", "--resume", "--quiet"]);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("cannot write out/report.html: No space left on device"), "{error}");
    let advice = "all 9 runs are kept in out; free some space, then make the exports with: touchline report out";
    assert!(error.contains(advice), "{error}");
    assert!(!place.0.join("out/report.html").exists(), "half a report is none");
    place.ok(&["report", "out"]);
    assert!(place.read("out/report.html").ends_with("</html>"));
    same_results(&place, "whole", "out");
}

#[cfg(target_os = "linux")]
#[test]
fn a_place_that_cannot_be_written_to_is_named() {
    let place = furnished("read-only");
    // Nobody creates folders here, whatever his rights.
    let output = place.run(&["run", "small.toml", "--out", "/proc/touchline", "--quiet"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("cannot create /proc/touchline: "), "{}", text(&output.stderr));

    place.ok(&["run", "small.toml", "--out", "out", "--quiet"]);
    let touchline = env!("CARGO_BIN_EXE_touchline");
    let bind = "mount --bind out out && mount -o remount,ro,bind out";
    let shell = |script: &str| {
        let script = format!("unshare -rm sh -c '{bind} && {script}'");
        Command::new("sh").args(["-c", &script]).current_dir(&place.0).output().unwrap()
    };
    if !shell("true").status.success() {
        eprintln!("skipped: a read-only folder, which needs the right to mount one");
        return;
    }
    let complete = shell(&format!("{touchline} run --out out --resume"));
    assert!(text(&complete.stdout).contains("Nothing is missing"), "{}", text(&complete.stderr));
    fs::remove_file(place.0.join("out/runs.csv")).unwrap();
    let refused = shell(&format!("{touchline} run --out out --resume --quiet"));
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("cannot write out/runs.csv: "), "{}", text(&refused.stderr));
    let refused = shell(&format!("{touchline} report out"));
    assert!(text(&refused.stderr).contains("cannot write out/"), "{}", text(&refused.stderr));
    let status = shell(&format!("{touchline} status out"));
    assert!(text(&status.stdout).contains("9 of 9 runs are there, 0 missing"), "{}", text(&status.stderr));

    // A copy of a campaign whose last runs are in the log alone, as a kill leaves it.
    let db = database(&place, "out").unwrap();
    db.execute("UPDATE campaign SET name = name", []).unwrap();
    fs::copy(place.0.join("out/runs.db-wal"), place.0.join("wal")).unwrap();
    drop(db);
    fs::rename(place.0.join("wal"), place.0.join("out/runs.db-wal")).unwrap();
    let status = shell(&format!("{touchline} status out"));
    assert_eq!(status.status.code(), Some(2));
    let error = text(&status.stderr);
    assert!(error.contains("its last runs are still in runs.db-wal, which can only be read where"), "{error}");
}

/// What external planners of a campaign from elsewhere would do is no result.
#[test]
fn external_planners_without_their_folder_are_not_run() {
    let place = furnished("elsewhere");
    fs::create_dir(place.0.join("first")).unwrap();
    let planner =
        "repeats = 2\nscenes = [\"../one.toml\"]\n[planner.mine]\nkind = \"external\"\ncommand = [\"false\"]\n";
    place.write("first/e.toml", &format!("name = \"e\"\n{planner}"));
    place.ok(&["run", "first/e.toml", "--shard", "1/2", "--out", "one half", "--quiet"]);
    let resolved = place.read("one half/comparison.toml");
    assert!(resolved.contains(&format!("folder = \"{}\"", place.0.join("first").display())), "{resolved}");
    let printed = place.ok(&["merge", "one half", "--out", "all of it"]);
    assert!(printed.contains("touchline run --out 'all of it' --resume"), "{printed}");
    fs::rename(place.0.join("first"), place.0.join("second")).unwrap();
    let resume = ["run", "--out", "all of it", "--resume", "--quiet"];
    place.refused(&resume, &format!("planner mine: no folder {}, in which", place.0.join("first").display()));
    place.refused(&resume, "name the comparison");
    place.ok(&["run", "one half/comparison.toml", "--out", "one half", "--resume", "--quiet"]);
    place.ok(&["run", "second/e.toml", "--out", "all of it", "--resume", "--quiet"]);
    assert_eq!(place.read("all of it/runs.csv").lines().count(), 3);
    // Complete: nobody needs the folder.
    place.ok(&resume);
}
