#!/usr/bin/env python3
"""What the emulated board is made of: Debian's arm64 kernel, its modules, busybox, and an initramfs of them.

Usage: board_parts.py           fetches what is missing, into build/board

Nothing of the system is changed, and no root is needed. What was fetched stays until the folder is
removed; all else is made anew in a second.
"""
import contextlib
import fcntl
import pathlib
import re
import shutil
import stat
import subprocess
import sys
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[3]
FOLDER = ROOT / "build" / "board"
PACKAGES = ("linux-image-arm64", "busybox-static")
# Needed by every board: the disk and the folder that it shares with the host.
SHARE_MODULES = ("virtio_pci", "9pnet_virtio", "9p")
NEEDED = {"qemu-system-aarch64": "qemu-system-arm", "modprobe": "kmod", "depmod": "kmod",
          "dpkg-deb": "dpkg", "setpriv": "util-linux"}


class BoardError(Exception):
    """The board cannot be had, or did not do what was waited for: one text that says all."""


def tool(name):
    """The path of a program of the host, also of one that is the administrator's."""
    found = shutil.which(name) or shutil.which(name, path="/usr/sbin:/sbin")
    if found is None:
        raise BoardError(f"{name} is missing: scripts/install_packages.sh bench test image, or"
                         f" apt-get install {NEEDED.get(name, name)}")
    return found


def run(*command, **more):
    """What a program of the host prints; a failure tells what it said."""
    done = subprocess.run([tool(command[0]), *map(str, command[1:])], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, **more)
    if done.returncode != 0:
        raise BoardError(f"{' '.join(map(str, command))}: exit status {done.returncode}\n"
                         f"{done.stderr.strip()}")
    return done.stdout


@contextlib.contextmanager
def _alone():
    """Holds what two tests at once must not do."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    with open(FOLDER / "lock", "w", encoding="ascii") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _download(packages, folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    done = subprocess.run([ROOT / "toolchain" / "debian_download.sh", "arm64", folder, *packages],
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        raise BoardError(f"the emulated board needs Debian's packages {' '.join(packages)} for arm64,"
                         f" once, and they cannot be fetched (network?):\n{done.stderr.strip()}")
    return sorted(folder.glob("*.deb"))


def _unpack(deb, folder, *members):
    """Only what is asked for: the modules are 300 MB otherwise."""
    with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", deb], stdout=subprocess.PIPE) as whole:
        subprocess.run(["tar", "-x", "-C", folder, "--wildcards", *members], stdin=whole.stdout,
                       check=True, timeout=300)


def fetch():
    """Kernel, modules and busybox, from Debian; at once where they are there."""
    with _alone():
        if (FOLDER / "complete").exists():
            return
        for name in ("tree", "debs"):
            shutil.rmtree(FOLDER / name, ignore_errors=True)
        # The package that is always the newest kernel names the one that has it.
        meta, busybox = None, None
        for deb in _download(PACKAGES, FOLDER / "debs" / "first"):
            if "busybox" in deb.name:
                busybox = deb
            elif "linux-image" in deb.name:
                meta = deb
        image = re.search(r"linux-image-[^\s,(]+", run("dpkg-deb", "-f", meta, "Depends"))[0]
        found = _download((image,), FOLDER / "debs" / "kernel")
        kernel = next(deb for deb in found if deb.name.startswith(image))
        tree = FOLDER / "tree"
        tree.mkdir(parents=True)
        _unpack(kernel, tree, "./boot/vmlinuz-*", "./lib/modules/*")
        _unpack(busybox, tree, "./bin/busybox")
        # Debian makes the modules' index when the package is installed.
        version = next((tree / "lib" / "modules").iterdir()).name
        run("depmod", "-b", tree, version)
        shutil.rmtree(FOLDER / "debs")
        (FOLDER / "complete").write_text(version + "\n", encoding="ascii")


def version():
    """Of the kernel, as its modules' folder is called."""
    fetch()
    return (FOLDER / "complete").read_text(encoding="ascii").strip()


def kernel():
    return FOLDER / "tree" / "boot" / f"vmlinuz-{version()}"


def modules(names):
    """The files of these modules and of all that they need, in the order of loading."""
    order = []
    for name in names:
        for line in run("modprobe", "-d", FOLDER / "tree", "-S", version(), "--show-depends",
                        name).splitlines():
            word, _, path = line.partition(" ")
            path = pathlib.Path(path.strip().split(" ")[0])
            if word == "insmod" and path not in order:
                order.append(path)
    return order


