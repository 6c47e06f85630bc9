#!/usr/bin/env python3
"""The blocks of the playground in a headless Chromium. usage: blocks_test.py ORB FOLDER [TEST...]

FOLDER is what `./dev playground` built. Exits 77 (skipped, to ctest) where no Chromium is installed or
nothing is built."""

import os
import sys
import unittest

from page_test import by_id, chromium, click, folder, fragment, note_violations, ready, site_server, stop, text, wait, weight

program = "' a side\ngoroll 0, 80, 1 ' off\ndelay 1s\n\nif dshake then\n  RGB red\nend if\ngoroll 0, 0, 0\n"
words = "[...document.querySelectorAll('#blocks .blocklySvg .blocklyBlockCanvas .blocklyText')].map(one => one.textContent.replaceAll('\\u00a0', ' '))"
field = lambda word: f"[...document.querySelectorAll('#blocks .blocklySvg .blocklyBlockCanvas .blocklyText')].find(one => one.textContent.replaceAll('\\u00a0', ' ').trim() === '{word}')"
middle = lambda found: f"(() => {{ const {{ x, y, width, height }} = ({found}).getBoundingClientRect(); return [x + width / 2, y + height / 2]; }})()"
left = lambda found: f"(() => {{ const {{ x, y, height }} = ({found}).getBoundingClientRect(); return [x + 4, y + height / 2]; }})()"


