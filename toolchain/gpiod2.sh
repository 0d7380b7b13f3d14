#!/usr/bin/env bash
# Fetches the header of libgpiod 2.x out of Debian 13's package, for a machine that has 1.6: there
# the driver's other half is compiled and tested, too.
#
# Usage: toolchain/gpiod2.sh FOLDER
#
# The test brings its own functions of the library: the header is all that is needed. Nothing of the
# system is changed, and no root is needed.
set -euo pipefail

if [ $# -ne 1 ]; then
  echo "usage: $0 FOLDER" >&2
  exit 2
fi
folder=$1
[ ! -f "$folder/usr/include/gpiod.h" ] || exit 0

# From where this machine has its own packages: the first archive of a whole release.
mirror=$(apt-get indextargets --format '$(SITE) $(RELEASE) $(COMPONENT)' 'Identifier: Packages' \
  | awk '$2 !~ /[-\/]/ && $3 == "main" { print $1; exit }')
if [ -z "$mirror" ]; then
  echo "$0: this machine's package sources name no archive of Debian" >&2
  exit 1
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{state/lists/partial,cache/archives/partial}
touch "$work/status"
keyring=/usr/share/keyrings/debian-archive-keyring.gpg
echo "deb [signed-by=$keyring] $mirror trixie main" > "$work/sources.list"
cat > "$work/apt.conf" <<CONF
APT::Sandbox::User "root";
Dir::State "$work/state";
Dir::State::status "$work/status";
Dir::Cache "$work/cache";
Dir::Etc::sourcelist "$work/sources.list";
Dir::Etc::sourceparts "-";
Acquire::Languages "none";
Acquire::Retries "3";
CONF
export APT_CONFIG=$work/apt.conf

fail() {
  echo "$0: $1; what apt said:" >&2
  tail -n 5 "$work/log" >&2
  exit 1
}
apt-get -q update > "$work/log" 2>&1 || fail "cannot read Debian 13's package lists"
(cd "$work" && apt-get -q download libgpiod-dev) > "$work/log" 2>&1 \
  || fail "cannot download Debian 13's libgpiod-dev"
mkdir -p "$folder"
dpkg-deb -x "$work"/libgpiod-dev_*.deb "$folder"
