#!/usr/bin/env python3
"""How right poses are: runs `tubesight pose` on stills that come with their truth.

Usage: pose_accuracy.py TUBESIGHT FOLDER [FOLDER ...] [--frames N] [--variants] [--poses]
                        [--check]

FOLDER holds session.toml, truth.csv (a row a pose), start.txt and start9.txt (a line a pose, as
--start takes it) and still-POSE-FRAME.png or .pgm (rest_stills.py makes such a folder). Of each pose the first N stills (4) are averaged. Prints
the RMS and the largest error: lateral, height and tilt, once from all tube-ends and once from the
up to nine of start9.txt alone. --variants adds the other methods of fitting and of placing edges,
--poses each pose by itself, with its error in units of its own standard deviation. With --check the
exit status is 1 when a pose is refused or a limit that must hold is broken.
"""
import argparse
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

METHODS = ["rims", "centers", "tangent-points", "tangent-lines", "ellipse-centers"]
EDGES = ["step", "mid-level", "moment"]
LIMITS = {  # must, aim
    ("nine", "lateral"): (0.030, 0.018), ("all", "lateral"): (0.010, 0.005),
    ("all", "height"): (0.015, 0.005), ("all", "tilt"): (0.012, 0.005),
    ("all", "worst lateral"): (0.030, 0.012),
}


def rotation(alpha, beta, gamma):
    ca, sa, cb, sb = math.cos(alpha), math.sin(alpha), math.cos(beta), math.sin(beta)
    cg, sg = math.cos(gamma), math.sin(gamma)
    return [[ca * cb, ca * sb * sg - sa * cg, ca * sb * cg + sa * sg],
            [sa * cb, sa * sb * sg + ca * cg, sa * sb * cg - ca * sg],
            [-sb, cb * sg, cb * cg]]


def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else float("nan")


class Errors:
    """Of one still: T_sheet_tool as told against the truth."""

    def __init__(self, told, truth):
        self.off = [float(told[f"tool_{axis}_mm"]) - float(truth[f"tool_{axis}"]) for axis in "xyz"]
        self.sigma = [float(told[f"sigma_{axis}_mm"]) for axis in "xyz"]
        self.lateral = math.hypot(self.off[0], self.off[1])
        self.height = self.off[2]
        angles = [math.radians(float(told[f"tool_{a}_deg"])) for a in ("alpha", "beta", "gamma")]
        seen = [row[2] for row in rotation(*angles)]
        true = [row[2] for row in rotation(*(float(truth[f"tool_{a}"])
                                             for a in ("alpha", "beta", "gamma")))]
        cross = [seen[1] * true[2] - seen[2] * true[1], seen[2] * true[0] - seen[0] * true[2],
                 seen[0] * true[1] - seen[1] * true[0]]
        self.tilt = math.degrees(math.asin(min(1.0, math.sqrt(sum(c * c for c in cross)))))
        self.tubes = int(told["tubes"])
        self.rms_px = float(told["rms_px"])

    def in_sigmas(self):
        return [off / sigma if sigma > 0 else float("inf")
                for off, sigma in zip(self.off, self.sigma)]


def run_pose(program, folder, pose, start, options, frames):
    kind = "png" if (folder / f"still-{pose}-0.png").exists() else "pgm"
    stills = [folder / f"still-{pose}-{frame}.{kind}" for frame in range(frames)]
    with tempfile.TemporaryDirectory() as scratch:
        out = pathlib.Path(scratch) / "p.csv"
        command = [program, "pose", folder / "session.toml", *stills, "--average", "--start", start,
                   "--csv", out, *options]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            print(f"  pose {pose}: status {done.returncode} {done.stderr.strip()}")
            return None
        with open(out, newline="", encoding="utf-8") as file:
            return next(csv.DictReader(file))


def measure(program, folder, which, options, frames):
    """The errors of all poses of a folder, a refused one left out and told."""
    name = "start9.txt" if which == "nine" else "start.txt"
    starts = (folder / name).read_text(encoding="utf-8").split("\n")
    more = ["--only-start"] if which == "nine" else []
    with open(folder / "truth.csv", newline="", encoding="utf-8") as file:
        truth = list(csv.DictReader(file))
    found = []
    for pose, row in enumerate(truth):
        told = run_pose(program, folder, pose, starts[pose], options + more, frames)
        if told is not None:
            found.append((pose, Errors(told, row)))
    return found, len(truth)


def print_row(label, found, poses):
    errors = [error for _, error in found]
    print(f"  {label:34} {len(errors):2}/{poses:<2} {rms([e.lateral for e in errors]):8.4f} "
          f"{max((e.lateral for e in errors), default=0):8.4f} "
          f"{rms([e.height for e in errors]):8.4f} {rms([e.tilt for e in errors]):8.4f} "
          f"{max((e.tilt for e in errors), default=0):8.4f} "
          f"{sum(e.tubes for e in errors) / max(1, len(errors)):6.1f} "
          f"{rms([e.rms_px for e in errors]):7.3f} "
          f"{rms([s for e in errors for s in e.in_sigmas()]):7.2f}")


def print_poses(found):
    for pose, error in found:
        text = " ".join(f"{off:+.4f} ({sigmas:+.1f})"
                        for off, sigmas in zip(error.off, error.in_sigmas()))
        print(f"      pose {pose}: x, y, z off {text} mm, tilt {error.tilt:.4f} deg, "
              f"{error.tubes} tube-ends")


def print_limits(results):
    good = True
    for (which, what), (must, aim) in LIMITS.items():
        errors = [error for _, error in results[which]]
        value = {"lateral": rms([e.lateral for e in errors]),
                 "height": rms([e.height for e in errors]), "tilt": rms([e.tilt for e in errors]),
                 "worst lateral": max((e.lateral for e in errors), default=float("nan"))}[what]
        verdict = "aim reached" if value <= aim else "must reached" if value <= must else "MISSED"
        print(f"  {what}, {which}: {value:.4f}, must {must}, aim {aim}: {verdict}")
        good = good and value <= must
    return good


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--frames", type=int, default=4)
    parser.add_argument("--variants", action="store_true")
    parser.add_argument("--poses", action="store_true")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    good = True
    for folder in arguments.folders:
        print(f"{folder.name}: {arguments.frames} stills averaged; mm, degrees, RMS unless said; "
              "sigmas: error over its own standard deviation")
        print(f"  {'':34} {'poses':5} {'lateral':>8} {'worst':>8} {'height':>8} {'tilt':>8} "
              f"{'worst':>8} {'tubes':>6} {'rms_px':>7} {'sigmas':>7}")
        variants = [[]]
        if arguments.variants:
            variants += [["--method", m] for m in METHODS[1:]] + [["--edge", e] for e in EDGES[1:]]
        for options in variants:
            results = {}
            for which in ("all", "nine"):
                found, poses = measure(arguments.program, folder, which, options, arguments.frames)
                results[which] = found
                print_row(f"{which}{', ' if options else ''}{' '.join(options)}", found, poses)
                if arguments.poses:
                    print_poses(found)
            if not options:
                complete = all(len(found) == poses for found in results.values())
                good = print_limits(results) and complete and good
    return 1 if arguments.check and not good else 0


if __name__ == "__main__":
    sys.exit(main())
