#!/usr/bin/env python3
"""Prints what compressing a recording costs: each codec's video is replayed and scored by the truth.

Usage: compression_accuracy.py TUBESIGHT FOLDER...

FOLDER is as accuracy.py takes it. ffmpeg encodes the recording, `tubesight replay` reads the video,
and the fields are scored as accuracy.py scores those of the recording itself (the first line).
"""
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import accuracy

X264 = ["-c:v", "libx264", "-preset", "medium", "-flags", "+ildct", "-x264opts"]
CODECS = [
    ("H.264 crf 18", [*X264, "tff=1:crf=18"], "mp4"),
    ("H.264 crf 23", [*X264, "tff=1:crf=23"], "mp4"),
    ("H.264 crf 28", [*X264, "tff=1:crf=28"], "mp4"),
    ("MPEG-4 q 5", ["-c:v", "mpeg4", "-flags", "+ildct+ilme", "-q:v", "5"], "avi"),
    ("MJPEG q 5", ["-c:v", "mjpeg", "-q:v", "5", "-pix_fmt", "yuvj420p"], "avi"),
    ("MJPEG q 10", ["-c:v", "mjpeg", "-q:v", "10", "-pix_fmt", "yuvj420p"], "avi"),
]
COLUMNS = [("wrong_tube", "{:.0f}", 1), ("false_aligned", "{:.0f}", 1), ("answered", "{:.2f}", 100),
           ("given", "{:.2f}", 100), ("offset_rms_mm", "{:.3f}", 1), ("offset_max_mm", "{:.3f}", 1),
           ("height_rms_mm", "{:.3f}", 1), ("centers_rms_px", "{:.3f}", 1),
           ("centers_p95_px", "{:.3f}", 1)]


def run(command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{command[0]}: {done.stderr.strip()}")


def plain(folder, scratch):
    """The recording as ffmpeg reads it: uncompressed."""
    recording = accuracy.recording_of(folder)
    if recording.suffix != ".xz":
        return recording
    unpacked = scratch / "recording.y4m"
    with open(unpacked, "wb") as file:
        subprocess.run(["xz", "-dc", str(recording)], stdout=file, check=True)
    return unpacked


def score(tubesight, folder, video, scratch):
    fields, centers = scratch / "fields.csv", scratch / "centers.csv"
    # Codecs keep the flag of interlacing or not; the settings know.
    run([tubesight, "replay", folder / "session.toml", video, "--fields", fields, "--centers", centers,
         "--ignore-scan-flag"])
    settings = tomllib.loads((folder / "session.toml").read_text(encoding="utf-8"))
    figures = accuracy.score_fields(settings, accuracy.read_csv(fields),
                                    accuracy.read_csv(folder / "truth.csv"))
    true_centers = {(accuracy.field_number(row, settings["camera"]["scan"]), int(row["row"]),
                     int(row["col"])): row for row in accuracy.read_csv(folder / "centers.csv")}
    figures.update(accuracy.score_centers(settings, accuracy.read_csv(centers), true_centers))
    return figures


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    tubesight = pathlib.Path(sys.argv[1]).resolve()
    for name in sys.argv[2:]:
        folder = pathlib.Path(name).resolve()
        print(f"{folder.name}\n| codec | kbit a frame | " + " | ".join(key for key, _, _ in COLUMNS) + " |")
        print("|" + "---|" * (len(COLUMNS) + 2))
        with tempfile.TemporaryDirectory() as temporary:
            scratch = pathlib.Path(temporary)
            source = plain(folder, scratch)
            frames = len({line["frame"] for line in accuracy.read_csv(folder / "truth.csv")})
            for codec, options, container in [("none", None, ""), *CODECS]:
                video = source
                if options is not None:
                    video = scratch / f"video.{container}"
                    run(["ffmpeg", "-nostdin", "-v", "error", "-y", "-i", source, *options, video])
                figures = score(tubesight, folder, video, scratch)
                cells = [form.format(factor * figures[key]) for key, form, factor in COLUMNS]
                size = 8e-3 * video.stat().st_size / frames
                print(f"| {codec} | {size:.0f} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
