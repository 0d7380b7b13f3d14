#!/usr/bin/env python3
"""Errors of `tubesight calibrate tool`, and of the chain camera - tool - pose (docs/accuracy.md).

Usage: tool_accuracy.py PROGRAM STILLS [CAMERA] | tool_accuracy.py --self-test

STILLS holds session.toml, start.txt (a line a pose), still-POSE-FRAME.png and truth.csv; pose 0 is
docked on the tube and with the offset that truth.csv tells. Told: tip and axis by that docking against
the session's [tool], which took the pictures, and the EFL and the tip with the EFL freed. With CAMERA, a folder with target.toml and its pictures,
the camera is calibrated first, the tool with that camera, and then the other poses are computed with
both: the error across the tubes. Exit status 1 when the tip is off by more than 0.05 mm, the axis by
more than 0.03 degrees, or the chain by more than 0.05 mm RMS.
"""
import csv
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

MUST_TIP_MM = 0.05
MUST_AXIS_DEG = 0.03
MUST_CHAIN_MM = 0.05


def run(arguments):
    done = subprocess.run(arguments, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}")
    return done.stdout


def axis_of(degrees):
    """z axis of Rz(alpha) Ry(beta) Rx(gamma)."""
    a, b, c = (math.radians(value) for value in degrees)
    return (math.cos(a) * math.sin(b) * math.cos(c) + math.sin(a) * math.sin(c),
            math.sin(a) * math.sin(b) * math.cos(c) - math.cos(a) * math.sin(c),
            math.cos(b) * math.cos(c))


class Stills:
    def __init__(self, folder):
        self.folder = folder
        self.starts = (folder / "start.txt").read_text().split()
        with open(folder / "truth.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        per_pose = len(rows) // len(self.starts)
        self.truth = [rows[per_pose * pose] for pose in range(len(self.starts))]

    def pictures(self, pose):
        return sorted(str(path) for path in self.folder.glob(f"still-{pose}-*.png"))


def session_without(text, *tables):
    kept = []
    table = None
    for line in text.splitlines(keepends=True):
        head = re.fullmatch(r"\[([a-z_]+)\].*\n", line)
        table = head.group(1) if head else table
        if table not in tables:
            kept.append(line)
    return "".join(kept)


def with_focal_length(text, ratio):
    """The text with [camera]'s EFL times ratio, and the EFL that stood there."""
    found = re.search(r"^focal_length_mm = ([0-9.]+)", text, re.MULTILINE)
    told = float(found.group(1))
    return text[:found.start(1)] + f"{ratio * told:.6f}" + text[found.end(1):], told


def calibrate(program, stills, session, out, *more):
    docked = stills.truth[0]
    run([program, "calibrate", "tool", session, "--dock", f"{docked['near_row']},{docked['near_col']}",
         *stills.pictures(0), "--start", stills.starts[0], "--dock-offset-mm",
         f"{docked['off_x']},{docked['off_y']}", *more, "--out", out])
    return tomllib.loads(out.read_text())["tool"]


def freed(program, stills, text, told, work):
    """The EFL found at docking, from 2 % beside the true one to either side, and the tip with it."""
    for ratio in (0.98, 1.02):
        (work / "type.toml").write_text(with_focal_length(session_without(text, "tool"), ratio)[0])
        tool = calibrate(program, stills, work / "type.toml", work / "tool3.toml", "--free-efl")
        focal = tomllib.loads((work / "tool3.toml").read_text())
        right = with_focal_length(text, 1.0)[1]
        print(f"EFL freed from {ratio - 1:+.0%}: {focal['camera']['focal_length_mm'] - right:+.5f} mm off, "
              f"{focal['camera_quality']['sigma'][0]:.5f} mm promised; tip "
              f"{math.dist(tool['position_mm'], told['position_mm']):.4f} mm off")


def chain(program, stills, session, work):
    """Errors across the tubes, mm, of all poses but the docked one."""
    errors = []
    for pose in range(1, len(stills.starts)):
        table = work / "pose.csv"
        run([program, "pose", session, *stills.pictures(pose), "--average", "--start",
             stills.starts[pose], "--csv", table])
        with open(table, newline="") as file:
            row = next(csv.DictReader(file))
        truth = stills.truth[pose]
        errors.append(math.hypot(float(row["tool_x_mm"]) - float(truth["tool_x"]),
                                 float(row["tool_y_mm"]) - float(truth["tool_y"])))
    return errors


def main(program, folder, camera=None):
    stills = Stills(pathlib.Path(folder))
    text = (stills.folder / "session.toml").read_text()
    told = tomllib.loads(text)["tool"]
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        (work / "session.toml").write_text(session_without(text, "tool"))
        tool = calibrate(program, stills, work / "session.toml", work / "tool.toml")
        tip = math.dist(tool["position_mm"], told["position_mm"])
        cosine = sum(a * b for a, b in zip(axis_of(tool["rotation_deg"]), axis_of(told["rotation_deg"])))
        axis = math.degrees(math.acos(min(1.0, cosine)))
        print(f"docked: tip {tip:.4f} mm off (must {MUST_TIP_MM}, aim 0.02), axis {axis:.4f} deg "
              f"(must {MUST_AXIS_DEG}, aim 0.01)")
        good = tip <= MUST_TIP_MM and axis <= MUST_AXIS_DEG
        freed(program, stills, text, told, work)
        if camera is not None:
            run([program, "calibrate", "camera", pathlib.Path(camera) / "target.toml", "--out",
                 work / "camera.toml"])
            bare = session_without(text, "camera", "tool")
            (work / "c.toml").write_text('include = ["camera.toml"]\n' + bare)
            calibrate(program, stills, work / "c.toml", work / "tool2.toml")
            (work / "s.toml").write_text('include = ["camera.toml", "tool2.toml"]\n' + bare)
            errors = chain(program, stills, work / "s.toml", work)
            rms = math.sqrt(sum(error * error for error in errors) / len(errors))
            print(f"chain: {len(errors)} poses, across the tubes {rms:.4f} mm RMS, {max(errors):.4f} mm "
                  f"at worst (must {MUST_CHAIN_MM}, aim 0.025)")
            good = good and rms <= MUST_CHAIN_MM
    return 0 if good else 1


def self_test():
    text = ("# of a tool\n[camera]\nk = 1\n\n[tool]\nposition_mm = [1, 2, 3]\nx = [ { a = 1 },\n  [2] ]\n\n"
            "[start]\nb = 2\n")
    assert session_without(text, "tool") == "# of a tool\n[camera]\nk = 1\n\n[start]\nb = 2\n"
    assert session_without(text, "camera", "tool") == "# of a tool\n[start]\nb = 2\n"
    assert with_focal_length("[camera]\nfocal_length_mm = 5.0  # EFL\nk = 1\n", 1.02) == (
        "[camera]\nfocal_length_mm = 5.100000  # EFL\nk = 1\n", 5.0)
    assert math.dist(axis_of((30, 0, 0)), (0, 0, 1)) < 1e-12
    assert math.dist(axis_of((0, 90, 0)), (1, 0, 0)) < 1e-12
    assert math.dist(axis_of((0, 0, 90)), (0, -1, 0)) < 1e-12
    print("tool_accuracy: self-test passed")
    return 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(self_test())
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
