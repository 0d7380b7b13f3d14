#!/usr/bin/env python3
"""The Debian package is whole, and what it says of itself is true.

Usage: package.py CPACK BUILD READELF | package.py --made FOLDER READELF [EMULATOR...]
       package.py --self-test

Packs what is built, or takes what FOLDER has, unpacks it, and looks: the files that are installed and
those that a package has beside, their owners, modes and times; what it depends on; programs without
symbols, and the symbols in the package of their own; the bill of materials against the programs; what
the service may do; and the settings of a first start, which the packaged box must find in order. Then it
goes through its life (package_life.py), and lintian has its say. Programs of --made that are of another
architecture are started with the EMULATOR.
"""
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import package_life
from source_text import report

EPOCH = 1700000000
EXPOSURE = 17
PROGRAMS = ["tubesight", "tubesightctl", "tubesightd"]
WANTED = ["./etc/tubesight/box.toml", "./usr/lib/systemd/system/tubesightd.service",
          "./usr/lib/sysusers.d/tubesight.conf", "./usr/lib/udev/rules.d/60-tubesight.rules",
          "./usr/share/doc/tubesight/README.md", "./usr/share/doc/tubesight/changelog.gz",
          "./usr/share/doc/tubesight/copyright", "./usr/share/doc/tubesight/tubesight.spdx.json",
          "./usr/share/doc/tubesight/docs/examples/steam-generator.toml"] + [
    name for program in PROGRAMS for name in (
        f"./usr/bin/{program}", f"./usr/share/man/man1/{program}.1.gz",
        f"./usr/share/bash-completion/completions/{program}")]
LIBRARIES = ["libc6", "libcrypt1", "libgnutls30", "libgpiod2", "libjpeg62-turbo", "liblzma5",
             "libmicrohttpd12", "libmodbus5", "libpng16-16", "libsqlite3-0",
             "libssl3", "libstdc++6", "libyaml-0-2"]


def run(*command, env=None):
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=env)
    return done.returncode, done.stdout + done.stderr


def check_listing(text, wanted_date):
    """Of what `dpkg-deb --contents` tells: owners, modes, dates, and what is missing."""
    problems, names = [], set()
    for line in text.splitlines():
        mode, owner, _, date, _, name = line.split(maxsplit=5)
        names.add(name)
        wanted = "drwxr-xr-x" if name.endswith("/") else (
            "-rwxr-xr-x" if name.startswith("./usr/bin/") else "-rw-r--r--")
        if mode != wanted and not mode.startswith("l"):
            problems.append(f"{name}: mode {mode}, wanted {wanted}")
        if owner != "root/root":
            problems.append(f"{name}: belongs to {owner}")
        if date != wanted_date:
            problems.append(f"{name}: of {date}, not of {wanted_date} as the bill of materials")
    return problems + [f"{name}: not in the package" for name in WANTED if name not in names]


def check_control(text):
    """Of what `dpkg-deb --field` tells."""
    fields = dict(re.findall(r"^([A-Z][A-Za-z-]*): ?(.*)$", text, re.MULTILINE))
    problems = [f"no field {name}" for name in ("Version", "Maintainer", "Description", "Depends")
                if not fields.get(name)]
    depends = {item.split()[0] for item in fields.get("Depends", "").split(",") if item.strip()}
    problems += [f"does not depend on {name}" for name in LIBRARIES if name not in depends]
    return problems


def check_materials(document, root):
    """Of the bill of materials: the programs' digests, and a version of all that is in them."""
    problems = []
    digests = {file["fileName"]: {c["algorithm"]: c["checksumValue"] for c in file["checksums"]}
               for file in document["files"]}
    for program in PROGRAMS:
        content = pathlib.Path(root, "usr/bin", program).read_bytes()
        told = digests.get(f"./usr/bin/{program}", {}).get("SHA256")
        if told != hashlib.sha256(content).hexdigest():
            problems.append(f"bill of materials: not the digest of {program}")
    named = {package["name"] for package in document["packages"] if package.get("versionInfo")}
    return problems + [f"bill of materials: {name} is missing"
                       for name in [*LIBRARIES, "libeigen3-dev", "tubesight"] if name not in named]


def check_programs(root, readelf):
    problems = []
    for program in PROGRAMS:
        sections = run(readelf, "-SW", pathlib.Path(root, "usr/bin", program))[1]
        if ".debug_info" in sections or ".symtab" in sections:
            problems.append(f"{program}: has its symbols")
        identity = re.search(r"Build ID: ([0-9a-f]+)",
                             run(readelf, "-n", pathlib.Path(root, "usr/bin", program))[1])
        if identity is None:
            problems.append(f"{program}: no build ID")
            continue
        name = f"{identity[1][:2]}/{identity[1][2:]}.debug"
        if not pathlib.Path(root, "symbols/usr/lib/debug/.build-id", name).exists():
            problems.append(f"{program}: its symbols are not in their package")
    return problems


def check_settings(root, emulator):
    """The settings of a first start, with the root put before their folders."""
    settings = pathlib.Path(root, "etc/tubesight/box.toml")
    text = settings.read_text(encoding="utf-8")
    pathlib.Path(root, "var/lib/tubesight").mkdir(parents=True)
    for folder in ("/usr/share", "/var/lib"):
        text = text.replace(f'"{folder}', f'"{root}{folder}')
    settings.write_text(text, encoding="utf-8")
    status, said = run(*emulator, pathlib.Path(root, "usr/bin/tubesightd"), settings, "--check")
    return [] if (status, said) == (0, "") else [f"box.toml as installed: {status} {said}"]


