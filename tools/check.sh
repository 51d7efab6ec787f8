#!/usr/bin/env bash
# Everything that CI checks: format, the dev, asan and tsan builds with their tests, lint, package.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

step() { printf '\n== %s (%s s)\n' "$*" "$SECONDS"; }

mapfile -t sources < <(git ls-files '*.cpp' '*.h')
tools/setup.sh train
step "format: ${#sources[@]} files"
clang-format-14 --dry-run --Werror "${sources[@]}"

check() {  # PRESET TARGETS CTEST_OPTION...
  local preset=$1 targets=$2
  shift 2
  step "build and test: $preset"
  cmake --preset "$preset" >/dev/null
  # shellcheck disable=SC2086  # targets are words
  cmake --build --preset "$preset" ${targets:+--target $targets} -- --quiet
  ctest --preset "$preset" --parallel 2 "$@"
}

tools/trace_mcap/run.sh setup  # its test reads a file back where this has been run
check dev ""
# Pages, the command line and the real model are tested once, in dev; benchmarks say nothing under a
# sanitiser.
check asan "module_tests scenario_replay vehicle_log_replay family_replay hundred_car_replay commonroad_replay ngsim_replay reply_replay" --label-exclude 'viewer|cli|bench|model_host'
check tsan "core_latest_slot_test core_parallel_test loop_thinking_thread_test loop_real_pace_test"

step "lint"
tools/lint.sh

step "package: installed, found and used by another project"
tools/check_package.sh

step "all is well"
