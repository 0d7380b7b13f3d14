#!/usr/bin/env python3
"""The box's image on the emulated board, from U-Boot to the box's answer.

Usage: image_test.py [--package FILE.deb | --cpack CPACK --build BUILD_FOLDER] [--long]

The package is FILE.deb, or what cpack makes of a build folder, or that of package.sh.

One boot by default, with a tubesight.txt as Windows writes it: U-Boot counts, the robot is told over its line
which tube is before the simulated camera, the slot is good, and the disk holds what it should. With --long
also: a second boot keeps all; a slot without a root, and one whose box dies, give way to the other; a key
comes in by the network, and nothing else listens.

Where the box is to answer, the board is a steady one: a busy machine does not take from it the seconds that
it has for that.
"""
import argparse
import contextlib
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import zlib

from board_box import WAITING, Robot
from board_machine import CLOCK_FROM_0, Board
from board_parts import BoardError, ROOT, run, tool

IMAGE_SCRIPT = ROOT / "board" / "visionbox" / "image.sh"
CACHE = ROOT / "build" / "image"
MIB = 1 << 20
BOOT_PARTITION, ROOT_A, ROOT_B, DATA = (at * MIB for at in (16, 192, 448, 704))
COPIES = (8192 * 512, 16384 * 512)
GROWN = 900 * MIB  # a card is larger than the image
ANSWER_S = 900.0   # a quiet machine takes 35
UNKNOWN_HIGH = 0x8000  # the high word of a value that the box does not know
START_S = 300.0    # U-Boot takes 5
PATIENCE_S = 240.0  # the 90 s that a box has to answer in, on a busy machine


def say(text):
    print(text, flush=True)


def expect(value, wanted, what):
    if value != wanted:
        raise BoardError(f"{what}: expected {wanted!r}, found {value!r}")


def expect_in(part, whole, what):
    if part not in whole:
        raise BoardError(f"{what}: expected '{part}' in:\n{whole}")


class Disk:
    """The image that the board boots from, looked at from outside."""

    def __init__(self, path, image=None):
        self.path = path
        if image is not None:
            run("cp", "--sparse=always", image, path)
            with open(path, "r+b") as disk:
                disk.truncate(GROWN)

    def state(self):
        """The newest of the two sectors that U-Boot and the box write."""
        best = {}
        with open(self.path, "rb") as disk:
            for at in COPIES:
                disk.seek(at)
                sector = disk.read(512)
                if zlib.crc32(sector[4:]) != int.from_bytes(sector[:4], "little"):
                    continue
                words = dict(word.split("=") for word in sector[4:].rstrip(b"\0").decode().split("\0"))
                if not best or int(words["ts_serial"], 16) > int(best["ts_serial"], 16):
                    best = words
        return best

    def put_file(self, name, content):
        source = self.path.with_suffix(".file")
        source.write_bytes(content)
        run("mcopy", "-o", "-i", f"{self.path}@@{BOOT_PARTITION}", source, f"::{name}")

    def put_folder(self, name, files):
        run("mmd", "-i", f"{self.path}@@{BOOT_PARTITION}", f"::{name}")
        for file, content in files.items():
            self.put_file(f"{name}/{file}", content)

    def boot_file(self, name):
        return run("mtype", "-i", f"{self.path}@@{BOOT_PARTITION}", f"::{name}").replace("\r\n", "\n")

    @contextlib.contextmanager
    def data(self):
        """Reads files of the data partition, repaired as after a power cut: a function of their path."""
        part = self.path.with_suffix(".data")
        with open(self.path, "rb") as disk, open(part, "wb") as copy:
            disk.seek(DATA)
            while piece := disk.read(4 * MIB):
                copy.write(piece)
        done = subprocess.run([tool("e2fsck"), "-fp", part], capture_output=True, text=True, check=False)
        if done.returncode > 1:
            raise BoardError(f"the data partition: e2fsck says {done.returncode}\n{done.stdout}")
        yield lambda request: run("debugfs", "-R", request, part)
        part.unlink()

    def write(self, at, content):
        with open(self.path, "r+b") as disk:
            disk.seek(at)
            disk.write(content)


