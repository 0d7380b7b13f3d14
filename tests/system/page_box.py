#!/usr/bin/env python3
"""A simulated box with the operator's page, and a browser's questions to it: for tests and measurements of the page."""
import http.client
import json
import os
import pathlib
import signal
import socket
import struct
import subprocess
import tempfile
import time

PASSWORDS = {"viewer": "only looking on", "operator": "clicks tube-ends", "engineer": "knows the keys"}


def free_port():
    with socket.socket() as any_port:
        any_port.bind(("127.0.0.1", 0))
        return any_port.getsockname()[1]


REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
SIMULATED = f"""[source]
kind = "simulated"
scenario = "{REPOSITORY}/docs/examples/steam-generator.toml"
"""


class Browser:
    """One session, over one connection at a time."""

    def __init__(self, port, context=None):
        self.port, self.context, self.cookie, self.token = port, context, "", ""
        self.connection = None

    def open(self):
        if self.context:
            return http.client.HTTPSConnection("127.0.0.1", self.port, timeout=15, context=self.context)
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=15)

    def ask(self, method, path, body=None, **headers):
        self.connection = self.connection or self.open()
        sent = {"Cookie": self.cookie} if self.cookie else {}
        if body is not None:
            sent.update({"Content-Type": "application/json", "X-Tubesight": self.token})
            body = body if isinstance(body, (str, bytes)) else json.dumps(body)
        sent.update({name.replace("_", "-"): value for name, value in headers.items()})
        try:
            self.connection.request(method, path, body, {k: v for k, v in sent.items() if v is not None})
            answer = self.connection.getresponse()
            data = answer.read()
        except (http.client.HTTPException, OSError):
            self.connection.close()
            self.connection = None
            raise
        if answer.getheader("Set-Cookie"):
            self.cookie = answer.getheader("Set-Cookie").split(";")[0]
        self.headers = answer.headers
        if answer.getheader("Connection") == "close":
            self.connection.close()
            self.connection = None
        if answer.getheader("Content-Type") == "application/json" and data:
            data = json.loads(data)
        return answer.status, data

    def begin(self):
        status, session = self.ask("GET", "/api/session")
        assert status == 200, (status, session)
        self.token = session["token"]
        return session

    def log_in(self, role):
        self.begin()
        status, session = self.ask("POST", "/api/login", {"role": role, "password": PASSWORDS[role]})
        assert status == 200 and session["role"] == role, (status, session)
        self.token = session["token"]
        return self

    def frame(self, after=-1):
        status, data = self.ask("GET", f"/api/frame?after={after}")
        if status != 200:
            return status, None, b""
        size = struct.unpack("<I", data[:4])[0]
        return status, json.loads(data[4:4 + size]), data[4 + size:]


class Box:
    """A box in a folder of its own, simulated unless `source` says otherwise. What `case` cleans up is undone."""

    def __init__(self, case, program, page="", source=None, realtime="priority = 0\nlock_memory = false\n"):
        self.program = program
        kept = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(kept.name)
        self.port = free_port()
        (self.folder / "rec").mkdir()
        (self.folder / "secret.y4m").write_text("not of the recorder")
        (self.folder / "box.toml").write_text(f"""{source or SIMULATED}
[control]
socket = "{self.folder}/control"
[record]
folder = "{self.folder}/rec"
memory_mb = 32
[realtime]
{realtime}[page]
port = {self.port}
""" + page)
        case.addCleanup(kept.cleanup)

    def check(self):
        return subprocess.run([self.program, "--check", self.folder / "box.toml"], capture_output=True, text=True,
                              timeout=60, check=False)

    def start(self, case, seconds=30, otherwise=None):
        """Waits until the page is served, so long at most; `otherwise` is what is told when it is not."""
        self.log = open(self.folder / "log", "w+", encoding="utf-8")
        self.process = subprocess.Popen([self.program, self.folder / "box.toml"], stderr=self.log,
                                        preexec_fn=lambda: os.nice(1))
        case.addCleanup(self.stop)
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline and self.process.poll() is None:
            try:
                socket.create_connection(("127.0.0.1", self.port), timeout=1).close()
                return self
            except OSError:
                time.sleep(0.05)
        raise AssertionError(otherwise or (self.folder / "log").read_text())

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        self.status = self.process.wait(timeout=30)
        self.log.close()
