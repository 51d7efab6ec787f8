#!/usr/bin/env bash
# From recordings and encounters to the weights of the learnt baseline of `saca forecast eval`: 25 minutes on one core.
# usage: tools/places.sh DATA
# DATA: a folder with the CommonRoad NGSIM files (*.xml; data/README.md).
# Trains models/places/model.safetensors and those that have not seen one site. An epoch that was done is not done again: the same command
# goes on where it was stopped; remove build/places to begin anew.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
data=${1:-}
[ -d "$data" ] || {
  echo "places: error: want a folder with recordings, got ${data:-nothing}" >&2
  exit 3
}
tools/setup.sh train

work=build/places
mkdir -p "$work" models/places
cmake --preset release -DSACA_TRAIN=ON >/dev/null
cmake --build --preset release --target saca-train-places -- --quiet

train_one() {  # NAME OPTION...
  local file=$work/$1.safetensors
  [ -e "$file" ] || build/release/saca-train-places --output "$file" --data "$data" "${@:2}" | tee -a "$file.log"
}
train_one model
for site in us101 lankershim; do
  train_one "without_$site" --leave-out "$site"
done
cp "$work"/*.safetensors "$work"/*.curve.csv models/places/
