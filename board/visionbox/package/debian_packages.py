"""What Debian says of the packages that a build stands on: of a sysroot, or of this machine."""
import pathlib
import subprocess

# Of this machine's, when there is no sysroot: what is compiled in or linked with, and what that stands on
# (GnuTLS on eight libraries), as a sysroot has it.
PACKAGES = ["libaravis-dev", "libc6", "libcli11-dev", "libcrypt1", "libeigen3-dev", "libffi8", "libgcc-s1",
            "libgmp10", "libgnutls30", "libgpiod2", "libhogweed6", "libidn2-0", "libjpeg62-turbo", "liblzma5",
            "libmicrohttpd12", "libmodbus5", "libnettle8", "libp11-kit0", "libpng16-16", "libsqlite3-0",
            "libssl3", "libstdc++6", "libtasn1-6", "libtomlplusplus-dev", "libunistring2", "libyaml-0-2",
            "nlohmann-json3-dev", "zlib1g"]


def packages(sysroot):
    """(name, version, source package) of each, by name."""
    if sysroot:
        text = pathlib.Path(sysroot, "debian/packages.tsv").read_text(encoding="utf-8")
    else:
        text = subprocess.run(
            ["dpkg-query", "-W", "-f", r"${Package}\t${Version}\t${source:Package}\n", *PACKAGES],
            check=True, capture_output=True, text=True).stdout
    return sorted({tuple(line.split("\t")) for line in text.splitlines()})


def shlibs(sysroot):
    """The package of each shared library, with the version needed: {(name, version): dependency}."""
    if sysroot:
        texts = [pathlib.Path(sysroot, "debian/shlibs").read_text(encoding="utf-8")]
    else:
        texts = [path.read_text(encoding="utf-8")
                 for name in PACKAGES for path in pathlib.Path("/var/lib/dpkg/info").glob("*.shlibs")
                 if path.stem.split(":")[0] == name]
    known = {}
    for line in "\n".join(texts).splitlines():
        words = line.split(maxsplit=2)
        if len(words) == 3 and not line.startswith(("udeb:", "#")):
            known[words[0], words[1]] = words[2]
    return known
