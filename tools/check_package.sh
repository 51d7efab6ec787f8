#!/usr/bin/env bash
# Configures as a packager would, installs the release build into an empty folder, and builds and runs examples/ against it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake -G Ninja -S . -B "$folder/packager" -DSACA_DEVELOPER=OFF >/dev/null  # as a packager would, without presets
cmake --install build/release --prefix "$folder/prefix" >/dev/null
for example in consumer own_dynamics; do
  cmake -G Ninja -S "examples/$example" -B "$folder/$example" -DCMAKE_PREFIX_PATH="$folder/prefix" >/dev/null
  cmake --build "$folder/$example" -- --quiet
  "$folder/$example/$example"
done
(cd "$folder" && prefix/bin/saca scenarios)
