#!/usr/bin/env bash
# clang-tidy over library and programs (not over tests), as many folders at a time as there are
# cores. A folder's sources are looked at as one, because most of the time goes into what they all
# include; where something is found, they are looked at again one by one, to say where. What that
# can miss is a using-declaration that only another file of the folder uses. A folder that passed
# is not looked at again until it, a header or the rules change. saca/train is left out: clang 14 does
# not understand libtorch's headers as C++20.
# usage: tools/lint.sh [FILE...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
command -v clang-tidy-14 >/dev/null || {
  echo "lint: error: clang-tidy-14 is missing; run make setup" >&2
  exit 1
}

tidy() {
  clang-tidy-14 --quiet --config-file=.clang-tidy "$@" -- -std=c++20 -I. -isystem /usr/include/eigen3 -isystem /usr/include/hdf5/serial \
    -isystem /usr/include/cairo -DSACA_VERSION='""' 2>/dev/null
}
lint_folder() {  # FOLDER
  local sources joined stamp
  mapfile -t sources < <(git ls-files "$1/*.cpp" | grep -vE '_(test|bench)\.cpp$')
  joined=build/lint/${1//\//_}.cpp
  cat "${sources[@]}" >"$joined"
  stamp=$joined-$({ cat "$joined" .clang-tidy; echo "$headers"; declare -f tidy; } | sha256sum | cut -c1-16)
  if [ -e "$stamp" ]; then
    return
  fi
  if tidy "$joined" >/dev/null; then
    rm -f "$joined"-*
    touch "$stamp"
  elif tidy "${sources[@]}"; then
    echo "lint: error: found only in the sources together, $joined:"
    tidy "$joined"
  else
    echo "lint: error: $1 failed"
    return 1
  fi
}
headers=$(git ls-files -- '*.h' | xargs sha256sum | sha256sum)
export headers
export -f tidy lint_folder

if [ $# -gt 0 ]; then
  tidy "$@"
else
  mkdir -p build/lint
  git ls-files -- 'saca/*/CMakeLists.txt' apps/saca/CMakeLists.txt ':!saca/train' | xargs -n 1 dirname |
    xargs -P "$(nproc)" -I{} bash -euo pipefail -c 'lint_folder {}'
fi
