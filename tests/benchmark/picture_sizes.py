#!/usr/bin/env python3
"""What the size of the camera's picture changes: accuracy, and the cost of a tube-end.

Usage: picture_sizes.py [--check] [--sizes N,N...] TUBESIGHT [TRACK_FIELDS]
       picture_sizes.py --self-test

Draws one scene, at rest and moving at 120 mm/s, through the same lens onto the same sensor with
other columns and lines (`tubesight simulate`), tracks it (`replay`), and prints against the truth:
the RMS of the tube-ends' centres, of the guidetube's offset, the greatest of these, and with
TRACK_FIELDS, the program of that name, the instructions of the tracking path a tube-end, the window
narrowed to 24 of them. --sizes takes those of these columns alone. With --check the exit status is
1 when a limit is broken.
"""
import argparse
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

import instructions

# Columns, lines, scan, frames a second.
SIZES = ((320, 240, "even-first", 30), (320, 240, "progressive", 60), (640, 480, "progressive", 60),
         (720, 576, "even-first", 25), (1280, 960, "progressive", 60),
         (1920, 1200, "even-first", 60), (1920, 1200, "progressive", 120))
MOST_CENTER_PX = 0.12
MOST_OFFSET_PX = 0.35  # of the same sensor's columns: 0.35 mm at 320
MOST_PER_TUBE = 22_000

SCENE = """\
[camera]
width_px = {width}
height_px = {height}
scan = "{scan}"
focal_length_mm = 5.06
cell_width_mm = {cell_width:.9f}
cell_height_mm = {cell_height:.9f}
sensor_columns = {width}
frame_columns = {width}
horizontal_scale = 1.0
center_px = [{center_u:.2f}, {center_v:.2f}]
distortion_per_mm2 = 0.0092
[tool]
position_mm = [-3.074, 31.629, 112.789]
rotation_deg = [-0.0639, -0.8174, 47.9947]
[start]
window_px = [{left}, {top}, {right}, {bottom}]
optimum_px = [{optimum_u}, {optimum_v}]
[tubesheet]
row_step_mm = [0.0, 25.4]
column_step_mm = [25.4, 0.0]
bore_mm = 18.6
rows = [0, 120]
columns = [0, 120]
[scenario]
seed = 77
[video]
rate_hz = {rate}
[path]
tube = [40, 60]
height_mm = 60
offset_mm = [0.4, -0.3]
heading_deg = 2.0
lean_deg = [-0.1, 0.15]
speed_mm_s = 120
[[step]]
rest_s = 0.2
[[step]]
to = [41, 62]
[[step]]
rest_s = 0.1
"""


