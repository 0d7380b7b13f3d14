#!/usr/bin/env bash
# The boards' packages, each built twice in two folders from clean checkouts: the same to the byte, and
# what tests/checks/package.py wants of them; and that of arm64 on an emulated board.
#
# Usage: tests/checks/packages_twice.sh [ARCHITECTURE...]      arm64 and armhf without them
#
# What is not committed is not looked at. Nothing of the first build, no compiler's cache either, helps
# the second; only Debian's own packages are fetched once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

architectures=("$@")
[ ${#architectures[@]} -gt 0 ] || architectures=(arm64 armhf)
export CCACHE_DISABLE=1

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Of different lengths, so that a path that is left in shifts what follows.
trees=("$work/one" "$work/another/folder")
for tree in "${trees[@]}"; do
  mkdir -p "$(dirname "$tree")"
  git clone -q . "$tree"
done
failed=0
for architecture in "${architectures[@]}"; do
  sysroot=build/sysroot-$architecture
  toolchain/debian_sysroot.sh "$architecture" "$sysroot"
  for tree in "${trees[@]}"; do
    mkdir -p "$tree/build"
    cp -a "$sysroot" "$tree/build"
  done
  "${trees[0]}/board/visionbox/package.sh" "$architecture" "${trees[0]}/packages-$architecture"
  # Somebody else's habits.
  (
    umask 077
    TZ=Asia/Tokyo LC_ALL=C "${trees[1]}/board/visionbox/package.sh" "$architecture" \
      "${trees[1]}/packages-$architecture"
  )
  rm -rf "${trees[@]/%//build}"
  diff -rq "${trees[0]}/packages-$architecture" "${trees[1]}/packages-$architecture" || failed=1

  case $architecture in
    arm64) machine=aarch64-linux-gnu emulator=qemu-aarch64-static ;;
    armhf) machine=arm-linux-gnueabihf emulator=qemu-arm-static ;;
  esac
  python3 -B tests/checks/package.py --made "${trees[0]}/packages-$architecture" "$machine-readelf" \
    "$emulator" -L "/usr/$machine" -E "LD_LIBRARY_PATH=$PWD/$sysroot/usr/lib/$machine" || failed=1
  # Installed, upgraded and removed under emulation, where systemd runs; of 32 bits there is no such board.
  [ "$architecture" != arm64 ] \
    || python3 -B tests/system/board/package_test.py "${trees[0]}/packages-arm64"/tubesight_*.deb || failed=1
done
exit "$failed"
