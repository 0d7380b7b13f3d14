#!/usr/bin/env python3
"""The tracking path's fixed-point instance computes without floating point.

Usage: no_float.py LIST COMPILER FLAG... | no_float.py --self-test COMPILER

Compiles each source of LIST with -mgeneral-regs-only and TUBESIGHT_FIXED_ONLY, which leaves the
fixed-point instance alone, and looks for calls of the software floating point that the compiler may
turn to. Files named *_setup.cpp turn settings, which are doubles, into fixed point before the first
field, and are exempt; so is what no_float_exempt.txt beside this file names, with the reason.
"""
import concurrent.futures
import pathlib
import re
import subprocess
import sys
import tempfile

from source_text import report

SOFT_FLOAT = re.compile(r"^__(\w+?)(sf|df|tf|xf|hf)(\w*)$")
LIBM = re.compile(r"^(sqrt|sin|cos|tan|atan2?|asin|acos|exp|log|pow|hypot|floor|ceil|l?l?round|"
                  r"fmod|fabs|fma|lrint|nearbyint|trunc|cbrt)[fl]?$")


def nm_of(compiler):
    prefix, found, _ = compiler.rpartition("g++")
    return prefix + "nm" if found else "nm"


def check(compiler, flags, path, obj):
    result = subprocess.run(
        [compiler, "-std=c++20", "-O2", "-fno-exceptions", "-fno-rtti", "-mgeneral-regs-only",
         "-DTUBESIGHT_FIXED_ONLY", *flags, "-c", str(path), "-o", str(obj)],
        capture_output=True, text=True, check=False)
    if result.returncode != 0:
        lines = [line for line in result.stderr.splitlines() if "error" in line]
        return [f"{path}: {line}" for line in (lines or result.stderr.splitlines())[:5]]
    names = subprocess.run([nm_of(compiler), str(obj)], check=True, capture_output=True,
                           text=True).stdout.splitlines()
    symbols = [line.split()[-2:] for line in names if len(line.split()) >= 2]
    problems = [f"{path}: calls {symbol}" for kind, symbol in symbols
                if kind in "Uw" and (SOFT_FLOAT.match(symbol) or LIBM.match(symbol))]
    if not any(kind in "TWt" for kind, _ in symbols):
        problems.append(f"{path}: defines no function with TUBESIGHT_FIXED_ONLY, so nothing was "
                        "checked")
    return problems


PLANTED = [
    ("#include <cmath>\ntemplate <class T> T f(T a) { return a + a; }\ntemplate int f(int);\n"
     "#ifndef TUBESIGHT_FIXED_ONLY\ntemplate double f(double);\n#endif\n", None),
    ("template <class T> T f(T a) { return a + a; }\ntemplate double f(double);\n", "error"),
    ("int f(int a) { return static_cast<int>(a * 0.3); }\n", ""),
    ("#ifndef TUBESIGHT_FIXED_ONLY\nint f(int a) { return a; }\n#endif\n", "defines no function"),
]


def self_test(compiler):
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "a.cpp")
        for text, expected in PLANTED:
            path.write_text(text, encoding="utf-8")
            problems = check(compiler, [], path, pathlib.Path(folder, "a.o"))
            if (expected is None) != (not problems) or (expected and expected not in problems[0]):
                wrong.append(f"expected '{expected}', reported {problems}, in: {text}")
    return report("no_float --self-test", wrong, f"{len(PLANTED)} planted sources")


def read_exempt():
    text = pathlib.Path(__file__).with_name("no_float_exempt.txt").read_text(encoding="utf-8")
    lines = [line.partition(": ") for line in text.splitlines() if line and line[0] != "#"]
    return {name for name, _, reason in lines if reason}


def main(listing, compiler, flags):
    exempt = read_exempt()
    every = pathlib.Path(listing).read_text(encoding="utf-8").split()
    paths = [path for path in every if not path.endswith("_setup.cpp")
             and not any(path.endswith("/" + name) for name in exempt)]
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = [pool.submit(check, compiler, flags, path, pathlib.Path(folder, f"{number}.o"))
                for number, path in enumerate(paths)]
        problems = [problem for job in jobs for problem in job.result()]
    problems += [f"no_float_exempt.txt: {name} is not a source of the tracking path"
                 for name in sorted(exempt)
                 if not any(path.endswith("/" + name) for path in every)]
    if not paths:
        problems.append(f"{listing} names no source")
    return report("no_float", problems, f"{len(paths)} sources")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test(sys.argv[2]))
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:]))