class Blocks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = site_server.Site(folder)
        cls.browser = chromium.Browser(chromium.find())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.server.close()

    def open(self, files, width=1366, height=860, mobile=False, blocks=True, **more):
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.resize(width, height, mobile)
        page.call("Page.addScriptToEvaluateOnNewDocument", source=note_violations)
        page.go(self.server.url + fragment(files, **more))
        page.wait(ready)
        self.addCleanup(lambda: self.assertEqual([one for one in page.complaints if "404" not in one], []))
        self.addCleanup(lambda: self.assertIsNone(page.evaluate("window.violations")))
        own = self.server.url
        self.addCleanup(lambda: self.assertEqual([url for url in page.requests if not url.startswith((own, "data:", f"blob:{own}"))], []))
        if blocks:
            page.evaluate(click("as-blocks"))
            page.wait(f"({words}).length > 0", 60)
            page.evaluate(wait(300))
        return page

    def mouse(self, page, kind, x, y):
        page.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=0 if kind == "mouseReleased" else 1, clickCount=1)

    def press(self, page, place):
        x, y = page.evaluate(place)
        self.mouse(page, "mousePressed", x, y)
        self.mouse(page, "mouseReleased", x, y)

    def drag(self, page, begin, end):
        (x, y), (to_x, to_y) = page.evaluate(begin), page.evaluate(end)
        self.mouse(page, "mousePressed", x, y)
        for step in range(1, 11):
            self.mouse(page, "mouseMoved", x + (to_x - x) * step / 10, y + (to_y - y) * step / 10)
            page.evaluate(wait(20))
        self.mouse(page, "mouseReleased", to_x, to_y)

    def key(self, page, key, code=0, modifiers=0):
        for kind in ("rawKeyDown", "keyUp"):
            page.call("Input.dispatchKeyEvent", type=kind, key=key, code=key if len(key) > 1 else f"Key{key.upper()}", windowsVirtualKeyCode=code, modifiers=modifiers)

    def enter(self, page, word, instead):
        """Types over what a field has."""
        self.press(page, middle(field(word)))
        page.wait("document.querySelector('.blocklyHtmlInput') !== null")
        page.evaluate("document.querySelector('.blocklyHtmlInput').select()")
        page.call("Input.insertText", text=instead)
        self.key(page, "Enter", 13)
        page.wait("document.querySelector('.blocklyHtmlInput') === null")

    # -- a view of the text --
    def test_the_program_is_shown_and_what_is_changed_is_written_at_once(self):
        page = self.open({"a.orb": program})
        shown = page.evaluate(words)
        for word in ("drive", "heading", "at speed", "80", "1s", "dshake", "red", "' off", "a side"):
            self.assertIn(word, [one.strip() for one in shown])
        self.enter(page, "80", "120")
        page.wait(f"({text}) === {program.replace('80', '120')!r}")

    def test_what_is_taken_back_is_taken_back_in_the_text(self):
        page = self.open({"a.orb": program})
        self.enter(page, "80", "120")
        page.wait(f"({text}).includes('120')")
        self.key(page, "z", 90, modifiers=2)
        page.wait(f"({text}) === {program!r}")
        page.wait(f"({words}).includes('80')")
        self.key(page, "y", 89, modifiers=2)
        page.wait(f"({text}).includes('120')")
        page.wait(f"({words}).includes('120')")

    def test_a_number_is_kept_in_the_range_of_the_tables(self):
        page = self.open({"a.orb": program})
        self.enter(page, "80", "300")
        page.wait(f"({text}).includes('goroll 0, 255, 1')")

    def test_a_number_outside_of_its_range_is_shown_as_it_is(self):
        page = self.open({"a.orb": "goroll 0, 300, 1\n"})
        self.assertIn("300", page.evaluate(words))
        page.evaluate(wait(300))
        self.assertEqual(page.evaluate(text), "goroll 0, 300, 1\n")

    def test_a_block_is_taken_from_its_drawer(self):
        page = self.open({"a.orb": "delay 1s\n"})
        self.press(page, middle("[...document.querySelectorAll('.blocklyToolboxCategory')].find(one => one.textContent.includes('Light'))"))
        page.wait("document.querySelector('.blocklyFlyout .blocklyText') !== null")
        page.evaluate(wait(300))
        begin = left("[...document.querySelectorAll('.blocklyFlyout .blocklyText')].find(one => one.textContent.replaceAll('\\u00a0', ' ') === 'light up in')")
        end = f"(() => {{ const {{ x, bottom }} = ({field('wait')}).closest('.blocklyDraggable').querySelector('.blocklyPath').getBoundingClientRect(); return [x + 12, bottom + 12]; }})()"
        self.drag(page, begin, end)
        page.wait(f"({text}) === 'delay 1s\\nRGB red\\n'")

    def test_what_hangs_nowhere_is_not_in_the_text(self):
        page = self.open({"a.orb": "delay 1s\nRGB red\n"})
        end = f"(() => {{ const [x, y] = {middle(field('light up in'))}; return [x + 150, y + 120]; }})()"
        self.drag(page, left(field("light up in")), end)
        page.wait(f"({text}) === 'delay 1s\\n'")
        page.wait("document.querySelector('.blocklyDisabled') !== null")

    def test_what_is_typed_into_the_text_is_in_the_blocks(self):
        page = self.open({"a.orb": program})
        page.evaluate(click("as-text"))
        page.evaluate("document.querySelector('.cm-content').focus()")
        page.key("a", modifiers=2)
        page.call("Input.insertText", text="repeat 3\n  LEDC 4\nend repeat\n")
        page.evaluate(click("as-blocks"))
        page.wait(f"({words}).map(one => one.trim()).includes('light up in colour')")
        self.assertNotIn("drive", page.evaluate(words))

    def test_lines_that_are_none_stay_byte_for_byte(self):
        broken = "delay 1s\n  goroll  0  80\n' note\nLEDC 3\n"
        page = self.open({"a.orb": broken})
        self.enter(page, "3", "5")
        page.wait(f"({text}) === {broken.replace('3', '5')!r}")

    # -- marks --
    def test_a_finding_marks_its_block(self):
        page = self.open({"a.orb": "LEDC 300\n"})
        marked = f"({field('light up in colour')}).closest('.blocklyDraggable').querySelector(':scope > .blocklyIconGroup') !== null"
        page.wait(marked)
        self.enter(page, "300", "3")
        page.wait(f"!({marked})")

    def test_the_block_that_runs_glows(self):
        page = self.open({"a.orb": "loop\n  RGB red\n  delay 500ms\n  RGB blue\n  delay 500ms\nend loop\n"})
        page.evaluate(click("run"))
        page.wait("document.querySelector('.orb-runs') !== null", 20)
        seen = "document.querySelector('.orb-runs')?.dataset.id"
        first = page.evaluate(seen)
        page.wait(f"document.querySelector('.orb-runs') && ({seen}) !== {first!r}", 20)
        page.evaluate(stop)

    # -- where there are none --
    def test_numbered_programs_say_why_and_can_be_lifted(self):
        page = self.open({"a.bas": '10 print "a"\n20 delay 100\n30 goto 10\n'}, blocks=False)
        page.evaluate(click("as-blocks"))
        page.wait(f"{by_id('lift')} !== null")
        self.assertIn("line numbers", page.evaluate(f"{by_id('blocks')}.textContent"))
        page.evaluate(click("lift"))
        page.wait(f"({words}).map(one => one.trim()).includes('print')", 60)
        self.assertIn("loop", page.evaluate(text))
        self.assertEqual(page.evaluate("[...document.querySelectorAll('#tabs button')].map(one => one.textContent)"), ["a.bas", "a.orb"])

    def test_tests_and_macros_have_no_switch(self):
        page = self.open({"a.macro": "rgb 0, 255, 0\n"}, blocks=False)
        self.assertTrue(page.evaluate("document.querySelector('.forms').hidden"))

    # -- everybody --
    def test_it_is_remembered(self):
        page = self.open({"a.orb": program})
        page.evaluate(wait(600))
        page.go("about:blank")
        page.go(self.server.url)
        page.wait(ready)
        page.wait(f"({words}).length > 0", 60)
        page.evaluate(click("as-text"))
        self.assertTrue(page.evaluate(f"{by_id('blocks')}.hidden && !{by_id('editor')}.hidden"))

    def test_a_keyboard_is_enough(self):
        page = self.open({"a.orb": "delay 1s\nLEDC 3\n"})
        page.evaluate("document.querySelector('#blocks .blocklySvg [tabindex=\"0\"], #blocks .blocklySvg[tabindex=\"0\"]').focus()")
        for _ in range(12):
            if "light up in colour" in page.evaluate("(document.activeElement.getAttribute('aria-label') ?? '').toLowerCase()") or page.evaluate("document.querySelector('.blocklySelected .blocklyText')?.textContent.replaceAll('\\u00a0', ' ') === 'light up in colour'"):
                break
            self.key(page, "ArrowDown", 40)
            page.evaluate(wait(60))
        self.key(page, "Delete", 46)
        page.wait(f"({text}) === 'delay 1s\\n'")

    def test_on_a_phone(self):
        page = self.open({"a.orb": program}, width=390, height=844, mobile=True)
        self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 390)
        box = page.evaluate(f"(() => {{ const {{ x, y, width, height }} = ({field('heading')}).getBoundingClientRect(); return [x, y, width, height]; }})()")
        self.assertGreater(box[0], 0)
        self.assertGreater(page.evaluate("document.querySelector('.blocklyToolboxCategory').getBoundingClientRect().height"), 30)
        self.press(page, middle("document.querySelector('.blocklyToolboxCategory')"))
        page.wait("[...document.querySelectorAll('.blocklyFlyout')].some(one => getComputedStyle(one).display !== 'none')")
        self.assertTrue(page.evaluate(f"(({{ x, y, width, height }}) => {by_id('run')}.contains(document.elementFromPoint(x + width / 2, y + height / 2)))({by_id('run')}.getBoundingClientRect())"))

    def test_they_weigh_little_and_only_for_who_wants_them(self):
        own = [name for name in os.listdir(folder) if name.startswith("view-") or name == "blocks.css"] + [f"blocks/{name}" for name in os.listdir(os.path.join(folder, "blocks"))]
        self.assertEqual(len([name for name in own if name.startswith("view-")]), 1)
        self.assertLessEqual(sum(weight.brotli(os.path.join(folder, name)) for name in own), 200_000)
        self.assertFalse([name for name in weight.listed(folder) if name in own])
        page = self.open({"a.orb": program}, blocks=False)
        page.evaluate(wait(500))
        self.assertFalse([url for url in page.requests if "/view-" in url or "/blocks" in url])


if __name__ == "__main__":
    if not chromium.find() or not os.path.exists(os.path.join(folder, "orb.wasm")):
        print("no Chromium, or no playground is built")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
