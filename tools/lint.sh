#!/usr/bin/env bash
# clang-tidy over library and programs (not over tests), as many folders at a time as there are
# cores, and a look whether each source includes what it needs. A folder's sources are looked at as
# one, because most of the time goes into what they all include; where something is found, they are
# looked at again one by one, to say where. What that can miss is a using-declaration that only
# another file of the folder uses. A folder that passed is not looked at again until it, a header or
# the rules change. saca/train is left out: clang 14 does not understand libtorch's headers as C++20.
#
# usage: tools/lint.sh             everything, some ten minutes
#        tools/lint.sh --changed   folders and sources that the last day's commits changed, or that are not committed
#        tools/lint.sh FILE...
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

# Each source by itself, as who builds without presets compiles it.
stands_alone() {  # SOURCE
  g++ -fsyntax-only -std=c++20 -I. -isystem /usr/include/eigen3 -isystem /usr/include/hdf5/serial \
    -isystem /usr/include/cairo -DSACA_VERSION='""' "$1" || {
    echo "lint: error: $1 does not compile by itself"
    return 1
  }
}
export -f stands_alone
in_parallel() {  # COMMAND: for each line of the standard input
  xargs -r -P "$(nproc)" -I{} bash -euo pipefail -c "$1 {}"
}

# The newest commit that is a day older than the head; nothing where there is none.
day_before_head() {
  git rev-list -1 --before="$(($(git show -s --format=%ct HEAD) - 86400))" HEAD
}
of_library_and_programs() {
  grep -E '^(saca/[a-z_]+|apps/saca)/[a-z0-9_]+\.(cpp|h)$' | grep -vE '^saca/train/|_(test|bench)\.cpp$|_for_test\.h$' || true
}

case ${1:-} in
  '') mapfile -t files < <(git ls-files saca apps/saca | of_library_and_programs) ;;
  --changed)
    base=$(day_before_head)
    [ -n "$base" ] || base=$(git hash-object -t tree /dev/null)
    mapfile -t files < <(git diff --name-only --diff-filter=d "$base" -- saca apps/saca | of_library_and_programs) ;;
  *)
    tidy "$@"
    exit ;;
esac
mkdir -p build/lint
echo "lint: ${#files[@]} files"
[ ${#files[@]} -gt 0 ] || exit 0
printf '%s\n' "${files[@]}" | xargs -n 1 dirname | sort -u | in_parallel lint_folder
printf '%s\n' "${files[@]}" | { grep '\.cpp$' || true; } | in_parallel stands_alone
