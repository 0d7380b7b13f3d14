#!/usr/bin/env python3
"""Replays recordings that come with their truth and prints how right the box was.

Usage: accuracy.py [--check] [--kind good|fair|hard] [--model-error PROGRAM] TUBESIGHT FOLDER...
       accuracy.py --self-test

Each FOLDER holds session.toml, recording.y4m.xz (or .y4m), truth.csv (a line a field) and centers.csv
(the true images of the tubes' centres, for some of the fields). TUBESIGHT is the program; PROGRAM the
one that predicts tube-ends not yet measured, looked for beside TUBESIGHT when it is not named.

The kind says which limits hold: `good` light and flush welds, `fair` (fillet welds, deposits, low
light), `hard`. Without --kind it is `fair` where the settings say fillet welds and `good` elsewhere.
With --check the exit status is 1 when a limit is broken.
"""
import argparse
import csv
import io
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib

# What the guidetube's tip may be off by before a field counts as clearly aligned, or clearly not.
GATE_TOLERANCE_MM = 0.3
# Nearer than this to half the pitch, two tubes are as good as equally near.
BETWEEN_TUBES_MM = 1.5
# Tube-ends that look smaller than this half height need not be measured.
LEAST_HALF_HEIGHT_PX = 8.0

# name, text, decimals, factor for printing, limits by kind ("<=" or ">=", value; in printed units)
FIGURES = [
    ("fields", "fields", 0, 1, {}),
    ("wrong_tube", "wrong tube vouched for, fields", 0, 1,
     {"good": ("<=", 0), "fair": ("<=", 0), "hard": ("<=", 0)}),
    ("false_aligned", "falsely aligned, fields", 0, 1,
     {"good": ("<=", 0), "fair": ("<=", 0), "hard": ("<=", 0)}),
    ("wrong_nearest", "wrong nearest tube, fields", 0, 1,
     {"good": ("<=", 0), "fair": ("<=", 0), "hard": ("<=", 0)}),
    ("truly_aligned", "truly aligned, fields", 0, 1, {}),
    ("missed", "missed of those, %", 2, 100, {"good": ("<=", 0.5), "fair": ("<=", 5)}),
    ("answered", "answered, %", 2, 100, {"good": (">=", 100), "fair": (">=", 97)}),
    ("degraded", "of them degraded, %", 2, 100, {"good": ("<=", 2)}),
    ("given", "tool tube given, %", 2, 100, {"good": (">=", 99), "fair": (">=", 95)}),
    ("offset_rms_mm", "offset RMS, mm", 4, 1, {"good": ("<=", 0.25), "fair": ("<=", 0.40)}),
    ("offset_max_mm", "offset, largest error, mm", 4, 1, {}),
    ("height_rms_mm", "height RMS, mm", 4, 1, {"good": ("<=", 0.5), "fair": ("<=", 1)}),
    ("measured_share", "tube-ends measured, %", 2, 100, {"good": (">=", 95), "fair": (">=", 80)}),
    ("centers_compared", "centres compared", 0, 1, {}),
    ("centers_rms_px", "centres RMS, px", 4, 1, {"good": ("<=", 0.20), "fair": ("<=", 0.40)}),
    ("centers_median_px", "centres, median, px", 4, 1, {}),
    ("centers_p95_px", "centres, 95 %, px", 4, 1, {}),
    ("ellipse_rms_px", "ellipse's centre off the true one, RMS, px", 4, 1, {}),
    ("between_rms", "model error between measured, % of minor radius", 3, 1, {"good": ("<=", 5)}),
    ("between_max", "  largest", 3, 1, {}),
    ("beyond_rms", "model error beyond measured, % of minor radius", 3, 1, {"good": ("<=", 5)}),
    ("beyond_max", "  largest", 3, 1, {}),
]


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values)) if values else math.nan


def quantile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))] if values else math.nan


def share(part, whole):
    return part / whole if whole else math.nan


def shortest_step_mm(sheet):
    """The distance of the nearest two addresses that exist; the judge's own, not the program's."""
    row, column = sheet["row_step_mm"], sheet["column_step_mm"]
    every_other = sheet.get("addresses", "all") != "all"
    shift = sheet.get("odd_row_shift", 0.0)  # from an even row to an odd one; back is the opposite
    steps = [(r, c) for r in range(-3, 4) for c in range(-3, 4)
             if (r, c) != (0, 0) and not (every_other and (r + c) % 2)]
    return min(math.hypot(*(r * row[i] + (c + r % 2 * shift) * column[i] for i in (0, 1)))
               for r, c in steps)


