#!/usr/bin/env bash
# Installs the release build into an empty folder, and builds and runs examples/consumer against it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --preset release >/dev/null
cmake --build --preset release -- --quiet
cmake --install build/release --prefix "$folder/prefix" >/dev/null
cmake -G Ninja -S examples/consumer -B "$folder/build" -DCMAKE_PREFIX_PATH="$folder/prefix" >/dev/null
cmake --build "$folder/build" -- --quiet
"$folder/build/consumer"
(cd "$folder" && prefix/bin/saca scenarios)
