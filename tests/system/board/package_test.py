#!/usr/bin/env python3
"""The package on a board with systemd: installed, at work, upgraded with the user's settings, removed, purged.

Usage: package_test.py PACKAGE_arm64.deb

The upgrade is to the same package under a later version. What needs no running system is tried in
seconds by tests/checks/package_life.py.
"""
import pathlib
import re
import sys
import tempfile
import time
import unittest

import board_pwm
from board_debian import debian_board
from board_parts import ROOT, BoardError

sys.path.insert(0, str(ROOT / "tests/checks"))
import package_life  # noqa: E402  (found by the line above)

BOOT_S = 400.0  # a quiet machine takes 25
STEP_S = 300.0
SETTINGS = "/etc/tubesight/box.toml"
# What the box's user may do in the service's sandbox, and what not.
TRIED = """\
say() { echo "= $1 $2"; }
try() { if sh -c "$2"; then say "$1" yes; else say "$1" no; fi; }
cd /sys/class/pwm/pwmchip0
echo 0 > export
tries=0
until [ -w pwm0/enable ] || [ $tries -gt 100 ]; do sleep 0.2; tries=$((tries + 1)); done
try pwm 'echo 100000 > pwm0/period && echo 50000 > pwm0/duty_cycle && echo 1 > pwm0/enable'
try gpio ': < /dev/gpiochip0'
try recording ': > /var/lib/tubesight/tried'
try kernel 'echo 1 > /proc/sys/kernel/printk'
try module 'echo 1 > /sys/module/printk/parameters/time'
try disk ': < /dev/vda'
try settings ': > /etc/tubesight/tried'
"""
PID = "systemctl show -P MainPID tubesightd"


