#!/usr/bin/env bash
# Prints every figure of docs/results.md and leaves them in build/figures.json.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

figures=build/figures
mkdir -p "$figures"
build/release/saca physics --json --drift-draws 400 >"$figures/physics.json"
build/release/saca bench --json >"$figures/saca.json"
build/release/saca model bench --runs "${RUNS:-20}" --json >"$figures/reason.json"
tools/start_time.py build/release/saca 100car_9018 >"$figures/start.json"
tools/merge_figures.py "$figures"/*.json >build/figures.json
cat build/figures.json
