#!/bin/sh
# The first program of the emulated board: loads the modules, mounts what the host shares, and does what the
# host says on the console, a line each: a word that is said again with the exit status, and a command.
/bin/busybox --install -s /bin
export PATH=/bin HOME=/root
mount -t proc proc /proc
mount -t sysfs sysfs /sys
mount -t devtmpfs dev /dev
mkdir -p /dev/pts /dev/shm
mount -t devpts devpts /dev/pts
mount -t tmpfs tmpfs /dev/shm
mount -t tmpfs tmpfs /tmp
mount -t tmpfs tmpfs /run
# Of module and parameters, unquoted on purpose.
while read -r module; do insmod $module || echo "board: cannot load $module"; done < /modules/order
mount -t 9p -o trans=virtio,version=9p2000.L,msize=262144 share /share 2> /dev/null
ip link set lo up
stty -F /dev/ttyAMA0 -echo -onlcr
echo "board: ready $(cut -d ' ' -f 1 /proc/uptime)"
while read -r word line; do
  sh -c "$line" < /dev/null
  echo "@$word $?"
done < /dev/ttyAMA0
poweroff -f
