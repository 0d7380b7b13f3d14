"""The emulated board: a machine of qemu-system-aarch64 with its console, its robot's line, its disks and pins.

    with Board(initramfs=path, share=folder) as board:
        board.boot()
        status, text = board.run("uname -r")
        board.robot                     # the host's end of the board's /dev/ttyS0

Leaves no process behind, however the test ends: the emulator dies with its starter. Nothing waits without
end: each wait has its seconds.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import threading
import time

from board_parts import BoardError, kernel, tool

# With `-cpu max` the kernel takes four times as long to boot.
MACHINE = ("-M", "virt", "-cpu", "cortex-a53", "-smp", "2")
STEADY = ("-icount", "shift=1,sleep=on")
# The board's real-time clock counts from its power on, by the clock that the board's programs have.
CLOCK_FROM_0 = ("-rtc", "base=1970-01-01T00:00:00,clock=vm")
COMMAND_LINE = "console=ttyAMA0 loglevel=1 panic=-1 rdinit=/init"
BOOT_S = 90.0  # a quiet machine takes 3


class Lines:
    """What comes from a file without end, read by a thread of its own and waited for with a limit."""

    def __init__(self, file, log):
        self._file, self._log = file, log
        self._text = ""
        self._ended = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def _read(self):
        while piece := os.read(self._file.fileno(), 65536):
            self._log.write(piece)
            self._log.flush()
            with self._changed:
                self._text += piece.decode("utf-8", "replace").replace("\r", "")
                self._changed.notify_all()
        with self._changed:
            self._ended = True
            self._changed.notify_all()

    def end(self):
        """When nobody writes any more."""
        self._thread.join(10.0)

    @property
    def text(self):
        with self._changed:
            return self._text

    def wait_for(self, pattern, seconds, begin=0):
        """The match of the regular expression behind `begin`; None after so many seconds, or at the end."""
        expression = re.compile(pattern, re.MULTILINE)
        due = time.monotonic() + seconds
        with self._changed:
            while True:
                if match := expression.search(self._text, begin):
                    return match
                left = due - time.monotonic()
                if left <= 0 or self._ended:
                    return None
                self._changed.wait(left)


class Channel:
    """A socket of the emulator's on which a line is answered by a line."""

    def __init__(self, path, seconds=20.0):
        due = time.monotonic() + seconds
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.settimeout(seconds)
        while True:
            try:
                self._socket.connect(str(path))
                break
            except (FileNotFoundError, ConnectionRefusedError):
                if time.monotonic() > due:
                    raise BoardError(f"the emulator has no {path}") from None
                time.sleep(0.01)
        self._lines = self._socket.makefile("r", encoding="utf-8")

    def read(self):
        line = self._lines.readline()
        if not line:
            raise BoardError("the emulator has gone")
        return line

    def send(self, line):
        self._socket.sendall(line.encode() + b"\n")

    def close(self):
        self._lines.close()
        self._socket.close()


def _ahead():
    """What makes a program go before all others, if that is allowed here."""
    words = (tool("chrt"), "--rr", "2")
    return words if subprocess.run([*words, "true"], capture_output=True).returncode == 0 else ()


