#!/usr/bin/env python3
"""Writes a folder as an initramfs: the cpio that Linux unpacks, all of it root's, with its first console.

Usage: write_cpio.py FOLDER > OUT.cpio. The same folder gives the same bytes.
"""
import os
import pathlib
import stat
import sys


def entry(out, number, name, mode, content=b"", device=(0, 0)):
    fields = (number, mode, 0, 0, 1, 0, len(content), 0, 0, *device, len(name) + 1, 0)
    header = b"070701" + b"".join(b"%08x" % field for field in fields) + name.encode() + b"\0"
    out.write(header + bytes(-len(header) % 4) + content + bytes(-len(content) % 4))


def main(folder):
    out = sys.stdout.buffer
    paths = sorted(pathlib.Path(folder).rglob("*"))
    for number, path in enumerate(paths, 1):
        name = path.relative_to(folder).as_posix()
        if path.is_symlink():
            entry(out, number, name, stat.S_IFLNK | 0o777, os.readlink(path).encode())
        elif path.is_dir():
            entry(out, number, name, stat.S_IFDIR | 0o755)
        else:
            runs = path.stat().st_mode & 0o100
            entry(out, number, name, stat.S_IFREG | (0o755 if runs else 0o644), path.read_bytes())
    entry(out, len(paths) + 1, "dev/console", stat.S_IFCHR | 0o600, device=(5, 1))
    entry(out, 0, "TRAILER!!!", 0)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
