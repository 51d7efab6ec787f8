#!/usr/bin/env bash
# Builds without presets, as a packager would: each source of library and programs by itself, so that
# each includes what it needs; without optimising, which takes a third of the time. Installs that into an empty folder, and builds and runs examples/consumer against it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake -G Ninja -S . -B build/package -DCMAKE_BUILD_TYPE=None -DSACA_DEVELOPER=OFF >/dev/null
cmake --build build/package -- --quiet
cmake --install build/package --prefix "$folder/prefix" >/dev/null
cmake -G Ninja -S examples/consumer -B "$folder/build" -DCMAKE_PREFIX_PATH="$folder/prefix" >/dev/null
cmake --build "$folder/build" -- --quiet
"$folder/build/consumer"
(cd "$folder" && prefix/bin/saca scenarios)