class Board:
    """One machine, from its power on to its power off.

    initramfs   with Debian's kernel; or
    bios        a boot loader, which finds all on the disks
    disks       paths of raw images: /dev/vda, /dev/vdb ...
    share       a folder of the host, /share on the board
    append      more words of the kernel's command line
    dtb         another device tree
    pins        a file that gets a line for each change of the PL061's pins, with its time
    steady      the board's clock counts instructions, 500 million a second, and the emulator goes before
                all else where the system allows it: so a busy PC delays no field
    arguments   more arguments of the emulator
    """

    def __init__(self, initramfs=None, bios=None, disks=(), share=None, append="", dtb=None, pins=None,
                 steady=False, arguments=(), memory_mb=512, log=None):
        self._work = pathlib.Path(tempfile.mkdtemp(prefix="board"))  # short: sockets' names are
        self._said = None
        self._process = None
        self._channels = {}
        self._robot = None
        self._count = 0
        command = [tool("setpriv"), "--pdeathsig", "KILL", *(_ahead() if steady else ()),
                   tool("qemu-system-aarch64"), *MACHINE, *(STEADY if steady else ()),
                   "-m", str(memory_mb), "-nographic", "-nodefaults", "-no-reboot", "-serial", "stdio",
                   "-qmp", f"unix:{self._work}/qmp,server=on,wait=off",
                   "-qtest", f"unix:{self._work}/qtest,server=on,wait=off", "-qtest-log", "none",
                   "-chardev", "pty,id=robot", "-device", "pci-serial,chardev=robot"]
        if bios is not None:
            command += ["-bios", str(bios)]
        if initramfs is not None:
            command += ["-kernel", str(kernel()), "-initrd", str(initramfs),
                        "-append", f"{COMMAND_LINE} {append}".strip()]
        for disk in disks:
            command += ["-drive", f"file={disk},if=virtio,format=raw"]
        if share is not None:
            command += ["-virtfs", f"local,path={share},mount_tag=share,security_model=none"]
        if dtb is not None:
            command += ["-dtb", str(dtb)]
        if pins is not None:
            command += ["-trace", "pl061_set_output", "-D", str(pins), "-msg", "timestamp=on"]
        self._command = command + [str(word) for word in arguments]
        self._log = open(log or self._work / "console", "wb")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    # Power

    def power_on(self):
        """The emulator runs; nothing is waited for."""
        self._process = subprocess.Popen(self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                         stderr=subprocess.STDOUT, start_new_session=True)
        self._said = Lines(self._process.stdout, self._log)

    def boot(self, seconds=BOOT_S):
        """Powers the board on; the seconds until board_init.sh takes commands."""
        begin = time.monotonic()
        self.power_on()
        self.expect(r"^board: ready", seconds)
        return time.monotonic() - begin

    def alive(self):
        return self._process is not None and self._process.poll() is None

    def cut_power(self):
        """Ends the emulator in the middle of whatever it does."""
        if self.alive():
            os.killpg(self._process.pid, signal.SIGKILL)
        if self._process is not None:
            self._process.wait()
            self._said.end()
            self._process.stdin.close()
            self._process.stdout.close()
        for channel in self._channels.values():
            channel.close()
        self._channels.clear()
        self._robot = None

    def wait_off(self, seconds):
        """After the board was told to switch itself off."""
        try:
            self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            raise BoardError(f"still on after {seconds} s{self._tail()}") from None
        self.cut_power()

    def close(self):
        self.cut_power()
        self._log.close()
        shutil.rmtree(self._work, ignore_errors=True)

    # Console

    @property
    def console(self):
        """All that the board has said since it was powered on."""
        return self._said.text

    def _tail(self):
        return "\nthe end of its console:\n  " + "\n  ".join(self.console.splitlines()[-25:])

    def expect(self, pattern, seconds, begin=0):
        """Waits until the console shows the regular expression."""
        match = self._said.wait_for(pattern, seconds, begin)
        if match is None:
            state = "within" if self.alive() else "though the emulator has ended, which was given"
            raise BoardError(f"the board did not say '{pattern}' {state} {seconds} s{self._tail()}")
        return match

    def type(self, text):
        """Types on the console."""
        self._process.stdin.write(text.encode())
        self._process.stdin.flush()

    def run(self, command, seconds=30.0):
        """Exit status and output of a line for the shell, on a board with board_init.sh."""
        self._count += 1
        word = f"end-{self._count}"
        begin = len(self.console)
        self.type(f"{word} {command}\n")
        match = self.expect(rf"@{word} (\d+)$", seconds, begin)
        return int(match[1]), self.console[begin:match.start()]

    def do(self, command, seconds=30.0):
        """The output of a command that must succeed."""
        status, text = self.run(command, seconds)
        if status != 0:
            raise BoardError(f"on the board, exit status {status}: {command}\n{text}")
        return text

    # Machine

    def qmp(self, command, **arguments):
        """What the emulator's monitor answers."""
        channel = self._channels.get("qmp")
        if channel is None:
            channel = self._channels["qmp"] = Channel(self._work / "qmp")
            channel.read()  # its greeting
            self.qmp("qmp_capabilities")
        channel.send(json.dumps({"execute": command, "arguments": arguments}))
        while True:
            answer = json.loads(channel.read())
            if "error" in answer:
                raise BoardError(f"{command}: {answer['error']['desc']}")
            if "return" in answer:
                return answer["return"]

    def monitor(self, line):
        """What the monitor for people answers: "xp /8xw 0x5fff0000" reads the board's memory."""
        return self.qmp("human-monitor-command", **{"command-line": line})

    def qtest(self, line):
        """What the emulator's test protocol answers: "readb 0x90303fc"."""
        channel = self._channels.get("qtest")
        if channel is None:
            channel = self._channels["qtest"] = Channel(self._work / "qtest")
        channel.send(line)
        while True:
            answer = channel.read().strip()
            if answer.startswith("OK"):
                return answer[2:].strip()
            if not answer.startswith("IRQ"):
                raise BoardError(f"{line}: {answer}")

    def seconds_on(self):
        """Whole seconds since its power on by its own clock, of a board with CLOCK_FROM_0."""
        return int(self.qtest("readl 0x9010000"), 16)

    @property
    def robot(self):
        """The host's path of the line that is /dev/ttyS0 on the board."""
        if self._robot is None:
            for device in self.qmp("query-chardev"):
                if device["label"] == "robot":
                    self._robot = device["filename"].partition(":")[2]
        return self._robot

    @property
    def process(self):
        """Of the emulator: its id, None before it was powered on."""
        return self._process.pid if self._process else None
