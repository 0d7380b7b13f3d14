#!/usr/bin/env python3
"""The operator's page of a simulated box: who may do what, starts and picks, pictures, and that nobody delays the box.

Usage: page_test.py TUBESIGHTD TUBESIGHTCTL
"""
import csv
import http.client
import json
import pathlib
import ssl
import sqlite3
import struct
import subprocess
import sys
import threading
import time
import unittest

import page_flood
from page_box import Box, Browser, PASSWORDS, REPOSITORY
from page_flood import Crowd

BOX = CTL = ""


class Settings(unittest.TestCase):
    def expect(self, page, words):
        result = Box(self, BOX, page).check()
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_nobody_else_is_served_without_password_and_certificate(self):
        self.expect('address = "0.0.0.0"\n', ["without a password", "cross the network in clear"])
        self.expect('address = "here"\n', ["'here' is no address"])
        self.expect('passwords = "none"\n', ["page.passwords"])
        self.expect('certificate = "box.toml"\nkey = "box.toml"\n', ["none in PEM form"])

    def test_the_example_is_sound(self):
        result = subprocess.run([BOX, "--check", REPOSITORY / "docs/examples/box-with-page.toml"], check=False)
        self.assertEqual(result.returncode, 0)


class Alone(unittest.TestCase):
    """A box on this machine without passwords."""

    @classmethod
    def setUpClass(cls):
        cls.box = Box(cls, BOX, '[journal]\nfile = "J.db"\n').start(cls)

    @classmethod
    def addCleanup(cls, function, *arguments):  # of the class, as one box serves all cases
        cls.addClassCleanup(function, *arguments)

    def setUp(self):
        self.browser = Browser(self.box.port)
        session = self.browser.begin()
        self.assertEqual((session["role"], session["login"]), ("engineer", False))

    def test_other_names_and_other_sites_are_refused(self):
        self.assertEqual(self.browser.ask("GET", "/", Host="evil.example")[0], 421)
        self.assertEqual(self.browser.ask("GET", "/api/session", Origin="http://evil.example")[0], 403)
        for wrong in [{"X_Tubesight": "0" * 64}, {"X_Tubesight": None}, {"Cookie": "tubesight=x"},
                      {"Origin": "null"}]:
            self.assertIn(self.browser.ask("POST", "/api/pick", {"u": 1, "v": 1}, **wrong)[0], (401, 403), wrong)
        self.assertEqual(self.browser.ask("POST", "/api/pick", "u=1", Content_Type="text/plain")[0], 415)
        mine = f"http://127.0.0.1:{self.box.port}"
        self.assertEqual(self.browser.ask("POST", "/api/pick", {"u": 1, "v": 1}, Origin=mine)[0], 200)

    def test_every_answer_keeps_other_sites_out(self):
        for path in ("/", "/api/session", "/api/nothing"):
            self.browser.ask("GET", path)
            self.assertIn("default-src 'self'", self.browser.headers["Content-Security-Policy"])
            self.assertEqual(self.browser.headers["X-Content-Type-Options"], "nosniff")
        fresh = Browser(self.box.port)
        fresh.ask("GET", "/api/session")
        for word in ("HttpOnly", "SameSite=Strict"):
            self.assertIn(word, fresh.headers["Set-Cookie"])

    def test_nothing_but_its_files_is_served(self):
        for path in ("/../etc/passwd", "/page/../../etc/passwd", "/page/%2e%2e/%2e%2e/etc/passwd", "/page/",
                     "/etc/passwd", "/api/recordings/../secret.y4m", "/api/recordings/%2e%2e%2fsecret.y4m",
                     "/api/recordings/secret.y4m", "/api/recordings//etc/passwd", "/api/", "/api/frame/x"):
            self.assertEqual(self.browser.ask("GET", path)[0], 404, path)
        self.assertEqual(self.browser.ask("GET", "/" + "x" * 300)[0], 414)
        self.assertIn(self.browser.ask("DELETE", "/api/settings")[0], (405, 501))

    def test_bodies_are_bounded_and_read_with_care(self):
        self.assertEqual(self.browser.ask("POST", "/api/pick", b" " * 70_000)[0], 413)
        self.browser.connection = None

        def endless():
            for _ in range(40):
                yield b"x" * 4096
        try:
            connection = self.browser.open()
            connection.request("POST", "/api/pick", endless(), {
                "Cookie": self.browser.cookie, "X-Tubesight": self.browser.token,
                "Content-Type": "application/json"}, encode_chunked=True)
            self.assertGreaterEqual(connection.getresponse().status, 400)
        except (http.client.HTTPException, OSError):
            pass  # cut off
        self.browser.connection = None
        for body in ("", "[]", "{", "null", '"x"', "[" * 30_000, '{"u":1e999,"v":1}', '{"u":"1","v":1}',
                     '{"u":1}', "\xff\xfe"):
            self.assertEqual(self.browser.ask("POST", "/api/pick", body.encode("latin-1"))[0], 400, body[:20])
        self.browser.ask("POST", "/api/operator", {"take": True, "name": "Ann", "confirmed": True})
        for tubes in ([], [1], [{"row": 1.5, "column": 1, "u": 1, "v": 1}], "x",
                      [{"row": 1, "column": 1, "u": 1, "v": 1}] * 9,
                      [{"row": 18446744073709551615, "column": 1, "u": 1, "v": 1}]):
            self.assertEqual(self.browser.ask("POST", "/api/start", {"tubes": tubes})[0], 400, tubes)
        for body in ({"permille": 1001}, {"permille": -1}, {}, {"permille": 1, "automatic": True}):
            self.assertEqual(self.browser.ask("POST", "/api/lamp", body)[0], 400, body)

    def test_pictures_and_sightings_come_in_pairs_and_grow(self):
        fields = [-1]
        for _ in range(5):
            status, sighting, picture = self.browser.frame(fields[-1])
            self.assertEqual(status, 200)
            self.assertGreater(sighting["field"], fields[-1])
            self.assertTrue(picture.startswith(b"\xff\xd8\xff") and picture.endswith(b"\xff\xd9"))
            self.assertLess(abs(sighting["now_s"] - sighting["time_s"]), 2)
            fields.append(sighting["field"])
        self.assertEqual(self.browser.frame(1 << 60)[0], 204)

    def test_a_picture_waits_for_nothing_but_its_field(self):
        """Fields come every 16.7 ms; the best of some, as the machine may have other work."""
        after, waits = -1, []
        for _ in range(20):
            asked = time.monotonic()
            status, sighting, _ = self.browser.frame(after)
            self.assertEqual(status, 200)
            after = sighting["field"]
            waits.append(time.monotonic() - asked)
        self.assertLess(sorted(waits)[5], 0.1, waits)

    def test_one_operates_and_starts_and_picks(self):
        browser, other = self.browser, Browser(self.box.port)
        other.begin()
        status, told = browser.ask("POST", "/api/operator", {"take": True, "name": "Ann", "confirmed": True})
        self.assertTrue(status == 200 and told["mine"], told)
        self.assertEqual(other.ask("POST", "/api/start", {})[1]["held_by"], "Ann")
        self.assertEqual(other.ask("POST", "/api/operator", {"take": True, "name": "Bob"})[0], 409)
        status, told = browser.ask("POST", "/api/start", {"tubes": [
            {"row": 1, "column": 1, "u": 2, "v": 2}] * 3})
        self.assertFalse(told["taken"])
        self.assertTrue(told["refusal"] and told["words"] and told["advice"], told)
        status, told = browser.ask("POST", "/api/start", {})
        self.assertEqual((status, told), (200, {"taken": True}))
        self.assertEqual(self.journalled("start", "by=Ann")[0], "taken")
        sighting = self.wait_for(browser, lambda now: now["state"] == "tracking" and now.get("tool"))
        tool = sighting["tool"]
        status, named = browser.ask("POST", "/api/pick", {
            "u": tool["u"], "v": tool["v"], "field": sighting["field"]})
        self.assertEqual((named.get("row"), named.get("column")), (tool["row"], tool["column"]), named)
        status, told = browser.ask("POST", "/api/start", {})
        self.assertEqual((told["taken"], told["refusal"], told["confirmable"]), (False, "tracking", True))
        self.assertTrue(self.wait_for(browser, lambda now: now["state"] == "tracking"))
        status, told = other.ask("POST", "/api/operator", {"take": True, "name": "Bob", "confirmed": True})
        self.assertTrue(told["mine"])
        self.assertEqual(browser.ask("POST", "/api/lamp", {"permille": 900})[0], 409)
        self.assertEqual(other.ask("POST", "/api/lamp", {"permille": 900})[1],
                         {"permille": 900, "automatic": False})

    def test_a_start_by_clicks_needs_a_person_who_was_warned_of_turned_numbers(self):
        browser = self.browser
        browser.ask("POST", "/api/operator", {"take": True, "name": "Cy", "confirmed": True})
        turned = {"tubes": [{"row": 1, "column": 1, "u": 9, "v": 9}], "confirmed": True}
        told = [browser.ask("POST", "/api/start", turned)[1] for _ in range(3)]
        warnings = [each["refusal"] for each in told if each["confirmable"]]
        self.assertIn(warnings, (["numbering"], ["tracking", "numbering"]))
        self.assertIn("turned", told[len(warnings) - 1]["words"])
        # Another session was warned of nothing, whatever it confirms.
        other = Browser(self.box.port)
        other.begin()
        other.ask("POST", "/api/operator", {"take": True, "name": "Di", "confirmed": True})
        self.assertTrue(other.ask("POST", "/api/start", turned)[1]["confirmable"])

    def test_a_session_tells_the_clock_of_the_pictures(self):
        first = self.browser.ask("GET", "/api/session")[1]
        _, sighting, _ = self.browser.frame(-1)
        then = self.browser.ask("GET", "/api/session")[1]
        self.assertLessEqual(sighting["time_s"], then["now_s"])
        self.assertLess(first["now_s"], then["now_s"])
        self.assertNotIn("boot", then["box"])  # nobody counts them here

    def journalled(self, kind, words):
        """Waits for a row of the journal of this kind with these words in its detail."""
        deadline = time.monotonic() + 20
        while time.monotonic() < deadline:
            database = sqlite3.connect(f"file:{self.box.folder}/J.db?mode=ro", uri=True)
            rows = database.execute("SELECT verdict, detail FROM journal WHERE kind = ?", (kind,)).fetchall()
            database.close()
            found = [row for row in rows if words in row[1]]
            if found:
                return found[-1]
            time.sleep(0.05)
        raise AssertionError((kind, words, rows))

    def wait_for(self, browser, condition):
        deadline, after = time.monotonic() + 20, -1
        while time.monotonic() < deadline:
            status, sighting, _ = browser.frame(after)
            if status == 200:
                after = sighting["field"]
                if condition(sighting):
                    return sighting
        raise AssertionError(f"never came: {sighting}")

    def test_a_frozen_picture_has_a_lattice_with_the_four_turns_of_a_square_sheet(self):
        status, told = self.browser.ask("POST", "/api/freeze", {})
        self.assertEqual(status, 200)
        status, data = self.browser.ask("GET", "/api/frozen")
        size = struct.unpack("<I", data[:4])[0]
        self.assertEqual(json.loads(data[4:4 + size])["field"], told["field"])
        status, lattice = self.browser.ask("GET", "/api/lattice")
        self.assertTrue(lattice["found"], lattice)
        self.assertGreater(len(lattice["elements"]), 10)
        self.assertEqual(len(lattice["ways"]), 4, lattice["ways"])

    def test_events_tell_status_and_operator_and_beat(self):
        connection = self.browser.open()
        connection.request("GET", "/api/events", headers={"Cookie": self.browser.cookie})
        answer = connection.getresponse()
        self.assertEqual(answer.getheader("Content-Type"), "text/event-stream")
        heard, deadline = b"", time.monotonic() + 15
        while time.monotonic() < deadline and not (
                b"event: status" in heard and b"event: operator" in heard and b": beat" in heard):
            heard += answer.read1(65536)
        for word in (b"event: status", b"event: operator", b": beat"):
            self.assertIn(word, heard)
        connection.close()

    def test_settings_are_checked_and_kept(self):
        status, now = self.browser.ask("GET", "/api/settings")
        status, told = self.browser.ask("POST", "/api/settings/check", {"text": now["text"] + "[nothing]\n"})
        self.assertIn("unknown table", told["messages"][0])
        status, told = self.browser.ask("PUT", "/api/settings", {"text": now["text"] + "[nothing]\n"})
        self.assertFalse(told["saved"])
        self.assertEqual((self.box.folder / "box.toml").read_text(), now["text"])
        status, told = self.browser.ask("PUT", "/api/settings", {"text": now["text"] + "# tried\n"})
        self.assertTrue(told["saved"], told)
        self.assertEqual(pathlib.Path(told["backup"]).read_text(), now["text"])
        self.assertEqual(self.browser.ask("GET", "/api/backup")[1].decode(), now["text"] + "# tried\n")
        self.journalled("setting", "what=saved by=")

    def test_the_rest_answers(self):
        for path in ("/api/sheet", "/api/visits", "/api/disagreements", "/api/recordings"):
            self.assertEqual(self.browser.ask("GET", path)[0], 200, path)
        status, told = self.browser.ask("POST", "/api/self-test", {})
        self.assertIn("numbers", [part["name"] for part in told["parts"]])


