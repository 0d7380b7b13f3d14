#!/usr/bin/env python3
"""Lattices found cold by `tubesight look`, held against published or true places (docs/accuracy.md).

Usage: look_accuracy.py PROGRAM FOLDER... | look_accuracy.py PROGRAM --campaign FRAMES [SEED] [DRAWN]
       | look_accuracy.py --self-test

A folder holds pictures and a table of what they show. `centres.csv` (photographs of dot lattices):
image, lattice indices i, j, and x_px, y_px of every dot's centroid. `centers.csv` (ray-traced scenes of
tubesheets): row, col, state, x_f, y_f of every tube-end's centre, half_w, half_h of its ellipse; the
first frame of `recording.y4m.xz`, or the stills `still-POSE-0.png`, inside `window_px` of
`session.toml`.

With `--campaign`: the first frames of that many moves of the randomised campaign (docs/campaign.md),
each drawn whole by `tubesight simulate`. Needed are the tube-ends whose centre is in the move's window,
whose ellipse is larger than 16 px and of whose rim half is in sight; told are the frames in which one is
missed or one is wrong, and how many there are. A tube-end found where the sheet has a plug counts as
wrong. What was drawn is kept in the folder DRAWN, and not drawn again.

Told for each picture: elements there, found, out of order, surplus, and the distance of the centres.
Exit status 1 when an element is out of order or surplus, with `--campaign` also when one is missed in
more than a hundredth of the frames.
"""
import csv
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

NEAR_PX = 3.0  # of dots; of tube-ends a quarter of the ellipse's smaller half axis, if that is more
LEAST_PX = 16.0  # tube-ends below this size need not be found
LEAST_SEEN = 0.5  # nor those of whose rim less is in the picture and not behind the guidetube
FEW = 0.01  # of the campaign's frames


def look(program, pictures):
    """{picture: [(row, column, u, v)]}"""
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "l.csv"
        subprocess.run([program, "look", *map(str, pictures), "--csv", table], check=False,
                       capture_output=True)
        found = {}
        if table.exists():
            with open(table, encoding="utf-8") as file:
                for row in csv.DictReader(file):
                    found.setdefault(row["image"], []).append(
                        (int(row["row"]), int(row["column"]), float(row["u_px"]), float(row["v_px"])))
        return found


def fit(pairs):
    """The affine map of indices to indices by least squares, as a function."""
    normal = [[0.0] * 3 for _ in range(3)]
    right = [[0.0] * 3 for _ in range(2)]
    for (row, column), index in pairs:
        terms = (row, column, 1.0)
        for a in range(3):
            for b in range(3):
                normal[a][b] += terms[a] * terms[b]
            for k in range(2):
                right[k][a] += terms[a] * index[k]

    def solve(values):
        rows = [line[:] + [value] for line, value in zip(normal, values)]
        for i in range(3):
            pivot = max(range(i, 3), key=lambda k: abs(rows[k][i]))
            rows[i], rows[pivot] = rows[pivot], rows[i]
            for k in range(3):
                if k != i:
                    factor = rows[k][i] / rows[i][i]
                    rows[k] = [x - factor * y for x, y in zip(rows[k], rows[i])]
        return [rows[i][3] / rows[i][i] for i in range(3)]

    maps = [solve(values) for values in right]
    return lambda at: [m[0] * at[0] + m[1] * at[1] + m[2] for m in maps]


def compare(found, there):
    """`there`: [(index, u, v, near, needed)] -> (missed, out of order, surplus, distances)."""
    taken, pairs, distances, missed = set(), [], [], []
    for index, u, v, near, needed in there:
        best = min(range(len(found)), default=None,
                   key=lambda k: math.hypot(found[k][2] - u, found[k][3] - v))
        off = math.inf if best is None else math.hypot(found[best][2] - u, found[best][3] - v)
        if off > near or best in taken:
            if needed:
                missed.append(index)
            continue
        taken.add(best)
        pairs.append((found[best][:2], index))
        if needed:
            distances.append(off)
    order = 0
    if len(pairs) >= 5:
        index_of = fit(pairs)
        order = sum(max(abs(a - b) for a, b in zip(index_of(at), index)) > 0.01 for at, index in pairs)
    surplus = [element for k, element in enumerate(found) if k not in taken]
    return missed, order, surplus, distances


