#!/usr/bin/env python3
"""Cuts the power while the product writes, and looks at what the disk has then.

Usage: power_cut_test.py [--cuts N] [--kills N] [--troubles N] [--seed N] [--keep FOLDER] --programs FOLDER
                         [--draw PROGRAM...] [--emulator COMMAND] [--strip PROGRAM] --checker PROGRAM
                         --skip-fsync LIBRARY

On the emulated board the arm64 programs write settings, calibrations, recordings and pairs to an ext4 disk,
and what they said to be written is marked behind the file system (power_cut_guest.sh). Then

    cuts      each request that reached the disk was logged; prefixes of the log are replayed, every other one
              without a random part of what was written since the last flush, as a disk may leave it
    kills     the emulator is killed at random instants, and the board boots again from what is there

and each time the file system is repaired and its content read by the product's own readers
(power_cut_checker.cpp): old or new and whole, never older than what was said to be written. A run whose
programs skip fsync shows that this would be found out. The last part,

    troubles  the disk is full, and then read-only: all say so, nothing old is lost, and all go on afterwards
"""
import argparse
import concurrent.futures
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

import power_cut_share
import write_log
from board_machine import STEADY, Board
from board_parts import ROOT, BoardError, initramfs, libraries, run, tool

HERE = pathlib.Path(__file__).resolve().parent
DISK_MB = 48       # recordings take 16 of it, and the one that is written
BLOCK = 4096       # of the file system, and of a mark
KINDS = ("zones", "base", "recording", "pairs")
ENOUGH = {"zones": 8, "base": 8, "recording": 8, "pairs": 2}
WORKERS = 2
LIBRARIES = ("/usr/aarch64-linux-gnu/lib",
             ROOT / "build" / "sysroot-arm64" / "usr" / "lib" / "aarch64-linux-gnu")
WRITTEN_S = 400  # a quiet machine takes 15


def make_disk(path):
    """An empty ext4 file system with room for the marks behind it."""
    with open(path, "wb") as file:
        file.truncate((DISK_MB << 20) + len(KINDS) * BLOCK)
    run("mke2fs", "-q", "-F", "-t", "ext4", "-b", BLOCK, "-E", "lazy_itable_init=0,lazy_journal_init=0", path,
        f"{DISK_MB}M")
    return path


def take_mark(data, said):
    """Puts the mark `data`, "zones 12", into `said`: the version that was said to be written, a kind each."""
    if match := re.match(rb"(\w+) (\d+) ", data):
        said[match[1].decode()] = int(match[2])


def marks_on(image):
    said = {}
    with open(image, "rb") as file:
        for slot in range(len(KINDS)):
            take_mark(os.pread(file.fileno(), BLOCK, (DISK_MB << 20) + slot * BLOCK), said)
    return said


class Checker:
    """Repairs a disk, takes the files out of it, and judges them."""

    def __init__(self, command, work):
        self._work = work
        self._reader = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def close(self):
        self._reader.stdin.close()
        self._reader.wait(20)

    def judge(self, image, said):
        """What is wrong with the disk at `image`, which is changed; empty: nothing."""
        folder = self._work / "files"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        repair = subprocess.run([tool("e2fsck"), "-fy", image], stdin=subprocess.DEVNULL, capture_output=True,
                                text=True)
        if repair.returncode & ~3:
            return [f"e2fsck: status {repair.returncode}: {repair.stdout.strip()}"]
        subprocess.run([tool("debugfs"), "-R", f"rdump / {folder}", image], stdin=subprocess.DEVNULL,
                       capture_output=True, check=True)
        self._reader.stdin.write(f"{folder}\n")
        self._reader.stdin.flush()
        line = self._reader.stdout.readline().rstrip("\n")
        if not line:
            return ["the checker ended"]
        wrong = list(judge_files(dict(part.split(" ", 1) for part in line.split("\t")), said))
        return [f"{'; '.join(wrong)} (on the disk: {line}; said to be written: {said})"] if wrong else []


