#!/usr/bin/env python3
"""Counts the instructions of the tracking path with callgrind: a field, and a tube-end measured.

Usage: instructions.py [--check] [--by-function N] TRACK_FIELDS FOLDER...
       instructions.py [--check] --drawing DRAW_FIELDS
       instructions.py --self-test

TRACK_FIELDS is the program of that name. Counted is step() alone, in fixed point, over all fields
behind the start's, everything of the field shared out over its tube-ends; once for all tube-ends in
the search window, once with the window narrowed to 24 of them on average. Counts of one build repeat
exactly. With --check the exit status is 1 when a limit is broken. --by-function lists where the
instructions of the 24 go: the N functions with the most of them, each without those that it calls.

--drawing counts what drawing a field takes instead: the whole picture of 635 by 480, interlaced, a
plain scene at rest.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

TUBES = 24
MOST_PER_TUBE = 22_000
MOST_STATE_BYTES = 64 * 1024

# Drawing must reach 60 fields a second. A field takes 17.8 million instructions, 2.5 ms on a 2.3 GHz
# core (docs/performance.md), so that 60 fields a second would be reached with 118 million, too. This
# limit, 15 % above what is counted, notices that drawing has become slower long before.
DRAWN_FIELDS = 4
MOST_PER_DRAWN_FIELD = 20_500_000


def total_of(text):
    """The number of counted instructions in a callgrind output file."""
    found = re.search(r"^(?:summary|totals): (\d+)", text, re.MULTILINE)
    if found is None:
        raise ValueError("no total in callgrind's output file")
    return int(found.group(1))


def by_function(profile, number):
    """The first lines of callgrind_annotate's list: share and name."""
    done = subprocess.run(["callgrind_annotate", "--threshold=100", profile], check=True,
                          stdout=subprocess.PIPE, text=True)
    lines = re.findall(r"^ *[\d,]+ \(([ \d.]+)%\) +\S*?:(.*?)(?: \[.*)?$", done.stdout, re.MULTILINE)
    return [f"  {float(percent):5.1f} %  {name}" for percent, name in lines[:number]]


def count(program, folder, tubes, functions):
    with tempfile.TemporaryDirectory() as out:
        profile = pathlib.Path(out, "callgrind.out")
        command = ["valgrind", "--tool=callgrind", "--collect-atstart=no", "--quiet",
                   f"--callgrind-out-file={profile}", str(program), str(folder)]
        done = subprocess.run(command + ([str(tubes)] if tubes else []), stdout=subprocess.PIPE,
                              text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"instructions: {' '.join(command)}: exit status {done.returncode}")
        fields, measured, state_bytes = map(int, done.stdout.split())
        instructions = total_of(profile.read_text(encoding="utf-8"))
        listing = by_function(profile, functions) if functions else []
    return {"fields": fields, "tubes": measured, "state_bytes": state_bytes,
            "instructions": instructions, "listing": listing}


def count_drawing(program):
    """Instructions of drawing a field."""
    with tempfile.TemporaryDirectory() as out:
        profile = pathlib.Path(out, "callgrind.out")
        command = ["valgrind", "--tool=callgrind", "--collect-atstart=no",
                   "--toggle-collect=*Renderer::render*", "--quiet",
                   f"--callgrind-out-file={profile}", str(program), str(DRAWN_FIELDS), "rest",
                   "whole"]
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"instructions: {' '.join(command)}: exit status {done.returncode}")
        return total_of(profile.read_text(encoding="utf-8")) / DRAWN_FIELDS


def broken_drawing(instructions):
    if 1_000_000 <= instructions <= MOST_PER_DRAWN_FIELD:
        return []
    return [f"{instructions:.0f} instructions a field drawn, "
            f"expected 1000000 (was it counted at all?) to {MOST_PER_DRAWN_FIELD}"]


def broken(result):
    problems = []
    if not 0 < result["tubes"] <= TUBES * result["fields"]:
        problems.append(f"{result['tubes']} tube-ends in {result['fields']} fields, "
                        f"expected up to {TUBES} a field")
    elif result["tubes"] < 0.85 * TUBES * result["fields"]:
        problems.append(f"{result['tubes']} tube-ends in {result['fields']} fields, "
                        f"expected about {TUBES} a field")
    elif not 1000 * result["tubes"] <= result["instructions"] <= MOST_PER_TUBE * result["tubes"]:
        problems.append(f"{result['instructions'] / result['tubes']:.0f} instructions a tube-end, "
                        f"expected 1000 (was it counted at all?) to {MOST_PER_TUBE}")
    if not 0 < result["state_bytes"] <= MOST_STATE_BYTES:
        problems.append(f"tracking state: {result['state_bytes']} bytes, "
                        f"expected at most {MOST_STATE_BYTES}")
    return problems


def self_test():
    good = {"fields": 10, "tubes": 235, "instructions": 235 * 22_000, "state_bytes": 65536}
    wrong = [f"refused without reason: {line}" for line in broken(good)]
    for change in ({"tubes": 241}, {"tubes": 150}, {"tubes": 0}, {"instructions": 235 * 22_000 + 1},
                   {"instructions": 0}, {"state_bytes": 65537}, {"state_bytes": 0}):
        if len(broken(good | change)) != 1:
            wrong.append(f"{change}: not noticed")
    wrong += [f"refused without reason: {line}" for line in broken_drawing(MOST_PER_DRAWN_FIELD)]
    for instructions in (MOST_PER_DRAWN_FIELD + 1, 0):
        if len(broken_drawing(instructions)) != 1:
            wrong.append(f"{instructions} instructions a field drawn: not noticed")
    if total_of("events: Ir\nfn=x\n1 5\n\ntotals: 1234567\n") != 1234567:
        wrong.append("the total is misread")
    try:
        total_of("events: Ir\n")
        wrong.append("a missing total is not noticed")
    except ValueError:
        pass
    for line in wrong:
        print(line)
    print(f"instructions --self-test: {len(wrong)} problems")
    return 1 if wrong else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--by-function", type=int, default=0, metavar="N")
    parser.add_argument("--drawing", action="store_true")
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folders", type=pathlib.Path, nargs="*")
    options = parser.parse_args()
    if options.drawing == bool(options.folders):
        parser.error("expected --drawing DRAW_FIELDS or TRACK_FIELDS FOLDER...")
    if options.drawing:
        instructions = count_drawing(options.program.resolve())
        print(f"drawing: {instructions:.0f} instructions a field, at most {MOST_PER_DRAWN_FIELD}")
        for line in broken_drawing(instructions):
            print(line)
        return 1 if options.check and broken_drawing(instructions) else 0
    print(f"{'recording':16} {'window':12} {'tube-ends a field':>18} {'instructions a field':>21} "
          f"{'a tube-end':>11}")
    problems = []
    for folder in options.folders:
        for tubes in (None, TUBES):
            functions = options.by_function if tubes else 0
            result = count(options.program.resolve(), folder, tubes, functions)
            name = folder.resolve().name
            print(f"{name:16} {'as set' if tubes is None else 'narrowed':12} "
                  f"{result['tubes'] / result['fields']:18.1f} "
                  f"{result['instructions'] / result['fields']:21.0f} "
                  f"{result['instructions'] / result['tubes']:11.0f}", flush=True)
            print(*result["listing"], sep="\n", end="\n" if result["listing"] else "")
        problems += [f"{name}: {line}" for line in broken(result)]
    print(f"tracking state: {result['state_bytes']} bytes, without pixels and sheet map")
    for line in problems:
        print(line)
    return 1 if options.check and problems else 0


if __name__ == "__main__":
    sys.exit(main())
