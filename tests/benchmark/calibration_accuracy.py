#!/usr/bin/env python3
"""Errors of `tubesight calibrate camera` against the truth of a ray-traced template (docs/accuracy.md).

Usage: calibration_accuracy.py PROGRAM FOLDER | calibration_accuracy.py --self-test

FOLDER holds target.toml with its pictures, and truth.json with the camera that took them. Told: the
error of EFL, and that of the map from pixels to rays over the picture, in pixels: the difference of the
rays' places on the ideal plane over EFL, times the true EFL in pixels, on a grid of every fifth pixel.
Beside them what the program promised. Exit status 1 when the map is off by more than 0.05 px RMS or
EFL by more than 0.0008 mm.
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

MUST_MAP_PX = 0.05
MUST_EFL_MM = 0.0008


def camera_of(settings):
    return {"efl": settings["focal_length_mm"], "dx": settings["cell_width_mm"],
            "dy": settings["cell_height_mm"], "ncx": settings["sensor_columns"],
            "nfx": settings["frame_columns"], "hsx": settings["horizontal_scale"],
            "cu": settings["center_px"][0], "cv": settings["center_px"][1],
            "k": settings["distortion_per_mm2"], "k2": settings.get("distortion2_per_mm4", 0.0)}


def truth_of(truth):
    return {"efl": truth["EFL_mm"], "dx": truth["dx_mm"], "dy": truth["dy_mm"], "ncx": truth["Ncx"],
            "nfx": truth["Nfx"], "hsx": truth["hsx"], "cu": truth["cu"], "cv": truth["cv"],
            "k": truth["kx_per_mm2"], "k2": 0.0}


def ray(camera, u, v):
    """Slopes of the ray of a pixel."""
    x = camera["dx"] * camera["ncx"] / camera["nfx"] / camera["hsx"] * (u - camera["cu"])
    y = camera["dy"] * (v - camera["cv"])
    r2 = x * x + y * y
    factor = (1.0 + camera["k"] * r2 + camera["k2"] * r2 * r2) / camera["efl"]
    return x * factor, y * factor


def map_error(camera, truth, width, height):
    """RMS and largest error of the map, px."""
    across = truth["efl"] * truth["hsx"] * truth["nfx"] / truth["ncx"] / truth["dx"]
    down = truth["efl"] / truth["dy"]
    errors = []
    for v in range(0, height, 5):
        for u in range(0, width, 5):
            a, b = ray(camera, u, v), ray(truth, u, v)
            errors.append(math.hypot(across * (a[0] - b[0]), down * (a[1] - b[1])))
    return math.sqrt(sum(e * e for e in errors) / len(errors)), max(errors)


def run(program, folder):
    truth = truth_of(json.loads((folder / "truth.json").read_text(encoding="utf-8"))["camera"])
    with tempfile.TemporaryDirectory() as work:
        out = pathlib.Path(work) / "c.toml"
        done = subprocess.run([program, "calibrate", "camera", folder / "target.toml", "--out", out],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stderr)
        settings = tomllib.loads(out.read_text(encoding="utf-8"))
    camera = camera_of(settings["camera"])
    rms, worst = map_error(camera, truth, settings["camera"]["width_px"],
                           settings["camera"]["height_px"])
    efl = camera["efl"] - truth["efl"]
    promised = re.search(r"map uncertainty +([\d.]+) px RMS.*, ([\d.]+) px at", done.stdout)
    print(f"map: {rms:.4f} px RMS, {worst:.4f} px at worst (promised, one sigma: "
          f"{promised.group(1)}, {promised.group(2)})")
    print(f"EFL: {efl:+.5f} mm (promised {settings['camera_quality']['sigma'][0]:.5f})")
    return rms <= MUST_MAP_PX and abs(efl) <= MUST_EFL_MM


def self_test():
    truth = {"efl": 5.0, "dx": 0.01, "dy": 0.01, "ncx": 640, "nfx": 640, "hsx": 1.0, "cu": 320.0,
             "cv": 240.0, "k": 0.01, "k2": 0.0}
    assert map_error(truth, truth, 640, 480) == (0.0, 0.0)
    # A centre that is off moves every ray by about as much.
    rms, worst = map_error({**truth, "cu": 320.5}, truth, 640, 480)
    assert 0.49 < rms < 0.75 and worst < 1.0, (rms, worst)
    # An EFL 1 % too long shortens slopes: 3.2 px at the edge of the middle line, undistorted.
    worst = map_error({**truth, "efl": 5.05, "k": 0.0}, {**truth, "k": 0.0}, 641, 1)[1]
    assert abs(worst - 400.0 * (1.0 - 1.0 / 1.01)) < 0.01, worst
    print("calibration_accuracy: self-test passed")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
    else:
        sys.exit(0 if run(sys.argv[1], pathlib.Path(sys.argv[2])) else 1)
