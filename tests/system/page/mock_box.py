#!/usr/bin/env python3
"""A box without a camera: serves the page and plays scenes to it, for the page's tests and for work on the page.

Usage: mock_box.py [--port N] [--root REPOSITORY]

Prints `listening on PORT`. Pictures and measured tube-ends are those of tests/data/recordings/square_flush; what
tests/data/golden says of each field is what the box is made to say. A scene is chosen by POST /mock {"scene": NAME,
...}; the keys of SCENES are the names. Each browser (cookie) has a session and a scene of its own, so that many
pages can be tested at once.
"""
import argparse
import csv
import http.server
import json
import lzma
import math
import pathlib
import socketserver
import struct
import subprocess
import threading
import time
import urllib.parse
import uuid

FRAMES = 16
RATE = 10              # pictures a second: enough to look at, and a test computer has other work
WIDTH, HEIGHT = 635, 480
WINDOW = {"left": 40, "top": 36, "width": 556, "height": 295}
OPTIMUM = {"u": 318, "v": 190}
TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
POLICY = "default-src 'self'"

# Which frame of the recording is shown (None: one after the other), and what the sighting says otherwise.
SCENES = {
    "aligned": {"frame": 0},
    "between": {"frame": 5},
    "moving": {"frame": None},
    "contradicted": {"frame": 0, "claim": (41, 60, "contradicted")},
    "waiting": {"frame": 0, "state": "waiting", "reason": "no-start", "words": "No start yet",
                "advice": "Name a tube-end under Start."},
    "lost": {"frame": 6, "state": "lost", "reason": "jump",
             "words": "Lost: the picture jumped further than the robot can move",
             "advice": "Let the robot stand still and start again."},
    "degraded": {"frame": 5, "state": "degraded", "reason": "dark", "words": "The picture is dark",
                 "advice": "Look at the lamp, its cable and the iris. The box coasts for a moment."},
    "void": {"frame": 5, "tool": None, "words": "No tube stands above the guidetube"},
    "frozen": {"frame": 0, "stops": "pictures"},   # the camera delivers no more, the box answers
    "silent": {"frame": 0, "stops": "answers"},    # the box takes requests and answers none
    "late": {"frame": 0, "late_s": 3.0},           # pictures held up on the way
    "three": {"frame": 0, "lattice": False, "state": "waiting", "words": "No start yet",
              "advice": "Name a tube-end under Start."},
    "locked": {"frame": 0, "password": "plant"},
}


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Recording:
    """Pictures as JPEG, and what was measured in the earlier field of each frame."""

    def __init__(self, root):
        folder = root / "tests/data/recordings/square_flush"
        video = lzma.decompress((folder / "recording.y4m.xz").read_bytes())
        jpegs = subprocess.run(
            ["ffmpeg", "-v", "error", "-f", "yuv4mpegpipe", "-i", "-", "-frames:v", str(FRAMES), "-pix_fmt", "gray",
             "-q:v", "4", "-f", "image2pipe", "-c:v", "mjpeg", "-threads", "1", "-"],
            input=video, stdout=subprocess.PIPE, check=True).stdout
        starts = [k for k in range(len(jpegs) - 1) if jpegs[k:k + 3] == b"\xff\xd8\xff"]
        self.jpegs = [jpegs[a:b] for a, b in zip(starts, starts[1:] + [len(jpegs)])]
        fields = rows_of(folder / "expected_fields.csv")
        self.fields = [fields[2 * k] for k in range(len(self.jpegs))]
        self.tubes = [[] for _ in self.jpegs]
        for row in rows_of(folder / "expected_centers.csv"):
            field = int(row["field"])
            if field % 2 == 0 and field // 2 < len(self.tubes):
                self.tubes[field // 2].append([int(row["row"]), int(row["column"]), float(row["u_px"]),
                                               float(row["v_px"]), float(row["quality"]), 0, 90])

    def sighting(self, frame):
        field = self.fields[frame]
        tubes = self.tubes[frame]
        place = {(r, c): {"u": u, "v": v} for r, c, u, v, *_ in tubes}
        row, column = int(field["primary_row"]), int(field["primary_column"])
        tool = (int(field["tool_row"]), int(field["tool_column"]))
        at = place.get(tool) or {"u": float(field["primary_u_px"]), "v": float(field["primary_v_px"])}
        dx, dy = float(field["tool_dx_mm"]), float(field["tool_dy_mm"])
        along, down = place.get((row, column + 1)), place.get((row + 1, column))
        # 25.4 mm to the next tube-end on either side.
        axis = {"u": at["u"] + 3.3 * dx, "v": at["v"] + 2.4 * dy}
        sighting = {
            "state": "tracking", "reason": "", "words": "Tracking", "advice": "", "judged": True,
            "aligned": field["aligned"] == "1", "tracked": int(field["tracked"]), "liveness": "proved",
            "tool": {"row": tool[0], "column": tool[1], **at, "offset_mm": float(field["tool_offset_mm"]),
                     "dx_mm": dx, "dy_mm": dy, "direction_deg": round(math.degrees(math.atan2(dy, dx)), 1)},
            "primary": {"row": row, "column": column, "u": float(field["primary_u_px"]),
                        "v": float(field["primary_v_px"])},
            "axis": axis, "height_mm": float(field["tool_height_mm"]), "margin_sigma": float(field["margin"]),
            "residual_px": float(field["residual_px"]), "next_row": down, "next_column": along,
            "around": [place[tube] for tube in ((tool[0] + 1, tool[1]), (tool[0] - 1, tool[1]), (tool[0], tool[1] + 1),
                                                (tool[0], tool[1] - 1)) if tube in place],
            "tubes": tubes, "window": WINDOW, "optimum": OPTIMUM,
            # Where the fit has them: up to 0.4 px off, the same in each run.
            "estimates": [[a, b, u + 0.4 * math.sin(7 * a + 3 * b), v + 0.4 * math.cos(5 * a + b), ]
                          for a, b, u, v, *_ in tubes],
            "lamp": {"permille": 620, "automatic": True, "words": "well"}, "link": {"state": "up", "words": "open"},
            "camera": {"words": "well", "fields_per_s": 60}, "thresholds": {"edge": 200, "region": 60},
        }
        if not sighting["aligned"]:
            sighting["words"] = "Tracking: not under the tube yet"
        return sighting


