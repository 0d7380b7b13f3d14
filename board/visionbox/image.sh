#!/usr/bin/env bash
# Builds the image that a vision box boots from: for a Raspberry Pi 4, 400 or Compute Module 4 and for the
# emulated board, the same one. docs/board.md tells how to flash it and what is on it.
#
# Usage: board/visionbox/image.sh [--package FILE.deb] [--refresh] OUT.img
#
# Without --package the box's package is built first (package.sh). Debian's packages are fetched once and
# kept below build/image, --refresh fetches them anew; so is the root, which is made again when what it
# consists of has changed. No root, no loop devices, no mounts: all is written into files.
set -euo pipefail

fail() {
  echo "$0: $1" >&2
  exit 1
}
usage() {
  echo "usage: $0 [--package FILE.deb] [--refresh] OUT.img" >&2
  exit 2
}
package=
refresh=no
while [ $# -gt 1 ]; do
  case $1 in
    --package) package=$(realpath "${2:-}") || usage; shift ;;
    --refresh) refresh=yes ;;
    *) usage ;;
  esac
  shift
done
case ${1:-} in '' | -*) usage ;; esac
out=$(realpath -m "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
here=board/visionbox/image
cache=${TUBESIGHT_IMAGE_CACHE:-build/image}
export PATH=$PATH:/usr/sbin:/sbin TZ=UTC
# The latest time that a file of the image bears. Of the recipe, not of any commit: the root is kept longer.
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git --no-optional-locks log -1 --format=%ct -- \
  board/visionbox/image board/visionbox/image.sh 2> /dev/null)}

# Where what begins, in MiB. Before the first partition stand the two copies of the boot count.
boot_at=16 boot_size=176
root_size=256
root_a_at=$((boot_at + boot_size))
root_b_at=$((root_a_at + root_size))
data_at=$((root_b_at + root_size)) data_size=96

if [ -n "$package" ]; then
  [ -f "$package" ] || fail "$package: no such package"
  is=$(dpkg-deb -W --showformat '${Package} ${Architecture}' "$package" 2> /dev/null || true)
  [ "$is" = "tubesight arm64" ] \
    || fail "$package: expected the package tubesight of arm64, found ${is:-no Debian package}"
fi
# A card's device is no place: it would be replaced by a file of that name.
[ ! -e "$out" ] || [ -f "$out" ] || fail "$out is no file; docs/board.md tells how an image gets onto a card"
[ -n "$SOURCE_DATE_EPOCH" ] \
  || fail "not a checkout with git; set SOURCE_DATE_EPOCH, the time that the image's files bear, in seconds since 1970"
scripts/install_packages.sh image
if [ -z "$package" ]; then
  board/visionbox/package.sh arm64 build/packages > /dev/null
  package=$(ls -t build/packages/tubesight_*_arm64.deb | head -n 1)
fi

# --- Debian's packages, and the kernel unpacked

packages() { sed -n 's/^\([a-z][^ #]*\).*/\1/p' "$here/root_packages.txt"; }
boot_packages=(linux-image-arm64/newest raspi-firmware u-boot-rpi u-boot-qemu e2fsck-static busybox-static)
wanted=$(packages; printf '%s\n' "${boot_packages[@]}")
mkdir -p "$cache"
exec 9> "$cache/lock"
flock 9
if [ $refresh = yes ] || [ "$(cat "$cache/packages.txt" 2> /dev/null)" != "$wanted" ]; then
  rm -rf "$cache"/{packages.txt,root_debs,boot_debs,boot}
  toolchain/debian_download.sh --component non-free-firmware arm64 "$cache/boot_debs" "${boot_packages[@]}" &
  boot_download=$!
  mapfile -t root_list < <(packages)
  toolchain/debian_download.sh --with-dependencies arm64 "$cache/root_debs" "${root_list[@]}"
  wait $boot_download || fail "the kernel and what boots it could not be fetched"
  for deb in "$cache"/boot_debs/*.deb; do
    dpkg-deb -x "$deb" "$cache/boot"
  done
  version=$(ls "$cache/boot/lib/modules")
  depmod -b "$cache/boot" "$version"
  printf '%s\n' "$wanted" > "$cache/packages.txt"
fi
version=$(ls "$cache/boot/lib/modules")

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# --- the root: a squashfs, by what it is made of

key=$({ (cd "$cache" && ls root_debs boot_debs); echo "$SOURCE_DATE_EPOCH"; sha256sum < "$package"
  find "$here"/{files,root_tar.py,select_modules.py,root_packages.txt,root_modules.txt} \
    board/visionbox/image.sh -type f | sort | xargs sha256sum; } | sha256sum | cut -c1-16)
root=$cache/root-$key.squashfs

# Copies the modules that a list of patterns names, with what they need, and indexes them.
select_modules() {
  local tree=$cache/boot/lib/modules/$version folder=$1
  mkdir -p "$folder/$version"
  tar -C "$tree" -cf - -T - | tar -xf - -C "$folder/$version"
  cp "$tree"/modules.{order,builtin,builtin.modinfo} "$folder/$version"
  mkdir -p "$folder/lib"
  ln -sfn .. "$folder/lib/modules"
  depmod -b "$folder" "$version"
  rm -r "$folder/lib"
}
# Of stdin's names of modules: these and what they need, as paths.
with_needed() {
  xargs -n 1 modprobe -d "$cache/boot" -S "$version" --show-depends \
    | sed -n "s,^insmod .*/modules/$version/\([^ ]*\).*,\1,p" | sort -u
}

