#!/usr/bin/env bash
# Everything that CI checks: format, the release build with all tests, the same code under sanitisers, lint of
# what has changed, the installed package. Says at the end what each step took.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

steps=()
step() {  # NAME COMMAND...
  local name=$1 begin=$SECONDS
  shift
  printf '\n== %s\n' "$name"
  "$@"
  steps+=("$(printf '%5d s  %s' $((SECONDS - begin)) "$name")")
}

format() {
  local sources
  mapfile -t sources < <(git ls-files '*.cpp' '*.h')
  printf '%s\0' "${sources[@]}" | xargs -0 -n 50 -P "$(nproc)" clang-format-14 --dry-run --Werror
}
build() {  # PRESET [TARGET...]
  local preset=$1
  shift
  cmake --preset "$preset" >/dev/null
  cmake --build --preset "$preset" ${1:+--target "$@"} -- --quiet
}

packages() {
  tools/setup.sh train
  tools/trace_mcap/run.sh setup  # its test reads a file back with another group's reader
}
# Some tests wait most of their time, for a clock or a browser: two more at a time than there are cores.
at_once=$(($(nproc) + 2))
step "packages" packages
step "format" format
step "build: release" build release
step "tests" tools/ctest_again.py release --parallel "$at_once"
# What reads files, replies and scenes, shares memory or begins processes (docs/testing.md).
step "build: address and undefined-behaviour sanitiser" build asan-quick
step "tests: address and undefined-behaviour sanitiser" tools/ctest_again.py asan-quick --parallel "$at_once"
step "build: thread sanitiser" build tsan core_test encounter_test language_model_test runtime_test
step "tests: thread sanitiser" tools/ctest_again.py tsan --parallel "$at_once"
step "lint: what has changed" tools/lint/run.sh --changed
step "package: installed, found and used by another project" tools/check_package.sh
step "aarch64: what drives, beside this processor" tools/aarch64.sh

# Of what is skipped each test says why.
grep -hA 1 ': Skipped$' build/{release,asan-quick,tsan}/Testing/Temporary/LastTest.log | grep -v '^--$' | sed 's|^.*/\([^/]*: Skipped\)|\1|' | paste - - | sort -u || true
grep -h '^SKIPPED ' build/{release,asan-quick,tsan}/Testing/Temporary/LastTest.log | sort -u || true
printf '\n== all is well (%d s)\n' "$SECONDS"
printf '%s\n' "${steps[@]}"