def check_unit(unit):
    """The service manager's own measure: tenths, 0 (nothing allowed) to 100. docs/security.md quotes it."""
    status, said = run("systemd-analyze", "security", "--offline=yes", "--no-pager",
                       f"--threshold={EXPOSURE}", unit)
    problems = [] if status == 0 else [
        f"{unit.name}: more is allowed to it than {EXPOSURE / 10}: {' '.join(said.split()[-8:])}"]
    text = unit.read_text(encoding="utf-8")
    return problems + [f"{unit.name}: no line {line}" for line in (
        "User=tubesight", "CapabilityBoundingSet=", "NoNewPrivileges=yes", "DevicePolicy=closed")
        if f"\n{line}\n" not in text]


def check_lintian(packages, more=()):
    """Debian's own opinion; what it says for the record (--info and below) is not asked for."""
    status, said = run("lintian", "--allow-root", "--tag-display-limit", "0", "--fail-on", "error,warning",
                       *more, *packages)
    problems = [line for line in said.splitlines() if re.match(r"[EW]: ", line)]
    return problems if status == 0 or problems else [f"lintian: {status} {said}"]


def check_made(packages, readelf, emulator=(), epoch=None):
    """Of a package and that of its symbols."""
    if len(packages) != 2:
        return [f"a package and its symbols are wanted, there are {[str(path) for path in packages]}"]
    symbols, package = sorted(packages, key=lambda path: "dbgsym" not in path.name)
    with tempfile.TemporaryDirectory() as folder:
        root, control = pathlib.Path(folder, "root"), pathlib.Path(folder, "control")
        for deb, into in ((package, root), (symbols, root / "symbols")):
            status, said = run("dpkg-deb", "-x", deb, into)
            if status != 0:
                return [f"dpkg-deb -x {deb.name}: {status} {said}"]
        document = json.loads((root / "usr/share/doc/tubesight/tubesight.spdx.json").read_text("utf-8"))
        run("dpkg-deb", "-e", package, control)
        problems = [f"no {name} in the package" for name in ("conffiles", "postinst", "prerm", "postrm")
                    if not (control / name).exists()]
        for script in ("postinst", "prerm", "postrm"):
            status, said = run("sh", "-n", control / script)
            problems += [] if status == 0 else [f"{script}: {said}"]
        created = document["creationInfo"]["created"]
        listing = run("dpkg-deb", "--contents", package, env={**os.environ, "TZ": "UTC"})[1]
        if epoch is not None and created != time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(epoch)):
            problems.append(f"bill of materials: of {created}, not of SOURCE_DATE_EPOCH")
        return (problems + check_listing(listing, created[:10])
                + check_control(run("dpkg-deb", "--field", package)[1])
                + check_materials(document, root) + check_programs(root, readelf)
                + check_unit(root / "usr/lib/systemd/system/tubesightd.service")
                + check_settings(root, emulator) + package_life.check(package))


def check_build(cpack, build, readelf):
    """Of the build for the PC: packed without much ado, as no board will ever have it."""
    with tempfile.TemporaryDirectory() as folder:
        status, said = run(cpack, "--config", f"{build}/CPackConfig.cmake", "-B", folder,
                           "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip",
                           env={**os.environ, "SOURCE_DATE_EPOCH": str(EPOCH), "LC_ALL": "C"})
        packages = sorted(pathlib.Path(folder).glob("*.deb"))
        if status != 0:
            return [f"cpack: {status} {said}"]
        # Boards' presets alone have the options that these ask for.
        return check_made(packages, readelf, epoch=EPOCH) + check_lintian(
            packages, ["--suppress-tags", "hardening-no-pie,hardening-no-fortify-functions"])


def self_test():
    problems = check_listing(
        "drwxr-xr-x root/root         0 2023-11-14 22:13 ./\n"
        "-rwsr-xr-x root/root         5 2023-11-14 22:13 ./usr/bin/tubesight\n"
        "-rw-r--r-- me/root           5 2026-11-14 22:13 ./etc/tubesight/box.toml\n", "2023-11-14")
    wanted = ["tubesight: mode -rwsr", "belongs to me/root", "of 2026-11-14", "copyright: not in"]
    problems += check_control("Version: 1\nMaintainer: x\nDescription: x\nDepends: libc6 (>= 2), x\n")
    wanted += ["does not depend on libmodbus5"]
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "usr/bin").mkdir(parents=True)
        for program in PROGRAMS:
            pathlib.Path(folder, "usr/bin", program).write_bytes(b"x")
        problems += check_materials({"files": [], "packages": [{"name": "libc6"}]}, folder)
        unit = pathlib.Path(folder, "open.service")
        unit.write_text("[Service]\nExecStart=/bin/true\n", encoding="utf-8")
        problems += check_unit(unit)
    wanted += ["not the digest of tubesightd", "libc6 is missing",
               "open.service: more is allowed to it than", "open.service: no line User=tubesight"]
    problems += check_made([], "readelf")
    wanted += ["a package and its symbols are wanted"]
    missed = [text for text in wanted if not any(text in problem for problem in problems)]
    missed += [text for text in problems if "depend on libc6" in text]
    return report("package --self-test",
                  [f"missed or wrong: {text}" for text in missed], f"{len(wanted)} planted mistakes")


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    if len(arguments) > 2 and arguments[0] == "--made":
        packages = sorted(pathlib.Path(arguments[1]).glob("*.deb"))
        problems = check_made(packages, arguments[2], arguments[3:]) + check_lintian(packages)
    elif len(arguments) == 3:
        problems = check_build(*arguments)
    else:
        sys.exit(__doc__)
    return report("package", problems, "a package and its symbols")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