RECORDING = REPOSITORY / "tests/data/recordings/square_flush"
REPLAYED = f"""include = ["{RECORDING}/session.toml"]
[source]
kind = "replay"
recording = "{RECORDING}/recording.y4m.xz"
script = true
"""


def kept_sightings():
    """What tests/data keeps of each field of the recording, in the words and digits of its file."""
    with open(RECORDING / "expected_fields.csv", newline="", encoding="utf-8") as file:
        return [tuple(row[name] for name in KEPT) for row in csv.DictReader(file)]


KEPT = ("state", "reason", "tracked", "aligned", "primary_row", "primary_column", "primary_u_px", "primary_v_px", "tool_row",
        "tool_column", "tool_offset_mm", "tool_dx_mm", "tool_dy_mm", "tool_height_mm", "margin", "residual_px", "liveness")


def as_kept(told):
    """A sighting that the page was told, in the same words and digits; what is not known is empty."""
    tool = told.get("tool", {})

    def text(place, key, digits):
        return f"{place[key]:.{digits}f}" if key in place else ""

    return (told["state"], told.get("reason", ""), text(told, "tracked", 0), str(int(told["aligned"])),
            text(told["primary"], "row", 0), text(told["primary"], "column", 0), text(told["primary"], "u", 3),
            text(told["primary"], "v", 3), text(tool, "row", 0), text(tool, "column", 0), text(tool, "offset_mm", 4),
            text(tool, "dx_mm", 4), text(tool, "dy_mm", 4), text(told, "height_mm", 4), text(told, "margin_sigma", 4),
            text(told, "residual_px", 3), told["liveness"])


