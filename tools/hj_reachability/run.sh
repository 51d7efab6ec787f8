#!/usr/bin/env bash
# Solves Mitchell's game air3D with hj_reachability (JAX), in a Python environment of its own (build/hj_reachability).
# usage: tools/hj_reachability/run.sh setup|reference|time
#   setup       makes the environment only
#   reference   writes data/reference/air3d_hj_reachability.json (6 minutes on two cores)
#   time        times it beside build/release/saca bench air3d, in floats and doubles; prints JSON
# Needs the network at its first run, and tools/setup.sh. Versions and sha256: requirements.txt.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
what=${1:-}
case $what in setup | reference | time) ;; *)
  echo "hj_reachability: error: want setup, reference or time, got ${what:-nothing}" >&2
  exit 2
  ;;
esac

venv=$here/../../build/hj_reachability
stamp=$venv/ready-$(sha256sum "$here/requirements.txt" | cut -c1-16)
if [ ! -e "$stamp" ]; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check --no-deps --only-binary :all: \
    --require-hashes -r "$here/requirements.txt"
  touch "$stamp"
fi
[ "$what" = setup ] || PYTHONDONTWRITEBYTECODE=1 exec "$venv/bin/python" "$here/make.py" "$what"