def photographs(folder):
    """{picture: what is there}"""
    there = {}
    with open(folder / "centres.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            name = pathlib.Path(row["image"]).stem
            if not (folder / f"{name}.png").exists():
                name = "image%d" % int(name.removeprefix("image"))
            there.setdefault(folder / f"{name}.png", []).append(
                ((int(row["i"]), int(row["j"])), float(row["x_px"]), float(row["y_px"]), NEAR_PX, True))
    return there, None


def draw_move(program, seed, move, folder):
    """Draws the first frame of a move into `folder`, where it is not there yet."""
    if (folder / "told.txt").exists():
        return
    folder.mkdir(parents=True, exist_ok=True)
    scenario = folder / "m.toml"
    told = subprocess.run([program, "campaign", "--replay-move", f"{seed}:{move}", "--out", scenario],
                          check=True, capture_output=True, text=True).stdout
    text = scenario.read_text(encoding="utf-8")
    one_frame = "length_s = %r" % (1.0 / tomllib.loads(text)["video"]["rate_hz"])
    # Moves draw the search window and a margin alone. What happens in them would be behind the end.
    text = "".join(part for part in re.split(r"(?m)^(?=\[)", text)
                   if part.startswith("[[step]]") or not part.startswith("[["))
    text = re.sub(r"(?m)^window_margin_px = .*$", "", text)
    scenario.write_text(re.sub(r"(?m)^length_s = .*$", one_frame, text, count=1), encoding="utf-8")
    subprocess.run([program, "simulate", scenario, "--out", folder / "r"], check=True,
                   stdout=subprocess.DEVNULL)
    (folder / "told.txt").write_text(told, encoding="utf-8")


def campaign_frame(folder):
    """The picture, and what is there as photographs() tells it; the window; the move's stratum."""
    window = tomllib.loads((folder / "m.toml").read_text(encoding="utf-8"))["start"]["window_px"]
    there = []
    with open(folder / "r.centers.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["field"] != "0" or row["frame"] != "0" or row["state"] != "open":
                continue
            u, v = float(row["x_f"]), float(row["y_f"])
            half = min(float(row["half_w"]), float(row["half_h"]))
            seen = float(row["rim_in_frame"]) - float(row["occluded"])
            there.append(((int(row["row"]), int(row["col"])), u, v, max(NEAR_PX, half / 4.0),
                          inside(window, u, v) and 2.0 * half > LEAST_PX and seen >= LEAST_SEEN))
    told = (folder / "told.txt").read_text(encoding="utf-8")
    return folder / "r.y4m", there, window, told.split(", ", 1)[1].split("\n", 1)[0]


def run_campaign(program, frames, seed, drawn):
    """Prints a line a frame with something missed or wrong, and the sum."""
    wanted, found_all, missing, wrong = 0, 0, 0, 0
    for move in range(frames):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(drawn or name) / f"{seed}-{move}"
            draw_move(program, seed, move, folder)
            picture, there, window, stratum = campaign_frame(folder)
            found = next(iter(look(program, [picture]).values()), [])
        missed, order, surplus, distances = compare(found, there)
        surplus = [element for element in surplus if inside(window, element[2], element[3])]
        needed = sum(element[4] for element in there)
        wanted += needed
        found_all += len(distances)
        missing += bool(missed)
        wrong += bool(order or surplus)
        if missed or order or surplus:
            print(f"move {seed}:{move} ({stratum}): {needed} there, {len(distances)} found, "
                  f"{order} out of order, {len(surplus)} surplus"
                  + "".join(f"; missed {index}" for index in missed[:5])
                  + "".join(f"; surplus at {u:.0f}, {v:.0f}" for _, _, u, v in surplus[:5]), flush=True)
    print(f"{frames} frames: {found_all} of {wanted} tube-ends found; one missed in {missing} frames, "
          f"one out of order or surplus in {wrong}")
    return wrong == 0 and missing <= FEW * frames


def scenes(folder):
    with open(folder / "session.toml", "rb") as file:
        window = tomllib.load(file)["start"]["window_px"]
    recording = folder / "recording.y4m.xz"
    there = {}
    with open(folder / "centers.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            frame = int(row["frame"])
            if row["field"] != "0" or row["state"] != "open" or (recording.exists() and frame != 0):
                continue
            picture = recording if recording.exists() else folder / f"still-{frame // 4}-0.png"
            u, v = float(row["x_f"]), float(row["y_f"])
            half = min(float(row["half_w"]), float(row["half_h"]))
            there.setdefault(picture, []).append(
                ((int(row["row"]), int(row["col"])), u, v, max(NEAR_PX, half / 4.0),
                 inside(window, u, v) and 2.0 * half > LEAST_PX))
    return there, window


def inside(window, u, v):
    return window[0] <= u <= window[2] and window[1] <= v <= window[3]


def run(program, folder):
    """Prints a line a picture; says whether nothing is wrong."""
    there, window = (photographs if (folder / "centres.csv").exists() else scenes)(folder)
    good = True
    for picture, elements in sorted(there.items()):
        found = look(program, [picture])
        found = next(iter(found.values()), [])
        missed, order, surplus, distances = compare(found, elements)
        if window is not None:
            surplus = [element for element in surplus if inside(window, element[2], element[3])]
        rms = math.sqrt(sum(d * d for d in distances) / len(distances)) if distances else math.nan
        print(f"{folder.name}/{picture.name}: {sum(e[4] for e in elements)} there, "
              f"{len(distances)} found, {order} out of order, {len(surplus)} surplus, "
              f"centres RMS {rms:.3f} px"
              + "".join(f"; missed {index}" for index in missed[:5]))
        good = good and order == 0 and not surplus
    return good


def self_test():
    there = [((i, j), 10.0 * i, 10.0 * j, NEAR_PX, True) for i in range(4) for j in range(4)]
    right = [(j, 3 - i, 10.0 * i + 0.3, 10.0 * j) for i in range(4) for j in range(4)]
    assert compare(right, there)[:3] == ([], 0, [])
    swapped = [right[1][:2] + right[0][2:], right[0][:2] + right[1][2:]] + right[2:]
    assert compare(swapped, there)[1] > 0
    assert compare(right[1:], there)[0] == [(0, 0)]
    assert len(compare(right + [(9, 9, 55.0, 55.0)], there)[2]) == 1
    print("look_accuracy: self-test passed")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
    elif sys.argv[2:3] == ["--campaign"]:
        frames, seed, drawn = (sys.argv[3:] + ["1", ""][len(sys.argv) - 4:])[:3]
        sys.exit(0 if run_campaign(sys.argv[1], int(frames), int(seed), drawn) else 1)
    else:
        results = [run(sys.argv[1], pathlib.Path(folder)) for folder in sys.argv[2:]]
        sys.exit(0 if all(results) else 1)
