#!/usr/bin/env python3
"""What the types promise to refuse is refused, for the reason given.

Usage: must_not_compile.py FILE COMPILER FLAG... | must_not_compile.py --self-test COMPILER

A snippet says `// expect: REGEX` and has two versions: as it stands it must compile, and with
TUBESIGHT_MUST_NOT_COMPILE defined it must fail with a message that the expression matches. The twin
shows that nothing but the mistake itself stops the compiler.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from source_text import report

EXPECT = re.compile(r"^// expect: (.+)$", re.MULTILINE)


def compiles(compiler, flags, path, defines):
    result = subprocess.run([compiler, "-fsyntax-only", *flags, *defines, str(path)],
                            capture_output=True, text=True, check=False)
    return result.returncode == 0, result.stderr


def check(compiler, flags, path):
    expected = EXPECT.search(pathlib.Path(path).read_text(encoding="utf-8"))
    if not expected:
        return [f"{path}: no line '// expect: REGEX'"]
    good, message = compiles(compiler, flags, path, [])
    if not good:
        return [f"{path}: the correct twin does not compile:\n{message}"]
    good, message = compiles(compiler, flags, path, ["-DTUBESIGHT_MUST_NOT_COMPILE"])
    if good:
        return [f"{path}: compiles, though it must not"]
    if not re.search(expected.group(1), message):
        return [f"{path}: fails without a message like '{expected.group(1)}':\n{message}"]
    return []


PLANTED = [
    ("// expect: cannot convert\n#ifdef TUBESIGHT_MUST_NOT_COMPILE\nint* p = 1.0;\n#else\nint p = 1;\n"
     "#endif\n", None),
    ("// expect: cannot convert\nint p = 1;\n", "compiles, though it must not"),
    ("// expect: cannot convert\nint* p = 1.0;\n", "twin does not compile"),
    ("// expect: no such words\n#ifdef TUBESIGHT_MUST_NOT_COMPILE\nint* p = 1.0;\n#endif\n",
     "fails without a message"),
    ("int p = 1;\n", "no line '// expect"),
]


def self_test(compiler):
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "a.cpp")
        for text, expected in PLANTED:
            path.write_text(text, encoding="utf-8")
            problems = check(compiler, ["-std=c++20"], path)
            if (expected is None) != (not problems) or (expected and expected not in problems[0]):
                wrong.append(f"expected '{expected}', reported {problems}, in: {text}")
    return report("must_not_compile --self-test", wrong, f"{len(PLANTED)} planted snippets")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test(sys.argv[2]))
    sys.exit(report("must_not_compile", check(sys.argv[2], sys.argv[3:], sys.argv[1]), sys.argv[1]))
