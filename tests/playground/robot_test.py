#!/usr/bin/env python3
"""Programs of the page that drive a robot over Web Bluetooth: a virtual one behind the mocked radio, in a headless Chromium, which
is asked itself where it is and whether it stands. usage: robot_test.py ORB FOLDER [TEST...]

FOLDER is what `./dev playground` built."""

import os
import sys
import time
import unittest

from page_test import by_id, chromium, click, events, folder, fragment, idle, mock_bluetooth, mock_serial, note_violations, open_flash, orb, outcome, ready, site_server, stop, wait

names = {"bolt": "SB-1234", "mini": "SM-1234", "sprk+": "SK-1234", "rvr": "RV-1234", "r2d2": "D2-1234", "ollie": "2B-1234", "bb9e": "GB-1234"}
# The workers of the page.
world = """
window.workers = [];
window.Worker = class extends Worker { constructor(...all) { super(...all); window.workers.push(this); } };
"""
js = lambda body: f"async function startProgram() {{\n{body}\n}}\n"
# Programs that drive for ever, each with its file.
endless = {"a.js": js("setSpeed(90);\nprint('drives');\nawait delay(600);"), "a.bas": '10 goroll 0,90,1\n15 print "drives"\n20 delay 100\n30 goto 20\n'}
picture_folder = os.environ.get("ORB_PICTURES")


