#!/usr/bin/env python3
"""How the playground looks and answers, in a headless Chromium. usage: design_test.py ORB FOLDER [TEST...]

FOLDER is what `./dev playground` built."""

import json
import os
import sys
import unittest

from page_test import chromium, by_id, click, coloured, folder, fragment, idle, outcome, played, ready, site_server, text, wait

here = os.path.dirname(os.path.abspath(__file__))
square = "for side = 0 to 3\n  goroll side * 90, 100, 1\n  delay 700ms\n  goroll side * 90, 0, 0\n  delay 500ms\nnext side\n"
# Layout shifts, including those right after a click: what is being looked at must not move.
note_shifts = """new PerformanceObserver(list => { for (const one of list.getEntries()) (window.shifts ??= []).push([one.value,
  one.sources.map(({ node }) => node?.id || node?.className || node?.nodeName)]); }).observe({ type: 'layout-shift', buffered: true });"""
shifts = "(window.shifts ?? [])"
stage = "(({ top, bottom }) => [Math.round(top), Math.round(bottom)])(document.querySelector('.stage').getBoundingClientRect())"
most_shift = 0.02


class Design(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = site_server.Site(folder)
        cls.browser = chromium.Browser(chromium.find())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.server.close()

    def open(self, where="", width=1366, height=768, mobile=False, language="en", motion=True, before=""):
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.resize(width, height, mobile)
        if not motion:
            page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
        page.call("Page.addScriptToEvaluateOnNewDocument", source=f"try {{ localStorage.setItem('orb-language', '{language}'); }} catch {{}}" + note_shifts + before)
        page.go(self.server.url + where)
        page.wait(ready)
        page.wait(coloured)
        self.addCleanup(lambda: self.assertEqual(page.complaints, []))
        return page

    def press(self, page, name):
        box = page.evaluate(f"(({{ x, y, width, height }}) => [x + width / 2, y + height / 2])({by_id(name)}.getBoundingClientRect())")
        for kind in ("mousePressed", "mouseReleased"):
            page.call("Input.dispatchMouseEvent", type=kind, x=box[0], y=box[1], button="left", clickCount=1)

    def lessons(self):
        with open(os.path.join(folder, "examples.json"), encoding="utf-8") as file:
            return [item["id"] for item in json.load(file)["groups"][0]["items"]]

    # -- a task --
    def test_the_job_is_always_in_sight(self):
        for language, size in (("en", (1366, 768)), ("fr", (1366, 768)), ("en", (390, 844)), ("en", (844, 390))):
            page = self.open("#lesson=" + self.lessons()[0], *size, mobile=size[0] < 500, language=language)
            for _ in self.lessons():
                page.wait(f"!{by_id('task')}.hidden && !{by_id('task-job')}.hidden")
                title = page.evaluate(f"{by_id('task-title')}.textContent")
                for _ in ("as it opens", "read to its end"):
                    first, end, height = page.evaluate(f"(({{ top, bottom }}) => [top, bottom, innerHeight])({by_id('task-job')}.getBoundingClientRect())")
                    self.assertGreater(end - first, 20, title)
                    self.assertGreater(first, 0, title)
                    self.assertLess(end, height, title)
                    self.assertEqual(page.evaluate(f"{by_id('task-job')}.scrollHeight - {by_id('task-job')}.clientHeight"), 0, (title, size))
                    page.evaluate(f"{by_id('task-text')}.scrollTop = 1e5")
                self.assertNotIn("Your job", page.evaluate(f"{by_id('task-text')}.textContent"))
                page.evaluate(f"document.querySelector('#lesson-next:enabled')?.click()")
                page.wait(f"{by_id('task-title')}.textContent !== {json.dumps(title)} || {by_id('lesson-next')}.disabled")
            page.evaluate(click("task-fold"))
            self.assertGreater(page.evaluate(f"{by_id('task-job')}.getBoundingClientRect().height"), 20)

    def test_a_task_without_a_job_is_a_text(self):
        page = self.open(fragment({"a.orb": "RGB red\n"}, task="# Mine\n\nDo **this** well."))
        page.wait(f"!{by_id('task')}.hidden")
        self.assertTrue(page.evaluate(f"{by_id('task-job')}.hidden"))
        self.assertIn("Do this well", page.evaluate(f"{by_id('task-text')}.textContent"))

    # -- verdicts --
    def verdict(self, page):
        page.evaluate(click("test"))
        page.wait(f"!{by_id('verdicts')}.hidden && {idle}", 60)

    def test_verdicts_speak_as_a_teacher_does(self):
        page = self.open("#lesson=lessons/01-traffic-light")
        self.verdict(page)
        said = page.evaluate("[...document.querySelectorAll('#verdict-list .miss')].map(one => one.textContent)")
        self.assertEqual(said[0], "Wanted yellow at 2.5 s, saw red.")
        self.assertIn("Wanted yellow from 2.1 to 2.9 s, saw red at 2.1 s.", said)
        self.assertNotIn("expect", page.evaluate(f"{by_id('verdict-list')}.textContent"))
        page = self.open("#lesson=lessons/01-traffic-light", language="de")
        self.verdict(page)
        page.wait("document.querySelector('#verdict-list .miss')?.textContent === 'Gewünscht: gelb bei 2.5 s, zu sehen: rot.'", 5)

    def test_every_lesson_says_what_it_wanted(self):
        for language, begins in (("en", ("Wanted", "Not wanted")), ("de", ("Gewünscht", "Nicht gewünscht"))):
            page = self.open("#lesson=" + self.lessons()[0], language=language)
            for _ in self.lessons():
                title = page.evaluate(f"{by_id('task-title')}.textContent")
                self.verdict(page)
                page.evaluate(wait(100))
                said = page.evaluate("[...document.querySelectorAll('#verdict-list .miss')].map(one => one.textContent)")
                misses = page.evaluate("document.querySelectorAll('#verdict-list li p').length")
                self.assertEqual(len(said), misses, title)
                for one in said:
                    self.assertTrue(one.startswith(begins), one)
                page.evaluate(click("verdicts-close"))
                page.evaluate("document.querySelector('#lesson-next:enabled')?.click()")
                page.wait(f"{by_id('task-title')}.textContent !== {json.dumps(title)} || {by_id('lesson-next')}.disabled")

    def test_the_ball_answers_a_verdict(self):
        page = self.open("#lesson=lessons/03-square")
        self.verdict(page)
        mood = f"{by_id('played')}.dataset.mood"
        page.wait(f"{played} && {mood} === 'sad'", 5)
        self.assertEqual(page.evaluate("getComputedStyle(document.querySelector('#ball .frown')).display"), "inline")
        self.assertEqual(page.evaluate("document.querySelectorAll('#map .ghosts .ghost-room').length"), 2)
        within = "(({ left, right, top, bottom }, map) => left >= map.left && right <= map.right && top >= map.top && bottom <= map.bottom)"
        for i in (0, 1):
            self.assertTrue(page.evaluate(f"{within}(document.querySelectorAll('#map .ghost-body')[{i}].getBoundingClientRect(), {by_id('map')}.getBoundingClientRect())"))
        self.assertIn("Wanted", page.evaluate("document.querySelector('.bubble').textContent"))
        self.assertEqual(page.evaluate(f"{by_id('clock')}.textContent"), "1.980")  # the moment at which it was nearest
        page.evaluate(click("solution"))
        self.verdict(page)
        page.wait(f"{mood} === 'glad'", 5)
        self.assertEqual(page.evaluate("getComputedStyle(document.querySelector('#ball')).animationName"), "hop")
        page.wait(f"{mood} === ''", 10)
        page.evaluate(click("run"))
        page.wait("document.querySelector('.ghosts') === null")

    def test_a_colour_that_was_wanted_is_a_ghost_beside_the_ball(self):
        page = self.open("#lesson=lessons/01-traffic-light")
        self.verdict(page)
        page.wait("document.querySelector('#ball .ghost-body')?.getAttribute('fill') === 'yellow'", 5)

    def test_who_wants_no_motion_has_none(self):
        page = self.open("#lesson=lessons/01-traffic-light", motion=False)
        page.evaluate(click("solution"))
        self.verdict(page)
        page.wait(f"{by_id('played')}.dataset.mood === 'glad'", 5)
        self.assertEqual(page.evaluate("getComputedStyle(document.querySelector('#ball')).animationName"), "none")
        page = self.open(motion=False)
        page.evaluate(click("run"))
        page.wait("document.querySelector('.cm-pointed') !== null", 10)
        self.assertEqual(page.evaluate("getComputedStyle(document.querySelector('.cm-pointed')).animationName"), "none")
        self.assertNotEqual(page.evaluate("getComputedStyle(document.querySelector('.cm-pointed')).boxShadow"), "none")

    # -- the stage --
    def test_the_stage_stays_where_it_is(self):
        printing = square + 'print "home"\n'
        for where in ("", fragment({"a.orb": square}), fragment({"a.orb": printing}), "#example=hall.orb"):
            page = self.open(where)
            page.evaluate(wait(500))
            places = [page.evaluate(stage)]
            loaded = page.evaluate(f"{shifts}.length")
            self.press(page, "run")
            page.wait(played)
            page.evaluate(wait(1200))
            places.append(page.evaluate(stage))
            page.wait(idle, 30)
            page.evaluate(wait(600))
            places.append(page.evaluate(stage))
            moved = page.evaluate(f"{shifts}.slice({loaded}).reduce((sum, [value]) => sum + value, 0)")
            print(f"layout shift of a run: {moved:.4f}, stage {places}")
            self.assertEqual(places, [places[0]] * 3, where[:20])
            self.assertLessEqual(moved, most_shift, page.evaluate(f"JSON.stringify({shifts}.slice({loaded}))"))

    def test_nothing_moves_while_the_page_comes(self):
        for where, size in (("", (1366, 768)), ("", (390, 844)), ("#lesson=lessons/03-square", (1366, 768))):
            page = self.open(where, *size, mobile=size[0] < 500)
            page.evaluate(wait(1500))
            moved = page.evaluate(f"{shifts}.reduce((sum, [value]) => sum + value, 0)")
            print(f"layout shift of a visit at {size}: {moved:.4f}")
            self.assertLessEqual(moved, most_shift, page.evaluate(f"JSON.stringify({shifts})"))

    def test_another_zoom_comes_little_by_little(self):
        eased = f"{by_id('map')}.getAnimations().length"
        page = self.open(fragment({"a.orb": "goroll 0, 200, 1\ndelay 3s\n"}))
        page.evaluate(f"(() => {{ const animate = Element.prototype.animate; Element.prototype.animate = function (...given) {{ if (this.id === 'map') window.eased = (window.eased ?? 0) + 1; return animate.apply(this, given); }}; }})()")
        page.evaluate(click("run"))
        page.wait(f"{played} && {idle}", 30)
        self.assertGreaterEqual(page.evaluate("window.eased"), 2)
        page.evaluate(click("zoom-in"))
        self.assertEqual(page.evaluate(eased), 1)
        page.evaluate(wait(600))
        self.assertEqual(page.evaluate(eased), 0)
        page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
        page.evaluate(click("zoom-out"))
        self.assertEqual(page.evaluate(eased), 0)

    def test_a_course_fills_the_map(self):
        page = self.open("#example=hall.orb")
        page.evaluate(click("instant"))
        page.wait(f"{played} && {idle}", 30)
        share = page.evaluate(f"""(() => {{
          const map = {by_id('map')}.getBoundingClientRect(), boxes = [...document.querySelectorAll('#map .wall')].map(one => one.getBoundingClientRect());
          const head = document.querySelector('.stage-head').getBoundingClientRect();
          const high = Math.max(...boxes.map(one => one.bottom)) - Math.min(...boxes.map(one => one.top));
          return high / (map.bottom - head.bottom); }})()""")
        print(f"the course takes {share:.0%} of the height that is free")
        self.assertGreater(share, .75)  # its drawing has margins

    def test_the_last_words_say_where_it_ended(self):
        page = self.open(fragment({"a.orb": square}))
        page.evaluate(click("instant"))
        page.wait(f"{played} && {idle}", 30)
        self.assertRegex(page.evaluate(f"{by_id('outcome')}.firstElementChild.textContent"), r"^Home again after \d\.\d m$")
        self.assertIn("robot time", page.evaluate(outcome))
        page = self.open(fragment({"a.orb": square}), language="de")
        page.evaluate(click("instant"))
        page.wait(f"{played} && {idle}", 30)
        page.wait(f"/^Wieder zu Hause nach \\d.\\d m$/.test({by_id('outcome')}.firstElementChild.textContent)", 5)
        page = self.open(fragment({"a.orb": "goroll 0, 100, 1\ndelay 1s\n"}))
        page.evaluate(click("instant"))
        page.wait(f"{played} && {idle}", 30)
        self.assertNotIn("Home", page.evaluate(outcome))

    def test_long_words_lie_over_the_stage(self):
        page = self.open(fragment({"a.orb": "for n = 3 to 0 step -1\n  print 12 / n\nnext n\n"}))
        before = page.evaluate(stage)
        page.evaluate(click("instant"))
        page.wait(f"{by_id('outcome')}.classList.contains('bad')", 30)
        self.assertEqual(page.evaluate(stage), before)
        self.assertGreater(page.evaluate(f"{by_id('outcome')}.getBoundingClientRect().height"), 50)
        on_top = f"(({{ x, y, width, height }}) => {by_id('outcome')}.contains(document.elementFromPoint(x + width / 2, y + height - 6)))({by_id('outcome')}.getBoundingClientRect())"
        self.assertTrue(page.evaluate(on_top))

    # -- the editor --
    def hover(self, page, word):
        find = f"[...document.querySelectorAll('.cm-line span')].find(one => one.textContent === '{word}')"
        box = page.evaluate(f"(({{ x, y, width, height }}) => [x + width / 2, y + height / 2])({find}.getBoundingClientRect())")
        page.call("Input.dispatchMouseEvent", type="mouseMoved", x=box[0], y=box[1])
        page.wait("document.querySelector('.cm-lsp-hover-tooltip') !== null")

    def test_hover_is_a_sentence_and_an_example(self):
        page = self.open(fragment({"a.orb": "goroll 0, 80, 1\n"}))
        self.hover(page, "goroll")
        seen = page.evaluate("[...document.querySelector('.cm-lsp-hover-tooltip').children].map(one => one.nodeName)")
        self.assertEqual(seen, ["P", "PRE", "DETAILS"])
        self.assertFalse(page.evaluate("document.querySelector('.cm-tooltip-hover').innerText.includes('source')"))
        page.evaluate("document.querySelector('.cm-tooltip-hover summary').click()")
        self.assertTrue(page.evaluate("document.querySelector('.cm-tooltip-hover').innerText.includes('heading: 0 to 359')"))

    def test_the_number_to_change_is_pointed_at(self):
        page = self.open()
        self.assertIsNone(page.evaluate("document.querySelector('.cm-pointed')"))
        page.evaluate(click("run"))
        page.wait("document.querySelector('.cm-pointed')?.textContent === '4'", 10)
        self.assertEqual(page.evaluate("getComputedStyle(document.querySelector('.cm-pointed')).animationName"), "pulse")
        page.evaluate("(() => { const view = document.querySelector('.cm-content').cmTile.view; const from = view.state.doc.toString().indexOf('corners = 4') + 10; view.dispatch({ changes: { from, to: from + 1, insert: '3' } }); })()")
        page.wait("document.querySelector('.cm-pointed') === null", 5)

    def test_on_a_phone_the_way_to_the_number_is_pointed_at(self):
        page = self.open(width=390, height=844, mobile=True)
        page.evaluate(click("run"))
        page.wait("document.querySelector('.views .pulse') !== null", 10)
        look = "getComputedStyle(document.querySelector('.views .pulse')).animationName"
        self.assertEqual(page.evaluate(look), "pulse")
        page.evaluate("document.querySelector('.views .pulse').click()")
        self.assertEqual(page.evaluate(look), "none")
        self.assertEqual(page.evaluate("document.querySelector('.cm-pointed').textContent"), "4")

    def test_seldom_buttons_step_back(self):
        page = self.open(fragment({"a.orb": "RGB red\n", "b.orb": "RGB blue\n"}))
        shown = f"['rename-file', 'drop-file', 'format'].map(id => document.getElementById(id).checkVisibility())"
        self.assertEqual(page.evaluate(shown), [False] * 3)
        page.evaluate("document.querySelector('#file-menu summary').click()")
        self.assertEqual(page.evaluate(shown), [True] * 3)
        self.press(page, "drop-file")
        page.wait(f"({text}).includes('blue')")
        self.assertEqual(page.evaluate(shown), [False] * 3)

    # -- sounds --
    def test_sounds_are_for_those_who_want_them(self):
        count = "for (const name of ['createOscillator', 'createBufferSource']) { const made = AudioContext.prototype[name]; AudioContext.prototype[name] = function () { (window.sounds ??= []).push(name); return made.call(this); }; }"
        page = self.open("#lesson=lessons/01-traffic-light", before=count)
        page.evaluate(click("solution"))
        self.verdict(page)
        self.assertIsNone(page.evaluate("window.sounds"))
        self.assertEqual([one for one in page.requests if "sound" in one], [])
        page.evaluate("document.querySelector('#menu summary').click()")
        self.press(page, "sound")
        page.wait("window.sounds?.includes('createBufferSource')")
        self.assertEqual(page.evaluate(f"[{by_id('sound')}.textContent, {by_id('sound')}.getAttribute('aria-pressed')]"), ["Sounds: on", "true"])
        self.verdict(page)
        page.wait("window.sounds.filter(one => one === 'createOscillator').length === 4", 10)  # a cheer
        page.go("about:blank")
        page.go(self.server.url)
        page.wait(ready)
        self.assertEqual(page.evaluate(f"{by_id('sound')}.textContent"), "Sounds: on")


if __name__ == "__main__":
    if not chromium.find() or not os.path.exists(os.path.join(folder, "orb.wasm")):
        print("skipped: no Chromium, or nothing built: ./dev playground")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
