#!/usr/bin/env python3
"""What a camera's calibration by type costs a pose, with EFL held and freed at docking (docs/accuracy.md).

Usage: type_sensitivity.py PROGRAM STILLS [DRAWS] | type_sensitivity.py --self-test

STILLS as of tool_accuracy.py. The session's [camera], which took the pictures, is made that of another
unit of its type: each parameter in turn off by twice its scatter from unit to unit (calibrate camera
--type), then all together, drawn at random. The tool is docked with each, EFL as the type has it and
freed (--free-efl), and the other poses are computed: their error across the tubes. Exit status 1 when a
freed one is off by half a tube's pitch or names a wrong tube.
"""
import csv
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import tomllib

import tool_accuracy

# As core/calibration/camera_type.h: of EFL, h_sx and k a share, of the centre pixels.
SCATTER = {"EFL": 0.01, "h_sx": 0.001, "c_u": 4.0, "c_v": 4.0, "k": 0.03}


def other_unit(camera, off):
    """[camera] of a unit that differs by so much."""
    unit = dict(camera)
    unit["focal_length_mm"] *= 1.0 + off.get("EFL", 0.0)
    unit["horizontal_scale"] *= 1.0 + off.get("h_sx", 0.0)
    unit["center_px"] = [camera["center_px"][0] + off.get("c_u", 0.0),
                         camera["center_px"][1] + off.get("c_v", 0.0)]
    unit["distortion_per_mm2"] *= 1.0 + off.get("k", 0.0)
    return unit


def camera_text(camera):
    def value(entry):
        return f'"{entry}"' if isinstance(entry, str) else str(entry)
    return "[camera]\n" + "".join(f"{key} = {value(entry)}\n" for key, entry in camera.items())


def errors_of(program, stills, camera, bare, freed, work):
    """Errors across the tubes of the poses beside the docked one, mm, and wrong tubes; or why not."""
    docked = stills.truth[0]
    (work / "c.toml").write_text(camera_text(camera) + bare)
    done = subprocess.run(
        [program, "calibrate", "tool", work / "c.toml", "--dock",
         f"{docked['near_row']},{docked['near_col']}", *stills.pictures(0), "--start",
         stills.starts[0], "--dock-offset-mm", f"{docked['off_x']},{docked['off_y']}", "--out",
         work / "tool.toml", *(["--free-efl"] if freed else [])],
        capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return None, done.stderr.strip()
    (work / "s.toml").write_text('include = ["tool.toml"]\n' + bare if freed else
                                 'include = ["tool.toml"]\n' + camera_text(camera) + bare)
    errors, wrong = [], 0
    for pose in range(1, len(stills.starts)):
        table = work / "pose.csv"
        tool_accuracy.run([program, "pose", work / "s.toml", *stills.pictures(pose), "--average",
                           "--start", stills.starts[pose], "--csv", table])
        with open(table, newline="", encoding="utf-8") as file:
            row = next(csv.DictReader(file))
        truth = stills.truth[pose]
        errors.append(math.hypot(float(row["tool_x_mm"]) - float(truth["tool_x"]),
                                 float(row["tool_y_mm"]) - float(truth["tool_y"])))
        wrong += (row["row"], row["column"]) != (truth["near_row"], truth["near_col"])
    return errors, wrong


def main(program, folder, draws="8"):
    stills = tool_accuracy.Stills(pathlib.Path(folder))
    text = (stills.folder / "session.toml").read_text()
    settings = tomllib.loads(text)
    pitch = min(math.hypot(*settings["tubesheet"][step]) for step in ("row_step_mm", "column_step_mm"))
    bare = tool_accuracy.session_without(text, "camera", "tool")
    units = [("as it is", [{}])]
    units += [(f"{name} {2 * SCATTER[name]:+g}", [{name: 2.0 * SCATTER[name]}]) for name in SCATTER]
    numbers = random.Random(4)
    units.append((f"all, {draws} drawn", [{name: numbers.gauss(0.0, sigma)
                                           for name, sigma in SCATTER.items()}
                                          for _ in range(int(draws))]))
    good = True
    with tempfile.TemporaryDirectory() as name:
        for title, offs in units:
            line = f"{title:16}"
            for freed in (False, True):
                found, wrong, refused = [], 0, 0
                for off in offs:
                    errors, bad = errors_of(program, stills, other_unit(settings["camera"], off), bare,
                                            freed, pathlib.Path(name))
                    if errors is None:
                        refused += 1
                        continue
                    found += errors
                    wrong += bad
                if found:
                    rms = math.sqrt(sum(error * error for error in found) / len(found))
                    line += (f"  EFL {'freed' if freed else 'held'}: {rms:.3f} mm RMS, "
                             f"{max(found):.3f} at worst, {wrong} wrong tubes")
                if refused:
                    line += f", {refused} refused"
                good = good and not (freed and found and (max(found) > 0.5 * pitch or wrong))
            print(line, flush=True)
    return 0 if good else 1


def self_test():
    camera = {"focal_length_mm": 5.0, "horizontal_scale": 1.0, "center_px": [320.0, 240.0],
              "distortion_per_mm2": 0.01, "scan": "progressive"}
    assert other_unit(camera, {}) == camera
    unit = other_unit(camera, {"EFL": 0.01, "c_v": 4.0, "k": -0.03})
    assert abs(unit["focal_length_mm"] - 5.05) < 1e-12 and unit["center_px"] == [320.0, 244.0]
    assert abs(unit["distortion_per_mm2"] - 0.0097) < 1e-12
    assert tomllib.loads(camera_text(unit))["camera"] == unit
    print("type_sensitivity: self-test passed")
    return 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(self_test())
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
