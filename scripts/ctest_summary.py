#!/usr/bin/env python3
"""Sums up ctest's JUnit files and refuses anything that did not run.

Usage: ctest_summary.py FILE.xml...

ctest itself is content when a test is skipped or disabled; here that is a failure, and so is a file
that is missing or names no test. Prints one line per file and the total; exit status 1 on failure.
"""
import pathlib
import sys
import xml.etree.ElementTree as xml


def count(path):
    """Returns ({"passed": n, "failed": n, "skipped": n}, names of all that did not pass)."""
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    others = []
    for case in xml.parse(path).getroot().iter("testcase"):
        status = case.get("status")
        if status == "run" and case.find("skipped") is None:
            counts["passed"] += 1
            continue
        kind = "failed" if status == "fail" else "skipped"
        counts[kind] += 1
        others.append(f"{kind} ({status}): {case.get('name')}")
    return counts, others


def main(paths):
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
        print(f"{name}: {counts['passed']} of {number} tests passed, "
              f"{counts['failed']} failed, {counts['skipped']} skipped")
        good = good and number > 0 and counts["passed"] == number
        for key in total:
            total[key] += counts[key]
    print(f"{total['passed']} passed, {total['failed']} failed, {total['skipped']} skipped")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
