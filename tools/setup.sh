#!/usr/bin/env bash
# Installs the Debian 12 packages that building and testing need; silent when all are there.
# usage: tools/setup.sh [train]    train: also what saca-train needs, libtorch (120 MB) and
#                                  OpenBLAS: with the reference BLAS a training takes several times as long
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
[ "${1:-}" != train ] || packages+=(libtorch-dev libopenblas0-pthread)

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
