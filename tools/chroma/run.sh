#!/usr/bin/env bash
# The memory bank beside Chroma, the vector database in which DiLu keeps its experience (Wen et al. 2024, ICLR): how long
# one question for the 50 most alike takes in each, on the same cases, in one run. In a Python environment of its own
# (build/chroma).
# usage: tools/chroma/run.sh CASES.jsonl[.gz] [--count N] [--questions N] [--seed N] [--json]
#        tools/chroma/run.sh setup       makes the environment only
# CASES: what `saca memory export` or `build` writes. Where --count asks for more cases than there are, they are copied,
# with grip, speeds and places shifted. Seeded; one thread asks.
# Needs build/release/saca, the network at its first run, and tools/setup.sh. Versions and sha256: requirements.txt.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if [ $# -lt 1 ]; then
  echo "chroma: error: want CASES.jsonl, or setup" >&2
  exit 2
fi

venv=$here/../../build/chroma
stamp=$venv/ready-$(sha256sum "$here/requirements.txt" | cut -c1-16)
if [ ! -e "$stamp" ]; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check --no-deps --only-binary :all: \
    --require-hashes -r "$here/requirements.txt"
  touch "$stamp"
fi
[ "$1" = setup ] || PYTHONDONTWRITEBYTECODE=1 exec "$venv/bin/python" "$here/make.py" "$@"
