#!/usr/bin/env python3
"""The stack of the tracking path is bounded: no frame over 4096 bytes, none of unknown size, no
recursion, and the deepest chain of calls within a limit.

Usage: stack.py LIMIT_BYTES OBJECT... | stack.py --self-test COMPILER

The compiler writes a .ci file beside each object (-fcallgraph-info=su): the call graph after
inlining, with the size of each frame. What lies outside the tracking path's own objects is the C
library (memcpy and the like, counted as EXTERNAL_BYTES) and the board's panic hook, which does not
come back. A call through a pointer can't be followed and is reported.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from source_text import report

FRAME_BYTES = 4096
EXTERNAL_BYTES = 256
INDIRECT = "__indirect_call"
# std::sort recurses at most 2 log2(n) levels deep before it turns to heap sort; n stays below 2^20.
BOUNDED_RECURSION = re.compile(r"(^|:)_ZSt16__introsort_loop")
BOUNDED_LEVELS = 40
# A failed assertion ends the program through the board's hook.
PANIC = re.compile(r"^_ZN9tubesight4core5panicE")

NODE = re.compile(r'^node: \{ title: "([^"]*)" label: "([^"]*)"')
EDGE = re.compile(r'^edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"')
# Template functions are titled with the file that they were compiled in: "tracker.cpp:_ZN9...".
FILE_OF_TITLE = re.compile(r'"[^"]*:(_Z[^"]*)"')
SIZE = re.compile(r"\\n(\d+) bytes \((static|dynamic,bounded|dynamic)\)")


def read(files):
    """Returns ({function: bytes}, {function: kind}, {function: label}, {function: called})."""
    size, kind, label, calls = {}, {}, {}, {}
    for path in files:
        for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
            line = FILE_OF_TITLE.sub(r'"\1"', line)
            node, edge = NODE.match(line), EDGE.match(line)
            if node:
                found = SIZE.search(node.group(2))
                name = node.group(1)
                label[name] = node.group(2).split("\\n")[0]
                if found:
                    # An inline function may be in several files; the largest counts.
                    size[name] = max(size.get(name, 0), int(found.group(1)))
                    if found.group(2) == "dynamic" or name not in kind:
                        kind[name] = found.group(2)
            elif edge and not PANIC.match(edge.group(1)) and not (
                    edge.group(1) == edge.group(2) and BOUNDED_RECURSION.search(edge.group(1))):
                calls.setdefault(edge.group(1), set()).add(edge.group(2))
    return size, kind, label, calls


def deepest_chains(size, calls):
    """Returns ({function: (bytes, next)}, functions that call themselves, by whatever way)."""
    depth, recursive, open_path = {}, set(), []

    def visit(name):
        if name in depth:
            return depth[name][0]
        if name not in size:
            return EXTERNAL_BYTES
        if name in open_path:
            recursive.update(open_path[open_path.index(name):])
            return 0
        open_path.append(name)
        best, following = 0, None
        for called in sorted(calls.get(name, ())):
            below = visit(called)
            if below > best:
                best, following = below, called
        open_path.pop()
        levels = BOUNDED_LEVELS if BOUNDED_RECURSION.search(name) else 1
        depth[name] = (levels * size[name] + best, following)
        return depth[name][0]

    sys.setrecursionlimit(100000)
    for name in size:
        visit(name)
    return depth, recursive


def check(files, limit):
    size, kind, label, calls = read(files)
    problems = []
    for name, number in sorted(size.items()):
        if number > FRAME_BYTES:
            problems.append(f"{label[name]}: frame of {number} bytes, more than {FRAME_BYTES}")
        if kind[name] == "dynamic":
            problems.append(f"{label[name]}: frame of unknown size")
        if INDIRECT in calls.get(name, ()):
            problems.append(f"{label[name]}: calls through a pointer")
    depth, recursive = deepest_chains(size, calls)
    problems += [f"{label[name]}: calls itself" for name in sorted(recursive)]
    if not depth:
        return ["no frame found: not compiled with -fcallgraph-info=su?"], 0
    name = max(depth, key=lambda key: depth[key][0])
    total = depth[name][0]
    print(f"deepest chain, {total} bytes:")
    while name in depth:
        print(f"  {size[name]:6d}  {label[name]}")
        name = depth[name][1]
    if total > limit:
        problems.append(f"the deepest chain takes {total} bytes, more than {limit}")
    return problems, len(size)


NOINLINE = "#define N __attribute__((noinline))\nvoid use(char*);\nvoid external();\n"
PLANTED = [
    ("N void f(int a) { char b[100]; b[a] = 1; external(); }\nvoid g(int a) { f(a); }\n", None),
    ("void f() { char b[5000]; use(b); }\n", "more than 4096"),
    ("void f(int n) { char* b = static_cast<char*>(__builtin_alloca(unsigned(n))); use(b); }\n",
     "unknown size"),
    ("N void g(int);\nN void f(int a) { if (a) { g(a - 1); external(); } }\n"
     "N void g(int a) { f(a); external(); }\n", "calls itself"),
    ("#include <algorithm>\nvoid f(int* p, int n) { std::sort(p, p + n); }\n", None),
    ("void f(void (*p)()) { p(); external(); }\n", "through a pointer"),
    ("N void h() { char b[2000]; use(b); }\nN void g() { char b[2000]; use(b); h(); external(); }\n"
     "void f() { char b[2000]; use(b); g(); external(); }\n", "the deepest chain takes"),
]


# A call from one file into a template function of another: 3000 bytes each.
PLANTED_PAIR = (
    "template <typename T> int deep(T value);\n"
    "extern template int deep<int>(int);\n"
    "int shallow(int value) {\n"
    "  volatile char bytes[3000];\n"
    "  bytes[value] = 1;\n"
    "  return deep<int>(value) + bytes[value];\n"
    "}\n",
    "template <typename T> int deep(T value) {\n"
    "  volatile char bytes[3000];\n"
    "  bytes[value] = 1;\n"
    "  return bytes[value];\n"
    "}\n"
    "template int deep<int>(int);\n")


def self_test(compiler):
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        callgraphs = []
        for name, text in zip(("caller", "called"), PLANTED_PAIR):
            source = pathlib.Path(folder, name + ".cpp")
            source.write_text(text, encoding="utf-8")
            subprocess.run([compiler, "-std=c++20", "-O2", "-fcallgraph-info=su", "-c", source, "-o",
                            pathlib.Path(folder, name + ".o")], check=True)
            callgraphs.append(pathlib.Path(folder, name + ".ci"))
        if not check(callgraphs, 5000)[0]:
            wrong.append("a chain of 6000 bytes over two files was not noticed")
        source = pathlib.Path(folder, "a.cpp")
        for text, expected in PLANTED:
            source.write_text(NOINLINE + text, encoding="utf-8")
            subprocess.run([compiler, "-std=c++20", "-O2", "-fcallgraph-info=su", "-c", source, "-o",
                            pathlib.Path(folder, "a.o")], check=True)
            problems, _ = check([pathlib.Path(folder, "a.ci")], 5000)
            if (expected is None) != (not problems) or not any(
                    (expected or "") in problem for problem in problems or [""]):
                wrong.append(f"expected '{expected}', reported {problems}, in: {text}")
    return report("stack --self-test", wrong, f"{len(PLANTED)} planted sources")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test(sys.argv[2]))
    callgraphs = [pathlib.Path(name).with_suffix(".ci") for name in sys.argv[2:]]
    list_of_problems, number_of_frames = check(callgraphs, int(sys.argv[1]))
    sys.exit(report("stack", list_of_problems, f"{number_of_frames} functions"))
