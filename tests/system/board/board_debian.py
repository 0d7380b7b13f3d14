"""A Debian with systemd for the emulated board: of Debian's packages, as they are, in a read-only root.

Nothing is configured that the tests do not need: what dpkg, systemd and a package's scripts stand on is
there, and dpkg believes that no package is. What is written goes into memory.
"""
import inspect
import pathlib
import shutil
import subprocess

from board_machine import Board
from board_pwm import MEMORY_MB, device_tree
from board_parts import FOLDER, ROOT, BoardError, initramfs, run

PACKAGES = ("base-files", "base-passwd", "bash", "coreutils", "dash", "diffutils", "dpkg", "findutils",
            "grep", "init-system-helpers", "libc-bin", "libcrypt1", "libgnutls30",
            "libgpiod2", "libjpeg62-turbo", "libmicrohttpd12", "libmodbus5", "libpng16-16",
            "libsqlite3-0", "libssl3", "libyaml-0-2", "mount", "perl-base", "sed", "systemd", "systemd-sysv",
            "udev", "util-linux")
# Not what the tests are about, and slow under emulation.
MASKED = ("systemd-udev-trigger.service", "systemd-udev-settle.service", "systemd-logind.service",
          "systemd-timesyncd.service", "systemd-networkd.service", "dev-hugepages.mount",
          "sys-kernel-debug.mount", "sys-kernel-tracing.mount", "systemd-machine-id-commit.service",
          "systemd-journal-flush.service", "serial-getty@ttyAMA0.service", "getty.target",
          "apt-daily.timer", "dpkg-db-backup.timer", "fstrim.timer", "systemd-tmpfiles-clean.timer")
# As board_init.sh does: a line each, a word that is said again with the exit status, and a command.
SHELL = """\
#!/bin/sh
export PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C
stty -echo -onlcr
echo "board: ready $(cut -d ' ' -f 1 /proc/uptime)"
while read -r word line; do
  sh -c "$line" < /dev/null 2>&1
  echo "@$word $?"
done
"""
UNIT = """\
[Unit]
Description=Takes the tests' commands
After=multi-user.target
[Service]
ExecStart=/usr/sbin/board-shell
StandardInput=tty-force
StandardOutput=tty
StandardError=tty
TTYPath=/dev/ttyAMA0
TTYReset=no
"""
INIT = """\
#!/bin/sh
/bin/busybox --install -s /bin
mount -t proc proc /proc
mount -t sysfs sysfs /sys
mount -t devtmpfs dev /dev
while read -r module; do insmod $module; done < /modules/order
mkdir /lower /written /whole
mount -t squashfs -o ro /dev/vda /lower || poweroff -f
mount -t tmpfs written /written
mkdir /written/upper /written/work
mount -t overlay -o lowerdir=/lower,upperdir=/written/upper,workdir=/written/work root /whole || poweroff -f
mount -t 9p -o trans=virtio,version=9p2000.L,msize=262144 share /whole/share
mount --move /proc /whole/proc
mount --move /sys /whole/sys
mount --move /dev /whole/dev
exec switch_root /whole /lib/systemd/systemd
"""


def _unpack(debs, tree):
    for name in ("usr/bin", "usr/sbin", "usr/lib", "var/lib/dpkg/info", "var/lib/dpkg/updates", "share"):
        (tree / name).mkdir(parents=True)
    for link in ("bin", "sbin", "lib"):
        (tree / link).symlink_to(f"usr/{link}")
    for deb in debs:
        with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", deb], stdout=subprocess.PIPE) as whole:
            subprocess.run(["tar", "-x", "-C", tree, "--keep-directory-symlink", "--no-same-owner",
                            "--exclude=./usr/share/doc", "--exclude=./usr/share/locale",
                            "--exclude=./usr/share/man", "--exclude=./usr/lib/udev/hwdb.d"],
                           stdin=whole.stdout, check=True, timeout=300)


def _configure(tree):
    """What the packages' scripts would have done."""
    for name in ("passwd", "group"):
        shutil.copy(tree / f"usr/share/base-passwd/{name}.master", tree / f"etc/{name}")
    (tree / "etc/machine-id").write_text("")
    (tree / "etc/fstab").write_text("")
    for name in ("status", "available"):
        (tree / "var/lib/dpkg" / name).write_text("")
    (tree / "usr/bin/sh").unlink(missing_ok=True)
    (tree / "usr/bin/sh").symlink_to("dash")
    units = tree / "etc/systemd/system"
    wanted = units / "multi-user.target.wants"
    wanted.mkdir(parents=True, exist_ok=True)
    for unit in MASKED:
        (units / unit).unlink(missing_ok=True)
        (units / unit).symlink_to("/dev/null")
    (units / "default.target").symlink_to("/lib/systemd/system/multi-user.target")
    (units / "board-shell.service").write_text(UNIT)
    (wanted / "board-shell.service").symlink_to("../board-shell.service")
    shell = tree / "usr/sbin/board-shell"
    shell.write_text(SHELL)
    shell.chmod(0o755)


def root():
    """The root's file, made once of what is fetched once."""
    made, recipe = FOLDER / "debian.squashfs", FOLDER / "debian.recipe"
    text = "\n".join([*PACKAGES, *MASKED, SHELL, UNIT, *map(inspect.getsource, (_unpack, _configure))])
    if made.exists() and recipe.exists() and recipe.read_text("utf-8") == text:
        return made
    debs, tree = FOLDER / "debian.debs", FOLDER / "debian.tree"
    for folder in (debs, tree):
        shutil.rmtree(folder, ignore_errors=True)
    FOLDER.mkdir(parents=True, exist_ok=True)
    done = subprocess.run([ROOT / "toolchain/debian_download.sh", "--with-dependencies", "arm64", debs,
                           *PACKAGES], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=900)
    if done.returncode != 0:
        raise BoardError(f"the board's Debian cannot be fetched (network?):\n{done.stderr.strip()}")
    _unpack(sorted(debs.glob("*.deb")), tree)
    _configure(tree)
    made.unlink(missing_ok=True)
    run("mksquashfs", tree, made, "-all-root", "-comp", "lz4", "-no-progress", "-quiet", "-noappend")
    for folder in (debs, tree):
        shutil.rmtree(folder)
    recipe.write_text(text, "utf-8")
    return made


def debian_board(folder, share):
    """A board with a PWM that boots this Debian; Board.run and Board.do give commands once boot() is through."""
    init = folder / "init"
    init.write_text(INIT)
    start = initramfs(folder / "debian.initramfs", ("virtio_blk", "squashfs", "overlay", "pwm-bcm2835"), init=init)
    return Board(initramfs=start, dtb=device_tree(folder), disks=[root()], share=share, memory_mb=MEMORY_MB,
                 append="systemd.show_status=0 quiet")
