"""The box on the emulated board names the tube of a drawn scenario over the robot's link, dims the lamp, and
keeps its promises of real time. Figures of time are printed, never judged: the emulator's mean nothing."""
import dataclasses
import re
import time

import board_case
import board_pwm
from board_box import LOST

RECORD = """
[record]
folder = "/data"
memory_mb = 240
disk_mb = 250
on_disagreement = false
on_track_lost = false
"""
GPIO = """
[lamp]
kind = "gpio"
chip = "9030000.pl061"
lines = ["5"]
frequency_hz = 100
soft_ms = 0
"""
PWM = f"""
[lamp]
kind = "pwm"
chip = "{board_pwm.CHIP}"
channel = 0
frequency_hz = 1000
pattern = false
automatic = false
soft_ms = 0
"""
SCHED_FIFO = 1


class Sighting(board_case.BoardCase):
    @classmethod
    def arguments(cls):
        cls.pins = cls.folder / "pins.txt"
        return {"memory_mb": board_pwm.MEMORY_MB, "dtb": board_pwm.device_tree(cls.folder),
                "modules": ("pwm-bcm2835",), "pins": cls.pins}

    def pid(self):
        return int(self.box.board.do("pidof tubesightd"))

    def threads(self):
        """[the words of /proc's stat behind the name] of each thread."""
        text = self.box.board.do(f"cat /proc/{self.pid()}/task/*/stat")
        return [line.rpartition(")")[2].split() for line in text.splitlines()]

    def cpu_s(self):
        """Processor time of the box so far, by the board's clock."""
        return sum(int(each[11]) + int(each[12]) for each in self.threads()) / 100.0

    def test_1_names_each_tube_as_the_scenario_has_it(self):
        box = self.box
        box.board.do("mkdir -p /data && mount -t tmpfs -o size=300m data /data")
        box.play()
        box.start_daemon(RECORD + GPIO)
        print(f"figures: power on to the first answer {time.monotonic() - self._begin + self.booted_s:.1f} s,"
              f" of which {self.booted_s:.1f} s until programs run (busybox init, no systemd)")
        box.wait_status(lambda status: status["camera"]["well"], "the camera is not well")
        before = box.robot.sighting()
        self.assertEqual((before.state, before.tube, before.vouched), (1, None, False), before)
        box.start_tracking()
        cpu, begin = self.cpu_s(), box.clock_s()
        faults = [(each[7], each[9]) for each in self.threads() if each[38] == str(SCHED_FIFO)]

        verdicts, seen, restarts = [], [], 0
        for index, (_, _, tube) in enumerate(self.scenario.stations):
            if index > 0:
                box.go_on()
            # On its way it vouches for what is true, or for nothing: judged below by the pixels.
            moved, due = box.clock_s(), time.monotonic() + 40.0
            while not (seen and seen[-1].vouched and seen[-1].tube == tube):
                self.assertLess(time.monotonic(), due, f"never under {tube}: {seen[-1:]}")
                verdicts.append(box.robot.claim(tube))
                seen.append(box.robot.sighting())
                # Where the PC itself stood still, pictures are missing and the track is lost.
                if seen[-1].state == LOST and box.clock_s() - moved > 4.0:
                    restarts += 1
                    box.start_tracking(index)
            verdicts += self.vouches_for(tube)
            seen.append(box.robot.sighting())
        share = (self.cpu_s() - cpu) / (box.clock_s() - begin)
        after = [(each[7], each[9]) for each in self.threads() if each[38] == str(SCHED_FIFO)]
        recorded = box.recording()
        known = [each for each in verdicts if each.word == "AGREE"]
        print(f"{len(recorded)} fields with the scenario's pixels, {self.judge(verdicts, seen, recorded)}"
              f" answers as the truth has them, {sum(each.word == 'CANNOT SAY' for each in verdicts)}"
              f" times CANNOT SAY, {restarts} restarts")
        # A wrong tube, a wrong verdict, another field's pixels and a counter that goes back are found.
        row, column = known[0].seen
        for planted in ((dataclasses.replace(known[0], seen=(row + 1, column)), seen, recorded),
                        (dataclasses.replace(known[0], word="DISAGREE"), seen, recorded),
                        (known[0], seen, [(field, status, None) for field, status, _ in recorded]),
                        (known[0], seen[::-1], recorded), (known[0], seen, recorded[::-1])):
            with self.assertRaises(self.failureException):
                self.judge([planted[0]], *planted[1:])
        self.assertEqual(after, faults, "page faults of the real-time threads after the start")
        self.costs(share)

    def judge(self, verdicts, seen, recorded):
        """What was said of a field against what the scenario has in just those pixels: how often."""
        strange = [field for field, status, truth in recorded if status == "good" and truth is None]
        self.assertEqual(strange, [], "fields whose pixels are in no field of the scenario")
        truth = {field: source for field, status, source in recorded if status == "good"}
        self.assertGreater(len(truth), 120)
        # Within a rest the scenario goes in a circle; from station to station only onwards.
        stations = self.scenario.stations
        places = [sum(source // 2 > last for _, last, _ in stations) for source in truth.values()]
        self.assertEqual(places, sorted(places))
        self.assertEqual(sorted({*range(len(stations))} - {*places}), [])
        for earlier, later in zip(seen, seen[1:]):
            self.assertGreaterEqual(later.field, earlier.field)
            self.assertGreaterEqual(later.judged, earlier.judged)
            self.assertEqual(later.boot, earlier.boot)
        looked_up = 0
        for verdict in verdicts:
            if verdict.word in ("AGREE", "DISAGREE"):
                self.assertIn(verdict.field, truth, f"{verdict}: not among the fields recorded")
                tube = self.scenario.tube(truth[verdict.field])
                self.assertEqual(verdict.seen, tube, verdict)
                self.assertEqual(verdict.word == "AGREE", verdict.claimed == tube, verdict)
                looked_up += 1
        for each in seen:
            if each.vouched:
                self.assertEqual(each.tube, self.scenario.tube(truth[each.field]), each)
                looked_up += 1
        return looked_up

    def costs(self, share):
        status = self.box.status()
        memory = self.box.board.do(f"grep VmHWM /proc/{self.pid()}/status").split()
        free = self.box.board.do("grep MemAvailable /proc/meminfo").split()[1]
        print(f"figures: {100 * share:.0f} % of one core of two, step {status['step']['median_us']} us,"
              f" grab to sighting {status['grab_to_sighting']['median_us']} us in the median,"
              f" {status['late']} of {status['counters']['fields']} fields after the deadline of 10 ms,"
              f" {status['counters']['missing']} missing, most before the camera was open;"
              f" memory {int(memory[1]) // 1024} MiB at most, of them 240 of the recorder,"
              f" {int(free) // 1024} MiB left")

    def test_2_runs_in_real_time_with_locked_memory(self):
        status = self.box.status()
        self.assertTrue(status["realtime"]["scheduled"], self.box.said)
        self.assertTrue(status["realtime"]["memory_locked"], self.box.said)
        policies = {(int(each[37]), int(each[38])) for each in self.threads()}
        self.assertIn((50, SCHED_FIFO), policies)  # it tracks
        self.assertIn((60, SCHED_FIFO), policies)  # the lamp's pulses
        text = self.box.board.do(f"cat /proc/{self.pid()}/status")
        locked, size = (int(re.search(rf"{key}:\s+(\d+)", text)[1]) for key in ("VmLck", "VmRSS"))
        self.assertGreater(locked, size * 9 // 10)

    def test_3_a_stall_shows_in_the_deadline_counters(self):
        before = self.box.status()
        self.box.board.do("killall -STOP tubesightd; sleep 1; killall -CONT tubesightd")
        after = self.box.wait_status(lambda status: status["late"] > before["late"],
                                     "no field is counted as late after a stall")
        self.assertGreater(after["camera"]["lost_fields"] + after["camera"]["wrong_stamps"]
                           + after["counters"]["missing"],
                           before["camera"]["lost_fields"] + before["camera"]["wrong_stamps"]
                           + before["counters"]["missing"])

    def edges(self, begin):
        """[(time, level)] of the lamp's line since the file had `begin` bytes."""
        with open(self.pins, encoding="ascii", errors="replace") as file:
            file.seek(begin)
            text = file.read()
        return [(float(at), int(level))
                for at, level in re.findall(r"@([\d.]+):pl061_set_output .* output 5 to (\d)", text)]

    def test_4_the_robot_dims_the_lamp_by_pulses_on_a_pin(self):
        for permille in (300, 700):
            self.assertEqual(self.box.robot.light(permille), permille)
            time.sleep(0.5)
            begin, clock = self.pins.stat().st_size, self.box.clock_s()
            time.sleep(2.0)
            clock = self.box.clock_s() - clock
            found = self.edges(begin)
            lit = sum(later - at for (at, level), (later, _) in zip(found, found[1:]) if level)
            share = lit / (found[-1][0] - found[0][0])
            rises = sum(level for _, level in found) / clock
            print(f"lamp at {permille} permille: lit {100 * share:.1f} %, {rises:.0f} pulses a second")
            self.assertAlmostEqual(share, permille / 1000.0, delta=0.1)
            self.assertAlmostEqual(rises, 100.0, delta=10.0)
        self.box.robot.light(0)
        time.sleep(0.5)
        self.assertEqual(int(self.box.board.qtest("readb 0x9030080"), 16) & 1 << 5, 0)
        self.box.robot.light(1000)
        time.sleep(0.5)
        self.assertEqual(int(self.box.board.qtest("readb 0x9030080"), 16) & 1 << 5, 1 << 5)

    def test_5_stops_with_a_dark_lamp(self):
        self.box.stop_daemon()
        self.assertEqual(int(self.box.board.qtest("readb 0x9030080"), 16) & 1 << 5, 0, self.box.said)

    def test_6_dims_by_the_pwm_of_a_raspberry_pi(self):
        self.box.start_daemon(PWM)
        for permille in (300, 1000, 0):
            self.box.robot.light(permille)
            time.sleep(0.5)
            enabled, period, duty = board_pwm.registers(self.box.board)
            self.assertTrue(enabled)
            self.assertEqual(period, board_pwm.CLOCK_HZ // 1000)
            self.assertAlmostEqual(duty / period, permille / 1000.0, delta=0.002)
        self.box.robot.light(700)
        time.sleep(0.5)
        self.box.stop_daemon("KILL")
        self.assertGreater(board_pwm.registers(self.box.board)[2], 0)
        self.box.board.do("tubesightd /share/box.toml --dark")
        self.assertEqual(board_pwm.registers(self.box.board)[2], 0)


if __name__ == "__main__":
    board_case.main()
