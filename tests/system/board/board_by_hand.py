#!/usr/bin/env python3
"""Boots the emulated board with the box and a camera that shows the drawn scenario, and takes commands.

Usage: board_by_hand.py [BUILD [TUBESIGHT]]

BUILD is the arm64 build, build/visionbox-qemu by default; TUBESIGHT draws, build/bench/bin/tubesight. Each line
is run by the board's shell; `next` moves the tool on to the next station, an empty line powers off.
"""
import pathlib
import sys
import tempfile

from board_box import SOCKET, Box, Scenario
from board_parts import ROOT, BoardError


def main(build=ROOT / "build" / "visionbox-qemu", program=ROOT / "build" / "bench" / "bin" / "tubesight"):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scenario = Scenario([[str(program)]], folder)
        box = Box(pathlib.Path(build).resolve(), folder, scenario)
        try:
            print(f"booted after {box.boot():.1f} s; {box.share} is /share on the board")
            box.play()
            box.start_daemon()
            print(f"the robot's line: {box.board.robot}, 115200 baud, no parity, unit 17\n"
                  f"the box: tubesightctl --socket {SOCKET} status\nits clicks: "
                  + ";".join(f"{r},{c},{u / 1000:g},{v / 1000:g}" for r, c, u, v in scenario.clicks))
            while line := input("board> ").strip():
                if line == "next":
                    box.go_on()
                    continue
                status, text = box.board.run(line, 3600.0)
                print(text + (f"(exit status {status})" if status else ""))
        except EOFError:
            pass
        finally:
            box.close()


if __name__ == "__main__":
    if len(sys.argv) > 3 or "--help" in sys.argv:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (BoardError, KeyboardInterrupt) as error:
        sys.exit(f"{sys.argv[0]}: {error or 'ended'}")
