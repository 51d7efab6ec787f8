#!/usr/bin/env bash
# Installs the Debian 12 packages that building and testing need; silent when all are there.
# usage: tools/setup.sh [train|aarch64]    train: also what saca-train needs, libtorch (120 MB) and
#                                          OpenBLAS: with the reference BLAS a training takes several times as long
#                                          aarch64: also a compiler for 64-bit Arm, and qemu
set -euo pipefail

packages=(
  g++ ccache cmake ninja-build make git pkg-config
  libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libcli11-dev libsqlite3-dev libpq-dev postgresql libcurl4-openssl-dev openssl
  libeigen3-dev libboost-math-dev libnlopt-dev libnlopt-cxx-dev libxsimd-dev libpugixml-dev libhdf5-dev libcairo2-dev libzip-dev zlib1g-dev
  libgtest-dev libgmock-dev libbenchmark-dev
  clang-format-14
  python3 python3-venv python3-pytest python3-jsonschema
  chromium
)
case ${1:-} in
  '') ;;
  train) packages+=(libtorch-dev libopenblas0-pthread) ;;
  aarch64) packages+=(g++-aarch64-linux-gnu qemu-user googletest) ;;
  *)
    echo "setup: error: want train, aarch64 or nothing, got $1" >&2
    exit 2
    ;;
esac

missing=()
for package in "${packages[@]}"; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
    missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

echo "setup: installing ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "setup: error: not root and no sudo; install by hand: apt-get install ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends \
  "${missing[@]}" >/dev/null
