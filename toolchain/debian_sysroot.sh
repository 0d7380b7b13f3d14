#!/usr/bin/env bash
# Recipe of a board's sysroot: fetches Debian's own packages for arm64 or armhf and unpacks them.
#
# Usage: toolchain/debian_sysroot.sh arm64|armhf FOLDER
#
# Beside what is unpacked, FOLDER/debian has what a package of ours must say of them: `packages.tsv`
# (name, version, source package) and `shlibs` (which package has a shared library, as dpkg knows it).
#
# Why not install them beside the PC's (multiarch): that would pull in the other C library and bring
# every shared library of the PC to the same patch level; for some libraries to link against, that is
# too much to ask, and for armhf it fails. Here nothing of the system is changed, and no root is
# needed. The C and C++ libraries to link with come with the cross compiler.
set -euo pipefail

packages=(
  libpng16-16          # PNG pictures: drivers/files
  libpng-dev           #
  zlib1g               # its decompression
  zlib1g-dev           #
  liblzma5             # .y4m.xz recordings: drivers/files
  liblzma-dev          #
  libeigen3-dev        # core/base
  libtomlplusplus-dev  # drivers/settings
  libmodbus5           # drivers/modbus
  libmodbus-dev        #
  libmicrohttpd12      # drivers/web
  libmicrohttpd-dev    #
  libgnutls30          #
  libgnutls28-dev      #
  libjpeg62-turbo      #
  libjpeg62-turbo-dev  #
  libcrypt1            #
  libcrypt-dev         #
  libnettle8           # what GnuTLS stands on, for the linker
  libhogweed6          #
  libgmp10             #
  libp11-kit0          #
  libffi8              #
  libidn2-0            #
  libunistring2        #
  libtasn1-6           #
  nlohmann-json3-dev   # board/visionbox: the page's questions and answers
  libsqlite3-0         # drivers/journal
  libsqlite3-dev       #
  libssl3              # its chain and its signatures
  libssl-dev           #
  libgpiod2            # drivers/gpio
  libgpiod-dev         #
  libaravis-dev        # drivers/aravis: its header alone, the library is loaded at run time
  libglib2.0-dev       # headers that that one includes
  libcli11-dev         # board/bench
  libyaml-0-2          # drivers/camera_yaml
  libyaml-dev          #
)
# Only what packages say of themselves: the cross compiler has the libraries.
described=(libc6 libgcc-s1 libstdc++6)

usage() {
  echo "usage: $0 arm64|armhf FOLDER" >&2
  exit 2
}
[ $# -eq 2 ] || usage
case $1 in
  arm64 | armhf) ;;
  *) usage ;;
esac
architecture=$1
sysroot=$2
stamp=$sysroot/debian/wanted
wanted=$(printf '%s\n' "$architecture" "${packages[@]}")

if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$wanted" ]; then
  exit 0
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$(dirname "${BASH_SOURCE[0]}")/debian_download.sh" "$architecture" "$work/debs" \
  "${packages[@]}" "${described[@]}"
mkdir "$work/described"
for package in "${described[@]}"; do
  mv "$work/debs/${package}"_*.deb "$work/described"
done

rm -rf "$sysroot"
mkdir -p "$sysroot/debian"
for deb in "$work"/debs/*.deb; do
  dpkg-deb -x "$deb" "$sysroot"
done
# As on an installed system: one folder of libraries, and links that stay within the sysroot. A link to a
# library that is not there (of aravis and glib the headers alone are wanted) could only mislead.
if [ -d "$sysroot/lib" ]; then
  cp -a "$sysroot/lib/." "$sysroot/usr/lib/"
  rm -r "$sysroot/lib"
fi
ln -s usr/lib "$sysroot/lib"
find "$sysroot/usr" -type l -lname '/*' -print0 | while IFS= read -r -d '' link; do
  ln -sfr "$sysroot$(readlink "$link")" "$link"
done
find "$sysroot/usr" -xtype l -delete

for deb in "$work"/{debs,described}/*.deb; do
  dpkg-deb -W --showformat '${Package}\t${Version}\t${source:Package}\n' "$deb" \
    >> "$work/packages.tsv"
  dpkg-deb -I "$deb" shlibs >> "$sysroot/debian/shlibs" 2> /dev/null || true
done
sort "$work/packages.tsv" > "$sysroot/debian/packages.tsv"
printf '%s\n' "$wanted" > "$stamp"
