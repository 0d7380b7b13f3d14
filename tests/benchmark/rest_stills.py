#!/usr/bin/env python3
"""Takes the rests out of a recording with truth, as stills for pose_accuracy.py.

Usage: rest_stills.py RECORDING_FOLDER OUT_FOLDER

RECORDING_FOLDER holds session.toml, recording.y4m.xz and truth.csv (a line a field, two a frame).
Four frames each in which the speed is zero become still-POSE-0.pgm ... still-POSE-3.pgm. The truth
of a pose is the mean over its fields, as a resting tool still trembles by hundredths of a
millimetre. start.txt and start9.txt name the three and the nine tubes nearest to the guidetube's
axis, off their centres by up to 40 % of the radius as an operator would be; the seed is fixed.
"""
import csv
import lzma
import math
import pathlib
import random
import sys
import tomllib

FRAMES = 4
AVERAGED = ("tool_x", "tool_y", "tool_z", "axis_x", "axis_y")
BORDER_PX = 40
LOWEST_PX = 280  # rows below are far from the camera


def rotation(alpha, beta, gamma):
    ca, sa, cb, sb = math.cos(alpha), math.sin(alpha), math.cos(beta), math.sin(beta)
    cg, sg = math.cos(gamma), math.sin(gamma)
    return [[ca * cb, ca * sb * sg - sa * cg, ca * sb * cg + sa * sg],
            [sa * cb, sa * sb * sg + ca * cg, sa * sb * cg - ca * sg],
            [-sb, cb * sg, cb * cg]]


def times(matrix, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in matrix]


def image_of(settings, truth, point):
    """Pixel of a point of the sheet, by the conventions' formulas; None behind the camera."""
    camera, tool = settings["camera"], settings["tool"]
    R_sheet_tool = rotation(*(float(truth[f"tool_{a}"]) for a in ("alpha", "beta", "gamma")))
    off = [p - float(truth[f"tool_{axis}"]) for p, axis in zip((*point, 0.0), "xyz")]
    in_tool = times(list(zip(*R_sheet_tool)), off)
    R_camera_tool = rotation(*(math.radians(a) for a in tool["rotation_deg"]))
    x, y, z = (a + b for a, b in zip(times(R_camera_tool, in_tool), tool["position_mm"]))
    if z < 1.0:
        return None
    x, y = (camera["focal_length_mm"] * value / z for value in (x, y))
    ideal, k = math.hypot(x, y), camera["distortion_per_mm2"]
    seen = ideal
    for _ in range(30):
        seen -= (seen * (1 + k * seen * seen) - ideal) / (1 + 3 * k * seen * seen)
    share = seen / ideal if ideal > 0 else 1.0
    scale = (camera["horizontal_scale"] / camera["cell_width_mm"] * camera["frame_columns"]
             / camera["sensor_columns"])
    return (x * share * scale + camera["center_px"][0],
            y * share / camera["cell_height_mm"] + camera["center_px"][1])


def read_frames(path, width, height):
    data = lzma.open(path).read()
    at, frames = data.index(b"\n") + 1, []
    while at < len(data):
        begin = data.index(b"\n", at) + 1
        frames.append(data[begin:begin + width * height])
        at = begin + width * height
    return frames


def rests(truth, frames):
    """Groups of FRAMES frames whose two fields are at rest."""
    groups, run = [], []
    for frame in range(frames):
        if all(float(truth[2 * frame + field]["speed"]) == 0.0 for field in (0, 1)):
            run.append(frame)
            if len(run) == FRAMES:
                groups.append(run)
                run = []
        else:
            run = []
    return groups


def nearest_tubes(settings, row, chance):
    """Address and a place in the dark, by the distance from the guidetube's axis."""
    sheet, camera = settings["tubesheet"], settings["camera"]
    listed = set(map(tuple, sheet["plugged"] + sheet["missing"]))
    axis = (float(row["axis_x"]), float(row["axis_y"]))
    found = []
    for d_row in range(-6, 7):
        for d_column in range(-6, 7):
            address = (int(row["near_row"]) + d_row, int(row["near_col"]) + d_column)
            center = [sheet["origin_mm"][i] + address[0] * sheet["row_step_mm"][i]
                      + address[1] * sheet["column_step_mm"][i] for i in (0, 1)]
            place = image_of(settings, row, center)
            if address in listed or place is None or not (
                    BORDER_PX < place[0] < camera["width_px"] - BORDER_PX
                    and BORDER_PX < place[1] < LOWEST_PX):
                continue
            radius, angle = 0.4 * sheet["bore_mm"] / 2 * chance.random(), 2 * math.pi * chance.random()
            click = image_of(settings, row, [center[0] + radius * math.cos(angle),
                                             center[1] + radius * math.sin(angle)])
            found.append((math.hypot(center[0] - axis[0], center[1] - axis[1]), address, click))
    return [(address, click) for _, address, click in sorted(found)]


def triangle(tubes):
    """The nearest three that do not lie in one line."""
    (first, _), rest = tubes[0], tubes[1:]
    for i, (second, _) in enumerate(rest):
        for k in range(i + 1, len(rest)):
            third = rest[k][0]
            if (second[0] - first[0]) * (third[1] - first[1]) != (
                    second[1] - first[1]) * (third[0] - first[0]):
                return [tubes[0], rest[i], rest[k]]
    return tubes[:3]


def as_start(tubes):
    return ";".join(f"{a[0]},{a[1]},{place[0]:.0f},{place[1]:.0f}" for a, place in tubes)


def main(source, out):
    source, out = pathlib.Path(source), pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    text = (source / "session.toml").read_text(encoding="utf-8")
    settings = tomllib.loads(text)
    width, height = settings["camera"]["width_px"], settings["camera"]["height_px"]
    frames = read_frames(source / "recording.y4m.xz", width, height)
    with open(source / "truth.csv", newline="", encoding="utf-8") as file:
        truth = list(csv.DictReader(file))
    chance = random.Random(5)
    groups, starts, starts9 = rests(truth, len(frames)), [], []
    with open(out / "truth.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, truth[0].keys())
        table.writeheader()
        for pose, group in enumerate(groups):
            fields = [truth[2 * frame + field] for frame in group for field in (0, 1)]
            row = dict(fields[0])
            for name in AVERAGED:
                row[name] = str(sum(float(field[name]) for field in fields) / len(fields))
            table.writerow(row)
            for i, frame in enumerate(group):
                (out / f"still-{pose}-{i}.pgm").write_bytes(
                    b"P5\n%d %d\n255\n" % (width, height) + frames[frame])
            tubes = nearest_tubes(settings, row, chance)
            starts.append(as_start(triangle(tubes)))
            starts9.append(as_start(tubes[:9]))
    (out / "session.toml").write_text(text, encoding="utf-8")
    (out / "start.txt").write_text("\n".join(starts) + "\n", encoding="utf-8")
    (out / "start9.txt").write_text("\n".join(starts9) + "\n", encoding="utf-8")
    print(f"{out}: {len(groups)} poses of {FRAMES} frames")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
