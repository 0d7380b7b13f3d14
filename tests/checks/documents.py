#!/usr/bin/env python3
"""What the documents point at is there.

Usage: documents.py ROOT | documents.py --self-test

Links of README.md, CONTRIBUTING.md and docs/ lead to files of the repository, nowhere else, and to headings where they
name one. Each page of docs/ is linked from docs/README.md. Folders and files that CONTRIBUTING.md names in `code` exist:
`core/base/` from the root, `result.h` anywhere, `drivers/<name>/` for one driver at least. Tests that docs/faults.md names are there: `Subject.Claim`, and
`Class.step` of the emulated board's. No document holds the marks of a merge that nobody finished.
"""
import pathlib
import re
import sys
import tempfile

from source_text import plant, report

LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"`([^`\n]+)`")
PATH = re.compile(r"^(?:\./)?([\w.<>-]+/[\w./<>-]*|[\w-]+\.(?:cpp|h|py|md|cmake|sh|json|txt|toml|1))$")
FENCE = re.compile(r"^```.*?^```$", re.DOTALL | re.MULTILINE)
TEST = re.compile(r"^([A-Z]\w*\.[A-Za-z]\w+)$")
MADE = re.compile(r"^(?:TYPED_)?TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", re.MULTILINE)
STEP = re.compile(r"^(?:class (\w+)|    def ([a-z]\w*)\()", re.MULTILINE)
UNMERGED = re.compile(r"^(<{7}|={7}|>{7})( |$)")
# Made by a build, or a part of C++ or of a command.
NOT_HERE = ("build/",)


def anchors(text):
    """The names by which GitHub links to headings."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", FENCE.sub("", text), re.MULTILINE):
        kept = re.sub(r"[^\w\- ]", "", heading.lower())
        found.add(kept.replace(" ", "-"))
    return found


def link_problem(root, path, target):
    if re.match(r"^[a-z]+:", target):
        return f"'{target}' leads out of the repository"
    name, _, anchor = target.partition("#")
    file = path.parent / name if name else path
    if root not in file.resolve().parents:
        return f"'{target}' leads out of the repository"
    if not file.exists():
        return f"'{target}' leads nowhere"
    if anchor and anchor not in anchors(file.read_text(encoding="utf-8")):
        return f"'{target}': {file.name} has no such heading"
    return None


def is_there(root, name):
    pattern = re.sub(r"<\w+>", "*", name.rstrip("/"))
    if "/" not in name:
        return (root / name).is_file() or any(
            found.is_file() for folder in ("core", "hal", "drivers", "board", "tests", "toolchain")
            for found in (root / folder).rglob(pattern))
    found = list(root.glob(pattern))
    return any(file.is_dir() for file in found) if name.endswith("/") else bool(found)


def lines_of(path):
    # Code blocks keep their lines, but hold no links.
    text = path.read_text(encoding="utf-8")
    return FENCE.sub(lambda match: "\n" * match.group(0).count("\n"), text).splitlines()


def steps_of(text):
    """`Class.step` of each method."""
    found, subject = set(), ""
    for begun, step in STEP.findall(text):
        subject = begun or subject
        if step:
            found.add(f"{subject}.{step}")
    return found


def tests_of(root):
    found = {f"{subject}.{claim}" for path in (root / "tests").rglob("*_test.cpp")
             for subject, claim in MADE.findall(path.read_text(encoding="utf-8"))}
    for path in (root / "tests" / "system" / "board").glob("*_test.py"):
        found |= steps_of(path.read_text(encoding="utf-8"))
    return found


def check(root):
    root = pathlib.Path(root)
    problems = []
    tests = tests_of(root)
    documents = [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").glob("*.md"))]
    for path in documents:
        name = path.relative_to(root).as_posix()
        for number, line in enumerate(lines_of(path), 1):
            found = [link_problem(root.resolve(), path, target) for target in LINK.findall(line)]
            found += ["a merge was left unfinished"] if UNMERGED.match(line) else []
            if path.name == "CONTRIBUTING.md":
                words = [word for code in CODE.findall(line) for word in code.split()]
                found += [f"`{word}` does not exist" for word in words
                          if PATH.match(word) and not word.startswith(NOT_HERE)
                          and not is_there(root, word.removeprefix("./"))]
            if path.name == "faults.md":
                found += [f"`{code}` is no test" for code in CODE.findall(line)
                          if TEST.match(code) and code not in tests]
            problems += [f"{name}:{number}: {problem}" for problem in found if problem]
    index = root / "docs" / "README.md"
    linked = set(LINK.findall(index.read_text(encoding="utf-8"))) if index.exists() else set()
    linked = {target.partition("#")[0] for target in linked}
    problems += [f"docs/README.md: links no {path.name}" for path in sorted((root / "docs").glob("*.md"))
                 if path != index and path.name not in linked]
    return problems, len(documents)


def self_test():
    planted = {
        "README.md": "# A b: `c --d`\n[x](docs/a.md) [y](https://example.org/x) [z](#a-b-c---d)\n"
                     "[u](docs/b.md)\n[v](docs/a.md#no)\n",
        "CONTRIBUTING.md": "`core/x/` `y.cpp` `drivers/<name>/` `drivers/<name>/y.cpp` `build/z` `R`\n"
                           "`./go.sh STAGE` `std::x` `a == b`\n`core/gone/` and `gone.h`\n"
                           "`board/<name>/`\n`core/x/y.cpp/`\n",
        "docs/README.md": "[a](a.md#yes)\n",
        "docs/a.md": "# Yes\n<<<<<<< HEAD\n| x |\n[o](../../out.md)\n",
        "docs/faults.md": "`A.IsThere` `core/x` `a.B` `B.test_is`\n`A.IsGone`\n`A.test_is`\n",
        "tests/a_test.cpp": "TEST_F(A,\n       IsThere) {}\n// TEST(A, IsGone)\n",
        "tests/system/board/b_test.py": "class A:\n    def test_was(self):\n        pass\n\n\n"
                                        "class B:\n    def test_is(self):\n        pass\n",
        "core/x/y.cpp": "",
        "drivers/v/y.cpp": "",
        "go.sh": "",
    }
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        plant(root, planted.items())
        found, _ = check(root)
    expected = ["README.md:2: 'https://example.org/x' leads out of", "README.md:3: 'docs/b.md'",
                "README.md:4: 'docs/a.md#no'",
                "CONTRIBUTING.md:3: `core/gone/`", "CONTRIBUTING.md:3: `gone.h`",
                "CONTRIBUTING.md:4: `board/<name>/`", "CONTRIBUTING.md:5: `core/x/y.cpp/`",
                "docs/a.md:2: a merge", "docs/a.md:4: '../../out.md' leads out of", "docs/faults.md:2: `A.IsGone`",
                "docs/faults.md:3: `A.test_is`", "docs/README.md: links no faults.md"]
    good = len(found) == len(expected) and all(
        problem.startswith(begin) for problem, begin in zip(found, expected))
    return report("documents --self-test",
                  [] if good else [f"expected {expected}, reported {found}"],
                  f"{len(expected)} planted mistakes")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    list_of_problems, number_of_documents = check(sys.argv[1])
    sys.exit(report("documents", list_of_problems, f"{number_of_documents} documents"))
