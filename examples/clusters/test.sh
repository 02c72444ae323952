#!/usr/bin/env bash
# Runs campaign.toml by `touchline run`, on a local Dask cluster and on a local Ray
# cluster of two workers each, and compares rows and paths. Needs Python 3.11 and
# the network (pip). TOUCHLINE: the executable; by default the release build.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
touchline=$(realpath "${TOUCHLINE:-$here/../../target/release/touchline}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# A Ray cluster or its settings elsewhere on this machine are none of ours.
unset RAY_ADDRESS

python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet 'dask[distributed]==2026.8.0' ray==2.60.0 || exit 77

"$touchline" run "$here/campaign.toml" --quiet --out "$work/bench"
"$work/venv/bin/python" "$here/with_dask.py" "$work/bench/comparison.toml" --out "$work/dask" --program "$touchline"
# Ray keeps a token in its user's folder.
HOME="$work" "$work/venv/bin/python" "$here/with_ray.py" "$work/bench/comparison.toml" --out "$work/ray" --program "$touchline"
for driver in dask ray; do
    "$work/venv/bin/python" "$here/../same_runs.py" "$work/bench" "$work/$driver"
done
"$work/venv/bin/python" "$here/test_worker.py" "$touchline"