@contextlib.contextmanager
def powered(disk, *arguments, steady=True):
    with Board(bios=CACHE / "u-boot-emulated.bin", disks=[disk.path], steady=steady,
               arguments=(*CLOCK_FROM_0, *arguments)) as board:
        board.power_on()
        yield board


def boot_to_answer(disk, slot, ask=None):
    """One boot until the slot is good, then a power cut; what the console said. `ask` gets the board as soon as
    it is on."""
    with powered(disk) as board:
        board.expect(rf"tubesight: slot {slot}, boot 1 of 3", START_S)
        if ask is not None:
            ask(board)
        board.expect(rf"slot {slot} is good: the box answers", ANSWER_S)
        say(f"  slot {slot} is good {board.seconds_on()} s after power on, by the board's clock")
        return board.console


def boot_to_reboot(disk, slot, count, seconds, steady=False):
    """One boot that comes to no answer and ends itself."""
    with powered(disk, steady=steady) as board:
        board.expect(rf"tubesight: slot {slot}, boot {count} of 3", START_S)
        board.wait_off(seconds)
        return board.console


def disk_without_kernels(disk, work):
    """What U-Boot needs to count, and nothing that starts: a boot of some seconds."""
    small = Disk(work / "small")
    with open(small.path, "wb") as file:
        file.truncate(BOOT_PARTITION + 8 * MIB)
        file.seek(446)  # one partition, FAT, in the boot sector
        file.write(bytes((0x80, 0, 0, 0, 0x0C, 0, 0, 0)) + (BOOT_PARTITION // 512).to_bytes(4, "little")
                   + (8 * MIB // 512).to_bytes(4, "little"))
        file.seek(510)
        file.write(b"\x55\xaa")
    script = work / "boot.scr"
    run("mcopy", "-i", f"{disk.path}@@{BOOT_PARTITION}", "::boot.scr", script)
    with open(work / "fat", "wb") as fat:
        fat.truncate(8 * MIB)
    run("mkfs.vfat", work / "fat")
    run("mcopy", "-i", work / "fat", script, "::boot.scr")
    small.write(BOOT_PARTITION, (work / "fat").read_bytes())
    return small


def test_boot_count(disk, work):
    say("U-Boot counts, falls back, and bears a torn sector")
    small = disk_without_kernels(disk, work)
    expect(small.state(), {}, "the boot count of an empty disk")

    def boots(*wanted):
        for slot, count in wanted:
            boot_to_reboot(small, slot, count, 120)
            state = small.state()
            expect((state["ts_slot"], state["ts_tries"]), (slot, str(count)), "the boot count")

    boots(("a", 1), ("a", 2), ("a", 3), ("b", 1))
    expect((small.state()["ts_bad_a"], small.state()["ts_bad_b"]), ("1", "0"), "who has failed")
    # The sector that was written last: the boot before is the last one that counts.
    boots(("b", 2))
    small.write(COPIES[int(small.state()["ts_serial"], 16) % 2 == 0] + 77, b"torn")
    expect(small.state()["ts_tries"], "1", "the boot count after a torn write")
    boots(("b", 2), ("b", 3), ("a", 1))
    for copy in COPIES:
        small.write(copy, bytes(512))
    boots(("a", 1))
    test_raspberry_pi_counts(small, work)


def test_raspberry_pi_counts(small, work):
    """The U-Boot of the image's boot partition, on the emulator's Raspberry Pi 3, from its SD card."""
    say("the Raspberry Pi's own U-Boot counts on its card")
    with open(small.path, "r+b") as disk:
        disk.truncate(32 * MIB)  # cards are powers of two there
    tree = next((CACHE / "boot/usr/lib").glob("linux-image-*/broadcom/bcm2837-rpi-3-b.dtb"))
    says = work / "raspberry"
    subprocess.run(
        [tool("qemu-system-aarch64"), "-M", "raspi3b", "-kernel", CACHE / "boot/usr/lib/u-boot/rpi_arm64/u-boot.bin",
         "-dtb", tree, "-drive", f"file={small.path},if=sd,format=raw", "-display", "none", "-no-reboot",
         "-serial", "null", "-serial", f"file:{says}"],
        stdin=subprocess.DEVNULL, check=True, timeout=300)
    expect_in("tubesight: slot a, boot 2 of 3", says.read_text(errors="replace"), "U-Boot on its console")
    expect((small.state()["ts_slot"], small.state()["ts_tries"]), ("a", "2"), "the boot count on the card")


SETTINGS = """format = 1
[source]
kind = "simulated"
scenario = "still.toml"
[record]
folder = "/var/lib/tubesight"
[control]
socket = "/run/tubesight/control"
[link]
kind = "modbus"
device = "/dev/ttyS0"
baud = 115200
parity = "none"
unit = 17
"""
TUBE, NEIGHBOUR = (40, 60), (41, 60)
# The tool rests under TUBE. To draw takes an emulated board long: few pictures, so that a tool must be slow, and
# the window alone.
STILL = (pathlib.Path(__file__).parent / "round.toml").read_text(encoding="utf-8").partition("[path]")[0] \
    .replace("rate_hz = 29.97", "rate_hz = 7.5\nwindow_margin_px = 24") + """\
[motion]
max_speed_mm_s = 20
max_acceleration_mm_s2 = 200
max_turn_speed_deg_s = 10
max_turn_acceleration_deg_s2 = 100

[path]
tube = [40, 60]
height_mm = 55
speed_mm_s = 10

[[step]]
rest_s = 86400
"""
# Places in it, in 1/1000 px, as `tubesight simulate` writes them into its session.
CLICKS = [(*TUBE, 343000, 201000), (*NEIGHBOUR, 347000, 253000), (40, 59, 250000, 196000)]


def ask_as_robot(board):
    """Over the robot's line: the box waits, takes a start, and says which tube is before its camera."""
    robot = Robot(board.robot)
    robot.answers(ANSWER_S)
    say(f"  the first answer on the robot's line {board.seconds_on()} s after power on, by the board's clock")
    seen = robot.sighting()
    expect((seen.state, seen.tube, seen.vouched), (WAITING, None, False), "a box that was switched on")
    due = time.monotonic() + ANSWER_S
    # The line answers before the box has looked round for the first time.
    while (numbers := robot.read(684, 4))[0] == UNKNOWN_HIGH and time.monotonic() < due:
        time.sleep(0.2)
    expect(numbers, [0, 1, 0, 1], "the numbers of this boot and start")
    while (done := robot.start(CLICKS)) != (1, 0):
        if time.monotonic() > due:
            raise BoardError(f"the start is refused: {done}")
    for claimed, wanted in ((TUBE, "AGREE"), (NEIGHBOUR, "DISAGREE")):
        verdict = robot.claim(claimed)
        while verdict.word == "CANNOT SAY" and time.monotonic() < due:
            verdict = robot.claim(claimed)
        expect((verdict.word, verdict.seen), (wanted, TUBE), f"the verdict on {claimed}")
    say(f"  the robot is under {TUBE}: {seen.judged} fields judged before, {robot.sighting().judged} now")
    robot.pull_out()


def test_first_boot(disk):
    say("first boot, with a tubesight.txt of Windows's")
    disk.put_file("tubesight.txt",
                  b"\xef\xbb\xbfNAME = Box-7\r\ntime-zone = Europe/Paris\r\nnonsense\r\nsettings = Mine\r\n")
    disk.put_folder("MINE", {"BOX.TOML": (SETTINGS + "# by tubesight.txt\n").encode(),
                             "still.toml": STILL.encode()})
    expect(disk.state()["ts_tries"], "0", "boots counted on a fresh image")
    console = boot_to_answer(disk, "a", ask_as_robot)
    if not re.search(r"fields +[1-9][0-9]*, of which", console):
        raise BoardError(f"the box did not say that fields came:\n{console}")
    expect_in("tubesight.txt: line 3 REFUSED: 'nonsense' is no line of the form KEY = VALUE", console,
              "the console")
    expect(disk.boot_file("tubesight-result.txt").splitlines(), [
        "boot 1", "line 1: the box is called Box-7", "line 2: time zone Europe/Paris",
        "line 3 REFUSED: 'nonsense' is no line of the form KEY = VALUE",
        "line 4: 2 files of folder 'Mine' are the box's settings", "1 refused."], "tubesight-result.txt")
    state = disk.state()
    expect((state["ts_slot"], state["ts_tries"], state["ts_bad_a"], state["ts_proven_a"]),
           ("a", "0", "0", "1"), "the boot count after an answer")
    with disk.data() as ask:
        expect(ask("cat /board/current/hostname"), "Box-7\n", "the box's name")
        expect_in("# by tubesight.txt", ask("cat /settings/box.toml"), "the box's settings")
        # The service's own folder is the data partition's: it has numbered this boot there.
        expect_in("boot 1\n", ask("cat /state/boots"), "the boots that the box has counted")
        expect_in("User:   900 ", ask("stat /state"), "whose the box's folder is")
        machine = ask("cat /board/machine-id").strip()
        expect_in(machine, ask("ls -p /log"), "the journal's folder")


def size_of_file_system(ask):
    told = dict(line.split(":", 1) for line in ask("stats").splitlines() if ":" in line)
    return int(told["Block count"]) * int(told["Block size"])


def test_second_boot(disk):
    say("second boot: the same name and settings, nothing applied again")
    console = boot_to_answer(disk, "a")
    if "line 1: the box is called" in console:
        raise BoardError("tubesight.txt was applied at the second boot, too")
    with disk.data() as ask:
        expect(ask("cat /board/boots"), "2\n", "boots")
        expect_in("boot 2\n", ask("cat /state/boots"), "the boots that the box has counted")
        # By now, at the latest, it reaches to the card's end, of which 4 MiB stay free.
        expect(size_of_file_system(ask) // MIB, (GROWN - DATA) // MIB - 4, "the data's file system in MiB")
        expect(ask("cat /board/current/hostname"), "Box-7\n", "the box's name")
        expect_in("# by tubesight.txt", ask("cat /settings/box.toml"), "the box's settings")


def test_slot_without_root(disk):
    say("slot a has lost its root: slot b takes over after three boots, and stays")
    disk.write(ROOT_A, bytes(MIB))
    for count in (1, 2, 3):
        console = boot_to_reboot(disk, "a", count, ANSWER_S)
        expect_in("tubesight: slot a: its root cannot be mounted", console, "the console")
    console = boot_to_answer(disk, "b")
    expect_in("tubesight: slot a has not come to an answer 3 times", console, "U-Boot")
    expect_in("slot a: failed: three boots without an answer", console, "the console")
    expect((disk.state()["ts_slot"], disk.state()["ts_bad_a"]), ("b", "1"), "the boot count")
    boot_to_answer(disk, "b")


def test_box_that_dies(disk, package, work):
    say("slot a's box dies at each start: slot b takes over")
    broken = work / "broken"
    run("dpkg-deb", "-R", package, broken)
    (broken / "usr/bin/tubesightd").write_text("#!/bin/sh\nexit 1\n", encoding="ascii")
    run("dpkg-deb", "--root-owner-group", "-Zgzip", "-b", broken, work / "broken.deb")
    # In a cache of its own with the same packages: the good root stays there.
    cache = work / "cache"
    run("cp", "-rl", CACHE, cache)
    build(work / "broken.img", work / "broken.deb", cache)
    with open(work / "broken.img", "rb") as image:
        image.seek(ROOT_A)
        disk.write(ROOT_A, image.read(ROOT_B - ROOT_A))
    state = disk.state()
    for count in (1, 2, 3):
        console = boot_to_reboot(disk, "a", count, ANSWER_S + PATIENCE_S, steady=True)
        expect_in("no answer from the box in slot a: the board starts again", console, "the console")
    boot_to_answer(disk, "b")
    expect((disk.state()["ts_bad_a"], state["ts_bad_a"]), ("1", "0"), "the boot count")


def test_network(disk, work):
    say("a network and a key in tubesight.txt: who has the key comes in, nothing else listens")
    run("ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", work / "key")
    public = (work / "key.pub").read_text(encoding="ascii").strip()
    disk.put_file("tubesight.txt", f"name = box-8\nnetwork = dhcp\nssh-key = {public}\n".encode())
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    # The emulator's own network, which ends at this machine.
    wire = ("-netdev", f"user,id=wire,restrict=on,hostfwd=tcp:127.0.0.1:{port}-:22",
            "-device", "virtio-net-pci,netdev=wire,romfile=")
    with powered(disk, *wire) as board:
        board.expect(r"slot a is good: the box answers", ANSWER_S)

        def ask(*words):
            return run("ssh", "-i", work / "key", "-p", port, "-o", "StrictHostKeyChecking=no", "-o",
                       f"UserKnownHostsFile={work}/hosts", "-o", "BatchMode=yes", "-o", "ConnectTimeout=120",
                       "root@127.0.0.1", *words)
        expect_in("tracking", ask("tubesightctl status"), "tubesightctl")
        listening = ask("ss -Hlntu").split("\n")
        others = [line for line in listening if line.strip() and not re.search(r":22 |:68 ", line)]
        expect(others, [], "what else listens")
        expect(ask("hostname").strip(), "box-8", "the name")
        expect(ask("systemctl --failed --no-legend --plain").strip(), "", "units that failed")
        expect(ask("ps -o user= -C tubesightd").strip(), "tubesight", "the box's user")
        say("  " + ask("free -m | sed -n 2p").strip())


def build(out, package, cache=CACHE):
    begin = time.monotonic()
    done = subprocess.run([IMAGE_SCRIPT, "--package", package, out], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=False,
                          env={**os.environ, "TUBESIGHT_IMAGE_CACHE": str(cache)})
    if done.returncode != 0:
        raise BoardError(f"the image could not be built:\n{done.stdout}{done.stderr}")
    say(f"  {done.stdout.strip()}, built in {time.monotonic() - begin:.0f} s")


def pack(cpack, folder, work):
    """The package: of a build folder, or of package.sh, which builds what it needs."""
    if cpack is not None:
        run(cpack, "--config", folder / "CPackConfig.cmake", "-B", work / "packages")
    else:
        done = subprocess.run([IMAGE_SCRIPT.with_name("package.sh"), "arm64", work / "packages"],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise BoardError(f"the package could not be built:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return next((work / "packages").glob("tubesight_*.deb"))


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--package", type=pathlib.Path)
    parser.add_argument("--cpack", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path)
    parser.add_argument("--long", action="store_true")
    arguments = parser.parse_args()
    work = pathlib.Path(tempfile.mkdtemp(prefix="image"))
    try:
        package = arguments.package or pack(arguments.cpack, arguments.build, work)
        build(work / "box.img", package)
        disk = Disk(work / "disk", work / "box.img")
        test_boot_count(disk, work)
        test_first_boot(disk)
        if arguments.long:
            test_second_boot(disk)
            test_slot_without_root(disk)
            test_network(Disk(work / "disk3", work / "box.img"), work)
            test_box_that_dies(Disk(work / "disk2", work / "box.img"), package, work)
    except BoardError as error:
        sys.exit(f"image_test: {error}")
    finally:
        shutil.rmtree(work)


if __name__ == "__main__":
    main()
