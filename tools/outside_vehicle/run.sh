#!/usr/bin/env bash
# Runs the models of commonroad-vehicle-models, in a Python environment of its own (build/outside_vehicle).
# usage: tools/outside_vehicle/run.sh [reference|compare|all]
#   reference   writes saca/onboard/vehicle/testdata/outside_*.csv
#   compare     builds and runs our test, prints the tables of docs/outside-models.md, draws its picture
#   all         both (the default)
# Needs the network at its first run, and tools/setup.sh. Versions and sha256: requirements.txt.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$here/../.."
what=${1:-all}
case $what in reference | compare | all) ;; *)
  echo "outside: error: want reference, compare or all, got $what" >&2
  exit 2
  ;;
esac

venv=build/outside_vehicle
stamp=$venv/ready-$(sha256sum "$here/requirements.txt" | cut -c1-16)
if [ ! -e "$stamp" ]; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check --no-deps --require-hashes \
    -r "$here/requirements.txt"
  touch "$stamp"
fi
export PYTHONDONTWRITEBYTECODE=1

[ "$what" = compare ] || "$venv/bin/python" "$here/make.py" reference
if [ "$what" != reference ]; then
  traces=$venv/traces
  mkdir -p "$traces"
  cmake --preset release >/dev/null
  cmake --build --preset release --target vehicle_test -- --quiet
  SACA_OUTSIDE_TRACES=$traces build/release/modules/vehicle/vehicle_test --gtest_filter='Outside*' >"$venv/test.log" || {
    cat "$venv/test.log" >&2
    exit 1
  }
  "$venv/bin/python" "$here/make.py" compare "$traces"
  "$venv/bin/python" "$here/make.py" causes
fi
