#!/usr/bin/env python3
"""A package is installed, upgraded, removed and purged, and the user's settings outlive what they should.

Usage: package_life.py PACKAGE.deb | package_life.py --self-test

dpkg itself does it, in a throw-away folder that it takes for the system, with the package's own scripts
and those of Debian that they call. Who is not root is root in a namespace of his own, which dpkg wants. No
service manager runs there: that the service starts, and starts anew at an upgrade, is seen on a board
(tests/system/board/).
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from source_text import report

SETTINGS = "etc/tubesight/box.toml"
KEPT = "var/lib/tubesight/box-000001.y4m"
ENABLED = "etc/systemd/system/multi-user.target.wants/tubesightd.service"
MASKED = "etc/systemd/system/tubesightd.service"
UNIT = "usr/lib/systemd/system/tubesightd.service"
AS_ROOT = [] if os.geteuid() == 0 else ["unshare", "--map-root-user"]
# What a purge may leave: the records of dpkg, and the user, who keeps his number.
LEFT = ("var/lib/dpkg/", "var/log/", "etc/passwd", "etc/shadow", "etc/group", "etc/gshadow", "etc/.pwd.lock")


class System:
    """A folder that dpkg takes for the system."""

    def __init__(self, root):
        self.root = root
        for folder in ("usr/bin", "usr/lib", "etc", "var/log", "var/lib/dpkg/info", "var/lib/dpkg/updates"):
            (root / folder).mkdir(parents=True)
        for link in ("bin", "lib"):
            (root / link).symlink_to(f"usr/{link}")
        for file in ("status", "available"):
            (root / "var/lib/dpkg" / file).write_text("")

    def dpkg(self, *arguments):
        """What went wrong, in its own words; nothing when all is well."""
        done = subprocess.run(
            [*AS_ROOT, "dpkg", f"--root={self.root}", "--force-script-chrootless", "--force-depends",
             "--force-architecture", "--force-unsafe-io", *arguments],
            capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL,
            env={**os.environ, "LC_ALL": "C", "PATH": "/usr/sbin:/usr/bin:/sbin:/bin"})
        return [] if done.returncode == 0 else [f"dpkg {arguments[0]}: {done.stdout}{done.stderr}"]

    def files(self):
        return {path.relative_to(self.root).as_posix() for path in self.root.rglob("*")
                if not path.is_dir() or path.is_symlink()}

    def read(self, name):
        path = self.root / name
        return path.read_text("utf-8") if path.exists() else None

    def write(self, name, text):
        (self.root / name).parent.mkdir(parents=True, exist_ok=True)
        (self.root / name).write_text(text, "utf-8")

    def has(self, name):
        return os.path.lexists(self.root / name)


def version(package, folder, number, settings=None):
    """The package again as another version, and with other settings of a first start if wanted."""
    tree = folder / f"tree-{number}"
    subprocess.run(["dpkg-deb", "-R", package, tree], check=True)
    control = tree / "DEBIAN/control"
    lines = control.read_text("utf-8").splitlines()
    lines = [f"Version: {number}" if line.startswith("Version:") else line for line in lines]
    control.write_text("\n".join(lines) + "\n", "utf-8")
    if settings is not None:
        (tree / SETTINGS).write_text(settings, "utf-8")
    made = folder / f"tubesight-{number}.deb"
    subprocess.run(["dpkg-deb", "--root-owner-group", "-Znone", "-b", tree, made], check=True,
                   stdout=subprocess.DEVNULL)
    shutil.rmtree(tree)
    return made


def without_password(shadow):
    """Whether nobody can log in as the box's user."""
    line = next((line for line in (shadow or "").splitlines() if line.startswith("tubesight:")), "")
    return line.startswith(("tubesight:!", "tubesight:*"))


def wrong(what, *truths):
    return [] if all(truths) else [what]


