#!/usr/bin/env python3
"""Tests the page of `orb run --report` in a headless Chromium: it renders, plays and jumps, and its
numbers equal the trace of the same run. usage: page_test.py ORB CHECKOUT

Exits with 77 (skipped, to ctest) if Chromium is not installed."""

import copy
import glob
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import browser as chromium

orb, root = (os.path.abspath(path) for path in sys.argv[1:3])
example = lambda name: glob.glob(os.path.join(root, "examples", "*", name))[0]
megabyte = 1_000_000

# Puts the slider where a hand would and tells the page.
seek = """(t => { const s = document.getElementById('time'); s.value = t;
  s.dispatchEvent(new Event('input')); })"""
now = "Number(document.getElementById('time').value)"
reading = lambda name: f"document.querySelector('[data-now={name}]').textContent"
total = lambda name: f"document.querySelector('[data-total={name}]').textContent"


def micro(ms):
    return round(ms * 1000)


class Run:
    """One run with its trace and its page."""

    def __init__(self, folder, name, *words, lines=True):
        self.page_path = os.path.join(folder, name + ".html")
        trace_path = os.path.join(folder, name + ".trace")
        lines = ["--trace-lines"] if lines else []
        subprocess.run([orb, "run", *words, "--report", self.page_path, "--trace", "json",
                        "--trace-out", trace_path, *lines],
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        with open(trace_path, encoding="utf-8") as trace:
            self.events = [json.loads(line) for line in trace]

    def of(self, kind):
        return [event for event in self.events if event["event"] == kind]

    def at(self, kind, t):
        before = [event for event in self.of(kind) if event["t"] <= t]
        return before[-1] if before else None

    def size(self):
        return os.path.getsize(self.page_path)


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="orb-report.")
        cls.browser = chromium.Browser(chromium.find())
        cls.dance = Run(cls.folder.name, "dance", example("dance.bas"))

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    def file(self, name, text):
        path = os.path.join(self.folder.name, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def open(self, run, width=1280, height=900, mobile=False):
        page = self.browser.page()
        page.resize(width, height, mobile)
        page.open(run.page_path)
        page.wait("document.getElementById('ball') !== null")
        self.addCleanup(self.assert_silent, page, run)
        return page

    def assert_silent(self, page, run):
        self.assertEqual(page.complaints, [])
        self.assertEqual([url for url in page.requests if not url.startswith(("file://" + run.page_path, "data:"))], [])

    def test_totals_equal_the_trace(self):
        page = self.open(self.dance)
        end = self.dance.of("end")[0]
        poses = self.dance.of("pose")
        self.assertGreater(len(poses), 50)
        self.assertEqual(page.evaluate(total("lines")).replace(",", ""), str(end["lines"]))
        self.assertEqual(page.evaluate(total("time")), f"{int(self.dance.events[-1]['t']) / 1000:.3f} s")
        top = max(pose["speed"] for pose in poses)
        self.assertAlmostEqual(float(page.evaluate(total("top-speed")).split()[0]), top, delta=0.051)
        way = sum(((b["x"] - a["x"]) ** 2 + (b["y"] - a["y"]) ** 2) ** 0.5 for a, b in zip(poses, poses[1:]))
        shown, unit = page.evaluate(total("distance")).split()
        self.assertAlmostEqual(float(shown) * (100 if unit == "m" else 1), way, delta=0.01 * way + 0.1)
        for kind in ("print", "marker", "collision", "error"):
            count = page.evaluate(f"(document.querySelector('[data-filter={kind}]') || {{dataset: {{count: 0}}}}).dataset.count")
            self.assertEqual(int(count), len(self.dance.of(kind)), kind)
            listed = page.evaluate(f"document.querySelectorAll('#events [data-kind={kind}]').length")
            self.assertEqual(listed, len(self.dance.of(kind)), kind)

    def test_line_counts_equal_the_trace(self):
        page = self.open(self.dance)
        rows = page.evaluate("[...document.querySelectorAll('#source tr')].map(row => [row.lastChild.textContent, Number(row.querySelector('.ran').dataset.count)])")
        wanted = {}
        for event in self.dance.of("line"):
            wanted[str(event["line"])] = wanted.get(str(event["line"]), 0) + 1
        self.assertGreater(len(wanted), 20)
        shown = {text.split()[0]: count for text, count in rows if count}
        self.assertEqual(shown, wanted)

    def test_every_moment_equals_the_trace(self):
        page = self.open(self.dance)
        for pose in self.dance.of("pose")[::7]:
            page.evaluate(f"{seek}({micro(pose['t'])})")
            x, y = page.evaluate(reading("position")).removesuffix(" cm").split(", ")
            self.assertAlmostEqual(float(x), pose["x"], delta=0.06)
            self.assertAlmostEqual(float(y), pose["y"], delta=0.06)
            self.assertAlmostEqual(float(page.evaluate(reading("speed")).split()[0]), pose["speed"], delta=0.06)
            led = self.dance.at("led", pose["t"])
            wanted = f"{led['r']}, {led['g']}, {led['b']}" if led else "0, 0, 0"
            self.assertEqual(page.evaluate(reading("led")), wanted)

    def test_a_bolt_has_a_matrix(self):
        program = self.file("lights.bas", "10 RGB 0,120,0\n20 delay 1000\n30 RGB 0,0,0\n40 delay 1000\n50 goroll 0,60,1\n60 delay 500\n70 goroll 0,0,0\n")
        lamps = "[...document.querySelectorAll('[data-now=matrix] rect')].map(lamp => lamp.style.fill)"
        on_ball = "[...document.querySelectorAll('#ball .matrix-on-ball rect')].map(lamp => lamp.style.fill)"
        label = "document.querySelector('[data-now=matrix] svg').getAttribute('aria-label')"
        for name, words in (("bolt", ["--robot", "bolt"]), ("sim", ["--port", "sim:", "--robot", "bolt"])):
            run = Run(self.folder.name, name, program, *words, lines=False)
            page = self.open(run)
            page.evaluate(f"{seek}(800000)")
            self.assertEqual(page.evaluate(lamps), ["rgb(0, 120, 0)"] * 64)
            self.assertEqual(page.evaluate(on_ball), ["rgb(0, 120, 0)"] * 64)
            self.assertEqual(page.evaluate(label), "Matrix: all #007800")
            page.evaluate(f"{seek}(1800000)")
            self.assertEqual(page.evaluate(lamps), [""] * 64)
            self.assertEqual(page.evaluate(label), "Matrix: dark")
        # A picture shows until the LED has another colour; the first lamp is at the bottom left.
        with open(run.page_path, encoding="utf-8") as file:
            text = file.read()
        pixels = "FF0000" + "000000" * 7 + "0000FF" + "000000" * 55
        drawn = text.replace('"matrix":{"t":[],"pixels":[]}', f'"matrix":{{"t":[500000],"pixels":["{pixels}"]}}')
        self.assertNotEqual(drawn, text)
        of_picture = copy.copy(run)
        of_picture.page_path = self.file("drawn.html", drawn)
        page = self.open(of_picture)
        page.evaluate(f"{seek}(800000)")
        places = page.evaluate("[...document.querySelectorAll('[data-now=matrix] rect')].filter(lamp => lamp.style.fill).map(lamp => (({x, y}) => [x, y])(lamp.getBoundingClientRect()))")
        self.assertEqual(len(places), 2)
        (red_x, red_y), (blue_x, blue_y) = places
        least_x, most_y = page.evaluate("(list => [Math.min(...list.map(one => one.x)), Math.max(...list.map(one => one.y))])([...document.querySelectorAll('[data-now=matrix] rect')].map(lamp => lamp.getBoundingClientRect()))")
        self.assertEqual((red_x, red_y), (least_x, most_y))
        self.assertEqual(blue_x, red_x)
        self.assertLess(blue_y, red_y)
        self.assertEqual(page.evaluate(label), "Matrix: 2 of 64 lamps lit")
        page.evaluate(f"{seek}(1800000)")
        self.assertEqual(page.evaluate(label), "Matrix: dark")
        # Others have none.
        plain = self.open(self.dance)
        self.assertTrue(plain.evaluate("document.querySelector('.now .matrix').hidden"))
        self.assertEqual(plain.evaluate("document.querySelectorAll('.matrix-on-ball').length"), 0)

    def test_plays_and_pauses(self):
        page = self.open(self.dance)
        where = "document.getElementById('ball').getAttribute('transform')"
        page.evaluate(f"{seek}(0)")
        before = page.evaluate(where)
        page.evaluate("document.getElementById('play').click()")
        page.wait(f"{now} > 300000")
        self.assertNotEqual(page.evaluate(where), before)
        page.evaluate("document.getElementById('play').click()")
        stopped = page.evaluate(now)
        page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        self.assertEqual(page.evaluate(now), stopped)

    def test_plays_to_the_end_and_lights_the_ball(self):
        page = self.open(self.dance)
        page.evaluate("document.getElementById('rate').value = '10'")
        page.evaluate("document.getElementById('play').click()")
        lamp = "document.getElementById('ball-lamp').getAttribute('fill')"
        page.wait(f"{lamp} !== 'transparent'")
        page.wait(f"{now} === Number(document.getElementById('time').max)")
        page.wait("document.getElementById('play').getAttribute('aria-label') === 'Play'")

    def test_events_jump(self):
        page = self.open(self.dance)
        prints = self.dance.of("print")
        for i in (0, len(prints) // 2, len(prints) - 1):
            page.evaluate(f"document.querySelectorAll('#events [data-kind=print]')[{i}].click()")
            self.assertEqual(page.evaluate(now), micro(prints[i]["t"]))
            text = page.evaluate("document.querySelector('#events .at .words').textContent")
            self.assertEqual(text, prints[i]["text"].rstrip("\n"))

    def test_a_long_list_shows_what_is_near_the_moment(self):
        program = self.file("many.bas", "10 for A = 1 to 1200\n20 print A\n30 delay 20\n40 next A\n50 RGB 0, 255, 0\n60 delay 20\n")
        page = self.open(Run(self.folder.name, "many", program, lines=False))
        rows, at = "document.querySelectorAll('#events [data-kind=print]')", "document.querySelector('#events .at .words')?.textContent"
        rest = "[...document.querySelectorAll('#events .gap')].map(one => one.textContent)"
        self.assertEqual(page.evaluate(rest), ["700 events before these"])
        self.assertEqual(page.evaluate(f"{rows}.length"), 500)
        page.evaluate("document.querySelector('#events .gap button').click()")
        self.assertEqual(page.evaluate(at), "700")
        self.assertEqual(page.evaluate(rest), ["449 events before these", "251 events after these"])
        page.evaluate("document.querySelector('#events .gap:last-child button').click()")
        self.assertEqual(page.evaluate(at), "950")
        page.evaluate(f"{seek}(0)")
        self.assertEqual(page.evaluate(f"{rows}[0].textContent"), "0.0001")
        self.assertEqual(page.evaluate(f"[...{rows}].slice(1).every(one => one.parentElement.classList.contains('future'))"), True)
        page.evaluate(f"{seek}(1e9)")
        self.assertEqual(page.evaluate(at), "1200")
        colours = page.evaluate("document.querySelectorAll('#track rect').length")
        self.assertEqual(colours, 1, "the green at the end is shown, though it is short")

    def test_source_lines_jump_to_their_first_run(self):
        page = self.open(self.dance)
        first = next(event["t"] for event in self.dance.of("line") if event["line"] == 210)
        page.evaluate("[...document.querySelectorAll('#source tr')].find(row => row.lastChild.textContent.startsWith('210 ')).click()")
        self.assertEqual(page.evaluate(now), micro(first))
        self.assertTrue(page.evaluate("document.querySelector('#source .current').textContent.includes('210 ')"))

    def test_works_by_keyboard(self):
        page = self.open(self.dance)
        times = sorted({micro(event["t"]) for kind in ("print", "marker", "collision", "error") for event in self.dance.of(kind)})
        page.key("Home")
        self.assertEqual(page.evaluate(now), 0)
        page.key("ArrowRight")
        self.assertEqual(page.evaluate(now), 50_000)
        page.key("ArrowRight", modifiers=8)  # shift
        self.assertEqual(page.evaluate(now), 1_050_000)
        page.key("n")
        following = next(t for t in times if t > 1_050_000)
        self.assertEqual(page.evaluate(now), following)
        page.key("p")
        self.assertLess(page.evaluate(now), following)
        page.key("End")
        self.assertEqual(page.evaluate(now), micro(self.dance.events[-1]["t"]))
        page.key("Home")
        page.key(" ")
        page.wait(f"{now} > 0")
        page.key(" ")
        self.assertEqual(page.evaluate("document.getElementById('play').getAttribute('aria-label')"), "Play")
        # Everything that can be pressed has a name and can be reached with Tab.
        self.assertEqual(page.evaluate("""[...document.querySelectorAll('button, select, input')].filter(one =>
          one.tabIndex < 0 || !(one.getAttribute('aria-label') || one.textContent || one.labels?.length)).length"""), 0)

    def test_follows_light_and_dark(self):
        page = self.open(self.dance)
        paper = "getComputedStyle(document.documentElement).backgroundColor"
        page.prefer("light")
        light = page.evaluate(paper)
        page.prefer("dark")
        dark = page.evaluate(paper)
        self.assertNotEqual(light, dark)
        page.key("t")  # auto -> light
        self.assertEqual(page.evaluate(paper), light)
        page.key("t")
        self.assertEqual(page.evaluate(paper), dark)

    def test_fits_a_phone(self):
        for width in (320, 390):
            page = self.open(self.dance, width, 780, mobile=True)
            self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width)
            page.key("End")
            self.assertEqual(page.evaluate("""[...document.querySelectorAll('.now dd, .totals dd, .tools button, .transport *')]
              .filter(one => one.getBoundingClientRect().right > innerWidth).length"""), 0)
            self.assertGreater(page.evaluate("document.getElementById('map').getBoundingClientRect().height"), 150)

    def test_a_minute_of_driving_is_small(self):
        run = Run(self.folder.name, "minute", example("fence.bas"), "--for", "60s")
        self.assertLess(run.size(), megabyte)
        page = self.open(run)
        self.assertEqual(page.evaluate(total("time")), "60.000 s")
        self.assertGreater(page.evaluate("document.querySelectorAll('#map .run').length"), 100)

    def test_an_hour_is_thinned_and_stays_small(self):
        program = self.file("hour.bas", "10 goroll H,80,1\n20 H = (H + 30) % 360\n30 RGB rnd 255,rnd 255,rnd 255\n40 print H\n50 delay 200\n60 goto 10\n")
        run = Run(self.folder.name, "hour", program, "--for", "3600s", lines=False)
        self.assertLess(run.size(), megabyte)
        page = self.open(run)
        self.assertFalse(page.evaluate("document.getElementById('thinned').hidden"))
        prints = page.evaluate("Number(document.querySelector('[data-filter=print]').dataset.count)")
        self.assertEqual(prints, len(run.of("print")))
        page.key("End")
        last = run.of("pose")[-1]
        x = float(page.evaluate(reading("position")).split(",")[0])
        self.assertAlmostEqual(x, last["x"], delta=0.06)

    def test_an_empty_run(self):
        run = Run(self.folder.name, "empty", self.file("empty.bas", "10 end\n"))
        page = self.open(run)
        self.assertFalse(page.evaluate("document.getElementById('still').hidden"))
        self.assertFalse(page.evaluate("document.getElementById('no-events').hidden"))
        page.evaluate("document.getElementById('play').click()")
        page.key("n")
        page.key("p")

    def test_without_a_program_there_is_no_pane_for_one(self):
        with open(self.dance.page_path, encoding="utf-8") as file:
            head, run, tail = re.split(r'(?<=id="run">)(.*?)(?=</script>)', file.read(), maxsplit=1, flags=re.S)
        data = json.loads(run)
        data.update(files=[], line={"t": [], "file": [], "line": []}, variables=[])
        driven = copy.copy(self.dance)
        driven.page_path = self.file("driven.html", head + json.dumps(data).replace("<", "\\u003c") + tail)
        hidden = "document.querySelector('.pane.source').offsetParent === null"
        bottom = lambda name: f"Math.round(document.querySelector('{name}').getBoundingClientRect().bottom)"
        for width in (1280, 400):
            page = self.open(driven, width)
            self.assertTrue(page.evaluate(hidden))
            self.assertEqual(page.evaluate("[...document.querySelectorAll('#now dt')].filter(one => one.offsetParent).map(one => one.textContent)"), ["at", "speed", "heading", "LED"])
            self.assertIsNone(page.evaluate("document.getElementById('line-on').offsetParent"))
            page.key(".")
        page = self.open(driven)
        top = lambda name: f"Math.round(document.querySelector('{name}').getBoundingClientRect().top)"
        self.assertEqual(page.evaluate(top(".events")), page.evaluate(top(".stage")))
        self.assertEqual(page.evaluate(bottom(".events")), page.evaluate(bottom(".stage")))
        self.assertFalse(self.open(self.dance).evaluate(hidden))

    def test_a_program_that_faults_at_once(self):
        run = Run(self.folder.name, "fault", self.file("fault.bas", "10 print 1/0 '</script><!--\n20 end\n"))
        page = self.open(run)
        self.assertEqual(page.evaluate("document.querySelectorAll('#events [data-kind=error]').length"), 1)
        self.assertIn("Divide by zero", page.evaluate("document.getElementById('outcome').textContent"))
        self.assertIn("</script><!--", page.evaluate("document.querySelector('#source .failed').textContent"))

    def test_a_macro_run(self):
        run = Run(self.folder.name, "macro", example("square.macro"))
        page = self.open(run)
        markers = run.of("marker")
        self.assertGreater(len(markers), 3)
        self.assertEqual(page.evaluate(total("commands")), str(len(run.of("macro"))))
        self.assertTrue(page.evaluate("document.querySelectorAll('#source .ran[data-count=\"1\"]').length > 20"))
        for i, marker in enumerate(markers):
            page.evaluate(f"document.querySelectorAll('#events [data-kind=marker]')[{i}].click()")
            self.assertEqual(page.evaluate(now), micro(marker["t"]))

    def test_a_program_and_a_macro_side_by_side(self):
        run = Run(self.folder.name, "pair", example("conductor.bas"), example("orchestra.macro"))
        page = self.open(run)
        self.assertEqual(page.evaluate("document.getElementById('file').options.length"), 2)
        t = next(event["t"] for event in run.of("macro") if event["id"] == 41)
        page.evaluate(f"{seek}({micro(t)})")
        self.assertRegex(page.evaluate("document.querySelector('#source .current').textContent"), "[0-9]+ (delay|if|macrun)")
        page.evaluate("(file => { file.value = 1; file.dispatchEvent(new Event('change')); })(document.getElementById('file'))")
        self.assertIn("rgb 255 160 0", page.evaluate("document.querySelector('#source .current').textContent"))

    def test_a_report_opens_on_the_whole_run_and_its_program(self):
        subprocess.run([orb, "new", "robot", "--structured"], cwd=self.folder.name, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        starter = lambda name: os.path.join(self.folder.name, "robot", name)
        run = Run(self.folder.name, "starter", starter("robot.orb"), "--stimulus", starter("world.stimulus"))
        page = self.open(run)
        self.assertEqual(page.evaluate(now), page.evaluate("Number(document.getElementById('time').max)"))
        self.assertGreater(page.evaluate("document.querySelectorAll('#map .run').length"), 4)
        self.assertEqual(page.evaluate("document.querySelectorAll('#map [visibility=hidden]').length"), 0)
        self.assertEqual(page.evaluate("document.getElementById('file').selectedOptions[0].textContent"), "robot.orb")
        self.assertEqual(page.evaluate("document.querySelector('#source .current').lastChild.textContent"), "macrun wink")
        lines = page.evaluate("document.querySelectorAll('#source tr').length")
        self.assertEqual(page.evaluate(reading("line")), str(lines))
        self.assertTrue(page.evaluate("""(() => {
          const row = document.querySelector('#source .current').getBoundingClientRect(), pane = document.getElementById('source-scroll').getBoundingClientRect();
          return row.top >= pane.top && row.bottom <= pane.bottom;
        })()"""))
        # Whoever plays it sees it from the start.
        page.evaluate("document.getElementById('play').click()")
        page.wait(f"{now} > 0 && {now} < 2000000")
        page.evaluate("document.getElementById('play').click()")

    def test_only_what_a_macro_does_counts_as_run(self):
        run = Run(self.folder.name, "comment", self.file("comment.macro", "; not a command\nrgb 0 255 0\ndelay 200\n"))
        page = self.open(run)
        self.assertEqual(page.evaluate("[...document.querySelectorAll('#source .ran')].map(one => Number(one.dataset.count))"), [0, 1, 1])
        self.assertNotIn("0 lines", page.evaluate("document.body.textContent"))

    def test_what_the_totals_say_is_said_once(self):
        page = self.open(self.dance)
        self.assertEqual(page.evaluate("document.getElementById('outcome').textContent"), "ended")

    def test_a_watched_page_loads_itself_again(self):
        program = self.file("watched.bas", "10 print \"before\"\n")
        page_path = os.path.join(self.folder.name, "watched.html")
        watching = subprocess.Popen([orb, "run", "--watch", "--open", "--report", page_path, program],
                                    env={**os.environ, "BROWSER": "true"},
                                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (watching.terminate(), watching.communicate()))
        while "waiting" not in watching.stderr.readline():
            pass
        page = self.browser.page()
        page.open(page_path)
        page.wait("document.body.textContent.includes('before')")
        self.file("watched.bas", "10 print \"after\"\n")
        page.wait("document.body.textContent.includes('after')")
        self.assertEqual(page.complaints, [])

    def test_the_readout_stands_beside_the_map(self):
        for width, mobile in ((1280, False), (390, True)):
            page = self.open(self.dance, width, 860, mobile)
            self.assertEqual(page.evaluate("""(() => {
              const map = document.getElementById('map').getBoundingClientRect();
              return ['now', 'legend', 'scale-bar', 'zoom-in', 'follow'].filter(id => {
                const box = document.getElementById(id).getBoundingClientRect();
                return box.left < map.right && box.right > map.left && box.top < map.bottom && box.bottom > map.top;
              });
            })()"""), [])

    # The contrast of an outline against the card, as WCAG computes it; a stroke may be translucent.
    contrast = """(selector => {
      const channels = text => text.match(/[0-9.]+/g).map(Number);
      const card = channels(getComputedStyle(document.querySelector('.stage')).backgroundColor);
      const [r, g, b, a = 1] = channels(getComputedStyle(document.querySelector(selector)).stroke);
      const light = rgb => rgb.map(c => c / 255).map(c => c <= .03928 ? c / 12.92 : ((c + .055) / 1.055) ** 2.4)
        .reduce((sum, c, i) => sum + c * [.2126, .7152, .0722][i], 0);
      const seen = light([r, g, b].map((c, i) => c * a + card[i] * (1 - a))), under = light(card);
      return (Math.max(seen, under) + .05) / (Math.min(seen, under) + .05);
    })"""

    def test_white_black_and_no_light_are_seen_on_light_and_dark(self):
        program = self.file("leds.bas", "10 RGB 255,255,255\n20 goroll 0,90,1\n30 delay 900\n40 RGB 0,0,30\n50 delay 900\n60 RGB 0,0,0\n70 delay 900\n80 goroll 0,0,0\n90 delay 900\n")
        page = self.open(Run(self.folder.name, "leds", program))
        page.key("End")
        page.evaluate("delete document.documentElement.dataset.theme")
        for scheme, outlined in (("light", ".casing.pale"), ("dark", ".casing.deep")):
            page.prefer(scheme)
            for selector in (outlined, ".run.unlit"):
                self.assertGreater(page.evaluate(f"{self.contrast}('{selector}')"), 3, (scheme, selector))
        self.assertEqual(page.evaluate("document.querySelector('[data-sign=unlit]').textContent"), "LED off")

    def test_the_program_has_the_colours_of_its_language(self):
        text = "10 ' counts\n20 for A = 1 to 3 ' up\n30 print \"for 5 \" A, xpos\n40 next A\n"
        page = self.open(Run(self.folder.name, "colours", self.file("colours.bas", text)))
        rows = page.evaluate("[...document.querySelectorAll('#source tr')].map(row => row.lastChild.textContent)")
        self.assertEqual(rows, text.rstrip("\n").split("\n"))
        of = lambda kind: page.evaluate(f"[...document.querySelectorAll('#source .is-{kind}')].map(one => one.textContent)")
        self.assertEqual(of("comment"), ["' counts", "' up"])
        self.assertEqual(of("statement"), ["for", "to", "print", "next"])
        self.assertEqual(of("string"), ['"for 5 "'])
        self.assertEqual(of("number"), ["1", "3"])
        self.assertEqual(of("label"), ["10", "20", "30", "40"])
        self.assertEqual(of("sensor"), ["xpos"])
        text = "' counts\nconst pause = 1.5s\nfor a = 1 to 3 ' up\n  Print \"for 5 \" a, xpos\n  RGB #FF8000\nnext a\ndelay pause\n"
        page = self.open(Run(self.folder.name, "orb-colours", self.file("colours.orb", text)))
        rows = page.evaluate("[...document.querySelectorAll('#source tr')].map(row => row.lastChild.textContent)")
        self.assertEqual(rows, text.rstrip("\n").split("\n"))
        self.assertEqual(of("comment"), ["' counts", "' up"])
        self.assertEqual(of("statement"), ["const", "for", "to", "Print", "RGB", "next", "delay"])
        self.assertEqual(of("number"), ["1.5s", "1", "3", "#FF8000"])
        self.assertEqual(of("label"), [])
        self.assertEqual(of("sensor"), ["xpos"])
        page = self.open(Run(self.folder.name, "macro-colours", example("square.macro")))
        self.assertIn("wait_until_stopped", page.evaluate("[...document.querySelectorAll('#source .is-statement')].map(one => one.textContent)"))

    def test_what_a_program_says_stays_text(self):
        bad = "<img src=x onerror=\"window.hacked = 1\"><script>window.hacked = 1</script>"
        name = "<b>x.bas"
        program = self.file(name, f"10 print \"<i>\" ' {bad}\n20 print 1/0 ' </script><!--\n")
        run = Run(self.folder.name, "hostile", program)
        page = self.open(run)
        self.assertEqual(page.evaluate("document.querySelectorAll('img, #events i, #title b, body script').length"), 3)  # its own
        self.assertIsNone(page.evaluate("window.hacked"))
        self.assertIn(bad, page.evaluate("document.querySelector('#source tr').textContent"))
        self.assertEqual(page.evaluate("document.querySelector('#events .words').textContent"), "<i>")
        self.assertEqual(page.evaluate("document.getElementById('title').textContent"), name)
        after = Run(self.folder.name, "after-hostile", example("dance.bas"), "--compare", run.page_path)
        page = self.open(after)
        page.evaluate("document.querySelector('[data-run=before]').click()")
        self.assertIsNone(page.evaluate("window.hacked"))
        self.assertIn(bad, page.evaluate("document.querySelector('#source tr').textContent"))

    def test_walls_that_were_hit_are_listed_without_collision_detection(self):
        run = Run(self.folder.name, "maze", example("maze.bas"), "--stimulus", example("maze.stimulus"))
        self.assertEqual(run.of("collision"), [])
        bumps = run.of("bump")
        self.assertGreater(len(bumps), 5)
        page = self.open(run)
        times = page.evaluate("[...document.querySelectorAll('#events [data-kind=bump]')].map(one => Number(one.dataset.t))")
        self.assertEqual(times, [micro(bump["t"]) for bump in bumps])
        self.assertEqual(page.evaluate("document.querySelectorAll('#map [data-mark=bump]').length"), len(bumps))
        self.assertIn("wall", page.evaluate("document.querySelector('#events .bump .words').textContent"))

    def test_prints_are_joined_as_the_robot_sends_them(self):
        program = self.file("joined.bas", "10 print \"a\";\n20 delay 100\n30 print \"b\"\n40 print \"c\";\n")
        run = Run(self.folder.name, "joined", program)
        page = self.open(run)
        self.assertEqual(page.evaluate("[...document.querySelectorAll('#events [data-kind=print]')].map(one => [one.querySelector('.words').textContent, Number(one.dataset.t)])"),
                         [["ab", micro(run.of("print")[1]["t"])], ["c", micro(run.of("end")[0]["t"])]])
        self.assertEqual(page.evaluate("document.querySelector('[data-filter=print]').dataset.count"), "2")

    def test_the_moment_of_the_address_is_honoured_on_change(self):
        page = self.open(self.dance)
        for t in ("3.2", "1"):
            page.evaluate(f"location.hash = '#t={t}'")
            page.wait(f"{now} === {round(float(t) * 1e6)}")

    def test_a_moment_that_is_none_is_left_alone(self):
        page = self.open(self.dance)
        page.evaluate(f"{seek}(1000000)")
        for address in ("1.2.3", ".", "1e9999", "-1", "1.", ""):
            page.evaluate(f"location.hash = '#t={address}'; new Promise(done => setTimeout(done, 30))")
            self.assertEqual(page.evaluate(now), 1_000_000, address)
            self.assertRegex(page.evaluate("document.getElementById('clock').textContent"), "^[0-9.]+$")
        page.open(self.dance.page_path + "#t=1.2.3")
        page.wait("document.getElementById('ball') !== null")
        self.assertNotIn("NaN", page.evaluate("document.documentElement.outerHTML"))

    def test_titles_on_a_phone_break_between_words(self):
        program = self.file("my-first-very-long_program.of-a-pupil.bas", "10 end\n")
        page = self.open(Run(self.folder.name, "long", program), 320, 700, mobile=True)
        broken = page.evaluate("""[...document.getElementById('title').childNodes].filter(node => node.nodeType === 3).filter(node => {
          const range = document.createRange();
          range.selectNode(node);
          return new Set([...range.getClientRects()].map(box => box.top)).size > 1;
        }).map(node => node.textContent)""")
        self.assertEqual(broken, [])
        self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 320)

    def test_words_on_the_map_keep_clear_of_walls(self):
        run = Run(self.folder.name, "walls", example("maze.bas"), "--stimulus", example("maze.stimulus"))
        for width, mobile in ((1280, False), (390, True)):
            page = self.open(run, width, 860, mobile)
            self.assertEqual(page.evaluate("""(() => {
              const walls = [...document.querySelectorAll('#map .wall')].map(one => one.getBoundingClientRect());
              return [...document.querySelectorAll('#map .grid-word, #map .mark-word')].filter(word => {
                const box = word.getBoundingClientRect();
                return walls.some(wall => wall.left < box.right && wall.right > box.left && wall.top < box.bottom && wall.bottom > box.top);
              }).map(word => word.textContent);
            })()"""), [])

    def test_a_course_is_drawn_to_scale_with_its_names(self):
        page = self.open(Run(self.folder.name, "course", example("hall.orb"), "--course", example("hall.svg")))
        self.assertEqual(page.evaluate("[...document.querySelectorAll('#map .zone-word')].map(one => one.textContent)"),
                         ["goal", "island", "puddle"])
        self.assertEqual(page.evaluate("[...document.querySelectorAll('#legend [data-sign]')].map(one => one.dataset.sign)"),
                         ["start", "end", "wall", "zone"])
        # All of it is in view, and the goal is 5 by 9, as it is drawn.
        boxes = page.evaluate("""(() => {
          const box = one => { const { left, right, top, bottom } = one.getBoundingClientRect(); return { left, right, top, bottom }; };
          return { map: box(document.getElementById('map')), goal: box(document.querySelector('[data-zone=goal]')),
                   walls: [...document.querySelectorAll('#map .wall')].map(box) };
        })()""")
        self.assertEqual(len(boxes["walls"]), 4 + 4 + 2 + 8)
        for wall in boxes["walls"]:
            self.assertGreater(wall["left"], boxes["map"]["left"])
            self.assertGreater(wall["top"], boxes["map"]["top"])
            self.assertLess(wall["right"], boxes["map"]["right"])
            self.assertLess(wall["bottom"], boxes["map"]["bottom"])
        goal = boxes["goal"]
        ratio = lambda box: (box["right"] - box["left"]) / (box["bottom"] - box["top"])
        self.assertAlmostEqual(ratio(goal), 5 / 9, delta=.05)
        # One button turns all of it as the ball sees it.
        self.assertEqual(page.evaluate("document.getElementById('as-drawn').getAttribute('aria-pressed')"), "true")
        page.evaluate("document.getElementById('as-drawn').click()")
        turned = page.evaluate("(() => { const { left, right, top, bottom } = document.querySelector('[data-zone=goal]').getBoundingClientRect(); return { left, right, top, bottom }; })()")
        self.assertAlmostEqual(ratio(turned), 9 / 5, delta=.05)

    def test_only_a_course_that_is_drawn_otherwise_can_be_turned(self):
        page = self.open(self.dance)
        self.assertTrue(page.evaluate("document.getElementById('as-drawn').hidden"))

    def test_names_of_zones_keep_clear_of_borders(self):
        for name, program in (("hall", "hall.orb"), ("parking", "parking.orb")):
            run = Run(self.folder.name, name, example(program), "--course", example(name + ".svg"))
            for width, mobile in ((1280, False), (390, True)):
                page = self.open(run, width, 860, mobile)
                crossed = page.evaluate("""(() => {
                  const found = [];
                  for (const word of document.querySelectorAll('#map .zone-word')) {
                    const box = word.getBBox();
                    for (const line of document.querySelectorAll('#map .zone, #map .wall'))
                      for (let at = 0, long = line.getTotalLength(); at <= long; at += 1) {
                        const p = line.getPointAtLength(at);
                        if (p.x > box.x && p.x < box.x + box.width && p.y > box.y && p.y < box.y + box.height) { found.push(word.textContent); break; }
                      }
                  }
                  return found;
                })()""")
                self.assertEqual(crossed, [], (name, width))

    def test_the_program_is_large_and_the_colours_stand_in_one_bar(self):
        page = self.open(self.dance)
        self.assertGreaterEqual(page.evaluate("parseFloat(getComputedStyle(document.querySelector('#source td:last-child')).fontSize)"), 15)
        bars = page.evaluate("[...document.querySelectorAll('svg')].filter(one => one.id !== 'map' && one.querySelector('rect[fill]')).map(one => one.id)")
        self.assertEqual(bars, ["track"])

    def test_a_course_prints_in_real_centimetres(self):
        drawing = example("parking.svg")
        out = os.path.join(self.folder.name, "parking.pdf")
        subprocess.run([chromium.find(), "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer",
                        f"--user-data-dir={self.folder.name}/print", f"--print-to-pdf={out}", "file://" + drawing],
                       check=True, env=chromium.environment(self.folder.name), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=60)
        with open(out, "rb") as file:
            pages = re.findall(rb"/MediaBox \[([0-9. ]+)\]", file.read())
        self.assertEqual(len(pages), 1)
        left, low, right, high = (float(number) * 2.54 / 72 for number in pages[0].split())
        self.assertAlmostEqual(right - left, 42, delta=.05)
        self.assertAlmostEqual(high - low, 29.7, delta=.05)

    def test_paper_shows_the_whole_path_and_the_whole_program(self):
        page = self.open(Run(self.folder.name, "paper", example("conductor.bas"), example("orchestra.macro")))
        page.prefer("dark")
        page.evaluate(f"{seek}(1000000)")
        page.evaluate("document.getElementById('zoom-in').click()")
        page.call("Emulation.setEmulatedMedia", media="print", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(page.evaluate("document.querySelectorAll('#map [visibility=hidden]').length"), 0)
        self.assertEqual(page.evaluate("""[...document.querySelectorAll('.scroll')].filter(one =>
          getComputedStyle(one).overflow !== 'visible' || one.getBoundingClientRect().height + 1 < one.scrollHeight).length"""), 0)
        self.assertEqual(page.evaluate("document.querySelectorAll('.listing tr').length"), 9 + 21)
        self.assertEqual(page.evaluate("""['.transport', '.tools', '.zoom', '.lanes'].filter(one =>
          document.querySelector(one).getClientRects().length > 0)"""), [])
        self.assertEqual(page.evaluate("getComputedStyle(document.documentElement).color"), "rgb(20, 33, 43)")
        page.evaluate("window.dispatchEvent(new Event('afterprint'))")
        self.assertEqual(page.evaluate(now), 1_000_000)
        self.assertEqual(page.evaluate("document.querySelectorAll('.listing tr').length"), 9)

    def test_two_runs_stand_side_by_side(self):
        slow = self.file("drive.bas", "10 RGB 0,200,0\n20 goroll 0,60,1\n30 delay 1000\n40 goroll 0,0,0\n50 delay 1000\n60 print \"slow\"\n")
        before = Run(self.folder.name, "before", slow)
        fast = self.file("drive.bas", "10 RGB 0,200,0\n20 goroll 90,120,1\n30 delay 1000\n40 goroll 90,0,0\n50 delay 500\n60 print \"fast\"\n")
        after = Run(self.folder.name, "after", fast, "--compare", before.page_path)
        page = self.open(after)
        maps = page.evaluate("['map-before', 'map'].map(id => { const box = document.getElementById(id).getBoundingClientRect(); return [box.left, box.top, box.width]; })")
        self.assertLess(maps[0][0] + maps[0][2], maps[1][0] + 2)
        self.assertEqual(maps[0][1], maps[1][1])
        self.assertEqual(page.evaluate("document.querySelector('[data-before=time]').textContent"), "before 2.002 s")
        self.assertEqual(page.evaluate("document.querySelectorAll('.line.before').length"), 2)
        page.evaluate(f"{seek}(1500000)")
        pose = before.at("pose", 1500)
        shown = page.evaluate("document.querySelector('#map-before + figcaption span').textContent")
        self.assertAlmostEqual(float(shown.split(",")[1].split()[0]), pose["y"], delta=2)
        words = "document.querySelector('#events .words').textContent"
        self.assertEqual(page.evaluate(words), "fast")
        page.evaluate("document.querySelector('[data-run=before]').click()")
        self.assertEqual(page.evaluate(words), "slow")
        self.assertIn("goroll 0,60,1", page.evaluate("document.getElementById('source').textContent"))


    def test_the_balls_of_a_room_are_played_back_together(self):
        red = self.file("red.orb", "RGB 255, 0, 0\ngoroll 270, 60, 1\ndelay 1500\ngoroll 270, 0, 0\nprint \"red\"\n")
        blue = self.file("blue.orb", "RGB 0, 0, 255\ndelay 2s\nprint \"blue\"\n")
        room = Run(self.folder.name, "room", red, blue, "--together")
        page = self.open(room)
        place = lambda name: page.evaluate(f"[...document.querySelectorAll('#map .ball')].find(one => one.querySelector('.ball-name').textContent === '{name}').getAttribute('transform').match(/[-0-9.]+/g).map(Number)")
        centimetres = page.evaluate("document.getElementById('scale-bar').getBoundingClientRect().width") / float(page.evaluate("document.getElementById('scale-words').textContent").split()[0])
        for ms in (100, 700, 1400, 2900):
            page.evaluate(f"{seek}({micro(ms)})")
            there = {}
            for name in ("red", "blue"):
                poses = [event for event in room.of("pose") if event["ball"] == name and event["t"] <= ms]
                there[name] = (poses[-1]["x"], poses[-1]["y"]) if poses else (0, 0)
            for axis, sign in ((0, 1), (1, -1)):
                apart = (place("red")[axis] - place("blue")[axis]) / centimetres * sign
                self.assertAlmostEqual(apart, there["red"][axis] - there["blue"][axis], delta=4) # it moves on between two poses
        words = "[...document.querySelectorAll('#events .words')].map(one => one.textContent).join(', ')"
        self.assertIn("met ball red", page.evaluate(words))
        page.evaluate("document.querySelector('[data-ball=red]').click()")
        self.assertIn("met ball blue", page.evaluate(words))
        self.assertIn("goroll 270, 60, 1", page.evaluate("document.getElementById('source').textContent"))
        self.assertEqual(page.evaluate("document.querySelector('[data-ball=red]').getAttribute('aria-pressed')"), "true")
        self.assertEqual(page.evaluate("document.querySelectorAll('#map .ball').length"), 2)

    # ---- variables and lines

    variable = staticmethod(lambda name: f"document.querySelector('[data-variable=\"{name}\"] .value')?.textContent")
    press = staticmethod(lambda key: f"document.dispatchEvent(new KeyboardEvent('keydown', {{ key: '{key}', bubbles: true }}))")

    def test_variables_have_their_names_and_values_at_every_moment(self):
        text = ("array seen[3]\nturns = 0\nsub leg(n)\n  local twice\n  twice = n * 2 + speed\n"
                "  seen[n] = twice\n  turns += twice\n  LEDC twice\n  delay 20ms\nend sub\n"
                "for i = 1 to 3\n  leg(i)\nnext i\nleg(3)\nprint turns, seen[2]\nprint turns\n")
        run = Run(self.folder.name, "names", self.file("names.orb", text))
        page = self.open(run)
        page.evaluate(f"{seek}(document.getElementById('time').max)")
        self.assertEqual(page.evaluate(self.variable("turns")), "18")
        self.assertEqual(page.evaluate(self.variable("seen[2]")), "4")
        self.assertIn("in leg", page.evaluate("document.getElementById('variables').textContent"))
        page.evaluate(f"{seek}(0)")
        self.assertEqual(page.evaluate(self.variable("turns")), "0")
        # From change to change, and back.
        jump = lambda words: page.evaluate(
            f"document.querySelector('[data-variable=turns] [data-jump={words}]').click()")
        seen = []
        for _ in range(4):
            jump("next")
            seen.append((page.evaluate(now), page.evaluate(self.variable("turns"))))
            self.assertTrue(page.evaluate(
                "document.querySelector('[data-variable=turns]').classList.contains('changed')"))
        self.assertEqual([value for _, value in seen], ["2", "6", "12", "18"])
        jump("previous")
        self.assertEqual(page.evaluate(now), seen[2][0])
        self.assertEqual(page.evaluate(self.variable("turns")), "12")

    def test_lines_are_stepped_forwards_and_backwards(self):
        run = Run(self.folder.name, "steps", self.file("steps.bas", "10 A=1\n20 B=A+1\n30 A=B*7\n40 delay 50\n50 end\n"))
        page = self.open(run)
        page.evaluate(f"{seek}(0)")
        states = []
        for _ in range(4):
            page.evaluate(self.press("."))
            states.append([page.evaluate(what) for what in (now, reading("line"), self.variable("A"), self.variable("B"))])
        self.assertEqual([state[1:] for state in states],
                         [["1", "1", "0"], ["2", "1", "2"], ["3", "14", "2"], ["4", "14", "2"]])
        for state in reversed(states[:-1]):
            page.evaluate(self.press(","))
            self.assertEqual([page.evaluate(what) for what in (now, reading("line"), self.variable("A"), self.variable("B"))], state)
        page.evaluate("document.getElementById('line-on').click()")
        self.assertEqual(page.evaluate(now), states[1][0])

    def test_a_long_run_says_where_changes_are_left_out(self):
        run = Run(self.folder.name, "counting", self.file("counting.bas", "10 A=A+1\n20 B=0-A\n30 goto 10\n"), "--for", "120s", lines=False)
        page = self.open(run)
        self.assertLess(run.size(), 2 * megabyte)
        page.evaluate(f"{seek}(document.getElementById('time').max)")
        last = int(page.evaluate(self.variable("A")))
        self.assertGreater(last, 100_000)
        self.assertIn("left out", page.evaluate("document.querySelector('[data-variable=A]').title"))
        self.assertFalse(page.evaluate("document.getElementById('thinned').hidden"))

    def test_a_run_without_variables_shows_no_pane(self):
        page = self.open(Run(self.folder.name, "plain", self.file("plain.bas", "10 print 1\n")))
        self.assertTrue(page.evaluate("document.getElementById('variables-pane').hidden"))

    def test_bumps_stand_on_the_map_and_on_the_slider(self):
        run = Run(self.folder.name, "bump", self.file("bump.bas", "10 goroll 90,200,1\n20 delay 1500\n30 end\n"), "--stimulus", "wall x=40")
        page = self.open(run)
        self.assertGreater(page.evaluate("document.querySelectorAll('[data-mark=bump]').length"), 0)
        self.assertGreater(page.evaluate("document.querySelectorAll('[data-tick=bump]').length"), 0)


class TestReport(unittest.TestCase):
    """The page of `orb test --report`: a picture of each run, and a replay of each failure."""

    def test_pictures_are_shown_and_failures_play_back(self):
        folder = tempfile.TemporaryDirectory(prefix="orb-report.")
        self.addCleanup(folder.cleanup)
        name = lambda file: os.path.join(folder.name, file)
        with open(name("way.bas"), "w", encoding="utf-8") as file:
            file.write("10 goroll rnd 359,100,1\n20 LEDC 1\n30 delay 900\n40 goroll 0,0,0\n50 delay 900\n")
        with open(name("way.test"), "w", encoding="utf-8") as file:
            file.write('test "goes <up>" seeds 1..6\n  expect beyond y>20\ntest "moves"\n  expect moving\n')
        done = subprocess.run([orb, "test", name("way.test"), "--report", name("out"), "--format", "json"],
                              stdout=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, 1)
        tests = json.loads(done.stdout)["tests"]
        failed = sum(case["verdict"] == "failed" for test in tests for case in test["cases"])
        self.assertGreater(failed, 0)
        browser = chromium.Browser(chromium.find())
        self.addCleanup(browser.close)
        for width in (1280, 400):
            page = browser.page()
            page.resize(width, 900, width < 500)
            page.open(name("out/index.html"))
            page.wait("[...document.images].every(image => (image.loading = 'eager', image.complete))")
            self.assertEqual(page.evaluate("document.querySelectorAll('.run').length"), 7)
            self.assertEqual(page.evaluate("[...document.images].filter(image => image.naturalWidth > 0).length"), 7)
            self.assertEqual(page.evaluate("document.querySelectorAll('.run.failed').length"), failed)
            self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width)
            self.assertEqual(page.complaints, [])
        replay = page.evaluate("document.querySelector('.run.failed p a').getAttribute('href')")
        page.open(name(os.path.join("out", replay)))
        page.wait("document.getElementById('ball') !== null")
        self.assertIn("goes <up>", page.evaluate("document.title"))
        self.assertEqual(page.complaints, [])


if __name__ == "__main__":
    if chromium.find() is None:
        print("skipped: no chromium here; `./dev report` installs it")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=1)
