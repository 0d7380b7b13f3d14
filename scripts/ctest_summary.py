#!/usr/bin/env python3
"""Sums up ctest's JUnit files and refuses anything that did not run.

Usage: ctest_summary.py [--slow FILE] FILE.xml...

ctest itself is content when a test is skipped or disabled; here that is a failure, and so is a file
that is missing or names no test. Prints one line per file and the total; exit status 1 on failure.

An entry of ctest that ran a whole test program has left its results in results/<entry>.xml beside
FILE.xml (scripts/run_test_program.py): its TESTs are counted then, one by one.

--slow names the list of the tests that `./test.sh quick` leaves out. Tests that took longer than a
second and are not in it are named, and lines of it that fit no test: no failure, as times vary.
"""
import json
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as xml

SLOW_S = 1.0


def tests_of(case, folder):
    """(name, kind) of each test behind an entry of ctest; kind is passed, failed or skipped."""
    status = case.get("status")
    kind = "failed" if status == "fail" else "skipped"
    if status == "run" and case.find("skipped") is None:
        kind = "passed"
    name = case.get("name")
    results = pathlib.Path(folder, "results", f"{name}.xml")
    if not results.exists() or kind == "skipped":
        return [(name, kind, status)]
    tests = []
    for test in xml.parse(results).getroot().iter("testcase"):
        ended = test.get("status") == "run" and test.get("result") == "completed"
        mark = "skipped" if not ended else "passed" if test.find("failure") is None else "failed"
        # What a program left out on purpose is "notrun, suppressed" and not there at all.
        tests.append((f"{test.get('classname')}.{test.get('name')}", mark, test.get("result")))
    if kind == "failed" and all(mark == "passed" for _, mark, _ in tests):
        tests.append((name, kind, status))
    return tests


def count(path):
    """Returns ({"passed": n, "failed": n, "skipped": n}, names of all that did not pass)."""
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    others = []
    for case in xml.parse(path).getroot().iter("testcase"):
        for name, kind, status in tests_of(case, pathlib.Path(path).parent):
            counts[kind] += 1
            if kind != "passed":
                others.append(f"{kind} ({status}): {name}")
    return counts, others


def slow_tests(times, rules):
    """What to tell of a list of slow tests, given (name, seconds) of all tests."""
    known = [(rule, re.compile(rule)) for rule in rules if rule and not rule.startswith("#")]
    told = [f"took {seconds:.1f} s and is not in the list of slow tests: {name}"
            for name, seconds in times
            if seconds > SLOW_S and not any(rule.search(name) for _, rule in known)]
    told += [f"the list of slow tests has a line that fits no test: {text}" for text, rule in known
             if not any(rule.search(name) for name, _ in times)]
    return told


def left_for_long(build, ran):
    """Tests of a build folder that only `./test.sh long` runs, and those that nothing runs."""
    listed = subprocess.run(["ctest", "--test-dir", str(build), "--show-only=json-v1"], check=True,
                            capture_output=True, text=True).stdout
    later, lost = [], []
    for test in json.loads(listed)["tests"]:
        labels = [value for part in test.get("properties", []) if part["name"] == "LABELS"
                  for value in part["value"]]
        if "long" in labels:
            later.append(test["name"])
        elif test["name"] not in ran and not test["name"].startswith("quick."):
            lost.append(test["name"])
    return later, lost


def main(paths):
    slow = None
    if paths[:1] == ["--slow"]:
        slow, paths = paths[1], paths[2:]
    total = {"passed": 0, "failed": 0, "skipped": 0}
    good = bool(paths)
    for path in paths:
        name = pathlib.Path(path).parent.name
        try:
            counts, others = count(path)
        except (OSError, xml.ParseError) as error:
            print(f"{name}: no result of ctest: {error}")
            good = False
            continue
        for line in others:
            print(f"{name}: {line}")
        number = sum(counts.values())
        if slow and name == "bench" and path.endswith("/ctest.xml"):
            times = [(case.get("name"), float(case.get("time")))
                     for case in xml.parse(path).getroot().iter("testcase")]
            rules = pathlib.Path(slow).read_text(encoding="utf-8").splitlines()
            for line in slow_tests([t for t in times if "." in t[0]], rules):
                print(f"{name}: {line}")
            later, lost = left_for_long(pathlib.Path(path).parent, {test for test, _ in times})
            print(f"{name}: {len(later)} more tests run in ./test.sh long alone: "
                  f"{', '.join(later)}")
            for test in lost:
                print(f"{name}: neither here nor in ./test.sh long: {test}")
            good = good and not lost
        print(f"{name}: {counts['passed']} of {number} tests passed, "
              f"{counts['failed']} failed, {counts['skipped']} skipped")
        good = good and number > 0 and counts["passed"] == number
        for key in total:
            total[key] += counts[key]
    print(f"{total['passed']} passed, {total['failed']} failed, {total['skipped']} skipped")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
