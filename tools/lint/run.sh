#!/usr/bin/env bash
# clang-tidy over library and programs (not over tests), in a Python environment of its own (build/clang_tidy), and a look
# whether each source includes what it needs. Sources of a folder are looked at as one, up to some thousand lines, because
# most of the time goes into what they all include; where something is found, they are looked at again one by one, to
# say where. What that can miss is a using-declaration that only another file of the folder uses. Sources that passed
# are not looked at again until one of them, a header or the rules change. saca/lab/network_training is left out: it needs libtorch.
#
# usage: tools/lint/run.sh             everything, some minutes; notes the commit that passed in tools/lint/passed,
#                                      which is to be committed once a day's worth of changes
#        tools/lint/run.sh --changed   sources that differ from that commit, or whose header does, new ones included
#        tools/lint/run.sh FILE...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

venv=$PWD/build/clang_tidy
ready=$venv/ready-$(sha256sum tools/lint/requirements.txt | cut -c1-16)
if [ ! -e "$ready" ]; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check --only-binary :all: --require-hashes \
    -r tools/lint/requirements.txt
  touch "$ready"
fi
headers=$(git ls-files -- '*.h' | xargs sha256sum | sha256sum)
compile=(-std=c++20 -I. -isystem /usr/include/eigen3 -isystem /usr/include/hdf5/serial
  -isystem /usr/include/cairo -isystem /usr/include/postgresql '-DSACA_VERSION=""')
export venv headers

in_parallel() {  # COMMAND: for each line of the standard input, its words are the arguments
  xargs -r -P "$(nproc)" -I{} bash -euo pipefail -c "$(declare -p compile); $1 {}"
}
# The analyzer gives up on a function after so many steps: what it finds, it finds early.
tidy() {
  "$venv/bin/clang-tidy" --quiet --config-file=.clang-tidy "$@" -- "${compile[@]}" \
    -Xclang -analyzer-config -Xclang max-nodes=8000 2>/dev/null
}
# A source by itself, as who builds without presets compiles it.
stands_alone() {  # SOURCE
  g++ -fsyntax-only "${compile[@]}" "$1" || {
    echo "lint: error: $1 does not compile by itself"
    return 1
  }
}
lint_group() {  # SOURCE...: of one folder
  local joined stamp source failed=
  stamp=build/lint/$({ cat "$@" .clang-tidy; echo "$* $headers"; declare -f tidy; } | sha256sum | cut -c1-32)
  [ ! -e "$stamp" ] || return 0
  joined=$stamp.cpp
  # What several sources of a folder call by the same short name is named once where they are one.
  awk '!(/^namespace [a-z]+ = / && named[$0]++)' "$@" >"$joined"
  if tidy "$joined" >/dev/null; then
    rm "$joined"
    touch "$stamp"
    return
  fi
  for source; do tidy "$source" || failed="$failed $source"; done
  [ -n "$failed" ] || tidy "$joined" || failed=" only together: $*"
  echo "lint: error: failed:$failed"
  return 1
}
export -f tidy stands_alone lint_group

of_library_and_programs() {
  grep -E '^(saca/[a-z_/]+|apps/saca)/[a-z0-9_]+\.(cpp|h)$' | grep -vE '^saca/lab/network_training/|_(test|bench)\.cpp$|_for_test\.h$' || true
}
# Sources that differ from the commit that passed last, and those of headers that do. Everything where nobody
# knows that commit.
changed_sources() {
  local passed
  passed=$(cat tools/lint/passed)
  git cat-file -e "$passed^{commit}" 2>/dev/null || passed=$(git hash-object -t tree /dev/null)
  { git diff --name-only --diff-filter=d "$passed" -- saca apps/saca; git ls-files --others --exclude-standard saca apps/saca; } |
    of_library_and_programs | sed 's/\.h$/.cpp/' | sort -u |
    while read -r source; do
      [ ! -e "$source" ] || echo "$source"
    done
}
# A line for each group: sources of one folder, of some thousand lines together.
groups() {  # SOURCE...
  wc -l "$@" | awk '$2 != "total" {
    folder = $2; sub("/[^/]*$", "", folder)
    if (NR > 1 && (folder != last || lines + $1 > 4000)) { printf "\n"; lines = 0 }
    printf "%s ", $2; lines += $1; last = folder
  } END { printf "\n" }'
}

mkdir -p build/lint
changed=$(changed_sources)  # apart, so that a git that fails is not taken for no change
mapfile -t changed < <(printf '%s' "${changed:+$changed$'\n'}")
case ${1:-} in
  '') mapfile -t files < <(git ls-files saca apps/saca | of_library_and_programs | grep '\.cpp$') ;;
  --changed) files=("${changed[@]}") ;;
  *) tidy "$@"
    exit ;;
esac
echo "lint: ${#files[@]} sources, of which ${#changed[@]} differ from the commit that passed last"
[ ${#files[@]} -gt 0 ] || exit 0
groups "${files[@]}" | in_parallel lint_group
printf '%s\n' "${changed[@]}" | in_parallel stands_alone
if [ -z "${1:-}" ] && git diff --quiet HEAD -- saca apps; then
  git rev-parse HEAD >tools/lint/passed
fi
