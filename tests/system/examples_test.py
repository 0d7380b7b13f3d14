#!/usr/bin/env python3
"""The examples of the documents run as they stand there.

Usage: examples_test.py PROGRAM REPOSITORY

A fenced block behind a line `<!-- run -->` is a script. All of a document run in its order, in one scratch
folder where `tests`, `docs` and `build/bench/bin/tubesight` are and `tubesight` is in the path. Each must end
with 0, and each file that it names behind an option must be there then.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path()
REPOSITORY = pathlib.Path()
RUN = re.compile(r"^<!-- run -->\n```sh\n(.*?)^```$", re.MULTILINE | re.DOTALL)
OUTPUT = re.compile(r"--(?:fields|centers|csv|overlay|poses|pairs)[ =](\S+)")
DOCUMENTS = {"README.md": 3, "docs/tutorial.md": 4}  # with the fewest examples that must be found


class Examples(unittest.TestCase):
    def run_all(self, document, fewest):
        scripts = RUN.findall((REPOSITORY / document).read_text(encoding="utf-8"))
        self.assertGreaterEqual(len(scripts), fewest, document)
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            (folder / "build/bench/bin").mkdir(parents=True)
            (folder / "build/bench/bin/tubesight").symlink_to(PROGRAM)
            for name in ("tests", "docs"):
                (folder / name).symlink_to(REPOSITORY / name)
            path = f"{folder}/build/bench/bin:{os.environ['PATH']}"
            for script in scripts:
                with self.subTest(document=document, script=script):
                    result = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, check=False,
                                            capture_output=True, text=True, env={**os.environ, "PATH": path},
                                            stdin=subprocess.DEVNULL)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    self.assertEqual(result.stderr, "", script)
                    for output in OUTPUT.findall(script):
                        self.assertTrue((folder / output).exists(), output)

    def test_readme(self):
        self.run_all("README.md", DOCUMENTS["README.md"])

    def test_tutorial(self):
        self.run_all("docs/tutorial.md", DOCUMENTS["docs/tutorial.md"])

    def test_a_broken_example_is_found(self):
        self.assertEqual(RUN.findall("<!-- run -->\n```sh\nfalse\n```\n"), ["false\n"])
        self.assertEqual(RUN.findall("```sh\nfalse\n```\n"), [])
        self.assertEqual(OUTPUT.findall("x --fields f.csv --overlay=o.png"), ["f.csv", "o.png"])


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
    REPOSITORY = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
