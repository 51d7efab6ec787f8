#!/usr/bin/env bash
# From cases to the weights of the baselines "imitation" and "imitation_drivers": a minute on one core each.
# usage: tools/imitator.sh [HUNDRED_CAR]
#   HUNDRED_CAR  folder of the 100-Car study's release (docs/formats.md): what its drivers did is gathered anew, four minutes; without it
#                data/imitation/drivers.jsonl.gz is taken as it is. Events that are shipped as scenarios are left out.
# An epoch that was done is not done again: the same command goes on where it was stopped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
tools/setup.sh train
cmake --preset release -DSACA_TRAIN=ON >/dev/null
cmake --build --preset release --target saca-train-imitator saca_program -- --quiet
if [ $# -gt 0 ]; then
  work=build/drivers
  mkdir -p "$work"
  build/release/saca cases build --hundred-car "$1" --draws 32 -o "$work/cases.jsonl" --drivers "$work/drivers.jsonl"
  python3 tools/shippable_cases.py "$work/drivers.jsonl" data/imitation/drivers.jsonl.gz
fi
mkdir -p models/imitator
train() { build/release/saca-train-imitator "data/$1.jsonl.gz" --output "models/imitator/$2.safetensors"; }
train memory/seed compact_rwd_ev
train imitation/drivers drivers