def field_number(line, scan):
    """Fields count in time: twice the frame's number, plus 1 for the later field of a frame."""
    later = int(line["field"]) if scan != "odd-first" else 1 - int(line["field"])
    return 2 * int(line["frame"]) + (later if scan != "progressive" else 0)


def score_fields(settings, fields, truth):
    """The figures of the guidetube: which tube, vouched for or not, offset and height."""
    gate_mm = settings.get("verification", {}).get("aligned_within_mm", 2.5)
    clear_mm = shortest_step_mm(settings["tubesheet"]) / 2 - BETWEEN_TUBES_MM
    scan = settings["camera"]["scan"]
    count = dict.fromkeys(["answered", "degraded", "truly_aligned", "missed", "wrong_tube",
                           "false_aligned", "wrong_nearest", "clear", "given"], 0)
    offset_errors, height_errors = [], []
    by_number = {int(row["field"]): row for row in fields}
    for true in truth:
        true_offset = float(true["offset_mm"])
        true_tube = (true["near_row"], true["near_col"])
        stands = true["near_state"] != "void"
        truly_aligned = stands and true_offset <= gate_mm - GATE_TOLERANCE_MM
        clear = stands and true_offset < clear_mm
        count["truly_aligned"] += truly_aligned
        count["clear"] += clear
        row = by_number.get(field_number(true, scan))
        aligned = row is not None and row["aligned"] == "1"
        count["missed"] += truly_aligned and not aligned
        if row is None:
            continue
        count["answered"] += row["state"] in ("tracking", "degraded")
        count["degraded"] += row["state"] == "degraded"
        given = row["tool_row"] != ""
        right = given and stands and (row["tool_row"], row["tool_column"]) == true_tube
        count["given"] += clear and given
        count["wrong_nearest"] += clear and given and not right
        count["wrong_tube"] += aligned and not right
        count["false_aligned"] += aligned and true_offset > gate_mm + GATE_TOLERANCE_MM
        if right and row["tool_offset_mm"]:
            offset_errors.append(float(row["tool_offset_mm"]) - true_offset)
        if row["tool_height_mm"]:
            height_errors.append(float(row["tool_height_mm"]) + float(true["tool_z"]))
    figures = {name: count[name]
               for name in ("truly_aligned", "wrong_tube", "false_aligned", "wrong_nearest")}
    figures.update(
        fields=len(truth), answered=share(count["answered"], len(truth)),
        degraded=count["degraded"] / max(1, count["answered"]),
        missed=count["missed"] / max(1, count["truly_aligned"]),
        given=share(count["given"], count["clear"]), offset_rms_mm=rms(offset_errors),
        offset_max_mm=max(map(abs, offset_errors), default=math.nan),
        height_rms_mm=rms(height_errors))
    return figures


def visible(true):
    return (true["state"] == "open" and float(true["occluded"]) == 0
            and float(true["rim_in_frame"]) == 1)


def inside(window, u, v, half_u=0.0, half_v=0.0):
    return (window[0] <= u - half_u and u + half_u <= window[2]
            and window[1] <= v - half_v and v + half_v <= window[3])


def score_centers(settings, centers, true_centers):
    """The figures of the measured tube-ends, over the fields that the truth lists."""
    window = settings["start"]["window_px"]
    errors, bias, hit = [], [], set()
    for row in centers:
        key = (int(row["field"]), int(row["row"]), int(row["column"]))
        true = true_centers.get(key)
        if true is None or not visible(true) or float(row["quality"]) <= 0:
            continue
        u, v = float(true["x_f"]), float(true["y_f"])
        if inside(window, u, v):
            hit.add(key)
            errors.append(math.hypot(float(row["u_px"]) - u, float(row["v_px"]) - v))
            bias.append(math.hypot(float(true["ell_x"]) - u, float(true["ell_y"]) - v))
    wanted = {key for key, true in true_centers.items()
              if visible(true) and float(true["half_h"]) >= LEAST_HALF_HEIGHT_PX
              and inside(window, float(true["x_f"]), float(true["y_f"]), float(true["half_w"]),
                         float(true["half_h"]))}
    return {"centers_compared": len(errors), "measured_share": share(len(wanted & hit), len(wanted)),
            "centers_rms_px": rms(errors), "centers_median_px": quantile(errors, 0.5),
            "centers_p95_px": quantile(errors, 0.95), "ellipse_rms_px": rms(bias)}


