#!/usr/bin/env python3
"""No heap, no exception, no RTTI: scans the tracking path's archives for what they would need.

Usage: symbols.py NM ARCHIVE... | symbols.py --self-test NM COMPILER
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from source_text import report

FORBIDDEN = [
    (re.compile(r"^_Zn[wa]"), "operator new"),
    (re.compile(r"^_Zd[la]"), "operator delete"),
    (re.compile(r"^(malloc|calloc|realloc|reallocarray|free|aligned_alloc|posix_memalign|memalign|"
                r"valloc|strdup)$"), "the malloc family"),
    (re.compile(r"^__cxa_(throw|rethrow|allocate_exception|begin_catch|end_catch|bad_cast|"
                r"bad_typeid|throw_bad_array_new_length)"), "exceptions"),
    (re.compile(r"^_ZSt\d+__throw_"), "exceptions, by a library function that throws"),
    (re.compile(r"^(__gxx_personality_v0|_Unwind_Resume)$"), "exceptions, to clean up after one"),
    (re.compile(r"^(__dynamic_cast|_ZTI|_ZTVN10__cxxabiv1)"), "RTTI"),
    (re.compile(r"^__cxa_guard_"), "a function-local static that is made at run time"),
]


def check(nm, archive):
    """Returns the problems of one archive or object, and how many symbols it defines."""
    text = subprocess.run([nm, str(archive)], check=True, capture_output=True, text=True).stdout
    problems, defined, member = [], 0, ""
    for line in text.splitlines():
        if line.endswith(":"):
            member = line[:-1]
            continue
        words = line.split()
        if len(words) < 2:
            continue
        kind, symbol = words[-2], words[-1]
        # A weak definition (V, W) of RTTI counts as well: no translation unit may make it.
        if kind in "Uwv" or symbol.startswith("_ZTI"):
            for pattern, what in FORBIDDEN:
                if pattern.match(symbol):
                    problems.append(f"{pathlib.Path(archive).name}({member}): {symbol} needs {what}")
        else:
            defined += 1
    return problems, defined


PLANTED = [
    ("#include <cstddef>\nint f(int a) { return a; }\n", None),
    ("int* f() { return new int; }\n", "operator new"),
    ("int* f(int n) { return new int[static_cast<unsigned>(n)]; }\n", "operator new"),
    ("void f(int* p) { delete p; }\n", "operator delete"),
    ("#include <cstdlib>\nvoid* f() { return std::malloc(9); }\n", "malloc family"),
    ("#include <cstdlib>\nvoid f(void* p) { std::free(p); }\n", "malloc family"),
    ("void f() { throw 1; }\n", "exceptions"),
    ("#include <optional>\nint f(std::optional<int> o) { return o.value(); }\n", "exceptions"),
    ("#include <array>\nint f(std::array<int, 3>& a, unsigned i) { return a.at(i); }\n",
     "library function that throws"),
    ("struct A { virtual void f(); };\nstruct B : A { void f() override; };\n"
     "B* f(A* a) { return dynamic_cast<B*>(a); }\n", "RTTI"),
    ("struct A { virtual ~A(); };\nA::~A() {}\n", "operator delete"),
    ("int g();\nint f() { static int a = g(); return a; }\n", "function-local static"),
]


def self_test(nm, compiler):
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        source, obj = pathlib.Path(folder, "a.cpp"), pathlib.Path(folder, "a.o")
        for text, expected in PLANTED:
            source.write_text(text, encoding="utf-8")
            subprocess.run([compiler, "-std=c++20", "-O2", "-c", source, "-o", obj], check=True)
            problems, defined = check(nm, obj)
            if defined == 0:
                wrong.append(f"nothing seen of: {text}")
            if expected is None and problems:
                wrong.append(f"reported without reason: {problems}")
            if expected is not None and not any(expected in problem for problem in problems):
                wrong.append(f"not caught: {expected} in: {text}")
    return report("symbols --self-test", wrong, f"{len(PLANTED)} planted objects")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test(*sys.argv[2:4]))
    list_of_problems = []
    for name in sys.argv[2:]:
        found, number = check(sys.argv[1], name)
        list_of_problems += found
        if number == 0:
            list_of_problems.append(f"{name}: defines nothing, so nothing was checked")
    if not sys.argv[2:]:
        list_of_problems.append("no archive given")
    sys.exit(report("symbols", list_of_problems, f"{len(sys.argv) - 2} archives"))
