#!/usr/bin/env python3
"""A program tells the commit that it was built from, and a commit makes one source compile anew.

Usage: commit.py ROOT CMAKE GENERATOR COMPILER | commit.py --self-test

Builds a small project with toolchain/tubesight_commit.cmake in repositories made for it.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from source_text import report

PROJECT = {
    "CMakeLists.txt": """
cmake_minimum_required(VERSION 3.25)
project(telling LANGUAGES CXX)
include(${PROJECT_SOURCE_DIR}/tubesight_commit.cmake)
add_library(box STATIC other.cpp)
tubesight_add_commit(box commit.cpp.in)
add_executable(tell main.cpp)
target_link_libraries(tell PRIVATE box)
""",
    "commit.cpp.in": 'const char* commit() { return "@COMMIT@"; }\n',
    "other.cpp": "int other() { return 1; }\n",
    "main.cpp": '#include <cstdio>\nconst char* commit();\nint main() { std::puts(commit()); }\n',
    ".gitignore": "/build/\n",
}
SCRIPTS = ["tubesight_commit.cmake", "write_commit.cmake"]


def run(folder, *command):
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    environment["GIT_CEILING_DIRECTORIES"] = str(folder.parent.parent)
    environment["GIT_CONFIG_GLOBAL"] = os.devnull
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: {done.stdout}{done.stderr}")
    return done.stdout


def git(folder, *arguments):
    return run(folder, "git", "-c", "user.name=nobody", "-c", "user.email=nobody@example.invalid",
               "-c", "commit.gpgsign=false", *arguments).strip()


class Tree:
    """The small project in a folder of its own."""

    def __init__(self, folder, toolchain, cmake, generator, compiler):
        self.folder, self.cmake = folder, cmake
        self.configuring = ["-G", generator, "-S", ".", "-B", "build",
                            f"-DCMAKE_CXX_COMPILER={compiler}"]
        folder.mkdir(parents=True)
        for name, text in PROJECT.items():
            (folder / name).write_text(text, encoding="utf-8")
        for name in SCRIPTS:
            shutil.copy(toolchain / name, folder / name)

    def configure(self):
        run(self.folder, self.cmake, *self.configuring)

    def build(self):
        """What the program tells, and the sources compiled for it."""
        said = run(self.folder, self.cmake, "--build", "build")
        compiled = [name for name in ("commit.cpp", "other.cpp", "main.cpp")
                    if f"/{name}.o" in said]
        return run(self.folder, str(self.folder / "build/tell")).strip(), compiled


def commit_all(tree, message):
    git(tree.folder, "add", "-A")
    git(tree.folder, "commit", "-q", "-m", message)
    return git(tree.folder, "rev-parse", "--short=12", "HEAD")


def differs(what, found, expected):
    return [] if found == expected else [f"{what}: {found}, expected {expected}"]


def check(toolchain, *tools):
    everything = ["commit.cpp", "other.cpp", "main.cpp"]
    with tempfile.TemporaryDirectory() as temporary:
        root = pathlib.Path(temporary).resolve()
        tree = Tree(root / "own", toolchain, *tools)
        git(tree.folder, "init", "-q")
        first = commit_all(tree, "first")
        tree.configure()
        problems = differs("built first", tree.build(), (first, everything))
        problems += differs("built again", tree.build(), (first, []))
        (tree.folder / "README").write_text("new\n", encoding="utf-8")
        second = commit_all(tree, "second")
        problems += differs("after a commit", tree.build(), (second, ["commit.cpp"]))
        (tree.folder / "README").write_text("newer\n", encoding="utf-8")
        problems += differs("with changes", tree.build(), (second + "-dirty", ["commit.cpp"]))
        git(tree.folder, "commit", "-q", "-a", "-m", "third")
        git(tree.folder, "tag", "-a", "v1", "-m", "v1")
        problems += differs("at a tag", tree.build(), ("v1", ["commit.cpp"]))

        shallow = Tree(root / "shallow", toolchain, *tools)
        git(shallow.folder, "clone", "-q", "--no-tags", "--depth", "1", f"file://{tree.folder}", "c")
        shallow.folder = shallow.folder / "c"
        shallow.configure()
        third = git(tree.folder, "rev-parse", "--short=12", "HEAD")
        problems += differs("a shallow clone", shallow.build(), (third, everything))

        # A source archive, unpacked within somebody's repository.
        archive = Tree(tree.folder / "archive", toolchain, *tools)
        archive.configure()
        problems += differs("an archive", archive.build(), ("unknown", everything))
    return problems


def self_test(root, *tools):
    """A script that asks once, and whichever repository lies around, must be caught at both."""
    planted = {
        "if(EXISTS ${TREE}/.git)": "if(NOT EXISTS ${OUTPUT})",
        "set(COMMIT unknown)": "if(EXISTS ${OUTPUT})\n  return()\nendif()\nset(COMMIT unknown)",
    }
    with tempfile.TemporaryDirectory() as folder:
        toolchain = pathlib.Path(folder)
        for name in SCRIPTS:
            text = (root / "toolchain" / name).read_text(encoding="utf-8")
            for part, instead in planted.items():
                text = text.replace(part, instead)
            (toolchain / name).write_text(text, encoding="utf-8")
        found = check(toolchain, *tools)
    names = [problem.split(":")[0] for problem in found]
    expected = ["after a commit", "with changes", "at a tag", "an archive"]
    wrong = [] if names == expected else [f"expected {expected}, reported {found}"]
    return report("commit --self-test", wrong, f"{len(planted)} planted mistakes")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test(pathlib.Path(sys.argv[2]), *sys.argv[3:6]))
    list_of_problems = check(pathlib.Path(sys.argv[1], "toolchain"), *sys.argv[2:5])
    sys.exit(report("commit", list_of_problems, "7 builds"))
