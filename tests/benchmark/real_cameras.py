#!/usr/bin/env python3
"""Calibrates the cameras of real pictures and points, beside what others found (docs/accuracy.md).

Usage: real_cameras.py PROGRAM FOLDER | real_cameras.py --self-test

FOLDER holds the sets boofcv_hex, boofcv_grid, opencv_acircles, robot_cal_tools_10x10 and zhang1998.
Told of each: the residuals' RMS beside that of the library on the same views with the same number of
parameters, EFL in pixels and the centre with their standard deviations. The three templates of
opencv_acircles are of one camera: their points are written (--write-points) and calibrated together.
Exit status 1 when residuals are larger than the library's, or Zhang's camera is farther from what he
published than its standard deviations say.
"""
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

CAMERA = """[camera]
width_px = 640
height_px = 480
scan = "progressive"
cell_width_mm = 0.01
cell_height_mm = 0.01
sensor_columns = 640
frame_columns = 640
"""
# Name: lines, dots in a line, lattice, spacing, row spacing, diameter (units of the sets).
TEMPLATES = {
    "boofcv_hex": (24, 14, "staggered", 1.2, 1.0392, 1.0),
    "boofcv_grid": (10, 8, "square", 25.0, 25.0, 15.0),
    "robot_cal_tools_10x10": (10, 10, "square", 25.4, 25.4, 11.5),
}
# Of opencv_acircles, the first and the last picture of each.
CIRCLES = [((13, 7), 1, 3), ((5, 5), 4, 6), ((9, 3), 7, 9)]
LIBRARY_RMS_PX = {"boofcv_hex": 0.269, "boofcv_grid": 0.525, "opencv_acircles": 0.276,
                  "robot_cal_tools_10x10": 0.226}
# fx, c_u, c_v as published for his points.
ZHANG = (832.5, 304.0, 206.6)


def number_of(path):
    return int(re.findall(r"\d+", path.stem)[-1])


def target_text(template, sources, key="images"):
    lines, columns, lattice, spacing, row_spacing, dot = template
    text = CAMERA + (f'[target]\nrows = {lines}\ncolumns = {columns}\nlattice = "{lattice}"\n'
                     f"spacing_mm = {spacing}\nrow_spacing_mm = {row_spacing}\ndot_mm = {dot}\n"
                     'dots = "dark"\n')
    for source in sources:
        text += f'[[view]]\n{key} = ' + (f'["{source}"]\n' if key == "images" else f'"{source}"\n')
    return text


def zhang_points(model, data):
    """The text of a points file of one view."""
    places = [float(word) for word in model.split()]
    seen = [float(word) for word in data.split()]
    rows = ["x_mm,y_mm,u_px,v_px"]
    rows += [f"{places[i]:.6f},{places[i + 1]:.6f},{seen[i]:.6f},{seen[i + 1]:.6f}"
             for i in range(0, len(places), 2)]
    return "\n".join(rows) + "\n"


def read_report(text):
    """RMS, and EFL (mm) and centre with their deviations, from what the program tells."""
    found = {name: (float(value), float(sigma)) for name, value, sigma in
             re.findall(r"^  (EFL|c_u|c_v) +([\d.]+) \+- ([\d.]+)", text, re.MULTILINE)}
    rms = re.search(r"residuals +([\d.]+) px RMS", text)
    return (float(rms.group(1)) if rms else None), found


def calibrate(program, target, *more):
    # Whether it would be written does not matter here: what is refused is told all the same.
    done = subprocess.run([program, "calibrate", "camera", target, *more], capture_output=True,
                          text=True, check=False)
    rms, found = read_report(done.stdout)
    return rms, found, done.stderr.strip()


def tell(name, rms, found, why, library):
    if rms is None:
        print(f"{name:24} {why}")
        return False
    efl, sigma = found["EFL"]
    line = f"{name:24} RMS {rms:.3f} px"
    line += f" (library {library})" if library else ""
    line += f", EFL {100.0 * efl:.1f} +- {100.0 * sigma:.1f} px"
    line += "".join(f", {key} {found[key][0]:.1f} +- {found[key][1]:.1f}" for key in ("c_u", "c_v")
                    if key in found)
    print(line + (f"; {why.split(': ', 1)[-1][:60]}..." if why else ""), flush=True)
    return library is None or round(rms, 3) <= library  # which is known to three digits


def main(program, folder):
    program = pathlib.Path(program).resolve()
    folder = pathlib.Path(folder).resolve()
    good = True
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        target = work / "t.toml"
        for name, template in TEMPLATES.items():
            pictures = sorted((folder / name).glob("*.png"), key=number_of)
            target.write_text(target_text(template, pictures))
            good = tell(name, *calibrate(program, target), LIBRARY_RMS_PX[name]) and good
        files = []
        for (lines, columns), first, last in CIRCLES:
            template = (lines, columns, "staggered", 2.0, 1.0, 0.65)
            pictures = [folder / "opencv_acircles" / f"acircles{i}.png"
                        for i in range(first, last + 1)]
            target.write_text(target_text(template, pictures))
            points = work / f"points{first}"
            calibrate(program, target, "--write-points", points)
            files += sorted(points.glob("view-*.csv"))
        target.write_text(target_text((13, 7, "staggered", 2.0, 1.0, 0.65), files, "points"))
        good = tell("opencv_acircles", *calibrate(program, target),
                    LIBRARY_RMS_PX["opencv_acircles"]) and good
        model = (folder / "zhang1998" / "Model.txt").read_text()
        files = []
        for i in range(1, 6):
            data = (folder / "zhang1998" / f"data{i}.txt").read_text()
            files.append(work / f"zhang{i}.csv")
            files[-1].write_text(zhang_points(model, data))
        target.write_text(target_text((16, 16, "square", 1.0, 1.0, 0.0), files, "points"))
        rms, found, why = calibrate(program, target)
        good = tell("zhang1998", rms, found, why, None) and good
        # EFL is told along the columns, in hundredths of a millimetre; the scale is h_sx.
        for key, published, unit in zip(("EFL", "c_u", "c_v"), ZHANG, (100.0, 1.0, 1.0)):
            value, sigma = found.get(key, (0.0, 0.0))
            if abs(unit * value - published) > unit * sigma:
                print(f"zhang1998: {key} {unit * value:.1f}, published {published}")
                good = False
    return 0 if good else 1


def self_test():
    text = zhang_points("0 -0.5 0.5 -0.5", "63.4 405.5 92.4 407.4")
    rows = list(csv.DictReader(text.splitlines()))
    assert rows[1] == {"x_mm": "0.500000", "y_mm": "-0.500000", "u_px": "92.400000",
                       "v_px": "407.400000"}
    rms, found = read_report("camera from 5 views\n  EFL                  8.31500 +- 0.02000 mm\n"
                             "  c_u                  304.100 +- 1.100 px\n"
                             "  residuals            0.3380 px RMS of a dot\n")
    assert rms == 0.338 and found["EFL"] == (8.315, 0.02) and found["c_u"] == (304.1, 1.1)
    assert read_report("")[0] is None
    assert target_text(TEMPLATES["boofcv_grid"], ["a.png"]).endswith('images = ["a.png"]\n')
    assert target_text(TEMPLATES["boofcv_grid"], ["a.csv"], "points").endswith('points = "a.csv"\n')
    print("real_cameras: self-test passed")
    return 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(self_test())
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
