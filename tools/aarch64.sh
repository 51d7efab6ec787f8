#!/usr/bin/env bash
# Builds what drives for 64-bit Arm, and runs it under qemu-user: the example in C beside the one of this machine, row for
# row, and with `all` the tests of its modules, too (some 25 minutes: qemu takes ten times as long as a processor).
# Needs `make build` before, for the package that both read. Debian packages: g++-aarch64-linux-gnu qemu-user
# usage: tools/aarch64.sh [all]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
case ${1:-} in
  '' | all) ;;
  *)
    sed -n 's/^# usage: /usage: /p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac

tools/setup.sh aarch64
cmake --preset aarch64 >/dev/null
cmake --build --preset aarch64 --target "${1:-reflex_in_c}" -- --quiet
cmake --build --preset release --target reflex_in_c saca_program -- --quiet

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
build/release/saca atlas build --output "$folder/car.atlas" >/dev/null
build/release/saca atlas package "$folder/car.atlas" --output "$folder/car.vehicle" >/dev/null
build/release/tests/reflex_in_c/reflex_in_c "$folder/car.vehicle" >"$folder/here.csv"
qemu-aarch64 -L /usr/aarch64-linux-gnu build/aarch64/tests/reflex_in_c/reflex_in_c "$folder/car.vehicle" >"$folder/there.csv"
python3 tools/same_drives.py "$folder/here.csv" "$folder/there.csv"
aarch64-linux-gnu-strip -o "$folder/stripped" build/aarch64/tests/reflex_in_c/reflex_in_c
strip -o "$folder/stripped_here" build/release/tests/reflex_in_c/reflex_in_c
echo "stripped, with the plane and its example in C: $(stat -c %s "$folder/stripped") bytes, here $(stat -c %s "$folder/stripped_here")"

[ -z "${1:-}" ] || ctest --preset aarch64 --parallel "$(nproc)"
