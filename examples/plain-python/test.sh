#!/usr/bin/env bash
# Tests the planner in plain Python and the template, alone and in Touchline's
# bench. Needs Python 3.11. TOUCHLINE: the executable; by default the release build.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
touchline=$(realpath "${TOUCHLINE:-$here/../../target/release/touchline}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

(cd "$here" && python3 -B -m unittest --quiet)
for run in first second; do
    "$touchline" run "$here/comparison.toml" --planner plain-python,plain-python-40 --quiet --fail-on invalid \
        --out "$work/$run"
done
python3 "$here/../same_runs.py" "$work/first" "$work/second"
# Its detour is free in the first scene, and through a defender in some others.
"$touchline" run "$here/../template/comparison.toml" --quiet --fail-on error --out "$work/template"
grep -q '^trap,mine,0,[0-9]*,solved,true,' "$work/template/runs.csv"
echo "plain-python: every path valid, twice the same; the template runs"