def judge_files(found, said):
    """The rules: whole, not older than what was said, and the version before beside settings."""
    def version(name):
        return 0 if found[name] == "none" else int(found[name].split()[-1])

    for name, what in found.items():
        if what.startswith("bad"):
            yield f"{name}: {what}"
            return
    for kind in KINDS:
        name = "recordings" if kind == "recording" else kind
        if version(name) < said.get(kind, 0):
            yield f"{name}: {found[name]}, expected {said[kind]} at least"
    for name in ("zones", "base"):
        now, before = version(name), version(name + ".bak")
        if now >= 2 and not now - 1 <= before <= now:
            yield f"{name}.bak: {found[name + '.bak']}, expected {now - 1} beside {now}"


class Cut:
    """A point of the log at which the power goes; every other one loses a part of what was not flushed."""

    def __init__(self, number, at, seed):
        self.number, self.at, self.loses = number, at, number % 2 == 1
        self._random = random.Random(f"{seed} {number}")
        self._share = self._random.random()

    def keep(self):
        return self._random.random() < self._share

    def __str__(self):
        return f"cut {self.number}, at request {self.at}{', with losses' if self.loses else ''}"


def judge_cuts(log_path, start, cuts, command):
    """What is wrong at each of these cuts, which are in the log's order."""
    log = write_log.WriteLog(log_path)
    wrong = []
    with tempfile.TemporaryDirectory(prefix="cuts") as name:
        work = pathlib.Path(name)
        image = work / "flushed"
        run("cp", "--sparse=always", start, image)
        checker = Checker(command, work)
        said, done = {}, 0
        with open(image, "r+b") as file:
            for cut in cuts:
                certain = log.last_flush(cut.at)
                for entry in log.entries[done:certain]:
                    log.apply(file.fileno(), entry)
                done = max(done, certain)
                run("cp", "--sparse=auto", image, work / "cut")
                with open(work / "cut", "r+b") as broken:
                    for entry in log.entries[certain:cut.at]:
                        log.apply(broken.fileno(), entry, cut.keep if cut.loses else None)
                said = said_before(log, cut.at)
                wrong += [f"{cut}: {what}" for what in checker.judge(work / "cut", said)]
        checker.close()
    return wrong


def said_before(log, at):
    said = {}
    for entry in log.entries[:at]:
        if entry.writes and entry.place >= DISK_MB << 20:
            take_mark(log.data[entry.at:entry.at + BLOCK], said)
    return said