def sheet():
    """11,000 tubes or so: half a disc, square pitch, with a lane and some plugs."""
    rows = []
    for row in range(0, 84):
        half = int(math.sqrt(max(0, 84.5 ** 2 - (row - 0.5) ** 2)))
        if half:
            rows.append([row, 84 - half, 83, 85, 84 + half])
    return {"name": "Steam generator 2, hot leg", "origin_mm": [0, 0], "row_step_mm": [0, 25.4],
            "column_step_mm": [25.4, 0], "odd_row_shift": 0, "bore_mm": 18.6, "column_stride": 1, "rows": rows,
            "plugs": [[40 + k % 9, 50 + k] for k in range(24)], "missing": [[20, 60], [20, 61], [21, 60], [21, 61]]}


SHEET = sheet()
VISITS = {"since": 0, "tubes": [[40, column, "verified", 2, 100.0 + column] for column in range(52, 61) if column != 56]
          + [[41, column, "visited", 1, 90.0] for column in range(50, 66)] + [[39, 58, "contradicted", 1, 95.0]],
          "path": [[25.4 * (52 + k / 4), 25.4 * 40 + 8 * math.sin(k / 3), 100 + k] for k in range(33)],
          "now": {"x_mm": 25.4 * 60, "y_mm": 25.4 * 40}}


class Client:
    """What one browser sees."""

    def __init__(self):
        self.scene = "aligned"
        self.since = time.monotonic()
        self.role = "engineer"
        self.operator = {"held": False, "mine": False}
        self.frozen = None
        self.started = None
        self.warned = set()
        self.more_status = {}  # beside the usual
        self.acknowledged = None
        self.disagreement = False
        self.lamp = {"permille": 620, "automatic": True, "words": "well"}
        self.asked = []       # what was posted, for the tests
        self.events = []      # (name, data) not sent yet
        self.attempts = 0
        self.replies = {}     # path: (status, body) that stands in for the next answer

    def choose(self, scene):
        self.scene = scene
        self.since = time.monotonic()
        self.started = None
        self.warned = set()
        if "password" in SCENES[scene]:
            self.role = "none"

    def session(self):
        return {"role": self.role, "token": "mock", "login": self.role == "none", "operator": self.operator,
                "box": {"version": "1.4.0", "boot": 7, "source": "simulated",
                        "calibration": {"camera": "8c41d0", "tool": "1f77ab"}},
                "frame": {"width": WIDTH, "height": HEIGHT}, "languages": ["en"]}