class Replayed(unittest.TestCase):
    """A box that plays a recording, again and again, whose sightings tests/data keeps."""

    def test_viewers_and_a_flood_change_nothing_and_delay_nobody(self):
        """All that the tracking thread says while the page is flooded is what it says alone, to the last digit."""
        box = Box(self, BOX, source=REPLAYED).start(self)
        kept, told, crowd = kept_sightings(), {}, Crowd()
        self.addCleanup(crowd.stop)
        page_flood.add_viewers(crowd, box.port, 4, take=lambda each: told.update({each["field"]: each}))
        page_flood.add_flood(crowd, box.port)
        time.sleep(4.5)
        crowd.stop()
        asking = Browser(box.port)
        asking.begin()
        status = asking.ask("GET", "/api/status")[1]
        # A pass begins where it begins: each of its fields must agree for one place of its first.
        begins, compared = set(), 0
        for field, each in sorted(told.items()):
            if each["state"] == "tracking" and each["judged"]:
                places = [index for index, row in enumerate(kept) if row == as_kept(each)]
                self.assertEqual(len(places), 1, f"field {field} is not what the recording's is: {as_kept(each)}")
                begins.add(field - places[0])
                compared += 1
                moved = {**each, "primary": {**each["primary"], "u": each["primary"]["u"] + 0.001}}
                self.assertNotIn(as_kept(moved), kept, "a thousandth of a pixel makes no difference")
        self.assertLessEqual(len(begins), status["source"]["passes"] + 1, "fields in another order than the recording's")
        self.assertGreater(compared, 20, crowd.done)
        self.assertGreater(len(begins), 1)
        for act in ("viewer 3", "requests", "bodies", "logins", "lattice searches", "slow readers", "half requests"):
            self.assertGreater(crowd.done.get(act, 0), 1, (act, crowd.done, crowd.failed))
        self.assertLess(status["step"]["median_us"], 2000)


