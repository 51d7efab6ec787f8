#!/usr/bin/env bash
# Everything that CI checks: format, the dev, asan and tsan builds with their tests, lint, package.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

step() { printf '\n== %s (%s s)\n' "$*" "$SECONDS"; }

mapfile -t sources < <(git ls-files '*.cpp' '*.h')
step "format: ${#sources[@]} files"
clang-format-14 --dry-run --Werror "${sources[@]}"

for preset in dev asan tsan; do
  step "build and test: $preset"
  cmake --preset "$preset" >/dev/null
  cmake --build --preset "$preset" -- --quiet
  ctest --preset "$preset" --progress
done

step "lint"
tools/lint.sh build/dev

step "package: installed, found and used by another project"
tools/check_package.sh

step "all is well"
