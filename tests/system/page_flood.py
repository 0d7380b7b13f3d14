#!/usr/bin/env python3
"""What people and others can do to the page at once: viewers who look, and a flood that asks for all that costs something."""
import http.client
import json
import socket
import ssl
import threading
import time

from page_box import Browser

TROUBLE = (http.client.HTTPException, OSError, ssl.SSLError, ValueError, AssertionError)


class Crowd:
    """Threads that go on until stop(); `done` counts what each kind did, `failed` what was refused or cut off."""

    def __init__(self):
        self.stopped = threading.Event()
        self.threads = []
        self.done, self.failed = {}, {}

    def add(self, name, act, pause_s=0.0):
        """Calls `act` again and again, from its own thread; what it raises is counted."""
        def run():
            while not self.stopped.is_set():
                try:
                    act()
                    self.done[name] = self.done.get(name, 0) + 1
                except TROUBLE:
                    self.failed[name] = self.failed.get(name, 0) + 1
                self.stopped.wait(pause_s)
        self.threads.append(threading.Thread(target=run))
        self.threads[-1].start()

    def stop(self):
        self.stopped.set()
        for thread in self.threads:
            thread.join()


def add_viewers(crowd, port, number, context=None, take=None):
    """`number` of those who look, each for the newest picture; take(sighting) hears what the first one sees."""
    for index in range(number):
        viewer, after = Browser(port, context), [-1]
        viewer.begin()

        def look(viewer=viewer, after=after, index=index):
            status, sighting, _ = viewer.frame(after[0])
            if status == 200:
                after[0] = sighting["field"]
                if take and index == 0:
                    take(sighting)
        crowd.add(f"viewer {index}", look)


def slow_reader(port):
    """Asks for many pictures and reads nothing."""
    asked = Browser(port)
    asked.begin()
    with socket.create_connection(("127.0.0.1", port), timeout=5) as line:
        question = f"GET /api/frame HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nCookie: {asked.cookie}\r\n\r\n"
        line.sendall(question.encode() * 20)
        time.sleep(1.0)


def half_a_request(port):
    """A request that never ends, a byte at a time."""
    with socket.create_connection(("127.0.0.1", port), timeout=5) as line:
        for letter in f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nX-Slow: ".encode() + b"x" * 40:
            line.sendall(bytes([letter]))
            time.sleep(0.02)


def add_flood(crowd, port, context=None):
    """All that costs the box something, from as many connections as one address gets, and more."""
    def asking(method, path, body=None, fresh=False):
        browser = Browser(port, context)

        def ask():
            if browser.connection is None or fresh:
                browser.connection = None
                browser.begin()
            browser.ask(method, path, body)
        return ask

    for _ in range(2):
        crowd.add("requests", asking("GET", "/api/status"), 0.001)
        crowd.add("sessions", asking("GET", "/api/session", fresh=True), 0.002)
        crowd.add("bodies", asking("PUT", "/api/settings", json.dumps({"text": "x" * 900_000})), 0.01)
        crowd.add("big questions", asking("POST", "/api/pick", b" " * 60_000), 0.005)
        crowd.add("logins", asking("POST", "/api/login", {"role": "operator", "password": "a guess"}), 0.002)
    searcher = Browser(port, context)

    def search():
        if searcher.connection is None:
            searcher.begin()
        searcher.ask("POST", "/api/freeze", {})
        searcher.ask("GET", "/api/lattice")
    crowd.add("lattice searches", search)
    for _ in range(4):
        crowd.add("closed at once", lambda: socket.create_connection(("127.0.0.1", port), timeout=5).close(), 0.002)
        if context is None:
            crowd.add("slow readers", lambda: slow_reader(port))
            crowd.add("half requests", lambda: half_a_request(port))
