#!/usr/bin/env bash
# From nothing to the weights of V_h and Q_h: transitions, training, what driving by it comes to, V of that, margins, figures; 1.5 h on two
# cores, 5 GB.
# usage: tools/danger.sh [CAR]
# CAR: a shipped car's name (default: compact_rwd_ev). Makes models/danger/CAR.safetensors and prints the figures of `saca danger check`.
# What is done is not done again: the same command goes on where it was stopped; remove build/danger to begin anew.
# SACA_DANGER_QUICK=1 makes all of it a thousand times smaller, in build/danger_quick, to see that it runs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
car=${1:-compact_rwd_ev}
[ -e "data/vehicles/$car.toml" ] || {
  echo "danger: error: want the name of a car in data/vehicles, got $car" >&2
  exit 3
}
if [ -n "${SACA_DANGER_QUICK:-}" ]; then
  work=build/danger_quick/$car output=$work/shipped.safetensors
  transitions=40000 outcomes=8000 first_steps=60 steps=60 pair_steps=50 batch=256 situations=400 checked=40
  parts=(--part-drives 50 --no-tables)
else
  work=build/danger/$car output=models/danger/$car.safetensors
  transitions=31000000 outcomes=5300000 first_steps=12000 steps=10000 pair_steps=8000 batch=4096 situations=400000 checked=20000
  parts=()
fi
tools/setup.sh train
mkdir -p "$work" "$(dirname "$output")"
cmake --preset release -DSACA_TRAIN=ON >/dev/null
cmake --build --preset release --target saca-train-danger saca_program -- --quiet
saca=build/release/saca
train() {  # FOLDER OUTPUT OPTION...
  [ -e "$2" ] || build/release/saca-train-danger "$1" --output "$2" --batch "$batch" "${@:3}"
}

"$saca" danger dataset "$work/drives" --car "$car" --transitions "$transitions" --seed 1 "${parts[@]}"
train "$work/drives" "$work/first.safetensors" --steps "$first_steps" --pair-steps 0 --expectile 0.98
"$saca" danger dataset "$work/outcomes" --car "$car" --by "$work/first.safetensors" --outcomes --no-tables \
  --transitions "$outcomes" --part-drives 5000 --seed 3
train "$work/outcomes" "$work/second.safetensors" --values-of "$work/first.safetensors" --steps "$steps" --pair-steps "$pair_steps"
[ -e "$output" ] || "$saca" danger margins "$work/second.safetensors" --output "$output" --situations "$situations"
cp "$work/second.safetensors.curve.csv" "$output.curve.csv"
"$saca" danger check "$output" --situations "$checked"
