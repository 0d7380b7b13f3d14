#!/usr/bin/env python3
"""What the program says to mistaken arguments, its exit statuses, and what an interrupted or failed run leaves.

Usage: words_test.py PROGRAM REPOSITORY
"""
import os
import pathlib
import pty
import re
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = ""
REPOSITORY = pathlib.Path()
COMMANDS = ["new", "replay", "pose", "look", "calibrate", "budget", "campaign", "simulate", "devices",
            "journal"]
PLATE = "tests/data/stills/square_flush"


def run(folder, *arguments, **more):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, capture_output=True, text=True,
                          timeout=120, check=False, **more)


class Folder(unittest.TestCase):
    """Each case has a folder of its own with a session, a recording, a still and others."""

    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)
        recording = REPOSITORY / "tests/data/recordings/square_flush"
        (self.folder / "s.toml").write_bytes((recording / "session.toml").read_bytes())
        (self.folder / "r.y4m.xz").symlink_to(recording / "recording.y4m.xz")
        (self.folder / "scenario.toml").write_text(
            'include = ["%s"]\n[path]\ntube = [40, 60]\nheight_mm = 60\n[[step]]\nrest_s = 0.1\n'
            % (REPOSITORY / "tests/data/scenarios/parts/camera.toml"))
        self.still = sorted((REPOSITORY / PLATE).glob("*.png"))[0]
        self.there = self.names()

    def names(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))


