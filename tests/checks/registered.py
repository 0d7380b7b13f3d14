#!/usr/bin/env python3
"""Every test is known to ctest, and every source to the CMakeLists.txt of its folder.

Usage: registered.py ROOT LIST | registered.py --self-test

LIST is written by CMake: one line per source handed to tubesight_add_test.
"""
import pathlib
import re
import sys
import tempfile

from source_text import report, sources

# Compiled by the check itself, one by one.
EXEMPT = "tests/checks/must_not_compile/"


def check(root, registered):
    root = pathlib.Path(root)
    problems = []
    tests = {path.relative_to(root).as_posix() for path in sources(root, ["tests"])
             if path.name.endswith("_test.cpp")}
    known = {pathlib.Path(line).resolve().relative_to(root.resolve()).as_posix()
             for line in registered if line.endswith("_test.cpp")}
    problems += [f"{name}: not known to ctest" for name in sorted(tests - known)]
    problems += [f"{name}: known to ctest, but not in tests/" for name in sorted(known - tests)]
    for path in sources(root, ["core", "hal", "drivers", "board", "tests"]):
        name = path.relative_to(root).as_posix()
        if name.startswith(EXEMPT) or (name.startswith("tests/") and path.suffix == ".h"):
            continue
        listing = path.parent / "CMakeLists.txt"
        words = re.split(r"[\s()]+", listing.read_text(encoding="utf-8")) if listing.exists() else []
        # A fuzzer may be listed by the name of its subject.
        if path.name not in words and path.name.removesuffix("_fuzz.cpp") not in words:
            problems.append(f"{name}: not named in the CMakeLists.txt of its folder")
    return problems, len(tests)


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "core/base").mkdir(parents=True)
        (root / "tests/core").mkdir(parents=True)
        for name in ["core/base/a.h", "core/base/lost.cpp", "tests/core/a_test.cpp",
                     "tests/core/lost_test.cpp"]:
            (root / name).write_text("", encoding="utf-8")
        (root / "core/base/CMakeLists.txt").write_text("f(a.h not_lost.cpp)\n", encoding="utf-8")
        (root / "tests/core/CMakeLists.txt").write_text("f(a_test.cpp lost_test.cpp)\n",
                                                        encoding="utf-8")
        lines = [str(root / "tests/core/a_test.cpp"), str(root / "tests/core/gone_test.cpp")]
        found, _ = check(root, lines)
    expected = ["tests/core/lost_test.cpp: not known to ctest",
                "tests/core/gone_test.cpp: known to ctest, but not in tests/",
                "core/base/lost.cpp: not named in the CMakeLists.txt of its folder"]
    wrong = [] if found == expected else [f"expected {expected}, reported {found}"]
    return report("registered --self-test", wrong, "5 planted files")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    known_lines = pathlib.Path(sys.argv[2]).read_text(encoding="utf-8").split()
    list_of_problems, number = check(sys.argv[1], known_lines)
    if number == 0:
        list_of_problems.append("no test found: wrong folder?")
    sys.exit(report("registered", list_of_problems, f"{number} tests"))
