#!/usr/bin/env bash
# Builds the vision box's Debian package for a board, from a clean checkout on a Debian 12 PC.
#
# Usage: board/visionbox/package.sh arm64|armhf [FOLDER]
#
# FOLDER (build/packages without it) then has tubesight_VERSION_ARCHITECTURE.deb and, apart, its debug
# symbols. Missing compilers are installed, the board's libraries fetched into build/. Two builds of one
# commit are to be the same to the byte, in whatever folders they were made.
set -euo pipefail

architecture=${1:-}
case $architecture in
  arm64 | armhf) ;;
  *)
    echo "usage: $0 arm64|armhf [FOLDER]" >&2
    exit 2
    ;;
esac
folder=$(realpath -m "${2:-$(dirname "${BASH_SOURCE[0]}")/../../build/packages}")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# cpack writes the mode of its temporary files into the package.
umask 022
preset=visionbox-$architecture
scripts/install_packages.sh "board-$architecture"
toolchain/debian_sysroot.sh "$architecture" "build/sysroot-$architecture"
cmake --preset "$preset"
cmake --build --preset "$preset"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cpack --config "build/$preset/CPackConfig.cmake" -B "$work" > "$work/log" 2>&1 || {
  cat "$work/log" >&2
  echo "$0: the package could not be made" >&2
  exit 1
}
mkdir -p "$folder"
mv "$work"/*.deb "$folder"
ls -l "$folder"/*_"$architecture".deb
