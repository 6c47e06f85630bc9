#!/usr/bin/env python3
"""Types in the playground, key by key, in a headless Chromium. usage: typing_test.py ORB FOLDER [TEST...]

FOLDER is what `./dev playground` built. Every key goes down and up, because `Input.insertText` would not show what Enter does to
an open list. ORB_PACES=60,150,400 types the lessons at each of these paces (milliseconds a key); the default is 60."""

import os
import sys
import time
import unittest

from page_test import chromium, click, by_id, coloured, folder, fragment, lessons, ready, site_server, text, wait

paces = [int(one) for one in os.environ.get("ORB_PACES", "60").split(",")]
offers = "[...document.querySelectorAll('.cm-tooltip-autocomplete li .cm-completionLabel')].map(one => one.textContent)"
codes = {"Enter": 13, "ArrowDown": 40, "Escape": 27, " ": 32, "Backspace": 8}


class Typing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = site_server.Site(folder)
        cls.browser = chromium.Browser(chromium.find())
        cls.lessons = lessons()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.server.close()

    def open(self, name="a.orb", before=""):
        """Opens an empty file, or one with a text before the cursor."""
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.resize(1280, 860)
        page.go(self.server.url + fragment({name: before}))
        page.wait(ready)
        page.evaluate("document.querySelector('.cm-content').focus()")
        self.key(page, "End", 35, modifiers=2)
        self.addCleanup(lambda: self.assertEqual(page.complaints, []))
        return page

    def key(self, page, key, code, modifiers=0):
        words = {"text": "\r"} if key == "Enter" else {"text": key} if len(key) == 1 else {}
        for kind in ("keyDown" if words else "rawKeyDown", "keyUp"):
            page.call("Input.dispatchKeyEvent", type=kind, key=key, code=key if len(key) > 1 else "", windowsVirtualKeyCode=code, modifiers=modifiers, **words)
            words = {}

    def type(self, page, words, pace=60):
        begun = time.monotonic()
        for i, letter in enumerate(words):
            while time.monotonic() < begun + i * pace / 1000:
                self.browser.listen(0.002)
            name = "Enter" if letter == "\n" else letter
            # The code of a sign is that of another key: for `'` an arrow.
            self.key(page, name, codes.get(name, ord(letter.upper()) if letter.isalnum() else 0))

    def typed(self, words, name="a.orb", pace=60, before=""):
        page = self.open(name, before)
        self.type(page, words, pace)
        page.evaluate(wait(300))
        return page.evaluate(text)

    def test_enter_accepts_nothing_that_nobody_chose(self):
        words = "RGB red\nprint n\ndelay \ngoroll 0, 80, 1\nprint speed\nrepeat 4\nprint no\nend repeat\nX"
        wanted = words.replace("print no", "  print no")
        for pace in (60, 150, 400):
            self.assertEqual(self.typed(words, pace=pace), wanted, pace)

    def test_enter_takes_what_an_arrow_has_chosen(self):
        page = self.open()
        self.type(page, "gor")
        page.wait(f"({offers}).includes('goroll')")
        page.evaluate(wait(200))
        self.key(page, "ArrowDown", 40)
        self.key(page, "Enter", 13)
        self.assertEqual(page.evaluate(text), "goroll")

    def test_only_what_begins_so_is_offered(self):
        page = self.open()
        self.type(page, "RGB r")
        page.wait(f"({offers}).includes('red')")
        self.assertEqual([one for one in page.evaluate(offers) if not one.lower().startswith("r")], [])
        for words in ("ed", "\ndelay "):  # a whole word, and a blank
            self.type(page, words)
            page.evaluate(wait(400))
            self.assertEqual(page.evaluate(offers), [], words)
        page.call("Input.dispatchKeyEvent", type="rawKeyDown", key=" ", code="Space", windowsVirtualKeyCode=32, modifiers=2)
        page.wait(f"({offers}).includes('speed')")  # when suggestions are requested

    def test_a_comment_begins_with_one_sign(self):
        self.assertEqual(self.typed("' it's a ball\nprint \"it's\" ' here's one\n"), "' it's a ball\nprint \"it's\" ' here's one\n")
        self.assertEqual(self.typed("# it's a test\n", name="a.test"), "# it's a test\n")

    def test_lines_of_a_block_are_moved_in(self):
        typed = "repeat 4\ngoroll 0, 80, 1\nif speed > 5 then\nRGB red\nelse\nRGB blue\nend if\nend repeat\nprint 1"
        self.assertEqual(self.typed(typed), "repeat 4\n  goroll 0, 80, 1\n  if speed > 5 then\n    RGB red\n  else\n    RGB blue\n  end if\nend repeat\nprint 1")
        typed = "select n\ncase 1\nRGB red\ncase 2, 3\nRGB blue\nelse\nprint 1\nend select\nif n = 1 then print 2\nprint 3"
        self.assertEqual(self.typed(typed), "select n\n  case 1\n    RGB red\n  case 2, 3\n    RGB blue\n  else\n    print 1\nend select\nif n = 1 then print 2\nprint 3")
        self.assertEqual(self.typed("sub a\nREPEAT 4\nprint 1\n\nprint 2\nend repeat\nend sub"), "sub a\n  REPEAT 4\n    print 1\n\n    print 2\n  end repeat\nend sub")
        self.assertEqual(self.typed("repeat 2\nnextval = 3"), "repeat 2\n  nextval = 3")
        typed = 'test "a"\nexpect print "b"\ntest "c"\nexpect end within 2s'
        self.assertEqual(self.typed(typed, name="a.test"), 'test "a"\n  expect print "b"\ntest "c"\n  expect end within 2s')
        self.assertEqual(self.typed("10 for I = 1 to 3\n20 next I\n", name="a.bas"), "10 for I = 1 to 3\n20 next I\n")

    def test_lessons_end_as_they_are_typed(self):
        for pace in paces:
            for lesson in self.lessons:
                wanted = lesson["solution"].rstrip("\n")
                words = "\n".join(line.strip() for line in wanted.split("\n"))
                self.assertEqual(self.typed(words, pace=pace), wanted, (lesson["id"], pace))


if __name__ == "__main__":
    if not chromium.find() or not os.path.exists(os.path.join(folder, "orb.wasm")):
        print("skipped: no Chromium, or nothing built: ./dev playground")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
