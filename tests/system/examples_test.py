#!/usr/bin/env python3
"""The examples of README.md and of all pages in docs/ run as they stand there.

Usage: examples_test.py PROGRAM REPOSITORY [DAEMON]

A block of commands, fenced or indented, that calls a program of ours must run, or stand in examples_not_run.txt with
the reason. What runs is fenced as `sh` behind a line `<!-- run -->`: all of a document run in its order, in one
scratch folder where `tests`, `docs` and `build/bench/bin/` with the programs are, and the programs are in the path.
Each must end with 0 and say nothing on standard error, and each file that it names behind an option must be there
then. A block behind `<!-- file NAME -->` is written there under its name before, and a script of its document must
name it. Every other block of settings holds keys that a reader of ours knows, in their tables.
"""
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path()
DAEMON = pathlib.Path()
REPOSITORY = pathlib.Path()
NOT_RUN = "tests/system/examples_not_run.txt"
FEWEST_RUN = 22
CALL = re.compile(r"^(?:\$ )?(?:sudo )?(?:[A-Z_]+=\S+ )?(?:(?:/usr/bin/)?python3 )?"
                  r"(?:tubesight(?:d|ctl|-slot)?|"
                  r"(?:\./|build/|docs/examples/|tests/benchmark/|board/|toolchain/|scripts/)\S*\w)(?= |$)")
JOIN = re.compile(r" *(?:&&|\|\|?|;) *")
OUTPUT = re.compile(r"--(?:fields|centers|csv|overlay|poses|pairs|replies|summary|picture|plot|export|report)[ =](\S+)")
SETTINGS = re.compile(r"^(?:\[+\w+\]+|\w+ = (?:[\"\[{\d]|-\d|true|false).*)(?: +#.*)?$")


class Block:
    """A fenced or an indented block, with the comment in the line above it."""

    def __init__(self, document, line, mark, language, text):
        self.document, self.line, self.mark, self.language, self.text = document, line, mark, language, text

    def first_call(self):
        """The first line that calls a program of ours; None where none does."""
        continued = False
        for line in self.text.splitlines():
            if not continued and any(CALL.match(part) for part in JOIN.split(line)):
                return line.rstrip()
            continued = line.endswith("\\")
        return None

    def runs(self):
        return self.mark == "run"

    def file(self):
        return self.mark.removeprefix("file ") if self.mark.startswith("file ") else None

    def is_settings(self):
        begin = next((line for line in self.text.splitlines() if line.strip()), "")
        return self.language == "toml" or not self.language and bool(SETTINGS.match(begin))

    def place(self):
        return f"{self.document}:{self.line}"


def blocks_of(document, text):
    found, lines, at = [], text.splitlines(), 0
    while at < len(lines):
        begin, fence = at, re.match(r"^( *)```(\w*)$", lines[at])
        mark = re.match(r"^ *<!-- (.*) -->$", lines[at - 1]) if at else None
        if fence:
            at += 1
            while at < len(lines) and lines[at].strip() != "```":
                at += 1
            body = [line.removeprefix(fence[1]) for line in lines[begin + 1:at]]
            at += 1
        elif lines[at].startswith("    ") and (not at or not lines[at - 1].strip()):
            while at < len(lines) and (lines[at].startswith("    ") or not lines[at].strip()):
                at += 1
            deep = min(len(line) - len(line.lstrip()) for line in lines[begin:at] if line.strip())
            body = [line[deep:] for line in lines[begin:at]]
        else:
            at += 1
            continue
        found.append(Block(document, begin + 1, mark[1] if mark else "", fence[2] if fence else "",
                           "\n".join(body).rstrip() + "\n"))
    return found


def not_run_of(text):
    """{(document, first call): reason} of the list of exceptions."""
    listed, reason = {}, ""
    for line in text.splitlines():
        if line.startswith("[") and line.endswith("]"):
            reason = line[1:-1]
        elif line and not line.startswith("# "):
            document, _, call = line.partition(": ")
            listed[(document, call)] = reason
    return listed