class Robot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = site_server.Site(folder)
        cls.browser = chromium.Browser(chromium.find())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.server.close()

    def open(self, files, kind="mini", before="", **more):
        self.wire = site_server.Handler.wire = site_server.Wire(orb, "--robot", kind)
        self.addCleanup(self.wire.close)
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.resize(1280, 860, False)
        mock = mock_bluetooth.replace("BB-1234", names.get(kind, "none")).replace("body: bytes }", "body: bytes, keepalive: true }")  # leaves even if the page goes away
        page.call("Page.addScriptToEvaluateOnNewDocument", source=note_violations + world + mock + before)
        page.go(self.server.url + fragment(files, **more))
        page.wait(ready, 40)
        self.addCleanup(lambda: self.assertIsNone(page.evaluate("window.violations")))
        open_flash(page)
        return page

    def drive(self, files, kind="mini", **more):
        page = self.open(files, kind, **more)
        page.evaluate(click("drive-bluetooth"))
        return page

    def until_it_drives(self, page):
        page.wait(f"({events}).some(words => words.includes('drives'))", 30)
        limit = time.monotonic() + 10
        while self.wire.state()["speed"] < 20:
            self.assertLess(time.monotonic(), limit, "it does not drive")
            time.sleep(0.05)

    def stands_within(self, seconds):
        """By its own clock; by itself it stops 1.2 s after the last command at the earliest."""
        begun = self.wire.state()["t"]
        while (state := self.wire.state())["speed"] > 1:
            self.assertLess(state["t"] - begun, seconds, f"it drives on: {state}")
            time.sleep(0.02)

    def stays(self):
        """It does not drive off again."""
        before = self.wire.state()
        time.sleep(1.5)
        after = self.wire.state()
        self.assertLess(abs(after["x"] - before["x"]) + abs(after["y"] - before["y"]), 2)

    def over(self, page, words, seconds=40):
        page.wait(idle, seconds)
        page.evaluate(wait(50))
        self.assertIn(words, page.evaluate(outcome))
        return page.evaluate(outcome)

    # -- as the program says --
    def test_it_drives_where_the_program_says(self):
        square = js("setMainLed({ r: 0, g: 0, b: 255 });\nawait roll(90, 80, 1.2);\nawait delay(0.6);\nconst { x, y } = getLocation();\n"
                    "print(getConnectedRobotType(), Math.round(x) > 20, Math.abs(y) < 15, getSpeed());\nawait roll(0, 80, 1);\nawait delay(0.5);\nprint(getElapsedTime() >= 3.3, getElapsedTime() < 5);")
        for kind in ("bolt", "mini", "sprk+", "rvr", "r2d2", "ollie", "bb9e"):
            with self.subTest(kind):
                page = self.drive({"a.js": square}, kind)
                page.wait(f"{outcome}.includes('driving the ')", 30)
                running = page.evaluate(outcome)
                self.assertEqual("that is chosen" in running, kind != "bolt", running)
                page.wait(f"({events}).length >= 1", 30)
                self.assertEqual(self.wire.state()["rgb"], "0,0,255")
                if picture_folder:
                    page.picture(os.path.join(picture_folder, f"edu-{kind}-live.png"))
                said = self.over(page, "has been stopped")
                state = self.wire.state()
                self.assertIn("ended after", said)
                self.assertEqual(page.evaluate(events), [f"{kind} true true 0", "true true"])
                self.assertGreater(state["x"], 20)
                self.assertGreater(state["y"], 20)
                self.assertLess(state["speed"], 1)
                self.assertGreater(page.evaluate("document.querySelectorAll('#map .run').length"), 0)
                shown = [float(number) for number in page.evaluate(f"/stopped at (-?[0-9]+),(-?[0-9]+) cm/.exec({outcome}).slice(1)")]
                self.assertLess(abs(shown[0] - state["x"]) + abs(shown[1] - state["y"]), 12)
                if picture_folder:
                    page.picture(os.path.join(picture_folder, f"edu-{kind}-over.png"))
                self.assertEqual(page.complaints, [])

    def test_a_classic_ball_is_driven_through_a_serial_port(self):
        page = self.open({"a.js": js("await roll(90, 80, 1);\nawait delay(0.5);\nprint(getConnectedRobotType(), getLocation().x > 20);")}, "sphero", before=mock_serial)
        page.evaluate(click("drive-serial"))
        page.wait(f"({events}).includes('sphero true')", 30)
        self.over(page, "has been stopped")
        self.assertGreater(self.wire.state()["x"], 20)
        self.stays()

    def test_it_feels_what_happens_to_it(self):
        page = self.drive({"a.js": "registerEvent(EventType.onCollision, async () => { stopRoll(); print('ouch'); await delay(0.2); exitProgram(); });\n" + js("setSpeed(90);\nprint('drives');")}, "bolt")
        self.until_it_drives(page)
        self.wire.tell("push 180 255")
        self.over(page, "has been stopped")
        self.assertIn("ouch", page.evaluate(events))
        self.stands_within(1)
        self.stays()

    def test_a_collision_is_listed_while_it_drives(self):
        for name, program in endless.items():
            with self.subTest(name):
                page = self.drive({name: program}, "bolt")
                self.until_it_drives(page)
                self.wire.tell("push 180 255")
                page.wait(f"({events}).some(words => words.startsWith('collision'))", 10)
                self.assertFalse(page.evaluate(idle))
                page.evaluate(stop)
                self.over(page, "has been stopped")
                self.assertEqual(len([words for words in page.evaluate(events) if words.startswith("collision")]), 1)

    def test_what_was_done_last_still_arrives(self):
        page = self.drive({"a.js": js("drawMatrixPixel({ r: 255, g: 0, b: 0 }, { x: 1, y: 1 });\n" * 8 + "setBackLed({ r: 9, g: 9, b: 9 });\nsetSpeed(200);")}, "bolt")
        page.wait(f"!({idle})")
        self.over(page, "has been stopped")
        self.stands_within(0.5)
        self.stays()
        self.assertEqual(self.wire.sent.count(b"\x1a\x2d"), 8)

    # -- whatever fails, it stands --
    def test_a_program_that_ends_while_it_drives(self):
        page = self.drive({"a.js": js("setSpeed(90);\nprint('drives');\nawait delay(1.5);")})
        self.until_it_drives(page)
        self.over(page, "has been stopped")
        self.stands_within(0.5)
        self.stays()

    def test_a_program_that_throws(self):
        page = self.drive({"a.js": js("setSpeed(90);\nprint('drives');\nawait delay(1);\nnull.x;")})
        self.until_it_drives(page)
        said = self.over(page, "has been stopped")
        self.assertIn("line 5", said)
        self.stands_within(0.5)
        self.stays()

    def test_a_program_that_loops_for_ever(self):
        for loop, words in (("for (;;);", "no time passes"), ("/^(a+)+$/.test('a'.repeat(60) + '!');", "did not let any time pass for 2 s"), ("await rawMotor(150, 150);\nawait delay(0.5);\nfor (;;);", "no time passes")):
            with self.subTest(loop):
                page = self.drive({"a.js": js(f"setSpeed(60);\nprint('drives');\nawait delay(0.5);\n{loop}")}, "bolt")
                self.until_it_drives(page)
                before = time.monotonic()
                self.assertIn(words, self.over(page, "has been stopped", 20))
                self.assertLess(time.monotonic() - before, 8)
                self.stands_within(2)
                self.stays()

    def test_stop_is_pressed(self):
        page = self.drive({"a.js": endless["a.js"]})
        self.until_it_drives(page)
        page.evaluate(click("run"))
        self.stands_within(1.1)
        self.assertIn("stopped after", self.over(page, "has been stopped"))
        self.stays()
        self.assertEqual(page.evaluate("document.querySelectorAll('iframe').length"), 0)

    def test_another_program_is_opened(self):
        page = self.drive({"a.js": endless["a.js"]})
        self.until_it_drives(page)
        page.evaluate(f"location.hash = {fragment({'b.orb': 'print 1'})!r}")
        self.stands_within(1.1)
        self.stays()

    def test_the_page_is_hidden(self):
        for name, program in endless.items():
            with self.subTest(name):
                page = self.drive({name: program})
                self.until_it_drives(page)
                page.evaluate("Object.defineProperty(document, 'hidden', { value: true }); document.dispatchEvent(new Event('visibilitychange', { bubbles: true }))")
                self.stands_within(1.1)
                self.assertIn("the page was hidden", self.over(page, "has been stopped"))
                self.stays()

    def test_the_page_is_closed(self):
        for source in (endless["a.js"], js("rawMotor(150, 150);\nprint('drives');\nawait delay(600);")):
            with self.subTest(source):
                page = self.drive({"a.js": source}, "bolt")
                self.until_it_drives(page)
                page.evaluate("location.href = 'about:blank'")
                self.stands_within(1.1)
                self.stays()

    def test_the_link_is_lost_and_comes_back(self):
        for name, program in endless.items():
            with self.subTest(name):
                page = self.drive({name: program})
                self.until_it_drives(page)
                page.evaluate("device.gatt.disconnect()")
                self.stands_within(1.1)
                self.assertIn("is gone", self.over(page, "the robot has been stopped"))
                self.stays()

    def test_the_link_is_lost_for_good(self):
        page = self.drive({"a.js": endless["a.js"]})
        self.until_it_drives(page)
        page.evaluate("window.out_of_reach = device.name; device.gatt.disconnect()")
        self.assertIn("is gone", self.over(page, "has not acknowledged the stop"))
        self.stands_within(3) # by itself
        self.stays()

    def test_the_engine_dies(self):
        for name, program in endless.items():
            for deed, words in (("worker.dispatchEvent(new ErrorEvent('error', { message: 'broken' }))", "check that it has stopped"), ("worker.terminate()", "does not answer")):
                with self.subTest(name=name, deed=deed):
                    page = self.drive({name: program})
                    self.until_it_drives(page)
                    page.evaluate(f"for (const worker of window.workers) {deed}")
                    self.stands_within(1.1 if "Error" in deed else 2.8)
                    self.assertIn("check that it has stopped", self.over(page, words))
                    self.stays()

    # -- before it drives --
    def test_it_is_cancelled_while_it_connects(self):
        page = self.open({"a.js": endless["a.js"]}, before="const connect = device.gatt.connect; device.gatt.connect = async function() { await new Promise(done => { window.let_in = done; }); return connect.call(this); };")
        page.evaluate(click("drive-bluetooth"))
        page.wait("!!window.let_in")
        page.evaluate(click("flash-cancel"))
        page.wait(f"{by_id('flash-cancel')}.hidden", 3)
        page.evaluate("let_in()")
        page.evaluate(wait(1500))
        self.assertFalse(page.evaluate("device.gatt.connected"))
        self.assertEqual(self.wire.sent, b"")
        self.assertEqual(self.wire.state()["y"], 0)
        self.assertTrue(page.evaluate(f"{by_id('flash-bluetooth')}.disabled && !{by_id('drive-bluetooth')}.disabled"))

    def test_it_is_stopped_before_it_has_moved(self):
        page = self.drive({"a.js": endless["a.js"]})
        page.wait("window.written?.length > 4")
        page.evaluate(click("run"))
        self.over(page, "was not moved")
        self.stays()
        self.assertEqual(self.wire.state()["y"], 0)
        self.assertFalse(page.evaluate("device.gatt.connected"))

    def test_a_text_that_does_not_parse_asks_nothing_of_a_robot(self):
        page = self.drive({"a.js": js("print('hello';")})
        page.wait(f"{by_id('outcome')}.classList.contains('bad')")
        self.assertTrue(page.evaluate(idle))
        self.assertEqual(self.wire.sent, b"")

    def test_a_robot_can_keep_no_such_program(self):
        page = self.open({"a.js": endless["a.js"]})
        self.assertTrue(page.evaluate(f"['flash-serial', 'flash-bluetooth', 'flash-file', 'flash-options'].every(name => document.getElementById(name).disabled)"))


if __name__ == "__main__":
    if not chromium.find() or not os.path.exists(os.path.join(folder, "orb.wasm")):
        print("no Chromium, or no playground is built")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