def score_predictions(predictions, true_centers):
    """Eq. 6.26: distances of predicted from true centres, in % of the ellipse's minor radius."""
    errors = {"between": [], "beyond": []}
    for row in predictions:
        true = true_centers.get((int(row["field"]), int(row["row"]), int(row["column"])))
        if true is not None and visible(true):
            distance = math.hypot(float(row["u_px"]) - float(true["x_f"]),
                                  float(row["v_px"]) - float(true["y_f"]))
            errors[row["split"]].append(100 * distance / float(row["minor_radius_px"]))
    figures = {}
    for split, values in errors.items():
        figures[f"{split}_rms"] = rms(values)
        figures[f"{split}_max"] = max(values, default=math.nan)
    return figures


def broken(figures, kind):
    """The limits that do not hold, as lines. A figure that could not be told breaks its limit."""
    lines = []
    for name, text, decimals, factor, limits in FIGURES:
        if kind not in limits:
            continue
        sign, limit = limits[kind]
        value = figures[name] * factor
        if not (value <= limit if sign == "<=" else value >= limit):
            lines.append(f"{text.strip()}: {value:.{decimals}f}, expected {sign} {limit}")
    return lines


def run(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"accuracy: {' '.join(map(str, command))}: exit status {done.returncode}")
    return done.stdout


def recording_of(folder):
    packed = folder / "recording.y4m.xz"
    return packed if packed.exists() else folder / "recording.y4m"


def score_folder(tubesight, model_error, folder):
    with open(folder / "session.toml", "rb") as file:
        settings = tomllib.load(file)
    with tempfile.TemporaryDirectory() as out:
        fields, centers = pathlib.Path(out, "fields.csv"), pathlib.Path(out, "centers.csv")
        run([tubesight, "replay", folder / "session.toml", recording_of(folder),
             "--fields", fields, "--centers", centers])
        figures = score_fields(settings, read_csv(fields), read_csv(folder / "truth.csv"))
        true_centers = {(field_number(row, settings["camera"]["scan"]), int(row["row"]),
                         int(row["col"])): row for row in read_csv(folder / "centers.csv")}
        figures.update(score_centers(settings, read_csv(centers), true_centers))
    predictions = list(csv.DictReader(io.StringIO(run([model_error, folder]))))
    figures.update(score_predictions(predictions, true_centers))
    weld = settings["tubesheet"].get("weld", "flush")
    return figures, "fair" if weld == "fillet" else "good"


def print_table(names, kinds, scores):
    width = max(len(text) for _, text, _, _, _ in FIGURES)
    columns = [max(len(name), 10) for name in names]
    print(" " * width, *(f"{name:>{size}}" for name, size in zip(names, columns)))
    print(f"{'limits':{width}}", *(f"{kind:>{size}}" for kind, size in zip(kinds, columns)))
    for name, text, decimals, factor, _ in FIGURES:
        cells = [f"{figures[name] * factor:>{size}.{decimals}f}"
                 for figures, size in zip(scores, columns)]
        print(f"{text:{width}}", *cells)


# --- Self-test: three fields and three tube-ends whose figures were worked out by hand ---------------

