#!/usr/bin/env bash
# Builds without presets, as a packager would: each source of library and programs by itself, so that
# each includes what it needs; without optimising, which takes a third of the time. Installs that into an empty folder, and builds and runs examples/ against it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake -G Ninja -S . -B build/package -DCMAKE_BUILD_TYPE=None -DSACA_DEVELOPER=OFF >/dev/null
cmake --build build/package -- --quiet
cmake --install build/package --prefix "$folder/prefix" >/dev/null
for example in consumer own_dynamics; do
  cmake -G Ninja -S "examples/$example" -B "$folder/$example" -DCMAKE_PREFIX_PATH="$folder/prefix" >/dev/null
  cmake --build "$folder/$example" -- --quiet
  "$folder/$example/$example"
done
(cd "$folder" && prefix/bin/saca scenarios)
