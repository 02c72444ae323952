"""Checks that a driver's folder tells of the same runs as the bench's: `same_runs.py BENCH DRIVER`.

Rows are compared column by column as far as the driver has them, times apart;
paths number by number. Exits with 1 at any difference.
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
    bench, driver = map(Path, sys.argv[1:3])
    expected, found = rows(bench), rows(driver)
    wrong = [f"{key}: only in one of the two" for key in expected.keys() ^ found.keys()]
    for key in sorted(expected.keys() & found.keys()):
        a, b = expected[key], found[key]
        wrong += [f"{key}: {c} = {b[c]!r}; expected {a[c]!r}" for c in EXACT if a[c] != b[c]]
        if not same_length(a["length"], b["length"]):
            wrong.append(f"{key}: length = {b['length']}; expected {a['length']}")
    ways, ways_found = paths(bench), paths(driver)
    wrong += [f"{key}: another path" for key in sorted(ways.keys() | ways_found.keys()) if ways.get(key) != ways_found.get(key)]
    if wrong or not expected or not ways:
        sys.exit("\n".join(["not the same runs:", *wrong[:20]]))
    print(f"{driver}: {len(expected)} runs and {len(ways)} paths as in {bench}")


if __name__ == "__main__":
    main()
