"""What goes wrong with the box on the emulated board, and how it comes back: the camera in each way that the
kernel's virtual camera can fail, the robot's line, the disk, the program, the power.

After each fault the robot starts the box anew where the track was lost; at no time may the box vouch for
a tube that the tool is not under.
"""
import random
import time

import board_case
import board_parts
from board_box import LOST, SOCKET, WAITING

SETTINGS = """
[record]
folder = "/data"
memory_mb = 32
disk_mb = 60
on_disagreement = false
on_track_lost = false

[lamp]
kind = "gpio"
chip = "9030000.pl061"
lines = ["5"]
frequency_hz = 100
"""


class Faults(board_case.BoardCase):
    @classmethod
    def arguments(cls):
        cls.disk = cls.folder / "data.img"
        with open(cls.disk, "wb") as file:
            file.truncate(128 * 1024 * 1024)
        board_parts.run("mke2fs", "-q", "-t", "ext4", "-E", "lazy_itable_init=0,lazy_journal_init=0",
                        cls.disk)
        return {"disks": (cls.disk,), "modules": ("virtio_blk", "ext4")}

    @property
    def tube(self):
        return self.scenario.stations[0][2]

    def test_0_begins(self):
        self.box.board.do("mkdir -p /data && mount -t ext4 /dev/vda /data")
        self.box.play(self.scenario.stations[:1])
        self.box.start_daemon(SETTINGS)
        self.comes_back()

    def comes_back(self, seconds=30.0):
        """The camera is well again, the robot starts the box where that is needed, and it vouches."""
        self.box.wait_status(lambda status: status["camera"]["well"], "the camera does not come back",
                             seconds)
        if self.box.robot.sighting().state in (WAITING, LOST):
            self.box.start_tracking()
        due = time.monotonic() + seconds
        while not (seen := self.box.robot.sighting()).vouched:
            self.assertLess(time.monotonic(), due, f"{seen}\n{self.box.status()['text']}")
        self.vouches_for(self.tube)

    def fails(self, control, value, counter, words="", during=None, again=False):
        """Injects a fault of the camera, waits until the box names it, and sees it come back."""
        begin = time.monotonic()
        before = self.box.status()["camera"]
        self.box.inject(control, value)

        def is_named(status):
            named = (status["camera"][counter] > before[counter]
                     and words in status["camera"]["words"])
            if again and not named:
                self.box.inject(control, value)
            return named
        named = self.box.wait_status(is_named, f"{control} is not named {counter}, '{words}'")
        seen = self.box.robot.sighting()
        if seen.vouched:
            self.assertEqual(seen.tube, self.tube, control)
        if during is not None:
            during()
        self.comes_back()
        print(f"{control}: {counter} {named['camera'][counter] - before[counter]}, "
              f"'{named['camera']['words']}'; back after {time.monotonic() - begin:.1f} s", flush=True)

    def vouches_for_nothing(self):
        """As long as there is no picture."""
        due = time.monotonic() + 10.0
        while self.box.robot.sighting().vouched:
            self.assertLess(time.monotonic(), due, "vouches without a picture")
        verdict = self.box.robot.claim(self.tube)
        self.assertEqual(verdict.word, "CANNOT SAY", verdict)

    def test_1_camera_drops_buffers(self):
        self.fails("Percentage of Dropped Buffers", 30, "lost_fields",
                   during=lambda: self.box.inject("Percentage of Dropped Buffers", 0))

    def test_1_camera_flags_errors(self):
        # The flag is on a picture of either node, or on none.
        self.fails("Inject V4L2_BUF_FLAG_ERROR", 1, "flagged", again=True)

    def test_1_camera_refuses_a_buffer(self):
        self.box.hold_picture(True)
        self.fails("Inject VIDIOC_QBUF Error", 1, "queue_errors",
                   during=lambda: self.box.hold_picture(False))

    def test_1_camera_without_signal(self):
        def back():
            self.vouches_for_nothing()
            self.box.inject("Standard Signal Mode", "Current Standard")
        self.fails("Standard Signal Mode", "No Signal", "without_signal", "no signal", back)

    def test_1_camera_without_lock(self):
        def back():
            self.vouches_for_nothing()
            self.box.inject("Standard Signal Mode", "Current Standard")
        self.fails("Standard Signal Mode", "No Lock", "without_signal", "no signal", back)

    def test_1_camera_stream_fails_for_good(self):
        self.fails("Inject Fatal Streaming Error", 1, "dequeue_errors")

    def test_2_camera_is_pulled_out(self):
        self.fails("Disconnect", 1, "disconnects", during=self.vouches_for_nothing)

    def refuses_at_the_opening(self, control, said):
        """The player is away meanwhile, so that the refusal meets the box; one that has said little
        so far, as it says only so much in a minute."""
        self.box.stop_daemon()
        self.box.start_daemon(SETTINGS)
        self.comes_back()
        self.box.stop_playing()
        self.box.inject(control)

        def back():
            due = time.monotonic() + 20.0
            while said not in self.box.said:
                self.assertLess(time.monotonic(), due, self.box.said)
            self.box.play(self.scenario.stations[:1])
        self.fails("Disconnect", 1, "disconnects", during=back)

    def test_2_camera_does_not_start_to_stream(self):
        self.refuses_at_the_opening("Inject VIDIOC_STREAMON Error", "does not start to stream")

    def test_2_camera_gives_no_buffers(self):
        self.refuses_at_the_opening("Inject VIDIOC_REQBUFS Error", "buffers")

    def test_3_line_is_pulled_and_noisy(self):
        self.box.robot.pull_out()
        time.sleep(2.5)
        self.box.robot.plug_in()
        self.assertLess(self.box.robot.answers(20.0), 20.0)
        before = self.box.robot.read(500, 46)
        noise = random.Random(34)
        for _ in range(20):
            self.box.robot.say(noise.randbytes(40))
            time.sleep(0.02)
        self.box.robot.answers(20.0)
        after = self.box.robot.read(500, 46)
        self.assertGreater(sum(after[18:28]), sum(before[18:28]), "noise is not counted")
        self.vouches_for(self.tube)

    def test_3_line_goes_and_returns(self):
        before = self.box.status()["link"]["reopenings"]
        self.box.board.do("readlink -f /sys/class/tty/ttyS0/device > /tmp/line;"
                          " echo 1 > $(cat /tmp/line)/remove")
        self.box.wait_status(lambda status: not status["link"]["open"], "the line is not missed")
        self.box.board.do("echo 1 > /sys/bus/pci/rescan")
        self.box.robot.answers(30.0)
        self.assertGreater(self.box.status()["link"]["reopenings"], before)
        self.vouches_for(self.tube)

    def test_4_disk_is_full(self):
        # Taken, not written: to write it keeps the processors from the camera, whose pictures they make.
        self.box.board.run("for mb in 64 32 16 8 4 2 1; do fallocate -l ${mb}M /data/full-$mb; done", 60.0)
        well, text = self.box.ask("record")
        self.assertFalse(well, text)
        self.assertIn("bad", self.box.ask("self-test")[1])
        self.vouches_for(self.tube)
        self.box.board.do("rm /data/full-*; sync")
        self.assertGreater(len(self.box.recording()), 60)

    def test_5_program_is_killed(self):
        boot = self.box.robot.sighting().boot
        self.box.stop_daemon("KILL")
        self.box.board.do("tubesightd /share/box.toml --dark")
        self.box.start_daemon(SETTINGS)
        self.waits(boot)

    def waits(self, boot):
        """A box that was started anew: it knows nothing of what was said before."""
        self.box.wait_status(lambda status: status["camera"]["well"], "the camera is not well")
        seen = self.box.robot.sighting()
        self.assertNotEqual(seen.boot, boot)
        self.assertEqual((seen.state, seen.tube, seen.vouched), (WAITING, None, False), seen)
        self.assertEqual(self.box.robot.claim(self.tube).word, "CANNOT SAY")
        self.comes_back()

    def test_6_power_is_cut(self):
        boot = self.box.robot.sighting().boot
        kept = self.box.board.do("cd /data && sha256sum *.y4m")
        self.box.board.run(f"(tubesightctl --socket {SOCKET} record &) > /dev/null 2>&1; sleep 1.2")
        self.box.board.cut_power()
        self.box.boot()
        self.box.board.do("mkdir -p /data && mount -t ext4 /dev/vda /data")
        self.assertEqual(self.box.board.do("cd /data && sha256sum " + " ".join(
            line.split()[1] for line in kept.splitlines())), kept)
        self.box.play(self.scenario.stations[:1])
        self.box.start_daemon(SETTINGS)
        self.waits(boot)
        self.assertGreater(len(self.box.recording()), 60)


if __name__ == "__main__":
    board_case.main()
