#!/usr/bin/env python3
"""What the operator's page takes of a processor: its threads' time while two viewers look at 30 pictures a second.

Usage: page_cpu.py [--seconds S] TUBESIGHTD TUBESIGHTCTL

A simulated box of 635 x 480 in real time, once in clear and once by TLS; the time is the kernel's, of the threads `page`
(server, TLS), `page-pictures` (fields, JSON, JPEG) and `page-jobs`, in steps of 10 ms.
"""
import argparse
import os
import pathlib
import ssl
import subprocess
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "system"))

# pylint: disable=wrong-import-position
from page_box import Box, Browser, SIMULATED
from page_load import Cleanup

PICTURES_PER_S = 30
TICK_MS = 1000 / os.sysconf("SC_CLK_TCK")


def thread_times(process):
    """Milliseconds that each thread of the page took so far, by its name."""
    times = {}
    for task in pathlib.Path(f"/proc/{process}/task").iterdir():
        name, _, rest = (task / "stat").read_text().partition("(")[2].rpartition(")")
        if name.startswith("page"):
            fields = rest.split()
            times[name] = times.get(name, 0) + TICK_MS * (int(fields[11]) + int(fields[12]))
    return times


def look(browser, until, pictures):
    """Asks for the newest picture 30 times a second."""
    browser.begin()
    due = time.monotonic()
    while time.monotonic() < until:
        pictures.append(browser.frame()[0] == 200)
        due += 1 / PICTURES_PER_S
        time.sleep(max(0.0, due - time.monotonic()))


def measure(program, ctl, seconds, tls):
    """(milliseconds of each thread, pictures) in so many seconds."""
    with Cleanup() as cleanup:
        page = 'certificate = "cert.pem"\nkey = "key.pem"\n' if tls else ""
        box = Box(cleanup, program, page, source=SIMULATED + "script = true\n")
        context = None
        if tls:
            subprocess.run([ctl, "page-certificate", box.folder / "cert.pem", box.folder / "key.pem", "127.0.0.1"], check=True,
                           stdout=subprocess.DEVNULL)
            context = ssl.create_default_context(cafile=str(box.folder / "cert.pem"))
        box.start(cleanup)
        time.sleep(1.5)
        pictures, until = [], time.monotonic() + seconds
        before = thread_times(box.process.pid)
        viewers = [threading.Thread(target=look, args=(Browser(box.port, context), until, pictures)) for _ in range(2)]
        for viewer in viewers:
            viewer.start()
        for viewer in viewers:
            viewer.join()
        after = thread_times(box.process.pid)
        return {name: after[name] - before.get(name, 0) for name in after}, sum(pictures)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("program")
    parser.add_argument("ctl")
    arguments = parser.parse_args()
    for tls in (False, True):
        times, pictures = measure(arguments.program, arguments.ctl, arguments.seconds, tls)
        share = sum(times.values()) / 10 / arguments.seconds
        print(f"{'TLS' if tls else 'in clear'}: {pictures / arguments.seconds:.1f} pictures a second to two viewers, "
              f"{share:.1f} % of a processor ("
              + ", ".join(f"{name} {took / 10 / arguments.seconds:.1f} %" for name, took in sorted(times.items())) + ")")


if __name__ == "__main__":
    main()
