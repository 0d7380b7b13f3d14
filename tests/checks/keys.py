#!/usr/bin/env python3
"""The documents tell every key that the settings' readers know, and no others.

Usage: keys.py PROGRAM ROOT | keys.py --self-test

What a reader knows it says itself: each table is given a key that it cannot know, and the message
lists those that it expects.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from source_text import report

UNKNOWN = "no_such_key"
# Of scenarios: tables whose readers look at other tables first.
SCENARIO_PARTS = ["camera.toml", "sheet-square.toml"]


def known_keys(said):
    """{table: keys} of the messages about unknown keys."""
    keys = {}
    for table, names in re.findall(rf"(\w+)(?:\[\d+\])?\.{UNKNOWN}: unknown key, expected one of (.+)", said):
        keys.setdefault(table, set()).update(names.split(", "))
    return keys


def known_tables(said):
    match = re.search(r"\[no_such_table\]: unknown table, expected one of (.+)", said)
    return set(match[1].split(", ")) if match else set()


def ask(program, arguments, text, lists=(), beside=""):
    """What the program says of a settings file with an unknown key in each of its tables."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "k.toml"

        def said_of(settings):
            path.write_text(settings)
            result = subprocess.run([program, *[str(path) if word == "FILE" else word for word in arguments]],
                                    capture_output=True, text=True, check=False, cwd=folder)
            return result.stderr

        tables = known_tables(said_of("[no_such_table]\n" + text))
        keys = {}
        for table in sorted(tables):
            heading = f"[[{table}]]" if table in lists else f"[{table}]"
            own = "" if re.search(rf"^\[+{table}\]", beside, re.M) else heading + "\n"
            settings = beside if not own else beside + own
            settings = re.sub(rf"^(\[+{table}\]+)$", rf"\1\n{UNKNOWN} = 1", settings, count=1, flags=re.M)
            keys.update({name: found for name, found in known_keys(said_of(settings)).items() if name == table})
        return tables, keys


def told_keys(text):
    """{table: keys} of a document's tables of keys: below a heading, or a line, that names their table."""
    told, tables, in_table = {}, [], False
    for line in text.splitlines():
        named = re.findall(r"`\[+(\w+)\]+`", line)
        if line.startswith("|"):
            header = re.match(r"\| key(?: of `\[+(\w+)\]+`)? \|", line)
            if header:
                in_table = True
                tables = [header[1]] if header[1] else tables
            elif in_table and not line.startswith("|---"):
                first = line.split("|")[1]
                for table in tables:
                    told.setdefault(table, set()).update(re.findall(r"`(\w+)`", first))
        else:
            in_table = False
            if line.startswith("#") or line.startswith(("`[", "Each `[[")):
                tables = named
    return told


def compare(document, known, told, only=None):
    problems = []
    for table in sorted(known):
        if only is not None and table not in only:
            continue
        for key in sorted(known[table] - told.get(table, set())):
            problems.append(f"{document}: [{table}] {key}: known to the reader, expected a row in the table's keys")
        for key in sorted(told.get(table, set()) - known[table]):
            problems.append(f"{document}: [{table}] {key}: told, but the reader does not know it")
    return problems


def check(program, root):
    docs = pathlib.Path(root) / "docs"
    formats = (docs / "file-formats.md").read_text()
    problems = []
    tables, session = ask(program, ["replay", "FILE", "none.y4m"], "")
    for table in sorted(tables - set(session)):
        problems.append(f"keys.py: [{table}] of a session: the program did not tell its keys")
    problems += compare("docs/file-formats.md", session, told_keys(formats))
    tables, target = ask(program, ["calibrate", "camera", "FILE"], "", lists=["view"])
    target = {table: keys for table, keys in target.items() if table == "target"}
    problems += compare("docs/file-formats.md", target, told_keys(formats))

    scenarios = (docs / "scenarios.md").read_text() + (docs / "kinematics.md").read_text() + formats
    parts = pathlib.Path(root) / "tests/data/scenarios/parts"
    beside = "".join((parts / name).read_text() for name in SCENARIO_PARTS)
    beside += "[path]\ntube = [40, 60]\nheight_mm = 60\n"
    tables, scenario = ask(program, ["simulate", "FILE", "--out", "x"], "", beside=beside,
                           lists=["step", "event", "fault"])
    words = set(re.findall(r"`(\w+)(?: = [^`]*)?`", scenarios)) | set(re.findall(r"`(\w+) = ", scenarios))
    for table in sorted(tables):
        if table not in scenario:
            problems.append(f"keys.py: [{table}] of a scenario: the program did not tell its keys")
        for key in sorted(scenario.get(table, set()) - words):
            problems.append(f"docs/scenarios.md: [{table}] {key}: known to the reader, expected to be told")
    strict = {"calibration_error", "look", "lamp", "sensor", "guidetube", "video", "path", "sheet", "scenario", "expect"}
    told = told_keys((docs / "scenarios.md").read_text())
    problems += compare("docs/scenarios.md", scenario, told, only=strict)
    return problems


def self_test():
    said = ("f:3: camera.no_such_key: unknown key, expected one of a_px, b_mm\n"
            "f:9: view[0].no_such_key: unknown key, expected one of images\n")
    assert known_keys(said) == {"camera": {"a_px", "b_mm"}, "view": {"images"}}
    assert known_tables("f:1: [no_such_table]: unknown table, expected one of a, b") == {"a", "b"}
    text = ("### `[camera]`\n\nWords.\n\n| key | is |\n|---|---|\n| `a_px`, `b_mm` | `c` |\n\n"
            "| other | is |\n|---|---|\n| `d` | |\n\n`[lamp]`: light.\n\n| key | is |\n|---|---|\n| `e` | |\n\n"
            "| key of `[view]` | |\n|---|---|\n| `images` | |\n")
    told = told_keys(text)
    assert told == {"camera": {"a_px", "b_mm"}, "lamp": {"e"}, "view": {"images"}}, told
    known = {"camera": {"a_px", "b_mm"}, "lamp": {"e"}}
    assert not compare("d", known, told)
    missing = compare("d", {"camera": {"a_px", "b_mm", "x"}, "lamp": {"e"}}, told)
    assert missing == ["d: [camera] x: known to the reader, expected a row in the table's keys"], missing
    surplus = compare("d", {"camera": {"a_px"}}, told)
    assert surplus == ["d: [camera] b_mm: told, but the reader does not know it"], surplus
    return 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(self_test())
    sys.exit(report("keys", check(sys.argv[1], sys.argv[2]), "the settings' readers"))