class Box:
    def __init__(self, root):
        self.root = root
        self.page = root / "drivers/web/page"
        self.recording = Recording(root)
        self.clients = {}
        self.begun = time.monotonic() - 100

    def client(self, name):
        return self.clients.setdefault(name, Client())

    def now(self):
        return time.monotonic() - self.begun

    def frame(self, client, at=None):
        """(JSON, JPEG) of the newest field."""
        scene = SCENES[client.scene]
        at = self.now() if at is None else at
        if scene.get("stops") == "pictures":
            at = client.since - self.begun
        field = int(at * RATE)
        frame = scene["frame"] if scene["frame"] is not None else field % FRAMES
        sighting = self.recording.sighting(frame)
        for key in ("state", "reason", "words", "advice", "tool"):
            if key in scene:
                sighting[key] = scene[key]
        if client.started:
            sighting.update(state="tracking", words="Tracking", advice="")
        if sighting["state"] in ("waiting", "lost"):
            for key in ("tool", "primary", "axis", "height_mm", "margin_sigma"):
                sighting.pop(key)
            sighting.update(aligned=False, tracked=0, tubes=[], estimates=[])
        if sighting["state"] == "degraded" or sighting.get("tool") is None:
            sighting["aligned"] = False
            if sighting.get("tool") is None:
                sighting.pop("tool", None)
        claim = scene.get("claim")
        if claim:
            place = next(({"u": u, "v": v} for r, c, u, v, *_ in sighting["tubes"] if (r, c) == claim[:2]), {})
            sighting["claim"] = {"row": claim[0], "column": claim[1], "verdict": claim[2], **place}
        elif sighting["aligned"]:
            sighting["claim"] = {"row": 40, "column": 60, "verdict": "confirmed"}
        taken = field / RATE
        sighting.update(field=field, time_s=round(taken, 6), age_s=0,
                        now_s=round(self.now(), 4), lamp=client.lamp)
        return sighting, self.recording.jpegs[frame]

    def lattice(self, client):
        if SCENES[client.scene].get("lattice") is False:
            return {"found": False, "words": "No regular tube-ends were found: the light is uneven."}
        tubes = self.recording.tubes[SCENES[client.scene]["frame"] or 0]
        elements = [{"i": row - 40, "j": column - 60, "u": u, "v": v, "size_px": 60 - abs(240 - v) / 8}
                    for row, column, u, v, *_ in tubes]
        turns = [(1, 0, 0, 1), (0, 1, -1, 0), (-1, 0, 0, -1), (0, -1, 1, 0)]
        return {"found": True, "elements": elements, "ways": [dict(zip("abcd", turn)) for turn in turns]}

    def disagreements(self, client):
        if not client.disagreement:
            return []
        return [{"id": "d1", "at_s": 100.5, "wall": "02:41:07", "claim": {"row": 41, "column": 60},
                 "tube": {"row": 40, "column": 60}, "acknowledged": client.acknowledged, "steps": 8,
                 "words": "The robot claims row 41, column 60; the guidetube is under row 40, column 60, 0.7 mm off its centre."}]

    def start(self, client, body):
        """As the box: the address of the first must be 40/60 for the tube-end at (310, 191)."""
        if not body.get("confirmed"):
            client.warned.clear()
        if self.warns(client, "numbering"):
            return {"taken": False, "refusal": "numbering", "confirmable": True,
                    "words": "nothing in the picture tells whether the numbers are turned"}
        first = body["tubes"][0]
        tubes = self.recording.tubes[0]
        for index, tube in enumerate(body["tubes"]):
            row, column, *_ = min(tubes, key=lambda t: (t[2] - tube["u"]) ** 2 + (t[3] - tube["v"]) ** 2)
            if (row, column) != (tube["row"], tube["column"]) and self.warns(client, "map"):
                return {"taken": False, "refusal": "map", "click": index, "confirmable": index == 0 and first["row"] == 48,
                        "words": f"tube-end {index + 1}: the settings know a plug at {tube['row']} / {tube['column']}, "
                                 "and an open tube-end stands there"}
        client.started = body
        return {"taken": True}

    @staticmethod
    def warns(client, kind):
        """Once, as the box does."""
        new = kind not in client.warned
        client.warned.add(kind)
        return new


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    box = None

    def log_message(self, *_):
        pass

    def name(self):
        for part in (self.headers.get("Cookie") or "").split(";"):
            key, _, value = part.strip().partition("=")
            if key == "tubesight":
                return value
        return None

    def send(self, status, body=b"", kind="application/json", headers=()):
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Content-Security-Policy", POLICY)
        self.send_header("Cache-Control", "no-store")
        for name, value in headers:
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def reply(self, data, status=200):
        self.send(status, json.dumps(data).encode())

    def send_frame(self, sighting, jpeg):
        text = json.dumps(sighting).encode()
        self.send(200, struct.pack("<I", len(text)) + text + jpeg, "application/octet-stream")

    def do_GET(self):
        url = urllib.parse.urlparse(self.path)
        name = self.name()
        if url.path == "/" or url.path.startswith("/page/"):
            path = self.box.page / (url.path.removeprefix("/page/") if url.path != "/" else "index.html")
            if path.parent != self.box.page or not path.is_file():
                self.send(404)
                return
            made = [] if name else [("Set-Cookie", f"tubesight={uuid.uuid4().hex}; HttpOnly; SameSite=Strict")]
            self.send(200, path.read_bytes(), TYPES[path.suffix], made)
            return
        client = self.box.client(name)
        if SCENES[client.scene].get("stops") == "answers":
            time.sleep(20)
            return
        if url.path == "/api/session":
            self.reply({**client.session(), "now_s": self.box.now()})
        elif client.role == "none":
            self.reply({"error": "Log in first."}, 401)
        elif url.path == "/api/frame":
            self.next_frame(client, urllib.parse.parse_qs(url.query))
        elif url.path == "/api/events":
            self.send_events(client)
        else:
            self.get(client, url)

    def next_frame(self, client, query):
        after = int(query.get("after", ["-1"])[0])
        until = time.monotonic() + 2
        while time.monotonic() < until:
            sighting, jpeg = self.box.frame(client)
            if sighting["field"] > after:
                time.sleep(SCENES[client.scene].get("late_s", 0))
                self.send_frame(sighting, jpeg)
                return
            time.sleep(1 / RATE - self.box.now() % (1 / RATE) + 0.001)
        self.send(204)

    def send_events(self, client):
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        beat = 0
        while client.role != "none" and SCENES[client.scene].get("stops") != "answers":
            events, client.events = client.events, []
            if beat % 5 == 0:
                events.append(("status", {"counters": {"fields": 1200, "missing": 0, "dimmer_errors": 0,
                                                       "link": {"garbled": 0, "gone": 0, "lost_replies": 0}},
                                          "camera": {"well": True, "fields_per_s": 60.0, "gaps": 0},
                                          "latency": {"median_us": 812, "p99_us": 1490, "worst_us": 2210},
                                          "recorder": {"written": 2, "failed": 0, "room_mb": 812}} | client.more_status))
            text = "".join(f"event: {kind}\ndata: {json.dumps(data)}\n\n" for kind, data in events) or ": still here\n\n"
            self.wfile.write(text.encode())
            self.wfile.flush()
            beat += 1
            time.sleep(0.1)

    def get(self, client, url):
        box = self.box
        if url.path == "/api/frozen":
            self.send_frame(*client.frozen)
        elif url.path == "/api/lattice":
            self.reply(box.lattice(client))
        elif url.path == "/api/sheet":
            self.reply(SHEET)
        elif url.path == "/api/visits":
            self.reply(VISITS)
        elif url.path == "/api/disagreements":
            self.reply(box.disagreements(client))
        elif url.path == "/api/disagreements/d1/frame":
            step = int(urllib.parse.parse_qs(url.query)["step"][0])
            sighting = box.recording.sighting(7 - step)
            place = next(({"u": u, "v": v} for r, c, u, v, *_ in sighting["tubes"] if (r, c) == (41, 60)), {})
            sighting.update(time_s=100.5 - (7 - step) / 30, claim={"row": 41, "column": 60, "verdict": "contradicted", **place})
            self.send_frame(sighting, box.recording.jpegs[7 - step])
        elif url.path == "/api/recordings":
            self.reply([{"name": "lost-0003.tar.xz", "bytes": 4210033, "at": "02:12", "reason": "lost: jump"},
                        {"name": "disagreement-0004.tar.xz", "bytes": 3980120, "at": "02:41", "reason": "contradicted claim"}])
        elif url.path.startswith("/api/recordings/"):
            self.send(200, b"a recording", "application/octet-stream")
        elif url.path in ("/api/settings", "/api/backup"):
            text = (box.root / "docs/examples/box.toml").read_text(encoding="utf-8")
            if url.path == "/api/backup":
                self.send(200, text.encode(), "application/toml")
            else:
                self.reply({"text": text, "path": "box.toml", "files": ["box.toml"]})
        elif url.path == "/mock":
            self.reply({"asked": client.asked})
        else:
            self.reply({"error": "There is nothing of that name."}, 404)

    def do_PUT(self):
        self.do_POST()

    def do_POST(self):
        body = json.loads(self.rfile.read(int(self.headers.get("Content-Length") or 0)) or b"{}")
        client = self.box.client(self.name())
        if self.path == "/mock":
            self.change(client, body)
            self.reply({})
            return
        if self.headers.get("X-Tubesight") != "mock" and self.path != "/api/login":
            self.reply({"error": "The page's token is missing."}, 403)
            return
        client.asked.append([self.path, body])
        if self.path in client.replies:
            status, data = client.replies.pop(self.path)
            self.reply(data, status)
            return
        handler = getattr(self, "post_" + self.path.removeprefix("/api/").replace("/", "_").replace("-", "_"), None)
        if handler:
            self.reply(*(lambda made: made if isinstance(made, tuple) else (made,))(handler(client, body)))
        else:
            self.reply({"error": "There is nothing of that name."}, 404)

    def change(self, client, body):
        """A test's wish: scene, an event, another operator, a disagreement, an answer."""
        if "scene" in body:
            client.choose(body["scene"])
        if "operator" in body:
            client.operator = body["operator"]
            client.events.append(("operator", client.operator))
        if "disagreement" in body:
            client.disagreement = True
            client.events.append(("disagreement", {"id": "d1"}))
        client.more_status = body.get("status", client.more_status)
        if "role" in body:
            client.role = body["role"]
        for path, answer in body.get("replies", {}).items():
            client.replies[path] = tuple(answer)

    def post_login(self, client, body):
        if body.get("password") != SCENES[client.scene].get("password"):
            client.attempts += 1
            return {"error": "That password is not right.", "retry_after_s": 2 ** (client.attempts - 1)}, 403
        client.role = body["role"]
        return client.session()

    def post_operator(self, client, body):
        if body["take"] and client.operator["held"] and not client.operator["mine"] and not body.get("confirmed"):
            return {"error": "Somebody else operates.", "held_by": client.operator.get("name")}, 409
        client.operator = {"held": body["take"], "mine": body["take"], "name": body.get("name", "")}
        client.events.append(("operator", client.operator))
        return {}

    def post_freeze(self, client, _):
        client.frozen = self.box.frame(client)
        return {"field": client.frozen[0]["field"]}

    def post_start(self, client, body):
        return self.box.start(client, body)

    def post_pick(self, client, body):
        tubes = self.box.frame(client)[0]["tubes"]
        near = min(tubes, key=lambda t: math.hypot(t[2] - body["u"], t[3] - body["v"]), default=None)
        if near is None or math.hypot(near[2] - body["u"], near[3] - body["v"]) > 30:
            return {"doubt": True, "words": "no tube-end was measured there."}
        return {"row": near[0], "column": near[1], "kind": "tube"}

    def post_acknowledge(self, client, body):
        client.acknowledged = {"name": body["name"], "reason": body["reason"], "at_s": self.box.now()}
        return {}

    def post_lamp(self, client, body):
        client.lamp = {"permille": body.get("permille", 620), "automatic": "automatic" in body, "words": "well"}
        return {}

    def post_window(self, client, body):
        return {"when": "restart"}

    post_optimum = post_window

    def post_record(self, client, _):
        return {"path": "asked-0005.tar.xz"}

    def post_settings_check(self, client, body):
        bad = "colour" in body["text"]
        return {"messages": ["box.toml:3: unknown key 'colour', expected one of [camera]"] if bad else []}

    def post_settings(self, client, body):
        return {"messages": [], "saved": True, "backup": "box.toml.1"}

    def post_self_test(self, client, _):
        return {"good": True, "parts": [{"name": "golden recording", "verdict": "good", "words": "tracks as it must"},
                                        {"name": "lamp", "verdict": "good", "words": "the picture follows it"}]}


class Server(socketserver.ThreadingMixIn, http.server.HTTPServer):
    daemon_threads = True

    def handle_error(self, *_):
        pass  # A browser that goes away in the middle of an answer is no error.


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--port", type=int, default=0)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[3])
    arguments = parser.parse_args()
    Handler.box = Box(arguments.root)
    server = Server(("127.0.0.1", arguments.port), Handler)
    print(f"listening on {server.server_port}", flush=True)
    threading.Thread(target=server.serve_forever).start()


if __name__ == "__main__":
    main()
