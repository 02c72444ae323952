"""Checks that two folders tell of the same runs: `same_runs.py BENCH OTHER`.

BENCH is that of `touchline run`, OTHER another one or that of a driver for clusters.
What both have of a row is compared, times apart, and
every number of the paths. Exits with 1 at any difference.
"""

import csv
import json
import math
import sys
from pathlib import Path

EXACT = ("seed", "status", "iterations", "evaluations", "collision_checks", "error")
# The bench adds up a path's length in its own order, with its own root.
ROUNDING = 1e-12


def rows(folder: Path) -> dict[tuple[str, ...], dict[str, str]]:
    """The rows of `runs.csv` by scene, planner and repeat."""
    with (folder / "runs.csv").open(newline="", encoding="utf-8") as file:
        return {(r["scene"], r["planner"], r["repeat"]): r for r in csv.DictReader(file)}


def paths(folder: Path) -> dict[tuple[str, ...], list[list[float]]]:
    """The paths of `paths.jsonl` by scene, planner and repeat."""
    lines = (folder / "paths.jsonl").read_text(encoding="utf-8").splitlines()
    return {(p["scene"], p["planner"], str(p["repeat"])): p["path"] for p in map(json.loads, lines)}


def same_length(a: str, b: str) -> bool:
    """Whether two lengths agree up to rounding; empty is that of no path."""
    return a == b or bool(a and b and math.isclose(float(a), float(b), rel_tol=ROUNDING))


def main() -> None:
    """The command."""
    bench, other = map(Path, sys.argv[1:3])
    expected, found = rows(bench), rows(other)
    wrong = [f"{key}: only in one of the two" for key in expected.keys() ^ found.keys()]
    for key in sorted(expected.keys() & found.keys()):
        a, b = expected[key], found[key]
        wrong += [f"{key}: {c} = {b[c]!r}; expected {a[c]!r}" for c in EXACT if a[c] != b[c]]
        if not same_length(a["length"], b["length"]):
            wrong.append(f"{key}: length = {b['length']}; expected {a['length']}")
    ways, other_ways = paths(bench), paths(other)
    keys = sorted(ways.keys() | other_ways.keys())
    wrong += [f"{key}: another path" for key in keys if ways.get(key) != other_ways.get(key)]
    if wrong or not expected or not ways:
        sys.exit("\n".join(["not the same runs:", *wrong[:20]]))
    print(f"{other}: {len(expected)} runs and {len(ways)} paths as in {bench}")


if __name__ == "__main__":
    main()
