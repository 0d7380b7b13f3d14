#!/usr/bin/python3
"""A robot program for the first run: starts the box over its link, and asks it.

Usage: robot.py LINE SECONDS [RATE]

LINE is the box's address and port, "127.0.0.1:1502", or a serial line, "/dev/ttyUSB0,19200,E" with baud
and parity (these are the defaults; N: none). In turn the program claims the tube that the box reports
and a wrong one beside it, RATE times a second, 20 by default. It needs Debian's python3-pymodbus.

Of what the document of the link asks of a robot it has what none can do without: it looks at map and
mark, the boot number and the bits that say what is known, and takes a verdict only with its own claim.
"""
import itertools
import sys
import time

from pymodbus.client import ModbusSerialClient, ModbusTcpClient

UNIT = 1
# Row, column and a place in the picture, in 1/1000 px, of steam-generator.toml in its first 10 s. Later
# other tubes stand there and look the same: whoever starts the box must know where the tool is.
START = [(40, 60, 307000, 195000), (41, 60, 314000, 262000), (40, 59, 217000, 199000)]
VERDICTS = {0: "NONE", 1: "AGREE", 2: "DISAGREE", 3: "CANNOT SAY"}


def words(*numbers):
    """Numbers of 32 bits as registers, the high word first."""
    return [half for number in numbers for half in (number >> 16 & 0xFFFF, number & 0xFFFF)]


def number(registers, at):
    value = registers[at] << 16 | registers[at + 1]
    return value - (1 << 32) if value >= 1 << 31 else value


def connect(line):
    if line.startswith("/"):
        device, baud, parity = (line.split(",") + ["19200", "E"][line.count(","):])[:3]
        master = ModbusSerialClient(device, baudrate=int(baud), parity=parity, timeout=1)
    else:
        host, port = line.split(":")
        master = ModbusTcpClient(host, port=int(port), timeout=1)
    if not master.connect():
        sys.exit(f"{line} cannot be reached")
    return master


def read(master, first, count):
    answer = master.read_holding_registers(first, count, slave=UNIT)
    if answer.isError():
        sys.exit(f"registers from {first}: {answer}")
    return answer.registers


def write(master, first, registers):
    answer = master.write_registers(first, registers, slave=UNIT)
    if answer.isError():
        sys.exit(f"registers from {first}: {answer}")


def sighting(master):
    """The tube nearest to the guidetube, whether the box vouches for it, and the boot number."""
    got = read(master, 100, 52)
    valid = got[4]
    tube = (number(got, 22), number(got, 24)) if valid & 1 << 4 else None
    return tube, valid & 1 and got[45] == 1, number(got, 2)


def start(master, tubes=START):
    """Names three tubes; the reason of the refusal, 0 when the box tracks."""
    write(master, 332, words(*itertools.chain(*tubes)))
    write(master, 320, [1])
    for _ in range(100):
        result = read(master, 400, 6)
        if result[0] & 1:
            break
        time.sleep(0.01)
    write(master, 320, [0])
    return result[5] if result[4] else -1


def claim(master, claim_id, tube, boot):
    """Writes the block claim and reads the block verdict in one transaction, function 23."""
    answer = master.readwrite_registers(
        read_address=200, read_count=24, write_address=300, unit=UNIT,
        write_registers=words(claim_id, *tube) + [0, 1])
    if answer.isError():
        return "NO ANSWER", None, -1
    got = answer.registers
    echo = number(got, 2), number(got, 8), number(got, 10), number(got, 12)
    if not got[4] & 1 or echo != (boot, claim_id, *tube):
        return "OF ANOTHER CLAIM", None, -1
    named = (number(got, 14), number(got, 16)) if got[4] & 2 else None
    return VERDICTS[got[5]], named, number(got, 18)


def text(tube):
    return f"{tube[0]},{tube[1]}" if tube else "-"


def main(line, seconds, rate=20.0):
    master = connect(line)
    version, _, *mark = read(master, 0, 4)
    if mark != words(0x01020304) or version != 1:
        sys.exit(f"another map or another order of the words: {version}, {mark}")
    tube, vouched, boot = sighting(master)
    print(f"boot {boot}, tube {text(tube)}, {'' if vouched else 'not '}vouched for")
    refused = start(master)
    print(f"start {'taken' if refused == 0 else f'refused, reason {refused}'}", flush=True)
    begin = time.monotonic()
    for i in range(int(seconds * rate)):
        time.sleep(max(0.0, begin + i / rate - time.monotonic()))
        tube = sighting(master)[0] or START[0][:2]
        claimed = tube if i % 2 == 0 else (tube[0] + 1, tube[1])
        verdict, named, field = claim(master, i + 1, claimed, boot)
        print(f"{text(claimed)} {verdict} tube {text(named)} field {field}", flush=True)
    health = read(master, 500, 42)
    print(f"fields {number(health, 6)}, missing {number(health, 8)}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], *map(float, sys.argv[2:]))
