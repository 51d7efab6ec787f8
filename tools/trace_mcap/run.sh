#!/usr/bin/env bash
# Turns a trace into an MCAP file for Foxglove Studio, in a Python environment of its own
# (build/trace_mcap).
# usage: tools/trace_mcap/run.sh TRACE.jsonl OUT.mcap
#        tools/trace_mcap/run.sh setup       makes the environment only
# Needs the network at its first run, and tools/setup.sh. Versions and sha256: requirements.txt.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if [ $# -ne 2 ] && [ "${1:-}" != setup ]; then
  echo "trace_mcap: error: want TRACE.jsonl OUT.mcap, or setup" >&2
  exit 2
fi

venv=$here/../../build/trace_mcap
stamp=$venv/ready-$(sha256sum "$here/requirements.txt" | cut -c1-16)
if [ ! -e "$stamp" ]; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check --no-deps --require-hashes \
    -r "$here/requirements.txt"
  touch "$stamp"
fi
[ "$1" = setup ] || PYTHONDONTWRITEBYTECODE=1 exec "$venv/bin/python" "$here/make.py" "$@"
