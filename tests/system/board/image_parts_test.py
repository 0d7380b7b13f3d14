#!/usr/bin/env python3
"""The scripts of the box's image, run here: what tubesight.txt does, and which slot boots next.

Usage: image_parts_test.py [unittest's arguments]

They run under the shell that the board has, busybox's, where it is installed, else under sh.
"""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[3]
IMAGE = ROOT / "board" / "visionbox" / "image"
FIRST_BOOT = IMAGE / "initramfs" / "first_boot"
IMAGE_SCRIPT = ROOT / "board" / "visionbox" / "image.sh"
GROW_DATA = IMAGE / "initramfs" / "grow_data"
SLOT = IMAGE / "files" / "usr" / "sbin" / "tubesight-slot"
KEY = "ssh-ed25519 AAAAC3NzaC1lZDI1NTE5AAAAIJx9FZ2o1ZpX7Bq5b7hFv0Xk me@desk"
COPY_1, COPY_2 = 8192 * 512, 16384 * 512


def shell(script):
    return ["busybox", "sh", script] if shutil.which("busybox") else ["sh", script]


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="image"))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, content=""):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def read(self, name):
        path = self.folder / name
        return path.read_text(encoding="utf-8") if path.exists() else None


class FirstBoot(Folder):
    """Boot partition, data partition and root are three folders."""

    def setUp(self):
        super().setUp()
        self.write("root/etc/tubesight/box.toml", "format = 1\n")
        self.write("root/etc/hostname", "tubesight\n")
        self.write("root/etc/hosts", "127.0.0.1 localhost\n")
        self.write("root/etc/ssh/sshd_config")
        self.write("root/usr/share/zoneinfo/Europe/Paris")
        (self.folder / "boot").mkdir()
        (self.folder / "data").mkdir()

    def boot(self, check="true"):
        """One boot; the lines of the result."""
        new_root = self.folder / "new"
        shutil.rmtree(new_root, ignore_errors=True)
        shutil.copytree(self.folder / "root", new_root)  # what a RAM overlay forgets
        done = subprocess.run(
            [*shell(FIRST_BOOT), self.folder / "boot", self.folder / "data", new_root],
            env={**os.environ, "CHECK_SETTINGS": str(check)}, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        text = (self.folder / "boot/tubesight-result.txt").read_bytes().decode()
        self.assertEqual(text.count("\n"), text.count("\r\n"), "for Windows's editor")
        return text.replace("\r\n", "\n").splitlines()

    def boot_with(self, *lines):
        self.write("boot/tubesight.txt", "\r\n".join(lines))
        return self.boot()

    def test_without_a_text_nothing_listens_and_all_is_said(self):
        result = self.boot()
        self.assertEqual(result[0], "boot 1")
        self.assertIn("there is no tubesight.txt", result[1])
        self.assertEqual(self.read("new/etc/hostname"), "tubesight\n")
        self.assertIsNone(self.read("new/etc/ssh/authorized_keys"))
        self.assertFalse((self.folder / "new/etc/systemd").exists())
        self.assertEqual(self.read("data/settings/box.toml"), "format = 1\n")

    def test_windows_writes_it(self):
        self.write("boot/Settings/BOX.TOML", "format = 1\nmine\n")
        self.write("boot/Settings/camera.toml", "camera")
        self.write("boot/TubeSight.TXT", b"\xef\xbb\xbf# what a box is called\r\nNAME = Box-7\r\n\r\n"
                   b"Time_Zone = Europe/Paris\r\nnetwork=DHCP\r\nssh-key = " + KEY.encode()
                   + b"\r\nsettings = settings")
        result = self.boot()
        self.assertEqual(result, [
            "boot 1", "line 2: the box is called Box-7", "line 4: time zone Europe/Paris",
            "line 5: the network gives the address (DHCP)",
            "line 6: whoever has the key 'me@desk' may come in as root, by ssh",
            "line 7: 2 files of folder 'settings' are the box's settings", "0 refused."])
        self.assertEqual(self.read("new/etc/hostname"), "Box-7\n")
        self.assertEqual(os.readlink(self.folder / "new/etc/localtime"), "/usr/share/zoneinfo/Europe/Paris")
        self.assertIn("DHCP=ipv4", self.read("new/etc/systemd/network/10-wire.network"))
        self.assertEqual(self.read("new/etc/ssh/authorized_keys"), KEY + "\n")
        wants = self.folder / "new/etc/systemd/system/multi-user.target.wants"
        self.assertEqual(sorted(path.name for path in wants.iterdir()),
                         ["ssh.service", "systemd-networkd.service"])
        self.assertEqual(self.read("data/settings/box.toml"), "format = 1\nmine\n")
        self.assertEqual(self.read("data/settings/camera.toml"), "camera")

    def test_each_wrong_line_is_refused_in_words_and_the_others_hold(self):
        wrong = {
            "name = -box": "'-box' is no name for a machine",
            "name = box 7": "'box 7' is no name for a machine",
            "time-zone = Mars/Olympus": "'Mars/Olympus' is no time zone",
            "time-zone = ../../etc/passwd": "is no time zone",
            "network = 192.168.1.300/24": "is no network",
            "network = 192.168.1.3": "is no network",
            "network = on": "is no network",
            "gateway = 192.168.1.1": "a gateway needs a line 'network = ADDRESS/BITS' above it",
            "ssh-key = " + KEY: "a key needs a network",
            "settings = nowhere": "there is no folder 'nowhere'",
            "settings = ../etc": "is no folder's name",
            "password = 1234": "'password' is not known; known are name,",
            "just words": "is no line of the form KEY = VALUE",
        }
        for line, words in wrong.items():
            with self.subTest(line):
                result = self.boot_with(line, "name = box-9")
                self.assertRegex(result[1], r"^line 1 REFUSED: ")
                self.assertIn(words, result[1])
                self.assertEqual(result[-1], "1 refused." if not line.startswith("name") else result[-1])
                if not line.startswith("name"):
                    self.assertEqual(self.read("new/etc/hostname"), "box-9\n")
        result = self.boot_with("network = dhcp", "ssh-key = AAAAB3 me", "network = off")
        self.assertIn("this is no public ssh key", result[2])
        self.assertIn("'network' stands twice", result[3])

    def test_what_is_no_text_is_refused_as_a_whole(self):
        self.write("boot/tubesight.txt", "\ufeffname = box-2\r\n".encode("utf-16-le"))
        self.assertIn("saved as Unicode (UTF-16)", self.boot()[1])
        self.write("boot/tubesight.txt", b"name = box-2\n" + b"#" * 70000)
        self.assertIn("more than 64 kB", self.boot()[1])
        self.assertEqual(self.read("new/etc/hostname"), "tubesight\n")

    def test_settings_that_the_box_refuses_leave_the_old_ones(self):
        check = self.write("check", "#!/bin/sh\necho 'box.toml:3: source.kind: expected a string'\nexit 2\n")
        check.chmod(0o755)
        self.write("boot/settings/box.toml", "wrong")
        self.write("boot/tubesight.txt", "settings = settings\nname = box-3\n")
        result = self.boot(check)
        self.assertIn("line 1 REFUSED: the box does not take the settings of folder 'settings'", result[1])
        self.assertEqual(result[2], "  box.toml:3: source.kind: expected a string")
        self.assertEqual(self.read("data/settings/box.toml"), "format = 1\n")
        self.assertEqual(self.read("new/etc/hostname"), "box-3\n")

    def test_a_second_boot_keeps_all_and_reads_nothing_again(self):
        self.write("boot/settings/box.toml", "first")
        self.boot_with("name = box-4", "settings = settings")
        machine = self.read("data/board/machine-id")
        self.write("data/settings/box.toml", "changed on the box")
        self.assertEqual(self.boot()[0], "boot 1", "the result stays that of the first boot")
        self.assertEqual(self.read("new/etc/hostname"), "box-4\n")
        self.assertEqual(self.read("new/etc/machine-id"), machine)
        self.assertEqual(self.read("data/board/boots"), "2\n")
        self.assertEqual(self.read("data/settings/box.toml"), "changed on the box")
        # Another name, and the folder as it was: what was changed on the box stays.
        result = self.boot_with("name = box-5", "settings = settings")
        self.assertIn("is as it was when the box took it", result[2])
        self.assertEqual(self.read("new/etc/hostname"), "box-5\n")
        self.assertEqual(self.read("data/settings/box.toml"), "changed on the box")
        # A changed folder under an unchanged text.
        self.write("boot/settings/box.toml", "second")
        self.boot()
        self.assertEqual(self.read("data/settings/box.toml"), "second")
        self.assertEqual(self.read("data/settings.before/box.toml"), "changed on the box")

    def test_a_cut_between_the_names_of_a_change_ends_at_whole_settings(self):
        self.boot_with("name = box-6")
        data = self.folder / "data"
        (data / "settings").rename(data / "settings.before")
        self.write("data/settings.new/box.toml", "new and whole")
        (data / "board/current").rename(data / "board/before")
        self.boot()
        self.assertEqual(self.read("data/settings/box.toml"), "new and whole")
        self.assertEqual(self.read("new/etc/hostname"), "box-6\n")
        # Half copied: the old ones stand.
        self.write("data/settings.new.part/box.toml", "ha")
        self.boot()
        self.assertEqual(self.read("data/settings/box.toml"), "new and whole")


class Slots(Folder):
    """A disk of a file, with the two sectors in the form that U-Boot reads and writes."""

    def setUp(self):
        super().setUp()
        self.disk = self.write("disk")
        os.truncate(self.disk, 10 << 20)
        self.write("board/disk", f"{self.disk}\n")
        self.run_in("a")
        for name, text in (("systemctl", '[ "$1" = show ] || { echo "$@" >> "$FOLDER/asked"; exit 0; }\n'
                            'case "$*" in *ExecMainStatus*) cat "$FOLDER/exit";; *) cat "$FOLDER/process";; esac\n'),
                           ("tubesightctl", 'test -e "$FOLDER/answers"\n')):
            self.write(f"bin/{name}", f"#!/bin/sh\n{text}").chmod(0o755)
        self.write("process", "0\n")
        self.write("exit", "1\n")

    def run_in(self, slot):
        self.write("board/slot", f"{slot}\n")

    def slot(self, *words, status=0):
        done = subprocess.run(
            [*shell(SLOT), *words], capture_output=True, text=True, check=False,
            env={**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "FOLDER": str(self.folder),
                 "TUBESIGHT_BOARD": str(self.folder / "board"), "TUBESIGHT_STEADY_S": "0",
                 "TUBESIGHT_PATIENCE_S": "1"}, timeout=30)
        self.assertEqual((done.returncode, done.stderr), (status, ""), done.stdout)
        return done.stdout

    def put(self, where, **values):
        """Writes a sector as `env export -c -s 200` does."""
        text = b"".join(f"{name}={value}\0".encode() for name, value in values.items()).ljust(508, b"\0")
        with open(self.disk, "r+b") as disk:
            disk.seek(where)
            disk.write(zlib.crc32(text).to_bytes(4, "little") + text)

    def get(self, where):
        """Reads a sector as `env import -c` does; None when its checksum is wrong."""
        with open(self.disk, "rb") as disk:
            disk.seek(where)
            sector = disk.read(512)
        if zlib.crc32(sector[4:]) != int.from_bytes(sector[:4], "little"):
            return None
        return dict(word.split("=") for word in sector[4:].rstrip(b"\0").decode().split("\0"))

    def test_a_boot_is_good_and_counted_no_more(self):
        self.put(COPY_1, ts_serial="f", ts_slot="a", ts_tries=2, ts_bad_a=0, ts_bad_b=1, ts_proven_a=0,
                 ts_proven_b=0)
        self.assertIn("slot a: not tried yet; running; next boot, 2 of 3 boots without an answer yet\n"
                      "slot b: failed", self.slot("status"))
        self.slot("good")
        self.assertEqual(self.get(COPY_2), {
            "ts_serial": "10", "ts_slot": "a", "ts_tries": "0", "ts_bad_a": "0", "ts_bad_b": "1",
            "ts_proven_a": "1", "ts_proven_b": "0"})
        self.assertEqual(self.get(COPY_1)["ts_serial"], "f", "the copy before stays")
        self.slot("good")
        self.assertEqual(self.get(COPY_1)["ts_serial"], "11")

    def test_a_torn_sector_leaves_the_one_before(self):
        self.put(COPY_1, ts_serial="4", ts_slot="b", ts_tries=1, ts_bad_a=1, ts_proven_b=1)
        self.put(COPY_2, ts_serial="5", ts_slot="a", ts_tries=0)
        with open(self.disk, "r+b") as disk:
            disk.seek(COPY_2 + 100)
            disk.write(b"torn")
        said = self.slot("status")
        self.assertIn("slot a: failed", said)
        self.assertIn("slot b: good; next boot, 1 of 3", said)
        self.run_in("b")
        self.slot("good")
        self.assertEqual(self.get(COPY_2)["ts_serial"], "5", "the torn one is written over")
        self.assertEqual(self.get(COPY_2)["ts_bad_a"], "1")

    def test_an_answer_makes_the_running_slot_good(self):
        self.write("process", "77\n")
        self.write("answers")
        self.run_in("b")
        self.assertIn("slot b is good: the box answers", self.slot("watch"))
        self.assertEqual(self.get(COPY_1)["ts_slot"], "b")
        self.assertIsNone(self.read("asked"))

    def watch_without_answer(self, lines):
        """What watch says; the box answers in the end so that it comes to one."""
        process = subprocess.Popen(
            [*shell(SLOT), "watch"], stdout=subprocess.PIPE, text=True,
            env={**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "FOLDER": str(self.folder),
                 "TUBESIGHT_BOARD": str(self.folder / "board"), "TUBESIGHT_STEADY_S": "0",
                 "TUBESIGHT_PATIENCE_S": "1"})
        said = "".join(process.stdout.readline() for _ in range(lines))
        self.write("answers")
        self.write("process", "5\n")
        with process.stdout:
            said += process.stdout.read()
        self.assertEqual(process.wait(30), 0 if lines == 2 else 1)
        return said

    def test_without_an_answer_the_board_starts_again(self):
        self.assertIn("no answer from the box in slot a", self.watch_without_answer(1))
        self.assertEqual(self.read("asked"), "--no-block reboot\n")
        self.assertIsNone(self.get(COPY_1), "and the count stays")

    def test_it_stays_up_where_another_boot_does_no_better(self):
        self.put(COPY_1, ts_serial=1, ts_slot="a", ts_bad_b=1)
        self.assertIn("slot b has not come to one either", self.watch_without_answer(2))
        self.put(COPY_1, ts_serial="20", ts_slot="a", ts_proven_a=1)
        for name in ("answers", "process"):
            (self.folder / name).unlink()
        self.write("process", "0\n")
        self.write("exit", "2\n")
        self.assertIn("the box's settings are wrong", self.watch_without_answer(2))
        (self.folder / "answers").unlink()
        self.write("board/no-data")
        self.assertIn("the data partition cannot be used", self.watch_without_answer(2))
        self.assertIsNone(self.read("asked"))

    def test_a_slot_is_tried_on_demand(self):
        self.put(COPY_1, ts_serial=1, ts_slot="a", ts_bad_b=1, ts_proven_a=1, ts_proven_b=1)
        self.slot("use", "b")
        state = self.get(COPY_2)
        self.assertEqual((state["ts_slot"], state["ts_bad_b"], state["ts_proven_b"], state["ts_proven_a"]),
                         ("b", "0", "0", "1"))

    def test_wrong_words_are_told(self):
        done = subprocess.run([*shell(SLOT), "use", "c"], capture_output=True, text=True, check=False,
                              env={**os.environ, "TUBESIGHT_BOARD": str(self.folder / "board")})
        self.assertEqual((done.returncode, done.stderr), (1, "tubesight-slot: expected a or b, found 'c'\n"))


class Units(Folder):
    """The image's own units run as root; the service manager's measure of what is left to them, in tenths.
    docs/security.md quotes it."""

    EXPOSURE = {"tubesight-slot": 12, "tubesight-grow": 13}

    def measure(self, unit, threshold):
        done = subprocess.run(["systemd-analyze", "security", "--offline=yes", "--no-pager",
                               f"--threshold={threshold}", unit], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout

    def test_no_more_is_allowed_to_them_than_is_said(self):
        units = IMAGE / "files/etc/systemd/system"
        self.assertEqual({path.stem for path in units.glob("*.service")}, set(self.EXPOSURE))
        for name, exposure in self.EXPOSURE.items():
            status, said = self.measure(units / f"{name}.service", exposure)
            self.assertEqual(status, 0, f"{name}: {said[-200:]}")
            text = (units / f"{name}.service").read_text(encoding="utf-8")
            opened = self.write(f"{name}.service", text.replace("NoNewPrivileges=yes", ""))
            self.assertNotEqual(self.measure(opened, exposure)[0], 0)


class ImageScript(Folder):
    """What it refuses, before anything is installed, fetched or written."""

    def refuses(self, *arguments, status=1, **environment):
        done = subprocess.run([IMAGE_SCRIPT, *arguments], capture_output=True, text=True, check=False,
                              stdin=subprocess.DEVNULL, timeout=30, env={**os.environ, **environment})
        self.assertEqual((done.returncode, done.stdout), (status, ""), done.stderr)
        return done.stderr

    def package(self, name, architecture):
        self.write("tree/DEBIAN/control", f"Package: {name}\nVersion: 1\nArchitecture: {architecture}\n"
                   "Maintainer: x <x@x.example>\nDescription: x\n")
        made = self.folder / f"{name}_{architecture}.deb"
        subprocess.run(["dpkg-deb", "--root-owner-group", "-b", self.folder / "tree", made], check=True,
                       stdout=subprocess.DEVNULL)
        return made

    def test_wrong_arguments_get_the_usage(self):
        for arguments in ((), ("--refresh",), ("--package",), ("--package", self.write("x.deb")), ("a.img", "b.img")):
            with self.subTest(arguments):
                self.assertIn("usage: ", self.refuses(*arguments, status=2))

    def test_another_package_than_the_boards_is_named(self):
        out = self.folder / "out.img"
        self.assertIn("none.deb: no such package", self.refuses("--package", self.folder / "none.deb", out))
        for name, architecture in (("tubesight", "armhf"), ("tubesight-dbgsym", "arm64")):
            self.assertIn(f"expected the package tubesight of arm64, found {name} {architecture}",
                          self.refuses("--package", self.package(name, architecture), out))
        self.assertIn("found no Debian package", self.refuses("--package", self.write("x.deb", "x"), out))
        self.assertFalse(out.exists())

    def test_a_device_or_a_folder_is_no_place_for_an_image(self):
        package = self.package("tubesight", "arm64")
        for out in (self.folder, pathlib.Path("/dev/null")):
            self.assertIn(f"{out} is no file", self.refuses("--package", package, out))

    def test_a_time_is_asked_for_where_git_has_none(self):
        said = self.refuses("--package", self.package("tubesight", "arm64"), self.folder / "out.img",
                            GIT_DIR=str(self.folder), SOURCE_DATE_EPOCH="")
        self.assertIn("not a checkout with git; set SOURCE_DATE_EPOCH", said)


if __name__ == "__main__":
    unittest.main()
