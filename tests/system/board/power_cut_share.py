"""What the emulated board is given to write: settings of two boxes and the pictures that they watch."""
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[3]

TINY = """\
[camera]
width_px = 96
height_px = 80
scan = "even-first"
focal_length_mm = 5.06
cell_width_mm = 0.0084
cell_height_mm = 0.0098
sensor_columns = 768
frame_columns = 635
horizontal_scale = 1.021
center_px = [48, 40]
distortion_per_mm2 = 0.0092
[tool]
position_mm = [-3.074, 31.629, 112.789]
rotation_deg = [-0.0639, -0.8174, 47.9947]
[tubesheet]
row_step_mm = [0.0, 25.4]
column_step_mm = [25.4, 0.0]
bore_mm = 18.6
rows = [39, 42]
columns = [59, 62]
[start]
tubes = [ { row = 40, column = 60, at_px = [40, 30] },
          { row = 41, column = 60, at_px = [40, 60] },
          { row = 40, column = 61, at_px = [70, 30] } ]
window_px = [10, 8, 85, 75]
"""

BOX = """\
format = 1
include = ["{session}"]
[source]
kind = "replay"
recording = "{recording}"
script = {script}
[control]
socket = "/run/{name}/box"
[realtime]
priority = 0
lock_memory = false
"""

RECORD = """\
[record]
folder = "/data"
memory_mb = 4
disk_mb = 16
fields_after = 0
on_track_lost = false
on_disagreement = false
"""

BASE = """\
[base]
position_mm = [0.0, 0.0, -1000.0]
rotation_deg = [0.0, 0.0, 0.0]
"""

PAIR_COLUMNS = ("name,robot_x_mm,robot_y_mm,robot_z_mm,robot_alpha_deg,robot_beta_deg,robot_gamma_deg,"
                "tool_x_mm,tool_y_mm,tool_z_mm,tool_alpha_deg,tool_beta_deg,tool_gamma_deg,sigma_x_mm,"
                "sigma_y_mm,sigma_z_mm,use")
# Places of the tool on the sheet and its headings.
PLACES = ((-900, -700, 10), (800, -750, 60), (900, 820, 140), (-850, 790, -80), (20, 60, -20), (100, 950, 35))

# Slow, as the emulated board is.
RATE_HZ = 5
FRAMES = 40
FIRST_POSE = 10  # a track that has just begun does not know yet that it is at rest


def _scenario():
    """The example's sheet with a tool that rests, and of so little acceleration that few fields suffice."""
    text = (ROOT / "docs" / "examples" / "steam-generator.toml").read_text(encoding="utf-8")
    text = text[:text.index("[[step]]")].replace(
        "[camera]", f"[video]\nrate_hz = {RATE_HZ}\n\n[motion]\nmax_acceleration_mm_s2 = 200\n\n[camera]", 1)
    return text + f"[[step]]\nrest_s = {FRAMES / RATE_HZ:.3f}\n"


def make(folder, draw):
    """Fills `folder`; `draw` is the program that draws a scenario, with what starts it."""
    folder.mkdir(exist_ok=True)

    def write(name, text):
        (folder / name).write_text(text, encoding="ascii")

    write("tiny.session.toml", TINY)
    frames = [bytes((i * 7 + x * 3 + y * 5) % 251 for y in range(80) for x in range(96)) for i in range(30)]
    (folder / "tiny.y4m").write_bytes(b"YUV4MPEG2 W96 H80 F15:1 It Cmono\n"
                                      + b"".join(b"FRAME\n" + frame for frame in frames))
    write("recorder.toml", BOX.format(name="recorder", session="tiny.session.toml", recording="tiny.y4m",
                                      script="false") + RECORD)
    write("rest.toml", _scenario())
    subprocess.run([*draw, "simulate", str(folder / "rest.toml"), "--out", str(folder / "rest")],
                   stdin=subprocess.DEVNULL, capture_output=True, check=True, timeout=300)
    events = (folder / "rest.events.csv").read_text(encoding="ascii").splitlines()[:1]
    events += [f'{field},,pose,"{100 + field}.0,200.0,970.0",,,'
               for field in range(FIRST_POSE, 2 * FRAMES - 2, 3)]
    write("rest.events.csv", "\n".join(events) + "\n")
    write("pairs.toml", BOX.format(name="pairs", session="rest.session.toml", recording="rest.y4m",
                                   script="true") + '[pairs]\nfile = "/data/pairs.csv"\n')
    write("base.toml", BASE)
    write("base_pairs.csv", "\n".join([PAIR_COLUMNS] + [
        f"p{i},{x},{y},DEPTH,{heading},0,0,{x},{y},-30,{heading},0,0,0.02,0.02,0.04,1"
        for i, (x, y, heading) in enumerate(PLACES)]) + "\n")
