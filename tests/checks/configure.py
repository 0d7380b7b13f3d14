#!/usr/bin/env python3
"""What is configured is what was asked for, and what cannot be is said: boards, drivers, libraries.

Usage: configure.py ROOT CMAKE GENERATOR COMPILER | configure.py --self-test

Configures the tree into temporary folders and builds nothing.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from source_text import report

# What find_package() and find_path() leave in the cache for the libraries in use.
LIBRARY = re.compile(r"^((?:LIBLZMA|PNG|ZLIB|CLI11|GTest|benchmark|TUBESIGHT_TOMLPLUSPLUS|Eigen3|"
                     r"PkgConfig|[A-Za-z0-9]+_DIR)\w*):", re.MULTILINE)
WITHOUT_TESTS = "-DTUBESIGHT_BUILD_TESTS=OFF"

# Options, part of the error or None where there is none, libraries that may be looked for.
CASES = [
    ("the core alone", ["-DTUBESIGHT_BOARDS=", WITHOUT_TESTS], None, r"Eigen3_DIR"),
    ("a driver alone", ["-DTUBESIGHT_BOARDS=", "-DTUBESIGHT_DRIVERS=simulated", WITHOUT_TESTS],
     None, r"Eigen3_DIR"),
    ("a driver with its tests", ["-DTUBESIGHT_BOARDS=", "-DTUBESIGHT_DRIVERS=files"], None, r".*"),
    ("a board that is not there", ["-DTUBESIGHT_BOARDS=bench;unknown", WITHOUT_TESTS],
     "there is no board/unknown/CMakeLists.txt", r".*"),
    ("a driver that is not there", ["-DTUBESIGHT_BOARDS=", "-DTUBESIGHT_DRIVERS=unknown",
                                    WITHOUT_TESTS],
     "there is no drivers/unknown/CMakeLists.txt", r".*"),
    ("a library that is not there", ["-DTUBESIGHT_BOARDS=bench",
                                    "-DCMAKE_DISABLE_FIND_PACKAGE_PNG=ON", WITHOUT_TESTS],
     "drivers/files (needed by board/bench, drivers/ffmpeg): PNG was not found on this machine; "
     "Debian's package is libpng-dev", r".*"),
]


def judge(what, status, output, cache, error, allowed):
    """The problems of one configuration."""
    output = " ".join(output.split())
    if error is None and status != 0:
        return [f"{what}: not configured: {output[-400:]}"]
    if error is not None:
        return [] if status != 0 and error in output else [
            f"{what}: expected the error '{error}', found: {output[-400:]}"]
    return [f"{what}: looks for {name}" for name in LIBRARY.findall(cache)
            if not re.fullmatch(allowed, name)]


def check(root, cmake, generator, compiler):
    problems = []
    for what, options, error, allowed in CASES:
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run(
                [cmake, "-G", generator, "-S", root, "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
                 f"-DCMAKE_CXX_COMPILER={compiler}", *options],
                capture_output=True, text=True, check=False)
            cache = pathlib.Path(folder, "CMakeCache.txt")
            text = cache.read_text(encoding="utf-8") if cache.exists() else ""
            problems += judge(what, run.returncode, run.stdout + run.stderr, text, error, allowed)
    return problems


def self_test():
    eigen = "Eigen3_DIR:PATH=/usr/share/eigen3/cmake\nCMAKE_AR:FILEPATH=/usr/bin/ar\n"
    found = [
        *judge("good", 0, "", eigen, None, "Eigen3_DIR"),
        *judge("good error", 1, "CMake Error\n  no\n  luck", "", "no luck", ".*"),
        *judge("one", 0, "", eigen + "PNG_LIBRARY:FILEPATH=x\n", None, "Eigen3_DIR"),
        *judge("two", 1, "no luck", "", None, ".*"),
        *judge("three", 0, "no luck", "", "no luck", ".*"),
        *judge("four", 1, "no luck", "", "other luck", ".*"),
    ]
    names = [problem.split(":")[0] for problem in found]
    wrong = [] if names == ["one", "two", "three", "four"] else [f"reported {found}"]
    return report("configure --self-test", wrong, "6 planted configurations")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    sys.exit(report("configure", check(*sys.argv[1:5]), f"{len(CASES)} configurations"))
