#!/usr/bin/env bash
# From nothing to the weights of V_h and Q_h: transitions, Q of them alone, V of what driving by that Q comes to, a better Q, V of what
# driving by that one comes to, margins, figures; two hours on two cores, 6 GB.
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
  work=build/danger_quick/$car output=$work/output/$car.safetensors
  transitions=40000 outcomes=8000 first_steps=60 steps=60 pair_steps=50 batch=256 situations=400 checked=40
  parts=(--part-drives 50 --no-tables)
else
  work=build/danger/$car output=models/danger/$car.safetensors
  transitions=31000000 outcomes=5300000 first_steps=12000 steps=10000 pair_steps=8000 batch=4096 situations=2000000 checked=20000
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

# What driving by WEIGHTS comes to, and V of it.
evaluate() {  # WEIGHTS OUTPUT
  local folder=${2%.safetensors}_drives
  "$saca" danger dataset "$folder" --car "$car" --by "$1" --outcomes --no-tables --transitions "$outcomes" --part-drives 5000 --seed 3
  train "$folder" "$2" --values-of "$1" --steps "$steps" --pair-steps "$pair_steps"
}

"$saca" danger dataset "$work/drives" --car "$car" --transitions "$transitions" --seed 1 "${parts[@]}"
train "$work/drives" "$work/q1.safetensors" --steps "$first_steps" --pair-steps 0 --expectile 0.98
evaluate "$work/q1.safetensors" "$work/v1.safetensors"
train "$work/drives" "$work/q2.safetensors" --q-of "$work/v1.safetensors" --steps "$first_steps"
evaluate "$work/q2.safetensors" "$work/v2.safetensors"
[ -e "$work/shipped.safetensors" ] || "$saca" danger margins "$work/v2.safetensors" --output "$work/shipped.safetensors" --situations "$situations"
cp "$work/shipped.safetensors" "$output"
cp "$work/v2.safetensors.curve.csv" "$output.curve.csv"
"$saca" danger check "$output" --situations "$checked"
