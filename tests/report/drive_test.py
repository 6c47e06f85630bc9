#!/usr/bin/env python3
"""The page of `orb drive --page` in a headless Chromium: the joystick drives a virtual robot, letting go and closing
the page stop it, and every sensor has a curve. usage: drive_test.py ORB [PICTURE.png]

Exits 77 (skipped, to ctest) where no Chromium is installed."""

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
