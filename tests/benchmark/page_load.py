#!/usr/bin/env python3
"""Whether the operator's page delays the tracking: a simulated box in real time, alone, looked at, and flooded.

Usage: page_load.py [--seconds S] [--rounds N] TUBESIGHTD

Each round starts the box three times for S seconds (20): nobody at the page; four viewers; four viewers and a flood of
requests, connections, sessions, bodies, logins, lattice searches, readers that do not read and requests that do not end
(tests/system/page_flood.py). Printed is what the tracking thread tells of itself, the best of N rounds (3) each, as the
machine may have other work, and the ratio to the box alone. The clients run with nice 5 on the same machine, as a browser
on the network takes no time of the box's.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "system"))

# pylint: disable=wrong-import-position
import page_flood
from page_box import Box, Browser, SIMULATED

FIGURES = (("step", "median_us"), ("step", "p99_us"), ("grab_to_sighting", "median_us"), ("grab_to_sighting", "p99_us"))


class Cleanup:
    """What unittest.TestCase would undo."""

    def __init__(self):
        self.kept = []

    def addCleanup(self, function, *arguments):  # pylint: disable=invalid-name
        self.kept.append((function, arguments))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for function, arguments in reversed(self.kept):
            function(*arguments)


def crowd_alone(port, viewers, flood, seconds):
    """The crowd in a process of its own, so that what is measured is not its interpreter."""
    code = (f"import sys, time, json; sys.path.insert(0, {str(pathlib.Path(page_flood.__file__).parent)!r}); import page_flood\n"
            f"crowd = page_flood.Crowd(); page_flood.add_viewers(crowd, {port}, {viewers})\n"
            + (f"page_flood.add_flood(crowd, {port})\n" if flood else "")
            + f"time.sleep({seconds}); crowd.stop(); print(json.dumps(crowd.done))")
    return subprocess.Popen([sys.executable, "-B", "-c", code], stdout=subprocess.PIPE, text=True,
                            preexec_fn=lambda: os.nice(5))


def measure(program, seconds, viewers, flood):
    """The status of a box after so long, and what the crowd did."""
    with Cleanup() as cleanup:
        box = Box(cleanup, program, source=SIMULATED + "script = true\n", realtime="").start(cleanup)
        time.sleep(1.0)
        asking, done = Browser(box.port), {}
        asking.begin()  # before the flood takes all sessions
        if viewers:
            crowd = crowd_alone(box.port, viewers, flood, seconds)
            cleanup.addCleanup(crowd.wait)
            done = json.loads(crowd.communicate()[0])
        else:
            time.sleep(seconds)
        asking.connection = None
        return asking.ask("GET", "/api/status")[1], done


TRACKED = 0.9  # A round counts when so many of its fields were judged: lost fields are cheap and prove nothing.


def best(statuses):
    """Of the rounds in which the box tracked: each quantile's least, the counts' sums."""
    statuses = [each for each in statuses if each["tracking"]["judged_fields"] >= TRACKED * each["counters"]["fields"]]
    if not statuses:
        sys.exit("page_load: the box lost its track in each round, as it does when its simulation comes too late: "
                 "measure on a machine with less to do, or with more --rounds")
    made = {f"{part} {key}": min(each[part][key] for each in statuses) for part, key in FIGURES}
    made["rounds"] = len(statuses)
    made["grab_to_sighting worst_us"] = min(each["grab_to_sighting"]["worst_us"] for each in statuses)
    made["fields judged"] = sum(each["tracking"]["judged_fields"] for each in statuses)
    made["fields missing"] = sum(each["counters"]["missing"] for each in statuses)
    made["made late by the simulation"] = sum(each["source"]["made_late"] for each in statuses)
    made["later than the deadline"] = sum(each["late"] for each in statuses)
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("program")
    arguments = parser.parse_args()
    loads = {"alone": (0, False), "4 viewers": (4, False), "4 viewers, flood": (4, True)}
    found, crowds = {name: [] for name in loads}, {}
    for _ in range(arguments.rounds):
        for name, (viewers, flood) in loads.items():
            status, crowds[name] = measure(arguments.program, arguments.seconds, viewers, flood)
            found[name].append(status)
    rows = {name: best(statuses) for name, statuses in found.items()}
    print(f"{os.cpu_count()} processors, {arguments.rounds} rounds of {arguments.seconds:g} s; priority of the tracking thread: "
          f"{found['alone'][0]['realtime']['priority'] if found['alone'][0]['realtime']['scheduled'] else 'none'}")
    print(f"{'':30}" + "".join(f"{name:>24}" for name in rows))
    for figure in rows["alone"]:
        line = f"{figure:30}"
        for name, row in rows.items():
            alone = rows["alone"][figure]
            ratio = f" ({row[figure] / alone:.2f})" if figure.endswith("_us") and alone and name != "alone" else ""
            line += f"{str(row[figure]) + ratio:>24}"
        print(line)
    for name, done in crowds.items():
        if done:
            pictures = [count for act, count in done.items() if act.startswith("viewer")]
            print(f"{name}, last round: pictures {pictures}, "
                  + ", ".join(f"{count} {act}" for act, count in done.items() if not act.startswith("viewer")))


if __name__ == "__main__":
    main()
