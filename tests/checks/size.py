#!/usr/bin/env python3
"""Files stay within 400 lines and 100 columns, functions within 60 lines.

Usage: size.py ROOT | size.py --self-test

Exceptions stand in size_allowed.txt beside this file, one a line: `PATH: REASON` for a file,
`PATH FUNCTION: REASON` for a function. An exception that is no longer needed is an error too.
"""
import pathlib
import re
import sys
import tempfile

from source_text import code_only, plant, report, sources

FILE_LINES = 400
FUNCTION_LINES = 60
COLUMNS = 100
FOLDERS = ["core", "hal", "drivers", "board", "tests"]

SCOPE = re.compile(r"\b(namespace|class|struct|union|enum|extern|concept)\b")
FUNCTION = re.compile(r"([~\w:]+|operator\s*\S+?)\s*\(")


def functions(text):
    """Yields (name, line, number of lines) of each function body, by matching braces."""
    stack, start, line = [], 0, 1
    code = re.sub(r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", lambda m: "\n" * m.group(0).count("\n"),
                  code_only(text), flags=re.MULTILINE)
    previous_was_function = None
    for position, character in enumerate(code):
        if character == "\n":
            line += 1
        elif character == "{":
            head = code[start:position].strip()
            outside = all(kind == "scope" for kind, _, _ in stack)
            name = FUNCTION.search(head)
            if outside and SCOPE.search(head.split("(")[0]) and not head.endswith(")"):
                entry = ("scope", None, line)
            elif outside and previous_was_function and (not head or head[0] == ","):
                # After an initialiser list such as `: a_{1}, b_{2} {`.
                entry = ("function", previous_was_function, line)
            elif outside and name and "=" not in head.split("(")[0]:
                entry = ("function", name.group(1), line)
            else:
                entry = ("block", None, line)
            stack.append(entry)
            start = position + 1
            previous_was_function = None
        elif character == "}":
            if stack:
                kind, name, first = stack.pop()
                if kind == "function":
                    yield name, first, line - first + 1
                    previous_was_function = name
            start = position + 1
        elif character == ";":
            # Not the semicolons between the parentheses of a for.
            if code.count("(", start, position) == code.count(")", start, position):
                start = position + 1


def read_allowed(path):
    allowed = {}
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else []:
        if line.strip() and not line.startswith("#"):
            key, _, reason = line.partition(": ")
            allowed[key.strip()] = reason.strip()
    return allowed


def check(root, allowed):
    root = pathlib.Path(root)
    problems, used = [], set()

    def over(key, message):
        if allowed.get(key):
            used.add(key)
        else:
            problems.append(message)

    files = sources(root, FOLDERS)
    for path in files:
        name = path.relative_to(root).as_posix()
        text = path.read_text(encoding="utf-8")
        lines = text.splitlines()
        if len(lines) > FILE_LINES:
            over(name, f"{name}: {len(lines)} lines, more than {FILE_LINES}")
        for number, line in enumerate(lines, 1):
            if len(line) > COLUMNS:
                problems.append(f"{name}:{number}: {len(line)} columns, more than {COLUMNS}")
        for function, first, length in functions(text):
            if length > FUNCTION_LINES:
                over(f"{name} {function}",
                     f"{name}:{first}: {function} has {length} lines, more than {FUNCTION_LINES}")
    problems += [f"size_allowed.txt: '{key}' is not needed or has no reason"
                 for key in allowed if key not in used]
    return problems, len(files)


def self_test():
    long_body = "  f();\n" * 70
    planted = {
        "core/a/good.cpp": "namespace a {\nvoid f() {\n" + "  f();\n" * 50 + "}\n"
                           "int x = [] { return 1; }();\nstruct S {\n" + "  int a;\n" * 80 + "};\n}\n",
        "core/a/long.cpp": "namespace a {\nint C::f(int a) const {\n" + long_body + "}\n}\n",
        "core/a/member.h": "class C {\n C() : a_{1}, b_(2) {\n" + long_body + "}\n};\n",
        "core/a/lines.h": "\n" * 401,
        "core/a/wide.h": "//" + "x" * 99 + "\n",
        "core/a/excused.h": "\n" * 401,
    }
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        plant(root, planted.items())
        found, _ = check(root, {"core/a/excused.h": "a table", "core/a/good.cpp": "none needed"})
    expected = ["core/a/lines.h: 401 lines, more than 400",
                "core/a/long.cpp:2: C::f has 72 lines, more than 60",
                "core/a/member.h:2: C has 72 lines, more than 60",
                "core/a/wide.h:1: 101 columns, more than 100",
                "size_allowed.txt: 'core/a/good.cpp' is not needed or has no reason"]
    wrong = [] if found == expected else ["expected:", *expected, "reported:", *found]
    return report("size --self-test", wrong, f"{len(planted)} planted files")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    exceptions = read_allowed(pathlib.Path(__file__).with_name("size_allowed.txt"))
    list_of_problems, number_of_files = check(sys.argv[1], exceptions)
    if number_of_files == 0:
        list_of_problems.append("no source found: wrong folder?")
    sys.exit(report("size", list_of_problems, f"{number_of_files} files"))
