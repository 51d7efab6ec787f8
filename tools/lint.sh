#!/usr/bin/env bash
# clang-tidy over library and programs (not over tests), two at a time; a file that passed is not looked at again until it, a
# header or the rules change.
# usage: tools/lint.sh BUILD_FOLDER [FILE...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=$1
shift
stamps=$build/lint
mkdir -p "$stamps"
headers=$(git ls-files '*.h' .clang-tidy | sort | xargs sha256sum | sha256sum | cut -c1-16)
export build stamps headers

lint_one() {
  local stamp
  stamp=$stamps/$(printf '%s' "$1" | tr / _)-$headers-$(sha256sum "$1" | cut -c1-16)
  [ -e "$stamp" ] && return
  if clang-tidy-14 -p "$build" --quiet "$1" 2>/dev/null; then
    touch "$stamp"
  else
    echo "lint: $1 failed"
    return 1
  fi
}
export -f lint_one

if [ $# -gt 0 ]; then files=("$@"); else mapfile -t files < <(git ls-files 'saca/*.cpp' 'apps/saca/*.cpp' | grep -vE '_(test|bench)\.cpp$'); fi
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -I{} bash -c 'lint_one {}'
