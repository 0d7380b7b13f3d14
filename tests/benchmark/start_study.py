#!/usr/bin/env python3
"""How often a start from clicks is taken in one spoilt field, in motion, and that no wrong one is.

Usage: start_study.py [--check] [--starts N] [--kinds NAME,NAME...] TUBESIGHT RECORDING...
       start_study.py --self-test

Draws fields in motion of recordings with truth (session.toml, recording.y4m.xz, truth.csv,
centers.csv), and in each three clicks into tube-ends whose rims are whole: neighbours in every
other start, up to half a radius off their centres. Spoils the field and those behind it in each of
the ways below and replays it (`tubesight replay`). Prints how many starts of N a recording were
refused, with which words, or lost within three frames. `bright-plate` puts one click beside the tube-ends, `addresses` gives
one click its neighbour's address: such a start must be refused. A start taken whose tool is not
named as the truth says is wrong. With --check the exit status is 1 where a limit is broken: two
refused of thirty, none wrong.
"""
import argparse
import collections
import csv
import lzma
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

FRAMES = 3  # of a replay: the start's and two more
MOST_REFUSED = 2 / 30
WANTED_REFUSED = {"bright-plate": "no-tube-there", "addresses": "addresses"}


class Field:
    """The pixels of one field: lines of bytes."""

    def __init__(self, lines):
        self.lines = [bytearray(line) for line in lines]
        self.width, self.height = len(lines[0]), len(lines)

    def places(self, dice, count):
        for _ in range(count):
            yield dice.randrange(self.width), dice.randrange(self.height)

    def disc(self, u, line, radius_px, grey):
        """Fills a disc; a field has every second line. grey: of the distance over the radius."""
        for v in range(max(0, line - radius_px // 2), min(self.height, line + radius_px // 2 + 1)):
            for x in range(max(0, u - radius_px), min(self.width, u + radius_px + 1)):
                away = math.hypot(x - u, 2 * (v - line)) / radius_px
                if away < 1:
                    self.lines[v][x] = grey(away, self.lines[v][x])


def table(function):
    return bytes(min(255, max(0, round(function(grey)))) for grey in range(256))


def specks(count):
    def spoil(field, dice, _):
        for u, line in field.places(dice, count):
            field.lines[line][u] = 255
    return spoil


def blots(field, dice, _):
    for u, line in field.places(dice, 8):
        field.disc(u, line, dice.randrange(14, 27), lambda away, grey: 12)


def lamp_spots(field, dice, _):
    """Reflections of a lamp: white in the middle, fading outwards."""
    for u, line in field.places(dice, 8):
        field.disc(u, line, dice.randrange(12, 37),
                   lambda away, grey: min(255, round(grey + 400 * (1 - away * away))))


def ghost(field, dice, _):
    near, far = table(lambda grey: 0.7 * grey), table(lambda grey: 0.3 * grey)
    for v, line in enumerate(field.lines):
        beside = (line[-30:] + line[:-30]).translate(far)
        field.lines[v] = bytearray(a + b for a, b in zip(line.translate(near), beside))


def salt_and_pepper(field, dice, _):
    for u, line in field.places(dice, round(0.03 * field.width * field.height)):
        field.lines[line][u] = 255 * dice.randrange(2)


def half_contrast(field, dice, _):
    less = table(lambda grey: 128 + (grey - 128) * 0.5)
    field.lines = [bytearray(line.translate(less)) for line in field.lines]


def white_clicks(field, dice, clicks):
    """A white pixel where each click is."""
    for u, v in clicks:
        field.lines[v // 2][u] = 255


def nothing(field, dice, clicks):
    pass


KINDS = {"clean": nothing, "white-clicks": white_clicks, "specks-600": specks(600),
         "specks-2000": specks(2000), "specks-6000": specks(6000), "blots": blots,
         "lamp-spots": lamp_spots, "ghost": ghost, "salt-and-pepper": salt_and_pepper,
         "half-contrast": half_contrast, "bright-plate": nothing, "addresses": nothing}


class Recording:
    def __init__(self, folder):
        folder = pathlib.Path(folder)
        self.name = folder.name
        self.session = (folder / "session.toml").read_text()
        self.raw = lzma.open(folder / "recording.y4m.xz").read()
        self.start = self.raw.index(b"\n") + 1
        size = {tag[0]: tag[1:] for tag in self.raw[:self.start - 1].decode().split()[1:]}
        self.width, self.height = int(size["W"]), int(size["H"])
        self.truth = list(csv.DictReader((folder / "truth.csv").open()))
        self.centers = collections.defaultdict(list)
        for row in csv.DictReader((folder / "centers.csv").open()):
            self.centers[2 * int(row["frame"]) + int(row["field"])].append(row)
        window = re.search(r"window_px = \[(.*)\]", self.session)[1]
        self.window = [int(number) for number in window.split(",")]

    def frame(self, index):
        begin = self.start + index * (self.width * self.height + 6) + 6
        return [self.raw[begin + v * self.width:begin + (v + 1) * self.width]
                for v in range(self.height)]

    def whole(self, field):
        """Open tube-ends whose rims lie in the window."""
        left, top, right, bottom = self.window
        for row in self.centers[field]:
            u, v = float(row["x_f"]), float(row["y_f"])
            half_u, half_v = float(row["half_w"]), float(row["half_h"])
            if (row["state"] == "open" and float(row["occluded"]) == 0 and
                    left < u - half_u and u + half_u < right and
                    top < v - half_v and v + half_v < bottom):
                yield int(row["row"]), int(row["col"]), u, v, half_u, half_v

    def moving(self):
        """Even fields in motion: a replay's start is in its first."""
        return [2 * i for i in range(len(self.truth) // 2 - FRAMES)
                if float(self.truth[2 * i]["speed"]) > 1 and len(list(self.whole(2 * i))) >= 4]


def fatness(a, b, c):
    """Twice the area of three tube-ends over the square of the longest side."""
    longest = max(math.hypot(p[2] - q[2], p[3] - q[3]) for p, q in ((a, b), (b, c), (c, a)))
    return abs((b[2] - a[2]) * (c[3] - a[3]) - (c[2] - a[2]) * (b[3] - a[3])) / longest ** 2


def draw_clicks(tubes, dice, close):
    while True:
        three = dice.sample(tubes, 3)
        if close:
            three = sorted(tubes, key=lambda t: math.hypot(t[2] - three[0][2], t[3] - three[0][3]))
            three = [three[0], *dice.sample(three[1:5], 2)]
        if fatness(*three) > 0.35:
            break
    clicks = []
    for row, column, u, v, half_u, half_v in three:
        angle, off = dice.uniform(0, 2 * math.pi), 0.5 * math.sqrt(dice.random())
        clicks.append((row, column, round(u + off * half_u * math.cos(angle)),
                       round(v + off * half_v * math.sin(angle))))
    return clicks


def beside(click, tubes, dice, window):
    """A click on the plate: at least 1.12 radii from every tube-end."""
    left, top, right, bottom = window
    for _ in range(100000):
        u, v = click[2] + dice.randrange(-80, 81), click[3] + dice.randrange(-80, 81)
        if (left + 60 < u < right - 60 and top + 60 < v < bottom - 60 and
                all(math.hypot((u - t[2]) / t[4], (v - t[3]) / t[5]) > 1.12 for t in tubes)):
            return (*click[:2], u, v)
    return None


def turn(a, b, c):
    """Which way round three addresses go."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    return (area > 0) - (area < 0)


def misnamed(clicks):
    """One click's address a step off, the way round kept, as the settings' check demands."""
    (row, column, u, v), *others = clicks
    for r, c in ((0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (-1, -1), (1, -1), (-1, 1)):
        moved = [(row + r, column + c, u, v), *others]
        if turn(*moved) == turn(*clicks):
            return moved
    return None


def replay(program, folder, recording, first, clicks, kind, dice):
    """The refusal's word, "lost" after it, "taken" or "WRONG"; None: the settings refuse them."""
    frames = []
    for i in range(FRAMES):
        lines = recording.frame(first // 2 + i)
        fields = [Field(lines[0::2]), Field(lines[1::2])]
        for j, field in enumerate(fields):
            KINDS[kind](field, dice, [(u, v) for _, _, u, v in clicks] if i + j == 0 else [])
        frames.append(b"".join(fields[v % 2].lines[v // 2] for v in range(recording.height)))
    video = folder / "video.y4m"
    video.write_bytes(b"YUV4MPEG2 W%d H%d F30:1 It A1:1 Cmono\n" %
                      (recording.width, recording.height) +
                      b"".join(b"FRAME\n" + frame for frame in frames))
    tubes = ", ".join(f"{{ row = {r}, column = {c}, at_px = [{u}, {v}] }}" for r, c, u, v in clicks)
    session = folder / "session.toml"
    session.write_text(re.sub(r"(?s)tubes = \[.*?\}\s*\]", f"tubes = [ {tubes} ]",
                              recording.session))
    said = subprocess.run([program, "replay", session, video, "--fields", folder / "fields.csv"],
                          capture_output=True, text=True)
    if "start.tubes" in said.stderr:
        return None
    if said.returncode:
        sys.exit(f"start_study.py: {said.stderr.strip()}")
    refused = re.search(r"start at .* refused: ([a-z-]+)", said.stdout)
    if refused:
        return refused[1]
    return judge(list(csv.DictReader((folder / "fields.csv").open())), recording.truth[first:])


def judge(rows, truth):
    for row, true in zip(rows, truth):
        named = row["tool_row"], row["tool_column"]
        if named[0] and named != (true["near_row"], true["near_col"]) and (
                float(true["offset_mm"]) < 9 or row["aligned"] == "1"):
            return "WRONG"
    return "lost" if any(row["state"] == "lost" for row in rows) else "taken"


def study(program, recordings, kinds, starts):
    """{kind: Counter of what became of its starts}"""
    found = {kind: collections.Counter() for kind in kinds}
    with tempfile.TemporaryDirectory() as name:
        for recording in recordings:
            fields = recording.moving()
            for i in range(starts):
                dice = random.Random(f"{recording.name} {i}")
                first = dice.choice(fields)
                tubes = list(recording.whole(first))
                clicks = draw_clicks(tubes, dice, i % 2 == 0)
                for kind in kinds:
                    own = random.Random(f"{recording.name} {i} {kind}")
                    chosen = list(clicks)
                    if kind == "bright-plate":
                        chosen[-1] = beside(clicks[-1], [(int(r["row"]), 0, float(r["x_f"]),
                                                          float(r["y_f"]), float(r["half_w"]),
                                                          float(r["half_h"]))
                                                         for r in recording.centers[first]], own,
                                            recording.window)
                    if kind == "addresses":
                        chosen = misnamed(clicks)
                    if chosen is None or chosen[-1] is None:
                        continue  # there is no such place
                    became = replay(program, pathlib.Path(name), recording, first, chosen, kind,
                                    own)
                    found[kind].update([became] if became else [])
    return found


def failures(found):
    """What breaks the limits, a line each."""
    for kind, counts in found.items():
        total = sum(counts.values())
        refused = total - counts["taken"] - counts["WRONG"]
        if counts["WRONG"]:
            yield f"{kind}: {counts['WRONG']} wrong"
        if kind in WANTED_REFUSED:
            if counts["taken"]:
                yield f"{kind}: {counts['taken']} taken"
            if counts[WANTED_REFUSED[kind]] < (1 - MOST_REFUSED) * total:
                yield f"{kind}: {counts[WANTED_REFUSED[kind]]} of {total} named as such"
        elif refused > MOST_REFUSED * total:
            yield f"{kind}: {refused} of {total} refused"


def self_test():
    count = collections.Counter
    assert not list(failures({"ghost": count(taken=28, picture=2)}))
    assert list(failures({"ghost": count(taken=27, picture=3)})) == ["ghost: 3 of 30 refused"]
    assert list(failures({"ghost": count(taken=29, WRONG=1)})) == ["ghost: 1 wrong"]
    plate = {"no-tube-there": 28, "size": 2}
    assert not list(failures({"bright-plate": count(plate)}))
    plate["taken"] = 1
    assert "bright-plate: 1 taken" in list(failures({"bright-plate": count(plate)}))
    row = {"tool_row": "4", "tool_column": "7", "aligned": "1", "state": "tracking"}
    true = {"near_row": "4", "near_col": "7", "offset_mm": "0.5"}
    assert judge([row], [true]) == "taken"
    assert judge([row, {**row, "state": "lost"}], [true, true]) == "lost"
    assert judge([row], [{**true, "near_col": "8"}]) == "WRONG"
    field = Field([bytes([100] * 200)] * 100)
    blots(field, random.Random(1), [])
    assert min(map(min, field.lines)) == 12
    ghost(field, random.Random(1), [])
    assert max(map(max, field.lines)) == 100
    print("start_study.py: self-test passed")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--starts", type=int, default=30)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("program", nargs="?")
    parser.add_argument("recording", nargs="*")
    options = parser.parse_args()
    if options.self_test:
        return self_test()
    if not options.program or not options.recording:
        parser.error("TUBESIGHT and RECORDING are needed")
    found = study(options.program, [Recording(folder) for folder in options.recording],
                  options.kinds.split(","), options.starts)
    for kind, counts in found.items():
        refused = {word: n for word, n in sorted(counts.items()) if word != "taken"}
        print(f"{kind:16s} taken {counts['taken']:3d} of {sum(counts.values()):3d}  " +
              ", ".join(f"{word} {n}" for word, n in refused.items()))
    broken = list(failures(found))
    if options.check and broken:
        sys.exit("start_study.py: " + "; ".join(broken))
    return None


if __name__ == "__main__":
    main()