class Words(Folder):
    """Mistakes, and what is said to them."""

    def expect(self, arguments, status, words):
        """One line on standard error that has the words, nothing on standard output, no file."""
        result = run(self.folder, *arguments)
        said = f"{arguments}: {result.stderr}{result.stdout}"
        self.assertEqual(result.returncode, status, said)
        self.assertEqual(result.stdout, "", said)
        self.assertEqual(result.stderr.count("\n"), 1, said)
        for word in [words] if isinstance(words, str) else words:
            self.assertIn(word, result.stderr, said)
        self.assertEqual(self.names(), self.there, said)

    def test_misspelt(self):
        self.expect(["frobnicate"], 2, ["'frobnicate' is no command", *COMMANDS])
        self.expect(["REPLAY", "s.toml"], 2, "did you mean replay?")
        self.expect(["simulte"], 2, "did you mean simulate?")
        self.expect(["help", "rplay"], 2, "did you mean replay?")
        self.expect(["--verison"], 2, "did you mean --version? a command comes first, one of")
        self.expect(["--from"], 2, "'--from' is no option: a command comes first, one of")
        self.expect(["replay", "--feilds", "f.csv", "s.toml", "r.y4m.xz"], 2,
                    "replay: '--feilds' is no option, did you mean --fields?")
        self.expect(["replay", "s.toml", "--feilds=f.csv"], 2, "did you mean --fields?")
        self.expect(["calibrate", "camra", "s.toml"], 2, "did you mean camera?")
        self.expect(["replay", "--version"], 2, "expected tubesight --version")
        self.expect([], 2, ["no command", *COMMANDS])

    def test_missing(self):
        self.expect(["replay", "s.toml", "r.y4m.xz", "--fields"], 2,
                    "--fields: its value is missing, expected F.csv: Write one row a field")
        self.expect(["replay", "s.toml", "r.y4m.xz", "--fields", "--centers", "c.csv"], 2,
                    "--fields: its value is missing")
        self.expect(["campaign", "--moves"], 2, "--moves: its value is missing, expected N: ")
        self.expect(["replay", "s.toml"], 2, "RECORDING is missing, expected SESSION.toml RECORDING")
        self.expect(["simulate", "scenario.toml"], 2, "--out is missing, expected NAME: ")
        self.expect(["calibrate", "tool", "s.toml", "--dock", "40,60"], 2, "--dock: too few values")
        self.expect(["pose", "s.toml", self.still, "--csv", ""], 2, "--csv: its value is empty")
        self.expect(["look", self.still, "--overlay="], 2, "--overlay")

    def test_surplus(self):
        self.expect(["replay", "s.toml", "r.y4m.xz", "--fields", "a", "--fields", "b"], 2,
                    "--fields: it is there 2 times, expected once")
        self.expect(["replay", "s.toml", "r.y4m.xz", "more"], 2,
                    "'more' is one argument too many, expected SESSION.toml RECORDING")
        self.expect(["devices", "x"], 2, "'x' is one argument too many, expected none")

    def test_swapped(self):
        for command in ["replay", "pose"]:
            self.expect([command, "r.y4m.xz", "s.toml"], 2,
                        [f"{command}: 'r.y4m.xz' is a recording", "they are swapped, expected SESSION"])
        self.expect(["pose", self.still, "s.toml"], 2, ["is a picture", "swapped"])
        self.expect(["replay", "video.mp4", "s.toml"], 2, "swapped")
        self.expect(["calibrate", "s.toml", "tool"], 2, "expected calibrate tool s.toml")
        self.expect(["look", "s.toml"], 2, "'s.toml' is a settings file, expected a picture")
        self.expect(["replay", "s.toml", "s.toml"], 2, "expected a recording as RECORDING")
        self.expect(["replay", "s.toml", self.still], 2, "is a picture, expected a recording as RECORDING")
        self.expect(["replay", "scenario.toml", "r.y4m.xz"], 2, "is a scenario (simulate draws it)")
        self.expect(["budget", "r.y4m.xz"], 2, "is a recording, expected a settings file as SETTINGS")
        self.expect(["simulate", "r.y4m.xz", "--out", "x"], 2, "is a recording, expected a scenario")
        self.expect(["calibrate", "base", "s.toml"], 2, "expected a table (CSV) as FILE")

    def test_an_option_s_file_of_another_kind(self):
        self.expect(["new", "n.toml", "--from", "s.toml"], 2,
                    "new: 's.toml' is a settings file, expected a recording or a picture as --from")
        self.expect(["new", "n.toml", "--from", "r.y4m.xz", "--camera", self.still], 2,
                    "is a picture, expected a settings file or a camera's file (YAML) as --camera")
        self.expect(["calibrate", "base", "pairs.csv", "--sheet", "r.y4m.xz"], 2,
                    "is a recording, expected a settings file as --sheet")
        self.expect(["campaign", "--moves", "1", "--resume", "s.toml"], 2,
                    "is a settings file, expected a table (CSV) as --resume")

    def test_help_and_version(self):
        version = run(self.folder, "--version")
        self.assertEqual(run(self.folder, "-V").stdout, version.stdout)
        self.assertTrue(version.stdout.startswith("tubesight "), version.stdout)
        self.assertEqual(run(self.folder, "help").stdout, run(self.folder, "--help").stdout)
        for command in COMMANDS:
            result = run(self.folder, "help", command)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(result.stdout, run(self.folder, command, "--help").stdout)
            self.assertIn(f"tubesight {command}", result.stdout)

    def test_a_number_is_a_number(self):
        session = (self.folder / "s.toml").read_text()
        for text, said in [("8e9", "8e+09, expected"), ("2e300", "2e+300, expected"), ("7.0", "7.0, expected"),
                           ("inf", "inf, expected")]:
            (self.folder / "s.toml").write_text(session.replace("width_px = 635", f"width_px = {text}"))
            self.expect(["replay", "s.toml", "r.y4m.xz"], 2, f"camera.width_px: {said}")

    def test_limits_are_written_as_people_do(self):
        self.expect(["replay", "s.toml", "r.y4m.xz", "--to", "abc"], 2, "--to: Value abc not in range 0 to 4000000000 (")
        self.expect(["campaign", "--hours", "0"], 2, "--hours: Value 0 not in range 0.000001 to 100000 (")
        self.expect(["calibrate", "template", "t.pdf", "--dot-mm", "0"], 2, "Value 0 not in range 0.05 to 1000 (")

    def test_a_scenario_names_the_camera_s_key(self):
        camera = (REPOSITORY / "tests/data/scenarios/parts/camera.toml").read_text()
        sheet = (REPOSITORY / "tests/data/scenarios/parts/sheet-square.toml").read_text()
        path = "[path]\ntube = [40, 60]\nheight_mm = 60\n[[step]]\nrest_s = 0.1\n"
        for old, new, said in [("width_px = 635", "width_px = 3000", ": camera.width_px: 3000, expected at most 2048"),
                               ("focal_length_mm = 5.06", "focal_length_mm = 0.5",
                                ": camera.focal_length_mm: 0.5, expected a picture within 60 degrees")]:
            self.assertIn(old, camera)
            text = camera.replace(old, new) + sheet + path
            (self.folder / "scenario.toml").write_text(text)
            line = text[:text.index(new)].count("\n") + 1
            self.expect(["simulate", "scenario.toml", "--out", "x"], 2, f"scenario.toml:{line}{said}")

    def test_exit_statuses(self):
        """0 done, 1 the job failed, 2 an argument or a file is wrong: docs/messages.md, of every command."""
        flat = self.folder / "flat.pgm"
        flat.write_bytes(b"P5 200 200 255\n" + bytes(40000))
        yaml = "image_width: 640\nimage_height: 480\ncamera_matrix: [500,0,320,0,500,240,0,0,1]\n" \
               "distortion_coefficients: [-0.1, 0.01, 0, 0, 0]\n"
        (self.folder / "c.yaml").write_text(yaml)
        (self.folder / "folds.yaml").write_text(yaml.replace("-0.1, 0.01", "-3, 0"))
        told = ["--efl-mm", "5", "--pixel-um", "8", "--pitch-mm", "25.4", "--bore-mm", "18.6"]
        none = "none.toml"
        table = {
            "new": [(0, ["new", "a/n.toml", "--from", self.still, *told]), (2, ["new", "s.toml", "--from", self.still]),
                    (2, ["new", "no/n.toml", "--from", self.still, *told])],
            "replay": [(2, ["replay", none, "r.y4m.xz"]), (2, ["replay", "s.toml", "none.y4m"])],
            "pose": [(1, ["pose", REPOSITORY / PLATE / "session.toml", self.still, "--csv", "/dev/full"]),
                     (2, ["pose", none, self.still])],
            "look": [(0, ["look", self.still, "--csv", "a/l.csv"]), (1, ["look", flat]), (2, ["look", "none.png"]),
                     (1, ["look", self.still, "--csv", "/dev/full"])],
            "calibrate": [(0, ["calibrate", "import", "c.yaml", "--out", "a/c.toml"]),
                          (1, ["calibrate", "import", "c.yaml", "--out", "/dev/full"]),
                          (1, ["calibrate", "import", "folds.yaml"]), (2, ["calibrate", "import", "none.yaml"]),
                          (0, ["calibrate", "template", "a/t.svg"]), (2, ["calibrate", "base", "none.csv"]),
                          (2, ["calibrate", "camera", none]), (2, ["calibrate", "tool", none, "--dock", "1,2", "x"]),
                          (2, ["calibrate", "zones", "none.csv", "--base", none]),
                          (2, ["calibrate", "links", "none.csv", "--arm", none])],
            "budget": [(2, ["budget", none])],
            "campaign": [(2, ["campaign"]), (2, ["campaign", "--merge", "none.csv"])],
            "simulate": [(2, ["simulate", none, "--out", "x"])],
            "devices": [(0, ["devices"])],
            "journal": [(2, ["journal", "check", "none.db"]), (2, ["journal", "copy", "none.db"]),
                        (2, ["journal", "reconcile", "none.db", "other.db", "--jobs", "none.csv"])],
        }
        self.assertEqual(sorted(table), sorted(COMMANDS))
        (self.folder / "a").mkdir()
        for command, cases in table.items():
            for status, arguments in cases:
                with self.subTest(arguments=arguments):
                    result = run(self.folder, *arguments, stdin=subprocess.DEVNULL)
                    self.assertEqual(result.returncode, status, result.stderr)
                    self.assertEqual(result.stderr == "", status == 0, result.stderr)
            wrong = run(self.folder, command, "--no-such-option")
            self.assertEqual(wrong.returncode, 2, wrong.stderr)
            with open("/dev/full", "w") as full:
                unsaid = subprocess.run([PROGRAM, command, "--help"], stdout=full, check=False, stderr=subprocess.PIPE)
            self.assertEqual(unsaid.returncode, 1, command)

    def test_no_half_of_the_outputs(self):
        still = REPOSITORY / PLATE
        for arguments in [
                ["look", self.still, "--csv", "l.csv", "--overlay", "no/o.png"],
                ["look", self.still, "--csv", "/dev/full", "--overlay", "o.png"],
                ["pose", still / "session.toml", self.still, "--csv", "p.csv", "--covariance", "/dev/full"],
                ["pose", still / "session.toml", self.still, "--csv", "p.csv", "--overlay", "no/o.png"]]:
            with self.subTest(arguments=arguments):
                result = run(self.folder, *arguments)
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
                self.assertEqual(self.names(), self.there)
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "look", self.still, "--csv", "l.csv"], cwd=self.folder, stdout=full,
                                    stderr=subprocess.PIPE, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(self.names(), self.there)

    def unfinished(self):
        return [name for name in self.names() if name.endswith(".part")]

    def feed(self, video, process):
        """Writes frames without an end into a pipe until the program writes; what it writes."""
        descriptor = os.open(video, os.O_RDWR | os.O_NONBLOCK)  # does not wait for a reader
        data = b"YUV4MPEG2 W635 H480 F30:1 It Cmono\n"
        end = time.monotonic() + 120
        while len(self.unfinished()) < 2:
            self.assertIsNone(process.poll(), "ended before its time")
            self.assertLess(time.monotonic(), end, "writes nothing")
            data = data or b"FRAME\n" + bytes(635 * 480)
            try:
                data = data[os.write(descriptor, data):]
            except BlockingIOError:
                time.sleep(0.01)
        self.addCleanup(os.close, descriptor)
        return self.unfinished()

    def test_interrupted(self):
        """Ctrl-C and SIGTERM leave nothing; what a kill leaves the next run removes."""
        for number, left in [(signal.SIGINT, False), (signal.SIGTERM, False), (signal.SIGHUP, False),
                             (signal.SIGKILL, True)]:
            with self.subTest(signal=number):
                video = self.folder / f"{number}.y4m"
                os.mkfifo(video)
                with subprocess.Popen([PROGRAM, "replay", "s.toml", video, "--fields", "f.csv", "--centers", "c.csv"],
                                      cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                      text=True) as process:
                    parts = self.feed(video, process)
                    self.assertEqual(len(parts), 2, parts)
                    process.send_signal(number)
                    self.assertEqual(process.wait(timeout=60), -number)
                    said = process.stderr.read()
                self.assertEqual(self.unfinished(), parts if left else [])
                self.assertEqual("interrupted" in said, not left, said)
        result = run(self.folder, "look", self.still, "--csv", "f.csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([name for name in self.names() if name.startswith("f.csv")], ["f.csv"])

    def test_an_ignored_signal_stays_ignored(self):
        result = subprocess.run(["sh", "-c", "trap '' INT; \"$0\" look \"$1\" & kill -INT $!; wait $!", PROGRAM,
                                 str(self.still)], cwd=self.folder, capture_output=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)


class Talk(Folder):
    """-q and -v: of every command the same."""

    def cases(self):
        still = REPOSITORY / PLATE
        told = ["--efl-mm", "5.06", "--pixel-um", "9.95,9.8", "--pitch-mm", "25.4", "--bore-mm", "18.6"]
        (self.folder / "c.yaml").write_text(
            "image_width: 640\nimage_height: 480\ncamera_matrix: [500,0,320,0,500,240,0,0,1]\n"
            "distortion_coefficients: [-0.1, 0.01, 0, 0, 0]\n")
        # What -v tells, as far as it tells anything.
        return {
            "new": (["new", "n.toml", "--from", "r.y4m.xz", *told],
                    "r.y4m.xz: 635 x 480 pixels, 8 bits, even lines first, 30.000 frames a second, read by itself\n"),
            "replay": (["replay", "s.toml", "r.y4m.xz", "--to", "0.1"], "s.toml: read\nr.y4m.xz: 635 x 480 pixels, "),
            "pose": (["pose", still / "session.toml", self.still], f"{self.still}: 635 x 480 pixels, read by itself\n"),
            "look": (["look", self.still], f"{self.still}: 635 x 480 pixels, read by itself\n"),
            "calibrate": (["calibrate", "import", "c.yaml", "--out", "c.toml"], ""),
            "budget": (["budget", "s.toml", "--robots", "1"], "s.toml: read\n"),
            "journal": (["journal", "check", self.journal()], ""),
            "campaign": (["campaign", "--moves", "1"], ", seed 1 from number 0, 1 at a time\n"),
            "simulate": (["simulate", "whole.toml", "--out", "drawn"], "whole.toml: read, with "),
        }

    def journal(self):
        """One of no rows, as docs/journal.md has it: nothing is wrong with it."""
        columns = re.findall(r"^\| (`\w+`(?:, `\w+`)*) \| (TEXT|INTEGER) \|",
                             (REPOSITORY / "docs/journal.md").read_text(encoding="utf-8"), re.MULTILINE)
        table = ", ".join(f"{name} {kind}" for names, kind in columns for name in re.findall(r"\w+", names))
        database = sqlite3.connect(self.folder / "j.db")
        database.executescript(
            "PRAGMA application_id = 0x54534a31; PRAGMA user_version = 1;"
            f"CREATE TABLE journal({table}) STRICT;"
            "CREATE TABLE checkpoint(n INTEGER PRIMARY KEY, chain TEXT, key TEXT, signature TEXT) STRICT;"
            "CREATE TABLE picture(digest TEXT PRIMARY KEY, n INTEGER, jpeg BLOB) STRICT;")
        database.close()
        return "j.db"

    def test_quiet_and_verbose(self):
        parts = REPOSITORY / "tests/data/scenarios/parts"
        (self.folder / "whole.toml").write_text(
            f'include = ["{parts}/camera.toml", "{parts}/sheet-square.toml"]\n[path]\ntube = [40, 60]\n'
            "height_mm = 60\n[[step]]\nrest_s = 0.1\n")
        cases = self.cases()
        self.assertEqual(sorted(cases), sorted(set(COMMANDS) - {"devices"}))
        for command, (arguments, words) in cases.items():
            with self.subTest(command=command):
                usual = run(self.folder, *arguments, stdin=subprocess.DEVNULL)
                self.assertEqual(usual.returncode, 0, usual.stderr)
                self.assertNotEqual(usual.stdout, "")
                for flag in ["-q"]:
                    (self.folder / "n.toml").unlink(missing_ok=True)
                    quiet = run(self.folder, *arguments, flag, stdin=subprocess.DEVNULL)
                    self.assertEqual((quiet.returncode, quiet.stdout), (0, ""))
                    self.assertEqual(quiet.stderr, usual.stderr)
                for flag in ["--verbose"]:
                    (self.folder / "n.toml").unlink(missing_ok=True)
                    verbose = run(self.folder, *arguments, flag, stdin=subprocess.DEVNULL)
                    self.assertEqual(verbose.returncode, 0)
                    if command != "campaign":  # which tells how long it took
                        self.assertEqual(verbose.stdout, usual.stdout)
                    self.assertIn(words, verbose.stderr)
                both = run(self.folder, *arguments, "-q", "-v")
                self.assertEqual((both.returncode, both.stderr), (2, f"tubesight: {command}: --quiet excludes --verbose "
                                                                     "(tubesight help tells more)\n"))
        self.assertEqual(run(self.folder, "devices", "-q").returncode, 2)

    def on_terminal(self, *arguments):
        """What is written where standard error is a terminal."""
        leader, follower = pty.openpty()
        with subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=follower) as process:
            os.close(follower)
            said = b""
            while True:
                try:
                    part = os.read(leader, 4096)
                except OSError:  # nobody writes any more
                    break
                if not part:
                    break
                said += part
        os.close(leader)
        return said.decode()

    def test_progress_of_a_video(self):
        """Its length comes from the container; a stream has none."""
        subprocess.run(["ffmpeg", "-nostdin", "-v", "error", "-loop", "1", "-framerate", "30", "-t", "10", "-i", self.still,
                        "-vf", "setfield=tff", "-c:v", "libx264", "-preset", "ultrafast", "-flags", "+ildct",
                        "-x264opts", "tff=1", "v.mp4"], cwd=self.folder, check=True)
        told = ["replay", "s.toml", "v.mp4", "--overlay", "o"]
        self.assertRegex(self.on_terminal(*told), r"\r\d+ fields, [0-9.]+ s of the recording, \d+ %, \d+:\d\d left")
        self.assertEqual(self.on_terminal(*told, "-q"), "")


