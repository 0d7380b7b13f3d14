#!/usr/bin/env python3
"""The tool's error behind four ways to calibrate a robot's base, in simulation (docs/accuracy.md).

Usage: base_accuracy.py PROGRAM SETTINGS [ROBOTS] | base_accuracy.py --self-test

Runs `tubesight budget SETTINGS` on ROBOTS robots, 200 by default, and tells its tables. Exit status 1
unless vision is better than the skilled operator with the special tool at every distance from the base.
"""
import re
import subprocess
import sys

VISION = "vision"
OPERATOR = "touch, skilled, special tool"


def rows_across(text):
    """Name of a way: RMS at each distance, of the table of errors across the tubes."""
    table = text[text.index("\n  across, at mm"):text.index("\n  along\n")]
    rows = {}
    for line in table.splitlines()[2:]:
        name = re.split(r"\s{2,}\d", line.strip())[0]
        rows[name] = [float(value) for value in re.findall(r"(\d+\.\d+) \(", line)]
    return rows


def worse(rows):
    """Distances, by number, at which vision is no better."""
    assert len(rows[VISION]) == len(rows[OPERATOR]) > 0
    return [i for i, (a, b) in enumerate(zip(rows[VISION], rows[OPERATOR])) if a >= b]


def main(program, settings, robots="200"):
    done = subprocess.run([program, "budget", settings, "--robots", robots], capture_output=True,
                          text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr.strip())
    print(done.stdout, end="")
    bad = worse(rows_across(done.stdout))
    print(f"vision better than '{OPERATOR}' at every distance: {'no' if bad else 'yes'}")
    return 1 if bad else 0


def self_test():
    text = ("tool's error\n  across, at mm from the base   400   700\n"
            "  vision                            0.55 (0.99)  0.50 (0.87)\n"
            "  touch, skilled, special tool      0.63 (1.03)  0.57 (0.91)\n  along\n  vision 1\n")
    rows = rows_across(text)
    assert rows == {VISION: [0.55, 0.50], OPERATOR: [0.63, 0.57]}, rows
    assert worse(rows) == []
    rows[VISION][1] = 0.57
    assert worse(rows) == [1]
    print("base_accuracy: self-test passed")
    return 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(self_test())
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
