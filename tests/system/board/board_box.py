"""The vision box on the emulated board: the product built for arm64, a camera that plays a drawn scenario, and
a robot at the host's end of the serial line, by mbpoll, a foreign master."""
import csv
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import subprocess
import termios
import time

import board_parts
from board_machine import Board
from board_parts import BoardError, tool

HERE = pathlib.Path(__file__).parent
# Two nodes, S-Video in and out, one plane. The daemon's settings loop one to the other.
VIVID = ("vivid n_devs=1 node_types=0x101 num_inputs=1 input_types=0x2 num_outputs=1"
         " output_types=0x0 multiplanar=1")
CAMERA, SCREEN = "/dev/video0", "/dev/video1"
SOCKET = "/run/tubesight"
BAUD, UNIT = 115200, 17
WIDTH_PX, HEIGHT_PX = 720, 480

SETTINGS = """format = 1
include = ["r.session.toml"]

[source]
kind = "v4l2"
device = "bus:platform:vivid-000"
format = "GREY"
fields = "interlaced"
standard = "NTSC"
controls = ["Loop Video = 1", "OSD Text Mode = None"]

[control]
socket = "/run/tubesight"

[link]
kind = "modbus"
device = "/dev/ttyS0"
baud = 115200
parity = "none"
unit = 17
"""


# The scenario

