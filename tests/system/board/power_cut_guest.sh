#!/bin/sh
# On the emulated board: has the product write to the disk until the power goes, and marks behind the file system
# what it said to be written, by whoever said so: a program's status 0, an answer, a counter.
#
# Usage: power_cut_guest.sh FIRST [LIBRARY]
#        FIRST: the 4 KiB block of the disk at which the marks begin; LIBRARY: put before the C library of the
#        product
#
# A mark goes past the page cache, so that it is on the disk in the order in which things were said.
first=$1
export LD_PRELOAD="${2:-}"
data=/data
cd /tmp || exit 1

mark() { # SLOT TEXT
  printf '%-4095s\n' "$2" | dd of=/dev/vda bs=4096 count=1 seek=$((first + $1)) oflag=direct conv=notrunc 2> /dev/null \
    || echo "writer: no mark $2"
}

said() { # FILE COMMAND...
  out=$1.out
  shift
  "$@" > "$out" 2>&1 && return
  echo "writer: failed: $*"
  cat "$out"
  return 1
}

said_by() { # BOX; it runs to the power cut
  tubesightd "/share/$1.toml"
  echo "writer: failed: the box $1, status $?"
}

rows_of() { # rows behind the header; none where there is no file
  [ -f "$1" ] && echo $(($(wc -l < "$1") - 1)) || echo 0
}

# Corrections by zones: each has a row more than the one before.
zones() {
  header=name,robot_x_mm,robot_y_mm,robot_z_mm,robot_alpha_deg,robot_beta_deg,robot_gamma_deg
  header=$header,tool_x_mm,tool_y_mm,tool_z_mm,tool_alpha_deg,tool_beta_deg,tool_gamma_deg
  header=$header,sigma_x_mm,sigma_y_mm,sigma_z_mm,use
  n=$(rows_of $data/zones.csv)
  mark 0 "zones $n"
  while [ "$n" -lt 60 ]; do
    x=$(((n % 8) * 150 - 600))
    y=$(((n / 8) * 150 - 600))
    printf '%s\nz%d,%d,%d,970,,,,%d,%d,-30,,,,,,,1\n' "$header" "$n" "$x" "$y" "$x" "$y" > zone.csv
    said zones tubesight calibrate zones zone.csv --base /share/base.toml --out $data/zones.csv || return
    n=$((n + 1))
    mark 0 "zones $n"
  done
}

# A base: each is a millimetre deeper than the one before. The version is the depth below 1 m.
base() {
  n=0
  if [ -f $data/base.toml ]; then
    depth=$(sed -n 's/^position_mm = \[.*, -\([0-9.]*\)\]$/\1/p' $data/base.toml)
    n=$(printf '%.0f' "$depth")
    n=$((n - 1000))
  fi
  mark 1 "base $n"
  while true; do
    n=$((n + 1))
    sed "s/DEPTH/$((970 + n))/" /share/base_pairs.csv > pairs.csv
    said base tubesight calibrate base pairs.csv --sheet /share/tiny.session.toml \
      --out $data/base.toml || return
    mark 1 "base $n"
  done
}

# Recordings are numbered by the box.
recordings() {
  said_by recorder &
  while true; do
    said=$(tubesightctl --socket /run/recorder/box record 2>&1) || { echo "writer: $said"; sleep 0.5; continue; }
    name=${said##*/box-}
    mark 2 "recording ${name%%-*}"
  done
}

# The box counts the pairs that it wrote since its start.
pairs() {
  before=$(rows_of $data/pairs.csv)
  said_by pairs &
  last=-1
  while true; do
    said=$(tubesightctl --socket /run/pairs/box status 2> /dev/null | sed -n 's/^pairs .*, \([0-9]*\) written.*/\1/p')
    if [ -z "$said" ] || [ "$said" = "$last" ]; then
      sleep 0.05
      continue
    fi
    last=$said
    mark 3 "pairs $((before + said))"
  done
}

mkdir -p $data /run/recorder /run/pairs
mount -t ext4 /dev/vda $data || exit 1
echo "writer: mounted"
for what in zones base recordings pairs; do
  $what &
done
wait
