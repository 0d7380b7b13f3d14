#!/usr/bin/env python3
"""What a stranger on the line may try at the operator's page: malformed, unending, doubled and injected requests.

Usage: page_security_test.py TUBESIGHTD

Speaks bytes, not a library's HTTP. Who may do what, and the slowing of logins, are page_test.py's.
"""
import socket
import sys
import time
import unittest

from page_box import Box, Browser

BOX = ""


class Malformed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.box = Box(cls, BOX).start(cls)
        cls.browser = Browser(cls.box.port)
        cls.browser.begin()
        cls.dawdling = [socket.create_connection(("127.0.0.1", cls.box.port), timeout=25) for _ in range(30)]
        for line in cls.dawdling:
            line.sendall(b"POST /api/pick HTTP/1.1\r\nContent-Le")
        cls.begun = time.monotonic()

    @classmethod
    def addCleanup(cls, function, *arguments):  # of the class, as one box serves all cases
        cls.addClassCleanup(function, *arguments)

    def tearDown(self):
        self.browser.connection = None
        self.assertEqual(self.browser.ask("GET", "/api/session")[0], 200, "the box serves nobody any more")

    def send(self, request, seconds=3.0):
        """All that is answered to these bytes until the line is closed or silent."""
        heard = b""
        with socket.create_connection(("127.0.0.1", self.box.port), timeout=seconds) as line:
            try:
                line.sendall(request)
                while True:
                    more = line.recv(65536)
                    if not more:
                        break
                    heard += more
            except OSError:
                pass
        return heard

    def head(self, first="GET /api/session HTTP/1.1", *more):
        lines = [first, f"Host: 127.0.0.1:{self.box.port}", *more]
        return "\r\n".join(lines).encode("latin-1") + b"\r\n\r\n"

    def post(self, *more, body=b""):
        return self.head("POST /api/pick HTTP/1.1", f"Cookie: {self.browser.cookie}", "Content-Type: application/json",
                         f"X-Tubesight: {self.browser.token}", *more) + body

    def statuses(self, heard):
        return [int(part[:3]) for part in heard.split(b"HTTP/1.1 ")[1:]]

    def test_a_sound_request_of_these_bytes_is_answered(self):
        """So that what is refused below is not refused for something else."""
        body = b'{"u":1,"v":1}'
        self.assertEqual(self.statuses(self.send(self.head(), 0.5)), [200])
        self.assertEqual(self.statuses(self.send(self.post(f"Content-Length: {len(body)}", body=body), 0.5)), [200])

    def test_no_second_request_is_smuggled_in_a_first(self):
        """Two lengths, or a length beside chunks: never more than one answer of success to one request."""
        inner = self.head("GET /api/session HTTP/1.1")
        for lengths in (["Content-Length: 2", f"Content-Length: {2 + len(inner)}"],
                        [f"Content-Length: {2 + len(inner)}", "Content-Length: 2"],
                        [f"Content-Length: {5 + len(inner)}", "Transfer-Encoding: chunked"],
                        ["Transfer-Encoding: chunked", f"Content-Length: {5 + len(inner)}"],
                        ["Content-Length: +2"], ["Content-Length: 2, 2"], ["Content-Length: -1"],
                        ["Content-Length: 0x2"], ["Content-Length: 99999999999999999999"]):
            body = b"0\r\n\r\n" if any("chunked" in each for each in lengths) else b"{}"
            heard = self.send(self.post(*lengths, body=body + inner), 0.5)
            self.assertNotIn(200, self.statuses(heard), (lengths, heard[:300]))

    def test_names_and_values_cannot_be_written_into_an_answer(self):
        for path in ("/%0d%0aSet-Cookie:%20x=1", "/page/%0d%0a%0d%0a<script>", "/api/recordings/a%0d%0aX-Evil:1",
                     "/<script>alert(1)</script>", "/api/frame?after=%0d%0aX-Evil:1"):
            heard = self.send(self.head(f"GET {path} HTTP/1.1", f"Cookie: {self.browser.cookie}"), 0.3)
            head = heard.split(b"\r\n\r\n")[0]
            self.assertNotIn(b"X-Evil", head)
            self.assertNotIn(b"x=1", head)
            self.assertNotIn(b"<script>", heard)

    def test_names_of_the_site_are_compared_whole(self):
        port = self.box.port
        for host in ("127.0.0.1", f"127.0.0.1:{port}.evil.example", f"evil.example#127.0.0.1:{port}", "", f"127.0.0.1:{port + 1}",
                     f"user@127.0.0.1:{port}"):
            heard = self.send(f"GET /api/session HTTP/1.1\r\nHost: {host}\r\n\r\n".encode(), 0.3)
            self.assertNotIn(200, self.statuses(heard), host)
        self.assertNotIn(200, self.statuses(self.send(b"GET /api/session HTTP/1.1\r\n\r\n", 0.3)))
        for origin in (f"http://127.0.0.1:{port}.evil.example", f"https://127.0.0.1:{port}", "null", "http://",
                       f"http://evil.example/http://127.0.0.1:{port}", f"http://127.0.0.1:{port}@evil.example"):
            self.assertEqual(self.statuses(self.send(self.head("GET /api/session HTTP/1.1", f"Origin: {origin}"), 0.3)), [403],
                             origin)

    def test_heads_are_bounded(self):
        for line in ("X-Long: " + "x" * 40_000, "\r\n".join(f"X-{number}: {'y' * 90}" for number in range(600))):
            self.assertNotIn(200, self.statuses(self.send(self.head("GET /api/session HTTP/1.1", line), 1.0)))
        self.assertNotIn(200, self.statuses(self.send(b"GET /" + b"x" * 60_000 + b" HTTP/1.1\r\n\r\n", 1.0)))

    def test_what_is_no_http_harms_nobody(self):
        for words in (b"\x16\x03\x01\x02\x00\x01\x00" + bytes(200), b"\0" * 500, b"GET\r\n\r\n", b"\r\n" * 200, b"PRI * HTTP/2.0\r\n\r\n",
                      b"GET /api/session HTTP/9.9\r\n\r\n", b"GET /\x00/api HTTP/1.1\r\nHost: a\r\n\r\n",
                      b"OPTIONS * HTTP/1.1\r\nHost: a\r\n\r\n", b"CONNECT a:1 HTTP/1.1\r\nHost: a\r\n\r\n",
                      b"TRACE /api/session HTTP/1.1\r\n" + self.head()[len(b"GET /api/session HTTP/1.1\r\n"):]):
            self.assertNotIn(200, self.statuses(self.send(words, 0.2)), words[:40])

    def test_who_dawdles_is_cut_off_and_keeps_nobody_out(self):
        """Half requests of setUpClass, all cases beside them: closed after the silence that docs/page.md tells."""
        asked = time.monotonic()
        Browser(self.box.port).begin()
        self.assertLess(time.monotonic() - asked, 5)
        for line in self.dawdling:
            self.assertEqual(self.closed_after(line), b"")
            line.close()
        self.assertLess(time.monotonic() - self.begun, 25)

    def closed_after(self, line):
        try:
            heard = line.recv(1000)
            return b"" if heard.startswith(b"HTTP/1.1 408") else heard
        except ConnectionError:
            return b""

    def test_a_name_is_told_as_data_and_never_as_a_page(self):
        """Names and reasons come back as JSON, whatever they are; the page's own test looks at what it shows of them."""
        evil = "</script><img src=x onerror=alert(1)>\u2028"
        status, told = self.browser.ask("POST", "/api/operator", {"take": True, "name": evil, "confirmed": True})
        self.assertEqual(status, 200)
        self.assertTrue(evil.startswith(told["name"]) and len(told["name"]) > 20, told)
        self.assertEqual(self.browser.headers["Content-Type"], "application/json")
        for path in ("/api/" + "<b>", "/api/disagreements/<b>/frame"):
            self.browser.ask("GET", path)
            self.assertEqual(self.browser.headers["Content-Type"], "application/json")
            self.assertEqual(self.browser.headers["X-Content-Type-Options"], "nosniff")


class OffByDefault(unittest.TestCase):
    def test_without_the_table_nobody_listens(self):
        box = Box(self, BOX)
        text = (box.folder / "box.toml").read_text()
        (box.folder / "box.toml").write_text(text[:text.index("[page]")])
        with self.assertRaisesRegex(AssertionError, "never served"):
            box.start(self, seconds=2.5, otherwise="never served")


if __name__ == "__main__":
    BOX = sys.argv[1]
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], warnings="ignore")