class PowerCuts:
    def __init__(self, options, work):
        self._options, self._work = options, work
        emulator = options.emulator.split()
        self._checker = [*emulator, str(options.checker)]
        self._random = random.Random(options.seed)
        programs = []
        for name in ("tubesight", "tubesightd", "tubesightctl"):
            run(options.strip, "-o", work / name, options.programs / name)
            programs.append(work / name)
        files = {f"bin/{path.name}": path for path in programs}
        files.update(libraries(programs, LIBRARIES))
        files["lib/skip_fsync.so"] = options.skip_fsync
        files["power_cut_guest.sh"] = HERE / "power_cut_guest.sh"
        self._initramfs = initramfs(work / "initramfs", names=("virtio_blk", "ext4"), files=files)
        self._share = work / "share"
        drawn_by = [[path] for path in options.draw if os.access(path, os.X_OK) and os.path.isfile(path)]
        power_cut_share.make(self._share, [*drawn_by, [*emulator, str(options.programs / "tubesight")]][0])

    def _board(self, arguments=(), **more):
        # Its clock counts instructions, so that the boxes keep up with their pictures; it need not go before all.
        return Board(initramfs=self._initramfs, share=self._share, arguments=(*STEADY, *arguments), **more)

    @staticmethod
    def _begin(board, preload=""):
        board.boot()
        board.type(f"go sh /power_cut_guest.sh {DISK_MB * 256} {preload} &\n")
        board.expect(r"^writer: mounted", 60)

    def _written(self, name, enough, preload=""):
        """Lets the board write until there is enough; its log and the disk it began with."""
        start, image, log = (self._work / f"{name}.{part}" for part in ("start", "image", "log"))
        make_disk(start)
        run("cp", "--sparse=always", start, image)
        with open(log, "wb") as file:
            file.truncate(2 << 30)
        limit = time.monotonic() + WRITTEN_S
        with self._board(arguments=write_log.arguments(image, log)) as board:
            self._begin(board, preload)
            while any(marks_on(image).get(kind, 0) < least for kind, least in enough.items()):
                time.sleep(0.25)
                if time.monotonic() > limit or not board.alive():
                    raise BoardError(f"the board wrote too little: {marks_on(image)}\n{board.console}")
                if "writer: failed" in board.console:
                    raise BoardError(f"the product failed on the board:\n{board.console}")
            board.cut_power()
        return start, log

    def _cuts(self, name, count, enough, preload=""):
        start, log_path = self._written(name, enough, preload)
        log = write_log.WriteLog(log_path)
        flushes = sum(entry.flags & write_log.FLUSH for entry in log.entries)
        print(f"{name}: {len(log.entries)} requests, {flushes} flushes; said to be written at the end:"
              f" {said_before(log, len(log.entries))}", flush=True)
        places = sorted(self._random.randrange(1, len(log.entries) + 1) for _ in range(count))
        cuts = [Cut(number, at, self._options.seed) for number, at in enumerate(places)]
        share = (len(cuts) + WORKERS - 1) // WORKERS
        parts = [cuts[begin:begin + share] for begin in range(0, len(cuts), share)]
        with concurrent.futures.ProcessPoolExecutor(WORKERS) as pool:
            found = pool.map(judge_cuts, [log_path] * len(parts), [start] * len(parts), parts,
                             [self._checker] * len(parts))
            return [wrong for part in found for wrong in part]

    def cuts(self):
        return self._cuts("cuts", self._options.cuts, ENOUGH)

    def self_proof(self):
        """What is wrong with a product that skips fsync."""
        return self._cuts("without-fsync", 40, {"zones": 4, "base": 6, "recording": 2},
                          "/lib/skip_fsync.so")

    def kills(self):
        image, wrong = make_disk(self._work / "kills.image"), []
        checker = Checker(self._checker, self._work)
        for number in range(self._options.kills):
            with self._board(disks=(image,)) as board:
                self._begin(board)
                begin = marks_on(image)
                # A box takes longer to begin than a command does: a half of the kills waits for it.
                kind, limit = self._random.choice(("base", "recording")), time.monotonic() + 60
                enough = begin.get(kind, 0) + self._random.randrange(1, 4)
                while marks_on(image).get(kind, 0) < enough and time.monotonic() < limit:
                    time.sleep(0.02)
                time.sleep(self._random.uniform(0.0, 0.3))
                board.cut_power()
            said = marks_on(image)
            run("cp", "--sparse=auto", image, self._work / "killed")
            wrong += [f"kill {number}: {what}" for what in checker.judge(self._work / "killed", said)]
        checker.close()
        print(f"kills: said to be written at the end: {marks_on(image)}", flush=True)
        return wrong


    def troubles(self):
        """A full disk and one that went read-only: what each writer says, and that all goes on afterwards."""
        image, wrong = make_disk(self._work / "troubles.image"), []

        def expect(what, pattern, seconds=0.0):
            """The board says what is expected to the command, if need be after some seconds."""
            due = time.monotonic() + seconds
            while True:
                status, text = board.run(what)
                text = f"status {status} {text.strip()}"
                if re.search(pattern, text, re.DOTALL):
                    return
                if time.monotonic() > due:
                    wrong.append(f"{what}: {text}\n  expected {pattern}")
                    return
                time.sleep(0.2)

        base = ("cd /tmp; sed s/DEPTH/97{}/ /share/base_pairs.csv > p.csv; tubesight calibrate base p.csv"
                " --sheet /share/tiny.session.toml --out /data/base.toml")
        record = "tubesightctl --socket /run/recorder/box record"
        status = "tubesightctl --socket /run/pairs/box status"
        with self._board(disks=(image,)) as board:
            board.boot()
            board.do("mkdir /data /run/recorder /run/pairs; mount -t ext4 /dev/vda /data")
            board.do("for box in recorder pairs; do tubesightd /share/$box.toml > /tmp/$box.out 2>&1 & done")
            expect(base.format(1), "^status 0")
            expect(status, r"pairs .* [1-9]\d* written", 60)
            expect(record, "^status 0 written", 30)
            # dd is root, who may use what ext4 keeps back.
            board.run("dd if=/dev/zero of=/data/full bs=64k; dd if=/dev/zero of=/data/more bs=512")
            expect(base.format(2), "^status 1.*/data/base.toml.*: cannot be written: No space left on device")
            expect("grep -c 1001.0 /data/base.toml; ls /data | grep part", "^status 1 1$")
            expect(record, "^status 1 .*the disk is full", 10)
            board.run("dd if=/dev/zero of=/data/again bs=512")  # what an older recording left
            expect(status, r"pairs .* [1-9]\d* lost.*No space left", 60)
            board.do("rm /data/full /data/more /data/again")
            expect(base.format(3), "^status 0")
            expect(record, "^status 0 written", 10)
            board.do("echo u > /proc/sysrq-trigger; sleep 1")
            expect(base.format(4), "^status 1.*/data/base.toml: cannot be written: Read-only file system")
            expect("grep -c 1003.0 /data/base.toml", "^status 0")
            expect(record, "^status 1 .*Read-only file system", 10)
            expect(status, r"pairs .* [1-9]\d* lost.*Read-only file system", 60)
            board.do("mount -o remount,rw /data")
            expect(base.format(5), "^status 0")
            expect(record, "^status 0 written", 10)
            expect("grep -c 1003.0 /data/base.toml.bak", "^status 0")
            board.cut_power()
        return wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--cuts", type=int, default=300)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--troubles", type=int, default=1)
    parser.add_argument("--seed", type=int, default=34)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--programs", type=pathlib.Path, required=True)
    parser.add_argument("--draw", nargs="*", default=[], help="programs that draw, best first")
    parser.add_argument("--strip", default="aarch64-linux-gnu-strip")
    parser.add_argument("--skip-fsync", type=pathlib.Path, required=True)
    parser.add_argument("--checker", type=pathlib.Path, required=True)
    parser.add_argument("--emulator", default="", help="what starts a program for arm64 here")
    options = parser.parse_args()
    print(f"seed {options.seed}", flush=True)
    with tempfile.TemporaryDirectory(prefix="power") as name:
        work = options.keep or pathlib.Path(name)
        work.mkdir(parents=True, exist_ok=True)
        failed = False
        try:
            tests = PowerCuts(options, work)
            for part, count in ((tests.cuts, options.cuts), (tests.kills, options.kills),
                                (tests.troubles, options.troubles)):
                begin = time.monotonic()
                wrong = part() if count else []
                print(f"{part.__name__}: {count}, of which {len(wrong)} wrong,"
                      f" {time.monotonic() - begin:.0f} s", flush=True)
                print("\n".join(wrong[:20]))
                failed = failed or bool(wrong)
            found = tests.self_proof()
            print(f"without fsync: {len(found)} of 40 found out, such as: {found[0] if found else 'none'}")
            failed = failed or len(found) < 5
        except BoardError as error:
            sys.exit(f"{sys.argv[0]}: {error}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
