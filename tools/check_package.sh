#!/usr/bin/env bash
# Configures as a packager would, installs the release build into an empty folder, and builds and runs examples/ against it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake -G Ninja -S . -B "$folder/packager" -DSACA_DEVELOPER=OFF >/dev/null  # as a packager would, without presets
cmake --install build/release --prefix "$folder/prefix" >/dev/null
built() {  # EXAMPLE [OPTION...]
  local example=$1
  shift
  cmake -G Ninja -S "examples/$example" -B "$folder/$example" -DCMAKE_PREFIX_PATH="$folder/prefix" "$@" >/dev/null
  cmake --build "$folder/$example" -- --quiet
}
built own_dynamics
"$folder/own_dynamics/own_dynamics"

(cd "$folder" && prefix/bin/saca atlas build --output car.atlas >/dev/null && prefix/bin/saca atlas package car.atlas --output car.vehicle)
built full_stack
"$folder/full_stack/full_stack" "$folder/car.vehicle"

# What drives, alone: no other package is looked for, and nothing is linked but the C and C++ libraries.
others=()
for package in tomlplusplus nlohmann_json fmt SQLite3 PostgreSQL ZLIB CURL Threads PkgConfig Eigen3 NLopt pugixml OpenMP; do
  others+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
built reflex_only --no-warn-unused-cli "${others[@]}"
built reflex_in_c --no-warn-unused-cli "${others[@]}"
"$folder/reflex_in_c/reflex_in_c" "$folder/car.vehicle" >/dev/null
# Nor does what builds it alone look for one.
cmake -G Ninja -S . -B "$folder/alone" -DSACA_DEVELOPER=OFF -DSACA_BUILD=reflex --no-warn-unused-cli "${others[@]}" >/dev/null
needed=$(readelf -d "$folder/reflex_only/reflex_only" | sed -n 's/.*(NEEDED).*\[\(.*\)\].*/\1/p')
if foreign=$(grep -vE '^lib(stdc\+\+|m|gcc_s|c)\.so\.' <<<"$needed"); then
  echo "package: error: reflex_only: want the C and C++ libraries alone, got $foreign" >&2
  exit 1
fi
"$folder/reflex_only/reflex_only" "$folder/car.vehicle"
(cd "$folder" && prefix/bin/saca scenarios)
