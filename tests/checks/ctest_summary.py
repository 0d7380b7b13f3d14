#!/usr/bin/env python3
"""Shows that scripts/ctest_summary.py refuses what ctest lets pass.

Usage: ctest_summary.py --self-test FOLDER_OF_SCRIPTS
"""
import contextlib
import importlib.util
import io
import pathlib
import sys
import tempfile

from source_text import report

PASSED = '<testcase name="A.a" status="run"/>'
PLANTED = [
    (PASSED, 0, "1 passed, 0 failed, 0 skipped"),
    (PASSED + '<testcase name="B.b" status="fail"><failure message=""/></testcase>', 1,
     "1 passed, 1 failed, 0 skipped"),
    (PASSED + '<testcase name="B.b" status="notrun"><skipped message="SKIP"/></testcase>', 1,
     "1 passed, 0 failed, 1 skipped"),
    (PASSED + '<testcase name="B.b" status="disabled"/>', 1, "1 passed, 0 failed, 1 skipped"),
    ("", 1, "0 passed, 0 failed, 0 skipped"),
    (None, 1, "0 passed, 0 failed, 0 skipped"),
]
ENDED = '<testcase classname="A" name="{}" status="run" result="completed">{}</testcase>'
# A program as one entry of ctest: its entry, what it left behind, and the same as above.
PROGRAMS = [
    ("run", ENDED.format("a", "") + ENDED.format("b", ""), 0, "2 passed, 0 failed, 0 skipped"),
    ("fail", ENDED.format("a", "") + ENDED.format("b", "<failure/>"), 1,
     "1 passed, 1 failed, 0 skipped"),
    ("fail", ENDED.format("a", ""), 1, "1 passed, 1 failed, 0 skipped"),  # ended by a signal
    ("fail", None, 1, "0 passed, 1 failed, 0 skipped"),
    ("run", '<testcase classname="A" name="a" status="run" result="skipped"/>', 1,
     "0 passed, 0 failed, 1 skipped"),
    ("run", '<testcase classname="A" name="a" status="notrun" result="suppressed"/>', 1,
     "0 passed, 0 failed, 1 skipped"),
]
TIMES = [("A.quick", 0.1), ("A.slow", 1.5), ("B.slow", 2.0)]


def self_test(folder):
    spec = importlib.util.spec_from_file_location("summary",
                                                  pathlib.Path(folder, "ctest_summary.py"))
    summary = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(summary)
    wrong = []
    for cases, status, last in PLANTED:
        with tempfile.TemporaryDirectory() as build:
            path = pathlib.Path(build, "ctest.xml")
            if cases is not None:
                path.write_text(f"<testsuite>{cases}</testsuite>", encoding="utf-8")
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                result = summary.main([str(path)])
        if result != status or printed.getvalue().splitlines()[-1] != last:
            wrong.append(f"expected {status}, '{last}'; got {result}, {printed.getvalue()}")
    for entry, results, status, last in PROGRAMS:
        with tempfile.TemporaryDirectory() as build:
            pathlib.Path(build, "results").mkdir()
            if results is not None:
                pathlib.Path(build, "results/p.xml").write_text(f"<a>{results}</a>", encoding="utf-8")
            path = pathlib.Path(build, "ctest.xml")
            path.write_text(f'<a><testcase name="p" status="{entry}"/></a>', encoding="utf-8")
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                result = summary.main([str(path)])
        if result != status or printed.getvalue().splitlines()[-1] != last:
            wrong.append(f"expected {status}, '{last}'; got {result}, {printed.getvalue()}")
    told = summary.slow_tests(TIMES, ["# a list", "^A\\.slow$", "^Gone\\."])
    if len(told) != 2 or not told[0].endswith(": B.slow") or not told[1].endswith("^Gone\\."):
        wrong.append(f"told of slow tests: {told}")
    return report("ctest_summary --self-test", wrong,
                  f"{len(PLANTED) + len(PROGRAMS) + 1} planted results")


if __name__ == "__main__":
    sys.exit(self_test(sys.argv[2]))
