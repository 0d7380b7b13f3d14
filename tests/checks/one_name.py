#!/usr/bin/env python3
"""No two headers of the product define a type of one name in one namespace.

Usage: one_name.py ROOT | one_name.py --self-test

Where both come into one program, the linker takes the functions of one for both: what then happens is
undefined, and no compiler tells. Types in anonymous namespaces and inside of others are their own.
"""
import pathlib
import re
import sys
import tempfile

from source_text import code_only, plant, report, sources

FOLDERS = ["core", "hal", "drivers", "board"]

NAMESPACE = re.compile(r"^namespace ([\w:]+) \{", re.M)
# As clang-format leaves them: what stands in the first column is in no other type.
TYPE = re.compile(r"^(?:struct|class|enum class) (?:alignas\([^)]*\) )?(\w+)(?: final)?(?:\s*:[^;{]*)?\s*\{",
                  re.M)


def check(root):
    root = pathlib.Path(root)
    problems, first, number = [], {}, 0
    for path in sources(root, FOLDERS):
        if path.suffix != ".h":
            continue
        number += 1
        name = path.relative_to(root).as_posix()
        text = code_only(path.read_text(encoding="utf-8"))
        spaces = [(found.start(), found.group(1)) for found in NAMESPACE.finditer(text)]
        for found in TYPE.finditer(text):
            within = [space for start, space in spaces if start < found.start()]
            whole = "::".join(within[-1:] + [found.group(1)])
            known = first.setdefault(whole, name)
            if known != name:
                problems.append(f"{name}: {whole} is also defined in {known}")
    return problems, number


def self_test():
    files = {
        "core/a.h": "namespace t::core {\nstruct Place {\n  struct Inner {\n  };\n};\n}\n",
        "core/b.h": "namespace t::core {\nclass Place;\nenum class Kind : int { kA };\n}\n",
        "core/c.cpp": "namespace t::core {\nstruct Place {\n};\n}\n",
        "drivers/a.h": "namespace t::drivers {\nclass Place final : public Other {\n};\n}\n",
        "drivers/b.h": "namespace t::drivers {\nstruct Inner {};\n// struct Place {\nclass Place {\n};\n}\n",
    }
    with tempfile.TemporaryDirectory() as folder:
        plant(folder, files.items())
        found, _ = check(folder)
    expected = ["drivers/b.h: t::drivers::Place is also defined in drivers/a.h"]
    wrong = [] if found == expected else [f"expected {expected}, reported {found}"]
    return report("one_name --self-test", wrong, f"{len(files)} planted files")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    list_of_problems, number_of_files = check(sys.argv[1])
    if number_of_files == 0:
        list_of_problems.append("no header found: wrong folder?")
    sys.exit(report("one_name", list_of_problems, f"{number_of_files} headers"))
