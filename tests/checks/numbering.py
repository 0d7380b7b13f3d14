#!/usr/bin/env python3
"""Which addresses there are is known to core/tubesheet alone.

Usage: numbering.py ROOT | numbering.py --self-test

Elsewhere in the product no source names a numbering, its words in files or the shift of odd rows,
asks whether a row or column is odd, or takes the steps between tubes apart: a further numbering
would have to be added there too. core/rendering draws by an arithmetic of its own, on purpose, and
the tests have their own oracles. Exceptions stand in numbering_allowed.txt beside this file, one a
line: `PATH: REASON`; one that is no longer needed is an error too.
"""
import pathlib
import re
import sys
import tempfile

from source_text import code_only, plant, report, sources

FOLDERS = ["core", "hal", "drivers", "board"]
KNOWING = ("core/tubesheet/", "core/rendering/")

# In the code, strings and comments left out.
CODE = [
    (re.compile(r"\bAddressParity\b|\bk(?:Even|Odd)Sum\b"), "names a numbering"),
    (re.compile(r"\bodd_row_shift\b|\bin_odd_row\b|\btwo_kinds\b"), "knows of shifted rows"),
    (re.compile(r"\b(?:row|column)_step(?:_mm)?\b"), "takes the steps between tubes apart"),
    (re.compile(r"(?:\brows?|\bcolumns?|_row|_column)\b[^;{}]{0,20}?(?:%\s*2\b|&\s*1\b)"),
     "asks whether an address is odd"),
]
# In the text, for the words are strings.
TEXT = [(re.compile(r'"(?:even|odd)-sum"'), "has the word of a numbering")]


def check_file(text):
    """Yields (line, what) of each violation."""
    for patterns, searched in ((CODE, code_only(text)), (TEXT, text)):
        for pattern, what in patterns:
            for found in pattern.finditer(searched):
                yield searched.count("\n", 0, found.start()) + 1, what


def check(root, allowed):
    root = pathlib.Path(root)
    problems, number, used = [], 0, set()
    for path in sources(root, FOLDERS):
        name = path.relative_to(root).as_posix()
        number += 1
        if name.startswith(KNOWING):
            continue
        for line, what in sorted(set(check_file(path.read_text(encoding="utf-8")))):
            if name in allowed:
                used.add(name)
            else:
                problems.append(f"{name}:{line}: {what}, expected a question to core/tubesheet")
    problems += [f"numbering_allowed.txt: {name} needs no exception"
                 for name in sorted(allowed - used)]
    return problems, number


def self_test():
    files = {
        "core/base/settings.h": "AddressParity addresses; double odd_row_shift;\n",
        "core/tubesheet/a.h": "bool odd(int row) { return row & 1; }\n",
        "core/rendering/a.h": "bool odd(int row) { return row % 2; }\n",
        "core/pose/a.cpp": "// odd_row_shift, row % 2\nint a = shift * p.odd_row_shift;\n",
        "drivers/a.cpp": "bool b = (address.row + address.column) % 2 == 0;\nint c = slot % 2;\n",
        "drivers/b.cpp": 'std::string w = "even-sum";\n',
        "board/a.cpp": "int a;\n\nif (first_row & 1) {}\nx = s.row_step_mm[0];\n",
        "board/b.cpp": "// AddressParity\nwide = row + 2 * column;\nint even = column % 20;\n",
    }
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        plant(root, files.items())
        found, _ = check(root, {"core/base/settings.h", "board/b.cpp"})
    end = ", expected a question to core/tubesheet"
    expected = ["board/a.cpp:3: asks whether an address is odd" + end,
                "board/a.cpp:4: takes the steps between tubes apart" + end,
                "core/pose/a.cpp:2: knows of shifted rows" + end,
                "drivers/a.cpp:1: asks whether an address is odd" + end,
                "drivers/b.cpp:1: has the word of a numbering" + end,
                "numbering_allowed.txt: board/b.cpp needs no exception"]
    wrong = [] if found == expected else [f"expected {expected}, reported {found}"]
    return report("numbering --self-test", wrong, f"{len(files)} planted files")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    lines = (pathlib.Path(__file__).parent / "numbering_allowed.txt").read_text(encoding="utf-8")
    exceptions = {line.split(": ")[0] for line in lines.splitlines() if not line.startswith("#")}
    list_of_problems, number_of_files = check(sys.argv[1], exceptions)
    if number_of_files == 0:
        list_of_problems.append("no source found: wrong folder?")
    sys.exit(report("numbering", list_of_problems, f"{number_of_files} files"))
