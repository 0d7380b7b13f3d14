#!/usr/bin/env bash
# Downloads Debian packages of another architecture, without a change to this system and without root.
#
# Usage: toolchain/debian_download.sh [--with-dependencies] ARCHITECTURE FOLDER PACKAGE...
#
# FOLDER then has a .deb for each PACKAGE, beside what was there before; with --with-dependencies also for
# what they depend on, and what every Debian has (libc6, dpkg and their like). Archives and keys are this
# system's; the state is apt's own, in a temporary folder.
set -euo pipefail

usage() {
  echo "usage: $0 [--with-dependencies] ARCHITECTURE FOLDER PACKAGE..." >&2
  exit 2
}
all=no
if [ "${1:-}" = --with-dependencies ]; then
  all=yes
  shift
fi
[ $# -ge 3 ] || usage
architecture=$1
mkdir -p "$2"
folder=$(realpath "$2")
shift 2

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{state/lists/partial,cache/archives/partial,debs}
touch "$work/status"
cat > "$work/apt.conf" <<CONF
APT::Architecture "$architecture";
APT::Architectures { "$architecture"; };
APT::Install-Recommends "no";
APT::Sandbox::User "root";
Debug::NoLocking "yes";
Dir::State "$work/state";
Dir::State::status "$work/status";
Dir::Cache "$work/cache";
Acquire::Languages "none";
Acquire::Retries "3";
CONF
export APT_CONFIG=$work/apt.conf

# One list that fails (the archive of security updates has at times none for armhf) is told, not the end:
# what counts is whether the packages come.
apt-get -q update > "$work/log" 2>&1 \
  || echo "$0: not all of Debian's package lists for $architecture could be read" >&2
fetch() {
  cd "$work/debs"
  if [ "$all" = yes ]; then
    apt-get -qy --download-only install "$@" && mv "$work"/cache/archives/*.deb .
  else
    apt-get -q download "$@"
  fi
}
(fetch "$@") > "$work/log" 2>&1 || {
  echo "$0: cannot download $* for $architecture; what apt said:" >&2
  tail -n 5 "$work/log" >&2
  exit 1
}
mv "$work"/debs/*.deb "$folder"