class Archive:
    """A cpio archive in the form that the kernel unpacks; device nodes need no root."""

    def __init__(self):
        self._bytes = bytearray()
        self._folders = set()
        self._inode = 0

    def _entry(self, name, mode, content=b"", device=(0, 0)):
        self._inode += 1
        label = name.encode() + b"\0"
        fields = (self._inode, mode, 0, 0, 1, 0, len(content), 0, 0, *device, len(label), 0)
        self._bytes += b"070701" + b"".join(b"%08X" % field for field in fields) + label
        self._bytes += b"\0" * (-len(self._bytes) % 4) + content
        self._bytes += b"\0" * (-len(self._bytes) % 4)

    def folder(self, name):
        name = name.strip("/")
        if name and name not in self._folders:
            self.folder(name.rpartition("/")[0])
            self._folders.add(name)
            self._entry(name, stat.S_IFDIR | 0o755)

    def file(self, name, content, mode=0o644):
        name = name.strip("/")
        self.folder(name.rpartition("/")[0])
        self._entry(name, stat.S_IFREG | mode, content)

    def link(self, name, target):
        self.folder(name.strip("/").rpartition("/")[0])
        self._entry(name.strip("/"), stat.S_IFLNK | 0o777, target.encode())

    def character_device(self, name, major, minor):
        self.folder(name.strip("/").rpartition("/")[0])
        self._entry(name.strip("/"), stat.S_IFCHR | 0o600, device=(major, minor))

    def write(self, path):
        self._entry("TRAILER!!!", 0)
        squeeze = zlib.compressobj(1, zlib.DEFLATED, 31)  # gzip, fast
        path.write_bytes(squeeze.compress(bytes(self._bytes)) + squeeze.flush())
        return path


def initramfs(path, names=(), files=None, init=None):
    """An initramfs at `path`: busybox, the modules `names`, and `files`, {path on the board: path here}.

    The script board_init.sh, or `init`, is its first program; `names` may carry parameters,
    "vivid n_devs=1".
    """
    fetch()
    archive = Archive()
    for folder in ("dev", "proc", "sys", "tmp", "run", "share", "root", "mnt", "etc"):
        archive.folder(folder)
    archive.character_device("dev/console", 5, 1)
    archive.file("bin/busybox", (FOLDER / "tree" / "bin" / "busybox").read_bytes(), 0o755)
    archive.link("bin/sh", "busybox")
    script = init or pathlib.Path(__file__).with_name("board_init.sh")
    archive.file("init", script.read_bytes(), 0o755)
    told = {name.split()[0]: name.split()[1:] for name in (*SHARE_MODULES, *names)}
    parameters = {name.replace("-", "_"): words for name, words in told.items()}
    lines = []
    for module in modules(told):
        archive.file(f"modules/{module.name}", module.read_bytes())
        lines.append(" ".join([f"/modules/{module.name}",
                               *parameters.get(module.stem.replace("-", "_"), ())]))
    archive.file("modules/order", ("\n".join(lines) + "\n").encode())
    for name, source in sorted((files or {}).items()):
        source = pathlib.Path(source)
        archive.file(name, source.read_bytes(), 0o755 if source.stat().st_mode & 0o100 else 0o644)
    return archive.write(path)


def libraries(programs, roots):
    """The shared libraries of arm64 programs, {path on the board: path here}, found below `roots`."""
    found, open_ = {}, [pathlib.Path(program) for program in programs]
    while open_:
        for name in re.findall(r"(?:NEEDED.*\[|interpreter: )(?:/lib/)?([^\]\s]+)\]",
                               run("readelf", "-W", "-l", "-d", open_.pop())):
            where = f"lib/{name}"
            if where in found:
                continue
            places = [pathlib.Path(root) / name for root in roots]
            source = next((place for place in places if place.exists()), None)
            if source is None:
                raise BoardError(f"{name}, a library for the board, is in none of"
                                 f" {' '.join(map(str, roots))}")
            found[where] = source.resolve()
            open_.append(source.resolve())
    return found


if __name__ == "__main__":
    if len(sys.argv) > 1:
        sys.exit(__doc__)
    try:
        print(f"the emulated board's kernel: {kernel()}")
    except BoardError as error:
        sys.exit(f"{sys.argv[0]}: {error}")