SELF_TEST_SETTINGS = {
    "camera": {"scan": "odd-first"},
    "tubesheet": {"row_step_mm": [0.0, 20.0], "column_step_mm": [20.0, 0.0]},
    "start": {"window_px": [0, 0, 100, 100]},
}
TRUTH = """frame,field,tool_z,near_row,near_col,near_state,offset_mm
0,1,-60.0,4,7,open,1.0
0,0,-60.0,4,7,open,2.0
1,1,-60.0,4,8,open,3.0
1,0,-60.0,4,8,open,9.0
2,1,-60.0,4,9,void,0.5
2,0,-60.0,4,8,open,0.1
"""
FIELDS = """field,state,tool_row,tool_column,tool_offset_mm,tool_height_mm,aligned
0,tracking,4,7,1.3,60.0,1
1,tracking,4,8,2.0,60.0,1
2,tracking,4,8,3.4,60.6,1
3,degraded,4,7,,60.0,0
4,tracking,4,9,0.5,60.0,1
"""
TRUE_CENTERS = """frame,field,row,col,state,x_f,y_f,ell_x,ell_y,half_w,half_h,rim_in_frame,occluded
0,1,1,1,open,50.0,50.0,50.0,50.5,10,9,1.00,0.00
0,1,1,2,open,80.0,50.0,80.0,50.5,10,9,1.00,0.00
0,1,1,3,plug_flush,20.0,20.0,20.0,20.5,10,9,1.00,0.00
0,0,1,1,open,95.0,50.0,95.0,50.5,10,9,1.00,0.00
"""
CENTERS = """field,row,column,u_px,v_px,quality
0,1,1,50.3,50.4,0.9
0,1,2,81.0,50.0,0.0
0,1,3,29.0,20.0,0.9
1,1,1,95.0,50.1,0.5
"""
PREDICTIONS = """split,field,row,column,u_px,v_px,measured_u_px,measured_v_px,minor_radius_px
between,0,1,1,50.3,50.4,0,0,10.0
between,0,1,3,29.0,20.0,0,0,10.0
beyond,0,1,2,80.0,51.0,0,0,10.0
"""
# Field 1 vouches for the neighbour; 2 is aligned though 3.0 mm off; 4 vouches in a void; 5 is not there.
# Fields 0, 1, 2 and 5 are clear (offset below 20 / 2 - 1.5 mm, a tube stands), three of them given.
EXPECTED = {
    "fields": 6, "wrong_tube": 2, "false_aligned": 1, "wrong_nearest": 1, "truly_aligned": 3,
    "missed": 1 / 3, "answered": 5 / 6, "degraded": 1 / 5, "given": 3 / 4,
    "offset_rms_mm": math.sqrt((0.09 + 0.16) / 2), "offset_max_mm": 0.4,
    "height_rms_mm": math.sqrt(0.36 / 5), "centers_compared": 2, "measured_share": 0.5,
    "centers_rms_px": math.sqrt((0.25 + 0.01) / 2), "centers_median_px": 0.5,
    "centers_p95_px": 0.5, "ellipse_rms_px": 0.5, "between_rms": 5.0, "between_max": 5.0,
    "beyond_rms": 10.0, "beyond_max": 10.0,
}


def self_test():
    def table(text):
        return list(csv.DictReader(io.StringIO(text)))
    true_centers = {(field_number(row, "odd-first"), int(row["row"]), int(row["col"])): row
                    for row in table(TRUE_CENTERS)}
    figures = score_fields(SELF_TEST_SETTINGS, table(FIELDS), table(TRUTH))
    figures.update(score_centers(SELF_TEST_SETTINGS, table(CENTERS), true_centers))
    figures.update(score_predictions(table(PREDICTIONS), true_centers))
    wrong = [f"{name}: {figures.get(name)}, expected {value}" for name, value in EXPECTED.items()
             if not math.isclose(figures.get(name, math.nan), value, abs_tol=1e-9)]
    wrong += [f"{name}: surplus" for name in figures if name not in EXPECTED]
    kept = {name: 0.0 for name, *_ in FIGURES} | {"answered": 1, "given": 1, "measured_share": 1}
    if broken(kept, "good") or broken(kept, "fair"):
        wrong.append("limits are broken by figures that keep them")
    for name, _, _, _, limits in FIGURES:
        if "good" in limits:
            for bad in (math.nan, 0.5 if limits["good"][0] == ">=" else 100):
                if len(broken(kept | {name: bad}, "good")) != 1:
                    wrong.append(f"{name} = {bad}: the broken limit is not noticed")
    if shortest_step_mm({"row_step_mm": [0.0, 8.0], "column_step_mm": [6.0, 0.0],
                         "addresses": "even-sum"}) != 10.0:
        wrong.append("shortest step of every other address: expected 10 mm")
    if shortest_step_mm({"row_step_mm": [0.0, 12.0], "column_step_mm": [18.0, 0.0],
                         "odd_row_shift": 0.5}) != 15.0:
        wrong.append("shortest step of shifted rows: expected 15 mm")
    for line in wrong:
        print(line)
    print(f"accuracy --self-test: {len(wrong)} problems in {len(EXPECTED)} figures")
    return 1 if wrong else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--kind", choices=["good", "fair", "hard"])
    parser.add_argument("--model-error", type=pathlib.Path)
    parser.add_argument("tubesight", type=pathlib.Path)
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    options = parser.parse_args()
    model_error = options.model_error or options.tubesight.with_name("model_error")
    scores, kinds, problems = [], [], []
    for folder in options.folders:
        figures, kind = score_folder(options.tubesight.resolve(), model_error.resolve(), folder)
        scores.append(figures)
        kinds.append(options.kind or kind)
        problems += [f"{folder.name}: {line}" for line in broken(figures, kinds[-1])]
    print_table([folder.resolve().name for folder in options.folders], kinds, scores)
    for line in problems:
        print(line)
    return 1 if options.check and problems else 0


if __name__ == "__main__":
    sys.exit(main())