class New(Folder):
    """`tubesight new`, asked and told."""

    TOLD = ["--efl-mm", "5.06", "--pixel-um", "9.95,9.8", "--pitch-mm", "25.4", "--bore-mm", "18.6"]

    def test_writes_what_replay_reads(self):
        result = run(self.folder, "new", "n.toml", "--from", "r.y4m.xz", *self.TOLD, "--at", "40,60",
                     stdin=subprocess.DEVNULL)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("635 x 480 px, 30 frames a second, even-first", result.stdout)
        text = (self.folder / "n.toml").read_text()
        for words in ['scan = "even-first"', "NOT CALIBRATED", "CHECK THESE", "row = 40, column = 60"]:
            self.assertIn(words, text)
        replay = run(self.folder, "replay", "n.toml", "r.y4m.xz", "--fields", "f.csv")
        self.assertEqual(replay.returncode, 0, replay.stderr)
        rows = (self.folder / "f.csv").read_text().splitlines()
        self.assertEqual(rows[1].split(",")[4], "tracking", rows[1])
        again = run(self.folder, "new", "n.toml", "--from", "r.y4m.xz", *self.TOLD, stdin=subprocess.DEVNULL)
        self.assertEqual(again.returncode, 2)
        self.assertIn("is there already", again.stderr)
        self.assertEqual((self.folder / "n.toml").read_text(), text)

    def test_reads_a_video_once(self):
        """A pipe can be read once alone."""
        os.mkfifo(self.folder / "p.y4m")
        with subprocess.Popen(["sh", "-c", "xz -dc r.y4m.xz > p.y4m"], cwd=self.folder, stderr=subprocess.DEVNULL):
            result = run(self.folder, "new", "n.toml", "--from", "p.y4m", *self.TOLD, stdin=subprocess.DEVNULL)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("635 x 480 px, 30 frames a second, even-first; ", result.stdout)

    def test_tells_all_that_is_missing(self):
        result = run(self.folder, "new", "n.toml", "--from", "r.y4m.xz", "--pitch-mm", "far", stdin=subprocess.DEVNULL)
        self.assertEqual(result.returncode, 2)
        for words in ["--efl-mm: missing", "--pixel-um: missing", "--pitch-mm: 'far', expected", "--bore-mm: missing"]:
            self.assertIn(words, result.stderr)
        self.assertEqual(self.names(), self.there)

    def test_tells_what_the_picture_contradicts(self):
        base = ["new", "n.toml", "--from", "r.y4m.xz", *self.TOLD[:4]]
        for more, status, words in [
                (["--pitch-mm", "25.4", "--bore-mm", "9"], 0, "told a bore of 0.35 of the pitch, but in the first"),
                (["--pitch-mm", "25.4", "--bore-mm", "18", "--lattice", "triangular"], 0, "as of a square lattice"),
                (["--pitch-mm", "25.4", "--bore-mm", "18", "--lattice", "hexagonal"], 2, "--lattice: 'hexagonal', ex"),
                (["--pitch-mm", "18.6", "--bore-mm", "25.4"], 2, "tubesheet.bore_mm: 25.4, expected less than the")]:
            result = run(self.folder, *base, *more, stdin=subprocess.DEVNULL)
            self.assertEqual(result.returncode, status, result.stderr)
            self.assertIn(words, result.stderr)
            self.assertEqual((self.folder / "n.toml").exists(), status == 0)
            (self.folder / "n.toml").unlink(missing_ok=True)

    def test_refuses_an_address_where_nothing_is_to_click_on(self):
        (self.folder / "grey.pgm").write_bytes(b"P5 635 480 255\n" + bytes([90]) * (635 * 480))
        result = run(self.folder, "new", "n.toml", "--from", "grey.pgm", "--scan", "progressive", *self.TOLD,
                     "--at", "40,60", stdin=subprocess.DEVNULL)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("--at: no tube-ends were found in the first frame, expected some", result.stderr)
        self.assertFalse((self.folder / "n.toml").exists())

    def test_takes_the_camera_of_a_session(self):
        result = run(self.folder, "new", "n.toml", "--from", "r.y4m.xz", "--camera", "s.toml", *self.TOLD[4:],
                     "--at", "-3,-4", stdin=subprocess.DEVNULL)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        text = (self.folder / "n.toml").read_text()
        self.assertIn("# The camera: as in s.toml.", text)
        self.assertIn("distortion_per_mm2 = 0.0092", text)
        self.assertIn("row = -3, column = -4", text)
        run(self.folder, "replay", "n.toml", "r.y4m.xz", "--fields", "f.csv")
        self.assertEqual((self.folder / "f.csv").read_text().splitlines()[1].split(",")[4], "tracking")

    def test_asks_on_a_terminal(self):
        leader, follower = pty.openpty()
        with subprocess.Popen([PROGRAM, "new", "n.toml", "--from", "r.y4m.xz"], cwd=self.folder, stdin=follower,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            # A camera by its lens, a pixel, one answer that will not do, and the usual for the rest.
            os.write(leader, b"5.06\n9.95,9.8\n\nfar\n25.4\n18.6\n\n\n40,60\n")
            out, err = process.communicate(timeout=60)
        os.close(leader)
        os.close(follower)
        self.assertEqual(process.returncode, 0, err)
        self.assertIn(b"'far' will not do", err)
        self.assertIn(b"three clicks", out)

    def test_takes_a_calibrated_camera(self):
        (self.folder / "c.yaml").write_text(
            "cam0:\n  camera_model: pinhole\n  intrinsics: [620.0, 530.0, 324.0, 233.0]\n"
            "  distortion_model: radtan\n  distortion_coeffs: [-0.1, 0.01, 0.0, 0.0]\n  resolution: [635, 480]\n")
        result = run(self.folder, "new", "n.toml", "--from", "r.y4m.xz", "--camera", "c.yaml", *self.TOLD[4:],
                     stdin=subprocess.DEVNULL)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("px RMS over the picture", result.stdout)
        self.assertEqual(run(self.folder, "calibrate", "import", "c.yaml", "--out", "c.toml").returncode, 0)
        result = run(self.folder, "new", "m.toml", "--from", self.still, "--camera", "c.toml", *self.TOLD[4:],
                     stdin=subprocess.DEVNULL)
        self.assertIn('include = ["c.toml"]', (self.folder / "m.toml").read_text(), result.stderr)
        (self.folder / "c.yaml").write_text((self.folder / "c.yaml").read_text().replace("635", "636"))
        wrong = run(self.folder, "new", "k.toml", "--from", "r.y4m.xz", "--camera", "c.yaml", *self.TOLD[4:],
                    stdin=subprocess.DEVNULL)
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("636 x 480 px, and r.y4m.xz has 635 x 480", wrong.stderr)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    REPOSITORY = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
