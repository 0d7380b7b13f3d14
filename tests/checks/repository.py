#!/usr/bin/env python3
"""The repository stands on its own: no path of somebody's machine, no package host, no large file; what
names its interpreter can be started.

Usage: repository.py ROOT | repository.py --self-test
"""
import os
import pathlib
import re
import sys
import tempfile

from source_text import plant, report

FILE_BYTES = 4_500_000
DATA_BYTES = 25_000_000

# Written so that this file does not find itself.
FORBIDDEN = [
    (re.compile(r"(?<![\w.])/(?:home|Users|root|work)" + r"/[\w.]"), "a path of one machine"),
    (re.compile(r"\.\./sha" + r"red\b"), "something outside the repository"),
    (re.compile(r"\b(?:deb|security|snapshot|ftp)\.deb" + r"ian\.org|\bpypi\.o" + r"rg|"
                r"pythonhos" + r"ted\.org|\bnpm" + r"js\.(?:org|com)|\bcrates\.i" + r"o\b|"
                r"\bproxy\.gol" + r"ang\.org"), "a package host"),
]
SKIPPED_FOLDERS = {".git", "__pycache__", ".cache", ".vscode", ".idea"}


def files_of(root):
    for folder, folders, names in os.walk(root):
        top = pathlib.Path(folder) == root
        folders[:] = sorted(name for name in folders if name not in SKIPPED_FOLDERS
                            and not (top and (name == "build" or name.startswith("build-"))))
        for name in sorted(names):
            path = pathlib.Path(folder, name)
            if path.is_file() and not path.is_symlink():
                yield path


def check(root):
    root = pathlib.Path(root)
    problems, data, number = [], 0, 0
    for path in files_of(root):
        number += 1
        name = path.relative_to(root).as_posix()
        size = path.stat().st_size
        if size > FILE_BYTES:
            problems.append(f"{name}: {size} bytes, more than {FILE_BYTES}")
        if name.startswith("tests/data/"):
            data += size
        content = path.read_bytes()
        if b"\0" in content[:8192]:
            continue
        if content.startswith(b"#!") and not os.access(path, os.X_OK):
            problems.append(f"{name}: begins with #! and is not executable")
        for line_number, line in enumerate(content.decode("utf-8", "replace").splitlines(), 1):
            for pattern, what in FORBIDDEN:
                match = pattern.search(line)
                if match:
                    problems.append(f"{name}:{line_number}: '{match.group(0)}' is {what}")
    if data > DATA_BYTES:
        problems.append(f"tests/data: {data} bytes, more than {DATA_BYTES}")
    return problems, number


def self_test():
    planted = {
        "README.md": "See /usr/src and core/work/x and ../share\n",
        "a.md": "in /ho" + "me/somebody/x\n",
        "b.cmake": "include(../sha" + "red/x)\n",
        "c.sh": "curl http://deb.deb" + "ian.org/x\n",
        "d.py": "#!/usr/bin/env python3\n",
        "e.py": "#!/usr/bin/env python3\n",
        "build/d.txt": "/ro" + "ot/x\n",
    }
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        plant(root, planted.items())
        (root / "e.py").chmod(0o755)
        for number in range(7):
            path = root / f"tests/data/{number}.bin"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(b"\0" * (4_500_001 if number == 0 else 4_000_000))
        found, _ = check(root)
    expected = ["a.md:1:", "b.cmake:1:", "c.sh:1:", "d.py:", "tests/data/0.bin:", "tests/data:"]
    good = len(found) == len(expected) and all(
        problem.startswith(begin) for problem, begin in zip(found, expected))
    wrong = [] if good else [f"expected {expected}, reported {found}"]
    return report("repository --self-test", wrong, f"{len(planted) + 7} planted files")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    list_of_problems, number_of_files = check(sys.argv[1])
    sys.exit(report("repository", list_of_problems, f"{number_of_files} files"))
