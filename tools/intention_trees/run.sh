#!/usr/bin/env bash
# Gradient-boosted trees (LightGBM) on windows of what is seen of a vehicle: the peer of the intention model, in a
# Python environment of its own (build/intention_trees).
# usage: tools/intention_trees/run.sh setup
#        tools/intention_trees/run.sh train SEQUENCES.h5 MODELS [--rounds N] [--json]
#        tools/intention_trees/run.sh predict SEQUENCES.h5 MODELS FORECASTS.h5 [--split WORD] [--json]
#        tools/intention_trees/run.sh cross SEQUENCES.h5 FORECASTS.h5 [--parts WORD] [--rounds N] [--json]
#        tools/intention_trees/run.sh teachers SEQUENCES.h5 FOLDER [--parts WORD] [--site NAME]... [--rounds N] [--json]
#   setup      makes the environment only
#   train      on the split `train`, stopped early on `tune`; writes one model for each head into the folder MODELS
#   predict   writes what they say of the split `test` (or WORD), to be scored by the program that scores all models
#   cross      writes what is said of each split whose name begins with `part-` (or WORD) by models that have not seen it:
#              they learn from the splits `train` and `simulated` and the other parts, but for one group in eight, which stop them
#   teachers   writes FOLDER/without_PART.h5 for each such split, and without_NAME.h5 for each site: of every other split, what
#              models say that have seen neither; so that who learns from them is judged fairly. Goes on where it was stopped
# SEQUENCES.h5: format saca.sequences/1; FORECASTS.h5: saca.forecasts/1 (docs/formats.md). Seeded, two threads.
# Needs the network at its first run, and tools/setup.sh. Versions and sha256: requirements.txt.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
case ${1:-} in setup | train | predict | cross | teachers) ;; *)
  echo "intention_trees: error: want setup, train, predict, cross or teachers, got ${1:-nothing}" >&2
  exit 2
  ;;
esac

venv=$here/../../build/intention_trees
stamp=$venv/ready-$(sha256sum "$here/requirements.txt" | cut -c1-16)
if [ ! -e "$stamp" ]; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check --no-deps --only-binary :all: \
    --require-hashes -r "$here/requirements.txt"
  touch "$stamp"
fi
[ "$1" = setup ] || PYTHONDONTWRITEBYTECODE=1 exec "$venv/bin/python" "$here/make.py" "$@"
