#!/usr/bin/env python3
"""Runs a GoogleTest program once with all its tests but some, and sees that each of them ran.

Usage: run_test_program.py --results FILE.xml --leave-out REGEX|@FILE -- COMMAND...
       run_test_program.py --self-test

A test is named as ctest names it: Suite.Name, Suite.Name<type>, Instance/Suite.Name/parameter. @FILE
has one regular expression a line; empty lines and those that begin with # say nothing.
"""
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as xml

TYPE = re.compile(r"^(\S+)\.\s+# TypeParam = (.*)$")


def listed(text):
    """Pairs of a test's name for ctest and for GoogleTest, from --gtest_list_tests."""
    tests, suite, shown, kind = [], "", "", ""
    for line in text.splitlines():
        if line.startswith("  "):
            name = line.strip().partition("  #")[0].strip()
            tests.append((f"{shown}.{name}{kind}", f"{suite}.{name}"))
        elif re.match(r"^\S+\.(\s|$)", line):
            suite = line.split(".  #")[0].rstrip().rstrip(".")
            typed = TYPE.match(line)
            shown = suite.rpartition("/")[0] if typed else suite
            kind = f"<{typed[2]}>" if typed else ""
    return tests


def expressions(left_out):
    if not left_out.startswith("@"):
        return [left_out] if left_out else []
    lines = pathlib.Path(left_out[1:]).read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def chosen(tests, left_out):
    """GoogleTest's names of the tests to be run, and of those left out."""
    rules = [re.compile(text) for text in expressions(left_out)]
    out = [name for shown, name in tests if any(rule.search(shown) for rule in rules)]
    return [name for _, name in tests if name not in set(out)], out


def completed(root):
    return {f"{case.get('classname')}.{case.get('name')}" for case in root.iter("testcase")
            if case.get("status") == "run" and case.get("result") == "completed"}


def main(results, left_out, command):
    results.unlink(missing_ok=True)
    results.parent.mkdir(parents=True, exist_ok=True)
    text = subprocess.run([*command, "--gtest_list_tests"], check=True, capture_output=True,
                          text=True).stdout
    run, out = chosen(listed(text), left_out)
    if not run:
        # Every one is left out by name: nothing to run, and said so in an empty result.
        results.write_text("<testsuites/>", encoding="utf-8")
        print(f"all {len(out)} tests are left out here")
        return 0 if out else 1
    print(f"{len(run)} tests, {len(out)} left out here", flush=True)
    status = subprocess.run([*command, "--gtest_brief=1", f"--gtest_output=xml:{results}",
                             *(["--gtest_filter=-" + ":".join(out)] if out else [])],
                            check=False).returncode
    ran = completed(xml.parse(results).getroot()) if results.exists() else set()
    missing = [name for name in run if name not in ran]
    for name in missing:
        print(f"did not run to its end: {name}")
    return 1 if status != 0 or missing else 0


PLANTED = """Running main() from gtest_main.cc
Plain.
  A
  B
Typed/0.  # TypeParam = double
  A
Typed/1.  # TypeParam = tubesight::core::Fixed<16, 16>
  A
All/Many.
  Holds/0  # GetParam() = 4-byte object <01-00 00-00>
  Holds/named  # GetParam() = "a.b"
"""


def self_test():
    tests = listed(PLANTED)
    wrong = []
    shown = ["Plain.A", "Plain.B", "Typed.A<double>", "Typed.A<tubesight::core::Fixed<16, 16>>",
             "All/Many.Holds/0", "All/Many.Holds/named"]
    if [name for name, _ in tests] != shown:
        wrong.append(f"listed {tests}, expected {shown}")
    cases = [("", []), ("<(float|double)>$", ["Typed/0.A"]),
             (r"Many\..*/[0-9]", ["All/Many.Holds/0"])]
    for left_out, expected in cases:
        run, out = chosen(tests, left_out)
        if out != expected or len(run) + len(out) != len(tests):
            wrong.append(f"'{left_out}' leaves out {out}, expected {expected}")
    root = xml.fromstring('<a><testcase classname="A" name="a" status="run" result="completed"/>'
                          '<testcase classname="A" name="b" status="run" result="skipped"/>'
                          '<testcase classname="A" name="c" status="notrun"/></a>')
    if completed(root) != {"A.a"}:
        wrong.append(f"{completed(root)} are said to have run, expected A.a alone")
    print("\n".join(wrong) or "planted lists and results read rightly")
    return 1 if wrong else 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(self_test())
    if len(sys.argv) < 7 or (sys.argv[1], sys.argv[3], sys.argv[5]) != ("--results", "--leave-out",
                                                                       "--"):
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[2]), sys.argv[4], sys.argv[6:]))
