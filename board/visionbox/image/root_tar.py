#!/usr/bin/env python3
"""Unpacks Debian packages and a folder of our own into one tar, the root of the vision box.

Usage: root_tar.py OUT.tar EPOCH FILES_FOLDER MODULES_FOLDER LEFT_OUT.txt PACKAGE.deb...

No package is configured and nothing of the board's architecture is run: what maintainer scripts would
have done and a box needs is done here (folders merged into /usr, users and groups, masked units). Owners
come from the packages, so no root is needed. The same input gives the same bytes.
"""
import io
import pathlib
import re
import subprocess
import sys
import tarfile

MERGED = ("bin", "sbin", "lib")
# Documentation and words in other languages, which nobody reads on a box; licences stay.
LEFT_OUT = re.compile(
    r"^usr/share/(man|info|locale|lintian|bug|gtk-doc|bash-completion|zsh|perl5?|doc-base)/"
    r"|^usr/share/doc/(?!tubesight/)[^/]+/(?!copyright)"
    r"|^usr/lib/udev/hwdb\.d/|^usr/lib/[^/]+/(perl|gconv)/|^boot/|^etc/(init\.d|rc[0-9S]\.d|cron[^/]*)/")


def merged_name(name):
    """The path below / without a leading "./", with bin, sbin and lib inside usr."""
    name = re.sub(r"^\./?", "", name).rstrip("/")
    if name.split("/")[0] in MERGED:
        name = "usr/" + name
    return name


class Root:
    """All members by path; a later one replaces an earlier one, but no link replaces a folder."""

    def __init__(self):
        self.members = {}

    def add(self, info, content):
        info.name = merged_name(info.name)
        if not info.name or LEFT_OUT.search(info.name + ("/" if info.isdir() else "")):
            return
        if info.islnk():
            info.linkname = merged_name(info.linkname)
        there = self.members.get(info.name)
        if there and there[0].isdir() and not info.isfile():
            return
        self.members[info.name] = (info, content)

    def add_text(self, name, text, mode=0o644, gid=0):
        info = tarfile.TarInfo(name)
        info.mode, info.size, info.gid = mode, len(text.encode()), gid
        self.add(info, text.encode())

    def add_link(self, name, target):
        info = tarfile.TarInfo(name)
        info.type, info.linkname, info.mode = tarfile.SYMTYPE, target, 0o777
        self.members[info.name] = (info, None)

    def add_folder(self, name, mode=0o755):
        info = tarfile.TarInfo(name)
        info.type, info.mode = tarfile.DIRTYPE, mode
        if name not in self.members:
            self.members[name] = (info, None)

    def text(self, name):
        return self.members[name][1].decode()

    def add_tar(self, stream):
        with tarfile.open(fileobj=stream, mode="r|") as archive:
            for info in archive:
                content = archive.extractfile(info).read() if info.isreg() else None
                self.add(info, content)

    def write(self, path, epoch):
        for name in list(self.members):
            for parent in pathlib.PurePosixPath(name).parents:
                if str(parent) != ".":
                    self.add_folder(str(parent))
        # Hard links after what they link to.
        order = sorted(self.members, key=lambda name: (self.members[name][0].islnk(), name))
        with tarfile.open(path, "w", format=tarfile.GNU_FORMAT) as archive:
            for name in order:
                info, content = self.members[name]
                info.mtime = min(int(info.mtime) or epoch, epoch)
                info.uname = info.gname = ""
                archive.addfile(info, io.BytesIO(content) if content is not None else None)


def package_fields(deb):
    said = subprocess.run(["dpkg-deb", "-f", deb], capture_output=True, text=True, check=True)
    return said.stdout


def add_packages(root, debs, left_out):
    """Unpacks them, in the order of their names, and writes down which they are."""
    status, names, needs = [], set(), []
    for deb in sorted(debs, key=lambda path: pathlib.Path(path).name):
        fields = package_fields(deb)
        name = re.search(r"^Package: (.*)$", fields, re.M).group(1)
        if name in left_out:
            continue
        names.add(name)
        if name == "tubesight":
            needs = re.findall(r"^Depends: (.*)$", fields, re.M)
        with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", deb], stdout=subprocess.PIPE) as unpack:
            root.add_tar(unpack.stdout)
        if unpack.returncode != 0:
            raise SystemExit(f"root_tar.py: {deb}: cannot be unpacked")
        status.append(fields.replace("\n", "\nStatus: install ok installed\n", 1))
    for need in ", ".join(needs).split(", ") if needs else ():
        if not names & {choice.split("(")[0].strip() for choice in need.split("|")}:
            raise SystemExit(f"root_packages.txt: tubesight needs {need}, which the root does not have")
    root.add_text("var/lib/dpkg/status", "\n".join(status))