def unaccounted(blocks, listed):
    """What is neither run nor listed, is both, or is listed and not there."""
    problems, seen = [], set()
    for block in blocks:
        call = block.first_call()
        key = (block.document, call)
        if block.runs():
            if call is None:
                problems.append(f"{block.place()}: runs, but calls no program of ours")
        elif call is not None and not block.is_settings():
            seen.add(key)
            if key not in listed:
                problems.append(f"{block.place()}: '{call}' neither runs nor stands in {NOT_RUN}")
    problems += [f"{NOT_RUN}: {document}: '{call}' stands in no block that is not run"
                 for document, call in listed if (document, call) not in seen]
    problems += [f"{NOT_RUN}: {document}: '{call}' has no reason"
                 for (document, call), why in listed.items() if not why]
    return problems


def keys_of(text):
    """(table, key) of settings; the table is empty before the first one."""
    table, inside, found = "", 0, []
    for line in text.splitlines():
        line = re.sub(r"\s+#.*|^#.*", "", line)
        heading = re.match(r"^\[+([A-Za-z_]+)\]+$", line)
        key = re.match(r"^(\w+) *=", line)
        if heading:
            table = heading[1]
            found.append((table, None))
        elif key and not inside:
            found.append((table, key[1]))
        inside += line.count("[") - line.count("]") + line.count("{") - line.count("}")
    return found


def unknown_keys(block, known):
    """What no reader of ours knows; tables with capitals are others' (systemd)."""
    problems, strangers = [], any(table[:1].isupper() for table, _ in keys_of(block.text))
    for table, key in [] if strangers else keys_of(block.text):
        if table and table not in known:
            problems.append(f"{block.place()}: [{table}] is a table of no settings")
        elif key and not table and key not in {"format", "include"} | set().union(*known.values()):
            problems.append(f"{block.place()}: '{key}' is a key of no settings")
        elif key and table and key not in known[table]:
            problems.append(f"{block.place()}: '{key}' is no key of [{table}]")
    return problems


def known_keys():
    """{table: keys} of all readers, as they say themselves to tests/checks/keys.py.

    Of views and steps they say those alone that go with what stands there: the rest are those of the files that ship.
    """
    place = REPOSITORY / "tests/checks/keys.py"
    sys.path.insert(0, str(place.parent))
    spec = importlib.util.spec_from_file_location("keys", place)
    keys = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(keys)
    parts = REPOSITORY / "tests/data/scenarios/parts"
    scenario = "".join((parts / name).read_text() for name in keys.SCENARIO_PARTS)
    scenario += "[path]\ntube = [40, 60]\nheight_mm = 60\n"
    known = {}
    for program, arguments, lists, beside in (
            (PROGRAM, ["replay", "FILE", "none.y4m"], [], ""),
            (PROGRAM, ["calibrate", "camera", "FILE"], ["view"], ""),
            (PROGRAM, ["simulate", "FILE", "--out", "x"], ["step", "event", "fault"], scenario),
            (DAEMON, ["FILE", "--check"], [], "")):
        for table, words in keys.ask(program, arguments, "", lists=lists, beside=beside)[1].items():
            known.setdefault(table, set()).update(words)
    for shipped in [*parts.parent.glob("*.toml"), *(REPOSITORY / "docs/examples").rglob("*.toml")]:
        for table, key in keys_of(shipped.read_text(encoding="utf-8")):
            if table in ("view", "step") and key:
                known[table].add(key)
    return known


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        documents = [REPOSITORY / "README.md", *sorted((REPOSITORY / "docs").glob("*.md"))]
        cls.blocks = [block for path in documents
                      for block in blocks_of(path.relative_to(REPOSITORY).as_posix(), path.read_text(encoding="utf-8"))]

    def test_every_block_of_commands_runs_or_says_why_not(self):
        listed = not_run_of((REPOSITORY / NOT_RUN).read_text(encoding="utf-8"))
        self.assertEqual(unaccounted(self.blocks, listed), [])
        self.assertGreaterEqual(sum(block.runs() for block in self.blocks), FEWEST_RUN)

    def test_every_block_of_settings_has_known_keys(self):
        known = known_keys()
        for table in ("camera", "view", "fault", "source"):
            self.assertIn(table, known)
        problems = [problem for block in self.blocks if block.is_settings() for problem in unknown_keys(block, known)]
        self.assertEqual(problems, [])

    def test_the_examples_run(self):
        for document in sorted({block.document for block in self.blocks if block.runs() or block.file()}):
            self.run_all(document, [block for block in self.blocks if block.document == document])

    def run_all(self, document, blocks):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            programs = folder / "build/bench/bin"
            programs.mkdir(parents=True)
            for program in (PROGRAM, DAEMON):
                (programs / program.name).symlink_to(program)
            for name in ("tests", "docs"):
                (folder / name).symlink_to(REPOSITORY / name)
            path = f"{programs}:{os.environ['PATH']}"
            scripts = "".join(block.text for block in blocks if block.runs())
            for block in blocks:
                if block.file():
                    with self.subTest(file=block.place()):
                        self.assertIn(block.file(), scripts)
                    (folder / block.file()).write_text(block.text, encoding="utf-8")
                if block.runs():
                    with self.subTest(example=block.place(), script=block.text):
                        self.run_one(folder, block.text, path)

    def run_one(self, folder, script, path):
        result = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, check=False,
                                capture_output=True, text=True, env={**os.environ, "PATH": path},
                                stdin=subprocess.DEVNULL)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "", script)
        for output in OUTPUT.findall(script):
            self.assertTrue((folder / output).exists(), output)