if [ ! -f "$root" ]; then
  python3 -B "$here/select_modules.py" "$here/root_modules.txt" "$cache/boot/lib/modules/$version" \
    | select_modules "$work/modules"
  mapfile -t debs < <(ls "$cache"/root_debs/*.deb)
  python3 -B "$here/root_tar.py" "$work/root.tar" "$SOURCE_DATE_EPOCH" "$here/files" "$work/modules" \
    "$here/root_packages.txt" "${debs[@]}" "$package"
  rm -f "$cache"/root-*.squashfs
  # zstd: a card gives 20 to 40 MB a second and the processor unpacks more than that; with lz4 half as much
  # again would have to be read.
  mksquashfs - "$work/root.squashfs" -tar -quiet -no-progress -noappend \
    -b 256K -comp zstd -Xcompression-level 9 < "$work/root.tar" > "$work/log" 2>&1 \
    || fail "the root could not be packed: $(tail -n 3 "$work/log")"
  mv "$work/root.squashfs" "$root"
fi
[ "$(stat -c %s "$root")" -le $((root_size * 1024 * 1024)) ] || fail "the root is larger than its slot, $root_size MiB"

# --- the initramfs

initramfs=$work/initramfs
mkdir -p "$initramfs"/{bin,dev,proc,sys,run,tmp,lib/modules}
cp "$here"/initramfs/* "$initramfs"
cp "$cache/boot/bin/busybox" "$cache/boot/sbin/e2fsck.static" "$initramfs/bin"
mv "$initramfs/bin/e2fsck.static" "$initramfs/bin/e2fsck"
grep -oE '^[a-z0-9][^ #]*' "$here/initramfs_modules.txt" | with_needed | select_modules "$initramfs/lib/modules"
python3 -B "$here/write_cpio.py" "$initramfs" | gzip -9n > "$work/initrd.img"

# --- the boot partition

mkdir -p "$work/fat"/{a,b}
for slot in a b; do
  cp "$cache/boot/boot/vmlinuz-$version" "$work/fat/$slot/vmlinuz"
  cp "$work/initrd.img" "$work/fat/$slot/initrd.img"
done
mkimage -A arm64 -T script -C none -n tubesight -d "$here/boot.cmd" "$work/fat/boot.scr" > /dev/null
cp "$cache"/boot/usr/lib/raspi-firmware/{start4.elf,fixup4.dat} "$work/fat"
cp "$cache"/boot/usr/lib/linux-image-"$version"/broadcom/bcm2711-rpi-*.dtb "$work/fat"
cp "$cache/boot/usr/lib/u-boot/rpi_arm64/u-boot.bin" "$here/config.txt" "$work/fat"
sed 's/$/\r/' "$here/tubesight.txt" > "$work/fat/tubesight.txt"

# --- all in one file, which appears when it is whole

image=$work/image
truncate -s $((data_at + data_size))M "$image"
sfdisk --quiet "$image" << TABLE
label: dos
label-id: 0x65627574
start=${boot_at}MiB, size=${boot_size}MiB, type=c, bootable
start=${root_a_at}MiB, size=${root_size}MiB, type=83
start=${root_b_at}MiB, size=${root_size}MiB, type=83
start=${data_at}MiB, size=${data_size}MiB, type=83
TABLE
truncate -s ${boot_size}M "$work/boot.fat"
mkfs.vfat -F 32 -n TUBESIGHT --invariant "$work/boot.fat" > /dev/null
find "$work/fat" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
mcopy -Q -m -s -i "$work/boot.fat" "$work"/fat/* ::
put() { dd if="$1" of="$image" bs=1M seek="$2" conv=notrunc,sparse status=none; }
put "$work/boot.fat" $boot_at
put "$root" $root_a_at
put "$root" $root_b_at
# Nothing is left for the kernel to write later in its own time, and the image stays the same. Blocks and
# inodes as of the card that it grows to.
E2FSPROGS_FAKE_TIME=$SOURCE_DATE_EPOCH mke2fs -q -t ext4 -L tubesight-data -m 1 \
  -b 4096 -I 256 -i 16384 \
  -U 74756265-7369-6768-7400-000000000001 \
  -E "hash_seed=74756265-7369-6768-7400-000000000002,lazy_itable_init=0,lazy_journal_init=0,offset=$((data_at * 1048576))" \
  "$image" ${data_size}M
mkdir "$work/board"
echo "$image" > "$work/board/disk"
for slot in b a; do
  echo $slot > "$work/board/slot"
  TUBESIGHT_BOARD=$work/board sh "$here/files/usr/sbin/tubesight-slot" good
done
mkdir -p "$(dirname "$out")"
cp --sparse=always "$image" "$out.part"
mv "$out.part" "$out"
# What the emulated board has in the place of a Raspberry Pi's firmware.
cp "$cache/boot/usr/lib/u-boot/qemu_arm64/u-boot.bin" "$cache/u-boot-emulated.bin"
echo "$out: $(du -h --apparent-size "$out" | cut -f1), root $(du -h "$root" | cut -f1), kernel $version"
