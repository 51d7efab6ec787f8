#!/usr/bin/env bash
# clang-tidy over library and programs (not over tests), as many folders at a time as there are
# cores, and a look whether each source includes what it needs. A folder's sources are looked at as
# one, because most of the time goes into what they all include; where something is found, they are
# looked at again one by one, to say where. What that can miss is a using-declaration that only
# another file of the folder uses. A folder that passed is not looked at again until it, a header or
# the rules change. saca/train is left out: clang 14 does not understand libtorch's headers as C++20.
#
# usage: tools/lint.sh             everything, some ten minutes; notes the commit that passed in tools/lint_passed,
#                                  which is to be committed once a day's worth of changes
#        tools/lint.sh --changed   sources that differ from that commit, or whose header does, new ones included
#        tools/lint.sh FILE...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
command -v clang-tidy-14 >/dev/null || {
  echo "lint: error: clang-tidy-14 is missing; run make setup" >&2
  exit 1
}

tidy() {
  clang-tidy-14 --quiet --config-file=.clang-tidy "$@" -- -std=c++20 -I. -isystem /usr/include/eigen3 -isystem /usr/include/hdf5/serial \
    -isystem /usr/include/cairo -isystem /usr/include/postgresql -DSACA_VERSION='""' 2>/dev/null
}
lint_folder() {  # FOLDER
  local sources joined stamp
  mapfile -t sources < <(git ls-files "$1/*.cpp" | grep -vE '_(test|bench)\.cpp$')
  joined=build/lint/${1//\//_}.cpp
  # What several sources of a folder call by the same short name is named once where they are one.
  awk '!(/^namespace [a-z]+ = / && named[$0]++)' "${sources[@]}" >"$joined"
  stamp=$joined-$({ cat "$joined" .clang-tidy; echo "$headers"; declare -f tidy; } | sha256sum | cut -c1-16)
  if [ -e "$stamp" ]; then
    return
  fi
  if tidy "$joined" >/dev/null; then
    rm -f "$joined"-*
    touch "$stamp"
  elif printf '%s\n' "${sources[@]}" | in_parallel tidy; then
    echo "lint: error: found only in the sources together, $joined:"
    tidy "$joined"
  else
    echo "lint: error: $1 failed"
    return 1
  fi
}
in_parallel() {  # COMMAND: for each line of the standard input
  xargs -r -P "$(nproc)" -I{} bash -euo pipefail -c "$1 {}"
}
headers=$(git ls-files -- '*.h' | xargs sha256sum | sha256sum)
export headers
export -f tidy lint_folder in_parallel

# Each source by itself, as who builds without presets compiles it.
stands_alone() {  # SOURCE
  g++ -fsyntax-only -std=c++20 -I. -isystem /usr/include/eigen3 -isystem /usr/include/hdf5/serial \
    -isystem /usr/include/cairo -isystem /usr/include/postgresql -DSACA_VERSION='""' "$1" || {
    echo "lint: error: $1 does not compile by itself"
    return 1
  }
}
export -f stands_alone

# A changed source, once for its content, that of all headers and the rules.
lint_source() {  # SOURCE
  local stamp
  stamp=build/lint/${1//\//_}-$({ cat "$1" .clang-tidy; echo "$headers"; declare -f tidy; } | sha256sum | cut -c1-16)
  [ ! -e "$stamp" ] || return 0
  tidy "$1" || {
    echo "lint: error: $1 failed"
    return 1
  }
  rm -f "build/lint/${1//\//_}"-*
  touch "$stamp"
}
export -f lint_source

of_library_and_programs() {
  grep -E '^(saca/[a-z_]+|apps/saca)/[a-z0-9_]+\.(cpp|h)$' | grep -vE '^saca/train/|_(test|bench)\.cpp$|_for_test\.h$' || true
}

# Sources that differ from the commit that passed last, and those of headers that do. Everything where nobody
# knows that commit.
changed_sources() {
  local passed
  passed=$(cat tools/lint_passed)
  git cat-file -e "$passed^{commit}" 2>/dev/null || passed=$(git hash-object -t tree /dev/null)
  { git diff --name-only --diff-filter=d "$passed" -- saca apps/saca; git ls-files --others --exclude-standard saca apps/saca; } |
    of_library_and_programs | sed 's/\.h$/.cpp/' | sort -u |
    while read -r source; do
      [ ! -e "$source" ] || echo "$source"
    done
}

mkdir -p build/lint
case ${1:-} in
  '')
    mapfile -t files < <(git ls-files saca apps/saca | of_library_and_programs | grep '\.cpp$')
    printf '%s\n' "${files[@]}" | xargs -n 1 dirname | sort -u | in_parallel lint_folder
    printf '%s\n' "${files[@]}" | in_parallel stands_alone
    git diff --quiet HEAD -- saca apps && git rev-parse HEAD >tools/lint_passed
    echo "lint: ${#files[@]} sources passed" ;;
  --changed)
    changed=$(changed_sources)  # apart, so that a git that fails is not taken for no change
    mapfile -t files < <(printf '%s' "${changed:+$changed$'\n'}")
    echo "lint: ${#files[@]} sources differ from the commit that passed last"
    [ ${#files[@]} -gt 0 ] || exit 0
    printf '%s\n' "${files[@]}" | in_parallel lint_source ;;  # each by itself: does it include what it needs?
  *) tidy "$@" ;;
esac
