#!/usr/bin/env bash
# Teaches the shipped language model what an expert would choose and say, from raw crash records to an adapter. In a
# Python environment of its own (build/training, 5.6 GB).
# usage: training/run.sh all FARS...         records to cases, to sets, to models/language/; hours on two cores. Can be
#                                            interrupted: the same command goes on where it was, unless the sets have
#                                            other contents by then: that is refused. Records that cannot be played
#                                            are told, and left out. `make model` merges it
#        training/run.sh tune SETS OUTPUT [--steps N] [...]     the training alone (fine_tune.py --help)
#        training/run.sh agree REPLIES SYSTEM ADAPTER [--temperature T] [...]     whether llama.cpp answers as PyTorch does;
#                                            T: that REPLIES were written with, else that of data/language_model.toml for
#                                            the tuned weights (agreement.py --help)
#        training/run.sh setup               makes the environment only
# FARS: folders of its releases (docs/cases.md). Needs `make model` and the network at its first run.
# Versions and sha256: requirements.txt. What came out, and how good it is: docs/language-model.md.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/.." && pwd)
usage() {
  sed -n 's/^# usage: /usage: /p; s/^#        training/       training/p' "${BASH_SOURCE[0]}" >&2
  exit 2
}
[ $# -ge 1 ] || usage

venv=$root/build/training
stamp=$venv/ready-$(sha256sum "$here/requirements.txt" | cut -c1-16)
if [ ! -e "$stamp" ]; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check --no-deps --only-binary :all: \
    --require-hashes -r "$here/requirements.txt"
  touch "$stamp"
fi

base=$root/third_party/models/SmolLM2-135M-Instruct.Q4_1.gguf
export PYTHONDONTWRITEBYTECODE=1
# What a step frees the next one needs again: giving it back to the system in between takes half of the time.
export MALLOC_MMAP_THRESHOLD_=1073741824 MALLOC_TRIM_THRESHOLD_=4294967296 MALLOC_TOP_PAD_=268435456
tune() {  # SETS OUTPUT [OPTION...]
  local sets=$1 output=$2
  shift 2
  "$venv/bin/python" "$here/fine_tune.py" "$sets" "$base" "$output" "$@"
}
without_failed() {  # COMMAND...: its exit code 5 says that some records could not be played (docs/formats.md)
  local code=0
  "$@" || code=$?
  [ "$code" -ne 5 ] || {
    echo "training: $2 $3: some records could not be played: they are left out" >&2
    code=0
  }
  return "$code"
}

command=$1
shift
case $command in
  setup) ;;
  tune)
    [ $# -ge 2 ] || usage
    tune "$@"
    ;;
  agree)
    [ $# -ge 3 ] || usage
    "$venv/bin/python" "$here/agreement.py" "$1" "$2" "$base" "${@:3}"
    ;;
  all)
    [ $# -ge 1 ] || usage
    saca=$root/build/release/saca
    work=$root/runs/training
    mkdir -p "$work"
    without_failed "$saca" cases build "$@" --draws 16 --told-draws 16 -o "$work/cases.jsonl"
    rm -f "$work/shipped.sqlite"
    gunzip -c "$root/data/memory/seed.jsonl.gz" >"$work/shipped.jsonl"
    "$saca" memory --memory "$work/shipped.sqlite" import "$work/shipped.jsonl" --keep-trust
    without_failed "$saca" cases export "$work/cases.jsonl" --memory "$work/shipped.sqlite" -o "$work/sets"
    without_failed "$saca" cases export "$work/cases.jsonl" --memory "$work/shipped.sqlite" --cues cues -o "$work/cues"
    tune "$work/sets" "$work/tuned" --also "$work/cues" --steps 400 --harm-scale 0.01
    cp "$work/tuned/adapter.gguf" "$work/tuned/training.json" "$root/models/language/"
    for output in "$root/models/language/curve.csv" "$root/docs/language_model/curve.svg"; do
      python3 "$here/curve.py" "$work/tuned/curve.csv" "$output"
    done
    echo "the adapter: models/language/adapter.gguf; make model merges it"
    ;;
  *) usage ;;
esac