def read_sysusers(root):
    """The lines of the packages' sysusers.d, in the order of systemd-sysusers."""
    lines = []
    for name in sorted(n for n in root.members if re.match(r"usr/lib/sysusers\.d/.*\.conf$", n)):
        for line in root.text(name).splitlines():
            if line.strip() and not line.startswith("#"):
                lines.append(re.findall(r'"[^"]*"|\S+', line))
    return lines


def add_users(root):
    """base-passwd's users and groups, those of sysusers.d, and nobody with a password."""
    users = root.text("usr/share/base-passwd/passwd.master").splitlines()
    groups = root.text("usr/share/base-passwd/group.master").splitlines()
    # Owners of files on the data partition: their numbers must stay from one version to the next.
    fixed = {"tubesight": 900, "sshd": 901}
    known_users = {line.split(":")[0] for line in users}
    known_groups = {line.split(":")[0]: line.split(":")[2] for line in groups}
    free = iter(range(950, 999))

    def add_group(name, number):
        if name not in known_groups:
            known_groups[name] = number
            groups.append(f"{name}:x:{number}:")

    # Of a package whose maintainer script makes its user.
    lines = read_sysusers(root) + [["u", "sshd", "-", '"sshd"', "/run/sshd"]]
    for kind, name, *rest in lines:
        if kind not in ("u", "g") or (kind == "u" and name in known_users):
            continue
        number = known_groups.get(name) or fixed.get(name)
        if number is None and rest and rest[0].isdigit():
            number = rest[0]
        number = number if number is not None else next(free)
        add_group(name, number)
        if kind == "u":
            about = rest[1].strip('"') if len(rest) > 1 and rest[1] != "-" else ""
            home = rest[2] if len(rest) > 2 and rest[2] != "-" else "/"
            users.append(f"{name}:*:{number}:{known_groups[name]}:{about}:{home}:/usr/sbin/nologin")
    shadow = [f"{line.split(':')[0]}:*:1:0:99999:7:::" for line in users]
    shadow_group = int(known_groups.get("shadow", 0))
    # A locked root without a password: bash where a key lets someone in.
    users = [re.sub(r"^([^:]*):[^:]*:", r"\1:x:", line) for line in users]
    root.add_text("etc/passwd", "\n".join(users) + "\n")
    root.add_text("etc/group", "\n".join(groups) + "\n")
    root.add_text("etc/shadow", "\n".join(shadow) + "\n", 0o640, shadow_group)


def add_tree(root, folder, below=""):
    for path in sorted(pathlib.Path(folder).rglob("*")):
        name = f"{below}{path.relative_to(folder).as_posix()}"
        if path.is_symlink():
            root.add_link(name, str(path.readlink()))
        elif path.is_file():
            info = tarfile.TarInfo(name)
            info.mode = 0o755 if path.stat().st_mode & 0o100 else 0o644
            content = path.read_bytes()
            info.size = len(content)
            root.add(info, content)


def add_system(root):
    for name in MERGED:
        root.add_link(name, f"usr/{name}")
    for name in ("dev", "proc", "sys", "run", "data", "boot", "mnt", "etc/tubesight",
                 "var/lib/tubesight", "var/log/journal"):
        root.add_folder(name)
    root.add_folder("tmp", 0o1777)
    root.add_folder("root", 0o700)
    # Empty, not missing: else systemd takes each boot for the first one and enables all it knows.
    root.add_text("etc/machine-id", "")
    root.add_text("etc/fstab", "# The initramfs has mounted everything.\n")
    root.add_text("etc/hostname", "tubesight\n")
    root.add_text("etc/hosts", "127.0.0.1 localhost\n::1 localhost\n")
    root.add_link("var/run", "/run")
    root.add_link("var/lock", "/run/lock")
    root.add_link("etc/localtime", "/usr/share/zoneinfo/Etc/UTC")
    root.add_link("etc/systemd/system/default.target", "/lib/systemd/system/multi-user.target")
    for unit in root.text("etc/tubesight-units").splitlines():
        action, _, name = unit.partition(" ")
        if action == "mask":
            root.add_link(f"etc/systemd/system/{name}", "/dev/null")
        elif action == "enable":
            where = "usr/lib" if f"usr/lib/systemd/system/{name}" in root.members else "etc"
            root.add_link(f"etc/systemd/system/multi-user.target.wants/{name}",
                          f"/{where}/systemd/system/{name}")
    if "usr/bin/bash" in root.members:
        root.add_link("usr/bin/sh", "dash")


def main(out, epoch, files, modules, left_out, *debs):
    root = Root()
    names = {line[1:].split("#")[0].strip() for line in pathlib.Path(left_out).read_text().splitlines()
             if line.startswith("-")}
    add_packages(root, debs, names)
    add_tree(root, files)
    add_tree(root, modules, "usr/lib/modules/")
    add_users(root)
    add_system(root)
    root.write(out, int(epoch))


if __name__ == "__main__":
    if len(sys.argv) < 7:
        sys.exit(__doc__)
    main(*sys.argv[1:])
