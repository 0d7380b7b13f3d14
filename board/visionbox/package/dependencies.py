#!/usr/bin/env python3
"""Writes what programs need of Debian's packages, as a package's control file says it.

Usage: dependencies.py --readelf READELF [--sysroot SYSROOT] PROGRAM...

dpkg-shlibdeps does this for packages that are installed; those of a sysroot are not. A library that no
package of the sysroot has is an error. The C and C++ libraries are asked for in the version that the
sysroot has or newer: by the symbols, an older one might do.
"""
import argparse
import re
import subprocess
import sys

import debian_packages


def needed(readelf, program):
    """Names and versions of the shared libraries that a program is linked with."""
    text = subprocess.run([readelf, "-d", program], check=True, capture_output=True, text=True).stdout
    for name in re.findall(r"\(NEEDED\).*\[(.+)\]", text):
        match = re.fullmatch(r"(.+)\.so\.(.+)", name) or re.fullmatch(r"(.+)-(.+)\.so", name)
        if match is None:
            sys.exit(f"{program} needs {name}, whose name has no version")
        yield match.groups()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--readelf", default="readelf")
    parser.add_argument("--sysroot", default="")
    parser.add_argument("programs", nargs="+")
    arguments = parser.parse_args()

    known = debian_packages.shlibs(arguments.sysroot)
    versions = {name: version for name, version, _ in debian_packages.packages(arguments.sysroot)}
    found = set()
    for program in arguments.programs:
        for library in needed(arguments.readelf, program):
            if library not in known:
                sys.exit(f"{program} needs {library[0]}.so.{library[1]}, which no known package has")
            dependency = known[library]
            if dependency in ("libstdc++6", "libgcc-s1"):
                # 12.2.0-14+deb12u1 -> 12.2.0: the compiler's own version.
                dependency += f" (>= {versions[dependency].split('-')[0]})"
            found.add(dependency)
    print(", ".join(sorted(found)))


if __name__ == "__main__":
    main()
