#!/usr/bin/env bash
# From the shipped cases to the weights of the baseline "imitation": a minute on one core.
# usage: tools/imitator.sh
# An epoch that was done is not done again: the same command goes on where it was stopped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
tools/setup.sh train
cmake --preset release -DSACA_TRAIN=ON >/dev/null
cmake --build --preset release --target saca-train-imitator -- --quiet
mkdir -p models/imitator
build/release/saca-train-imitator data/memory/seed.jsonl.gz --output models/imitator/compact_rwd_ev.safetensors
