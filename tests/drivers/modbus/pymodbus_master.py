"""A foreign master for the robot's link: asks by pymodbus and prints what it was told.

Usage: pymodbus_master.py DEVICE CLAIMS
"""
import sys
import time

from pymodbus.client import ModbusSerialClient

UNIT = 17


def words(value):
    """A number of 32 bits as two registers, high word first."""
    return [value >> 16 & 0xFFFF, value & 0xFFFF]


def number(registers, at):
    value = registers[at] << 16 | registers[at + 1]
    return value - (1 << 32) if value >= 1 << 31 else value


def claim(master, claim_id, row, column):
    """Function 23: the block claim written, the block verdict read."""
    answer = master.readwrite_registers(
        read_address=200, read_count=24, write_address=300, unit=UNIT,
        write_registers=words(claim_id) + words(row) + words(column) + [0, 1])
    got = answer.registers
    return got[5], number(got, 8), number(got, 10), number(got, 12)


def main(device, claims):
    master = ModbusSerialClient(device, baudrate=115200, parity="N", timeout=1)
    assert master.connect()
    print("mark", master.read_holding_registers(2, 2, slave=UNIT).registers)
    print("input", master.read_input_registers(2, 2, slave=UNIT).registers)
    got = master.read_holding_registers(100, 52, slave=UNIT).registers
    print("sighting", got[4], number(got, 22), number(got, 24), number(got, 26))
    print("verdict", *claim(master, 4711, 12, -7))
    print("verdict", *claim(master, 4712, 12, -8))
    written = master.write_register(330, 640, slave=UNIT)
    print("one", written.address, written.value)
    written = master.write_registers(300, words(5) + words(12) + words(-7) + [0, 1], slave=UNIT)
    print("many", written.address, written.count)
    time.sleep(0.1)
    got = master.read_holding_registers(200, 24, slave=UNIT).registers
    print("two steps", got[5], number(got, 8))
    print("exception", master.read_holding_registers(99, 1, slave=UNIT).exception_code)
    print("exception", master.write_register(330, 1001, slave=UNIT).exception_code)
    wrong = 0
    for i in range(claims):
        begin = time.monotonic()
        wrong += claim(master, i, 12, -7) != (1, i, 12, -7)
        wrong += claim(master, i, 9, -7) != (2, i, 9, -7)
        time.sleep(max(0.0, 0.1 - (time.monotonic() - begin)))
    print("wrong", wrong)


main(sys.argv[1], int(sys.argv[2]))