class Package(unittest.TestCase):
    """Its tests share a board, and run in the order of their names."""

    package = None

    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory(prefix="package")
        folder = pathlib.Path(cls.work.name)
        cls.share = folder / "share"
        cls.share.mkdir()
        first = package_life.version(cls.package, folder, "1-1")
        later = package_life.version(cls.package, folder, "1-2", "# of a later version\n")
        first.rename(cls.share / "first.deb")
        later.rename(cls.share / "later.deb")
        cls.board = debian_board(folder, cls.share)
        try:
            cls.booted_s = cls.board.boot(BOOT_S)
        except BaseException:
            cls.tearDownClass()
            raise

    @classmethod
    def tearDownClass(cls):
        cls.board.close()
        cls.work.cleanup()

    def setUp(self):
        self._begin = time.monotonic()

    def tearDown(self):
        print(f"{self.id().rpartition('.')[2]}: {time.monotonic() - self._begin:.1f} s", flush=True)

    def do(self, command, seconds=STEP_S):
        return self.board.do(command, seconds).strip()

    def is_active(self):
        """Whether the service is up, with the journal's end when it is not."""
        state = self.board.run("systemctl is-active tubesightd", STEP_S)[1].strip()
        if state != "active":
            state += "\n" + self.board.run("journalctl -b -n 20 --no-pager", STEP_S)[1]
        return state

    def answers(self):
        """What the box says, once it listens."""
        due = time.monotonic() + STEP_S
        while time.monotonic() < due:
            status, text = self.board.run("tubesightctl status", STEP_S)
            if status == 0:
                return text
            time.sleep(1)
        self.fail(text)

    def test_1_is_at_work_once_it_is_installed(self):
        self.do("dpkg --force-depends -i /share/first.deb")

        self.assertEqual(self.is_active(), "active")
        self.assertIn("simulated", self.answers())
        self.assertEqual(self.do("systemctl is-enabled tubesightd"), "enabled")

    def test_2_has_no_privileges_and_listens_to_no_network(self):
        process = f"/proc/$({PID})"
        self.assertEqual(self.do(f"stat -c %U:%G {process}"), "tubesight:tubesight")
        self.assertEqual(self.do(f"grep CapEff {process}/status").split()[1].strip("0"), "")
        self.assertEqual(self.do(f"grep NoNewPrivs {process}/status").split()[1], "1")
        # State 0A is LISTEN; the board runs nothing else that could.
        self.assertEqual(self.do("cat /proc/net/tcp /proc/net/tcp6 | grep -c ' 0A ' || true"), "0")
        self.assertEqual(self.do("stat -c %U:%G:%a /run/tubesight /run/tubesight/control").splitlines(),
                         ["tubesight:tubesight:750", "tubesight:tubesight:660"])
        self.assertRegex(self.do("grep ^tubesight: /etc/shadow"), r"^tubesight:[!*]")

    def test_3_has_the_lamps_outputs_from_the_rule_and_past_the_sandbox(self):
        self.do("udevadm settle || true")
        self.assertEqual(self.do("stat -c %G:%a /dev/gpiochip0"), "tubesight:660")

        # The unit as it is, with other commands in its place.
        unit = self.do("cat /lib/systemd/system/tubesightd.service")
        unit = re.sub(r"(?m)^(Type|NotifyAccess|WatchdogSec|Restart\w*|Exec\w+|Runtime\w+)=.*\n", "", unit)
        (self.share / "try.service").write_text(unit.replace(
            "[Service]\n", "[Service]\nType=oneshot\nExecStart=/bin/sh /share/try.sh\n"
                           "StandardOutput=file:/run/try\nStandardError=file:/run/try\n"))
        (self.share / "try.sh").write_text(TRIED)
        self.do("cp /share/try.service /run/systemd/system/ && systemctl daemon-reload")
        self.do("systemctl start try; true")

        self.assertEqual([line for line in self.do("cat /run/try").splitlines() if line.startswith("=")],
                         ["= pwm yes", "= gpio yes", "= recording yes", "= kernel no", "= module no",
                          "= disk no", "= settings no"], self.do("cat /run/try"))
        self.assertEqual(board_pwm.registers(self.board), (True, 960, 480), "100 us, half of it lit")

    def test_4_keeps_the_users_settings_and_starts_anew_at_an_upgrade(self):
        before = self.do(PID)
        self.do(f"sed -i 's/^format = 1/format = 1 # the plant of the user/' {SETTINGS}")
        self.do("touch /var/lib/tubesight/recording")

        self.do("dpkg --force-depends --force-confold -i /share/later.deb")

        self.assertIn("the plant of the user", self.do(f"cat {SETTINGS}"))
        self.assertEqual(self.do(f"cat {SETTINGS}.dpkg-dist"), "# of a later version")
        self.assertEqual(self.is_active(), "active")
        self.assertNotEqual(self.do(PID), before)
        self.assertIn("simulated", self.answers())

    def test_5_stops_when_it_is_removed_and_leaves_what_is_the_users(self):
        self.do("dpkg -r tubesight")

        self.assertNotEqual(self.board.run("systemctl is-active tubesightd", STEP_S)[0], 0)
        self.assertEqual(self.do("grep -l '^tubesightd$' /proc/[0-9]*/comm 2> /dev/null | wc -l"), "0")
        self.assertIn("the plant of the user", self.do(f"cat {SETTINGS}"))
        self.do("test -e /var/lib/tubesight/recording && ! test -e /usr/bin/tubesightd")

    def test_6_leaves_nothing_when_it_is_purged(self):
        self.do("dpkg -P tubesight")

        self.do("! test -e /etc/tubesight && ! test -e /var/lib/tubesight")
        self.assertEqual(self.do("find /etc/systemd/system -name '*tubesight*' | wc -l"), "0")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    Package.package = pathlib.Path(sys.argv[1]).resolve()
    try:
        unittest.main(argv=sys.argv[:1], failfast=True, verbosity=0)
    except BoardError as error:
        sys.exit(f"{sys.argv[0]}: {error}")