class Itself(unittest.TestCase):
    """What is planted is found."""

    TEXT = ("# A\n<!-- run -->\n```sh\ntubesight look x\n```\n\n"
            "    $ sudo tubesightd y.toml &\n    said: z\n    tests/data/z.png\n\n"
            "1. Do\n\n   ```sh\n   cd x && build/bench/bin/pose_study --x \\\n      a\n   ```\n\n"
            "<!-- file s.toml -->\n```toml\n[camera]\nwidth_px = [1, # one\n  2]\n```\n\n"
            "    [lamp]\n    king = 1\n\nWords.\n\n"
            "    tubesight.txt   yours\n    build/bench/bin/\n")

    def test_blocks_are_found(self):
        blocks = blocks_of("d.md", self.TEXT)
        self.assertEqual([block.first_call() for block in blocks],
                         ["tubesight look x", "$ sudo tubesightd y.toml &",
                          "cd x && build/bench/bin/pose_study --x \\", None, None, None])
        self.assertEqual([block.line for block in blocks], [3, 7, 13, 19, 25, 30])
        self.assertEqual([block.file() for block in blocks], [None, None, None, "s.toml", None, None])
        self.assertEqual([block.is_settings() for block in blocks], [False, False, False, True, True, False])

    def test_what_is_not_accounted_for_is_found(self):
        blocks = blocks_of("d.md", self.TEXT)
        listed = not_run_of("# What\n[the board]\nd.md: $ sudo tubesightd y.toml &\nd.md: tubesight gone\n")
        self.assertEqual(listed[("d.md", "tubesight gone")], "the board")
        problems = unaccounted(blocks, listed)
        self.assertEqual(len(problems), 2, problems)
        self.assertIn("pose_study", problems[0])
        self.assertIn("'tubesight gone' stands in no block", problems[1])
        self.assertEqual(len(unaccounted(blocks[:1], not_run_of("[why]\nd.md: tubesight look x\n"))), 1)
        self.assertEqual(len(unaccounted(blocks[1:2], not_run_of("d.md: $ sudo tubesightd y.toml &\n"))), 1)

    def test_a_wrong_key_is_found(self):
        blocks = blocks_of("d.md", self.TEXT)
        known = {"camera": {"width_px"}, "lamp": {"kind"}}
        self.assertEqual(unknown_keys(blocks[3], known), [])
        self.assertEqual(unknown_keys(blocks[4], known), ["d.md:25: 'king' is no key of [lamp]"])
        self.assertEqual(unknown_keys(Block("d", 1, "", "toml", "[lam]\nkind = 1\n"), known),
                         ["d:1: [lam] is a table of no settings"] * 2)
        self.assertEqual(unknown_keys(Block("d", 1, "", "toml", "kinds = 1\n"), known),
                         ["d:1: 'kinds' is a key of no settings"])

    def test_outputs_are_found(self):
        self.assertEqual(OUTPUT.findall("x --fields f.csv --overlay=o.png"), ["f.csv", "o.png"])

    def test_a_broken_example_is_found(self):
        with tempfile.TemporaryDirectory() as scratch:
            for script in ("false\n", "echo word >&2\n", "true --csv none.csv\n", "false | true\n"):
                with self.assertRaises(AssertionError, msg=script):
                    Examples("run_one").run_one(pathlib.Path(scratch), script, os.environ["PATH"])


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
    REPOSITORY = pathlib.Path(sys.argv.pop(1)).resolve()
    DAEMON = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
