#!/usr/bin/env bash
# From recordings to the weights of the intention model, and to its figures beside all baselines. An hour to an hour and a half on two cores.
# usage: tools/intention.sh all|train|eval DATA
#   all    train, then eval
#   train  packs what DATA holds, labels it, trains boosted trees as teachers, the model, those that leave something out, and
#          the LSTM without CRF; calibrates all models on what those say that have not seen it
#   eval   scores everything beside the boosted trees: build/intention/eval.txt and eval.json
# DATA: a folder with the CommonRoad NGSIM files (*.xml) and the 100-Car study's release, unpacked (data/README.md).
# Weights go to models/intent. What was done before is not done again; remove build/intention to begin anew.
# The trees need the network at their first run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
what=${1:-}
data=${2:-}
case $what in all | train | eval) ;; *)
  echo "intention: error: want all, train or eval, got ${what:-nothing}" >&2
  exit 2
  ;;
esac
[ -d "$data" ] || {
  echo "intention: error: want a folder with recordings, got ${data:-nothing}" >&2
  exit 3
}
tools/setup.sh train

work=build/intention
saca=build/release/saca
train=build/release/saca-train
mkdir -p "$work/plain" "$work/models" models/intent
cmake --preset release -DSACA_TRAIN=ON >/dev/null
cmake --build --preset release --target saca_program saca-train -- --quiet

made() {  # FILE COMMAND...: unless it is there; COMMAND makes it
  local file=$1
  shift
  [ -e "$file" ] || "$@"
}

made "$work/commonroad.h5" "$saca" traffic pack commonroad "$data" -o "$work/commonroad.h5"
made "$work/100car.h5" "$saca" traffic pack 100car "$data" -o "$work/100car.h5"
made "$work/sequences.h5" "$saca" intent examples "$work/commonroad.h5" "$work/100car.h5" \
  --simulated 1000 -o "$work/sequences.h5"
made "$work/trees.h5" tools/intention_trees/run.sh cross "$work/sequences.h5" "$work/trees.h5"

if [ "$what" != eval ]; then
  teach() {
    tools/intention_trees/run.sh teachers "$work/sequences.h5" "$work/teachers" --site us101 --site lankershim
    touch "$work/teachers/made"
  }
  made "$work/teachers/made" teach
  train_one() {  # FILE OPTION...
    [ -e "$1" ] || "$train" "$work/sequences.h5" --output "$@" >> "$1.log" 2>&1
  }
  calibrate() {
    "$train" "$work/sequences.h5" --calibrate "$work/models"
    touch "$work/models/calibrated"
  }
  export -f train_one
  export train work
  {
    echo "$work/models/model.safetensors --teachers $work/trees.h5"
    for k in 0 1 2 3 4; do
      of_part="--leave-out part-$k --teachers $work/teachers/without_part_$k.h5"
      echo "$work/models/without_part_$k.safetensors $of_part"
      echo "$work/plain/without_part_$k.safetensors $of_part --without-chain"
    done
    for site in us101 lankershim; do
      echo "$work/models/without_$site.safetensors --leave-out $site --teachers $work/teachers/without_$site.h5"
    done
  } | xargs -P 2 -L 1 bash -c 'train_one "$@"' train_one  # two at a time, one core each
  made "$work/models/calibrated" calibrate
  cp "$work"/models/*.safetensors "$work"/models/*.curve.csv models/intent/
fi

if [ "$what" != train ]; then
  evaluate() {
    "$saca" intent eval "$work/sequences.h5" --models models/intent --plain-models "$work/plain" \
      --forecasts "$work/trees.h5" "$@"
  }
  evaluate | tee "$work/eval.txt"
  evaluate --json > "$work/eval.json"
fi
