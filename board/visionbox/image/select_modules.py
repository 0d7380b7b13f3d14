#!/usr/bin/env python3
"""Prints which kernel modules a list of patterns keeps, and which others these need.

Usage: select_modules.py PATTERNS.txt MODULES_FOLDER
A pattern is of paths below kernel/; one that begins with "-" leaves out what earlier ones keep, unless
something kept needs it.
"""
import fnmatch
import pathlib
import sys


def main(patterns_file, folder):
    needs = {}
    for line in (pathlib.Path(folder) / "modules.dep").read_text().splitlines():
        module, _, needed = line.partition(":")
        needs[module] = needed.split()
    kept = set()
    for line in pathlib.Path(patterns_file).read_text().splitlines():
        pattern = line.split("#")[0].strip()
        if not pattern:
            continue
        hits = fnmatch.filter(needs, f"kernel/{pattern.lstrip('-')}")
        if not hits:
            sys.exit(f"{patterns_file}: the kernel has no module '{pattern}'")
        kept = kept - set(hits) if pattern.startswith("-") else kept | set(hits)
    print("\n".join(sorted(kept | {other for module in kept for other in needs[module]})))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
