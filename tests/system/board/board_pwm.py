"""A PWM for the emulated board: the Raspberry Pi's own driver of the kernel on registers that are a page of
memory, which the host reads. It shows what the driver was told, not a waveform."""
import re

from board_machine import MACHINE
from board_parts import run

MEMORY_MB = 1024
CLOCK_HZ = 9_600_000
_BASE = 0x40000000 + MEMORY_MB * 1024 * 1024 - 0x10000  # the last page that there is
CHIP = f"{_BASE:x}.pwm"
_NODES = f"""
  reserved-memory {{ #address-cells = <2>; #size-cells = <2>; ranges;
    pwmregs@{_BASE:x} {{ reg = <0 0x{_BASE:x} 0 0x10000>; no-map; }}; }};
  pwmclk: pwmclk {{ compatible = "fixed-clock"; #clock-cells = <0>; clock-frequency = <{CLOCK_HZ}>; }};
  pwm@{_BASE:x} {{ compatible = "brcm,bcm2835-pwm"; reg = <0 0x{_BASE:x} 0 0x1000>;
    clocks = <&pwmclk>; #pwm-cells = <3>; }};
"""


def device_tree(folder):
    """The machine's own device tree with the PWM in it; for a board of MEMORY_MB alone."""
    plain, text, changed = (folder / name for name in ("virt.dtb", "virt.dts", "pwm.dtb"))
    run("qemu-system-aarch64", *MACHINE[:1], f"{MACHINE[1]},dumpdtb={plain}", *MACHINE[2:],
        "-m", str(MEMORY_MB), "-nographic", "-nodefaults")
    run("dtc", "-q", "-I", "dtb", "-O", "dts", "-o", text, plain)
    source = text.read_text(encoding="ascii")
    end = source.rindex("};")
    text.write_text(source[:end] + _NODES + source[end:], encoding="ascii")
    run("dtc", "-q", "-I", "dts", "-O", "dtb", "-o", changed, text)
    return changed


def registers(board):
    """Whether the channel is on, its period and its lit part, in ticks of the clock."""
    said = board.monitor(f"xp /8xw 0x{_BASE:x}")
    values = [int(value, 16) for line in said.splitlines()
              for value in re.findall(r"0x[0-9a-f]+", line.partition(":")[2])]
    return bool(values[0] & 1), values[4], values[5]