class WithPasswords(unittest.TestCase):
    """A box that others than this machine could ask: passwords by role, and TLS."""

    @classmethod
    def setUpClass(cls):
        cls.box = Box(cls, BOX, 'passwords = "passwords"\ncertificate = "cert.pem"\nkey = "key.pem"\n')
        for role, password in PASSWORDS.items():
            subprocess.run([CTL, "page-password", cls.box.folder / "passwords", role], input=password + "\n",
                           text=True, check=True, timeout=60)
        made = subprocess.run([CTL, "page-certificate", cls.box.folder / "cert.pem", cls.box.folder / "key.pem",
                               "127.0.0.1", "box1"], capture_output=True, text=True, check=True, timeout=60)
        assert made.stdout.startswith("SHA-256 "), made.stdout
        cls.context = ssl.create_default_context(cafile=str(cls.box.folder / "cert.pem"))
        cls.box.start(cls)

    @classmethod
    def addCleanup(cls, function, *arguments):
        cls.addClassCleanup(function, *arguments)

    def browser(self):
        return Browser(self.box.port, self.context)

    def test_roles_may_what_they_may(self):
        stranger = self.browser()
        self.assertEqual(stranger.begin()["role"], "none")
        self.assertIn("Secure", stranger.headers["Set-Cookie"])
        for path in ("/api/frame", "/api/status", "/api/events", "/api/settings", "/api/recordings"):
            self.assertEqual(stranger.ask("GET", path)[0], 401, path)
        viewer = self.browser().log_in("viewer")
        self.assertEqual(viewer.frame()[0], 200)
        for path in ("/api/start", "/api/operator", "/api/lamp", "/api/record", "/api/acknowledge"):
            self.assertEqual(viewer.ask("POST", path, {})[0], 403, path)
        operator = self.browser().log_in("operator")
        self.assertEqual(operator.ask("POST", "/api/operator", {"take": True, "name": "Ann"})[0], 200)
        self.assertEqual(operator.ask("POST", "/api/lamp", {"permille": 900})[0], 200)
        self.assertEqual(operator.ask("PUT", "/api/settings", {"text": ""})[0], 403)
        engineer = self.browser().log_in("engineer")
        self.assertEqual(engineer.ask("GET", "/api/backup")[0], 200)
        self.assertEqual(engineer.ask("POST", "/api/logout", {})[0], 200)
        self.assertEqual(engineer.ask("GET", "/api/backup")[0], 401)

    def test_wrong_passwords_are_slowed(self):
        guesser = self.browser()
        guesser.begin()
        status, told = guesser.ask("POST", "/api/login", {"role": "operator", "password": "guess number 1"})
        self.assertEqual(status, 403)
        begun, waits = time.monotonic(), []
        while time.monotonic() - begun < 1.5:
            status, told = guesser.ask("POST", "/api/login", {"role": "operator", "password": "guess again"})
            self.assertEqual(status, 403)
            waits.append(told["retry_after_s"])
            time.sleep(0.02)
        self.assertGreaterEqual(max(waits), 2)
        time.sleep(max(waits) + 0.5)
        guesser.log_in("operator")

    def test_in_clear_nothing_is_said(self):
        with self.assertRaises((http.client.HTTPException, OSError)):
            Browser(self.box.port).ask("GET", "/api/session")


if __name__ == "__main__":
    BOX, CTL = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], warnings="ignore")