class Scenario:
    """What is drawn for the camera, and what is true of it. At each station the tool rests for a second."""

    def __init__(self, programs, folder):
        """`programs`: commands that run `tubesight`, best first; the first that there is draws."""
        program = next((each for each in programs if pathlib.Path(each[-1]).exists()), None)
        if program is None:
            raise BoardError("there is no tubesight to draw the scenario, expected one of "
                             + " ".join(each[-1] for each in programs))
        source = HERE / "round.toml"
        done = subprocess.run([*program, "simulate", source, "--out", folder / "r"],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=240)
        if done.returncode != 0:
            raise BoardError(f"{source.name} was not drawn: {done.stderr}")
        with open(folder / "r.truth.csv", encoding="ascii") as file:
            self.truth = list(csv.DictReader(file))
        self.picture = folder / "r.y4m"
        session = (folder / "r.session.toml").read_text(encoding="utf-8")
        self.clicks = [(int(row), int(column), round(1000 * float(u)), round(1000 * float(v)))
                       for row, column, u, v in re.findall(
                           r"row = (\d+), column = (\d+), at_px = \[([\d.]+), ([\d.]+)\]", session)]
        self.fields = self._digests()

    def tube(self, field):
        """The tube nearest to the guidetube in a field of the scenario."""
        row = self.truth[field]
        return int(row["near_row"]), int(row["near_col"])

    @property
    def stations(self):
        """[(first frame, last frame, tube)] of each rest, in order."""
        found = []
        for frame in range(len(self.truth) // 2):
            if all(float(self.truth[2 * frame + k]["speed"]) < 0.01 for k in (0, 1)):
                tube = self.tube(2 * frame)
                if found and found[-1][1] == frame - 1 and found[-1][2] == tube:
                    found[-1] = (found[-1][0], frame, tube)
                else:
                    found.append((frame, frame, tube))
        return [each for each in found if each[1] - each[0] >= 5]

    def _digests(self):
        """{digest of a field's pixels: its number}: noise makes each another one."""
        found = {}
        for frame, picture in enumerate(frames(self.picture)):
            for later in (0, 1):
                found[digest(picture, later)] = 2 * frame + later
        return found


def frames(path):
    """The pictures of a grey recording."""
    with open(path, "rb") as file:
        file.readline()
        while file.readline():
            yield file.read(WIDTH_PX * HEIGHT_PX)


def digest(picture, later):
    """Of the pixels of a frame's first or later field; the first one has the odd lines, as NTSC has it."""
    lines = range(1 - later, HEIGHT_PX, 2)
    pixels = b"".join(picture[y * WIDTH_PX:(y + 1) * WIDTH_PX] for y in lines)
    return hashlib.sha256(pixels).digest()


# The robot

def words(*numbers):
    """Numbers of 32 bits as registers, the high word first."""
    return [half for number in numbers for half in (number >> 16 & 0xFFFF, number & 0xFFFF)]


def number(registers, at):
    value = registers[at] << 16 | registers[at + 1]
    return value - (1 << 32) if value >= 1 << 31 else value


@dataclasses.dataclass
class Sighting:
    sequence: int
    boot: int
    state: int
    reason: int
    judged: int
    field: int
    tube: tuple  # None: not known
    vouched: bool


@dataclasses.dataclass
class Verdict:
    claimed: tuple
    word: str
    reason: int
    seen: tuple
    field: int


VERDICTS = {0: "NONE", 1: "AGREE", 2: "DISAGREE", 3: "CANNOT SAY"}
WAITING, TRACKING, DEGRADED, LOST = 1, 2, 3, 4


class Robot:
    """The master of the line. It is held open: the emulator looks for a new listener once a second only."""

    def __init__(self, line):
        self._line = line
        self._hold = None
        self._claims = 0
        self.plug_in()

    def plug_in(self):
        self._hold = os.open(self._line, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)

    def pull_out(self):
        os.close(self._hold)
        self._hold = None

    def say(self, noise):
        """Bytes that are no request."""
        os.write(self._hold, noise)

    def _ask(self, *arguments, tries, wait_s=5):
        for left in reversed(range(tries)):
            if self._hold is not None:
                termios.tcflush(self._hold, termios.TCIOFLUSH)
            done = subprocess.run(
                [tool("mbpoll"), "-m", "rtu", "-b", str(BAUD), "-P", "none", "-a", str(UNIT), "-0",
                 "-1", "-q", "-o", str(wait_s), "-t", "4", *map(str, arguments)],
                stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=20)
            if done.returncode == 0:
                return done.stdout
            if left == 0:
                raise BoardError(f"mbpoll {' '.join(map(str, arguments))}: {done.stderr.strip()}")
        return None

    def read(self, first, count, tries=2, wait_s=5):
        text = self._ask("-r", first, "-c", count, self._line, tries=tries, wait_s=wait_s)
        found = {int(at): int(value) for at, value in re.findall(r"^\[(\d+)\]:\s*(\d+)", text, re.M)}
        if sorted(found) != list(range(first, first + count)):
            raise BoardError(f"registers from {first}: {text}")
        return [found[at] for at in range(first, first + count)]

    def write(self, first, values, tries=1):
        self._ask("-r", first, self._line, "--", *values, tries=tries)

    def answers(self, seconds):
        """The seconds until the box answers."""
        begin = time.monotonic()
        while True:
            try:
                if self.read(0, 4, tries=1, wait_s=1)[2:] == [0x0102, 0x0304]:
                    return time.monotonic() - begin
            except BoardError:
                if time.monotonic() - begin > seconds:
                    raise

    def sighting(self):
        got = self.read(100, 52)
        known = got[4] & 1 << 4
        return Sighting(number(got, 0), number(got, 2), got[5], got[6], number(got, 8), number(got, 12),
                        (number(got, 22), number(got, 24)) if known else None,
                        bool(got[4] & 1 and got[45] == 1))

    def _command(self, bit, block, result):
        """The registers of the result of one command; a refusal is one, too."""
        self.write(320, [bit, *block])
        for _ in range(40):
            got = self.read(400, 24)
            if got[0] & bit:
                break
        self.write(320, [0])
        if not got[0] & bit:
            raise BoardError(f"command {bit} got no result: {got}")
        return got[result], got[result + 1]

    def start(self, clicks):
        """(1, 0): taken; else 2 and the reason."""
        self.write(332, words(*[value for click in clicks for value in click]))
        return self._command(1, [], 4)

    def light(self, permille):
        """The level taken."""
        self.write(330, [permille, 1])
        done, level = self._command(4, [], 20)
        if done != 1:
            raise BoardError(f"the lamp was not taken: {done}")
        return level

    def claim(self, tube):
        self._claims += 1
        self.write(300, words(self._claims, *tube) + [0, 1])
        for _ in range(20):
            got = self.read(200, 24)
            if not got[4] & 4:
                break
        if [number(got, at) for at in (8, 10, 12)] != [self._claims, *tube]:
            raise BoardError(f"claim {self._claims} got the answer of another one: {got}")
        seen = (number(got, 14), number(got, 16)) if got[4] & 2 else None
        return Verdict(tube, VERDICTS[got[5]], got[6], seen, number(got, 18))


# The board with the box

def programs(build, folder, *names):
    """Programs of an arm64 build, stripped in `folder`, with their libraries: {path on the board: path here}."""
    found = {}
    for name in names:
        whole = build / "bin" / name
        if not whole.exists():
            raise BoardError(f"{whole} is missing: cmake --build --preset visionbox-qemu")
        found[f"bin/{name}"] = folder / name
        board_parts.run("aarch64-linux-gnu-strip", "-o", folder / name, whole)
    roots = ("/usr/aarch64-linux-gnu/lib",
             build.parent / "sysroot-arm64" / "usr" / "lib" / "aarch64-linux-gnu")
    return found | board_parts.libraries(found.values(), roots)


class Box:
    """A board that has the product, and what a test asks of it."""

    def __init__(self, build, folder, scenario, **more):
        """`build`: the folder of an arm64 build. `more`: arguments of the board."""
        self.scenario = scenario
        self.share = folder / "share"
        self.share.mkdir()
        for name in ("r.session.toml", "r.y4m"):
            os.link(folder / name, self.share / name)
        files = programs(build, folder, "tubesightd", "tubesightctl", "board_camera")
        modules = more.pop("modules", ())
        initramfs = board_parts.initramfs(folder / "initramfs", (VIVID, *modules), files)
        self.board = Board(initramfs=initramfs, share=self.share, steady=True,
                           log=folder / "console.txt", **more)
        self.robot = None
        self._starts = 0

    def boot(self):
        seconds = self.board.boot()
        self.robot = Robot(self.board.robot)
        return seconds

    def clock_s(self):
        """The board's own clock: it may go slower than the host's."""
        return float(self.board.do("cut -d ' ' -f 1 /proc/uptime"))

    def play(self, stations=None):
        """The camera shows the first station; a camera that was pulled out is put in again."""
        circles = " ".join(f"{first}:{last}" for first, last, _ in stations or self.scenario.stations)
        self.board.do("touch /tmp/playing; (while [ -e /tmp/playing ]; do"
                      f" setsid board_camera play {SCREEN} /share/r.y4m {circles}; sleep 0.3;"
                      " done) > /tmp/camera 2>&1 &")

    def stop_playing(self):
        self.board.do("rm /tmp/playing; killall -KILL board_camera;"
                      " while pidof board_camera; do sleep 0.1; done")

    def go_on(self):
        """The tool moves on to the next station."""
        self.board.do("killall -USR1 board_camera")

    def inject(self, name, value=1):
        """A control of the camera. What refuses one call refuses the next one of either node."""
        self.board.do(f"board_camera set {CAMERA} '{name}' '{value}'")

    def start_daemon(self, more=""):
        """The box runs; what it says goes to the file `said`."""
        self._starts += 1
        (self.share / "box.toml").write_text(SETTINGS + more, encoding="ascii")
        self.board.do(f"setsid tubesightd /share/box.toml > /tmp/said-{self._starts} 2>&1 &")
        return self.robot.answers(60.0)

    def hold_picture(self, held):
        """The camera shows what it shows: the player waits, so that what refuses the next call meets the box."""
        self.board.do(f"killall -{'STOP' if held else 'CONT'} board_camera")

    def stop_daemon(self, signal="TERM"):
        self.board.do(f"killall -{signal} tubesightd; while pidof tubesightd; do sleep 0.1; done")

    @property
    def said(self):
        return self.board.do(f"cat /tmp/said-{self._starts}")

    def ask(self, *arguments, seconds=30.0):
        """What tubesightctl prints, and whether all was well."""
        status, text = self.board.run(f"tubesightctl --socket {SOCKET} {' '.join(arguments)}", seconds)
        return status == 0, text.strip()

    def status(self):
        well, text = self.ask("status", "--json")
        if not well:
            raise BoardError(f"no status: {text}\n{self.said}")
        return json.loads(text)

    def wait_status(self, wanted, what, seconds=20.0):
        """The status that `wanted` is true of; `what` it was is told where it does not come."""
        due = time.monotonic() + seconds
        while not wanted(status := self.status()):
            if time.monotonic() > due:
                raise BoardError(f"{what}: not within {seconds} s\n{status['text']}\n{self.said}")
            time.sleep(0.2)  # a program's start takes the board more than a field does
        return status

    def start_tracking(self, station=0, seconds=20.0):
        """The robot starts the box at a station, again while the camera has not come back. The pictures of
        all stations are alike: the clicks have the same places and the tubes of the station."""
        (row, column), (first_row, first_column) = (self.scenario.stations[at][2]
                                                    for at in (station, 0))
        clicks = [(r + row - first_row, c + column - first_column, u, v)
                  for r, c, u, v in self.scenario.clicks]
        due = time.monotonic() + seconds
        while (done := self.robot.start(clicks)) != (1, 0):
            if time.monotonic() > due:
                raise BoardError(f"the start is refused: {done}\n{self.status()['text']}")

    def recording(self):
        """Writes the last seconds down: [(field, status, field of the scenario or None)]."""
        well, text = self.ask("record")
        if not well:
            raise BoardError(f"record: {text}")
        name = text.split()[-1]
        self.board.do(f"cp {name.removesuffix('.y4m')}.* /share/ && sync", 60.0)
        mine = self.share / pathlib.PurePath(name).name
        pictures = list(frames(mine))
        with open(mine.with_suffix(".meta.csv"), encoding="ascii") as file:
            rows = list(csv.DictReader(file))
        begin = int(rows[0]["field"])
        return [(int(row["field"]), row["status"], self.scenario.fields.get(
            digest(pictures[(int(row["field"]) - begin) // 2], int(row["field"]) % 2)))
            for row in rows]

    def close(self):
        self.board.close()
