"""A comparison as a list of jobs, and their answers as tables: what the drivers for Dask and Ray share.

Reads the resolved comparison that `touchline run` leaves in its folder
(`comparison.toml` and `scenes/`): scene files instead of generators, sweeps
and budgets spelled out. Standard library only; Python 3.11 or newer.
"""

import argparse
import csv
import json
import math
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

MASK = 2**64 - 1
RESERVED = ("kind", "variant", "budget", "hard_limit_ms", "memory_mb")
COUNTS = ("iterations", "evaluations", "collision_checks", "time_us", "cpu_us")
COLUMNS = ("scene", "planner", "repeat", "seed", "status", "length", *COUNTS, "error")


@dataclass(frozen=True)
class Job:
    """One run: its row's key, what `touchline worker` is asked, and how long it is waited for."""

    scene: str
    planner: str
    repeat: int
    request: dict[str, Any]
    timeout: float


@dataclass(frozen=True)
class Result:
    """A job's row for the table, and the path that was returned."""

    row: dict[str, Any]
    path: list[list[float]]


def splitmix(state: int) -> int:
    """The first output of SplitMix64 from `state` (Steele, Lea & Flood 2014)."""
    z = (state + 0x9E3779B97F4A7C15) & MASK
    z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
    return z ^ (z >> 31)


def run_seed(comparison: int, scene: str, repeat: int) -> int:
    """The seed that `touchline run` gives this run, as its manifest.json states the formula; < 2^53."""
    name = 0xCBF29CE484222325  # FNV-1a, 64 bits
    for byte in scene.encode():
        name = ((name ^ byte) * 0x100000001B3) & MASK
    return splitmix(splitmix(splitmix(comparison) ^ name) ^ repeat) >> 11


def jobs(comparison: Path) -> list[Job]:
    """Every run of the resolved comparison, scene by scene."""
    table = tomllib.loads(comparison.read_text(encoding="utf-8"))
    files = [*table["scenes"], *table.get("tuning", [])]
    if "budget" in table or not all(isinstance(file, str) for file in files):
        raise SystemExit(
            f"{comparison} is as written by hand; expected the one that `touchline run` left in its folder"
        )
    scenes = [tomllib.loads((comparison.parent / file).read_text(encoding="utf-8")) for file in files]
    made = []
    for scene in scenes:
        for repeat in range(table["repeats"]):
            seed = run_seed(table["seed"], scene["name"], repeat)
            for label, planner in table["planner"].items():
                made.append(Job(scene["name"], label, repeat, request(planner, scene, seed), hard_limit(planner)))
    return made


def request(planner: dict[str, Any], scene: dict[str, Any], seed: int) -> dict[str, Any]:
    """What `touchline worker` is asked for one run of the planner with this table."""
    if planner["kind"] == "external":
        raise SystemExit(f"{planner['command']} is external, which `touchline worker` does not run")
    settings = {key: value for key, value in planner.items() if key not in RESERVED}
    return {
        "kind": planner["kind"],
        "scene": scene,
        "settings": settings,
        "seed": seed,
        "budget": planner.get("budget", {}),
    }


def hard_limit(planner: dict[str, Any]) -> float:
    """Seconds to wait for an answer: the bench's rule is twice the time budget plus 1 s, or 60 s."""
    time_ms = planner.get("budget", {}).get("time_ms")
    return planner.get("hard_limit_ms", 60000 if time_ms is None else 2 * time_ms + 1000) / 1e3


def result(job: Job, answer: dict[str, Any]) -> Result:
    """The job's row; the length is that of the path returned, which nobody has checked."""
    path = answer.get("path", [])
    row = {
        "scene": job.scene,
        "planner": job.planner,
        "repeat": job.repeat,
        "seed": job.request["seed"],
        "status": answer.get("status", "error"),
        "length": sum(math.dist(a, b) for a, b in pairwise(path)) if path else "",
        "error": answer.get("error", ""),
        **{column: answer.get(column, "") for column in COUNTS},
    }
    return Result(row, path)


def write(results: Iterable[Result], out: Path) -> None:
    """`runs.csv` and `paths.jsonl` in the folder `out`, sorted by scene, planner and repeat."""
    ordered = sorted(results, key=lambda r: (r.row["scene"], r.row["planner"], r.row["repeat"]))
    out.mkdir(parents=True, exist_ok=True)
    with (out / "runs.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        table.writerows(r.row for r in ordered)
    with (out / "paths.jsonl").open("w", encoding="utf-8") as file:
        for r in ordered:
            key = {name: r.row[name] for name in ("scene", "planner", "repeat")}
            file.write(json.dumps({**key, "path": r.path}) + "\n")


def arguments(description: str) -> argparse.Namespace:
    """The command line that both drivers have."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("comparison", type=Path, help="comparison.toml, resolved")
    parser.add_argument("--out", type=Path, required=True, help="folder for runs.csv and paths.jsonl")
    parser.add_argument("--program", default="touchline", help="the touchline executable on every machine")
    parser.add_argument("--workers", type=int, default=2, help="processes, where a local cluster is started")
    parser.add_argument("--address", help="scheduler of a cluster that runs already")
    return parser.parse_args()
