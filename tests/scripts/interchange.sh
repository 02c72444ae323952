#!/usr/bin/env bash
# Other programs read what the bench writes: OMPL's own script its logs, jsonschema its document.
# Needs python3 with venv, and PyPI. TOUCHLINE names the program, default target/release/touchline.
set -euo pipefail
cd "$(dirname "$0")/../.."
touchline=$(realpath "${TOUCHLINE:-target/release/touchline}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check ompl==2.0.1 jsonschema==4.25.1 || exit 77
"$touchline" run tests/baseline/small.toml --out "$work/out" --quiet
"$touchline" report "$work/out" --format csv,json,ompl
"$work/venv/bin/ompl_benchmark_statistics" "$work"/out/ompl/*.log -d "$work/runs.db" > "$work/printed"
if grep -i "duplicate" "$work/printed"; then
    echo "OMPL's script dropped progress data" >&2
    exit 1
fi
"$work/venv/bin/python" tests/scripts/interchange.py "$work/out" "$work/runs.db"
