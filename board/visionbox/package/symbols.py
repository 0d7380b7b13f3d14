#!/usr/bin/env python3
"""Takes the symbols out of the package's programs and packs them, apart, into tubesight-dbgsym.

Usage: symbols.py --version V --architecture A --objcopy OBJCOPY --readelf READELF --root ROOT --out FOLDER
                  [--compression xz]

In the manner of Debian's own: a debugger finds them by the programs' build IDs once the package is
installed. cpack's would name folders of the machine that packs. SOURCE_DATE_EPOCH is the time they bear.
"""
import argparse
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

CONTROL = """\
Package: tubesight-dbgsym
Source: tubesight
Version: {version}
Auto-Built-Package: debug-symbols
Architecture: {architecture}
Maintainer: Tubesight engineers <box@tubesight.example>
Installed-Size: {size}
Depends: tubesight (= {version})
Section: debug
Priority: optional
Description: debug symbols for tubesight
Build-Ids: {identities}
"""


def split(program, tools, folder):
    """Moves the symbols of a program below `folder`; its build ID."""
    said = subprocess.run([tools.readelf, "-n", program], check=True, capture_output=True, text=True).stdout
    identity = re.search(r"Build ID: ([0-9a-f]+)", said)
    if identity is None:
        sys.exit(f"symbols.py: {program} has no build ID")
    symbols = folder / identity[1][:2] / f"{identity[1][2:]}.debug"
    symbols.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([tools.objcopy, "--only-keep-debug", "--compress-debug-sections", program, symbols],
                   check=True)
    symbols.chmod(0o644)
    subprocess.run([tools.objcopy, "--strip-unneeded", "--remove-section=.comment",
                    "--remove-section=.note", program], check=True)
    return identity[1]


def main():
    parser = argparse.ArgumentParser()
    for name in ("version", "architecture", "objcopy", "readelf", "root", "out"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--compression", default="xz")
    tools = parser.parse_args()
    with tempfile.TemporaryDirectory() as tree:
        tree = pathlib.Path(tree)
        folder = tree / "usr/lib/debug/.build-id"
        identities = [split(program, tools, folder)
                      for program in sorted(pathlib.Path(tools.root, "usr/bin").iterdir())]
        documents = tree / "usr/share/doc"
        documents.mkdir(parents=True)
        (documents / "tubesight-dbgsym").symlink_to("tubesight")
        files = sorted(path for path in tree.rglob("*") if path.is_file() and not path.is_symlink())
        (tree / "DEBIAN").mkdir()
        (tree / "DEBIAN/md5sums").write_text("".join(
            f"{hashlib.md5(path.read_bytes()).hexdigest()}  {path.relative_to(tree)}\n" for path in files))
        (tree / "DEBIAN/control").write_text(CONTROL.format(
            version=tools.version, architecture=tools.architecture, identities=" ".join(identities),
            size=sum(path.stat().st_size for path in files) // 1024 + 1))
        subprocess.run(["chmod", "-R", "u=rwX,go=rX", tree], check=True)
        name = f"tubesight-dbgsym_{tools.version}_{tools.architecture}.deb"
        # Compressed by several processors the bytes would depend on their number.
        # Compressed within already: more than a little of it again takes minutes for nothing.
        subprocess.run(["dpkg-deb", "--root-owner-group", f"-Z{tools.compression}", "-z1", "-b", tree,
                        pathlib.Path(tools.out, name)], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "DPKG_DEB_THREADS_MAX": "1"})


if __name__ == "__main__":
    main()
