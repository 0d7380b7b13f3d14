#!/usr/bin/env python3
"""An installation is whole and stands on its own.

Usage: install.py CMAKE BUILD SOURCE READELF | install.py --self-test

Installs into a temporary folder, looks for what belongs there, and replays the recording that comes
with the source with the program installed. Nothing installed may lead into the build tree: no run-time
path of the program, no text.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from source_text import report

PROGRAMS = ["tubesight", "tubesightctl", "tubesightd"]
WANTED = ["share/doc/tubesight/README.md", "share/doc/tubesight/LICENSE",
          "lib/systemd/system/tubesightd.service", "lib/sysusers.d/tubesight.conf",
          "lib/udev/rules.d/60-tubesight.rules"] + [
    name for program in PROGRAMS for name in (
        f"bin/{program}", f"share/man/man1/{program}.1",
        f"share/bash-completion/completions/{program}")]
RECORDING = "tests/data/recordings/square_flush"


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def check_files(prefix, source, build):
    """What is missing, what is there without need, and what leads into the build tree."""
    installed = {path.relative_to(prefix).as_posix() for path in prefix.rglob("*") if path.is_file()}
    documents = {f"share/doc/tubesight/{path.relative_to(source).as_posix()}"
                 for path in (source / "docs").rglob("*")
                 if path.is_file() and "docs/man/" not in path.as_posix()}
    wanted = documents | set(WANTED)
    problems = [f"{name}: not installed" for name in sorted(wanted - installed)]
    problems += [f"{name}: installed without need" for name in sorted(installed - wanted)]
    for name in sorted(installed - {f"bin/{program}" for program in PROGRAMS}):
        content = (prefix / name).read_bytes()
        if str(build).encode() in content or str(prefix).encode() in content:
            problems.append(f"{name}: names a folder of this machine")
    return problems


def check_dynamic(program, text):
    """Of what readelf tells: the folders in which the program looks for libraries."""
    return [f"bin/{program}: {line.strip()}" for line in text.splitlines()
            if re.search(r"\((RPATH|RUNPATH)\)", line)]


def check_program(prefix, source):
    problems = []
    for name in PROGRAMS:
        status, said = run(prefix / "bin" / name, "--version")
        if status != 0 or not said.startswith(f"{name} "):
            problems.append(f"{name} --version: {status} {said}")
    program = prefix / "bin/tubesight"
    fields = prefix / "fields.csv"
    status, said = run(program, "replay", source / RECORDING / "session.toml",
                       source / RECORDING / "recording.y4m.xz", "--fields", fields)
    if status != 0 or not fields.exists() or fields.read_text(encoding="utf-8").count("\n") < 10:
        problems.append(f"replay: {status} {said}")
    return problems


def check(cmake, build, source, readelf):
    build, source = pathlib.Path(build), pathlib.Path(source)
    with tempfile.TemporaryDirectory() as folder:
        prefix = pathlib.Path(folder, "usr")
        status, said = run(cmake, "--install", build, "--prefix", prefix)
        if status != 0:
            return [f"cmake --install: {status} {said}"]
        problems = check_files(prefix, source, build)
        for program in PROGRAMS:
            problems += check_dynamic(program, run(readelf, "-d", prefix / "bin" / program)[1])
        return problems + check_program(prefix, source)


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        prefix, source = root / "usr", root / "source"
        planted = {"bin/tubesight": "#!/bin/sh\nexit 3\n", "share/man/man1/tubesight.1": "",
                   "share/doc/tubesight/README.md": f"see {root / 'build'}\n",
                   "share/doc/tubesight/LICENSE": "", "share/doc/tubesight/docs/a.md": "",
                   "lib/systemd/system/tubesightd.service": "", "lib/sysusers.d/tubesight.conf": "",
                   "lib/udev/rules.d/60-tubesight.rules": "", "share/more": ""}
        for name in PROGRAMS[1:]:
            planted.update({f"bin/{name}": f"#!/bin/sh\necho {name} 1\n",
                            f"share/man/man1/{name}.1": "",
                            f"share/bash-completion/completions/{name}": ""})
        for name, text in planted.items():
            (prefix / name).parent.mkdir(parents=True, exist_ok=True)
            (prefix / name).write_text(text, encoding="utf-8")
        for name in PROGRAMS:
            (prefix / "bin" / name).chmod(0o755)
        for name in ("a.md", "pictures/b.png", "man/c.1"):
            (source / "docs" / name).parent.mkdir(parents=True, exist_ok=True)
            (source / "docs" / name).write_text("", encoding="utf-8")
        found = check_files(prefix, source, root / "build") + check_program(prefix, source)
    found += check_dynamic("tubesight", " 0x1 (NEEDED) [libc.so.6]\n 0x1d (RUNPATH) Library runpath: [/x]\n")
    expected = ["share/bash-completion/completions/tubesight: not installed",
                "share/doc/tubesight/docs/pictures/b.png: not installed",
                "share/more: installed without need",
                "share/doc/tubesight/README.md: names a folder of this machine",
                "tubesight --version: 3", "replay: 3", "bin/tubesight: 0x1d (RUNPATH)"]
    good = len(found) == len(expected) and all(
        problem.startswith(begin) for problem, begin in zip(found, expected))
    return report("install --self-test", [] if good else [f"expected {expected}, reported {found}"],
                  f"{len(expected)} planted mistakes")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    sys.exit(report("install", check(*sys.argv[1:5]), "one installation"))
