#!/usr/bin/env python3
"""Tests the page of `orb drive --page` in a headless Chromium: the joystick drives a virtual robot, releasing it and
closing the page stop the robot, and every sensor has a curve. usage: drive_test.py ORB [PICTURE.png]

Exits with 77 (skipped, to ctest) if Chromium is not installed."""

import os
import re
import signal
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request

import browser as chromium

orb = os.path.abspath(sys.argv[1])
picture = sys.argv[2] if len(sys.argv) > 2 else None

speed = "Number(document.getElementById('state').textContent.match(/([0-9]+) cm\\/s/)?.[1] ?? 0)"
told = "document.getElementById('state').textContent.match(/told ([0-9]+)° at ([0-9]+)/)?.slice(1).join(' ')"


class Drive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="orb-report.")
        cls.browser = chromium.Browser(chromium.find())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    def setUp(self):
        self.orb = subprocess.Popen([orb, "drive", "--port", "sim:", "--robot", "bolt", "--page"], cwd=self.folder.name,
                                    stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.url = re.search(r"http://\S+", self.orb.stderr.readline()).group()
        self.page = self.browser.page()
        self.page.resize(1200, 1000)
        self.page.go(self.url)
        self.page.wait("document.querySelectorAll('.curve').length >= 13")

    def tearDown(self):
        self.page.close()
        self.orb.send_signal(signal.SIGINT)
        _, said = self.orb.communicate(timeout=20)
        self.assertIn("the robot has been stopped", said)
        self.assertEqual(self.orb.returncode, 130)

    def mouse(self, kind, x, y):
        self.page.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def stick(self):
        box = self.page.evaluate("(({x, y, width}) => [x, y, width])(document.getElementById('stick').getBoundingClientRect())")
        return box[0] + box[2] / 2, box[1] + box[2] / 2, box[2] / 220

    def test_the_stick_drives_and_letting_go_stops(self):
        if picture:
            self.page.resize(1200, 1200)
            for row, lamps in enumerate(("..####..", ".#....#.", "#.#..#.#", "#......#", "#.#..#.#", "#..##..#", ".#....#.", "..####..")):
                for column, lamp in enumerate(lamps):
                    if lamp == "#":
                        self.page.evaluate(f"fetch('pixel', {{ method: 'POST', body: '{column} {7 - row} 255 200 0' }}).then(() => 0)")
            self.page.wait("document.querySelectorAll('#lamps [data-color=\"#ffc800\"]').length === 26")
        x, y, unit = self.stick()
        self.mouse("mousePressed", x, y)
        self.mouse("mouseMoved", x + 95 * unit, y)
        self.page.wait(f"{told} === '90 76'")
        self.page.wait(f"{speed} > 20")
        self.mouse("mouseMoved", x, y + 95 * unit)
        self.page.wait(f"{told} === '180 76'")
        if picture:
            self.page.wait(f"{speed} > 38")
            self.page.picture(picture)
        self.mouse("mouseReleased", x, y + 95 * unit)
        self.page.wait(f"{told} === '180 0' && {speed} === 0")
        self.assertEqual(self.page.complaints, [])

    def test_a_page_that_is_closed_drives_no_more(self):
        x, y, unit = self.stick()
        self.mouse("mousePressed", x, y)
        self.mouse("mouseMoved", x, y - 95 * unit)
        self.page.wait(f"{speed} > 20")
        self.page.close()
        self.page = self.browser.page()
        self.page.go(self.url)
        self.page.wait(f"{told} === '0 0' && {speed} === 0")

    def test_keys_stop_and_lamps(self):
        self.page.evaluate("document.getElementById('stick').focus()")
        self.page.call("Input.dispatchKeyEvent", type="keyDown", key="ArrowUp")
        self.page.wait(f"{speed} > 10")
        self.page.evaluate("document.getElementById('stop').click()")
        self.page.wait(f"{told} === '0 0'")
        for name, value in (("color", "#00ff00"), ("lamp", "on")):
            self.page.evaluate(f"(e => {{ e.value = '{value}'; e.dispatchEvent(new Event('input')); e.click(); }})"
                               f"(document.getElementById('{name}'))")
        self.assertEqual(self.page.complaints, [])

    def lamp(self, x, y):
        return self.page.evaluate(f"document.querySelector('#lamps [data-x=\"{x}\"][data-y=\"{y}\"]').dataset.color")

    def place(self, x, y):
        return self.page.evaluate(f"(({{x, y, width, height}}) => [x + width / 2, y + height / 2])"
                                  f"(document.querySelector('#lamps [data-x=\"{x}\"][data-y=\"{y}\"]').getBoundingClientRect())")

    def settle(self, wanted):
        """Until the page shows what the robot has been told, and no longer what was painted here."""
        self.page.evaluate("new Promise(done => setTimeout(done, 700))")
        self.page.wait(wanted)

    lit = "[...document.querySelectorAll('#lamps button')].filter(lamp => lamp.dataset.color !== '#000000').map(lamp => lamp.dataset.x + lamp.dataset.y + lamp.dataset.color).join(' ')"

    def test_a_drag_paints_on_the_matrix(self):
        self.page.wait("!document.getElementById('matrix').hidden")
        self.page.resize(1200, 1400)
        self.page.evaluate("document.getElementById('pen').value = '#ff8000'")
        self.mouse("mousePressed", *self.place(1, 0))
        self.mouse("mouseMoved", *self.place(2, 0))
        self.mouse("mouseMoved", *self.place(2, 1))
        self.mouse("mouseReleased", *self.place(2, 1))
        self.mouse("mouseMoved", *self.place(5, 5))
        self.settle(f"{self.lit} === '21#ff8000 10#ff8000 20#ff8000'")
        # The keys go on from there.
        self.page.evaluate("document.querySelector('#lamps [tabindex=\"0\"]').focus()")
        self.page.key("ArrowUp")
        self.page.key("ArrowRight")
        self.assertEqual(self.page.evaluate("document.activeElement.getAttribute('aria-label')"), "2, 1: #ff8000")
        self.page.evaluate("document.activeElement.click()")
        self.settle("true")
        self.assertEqual(self.lamp(2, 1), "#ff8000")
        # The light fills it, and what is painted then lies on top.
        self.page.evaluate("(e => { e.value = '#0000ff'; e.dispatchEvent(new Event('input')); })(document.getElementById('color'))")
        self.settle("[...document.querySelectorAll('#lamps button')].every(lamp => lamp.dataset.color === '#0000ff')")
        self.page.evaluate("document.getElementById('clear').click()")
        self.settle(f"{self.lit} === ''")
        self.page.evaluate("document.getElementById('text').value = 'orb'")
        self.page.evaluate("document.getElementById('say').requestSubmit()")
        self.page.wait(f"{self.lit} !== ''")
        self.page.wait(f"{self.lit} === ''")
        self.assertEqual(self.page.complaints, [])

    def test_what_is_no_lamp_is_left_alone(self):
        for path, data in (("pixel", b"8 0 255 0 0"), ("pixel", b"0 -1 255 0 0"), ("pixel", b"0 0 256 0 0"), ("pixel", b"1 1"),
                           ("text", b""), ("text", b"1 2"), ("text", b"1 2 x hello"), ("text", b"300 0 0 hello")):
            urllib.request.urlopen(urllib.request.Request(self.url + path, data), timeout=5).close()
        self.settle(f"{self.lit} === ''")
        urllib.request.urlopen(urllib.request.Request(self.url + "pixel", b"7 7 0 255 0"), timeout=5).close()
        self.settle(f"{self.lit} === '77#00ff00'")

    def test_nobody_else_finds_the_page(self):
        base = self.url[:self.url.index("/", len("http://")) + 1]
        for path, data in (("", None), ("events", None), ("0123456789abcdef0123456789abcdef/drive", b"0 255")):
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(urllib.request.Request(base + path, data), timeout=5)
            self.assertEqual(refused.exception.code, 404)
            refused.exception.close()
        for data in (b"0 256", b"x", b"0 60 5", b"9" * 1024):
            urllib.request.urlopen(urllib.request.Request(self.url + "drive", data), timeout=5).close()
        with self.assertRaises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(urllib.request.Request(self.url + "drive", b"9" * 2000), timeout=5)
        self.assertEqual(refused.exception.code, 400)
        refused.exception.close()
        self.page.wait(f"{told} === '0 0'")

    def test_it_fits_a_phone(self):
        self.page.resize(390, 844, True)
        self.assertLessEqual(self.page.evaluate("document.documentElement.scrollWidth"), 390)


if __name__ == "__main__":
    if chromium.find() is None:
        print("skipped: no chromium here; `./dev report` installs it")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=1)
