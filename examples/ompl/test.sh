#!/usr/bin/env bash
# Installs OMPL into an environment of its own and tests what drives it, alone and
# in Touchline's bench. Needs Python 3.11 and the network (pip). TOUCHLINE: the
# executable; by default the release build.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
touchline=$(realpath "${TOUCHLINE:-$here/../../target/release/touchline}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet -r "$here/requirements.txt" || exit 77
# The comparison says python3.
PATH="$work/venv/bin:$PATH"

(cd "$here" && python3 -B -m unittest --quiet)
for run in first second; do
    "$touchline" run "$here/comparison.toml" --planner ompl-rrt-connect,ompl-rrt-star,ompl-bit-star --quiet \
        --fail-on invalid --out "$work/$run"
done
python3 "$here/../same_runs.py" "$work/first" "$work/second"
echo "ompl: every path valid, twice the same"
