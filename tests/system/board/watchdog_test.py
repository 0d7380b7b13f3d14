"""The hardware watchdog on the emulated board: the kernel's softdog, /dev/watchdog, fed by the box alone.

Usage: watchdog_test.py BUILD

BUILD is the folder of the arm64 build. The board's clock goes by instructions, and leaps where the board has
nothing to do: its seconds are exact on a busy PC, and most of them cost none. Between two commands any time may
pass on it, so what is timed is one command.
"""
import json
import pathlib
import re
import shutil
import sys
import time
import unittest

import board_parts
from board_box import SOCKET, programs
from board_machine import Board

CLOCK = ("-icount", "shift=1,sleep=off")
TIMEOUT_S = 10  # the least that the settings allow
LONG_S = 25
# Fields are judged for longer than the time-out; then none come, which is told field by field. To draw them is
# what costs time here: they are few, which the box takes of a slow tool only.
PICTURES_S = 12
FIELDS_PER_S = 8
SLOW = f"""[video]
rate_hz = {FIELDS_PER_S // 2}
window_margin_px = 24

[motion]
max_speed_mm_s = 35

"""
EXAMPLE = board_parts.ROOT / "docs" / "examples" / "steam-generator.toml"
SETTINGS = f"""format = 1

[source]
kind = "simulated"
scenario = "scenario.toml"
at_end = "end"
script = true

[control]
socket = "{SOCKET}"

[watchdog]
device = "/dev/watchdog"
timeout_s = {TIMEOUT_S}
"""
START = "setsid tubesightd /etc/box.toml > /tmp/said 2>&1 &"
ARMED = f"resets the machine {TIMEOUT_S} s after the box stands still"
UPTIME = "cut -d ' ' -f 1 /proc/uptime"


class Watchdog(unittest.TestCase):
    """Each test has a board of its own."""

    build = None

    @classmethod
    def setUpClass(cls):
        cls.folder = cls.build / "board" / "watchdog_test"
        shutil.rmtree(cls.folder, ignore_errors=True)
        cls.folder.mkdir(parents=True)
        settings, scenario = cls.folder / "box.toml", cls.folder / "scenario.toml"
        settings.write_text(SETTINGS, encoding="ascii")
        begin = EXAMPLE.read_text(encoding="ascii").partition("[[step]]")[0]
        scenario.write_text(f"{begin}{SLOW}[[step]]\nrest_s = {PICTURES_S}\n", encoding="ascii")
        cls.initramfs = board_parts.initramfs(
            cls.folder / "initramfs", ("softdog",),
            {"etc/box.toml": settings, "etc/scenario.toml": scenario}
            | programs(cls.build, cls.folder, "tubesightd", "tubesightctl"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder, ignore_errors=True)

    def setUp(self):
        self._begin = time.monotonic()
        # With what the kernel says of a watchdog that resets.
        self.board = Board(initramfs=self.initramfs, append="loglevel=3", arguments=CLOCK)
        self.addCleanup(self.board.close)
        self.board.boot()

    def tearDown(self):
        print(f"{self.id().rpartition('.')[2]}: {time.monotonic() - self._begin:.1f} s", flush=True)

    def start_daemon(self):
        self.board.do(START)
        self.wait_armed()

    def wait_armed(self):
        """The box has come round and opened its watchdog."""
        self.board.do(f"for i in $(seq 200); do grep -q '{ARMED}' /tmp/said && exit 0; sleep 0.1; done;"
                      " cat /tmp/said; exit 1", 60.0)

    def resets(self, command):
        """After the command the watchdog, and nothing else, resets the board; the emulator ends with it."""
        begin = len(self.board.console)
        self.board.type(f"word {command}; while {UPTIME}; do sleep 0.1; done\n")
        self.board.wait_off(120.0)
        said = self.board.console[begin:]
        times = [float(each) for each in re.findall(r"^(\d+\.\d+)$", said, re.M)]
        self.assertIn("softdog: Initiating system reboot", said)
        # The last meal was up to 0.2 s before the command.
        self.assertGreater(times[-1] - times[0], TIMEOUT_S - 1.0, said)
        self.assertLess(times[-1] - times[0], TIMEOUT_S + 1.0, said)

    def test_1_a_sound_box_keeps_the_board_up_and_one_that_stands_still_does_not(self):
        self.start_daemon()
        self.board.do(f"sleep {LONG_S}", 120.0)
        status = json.loads(self.board.do(f"tubesightctl --socket {SOCKET} status --json"))
        self.assertGreater(status["tracking"]["judged_fields"], FIELDS_PER_S * (TIMEOUT_S + 1), status)
        self.assertGreater(status["counters"]["missing"], FIELDS_PER_S * (TIMEOUT_S + 1), status)
        self.assertEqual(status["supervision"]["watchdog"],
                         {"there": True, "device": "/dev/watchdog", "armed": True, "timeout_s": TIMEOUT_S,
                          "trouble": ""})
        self.assertNotIn("not fed", self.board.do("cat /tmp/said"))
        self.resets("killall -STOP tubesightd")

    def test_2_a_stop_disarms_it_and_a_kill_leaves_it_to_the_next_box(self):
        self.board.do("sed -i 's/^rest_s.*/rest_s = 1/' /etc/scenario.toml")
        self.start_daemon()
        self.board.do("killall tubesightd; while pidof tubesightd > /dev/null; do sleep 0.1; done;"
                      f" sleep {LONG_S}")
        self.assertNotIn("did not stop", self.board.console)
        self.start_daemon()
        self.board.do(f"killall -KILL tubesightd; {START} sleep {LONG_S}", 120.0)
        self.assertIn("watchdog did not stop", self.board.console)
        self.wait_armed()
        self.resets("killall -KILL tubesightd")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    Watchdog.build = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=sys.argv[:1], verbosity=0)
