# What U-Boot runs, on the emulated board and on a Raspberry Pi alike: counts this boot, falls back to the
# other slot when three boots of one have not come to an answer, and starts the slot's kernel.
#
# The count stands outside all file systems, in two sectors that are written in turn, each with its
# checksum (the format of U-Boot's own environment): a power cut while one is written leaves the other.
# Linux reads and writes the same ones: files/usr/sbin/tubesight-slot.
setenv ts_tries_allowed 3

setexpr ts_copy1 ${scriptaddr} + 20000
setexpr ts_copy2 ${scriptaddr} + 20400
setexpr ts_new ${scriptaddr} + 20800
# 4 MiB and 8 MiB from the start, in units of 512 bytes: never in one erase block of a card.
setenv ts_sector1 2000
setenv ts_sector2 4000
${devtype} dev ${devnum}

setenv ts_serial 0
setenv ts_slot a
setenv ts_tries 0
setenv ts_bad_a 0
setenv ts_bad_b 0
setenv ts_proven_a 0
setenv ts_proven_b 0
setenv ts_serial1 0
setenv ts_serial2 0
${devtype} read ${ts_copy1} ${ts_sector1} 1
${devtype} read ${ts_copy2} ${ts_sector2} 1
if env import -c ${ts_copy1} 200; then setenv ts_serial1 ${ts_serial}; fi
if env import -c ${ts_copy2} 200; then setenv ts_serial2 ${ts_serial}; fi
if itest ${ts_serial1} -gt ${ts_serial2}; then
  env import -c ${ts_copy1} 200
  setenv ts_next ${ts_sector2}
else
  setenv ts_next ${ts_sector1}
fi

if itest ${ts_tries} -ge ${ts_tries_allowed}; then
  echo "tubesight: slot ${ts_slot} has not come to an answer ${ts_tries} times"
  setenv ts_bad_${ts_slot} 1
  if test ${ts_slot} = a; then setenv ts_slot b; else setenv ts_slot a; fi
  setenv ts_tries 0
fi
setexpr ts_tries ${ts_tries} + 1
setexpr ts_serial ${ts_serial} + 1
env export -c -s 200 ${ts_new} ts_serial ts_slot ts_tries ts_bad_a ts_bad_b ts_proven_a ts_proven_b
${devtype} write ${ts_new} ${ts_next} 1
echo "tubesight: slot ${ts_slot}, boot ${ts_tries} of ${ts_tries_allowed}"

setenv ts_fdt ${fdt_addr}
if test ${board} = rpi; then
  setenv ts_console "console=tty1"
  setenv ts_ramdisk 0x08000000
  # Out of the way of the kernel, wherever the firmware has put it.
  if fdt addr ${fdt_addr}; then
    fdt move ${fdt_addr} 0x07000000 40000
    setenv ts_fdt 0x07000000
  else
    setenv ts_fdt ${fdtcontroladdr}
  fi
else
  setenv ts_console "console=ttyAMA0"
  setenv ts_ramdisk ${ramdisk_addr_r}
fi
setenv bootargs "${ts_console} quiet loglevel=5 panic=10 tubesight.slot=${ts_slot} tubesight.boot=${ts_tries}"
if load ${devtype} ${devnum}:1 ${kernel_addr_r} ${ts_slot}/vmlinuz; then
  if load ${devtype} ${devnum}:1 ${ts_ramdisk} ${ts_slot}/initrd.img; then
    booti ${kernel_addr_r} ${ts_ramdisk}:${filesize} ${ts_fdt}
  fi
fi
echo "tubesight: slot ${ts_slot} has no kernel that starts"
sleep 2
reset
