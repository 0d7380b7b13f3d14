"""A robot on a mission: polls and claims over its link, and writes down all it asked and was told.

Usage: mission_robot.py EXAMPLES LINE SECONDS RESTS SPAN_US

EXAMPLES is the folder of the document's robot program, whose parts it uses. RESTS is a file with a line
a rest of the tool: first and last field, row, column; SPAN_US is from one field to the next. Where the
box has lost its track, the robot starts it anew when it rests, as it knows where it is. Twenty times a second it
reads the block `sighting`, and claims where it was some time ago by what it had read then: every
second claim names a wrong tube beside it, every fifth is made in two transactions. A line each, with
instants of the monotonic clock in us:

  P SENT RECEIVED VALID FIELD AGE_MS TUBE ALIGNED STATE
  C SENT TAKEN RECEIVED AGE_MS CLAIMED VERDICT REASON NAMED FIELD
  R AT FIELD TUBE REFUSED
  H FIELDS MISSING LATE REQUESTS EXCEPTIONS CRC_ERRORS LATE_CLAIMS WORST_US CLAIM_WORST_US

TAKEN is when a claim's own write was answered; of one transaction that is the verdict's arrival.
"""
import collections
import sys
import time

sys.path.insert(0, sys.argv[1])
import robot  # noqa: E402

RATE = 20
AGES_MS = (0, 0, 40, 120, 0, 200, 0, 300)  # the last is older than the box answers for
WAITING, LOST = 1, 4  # state
Seen = collections.namedtuple("Seen", "at_us tube")
Polled = collections.namedtuple("Polled", "at_us tube field lost")


def now_us():
    return time.monotonic_ns() // 1000


def poll(master):
    sent = now_us()
    got = robot.read(master, 100, 52)
    received = now_us()
    tube = (robot.number(got, 22), robot.number(got, 24)) if got[4] & 1 << 4 else None
    age = robot.number(got, 48) if got[4] & 1 else -1
    field = robot.number(got, 12)
    print("P", sent, received, got[4], field, age, robot.text(tube), got[45], got[5])
    exposed = (sent + received) // 2 - 1000 * age if age >= 0 else None
    return Polled(exposed, tube, field, got[5] in (WAITING, LOST))


class Restarts:
    """Starts the box anew after a loss, when the tool rests under a tube for long enough."""

    BEGIN, END = 6, 12  # fields of a rest that are left out

    def __init__(self, master, path, span_us):
        self.master = master
        self.span_us = span_us
        with open(path, encoding="ascii") as file:
            self.rests = [tuple(map(int, line.split())) for line in file]
        self.mark = None  # a field and when it was exposed

    def look(self, polled):
        if polled.at_us is not None:
            self.mark = polled.field, polled.at_us
        if not polled.lost or not self.mark:
            return
        field = self.mark[0] + round((now_us() - self.mark[1]) / self.span_us)
        for first, last, row, column in self.rests:
            if first + self.BEGIN <= field <= last - self.END:
                rows, columns = row - robot.START[0][0], column - robot.START[0][1]
                tubes = [(r + rows, c + columns, u, v) for r, c, u, v in robot.START]
                at = now_us()
                refused = robot.start(self.master, tubes)
                print("R", at, field, robot.text((row, column)), refused)


def claim(master, claim_id, tube, age, boot, in_two):
    """Whether the box answered, and to this claim."""
    block = robot.words(claim_id, *tube) + [age, 1]
    sent = now_us()
    if in_two:
        robot.write(master, 300, block)
        taken = now_us()
        got = robot.read(master, 200, 24)
        while got[4] & 4:
            time.sleep(0.002)
            got = robot.read(master, 200, 24)
    else:
        answer = master.readwrite_registers(read_address=200, read_count=24, write_address=300,
                                            write_registers=block, unit=robot.UNIT)
        taken = now_us()
        if answer.isError():
            return False
        got = answer.registers
    received = now_us()
    echo = [robot.number(got, at) for at in (2, 8, 10, 12)]
    if not got[4] & 1 or echo != [boot, claim_id, *tube]:
        return False
    named = (robot.number(got, 14), robot.number(got, 16)) if got[4] & 2 else None
    print("C", sent, taken, received, age, robot.text(tube), got[5], got[6], robot.text(named),
          robot.number(got, 18))
    return True


def main(line, seconds, rests, span_us):
    master = robot.connect(line)
    boot = robot.sighting(master)[2]
    if refused := robot.start(master):
        sys.exit(f"start refused, reason {refused}")
    restarts = Restarts(master, rests, span_us)
    seen = collections.deque(maxlen=RATE)
    unanswered = 0
    begin = time.monotonic()
    for i in range(int(seconds * RATE)):
        # Not in step with the fields: at another part of one each time.
        due = begin + i / RATE + 0.001 * (i * 7 % 17)
        time.sleep(max(0.0, due - time.monotonic()))
        polled = poll(master)
        restarts.look(polled)
        if polled.tube and polled.at_us is not None:
            seen.append(Seen(polled.at_us, polled.tube))
        if not seen:
            continue
        age = AGES_MS[i % len(AGES_MS)]
        instant = now_us() - 1000 * age
        row, column = min(seen, key=lambda each: abs(each.at_us - instant)).tube
        in_two = i % 5 == 4
        unanswered += not claim(master, i + 1, (row + i % 2, column), age, boot, in_two)
    health = robot.read(master, 500, 42)
    print("H", *(robot.number(health, at) for at in (6, 8, 10, 12, 16, 18, 30, 38, 40)))
    if unanswered:
        sys.exit(f"{unanswered} claims without an answer of their own")


main(sys.argv[2], float(sys.argv[3]), sys.argv[4], float(sys.argv[5]))
