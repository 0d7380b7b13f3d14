#!/usr/bin/env bash
# Recipe of the arm64 sysroot: fetches Debian's own packages for arm64 and unpacks them.
#
# Usage: toolchain/arm64_sysroot.sh FOLDER
#
# Why not install them beside the PC's (multiarch): that would pull in the arm64 C library and bring
# every shared library of the PC to the same patch level; for some libraries to link against, that is
# too much to ask. Here nothing of the system is changed, and no root is needed. The C and C++
# libraries come with the cross compiler (libc6-dev-arm64-cross, libstdc++-12-dev-arm64-cross).
set -euo pipefail

packages=(
  zlib1g-dev           # libpng's decompression
  libpng-dev           # PNG pictures: drivers/files
  liblzma-dev          # .y4m.xz recordings: drivers/files
  libeigen3-dev        # core/base
  libtomlplusplus-dev  # drivers/settings
  libmodbus5           # drivers/modbus: a shared library
  libmodbus-dev        # and its header
  libgpiod-dev         # drivers/gpio
  libaravis-dev        # drivers/aravis: its header alone, the library is loaded at run time
  libglib2.0-dev       # headers that that one includes
  libcli11-dev         # board/bench
  libyaml-dev          # drivers/camera_yaml
)

if [ $# -ne 1 ]; then
  echo "usage: $0 FOLDER" >&2
  exit 2
fi
sysroot=$1
stamp=$sysroot/packages.txt
wanted=$(printf '%s\n' "${packages[@]}")

if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$wanted" ]; then
  exit 0
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{state/lists/partial,cache/archives/partial,debs}
touch "$work/status"
cat > "$work/apt.conf" <<CONF
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "root";
Dir::State "$work/state";
Dir::State::status "$work/status";
Dir::Cache "$work/cache";
Acquire::Languages "none";
Acquire::Retries "3";
CONF
export APT_CONFIG=$work/apt.conf

fail() {
  echo "$0: $1; what apt said:" >&2
  tail -n 5 "$work/log" >&2
  exit 1
}
apt-get -q update > "$work/log" 2>&1 || fail "cannot read Debian's package lists for arm64"
(cd "$work/debs" && apt-get -q download "${packages[@]}") > "$work/log" 2>&1 \
  || fail "cannot download ${packages[*]} for arm64"

rm -rf "$sysroot"
mkdir -p "$sysroot"
for deb in "$work"/debs/*.deb; do
  dpkg-deb -x "$deb" "$sysroot"
done
# The shared libraries are left out: programs for emulated tests are linked against the archives and
# then run with nothing but the cross compiler's C library. Only libmodbus has no archive; programs find
# it by the folder that they were linked with.
find "$sysroot/usr/lib/aarch64-linux-gnu" -name '*.so*' ! -name 'libmodbus.so*' -delete
printf '%s\n' "$wanted" > "$stamp"
