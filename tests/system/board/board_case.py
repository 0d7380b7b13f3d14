"""What the tests of the emulated board share: a board for each test program, and its arguments.

Usage: PROGRAM_test.py [--times N] BUILD TUBESIGHT...

BUILD is the folder of the arm64 build; TUBESIGHT are programs that draw, of this machine first. All is done
N times, each time on a board that is powered on anew.
"""
import contextlib
import os
import pathlib
import shutil
import sys
import time
import unittest

from board_box import Box, Scenario


class BoardCase(unittest.TestCase):
    """Its tests share a board, and run in the order of their names."""

    build = None
    programs = ()
    more = {}  # arguments of the board

    @classmethod
    def setUpClass(cls):
        # One that a test left behind, killed, goes with the next run.
        cls.folder = cls.build / "board" / pathlib.Path(sys.argv[0]).stem
        shutil.rmtree(cls.folder, ignore_errors=True)
        cls.folder.mkdir(parents=True)
        cls.box = None
        try:
            cls.scenario = Scenario(cls.programs, cls.folder)
            cls.box = Box(cls.build, cls.folder, cls.scenario, **cls.arguments())
            cls.booted_s = cls.box.boot()
        except BaseException:
            cls.tearDownClass()
            raise

    @classmethod
    def tearDownClass(cls):
        if cls.box is not None:
            cls.box.close()
        shutil.rmtree(cls.folder, ignore_errors=True)

    @classmethod
    def arguments(cls):
        """Of the board, made in `cls.folder`."""
        return {}

    def setUp(self):
        self._begin = time.monotonic()

    def tearDown(self):
        print(f"{self.id().rpartition('.')[2]}: {time.monotonic() - self._begin:.1f} s", flush=True)

    def vouches_for(self, tube):
        """The box agrees with `tube` and contradicts its neighbour; the verdicts. At times it cannot say,
        as the emulated camera repeats a picture or leaves one out."""
        verdicts = []
        for claimed, wanted in ((tube, "AGREE"), ((tube[0] + 1, tube[1]), "DISAGREE")):
            for _ in range(10):
                verdicts.append(self.box.robot.claim(claimed))
                if verdicts[-1].word != "CANNOT SAY":
                    break
            self.assertEqual((verdicts[-1].word, verdicts[-1].seen), (wanted, tube),
                             f"{verdicts[-1]}\n{self.box.status()['text']}")
        return verdicts


def main():
    """Runs the tests of the program that calls it."""
    arguments = sys.argv[1:]
    times = 1
    if arguments[:1] == ["--times"]:
        times, arguments = int(arguments[1]), arguments[2:]
    if len(arguments) < 2:
        sys.exit(__doc__)
    BoardCase.build = pathlib.Path(arguments[0]).resolve()
    # Robot and emulator before all else, where that is allowed: beside a build both would be late.
    with contextlib.suppress(OSError):
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(1))
    emulated = [str(BoardCase.build / "bin" / "tubesight")]
    BoardCase.programs = [[each] for each in arguments[1:]] + [["qemu-aarch64-static", "-L",
                                                                "/usr/aarch64-linux-gnu", *emulated]]
    for _ in range(times):
        done = unittest.main(argv=sys.argv[:1], failfast=True, verbosity=0, exit=False)
        if not done.result.wasSuccessful():
            sys.exit(1)
