#!/usr/bin/env bash
# Installs what is missing to build and run Tubesight on Debian 12; silent when nothing is.
#
# Usage: scripts/install_packages.sh bench          what the program needs to be built and run
#        scripts/install_packages.sh bench test     and what the tests and checks need
#        scripts/install_packages.sh image          what a board's image is made with
#        scripts/install_packages.sh board-arm64    what a board's package is built with; or board-armhf
set -euo pipefail

bench=(
  g++                   # the compiler, 12.2 on Debian 12
  cmake                 # 3.25, presets version 6
  ninja-build           # the presets' generator
  libeigen3-dev         # transforms; pose and calibration later
  liblzma-dev           # .y4m.xz recordings
  libpng-dev            # overlay pictures
  libtomlplusplus-dev   # settings
  libcli11-dev          # the command line
  ffmpeg                # videos of other kinds, at run time
  libyaml-dev           # cameras of OpenCV and ROS
  libmodbus-dev         # the robot's link
  libmicrohttpd-dev     # the operator's page
  libgnutls28-dev       # its certificate
  libjpeg62-turbo-dev   # its pictures
  nlohmann-json3-dev    # what it is asked and answers
  libsqlite3-dev        # the journal
  libssl-dev            # its chain and its signatures
  libgpiod-dev          # a lamp on GPIO lines
  libaravis-dev         # cameras of GigE Vision and USB3 Vision
  libglib2.0-dev        # what its header stands on
)
test=(
  libgtest-dev          # tests on the PC
  googletest            # its source, built for arm64
  libbenchmark-dev      # time per field
  clang                 # libFuzzer, and a second opinion
  libclang-rt-14-dev    # libFuzzer's and the sanitizers' run time for it
  clang-format          # format check
  clang-tidy            # preset bench-tidy
  valgrind              # callgrind: instructions per field
  python3               # tests/checks/
  mbpoll                # a foreign master for the robot's link
  python3-pymodbus      # and another, with what it needs for a serial line:
  python3-serial-asyncio #
  groff-base            # check manual: the manual page is rendered
  systemd               # systemd-analyze judges the service's unit
  lintian               # judges the package
  g++-aarch64-linux-gnu # preset visionbox-qemu, check no_float
  qemu-user-static      # runs its tests
  qemu-system-arm       # the emulated board: tests/system/board/
  kmod                  # the order in which its kernel's modules are loaded
  openssh-client        # the long test of its image comes in by the network
  e2fsprogs             # the file system that power cuts leave
  device-tree-compiler  # its PWM
  squashfs-tools        # its Debian, on which the package is installed
  chromium-headless-shell # the page is looked at in it
  fonts-dejavu-core     # and written with these
)
# Node drives it. Where somebody has it from elsewhere, npm comes with it.
command -v node > /dev/null || test+=(nodejs)
command -v npm > /dev/null || test+=(npm)
board=(
  cmake
  ninja-build
  python3               # sources joined, dependencies and bill of materials written
  git                   # the commit, and the time that the package's files bear
)
image=(
  dosfstools            # the boot partition
  mtools                # and what is on it
  e2fsprogs             # the data partition
  fdisk                 # the partitions' table
  squashfs-tools        # the root
  kmod                  # which kernel modules need which
  u-boot-tools          # U-Boot's script
  python3
)

fail() {
  echo "$0: $1" >&2
  exit 1
}

# What the page's test needs of npm's registry, at the versions of the lock file: build/page-test/.
install_page_test() {
  local root folder
  root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
  folder=$root/build/page-test
  cmp -s "$root/tests/system/page/package-lock.json" "$folder/installed.json" && return
  mkdir -p "$folder"
  cp "$root/tests/system/page/package.json" "$root/tests/system/page/package-lock.json" "$folder"
  (cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund > npm.log 2>&1 < /dev/null) || {
    tail -n 5 "$folder/npm.log" >&2
    fail "npm could not install what the page's test needs (network?)"
  }
  cp "$folder/package-lock.json" "$folder/installed.json"
}

wanted=()
for group in "$@"; do
  case $group in
    bench) wanted+=("${bench[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    image) wanted+=("${image[@]}") ;;
    board-arm64) wanted+=("${board[@]}" g++-aarch64-linux-gnu) ;;
    board-armhf) wanted+=("${board[@]}" g++-arm-linux-gnueabihf) ;;
    *) fail "unknown group '$group', expected bench, test, image, board-arm64 or board-armhf" ;;
  esac
done
[ ${#wanted[@]} -gt 0 ] || fail "no group given, expected bench, test, image, board-arm64 or board-armhf"

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
  fail "this is not Debian; install by hand what corresponds to: ${wanted[*]}"
fi

missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  [[ " $* " != *" test "* ]] || install_page_test
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo > /dev/null \
    || fail "not root and no sudo; as root, run: apt-get install ${missing[*]}"
  as_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "installing: ${missing[*]}" >&2
# A source list of someone else's that cannot be reached is no reason to stop: what counts is whether
# the packages install.
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get -q -o Acquire::Retries=3 update > "$log" 2>&1 < /dev/null || true
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get -qy -o Acquire::Retries=3 install --no-install-recommends "${missing[@]}" \
  >> "$log" 2>&1 < /dev/null || {
    tail -n 5 "$log" >&2
    fail "apt-get could not install ${missing[*]} (network? Debian 12?)"
  }
[[ " $* " != *" test "* ]] || install_page_test