def live(packages, system):
    """Through all of it; packages: two with the same settings of a first start, one with others."""
    first, second, other = packages
    before = system.files()
    problems = system.dpkg("-i", first)
    shipped = system.read(SETTINGS)
    problems += wrong("installed: not enabled", system.has(ENABLED))
    problems += wrong("installed: no user", "tubesight:" in (system.read("etc/passwd") or ""))
    problems += wrong("installed: the user has a password", without_password(system.read("etc/shadow")))
    problems += wrong("installed: the user has a shell",
                      "/tubesight:/usr/sbin/nologin" in (system.read("etc/passwd") or ""))

    problems += system.dpkg("-i", other)
    problems += wrong("upgraded: settings that nobody changed are the old ones",
                      system.read(SETTINGS) not in (shipped, None))
    problems += system.dpkg("-i", first)

    system.write(SETTINGS, "# the user's\n")
    system.write(KEPT, "a recording\n")
    if system.has(ENABLED):
        (system.root / ENABLED).unlink()
    problems += system.dpkg("-i", second)
    problems += wrong("upgraded: the user's settings are lost", system.read(SETTINGS) == "# the user's\n")
    problems += wrong("upgraded: enabled again", not system.has(ENABLED))
    problems += system.dpkg("--force-confold", "-i", other)
    problems += wrong("upgraded with --force-confold: the user's settings are lost",
                      system.read(SETTINGS) == "# the user's\n")
    problems += wrong("upgraded with --force-confold: the new ones are not beside them",
                      system.has(SETTINGS + ".dpkg-dist"))
    problems += wrong("upgraded: a recording is lost", system.has(KEPT))

    problems += system.dpkg("-r", "tubesight")
    problems += wrong("removed: programs or unit are there", not system.has("usr/bin/tubesightd"),
                      not system.has(UNIT))
    problems += wrong("removed: settings or recordings are gone",
                      system.read(SETTINGS) == "# the user's\n", system.has(KEPT))
    problems += wrong("removed: the unit can be started", system.has(MASKED))
    problems += system.dpkg("-i", other)
    problems += wrong("installed again: the user's settings are lost",
                      system.read(SETTINGS) == "# the user's\n")
    problems += wrong("installed again: masked", not system.has(MASKED))
    problems += system.dpkg("-P", "tubesight")
    left = sorted(name for name in system.files() - before if not name.startswith(LEFT))
    return problems + [f"purged: {name} is left" for name in left] + wrong(
        "purged: folders are left", not system.has("etc/tubesight"), not system.has("var/lib/tubesight"))


def check(package):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        packages = [version(package, folder, "1-1"), version(package, folder, "1-2"),
                    version(package, folder, "1-3", "# of another version\n")]
        return live(packages, System(folder / "root"))


def self_test():
    """A package that does all of it wrong."""
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder, "tree")
        scripts = {"control": "Package: tubesight\nVersion: 1\nArchitecture: all\nDescription: x\n"
                              "Maintainer: x <x@x.example>\n",
                   "postinst": "#!/bin/sh\nmkdir -p $DPKG_ROOT/etc/systemd/system/multi-user.target.wants\n"
                               f"touch $DPKG_ROOT/{ENABLED}\n"
                               "echo tubesight::1:1::/:/bin/sh > $DPKG_ROOT/etc/passwd\n",
                   "prerm": "#!/bin/sh\nrm -rf $DPKG_ROOT/var/lib/tubesight\n"}
        for name, text in scripts.items():
            path = tree / "DEBIAN" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
            path.chmod(0o755)
        for name in (SETTINGS, UNIT, "usr/bin/tubesightd"):
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            (tree / name).write_text("x\n", "utf-8")
        package = pathlib.Path(folder, "wrong.deb")
        subprocess.run(["dpkg-deb", "--root-owner-group", "-b", tree, package], check=True,
                       stdout=subprocess.DEVNULL)
        found = check(package)
    wanted = ["installed: the user has a password", "installed: the user has a shell",
              "upgraded: the user's settings are lost", "upgraded: enabled again",
              "upgraded with --force-confold: the user's settings are lost",
              "upgraded with --force-confold: the new ones are not beside them",
              "upgraded: a recording is lost", "removed: settings or recordings are gone",
              "removed: the unit can be started", "installed again: the user's settings are lost",
              f"purged: {ENABLED} is left"]
    return report("package_life --self-test",
                  [] if found == wanted else [f"expected {wanted}, reported {found}"],
                  f"{len(wanted)} planted mistakes")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    sys.exit(report("package_life", check(sys.argv[1]), "one package"))