def scenario(width, height, scan, rate):
    return SCENE.format(
        width=width, height=height, scan=scan, rate=rate, cell_width=6.4 / width,
        cell_height=4.8 / height, center_u=0.51 * width, center_v=0.487 * height,
        left=width // 16, top=height // 13, right=width * 15 // 16, bottom=height * 11 // 16,
        optimum_u=width // 2, optimum_v=height * 2 // 5)


def rows(path):
    with open(path, newline="", encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def rms(squares):
    return math.sqrt(sum(squares) / len(squares)) if squares else math.nan


def judged(fields, centers, truth, true_centers, scan):
    """RMS of centres (px) and of offsets (mm), the greatest offset, wrong tubes, fields lost."""
    step = 2 if scan == "progressive" else 1
    true_at = {(2 * int(row["frame"]) + int(row["field"]), row["row"], row["col"]): row
               for row in true_centers}
    offsets, wrong, lost = [], 0, 0
    for field in fields:
        true = truth[int(field["field"]) // step]
        lost += field["state"] != "tracking"
        if not field["tool_row"]:
            continue
        if (field["tool_row"], field["tool_column"]) != (true["near_row"], true["near_col"]):
            wrong += field["aligned"] == "1"
            continue
        offsets.append((float(field["tool_dx_mm"]) - float(true["off_x"])) ** 2
                       + (float(field["tool_dy_mm"]) - float(true["off_y"])) ** 2)
    squares = []
    for center in centers:
        true = true_at.get((int(center["field"]), center["row"], center["column"]))
        if true is not None and float(center["quality"]) > 0:
            squares.append((float(center["u_px"]) - float(true["x_f"])) ** 2
                           + (float(center["v_px"]) - float(true["y_f"])) ** 2)
    return {"center_px": rms(squares), "offset_mm": rms(offsets),
            "greatest_mm": math.sqrt(max(offsets, default=math.nan)), "wrong": wrong, "lost": lost}


def run(program, folder, *arguments):
    done = subprocess.run([str(program), *arguments], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"picture_sizes: {' '.join(arguments)}: {done.stderr.strip()}")


def measure(size, program, track_fields):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        (out / "scene.toml").write_text(scenario(*size), encoding="utf-8")
        run(program, folder, "simulate", "scene.toml", "--out", "r", "--window-only")
        run(program, folder, "replay", "r.session.toml", "r.y4m", "--fields", "f.csv",
            "--centers", "c.csv")
        result = judged(*(rows(out / name) for name in
                          ("f.csv", "c.csv", "r.truth.csv", "r.centers.csv")), size[2])
        result["per_tube"] = None
        if track_fields is not None:
            (out / "r.session.toml").rename(out / "session.toml")
            (out / "r.y4m").rename(out / "recording.y4m")
            count = instructions.count(track_fields, out, instructions.TUBES, 0)
            result["per_tube"] = count["instructions"] / count["tubes"]
    return result


def broken(width, result):
    problems = []
    if result["wrong"] or result["lost"]:
        problems.append(f"{result['wrong']} wrong tubes, {result['lost']} fields not tracked, "
                        "expected none")
    if not result["center_px"] <= MOST_CENTER_PX:
        problems.append(f"centres {result['center_px']:.3f} px, expected at most {MOST_CENTER_PX}")
    most_mm = MOST_OFFSET_PX * 320 / width
    if not result["offset_mm"] <= most_mm:
        problems.append(f"offset {result['offset_mm']:.4f} mm, expected at most {most_mm:.4f}")
    if result["per_tube"] is not None and not 1000 <= result["per_tube"] <= MOST_PER_TUBE:
        problems.append(f"{result['per_tube']:.0f} instructions a tube-end, "
                        f"expected 1000 (was it counted at all?) to {MOST_PER_TUBE}")
    return problems


def self_test():
    good = {"center_px": 0.1, "offset_mm": 0.05, "wrong": 0, "lost": 0, "per_tube": 20_000}
    wrong = [f"refused without reason: {line}" for line in broken(1920, good)]
    for change in ({"center_px": 0.121}, {"center_px": math.nan}, {"offset_mm": 0.06}, {"wrong": 1},
                   {"lost": 1}, {"per_tube": 22_001}, {"per_tube": 0}):
        if len(broken(1920, good | change)) != 1:
            wrong.append(f"{change}: not noticed")
    field = {"field": "2", "state": "tracking", "tool_row": "1", "tool_column": "2",
             "tool_dx_mm": "0.5", "tool_dy_mm": "0.0", "aligned": "1"}
    truth = [{}, {"near_row": "1", "near_col": "2", "off_x": "0.1", "off_y": "0.3"}]
    center = {"field": "2", "row": "1", "column": "2", "u_px": "3.0", "v_px": "4.0",
              "quality": "0.5"}
    true_center = {"frame": "1", "field": "0", "row": "1", "col": "2", "x_f": "0", "y_f": "0"}
    result = judged([field], [center], truth, [true_center], "progressive")
    if (result["center_px"], result["wrong"], result["lost"]) != (5.0, 0, 0) or \
            abs(result["offset_mm"] - 0.5) > 1e-12:
        wrong.append(f"misjudged: {result}")
    result = judged([field | {"tool_row": "9", "state": "degraded"}], [], truth, [], "progressive")
    if (result["wrong"], result["lost"]) != (1, 1):
        wrong.append(f"a wrong tube is not noticed: {result}")
    for line in wrong:
        print(line)
    print(f"picture_sizes --self-test: {len(wrong)} problems")
    return 1 if wrong else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--sizes", default="")
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("track_fields", type=pathlib.Path, nargs="?")
    options = parser.parse_args()
    wanted = [int(columns) for columns in options.sizes.split(",") if columns]
    track_fields = options.track_fields.resolve() if options.track_fields else None
    problems = []
    print(f"{'picture':30} {'centres, px':>12} {'offset, mm':>11} {'greatest':>9} {'a tube-end':>11}")
    for size in SIZES:
        if wanted and size[0] not in wanted:
            continue
        result = measure(size, options.program.resolve(), track_fields)
        name = f"{size[0]} x {size[1]} {size[2]}, {size[3]} a second"
        cost = f"{result['per_tube']:11.0f}" if result["per_tube"] is not None else f"{'-':>11}"
        print(f"{name:30} {result['center_px']:12.3f} {result['offset_mm']:11.4f} "
              f"{result['greatest_mm']:9.4f} {cost}", flush=True)
        problems += [f"{name}: {line}" for line in broken(size[0], result)]
    for line in problems:
        print(line)
    return 1 if options.check and problems else 0


if __name__ == "__main__":
    sys.exit(main())
