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
    return report("ctest_summary --self-test", wrong, f"{len(PLANTED)} planted results")


if __name__ == "__main__":
    sys.exit(self_test(sys.argv[2]))
