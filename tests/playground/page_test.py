#!/usr/bin/env python3
"""Tests the playground in a headless Chromium. usage: page_test.py ORB FOLDER [TEST...]

FOLDER is what `./dev playground` built. Exits with 77 (skipped, to ctest) if Chromium is not installed or
nothing is built."""

import base64
import json
import os
import re
import sys
import unittest
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "report"))
import browser as chromium
import site_server
import weight

orb, folder = (os.path.abspath(path) for path in sys.argv[1:3])

by_id = lambda name: f"document.getElementById('{name}')"
click = lambda name: f"{by_id(name)}.click()"
findings = "[...document.querySelectorAll('#findings li')].map(item => item.dataset.rule)"
text = "document.querySelector('.cm-content').cmTile?.view?.state.doc.toString() ?? [...document.querySelectorAll('.cm-line')].map(line => line.textContent).join('\\n')"
events = "[...document.querySelectorAll('#events .words')].map(words => words.textContent)"
outcome = f"{by_id('outcome')}.textContent"
ready = "document.documentElement?.dataset.ready"
coloured = "document.querySelector('.cm-line [class^=tok-]') !== null"
idle = f"!{by_id('run')}.classList.contains('stop')"
stop = f"{by_id('run')}.classList.contains('stop') && {by_id('run')}.click()"
played = f"!{by_id('played')}.classList.contains('idle')"
# Chromium's own editing of the text writes styles that the policy refuses.
note_violations = "document.addEventListener('securitypolicyviolation', event => event.target.closest?.('.cm-content') || (window.violations ??= []).push(`${event.violatedDirective} ${event.blockedURI}`));"
wait = lambda ms: f"new Promise(done => setTimeout(done, {ms}))"


def fragment(files, **more):
    """Returns what the page itself would put behind `#`."""
    data = json.dumps({"files": files, "active": next(iter(files)), **more}).encode()
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(data) + packer.flush()
    return "#p=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def lessons():
    """Returns the lessons with all their files, from the folder."""
    def read(name):
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return json.load(file)
    known = [item for group in read("examples.json")["groups"] for item in group["items"] if "job" in item and item["language"] == "orb"]
    return [{**item, **read(f"examples/{item['id']}.json")} for item in known]


# A port of the browser that leads to a ball behind the web server.
mock_serial = """
const port = {
  readable: null, writable: null,
  async open() {
    let over = false;
    this.readable = new ReadableStream({
      async pull(out) {
        while (!over) {
          const answer = await fetch('/wire/read');
          if (answer.status !== 200) throw new DOMException('lost', 'NetworkError');
          const bytes = new Uint8Array(await answer.arrayBuffer());
          if (bytes.length) return out.enqueue(bytes);
        }
      },
      cancel() { over = true; },
    });
    this.writable = new WritableStream({ async write(bytes) {
      if ((await fetch('/wire/write', { method: 'POST', body: bytes })).status !== 200) throw new DOMException('lost', 'NetworkError');
    } });
  },
  async close() { this.readable = this.writable = null; },
};
Object.defineProperty(navigator, 'serial', { value: { requestPort: async () => port } });
"""
mock_bluetooth = """
class Characteristic extends EventTarget {
  constructor(robot, service, name) { super(); Object.assign(this, { robot, service, name }); }
  async writeValueWithResponse(value) {
    const bytes = new Uint8Array(value.buffer ? value.buffer.slice(value.byteOffset, value.byteOffset + value.byteLength) : value);
    if (bytes.length > 20) throw new DOMException('too long', 'InvalidModificationError');
    (window.written ??= []).push([this.name, bytes.length]);
    if (!this.robot.greeted) return; // what opens the robot to commands
    if ((await fetch('/wire/write', { method: 'POST', body: bytes })).status !== 200) this.robot.gatt.disconnect();
  }
  async startNotifications() {
    this.robot.greeted = true;
    (async () => { while (this.robot.gatt.connected) {
      const answer = await fetch('/wire/read');
      if (answer.status !== 200) return this.robot.gatt.disconnect();
      const bytes = await answer.arrayBuffer();
      for (let i = 0; i < bytes.byteLength; i += 20) {
        this.value = new DataView(bytes.slice(i, i + 20));
        this.dispatchEvent(new Event('characteristicvaluechanged'));
      }
    } })();
  }
}
const robot = name => {
  const known = {}, made = Object.assign(new EventTarget(), { name, id: name, greeted: false, gatt: {
    connected: false,
    async connect() {
      if (window.out_of_reach === name) throw new DOMException('Connection attempt failed.', 'NetworkError');
      this.connected = true;
      return { getPrimaryService: async service => ({ getCharacteristic: async name => known[name] ??= new Characteristic(made, service, name) }) };
    },
    disconnect() { if (this.connected) { this.connected = false; made.dispatchEvent(new Event('gattserverdisconnected')); } },
  } });
  return made;
};
const device = robot('BB-1234');
Object.defineProperty(navigator, 'bluetooth', { value: { requestDevice: async () => device } });
"""


picture_folder = os.environ.get("ORB_PICTURES")


def open_flash(page):
    """Opens the dialog, which is loaded on demand."""
    page.evaluate(click("flash"))
    page.wait(f"{by_id('flash-dialog')}.open")


class Playground(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = site_server.Site(folder)
        cls.browser = chromium.Browser(chromium.find())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.server.close()

    def open(self, where="", width=1280, height=860, mobile=False, server=None, before=""):
        """Opens the page as a first visitor sees it."""
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.resize(width, height, mobile)
        page.call("Page.addScriptToEvaluateOnNewDocument", source=note_violations + before)
        page.go((server or self.server).url + where)
        page.wait(ready)
        own = (server or self.server).url
        self.addCleanup(lambda: self.assertEqual(page.complaints, []))
        self.addCleanup(lambda: self.assertIsNone(page.evaluate("window.violations")))
        self.addCleanup(lambda: self.assertEqual([url for url in page.requests if not url.startswith((own, "data:", f"blob:{own}"))], []))
        return page

    def type(self, page, words):
        """Replaces the text of the shown file by typing."""
        page.evaluate("document.querySelector('.cm-content').focus()")
        page.key("a", modifiers=2)
        page.call("Input.insertText", text=words)

    def instant(self, page):
        page.evaluate(click("instant"))
        page.wait(f"{played} && {idle}", 60)

    # -- nothing is lost --
    def documents(self, page):
        page.evaluate(click("mine"))
        page.wait(f"{by_id('mine-dialog')}.open")
        return page.evaluate("[...document.querySelectorAll('#mine-list [data-document]')].map(item => item.dataset.document)")

    def test_a_lesson_is_as_it_was_left(self):
        page = self.open("#lesson=lessons/01-traffic-light")
        self.type(page, "' mine\nRGB blue\ndelay 1s\n")
        page.evaluate(click("lesson-next"))
        page.wait(f"{by_id('task-title')}.textContent.includes('One metre')")
        page.evaluate(click("lesson-before"))
        page.wait(f"({text}).includes('mine')")
        page.evaluate("location.hash = '#lesson=lessons/01-traffic-light'")
        page.wait("location.hash === ''")
        page.evaluate(wait(200))
        self.assertIn("mine", page.evaluate(text))
        page.evaluate("[...document.querySelectorAll('#came button')].find(one => one.textContent === 'Start over').click()")
        page.wait(f"({text}).includes('delay 2s') || !({text}).includes('mine')")

    def test_back_is_there_after_the_page_is_loaded_again(self):
        page = self.open(fragment({"a.bas": '10 print "first"\n'}))
        page.evaluate("location.hash = '#example=square.macro'")
        page.wait(f"({text}).includes('square') || {by_id('came')}.textContent.includes('Square')")
        page.evaluate("location.hash = '#lesson=lessons/02-one-metre'")
        page.wait(f"{by_id('task-title')}.textContent.includes('One metre')")
        page.evaluate(wait(600))
        page.go("about:blank")
        page.go(self.server.url)
        page.wait(ready)
        page.wait(f"!{by_id('came')}.hidden")
        page.evaluate("[...document.querySelectorAll('#came button')].find(one => one.textContent.startsWith('Back')).click()")
        page.wait(f"{by_id('what')}.textContent.includes('square.macro')")
        ids = self.documents(page)
        self.assertIn("lessons/02-one-metre", ids)
        self.assertIn("square.macro", ids)
        self.assertEqual(len([one for one in ids if one.startswith("own:")]), 1)
        page.evaluate("document.querySelector('#mine-list [data-document^=own] button').click()")
        page.wait(f"({text}).includes('first')")

    def test_earlier_states_of_a_program_come_back(self):
        page = self.open(fragment({"a.bas": '10 print "one"\n'}))
        for word in ("two", "three"):
            self.instant(page)
            self.type(page, f'10 print "{word}"\n')
            page.evaluate(wait(500))
        self.instant(page)
        self.documents(page)
        page.evaluate("document.querySelector('#mine-list details').open = true")
        page.wait("document.querySelectorAll('#mine-list ol button').length >= 3")
        labels = page.evaluate("[...document.querySelectorAll('#mine-list ol button')].map(one => one.textContent)")
        self.assertEqual(len(set(labels)), len(labels), labels)
        page.evaluate("[...document.querySelectorAll('#mine-list ol button')].pop().click()")
        page.wait(f"({text}).includes('one')")

    def test_at_most_fifty_states_are_kept(self):
        page = self.open(fragment({"a.bas": "10 end\n"}))
        page.wait(coloured)
        for number in range(53):
            page.evaluate(f"document.querySelector('.cm-content').focus(); document.execCommand('selectAll'); document.execCommand('insertText', false, '10 print {number}')")
            page.evaluate(click("mine"))
            page.wait(f"{by_id('mine-dialog')}.open")
            page.evaluate(f"{by_id('mine-dialog')}.close()")
        self.documents(page)
        page.evaluate("document.querySelector('#mine-list details').open = true")
        page.wait("document.querySelectorAll('#mine-list ol button').length > 40")
        self.assertEqual(page.evaluate("document.querySelectorAll('#mine-list ol button').length"), 50)

    def test_a_browser_that_keeps_nothing_says_so(self):
        blocked = "Object.defineProperty(window, 'indexedDB', { get() { throw new DOMException('denied', 'SecurityError'); } });"
        page = self.open(fragment({"a.bas": "10 end\n"}), before=blocked)
        self.type(page, "10 print 1\n")
        page.wait(f"!{by_id('storage')}.hidden && {by_id('storage')}.textContent.includes('stores nothing')")
        full = "IDBObjectStore.prototype.put = () => { throw new DOMException('full', 'QuotaExceededError'); };"
        page = self.open(fragment({"a.bas": "10 end\n"}), before=full)
        self.type(page, "10 print 1\n")
        page.wait(f"!{by_id('storage')}.hidden && {by_id('storage')}.textContent.includes('no space left')")

    # -- an engine that does not answer --
    def test_an_engine_that_is_missing_is_named_and_tried_again(self):
        for missing in ("orb.wasm", "worker.js"):
            server = site_server.Site(folder, without={missing})
            page = self.browser.page(fresh=True)
            self.addCleanup(page.close)
            page.go(server.url + fragment({"a.bas": "10 rgb 1\n"}))
            page.wait(f"!{by_id('engine')}.hidden", 30)
            self.assertIn("is not running", page.evaluate(f"{by_id('engine')}.textContent"), missing)
            self.assertEqual(page.evaluate(f"{by_id('count')}.textContent"), "not checked")
            page.evaluate(click("run"))
            page.wait(f"{idle} && {by_id('outcome')}.classList.contains('bad')")
            server.without.clear()
            page.evaluate(click("engine-again"))
            page.wait(f"{by_id('engine')}.hidden && {by_id('count')}.textContent === '1 error'", 30)
            server.close()

    # -- what a live run says --
    def test_a_fault_is_told_while_the_ball_still_drives(self):
        page = self.open(fragment({"a.bas": "10 goroll 0,60,1\n20 delay 200\n30 A = 1 / B\n"}))
        page.evaluate(click("run"))
        page.wait(f"{by_id('outcome')}.classList.contains('bad')", 10)
        self.assertFalse(page.evaluate(idle))  # it drives on
        self.assertIn("line 3", page.evaluate(outcome))
        page.evaluate(stop)
        page.wait(idle)
        self.assertIn("line 3", page.evaluate(outcome))
        self.assertNotIn("0.000 s", page.evaluate(outcome))

    def test_a_program_that_leaves_the_ball_driving_ends(self):
        page = self.open(fragment({"a.bas": "10 goroll 0,60,1\n20 delay 500\n"}))
        page.evaluate(click("run"))
        page.wait(f"{outcome}.includes('is still rolling')", 10)
        page.wait(idle, 20)
        self.assertIn("ended after 0.5", page.evaluate(outcome))
        self.assertIn("still driving", page.evaluate(outcome))
        page.evaluate(click("run"))
        page.wait(f"{outcome}.includes('is still rolling')", 10)
        page.evaluate(stop)
        page.wait(idle, 10)
        self.assertIn("ended after 0.5", page.evaluate(outcome))

    def test_a_lesson_brings_its_world(self):
        page = self.open("#lesson=lessons/08-the-wall")
        self.type(page, "goroll 0, 120, 1\ndelay 4s\ngoroll 0, 0, 0\n")
        page.evaluate(click("run"))
        page.wait("document.querySelector('#map .wall') !== null", 10)
        page.wait("document.querySelector('#map [data-mark=bump]') !== null", 15)
        page.evaluate(stop)
        page.wait(idle)

    def test_who_shakes_it_is_not_told_that_nobody_does(self):
        page = self.open("#lesson=lessons/07-shake-me")
        page.evaluate("document.querySelector('#scripts input').click()")  # nobody but the person
        self.type(page, "while not dshake\n  delay 50ms\nend while\nprint \"hello\"\n")
        page.evaluate(click("run"))
        page.wait(played, 10)
        page.evaluate("document.querySelector('[data-line=shake]').click()")
        page.wait(f"{events}.includes('hello')", 10)
        page.wait(idle, 10)
        self.assertNotIn("nobody", page.evaluate(outcome))

    def test_a_task_speaks_of_the_page(self):
        self.assertEqual(len(lessons()), 10)
        for lesson in lessons():
            for words in ("orb run", "orb test", "orb new", "--", "page:", "A page opens"):
                self.assertNotIn(words, lesson["readme"])

    def test_the_first_program_is_three_steps(self):
        page = self.open()
        page.wait(coloured)
        done = "document.querySelectorAll('#task-text .done').length"
        self.assertEqual(page.evaluate(done), 0)
        page.evaluate(click("run"))
        page.wait(f"{done} === 1")
        page.wait("document.querySelectorAll('#map .run').length > 0", 10)
        page.evaluate(stop)
        page.wait(idle)
        page.evaluate("document.querySelector('[data-view=work]').click()")
        self.type(page, page.evaluate(text).replace("corners = 4", "corners = 3"))
        page.wait(f"{done} === 2")
        self.instant(page)
        page.wait(f"{done} === 3")
        self.assertIn("3 corners", " ".join(page.evaluate(events)))
        page.evaluate(click("first-lesson"))
        page.wait(f"{by_id('task-title')}.textContent.includes('Traffic light')")

    def test_a_newcomer_sees_it_move_within_ten_seconds(self):
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.go(self.server.url)
        page.wait("document.readyState === 'complete'")
        page.evaluate(click("run"))  # at once, whether or not the engine is there
        page.wait("document.querySelectorAll('#map .run').length > 0", 30)
        took = page.evaluate("performance.now() - performance.getEntriesByName('first-contentful-paint')[0].startTime")
        print(f"it moves {took / 1000:.1f} s after the first paint")
        self.assertLess(took, 10_000)
        page.evaluate(stop)
        page.wait(idle)

    # -- a run of ten minutes --
    def test_ten_minutes_are_shown_in_short_tasks(self):
        program = "10 for A = 0 to 20000\n20 goroll A * 40 % 360, 90, 1\n30 RGB A % 200 + 20, 90, 200\n40 print A\n50 delay 400\n60 next A\n"
        # Nine minutes pass quickly, the tenth as it is.
        fast = """const post = Worker.prototype.postMessage;
          Worker.prototype.postMessage = function (message, ...more) {
            if (message.method === 'start') { message.params = { ...message.params, speed: 60 }; window.slower = () => post.call(this, { id: 1e9, method: 'speed', params: { factor: 1 } }); }
            return post.call(this, message, ...more);
          };"""
        page = self.open(fragment({"a.bas": program}), before=fast)
        page.evaluate(click("run"))
        page.wait(f"Number({by_id('time')}.max) > 540e6", 120)
        page.evaluate("window.slower()")
        page.evaluate(wait(1500))
        self.assertGreater(page.evaluate("document.querySelectorAll('#events li').length"), 400)
        nodes = "document.getElementsByTagName('*').length"
        live = page.evaluate(nodes)
        print(f"elements of the page in the tenth minute: {live}")
        tasks = self.browser.longest_tasks(6)
        print(f"longest tasks in the tenth minute: {', '.join(f'{task:.0f}' for task in tasks[:5])} ms of processor time")
        self.assertGreater(len(tasks), 100)
        self.assertLessEqual(tasks[0], 25)  # 100 ms at a quarter of the processor
        page.evaluate(stop)
        page.wait(idle)
        page.wait(f"{outcome}.includes('stopped after')")
        page.evaluate(wait(1000))
        after = page.evaluate(nodes)
        print(f"elements of the page after it: {after}")
        self.assertLessEqual(max(live, after), 8000)

    # -- keyboard and screen readers --
    def test_the_focus_stays_on_run_and_test(self):
        page = self.open(fragment({"a.bas": '10 print "said"\n20 delay 300\n', "a.test": 'test "t"\n  expect print "said"\n'}))
        for name in ("run", "test"):
            page.evaluate(f"{by_id(name)}.focus()")
            page.key("Enter")
            page.evaluate(click(name))
            page.evaluate(wait(900))
            page.wait(idle)
            self.assertEqual(page.evaluate("document.activeElement.id"), name)
        self.assertIn("said", page.evaluate(f"{by_id('announce')}.textContent"))

    def test_limits_are_told_as_they_are(self):
        page = self.open(fragment({"a.bas": "10 end\n"}))
        page.evaluate("""(() => { const data = new DataTransfer();
          for (let i = 0; i < 30; ++i) data.items.add(new File(['10 end'], `p${i}.bas`));
          data.items.add(new File(['x'.repeat(300000)], 'long.bas'));
          document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true })); })()""")
        page.wait(f"{by_id('status')}.textContent.includes('at most 24 files')")
        self.assertEqual(page.evaluate("document.querySelectorAll('[role=tab]').length"), 24)

    def test_a_browser_that_cannot_pack_says_so(self):
        page = self.open(fragment({"a.bas": "10 end\n"}), before="delete window.CompressionStream; delete window.DecompressionStream;")
        page.wait(f"{by_id('status')}.textContent.includes('before 2023')")
        page.evaluate(click("share"))
        page.wait(f"{by_id('status')}.textContent.includes('too old to put')")

    def test_a_new_file_says_what_it_is_for(self):
        page = self.open(fragment({"a.bas": "10 end\n"}))
        for name, words in (("b.orb", "a separate structured program"), ("a.test", "it tests a.bas"), ("c.svg", "under More")):
            page.evaluate(click("new-file"))
            page.evaluate(f"{by_id('name')}.value = '{name}'; document.querySelector('#name-form [value=ok]').click()")
            page.wait(f"{by_id('status')}.textContent.includes('{words}')")

    # -- phones and paper --
    def test_run_and_test_are_in_reach_on_a_phone(self):
        page = self.open("#lesson=lessons/01-traffic-light", 390, 844, mobile=True)
        page.wait(f"!{by_id('task')}.hidden")
        for view in ("work", "play"):
            page.evaluate(f"document.querySelector('[data-view={view}]').click()")
            for name in ("run", "test"):
                box = page.evaluate(f"(({{top, bottom, height}}) => [top, bottom, height])({by_id(name)}.getBoundingClientRect())")
                self.assertGreater(box[0], 0, (view, name))
                self.assertLessEqual(box[1], 844, (view, name))
                self.assertGreaterEqual(box[2], 40)

    def test_a_lesson_begins_without_the_run_before(self):
        page = self.open(fragment({"a.bas": '10 print "old"\n20 goroll 0,90,1\n30 delay 500\n40 goroll 0,0,0\n'}))
        self.instant(page)
        page.evaluate("location.hash = '#lesson=lessons/03-square'")
        page.wait(f"{by_id('task-title')}.textContent.includes('Square')")
        self.assertFalse(page.evaluate(played))
        self.assertEqual(page.evaluate(outcome), "")
        self.assertIsNotNone(page.evaluate("document.querySelector('#map #ball')"))  # it rests in the middle

    def test_a_sheet_is_printed(self):
        page = self.open("#lesson=lessons/03-square")
        page.wait(f"{by_id('task-job')}.textContent.includes('Your job')")
        page.evaluate(click("solution"))
        self.instant(page)
        page.evaluate("dispatchEvent(new Event('beforeprint'))")
        page.call("Emulation.setEmulatedMedia", media="print")
        shown = lambda where: page.evaluate(f"(one => !!one && one.getClientRects().length > 0)(document.querySelector('{where}'))")
        for where in (".sheet-head", "#task-text", "#sheet-program", "#map"):
            self.assertTrue(shown(where), where)
        for where in ("#run", "#pick", "#editor", ".transport"):
            self.assertFalse(shown(where), where)
        self.assertIn("repeat 4", page.evaluate(f"{by_id('sheet-program')}.textContent"))
        self.assertGreater(page.evaluate("document.querySelectorAll('#map .ahead .run').length"), 0)
        paper = base64.b64decode(page.call("Page.printToPDF", printBackground=True, preferCSSPageSize=False, paperWidth=8.27, paperHeight=11.69)["data"])
        self.assertEqual(len(re.findall(rb"/Type\s*/Page\b", paper)), 1)
        if picture_folder:
            with open(os.path.join(picture_folder, "sheet.pdf"), "wb") as file:
                file.write(paper)

    # -- the library, sharing --
    def test_cards_show_a_path_and_no_program_twice(self):
        page = self.open()
        page.evaluate(click("pick"))
        page.wait("document.querySelectorAll('.cards > li').length > 20")
        names = page.evaluate("[...document.querySelectorAll('.cards > li')].map(card => card.firstChild.dataset.id)")
        stems = [name.rsplit(".", 1)[0] for name in names if "/" not in name]
        self.assertEqual(len(stems), len(set(stems)))
        self.assertIn("flower.orb", names)
        self.assertNotIn("flower.bas", names)
        self.assertIsNotNone(page.evaluate("document.querySelector('[data-id=\"flower.bas\"]')"))
        self.assertGreater(page.evaluate("document.querySelectorAll('.cards .drawn path').length"), 20)

    def test_a_shared_program_has_a_code(self):
        page = self.open(fragment({"a.bas": "10 end\n"}))
        page.evaluate(click("share"))
        page.wait("document.querySelector('#share-code svg') !== null")
        self.assertGreater(page.evaluate("document.querySelector('#share-code path').getAttribute('d').length"), 200)

    def test_it_can_be_installed(self):
        page = self.open()
        manifest = page.call("Page.getAppManifest")
        self.assertEqual(manifest["errors"], [])
        self.assertIn('"standalone"', manifest["data"])
        for icon in json.loads(manifest["data"])["icons"]:
            page.evaluate(f"window.drawn = new Image(); drawn.src = '{icon['src']}'")
            page.wait("drawn.complete")
            width = page.evaluate("drawn.naturalWidth")
            self.assertTrue(width > 0 if icon["sizes"] == "any" else f"{width}x{width}" == icon["sizes"], icon)
        page.wait("navigator.serviceWorker.controller !== null", 30)
        wanted = [one["errorId"] for one in page.call("Page.getInstallabilityErrors")["installabilityErrors"]]
        self.assertEqual([one for one in wanted if one != "in-incognito"], [])

    # -- writing --
    def test_a_mistake_is_underlined_and_fixed(self):
        page = self.open(fragment({"a.bas": "10 rgb 255,0,0\n20 delay 100\n"}))
        page.wait("document.querySelector('.cm-lintRange-error')?.textContent === 'rgb'")
        self.assertEqual(page.evaluate(findings), ["unknown-statement"])
        page.wait("document.querySelector('#findings .fix') !== null")
        page.evaluate("document.querySelector('#findings .fix').click()")
        page.wait(f"({text}).startsWith('10 RGB 255')")
        page.wait("document.querySelectorAll('#findings li').length === 0")
        self.assertIsNone(page.evaluate("document.querySelector('.cm-lintRange-error')"))

    def test_a_mistake_is_fixed_by_a_key(self):
        page = self.open(fragment({"a.bas": "10 rgb 255,0,0\n20 delay 100\n"}))
        page.wait("document.querySelector('#findings .fix') !== null")
        page.evaluate("document.querySelector('.cm-content').focus()")
        page.key(".", modifiers=2)
        page.wait(f"({text}).startsWith('10 RGB 255')")

    def test_words_are_coloured_completed_and_explained(self):
        page = self.open(fragment({"a.bas": "10 goroll 0,0,0\n20 go"}))
        page.wait("document.querySelector('.tok-robots')?.textContent === 'goroll'")
        page.evaluate("document.querySelector('.cm-content').focus()")
        page.key("End", modifiers=2)
        page.key("r")
        page.wait("[...document.querySelectorAll('.cm-tooltip-autocomplete li')].some(item => item.textContent.includes('goroll'))")
        page.key("Escape")
        box = page.evaluate("(({x, y, width, height}) => [x + width / 2, y + height / 2])(document.querySelector('.tok-robots').getBoundingClientRect())")
        page.call("Input.dispatchMouseEvent", type="mouseMoved", x=box[0], y=box[1])
        page.wait("document.querySelector('.cm-tooltip-hover')?.textContent.includes('brakes')")

    def test_formats(self):
        page = self.open(fragment({"a.orb": "for i = 1 to 3\nprint i\nnext i\n"}))
        page.wait(coloured)
        page.evaluate(click("format"))
        page.wait(f"({text}).includes('\\n  print i')")

    def test_findings_come_at_once(self):
        page = self.open(fragment({"a.bas": "10 RGB 255,0,0\n" * 1}))
        page.wait(coloured)
        page.evaluate("document.querySelector('.cm-content').focus()")
        page.key("End", modifiers=2)
        took = page.evaluate("""new Promise(done => {
          const began = performance.now(), list = document.getElementById('findings');
          const watch = new MutationObserver(() => { if (list.querySelector('li')) { watch.disconnect(); done(performance.now() - began); } });
          watch.observe(list, { childList: true });
          document.execCommand('insertText', false, '20 rgb 1');
        })""")
        print(f"findings after {took:.1f} ms")
        self.assertLess(took, 200)  # what is wanted is in docs/inside/performance.md; this machine may be busy

    def test_a_huge_paste_is_left_out(self):
        page = self.open(fragment({"a.bas": "10 print 1\n"}))
        page.wait(coloured)
        page.evaluate("""document.querySelector('.cm-content').focus();
          const data = new DataTransfer(); data.setData('text/plain', '20 print 2\\n'.repeat(200000));
          document.querySelector('.cm-content').dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, bubbles: true, cancelable: true }))""")
        page.wait(f"{by_id('status')}.textContent.includes('262,144 characters')")
        self.assertEqual(page.evaluate(text).strip(), "10 print 1")
        self.type(page, "10 print 3\n")
        page.wait(f"({text}).includes('print 3')")

    def test_a_long_program_is_edited_fluently(self):
        page = self.open(fragment({"a.orb": "print 1\n" * 20000}))
        page.evaluate("document.querySelector('.cm-content').focus()")
        took = page.evaluate("""(() => { const began = performance.now();
          for (let i = 0; i < 20; ++i) document.execCommand('insertText', false, 'x'); return performance.now() - began; })()""")
        self.assertLess(took, 2000)

    # -- running --
    def test_a_run_shows_prints_and_path(self):
        page = self.open(fragment({"a.bas": '10 RGB 255,0,0\n20 goroll 90,100,1\n30 delay 1000\n40 goroll 0,0,0\n50 print "there"\n'}))
        self.instant(page)
        page.wait(f"{events}.includes('there')")
        page.wait("document.querySelector('#map .run[stroke=\"#ff0000\"]') !== null")
        self.assertIn("ended after", page.evaluate(outcome))
        page.wait("document.querySelector('.cm-line.running') !== null")

    def test_the_ball_says_what_is_printed(self):
        bubble = "document.querySelector('.bubble')"
        says = f"{bubble}.hidden ? '' : {bubble}.textContent"
        page = self.open(fragment({"a.bas": '10 print "hello"\n20 goroll 90,100,1\n30 delay 4000\n40 goroll 0,0,0\n50 print "<b>there</b>"\n'}))
        self.assertIn("Press Run", page.evaluate(says))
        self.instant(page)
        page.evaluate(f"{by_id('time')}.value = {by_id('time')}.max; {by_id('time')}.dispatchEvent(new Event('input'))")
        self.assertEqual(page.evaluate(says), "<b>there</b>")
        over = page.evaluate(f"(one => {{ const ball = {by_id('ball')}.getBoundingClientRect(), box = one.getBoundingClientRect(); return [box.bottom - ball.top, box.left + box.width / 2 - ball.left - ball.width / 2]; }})({bubble}.firstChild)")
        self.assertLess(over[0], 40)
        self.assertLess(abs(over[1]), 80)
        for at, words in ((1, "hello"), (3.5, "")):
            page.evaluate(f"{by_id('time')}.value = {at * 1e6}; {by_id('time')}.dispatchEvent(new Event('input'))")
            self.assertEqual(page.evaluate(says), words)

    def test_a_run_is_shown_while_it_goes_on(self):
        page = self.open(fragment({"a.bas": '10 goroll 0,60,1\n20 print "tick"\n30 delay 200\n40 goto 20\n'}))
        page.evaluate(click("run"))
        page.wait(f"{events}.filter(words => words === 'tick').length > 2", 30)
        self.assertFalse(page.evaluate(idle))
        y = "Number(document.querySelector('[data-now=position]').textContent.split(', ')[1].split(' ')[0])"
        first = page.evaluate(y)
        page.wait(f"{y} > {first} + 5")
        page.evaluate(stop)
        page.wait(idle)
        self.assertGreater(page.evaluate(f"{by_id('map')}.querySelectorAll('.run').length"), 0)

    def test_somebody_shakes_it_and_answers_while_it_runs(self):
        page = self.open(fragment({"a.bas": '10 if dshake = 0 then goto 10\n20 print "shaken"\n30 input A\n40 print "got " A\n'}))
        page.evaluate(click("run"))
        page.wait(f"!{by_id('hands')}.hidden")
        page.wait(played, 30)
        page.evaluate("document.querySelector('[data-line=shake]').click()")
        page.wait(f"{events}.includes('shaken')", 30)
        page.wait(f"{by_id('number-form')}.classList.contains('wanted')", 30)
        page.evaluate(f"{by_id('number')}.value = '42'; {by_id('number-form')}.requestSubmit()")
        page.wait(idle, 30)
        page.wait(f"{events}.includes('got 42')")

    def test_an_endless_program_stops_at_once_and_the_text_stays(self):
        page = self.open(fragment({"a.bas": "10 goto 10\n"}, run={"for": "9999min"}))
        self.type(page, "10 A = A + 1\n20 goto 10\n")
        for how in ("run", "instant"):
            page.evaluate(click(how))
            page.wait(f"!{idle}")
            page.evaluate("new Promise(done => setTimeout(done, 500))")
            page.evaluate(stop)
            page.wait(idle, 3)
            self.assertIn("10 A = A + 1", page.evaluate(text))
        self.type(page, '10 print "again"\n')
        page.evaluate(click("instant"))
        page.wait(f"{events}.includes('again')")

    def test_a_program_with_mistakes_says_so(self):
        page = self.open(fragment({"a.bas": "10 rgb 1\n"}))
        page.evaluate(click("instant"))
        page.wait(f"{by_id('outcome')}.classList.contains('bad')")
        self.assertIn("RGB", page.evaluate(outcome))
        page.wait(idle)

    def test_a_course_is_drawn(self):
        page = self.open("#example=hall.orb")
        self.instant(page)
        page.wait("document.querySelectorAll('#map .wall').length > 0 && document.querySelector('#map [data-zone=goal]') !== null")

    def test_the_numbers_do_not_lie_over_what_is_drawn(self):
        for where, width in (("#example=hall.orb", 1366), ("#example=star.orb", 390)):
            page = self.open(where, width, 768, mobile=width < 500)
            self.instant(page)
            edges = page.evaluate("""[document.querySelector('.stage-head').getBoundingClientRect().bottom,
              Math.min(...[...document.querySelectorAll('#map .run, #map .wall')].map(one => one.getBoundingClientRect().top))]""")
            self.assertLessEqual(edges[0], edges[1], where)

    # -- testing --
    def test_a_test_fails_and_then_passes(self):
        page = self.open(fragment({"a.bas": '10 print "no"\n', "a.test": 'test "says yes"\n  expect print "yes"\n'}))
        page.evaluate(click("test"))
        page.wait("document.querySelector('#verdict-list [data-verdict=failed]') !== null", 30)
        self.assertIn("0 of 1 tests passed", page.evaluate(f"{by_id('verdicts-title')}.textContent"))
        page.evaluate("[...document.querySelectorAll('#verdict-list button')].find(one => one.textContent === 'Watch').click()")
        page.wait(f"{played} && {events}.includes('no')", 30)
        page.wait(idle)
        self.type(page, '10 print "yes"\n')
        page.evaluate(click("test"))
        page.wait("document.querySelector('#verdict-list [data-verdict=passed]') !== null", 30)
        self.assertTrue(page.evaluate(f"{by_id('verdicts')}.classList.contains('all-passed')"))

    def test_a_lesson_is_done(self):
        page = self.open("#lesson=lessons/01-traffic-light")
        page.wait(f"!{by_id('task')}.hidden && {by_id('task-job')}.textContent.includes('Your job')")
        page.evaluate(click("test"))
        page.wait("document.querySelector('#verdict-list [data-verdict=failed]') !== null", 30)
        page.wait(idle)
        page.evaluate(click("solution"))
        page.evaluate(click("test"))
        page.wait(f"{by_id('verdicts')}.classList.contains('all-passed')", 30)
        page.evaluate(click("lesson-next"))
        page.wait(f"{by_id('task-title')}.textContent.includes('One metre')")
        page.evaluate(click("pick"))
        page.wait("document.querySelector('[data-id=\"lessons/01-traffic-light\"] .done') !== null")

    # -- a class --
    lesson_files = {"robot.orb": 'print "?"\n', "robot.test": 'test "says hello"\n  expect print "hello"\n'}

    def write_lesson(self, page, title, task):
        page.evaluate(click("share"))
        page.wait(f"{by_id('share-dialog')}.open")
        page.evaluate(click("share-lesson"))
        page.wait(f"{by_id('lesson-dialog')}.open && {by_id('lesson-parts')}.textContent.includes('passes 0 of 1')", 20)
        page.evaluate(f"{by_id('lesson-title')}.value = {json.dumps(title)}; {by_id('lesson-text')}.value = {json.dumps(task)}")
        page.evaluate(click("lesson-share"))
        page.wait(f"{by_id('share-dialog')}.open")
        self.assertIsNotNone(page.evaluate("document.querySelector('#share-code svg')"))
        return page.evaluate(f"{by_id('share-link')}.value").removeprefix(self.server.url)

    def test_a_lesson_is_written_opened_and_handed_in(self):
        teacher = self.open(fragment(self.lesson_files))
        lesson = self.write_lesson(teacher, "Hello", "Say **hello**.\n\n- once")
        pupil = self.open(lesson)
        pupil.wait(f"!{by_id('task')}.hidden && {by_id('task-title')}.textContent === 'Hello'")
        self.assertEqual(pupil.evaluate("document.querySelector('#task-text strong').textContent"), "hello")
        self.assertEqual(pupil.evaluate(f"{by_id('test')}.textContent"), "Am I done?")
        self.assertTrue(pupil.evaluate(f"{by_id('task-edit')}.hidden"))
        self.type(pupil, 'print "hello"\n')
        pupil.evaluate(click("test"))
        pupil.wait(f"!{by_id('cheer')}.hidden && !{by_id('cheer-hand-in')}.hidden", 30)
        pupil.evaluate(click("cheer-hand-in"))
        pupil.wait(f"{by_id('hand-in-dialog')}.open")
        self.assertTrue(pupil.evaluate(f"{by_id('hand-in-save')}.disabled"))
        pupil.evaluate(f"{by_id('pupil')}.value = 'Anna B.'; {by_id('pupil')}.dispatchEvent(new Event('input'))")
        pupil.wait(f"{by_id('hand-in-link')}.value !== '' && !{by_id('hand-in-save')}.disabled")
        pupil.evaluate(wait(200))
        handed_in = pupil.evaluate(f"{by_id('hand-in-link')}.value")
        pupil.evaluate(f"{by_id('hand-in-dialog')}.close()")
        # The lesson's address again: nothing is lost.
        pupil.evaluate(f"location.hash = {json.dumps(lesson)}")
        pupil.wait("location.hash === ''")
        pupil.evaluate(wait(300))
        self.assertIn("hello", pupil.evaluate(text))
        self.assertIn("as you left it", pupil.evaluate(f"{by_id('came')}.textContent"))
        # The teacher looks at it.
        self.type(teacher, 'print "mine"\n')
        teacher.evaluate("document.querySelectorAll('dialog[open]').forEach(one => one.close())")
        teacher.evaluate(f"location.hash = {json.dumps(handed_in.removeprefix(self.server.url))}")
        teacher.wait(f"{by_id('came')}.textContent.includes('Anna B.')")
        self.assertIn("hello", teacher.evaluate(text))

    def escape(self, page):
        for kind in ("rawKeyDown", "keyUp"):
            page.call("Input.dispatchKeyEvent", type=kind, key="Escape", code="Escape", windowsVirtualKeyCode=27)

    def test_a_lesson_opens_with_its_program(self):
        teacher = self.open(fragment(self.lesson_files, active="robot.test"))
        teacher.wait(f"{by_id('what')}.textContent.includes('robot.test')")
        pupil = self.open(self.write_lesson(teacher, "Hello", "Say **hello**."))
        pupil.wait(f"{by_id('what')}.textContent.includes('robot.orb')")

    def test_a_lesson_that_is_closed_is_a_draft(self):
        page = self.open(fragment(self.lesson_files))
        fields = f"[{by_id('lesson-title')}.value, {by_id('lesson-text')}.value]"
        for leave in (lambda: self.escape(page), lambda: page.evaluate("[...document.querySelectorAll('#lesson-form button')].find(one => one.textContent === 'Close').click()")):
            page.evaluate(click("lesson-write"))
            page.wait(f"{by_id('lesson-dialog')}.open")
            page.evaluate(f"{by_id('lesson-title')}.value = 'Hello'; {by_id('lesson-text')}.value = 'Say hello.'")
            leave()
            page.wait(f"!{by_id('lesson-dialog')}.open")
            self.assertTrue(page.evaluate(f"{by_id('task')}.hidden"))
        page.evaluate(wait(600))
        page.call("Page.reload")
        page.wait(ready)
        page.evaluate(click("lesson-write"))
        page.wait(f"{by_id('lesson-dialog')}.open && !{by_id('lesson-draft')}.hidden")
        self.assertEqual(page.evaluate(fields), ["Hello", "Say hello."])
        page.evaluate(click("lesson-discard"))
        self.assertEqual(page.evaluate(fields), ["robot.orb", ""])

    def test_back_under_an_open_lesson_keeps_both(self):
        page = self.open(fragment(self.lesson_files))
        page.evaluate("location.hash = '#lesson=lessons/01-traffic-light'")
        page.wait(f"{by_id('task-title')}.textContent.includes('Traffic light')")
        page.evaluate(click("lesson-write"))
        page.wait(f"{by_id('lesson-dialog')}.open")
        page.evaluate(f"{by_id('lesson-text')}.value = 'Mine.'; {by_id('lesson-text')}.dispatchEvent(new Event('input'))")
        page.evaluate("history.back()")
        page.wait(f"({text}).includes('?') && !{by_id('lesson-dialog')}.open")
        self.assertTrue(page.evaluate(f"{by_id('task')}.hidden"))
        page.evaluate(click("lesson-write"))
        self.assertEqual(page.evaluate(f"{by_id('lesson-text')}.value"), "")
        self.escape(page)
        page.evaluate("history.forward()")
        page.wait(f"{by_id('task-title')}.textContent.includes('Traffic light')")
        page.evaluate(click("lesson-write"))
        self.assertEqual(page.evaluate(f"{by_id('lesson-text')}.value"), "Mine.")

    def test_the_test_of_a_lesson_is_written_beside_its_task(self):
        page = self.open(fragment({"robot.orb": 'print "?"\n'}))
        page.evaluate(click("lesson-write"))
        page.wait("document.getElementById('lesson-make-test') !== null")
        page.evaluate(click("lesson-make-test"))
        page.wait(f"!{by_id('lesson-test-label')}.hidden && {by_id('lesson-test')}.value.startsWith('test ')")
        put = lambda words: page.evaluate(f"{by_id('lesson-test')}.value = {json.dumps(words)}; {by_id('lesson-test')}.dispatchEvent(new Event('input'))")
        verdict = "document.getElementById('lesson-verdict')?.textContent"
        put('test "a"\n  expect print "!"\n')
        page.wait(f"{verdict} === 'The program passes 0 of 1.'", 20)
        put('test "a"\n  expects print "!"\n')
        page.wait(f"{verdict}?.includes('line 2: ')", 20)
        put('test "a"\n  expect print "?"\n')
        page.wait(f"{verdict}?.startsWith('The program already passes')", 20)
        self.escape(page)
        page.wait(f"!{by_id('lesson-dialog')}.open")
        page.wait("document.getElementById('tab-robot.test') !== null")
        page.evaluate(click("tab-robot.test"))
        page.wait(f"({text}).includes('print \"?\"')")

    def test_a_result_says_whose_it_is(self):
        page = self.open(fragment(self.lesson_files, name="Ben", task="# Hello"))
        page.wait(f"{by_id('task-title')}.textContent === 'Hello'")
        page.evaluate("[...document.querySelectorAll('#came button')].find(one => one.textContent === 'OK')?.click()")
        self.assertIn("Handed in by “Ben”.", page.evaluate(f"{by_id('came')}.textContent"))
        self.assertEqual(page.evaluate(f"[{by_id('task-edit')}.hidden, {by_id('hand-in')}.hidden, {by_id('share-lesson')}.hidden, {by_id('lesson-write')}.hidden, {by_id('came')}.hidden]"), [True, True, True, True, False])

    def test_a_verdict_belongs_to_a_text(self):
        page = self.open(fragment({"robot.orb": 'print "hello"\n', "robot.test": self.lesson_files["robot.test"]}))
        title = f"{by_id('verdicts-title')}.textContent"
        page.evaluate(click("test"))
        page.wait(f"{title} === '1 of 1 tests passed, 1 of 1 points'", 30)
        self.type(page, "")
        page.key("Delete")
        page.wait(f"{title} === 'Before your change: 1 of 1 tests passed, 1 of 1 points'")
        self.assertEqual(page.evaluate("getComputedStyle(document.querySelector('#cheer')).display"), "none")

    def test_a_program_with_mistakes_is_not_tested(self):
        files = {"robot.orb": "RGB rde\n", "robot.test": 'test "a"\n  expect print "1"\ntest "b"\n  expect print "2"\n'}
        page = self.open(fragment(files, active="robot.test"))
        page.evaluate(click("test"))
        page.wait(f"{outcome}.includes('It has errors')", 30)
        self.assertTrue(page.evaluate(f"{by_id('verdicts')}.hidden"))
        page.wait(f"{by_id('what')}.textContent.includes('robot.orb') && document.querySelectorAll('#findings .error').length === 1")

    def test_the_browsers_back_leads_back(self):
        page = self.open(fragment({"a.bas": '10 print "mine"\n'}))
        page.evaluate("location.hash = '#lesson=lessons/01-traffic-light'")
        page.wait(f"{by_id('task-title')}.textContent.includes('Traffic light')")
        page.evaluate(click("lesson-next"))
        page.wait(f"{by_id('task-title')}.textContent.includes('One metre')")
        page.evaluate("history.back()")
        page.wait(f"{by_id('task-title')}.textContent.includes('Traffic light')")
        page.evaluate("history.back()")
        page.wait(f"({text}).includes('mine')")
        page.evaluate("history.forward()")
        page.wait(f"{by_id('task-title')}.textContent.includes('Traffic light')")
        page.evaluate(click("lesson-write"))
        page.wait(f"{by_id('lesson-dialog')}.open")
        page.evaluate("document.querySelector('#lesson-form [value=try]').click()")
        page.wait("history.state.document.startsWith('own:')")

    def test_the_count_is_announced_when_the_typing_rests(self):
        page = self.open(fragment({"a.orb": "print 1\n"}))
        page.wait(coloured)
        page.evaluate(wait(4000))
        page.evaluate("""window.said = []; for (const one of document.querySelectorAll('[role=status], [aria-live]'))
          new MutationObserver(() => said.push(one.textContent)).observe(one, { childList: true, subtree: true, characterData: true })""")
        page.evaluate("document.querySelector('.cm-content').focus()")
        for letter in "dealy 1s":
            page.key(letter)
            page.evaluate(wait(120))
        page.wait("said.length > 0", 10)
        self.assertEqual(page.evaluate("said"), ["1 error"])

    def test_files_that_an_address_cannot_bring_are_counted(self):
        page = self.open(fragment({f"a{number}.bas": "10 end\n" for number in range(200)}))
        self.assertIn("176 of the 200 files", page.evaluate(f"{by_id('status')}.textContent"))

    def test_a_file_with_an_address_opens(self):
        page = self.open(fragment({"a.bas": "10 end\n"}))
        drop = lambda content: page.evaluate(f"""(() => {{ const data = new DataTransfer(); data.items.add(new File([{json.dumps(content)}], 'ben.link'));
          document.dispatchEvent(new DragEvent('drop', {{ dataTransfer: data, bubbles: true, cancelable: true }})); }})()""")
        drop("nothing\n")
        page.wait(f"{by_id('status')}.textContent.includes('contains no address')")
        drop(f"https://orb.example/{fragment(self.lesson_files, name='Ben', task='# Hello')}\n")
        page.wait(f"{by_id('came')}.textContent.includes('Ben')")
        page.wait(f"{by_id('task-title')}.textContent === 'Hello'")

    def test_a_lesson_of_ones_own_leaves_the_lesson_that_it_was_made_of(self):
        page = self.open("#lesson=lessons/01-traffic-light")
        page.wait(f"!{by_id('task')}.hidden")
        page.evaluate(click("share"))
        page.wait(f"{by_id('share-dialog')}.open")
        page.evaluate(click("share-lesson"))
        page.wait(f"{by_id('lesson-dialog')}.open")
        page.evaluate(f"{by_id('lesson-title')}.value = 'My lights'; document.querySelector('#lesson-form [value=try]').click()")
        page.wait(f"{by_id('task-title')}.textContent === 'My lights'")
        self.assertFalse(page.evaluate(f"{by_id('task-edit')}.hidden"))
        self.type(page, "' changed\n")
        page.evaluate(wait(600))
        page.evaluate("location.hash = '#lesson=lessons/01-traffic-light'")
        page.wait(f"{by_id('task-title')}.textContent.includes('Traffic light')")
        self.assertNotIn("changed", page.evaluate(text))

    # -- keeping and sharing --
    def test_sharing_brings_the_same_files(self):
        files = {"ü.bas": "x", "a.orb": 'print "grüße 👋"\n', "b.test": "# a test\n"}
        page = self.open(fragment(files))
        page.evaluate(click("share"))
        page.wait(f"{by_id('share-dialog')}.open")
        link = page.evaluate(f"{by_id('share-link')}.value")
        other = self.open(link.removeprefix(self.server.url))
        tabs = other.evaluate("[...document.querySelectorAll('[role=tab]')].map(tab => tab.textContent)")
        self.assertEqual(tabs, ["a.orb", "b.test"])  # the other is no name for a file
        self.assertIn("grüße 👋", other.evaluate(text))
        self.assertNotIn("#", other.evaluate("location.href"))

    def test_what_was_written_is_there_again(self):
        page = self.open(fragment({"a.bas": "10 print 1\n"}))
        self.type(page, '10 print "kept"\n')
        page.go("about:blank")
        page.go(self.server.url)
        page.wait(ready)
        self.assertIn("kept", page.evaluate(text))
        page.go(self.server.url + fragment({"b.bas": "10 print 2\n"}))
        page.wait(f"!{by_id('came')}.hidden")
        page.evaluate("document.querySelector('#came button').click()")
        page.wait(f"({text}).includes('kept')")

    def test_a_first_visit_weighs_at_most_600_kb(self):
        at_once, later = (weight.weights(folder, names) for names in ("core", "on_demand"))
        blocks = sum(size for name, size in later.items() if name.startswith(("view-", "en-")))  # in one language
        # Opening a lesson and asking for its verdict.
        opened = max(size for name, size in later.items() if name.startswith("examples/lessons/"))
        opened += sum(size for name, size in later.items() if name.startswith("verdicts-"))
        print(f"a first visit loads {sum(at_once.values())} bytes and up to {opened} for a lesson, blocks {blocks} more, all on demand {sum(later.values())}")
        self.assertLessEqual(sum(at_once.values()), 600_000)
        self.assertLessEqual(opened, 6_000)
        self.assertGreater(blocks, 100_000)
        self.assertLessEqual(blocks, 200_000)

    def test_a_first_visit_loads_what_is_counted(self):
        server = site_server.Site(folder)
        self.addCleanup(server.close)
        # Of what is kept when the page rests nothing comes here.
        page = self.open(server=server, before="Object.defineProperty(navigator, 'connection', { value: { saveData: true } });")
        page.wait("navigator.serviceWorker.controller !== null", 30)
        page.evaluate(click("run"))  # the actions of a new visitor
        page.wait(f"{by_id('hands')}.hidden === false")
        page.evaluate(stop)
        page.wait(idle)
        self.type(page, "goroll 0, 300, 1\nprint x\nfor i = 1 to 3\n")
        page.wait("document.querySelectorAll('#findings li').length > 1")
        page.evaluate("location.hash = '#lesson=lessons/03-square'")
        page.wait(f"{by_id('task-title')}.textContent.includes('Square')")
        page.evaluate(click("test"))
        page.wait("document.querySelector('#verdict-list [data-verdict=failed]') !== null", 30)
        page.wait(idle)
        page.evaluate(click("pick"))
        page.wait("document.querySelectorAll('.cards > li').length > 20")
        asked_for = {name for name in weight.listed(folder, "on_demand") if name.startswith("verdicts-")}
        counted = {*weight.listed(folder), *asked_for, "examples/lessons/03-square.json"}
        self.assertEqual({path.lstrip("/") or "index.html" for path in server.asked} - counted, set())

    def test_what_is_loaded_on_demand_is_told_where_it_is_missing(self):
        server = site_server.Site(folder, without=weight.listed(folder, "on_demand"))
        self.addCleanup(server.close)
        page = self.open(fragment({"a.bas": "10 end\n"}), server=server)
        page.evaluate(click("flash"))
        page.wait(f"{by_id('status')}.textContent.includes('could not be loaded')")
        refusal = "new Promise(done => { const one = new Worker('worker.js', { type: 'module' }); one.onmessage = ({ data }) => data.error && done(data.error.message); one.postMessage({ id: 1, method: 'links' }); one.postMessage({ id: 2, method: 'build', params: { files: { 'a.bas': '10 end' } } }); })"
        self.assertIn("could not be loaded", page.evaluate(refusal))
        # A lesson that is missing leaves what is open, and comes when it is asked for again.
        said = f"{by_id('status')}.textContent.includes('lessons and examples could not be loaded')"
        pick = lambda: page.evaluate("document.querySelector('[data-id=\"lessons/02-one-metre\"]').click()")
        page.evaluate(f"{by_id('status')}.textContent = ''")
        page.evaluate(click("pick"))
        page.wait("document.querySelectorAll('.cards > li').length > 20")
        pick()
        page.wait(said)
        self.assertIn("10 end", page.evaluate(text))
        page.evaluate(f"{by_id('status')}.textContent = ''; location.hash = '#lesson=lessons/02-one-metre'")
        page.wait(said)
        server.without.clear()
        page.evaluate(click("pick"))
        pick()
        page.wait(f"{by_id('task-title')}.textContent.includes('One metre')")
        page.complaints.clear()

    def test_of_two_lessons_the_one_asked_for_last_opens(self):
        slow = "const own = fetch; window.fetch = async (url, ...more) => { if (`${url}`.includes('01-')) await new Promise(done => setTimeout(done, 800)); return own(url, ...more); };"
        page = self.open(fragment({"a.bas": "10 end\n"}), before=slow)
        page.evaluate(click("pick"))
        page.wait("document.querySelectorAll('.cards > li').length > 20")
        page.evaluate("for (const id of ['01-traffic-light', '02-one-metre']) document.querySelector(`[data-id=\"lessons/${id}\"]`).click()")
        page.wait(f"{by_id('task-title')}.textContent.includes('One metre')")
        page.evaluate(wait(1000))
        self.assertIn("One metre", page.evaluate(f"{by_id('task-title')}.textContent"))

    def test_two_tabs_do_not_write_over_each_other(self):
        pages = [self.browser.page(), self.browser.page()]
        for page, word in zip(pages, ("first", "second")):
            self.addCleanup(page.close)
            page.go(self.server.url + fragment({"a.bas": "10 end\n"}))
            page.wait(ready)
            self.type(page, f'10 print "{word}"\n')
            page.evaluate("new Promise(done => setTimeout(done, 600))")
        for page, word in zip(reversed(pages), ("second", "first")):  # the first, which is older, is loaded last
            page.go("about:blank")
            page.go(self.server.url)
            page.wait(ready)
            page.evaluate("new Promise(done => setTimeout(done, 600))")
            self.assertIn(word, page.evaluate(text))
        third = self.browser.page()
        self.addCleanup(third.close)
        third.go(self.server.url)
        third.wait(ready)
        self.assertIn("second", third.evaluate(text))

    def test_hostile_text_stays_text(self):
        evil = "<img src=x onerror='window.hacked=1'>"
        quoted = "`a`<img/src=x>`b`"  # in a message it ends the quotation
        page = self.open(fragment({"a.test": f'test "t"\n  {quoted} 1\n', "a.bas": '10 print "<img src=x>"\n', "b.orb": "const side = 3 ' <img src=x>\nprint side\n",
                                   evil + ".bas": "x", "__proto__.bas": "10 end\n"},
                                  lesson=evil, main=evil, run={"stimuli": [evil], "course": evil, "input": evil, "seed": evil}))

        def shown(where):
            """There it is, as text."""
            page.wait(f"document.querySelector('{where}')?.textContent.includes('<img')", 30)
            self.assertEqual(page.evaluate("document.querySelectorAll('img:not(#course-picture), body script:not([src])').length"), 0, where)

        shown("#findings")
        page.evaluate(click("world-button"))
        shown("#scripts")
        page.evaluate("document.querySelector('#scripts input').click()")  # without it
        self.type(page, f'test "{evil}"\n  expect print "no"\n')
        page.evaluate(click("test"))
        shown("#verdict-list b")
        page.evaluate("document.querySelector('#verdict-list li > .row button').click()")
        shown("#outcome")
        shown("#events")
        page.wait(idle)
        page.evaluate("document.getElementById('tab-b.orb').click()")
        page.wait("document.querySelector('.tok-variable') !== null")
        box = page.evaluate("(({x, y, height}) => [x + 4, y + height / 2])([...document.querySelectorAll('[class^=tok-]')].filter(one => one.textContent === 'side').pop().getBoundingClientRect())")
        page.call("Input.dispatchMouseEvent", type="mouseMoved", x=box[0], y=box[1])
        shown(".cm-tooltip-hover")
        self.assertIsNone(page.evaluate("window.hacked"))

    def test_scripts_of_others_are_refused(self):
        page = self.open()
        refused = page.evaluate("""new Promise(done => {
          document.addEventListener('securitypolicyviolation', event => done(event.violatedDirective), { once: true });
          const script = document.createElement('script'); script.textContent = 'window.hacked = 1'; document.body.append(script);
        })""")
        self.assertTrue(refused.startswith("script-src"), refused)
        self.assertIsNone(page.evaluate("window.hacked"))
        page.complaints.clear()
        page.evaluate("delete window.violations")  # which is what was wanted

    def test_a_file_ends_as_a_kind_does(self):
        page = self.open()
        for name, fits in (("a.constructor", False), ("a.__proto__", False), ("a.orb", True)):
            page.evaluate(click("new-file"))
            page.evaluate(f"document.getElementById('name').value = '{name}'")
            page.evaluate("document.querySelector('#name-form [value=ok]').click()")
            self.assertEqual(page.evaluate("document.getElementById('name-dialog').open"), not fits, name)
            if not fits:
                self.assertIn("must end in", page.evaluate("document.getElementById('name-trouble').textContent"))
                page.evaluate("document.getElementById('name-dialog').close()")

    def test_damaged_addresses_are_told(self):
        bomb = zlib.compressobj(9, zlib.DEFLATED, -15)
        packed = bomb.compress(b'{"files":{"a.bas":"10 end"},"x":"' + b"x" * 50_000_000 + b'"}') + bomb.flush()
        for broken in ("#p=AAAA", "#p=%%%", "#p=AA&x=1", "#p=" + base64.urlsafe_b64encode(packed).decode().rstrip("="), "#lesson=none"):
            page = self.open(broken)
            page.wait(f"{by_id('status')}.textContent.includes('damaged')")

    def test_it_works_without_a_network_once_loaded(self):
        server = site_server.Site(folder)
        page = self.open(server=server)
        page.wait("navigator.serviceWorker.controller !== null", 30)
        server.close()
        page.call("Page.reload")
        page.wait(ready, 30)
        self.instant(page)
        page.wait(f"{events}.length > 0")
        page.evaluate(click("pick"))
        page.wait("document.querySelectorAll('.cards button').length > 20")

    def test_what_was_never_used_works_without_a_network(self):
        server = site_server.Site(folder)
        page = self.open(server=server)
        soon = weight.listed(folder, "soon")
        self.assertTrue(any(name.endswith(".wasm") for name in soon))
        for name in soon:
            page.wait(f"caches.match({json.dumps(name)}).then(found => !!found)", 60)
        server.close()
        page.call("Page.reload")
        page.wait(ready, 30)
        page.evaluate("location.hash = " + json.dumps(fragment({"a.macro": "rgb 0, 255, 0\ndelay 1s\n", "a.bas": "10 rgb 1\n"})))
        page.wait("document.getElementById('tab-a.bas') !== null")
        page.evaluate("document.getElementById('tab-a.bas').click()")
        page.wait("document.querySelectorAll('#findings .error').length === 1", 30)
        open_flash(page)
        page.evaluate(f"{by_id('flash-dialog')}.close()")
        page.evaluate("document.getElementById('tab-a.macro').click()")
        self.instant(page)
        page.wait(f"{outcome}.includes('ended')")
        for number, lesson in enumerate(lessons()):
            page.evaluate(f"location.hash = '#lesson={lesson['id']}'")
            page.wait(f"{by_id('dots')}.children[{number}]?.getAttribute('aria-current') === 'step' && ({text}) === {json.dumps(lesson['files']['robot.orb'])}")
        page.evaluate("location.hash = '#example=hall.svg'")
        page.wait("document.getElementById('tab-hall.svg') !== null")
        # Parts not used before are missing offline, which one sentence says.
        page.evaluate("location.hash = " + json.dumps(fragment({"b.orb": "print 1\n"})))
        page.evaluate(click("as-blocks"))
        page.wait("document.querySelector('.blocks-words')?.textContent.includes('not on this device yet')", 20)
        page.complaints.clear()

    # -- onto a ball --
    def flash(self, kind, mock, *options, cut=None, files=None):
        wire = site_server.Handler.wire = site_server.Wire(orb, *options, cut=cut)
        self.addCleanup(wire.close)
        files = files or {"a.bas": '10 print "on the ball"\n' + "".join(f"{n} A = A + {n}\n" for n in range(20, 500, 10))}
        page = self.open(fragment(files), before=mock)
        open_flash(page)
        page.evaluate(click(f"flash-{kind}"))
        page.wait(f"{by_id('flash-cancel')}.hidden && {by_id('flash-status')}.textContent !== ''", 60)
        return page, wire

    def test_a_program_is_flashed_over_a_serial_port(self):
        page, wire = self.flash("serial", mock_serial)
        self.assertEqual(page.evaluate(f"[{by_id('flash-status')}.className, {by_id('flash-progress')}.value]"), ["", 1], page.evaluate(f"{by_id('flash-status')}.textContent"))
        self.assertIn(b"on the ball", wire.sent)
        self.assertRegex(page.evaluate(f"{by_id('flash-status')}.textContent"), r"^\d+ bytes in RAM")

    def test_a_program_that_stops_when_it_is_started_is_told(self):
        page, wire = self.flash("serial", mock_serial, files={"a.bas": "10 goroll 0, 100, 1\n20 A = xpos\n30 print 5 / A\n"})
        said = page.evaluate(f"[{by_id('flash-status')}.className, {by_id('flash-status')}.textContent, document.querySelector('#robots > li').dataset.state]")
        self.assertEqual(said, ["bad", "the program stopped at line 30: Divide by zero", "failed"])
        self.assertFalse(page.evaluate(f"{by_id('robot')}.hidden"), "it can be started again")
        self.assertIn(bytes([0x02, 0x33]), wire.sent[wire.sent.rindex(b"goroll"):], "its motors are stopped")

    def test_a_program_is_flashed_over_bluetooth(self):
        page, wire = self.flash("bluetooth", mock_bluetooth, "--firmware", "bb-8", files={"a.macro": "rgb 0, 255, 0\ndelay 1s\n" * 9})
        self.assertEqual(page.evaluate(f"{by_id('flash-status')}.className"), "", page.evaluate(f"{by_id('flash-status')}.textContent"))
        self.assertRegex(page.evaluate(f"{by_id('flash-status')}.textContent"), r"macro")
        self.assertGreater(len(wire.sent), 60)
        self.assertLessEqual(max(size for _, size in page.evaluate("window.written")), 20)

    def test_a_robot_that_does_not_answer_is_given_up_by_hand(self):
        page = self.open(fragment({"a.macro": "rgb 0, 255, 0\n"}), before=mock_bluetooth.replace("this.connected = true;", "await new Promise(() => {});"))
        open_flash(page)
        page.evaluate(click("flash-bluetooth"))
        page.wait(f"!{by_id('flash-cancel')}.hidden")
        page.evaluate("new Promise(done => setTimeout(done, 300))")
        page.evaluate(click("flash-cancel"))
        page.wait(f"{by_id('flash-cancel')}.hidden", 3)
        self.assertIn("nothing was sent", page.evaluate(f"{by_id('flash-status')}.textContent"))
        self.assertFalse(page.evaluate(f"{by_id('flash-serial')}.disabled"))

    def test_a_class_flashes_one_robot_after_the_other(self):
        box = mock_bluetooth.replace("{ requestDevice: async () => device }", "{ requestDevice: async () => robot(window.chosen) }") + "window.chosen = 'BB-1111';"
        ball = ["--firmware", "bb-8"]
        rows = "Object.fromEntries([...document.querySelectorAll('#robots > li')].map(row => [row.querySelector('b').textContent, [row.dataset.state, row.querySelector('.words').textContent]]))"
        state = lambda name: f"({rows})['{name}']?.[0]"
        idle = f"{by_id('flash-cancel')}.hidden && !{by_id('flash-next')}.disabled"
        def anew():
            new = site_server.Handler.wire = site_server.Wire(orb, *ball)
            self.addCleanup(new.close)
            return new
        def send_to(name, ended):
            page.evaluate(f"window.chosen = '{name}'")
            page.evaluate(click("flash-next"))
            page.wait(f"{state(name)} === 'busy'", 10)
            self.assertTrue(page.evaluate(f"{by_id('robots')}.inert"), "nobody sends to two at once")
            page.wait(f"{state(name)} === '{ended}' && {idle}", 60)

        page, wire = self.flash("bluetooth", box, *ball, files={"a.macro": "rgb 0, 255, 0\ndelay 1s\n" * 9})
        self.assertIn("macro", page.evaluate(rows)["BB-1111"][1])
        wire = anew()
        send_to("BB-3333", "done")
        self.assertGreater(len(wire.sent), 60)
        anew()
        page.evaluate("window.out_of_reach = 'BB-2222'")
        send_to("BB-2222", "failed")
        self.assertIn("cannot connect to BB-2222", page.evaluate(rows)["BB-2222"][1])
        if picture_folder:
            page.evaluate(f"{by_id('robots')}.scrollIntoView()")
            page.picture(os.path.join(picture_folder, "robots.png"))

        wire = anew()
        page.evaluate("window.out_of_reach = ''; [...document.querySelectorAll('#robots > li')].find(row => row.textContent.includes('BB-2222')).querySelector('button').click()")
        page.wait(f"{state('BB-2222')} === 'done' && {idle}", 60)
        self.assertGreater(len(wire.sent), 60)
        anew()
        send_to("BB-1111", "done")
        self.assertEqual({name: state for name, (state, _) in page.evaluate(rows).items()}, dict.fromkeys(["BB-1111", "BB-2222", "BB-3333"], "done"), "each is listed once")
        self.assertEqual(page.complaints, [])

    def test_ports_without_names_are_numbered(self):
        page, wire = self.flash("serial", mock_serial)
        self.assertEqual(page.evaluate("document.querySelector('#robots b').textContent"), "Ball 1")
        self.assertFalse(page.evaluate(f"{by_id('flash-next')}.hidden"))

    def test_a_robot_is_run_and_stopped_and_heard(self):
        page, wire = self.flash("serial", mock_serial, files={"a.bas": '10 print "on the ball"\n20 delay 200\n30 goto 10\n'})
        page.wait(f"!{by_id('robot')}.hidden")
        page.evaluate(click("robot-run"))
        page.wait(f"{by_id('robot-prints')}.textContent.includes('on the ball')", 20)
        page.evaluate(click("robot-stop"))
        page.evaluate(wait(1200))
        heard = page.evaluate(f"{by_id('robot-prints')}.textContent")
        page.evaluate(wait(900))
        self.assertEqual(page.evaluate(f"{by_id('robot-prints')}.textContent"), heard)

    def drive(self, kind, mock, *options, program, cut=None):
        wire = site_server.Handler.wire = site_server.Wire(orb, *options, cut=cut)
        self.addCleanup(wire.close)
        page = self.open(fragment({"a.bas": program}), before=mock)
        open_flash(page)
        page.evaluate(click(f"drive-{kind}"))
        return page, wire

    def test_a_robot_is_driven_from_here(self):
        newer = mock_bluetooth.replace("BB-1234", "SB-1234")
        for kind, mock, options in (("bluetooth", newer, ["--robot", "bolt"]), ("serial", mock_serial, [])):
            with self.subTest(kind):
                page, wire = self.drive(kind, mock, *options, program='10 RGB 0,0,255\n20 goroll 90,80,1\n30 if xpos < 20 then goto 30\n'
                                        '40 goroll 90,0,0\n50 delay 600\n60 print "at ";xpos / 10\n')
                page.wait(f"{by_id('outcome')}.textContent.includes('has been stopped')", 40)
                outcome = page.evaluate(f"{by_id('outcome')}.textContent")
                self.assertIn("ended after", outcome)
                self.assertRegex(outcome, r"stopped at [2-6]\d,-?\d cm")
                if picture_folder:
                    page.picture(os.path.join(picture_folder, f"drive-{kind}.png"))
                self.assertRegex(page.evaluate(f"{events}.join()"), r"at [2-6]")
                self.assertEqual(page.complaints, [])

    def test_stop_brakes_the_robot_that_is_driven(self):
        newer = mock_bluetooth.replace("BB-1234", "SM-1234")
        page, wire = self.drive("bluetooth", newer, "--robot", "mini", program="10 goroll 0,60,1\n20 delay 100\n30 goto 10\n")
        page.wait(f"{by_id('outcome')}.textContent.includes('driving the “Sphero Mini”')", 20)
        page.evaluate(wait(800))
        page.evaluate(click("run"))
        page.wait(f"{by_id('outcome')}.textContent.includes('has been stopped')", 20)
        page.evaluate(wait(300))
        sent = len(wire.sent)
        page.evaluate(wait(1200))
        self.assertEqual(len(wire.sent), sent, "nothing drives it any more")

    def test_a_robot_that_is_lost_while_it_drives_is_told(self):
        newer = mock_bluetooth.replace("BB-1234", "SM-1234")
        page, wire = self.drive("bluetooth", newer, "--robot", "mini", program="10 goroll 0,60,1\n20 delay 100\n30 goto 10\n", cut=900)
        page.wait(f"{by_id('outcome')}.textContent.includes('not acknowledged the stop')", 30)
        self.assertIn("gone", page.evaluate(f"{by_id('outcome')}.textContent"))

    def test_a_radio_that_is_off_is_told(self):
        off = mock_bluetooth.replace("{ requestDevice: async () => device }", "{ requestDevice: async () => device, getAvailability: async () => false }")
        page = self.open(fragment({"a.bas": "10 end\n"}), before=off)
        page.evaluate(click("flash"))
        page.wait(f"{by_id('flash-bluetooth')}.disabled && {by_id('flash-lacks')}.textContent.includes('switched off')")

    def test_a_cut_link_is_told(self):
        page, wire = self.flash("serial", mock_serial, cut=200)
        self.assertEqual(page.evaluate(f"{by_id('flash-status')}.className"), "bad")
        self.assertNotEqual(page.evaluate(f"{by_id('flash-status')}.textContent"), "")
        self.assertFalse(page.evaluate(f"{by_id('flash-serial')}.disabled"))
        page.complaints.clear()

    def test_where_no_ball_can_be_reached_there_is_the_file(self):
        page = self.open(before="delete Navigator.prototype.serial; delete Navigator.prototype.bluetooth;")
        open_flash(page)
        self.assertIn("cannot reach robots", page.evaluate(f"{by_id('flash-lacks')}.textContent"))
        self.assertTrue(page.evaluate(f"{by_id('flash-serial')}.disabled"))
        page.evaluate(click("flash-file"))
        page.wait(f"{by_id('flash-status')}.textContent.includes('orb upload')", 30)

    # -- for everybody --
    def test_everything_has_a_name(self):
        page = self.open("#lesson=lessons/01-traffic-light")
        self.instant(page)
        page.evaluate(click("world-button"))
        page.call("Accessibility.enable")
        nodes = page.call("Accessibility.getFullAXTree")["nodes"]
        value = lambda node, key: (node.get(key) or {}).get("value", "")
        focusable = [node for node in nodes if not node.get("ignored") and any(p["name"] == "focusable" and p["value"].get("value") for p in node.get("properties", []))]
        self.assertGreater(len(focusable), 30)
        nameless = [value(node, "role") for node in focusable if not value(node, "name").strip() and value(node, "role") not in ("RootWebArea", "generic")]
        self.assertEqual(nameless, [])

    def test_axe_finds_nothing(self):
        with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../playground/node_modules/axe-core/axe.min.js"), encoding="utf-8") as file:
            axe = file.read()
        play = "document.querySelector('[data-view=play]').click()"
        for where, width, deeds in (("", 1366, []), ("", 1366, ["pick"]), ("", 1366, ["mine"]), ("", 1366, ["share"]), ("", 1366, ["flash"]),
                                    ("#example=hall.orb", 1366, ["instant", "world-button"]), ("#lesson=lessons/01-traffic-light", 1366, ["solution", "test"]),
                                    ("#example=dance.orb", 1366, ["as-blocks"]),
                                    ("#lesson=lessons/03-square", 390, ["instant"]), ("#p=AAAA", 1366, [])):
            for colours in ("light", "dark"):
                page = self.open(where, width, 800, mobile=width < 500)
                page.prefer(colours)
                page.wait(coloured)
                for name in deeds:
                    page.evaluate(click(name))
                    page.evaluate(wait(700))
                    page.wait(idle, 30)
                    if name == "as-blocks":
                        page.wait("document.querySelectorAll('#blocks .blocklyBlockCanvas .blocklyText').length > 10", 60)
                if width < 500:
                    page.evaluate(play)
                page.evaluate(axe + ";0")
                found = page.evaluate("axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) => violations.map(({ id, nodes }) => `${id}: ${nodes[0].target}`))")
                self.assertEqual(found, [], (where, deeds, colours))

    def test_a_phone_scrolls_only_down(self):
        for where in ("", "#lesson=lessons/08-the-wall"):
            page = self.open(where, 360, 740, mobile=True)
            for view in ("work", "play"):
                page.evaluate(f"document.querySelector('[data-view={view}]').click()")
                if view == "play":
                    self.instant(page)
                self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 360)
            small = page.evaluate("""[...document.querySelectorAll('button, select, a.as-button')].filter(one => one.offsetParent && !one.closest('.cm-editor, dialog, .link'))
              .filter(one => one.getBoundingClientRect().height < 24).map(one => one.id || one.textContent)""")
            self.assertEqual(small, [])

    def test_a_low_page_shows_both(self):
        for width, height, mobile in ((844, 390, True), (683, 384, False)):  # a phone on its side; 200 % of 1366 x 768
            page = self.open("#lesson=lessons/03-square", width, height, mobile)
            self.instant(page)
            page.evaluate("document.querySelector('.work').scrollTop = 1e4; document.querySelector('.player').scrollTop = 1e4")
            seen = lambda name: page.evaluate(f"(({{ top, bottom }}) => Math.min(bottom, innerHeight) - Math.max(top, 0))(document.querySelector('{name}').getBoundingClientRect())")
            self.assertGreater(seen("#editor"), 140, width)
            self.assertGreater(seen("#map"), 140, width)
            self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width)

    def test_a_keyboard_is_enough(self):
        page = self.open(fragment({"a.bas": '10 print "keys"\n', "a.test": 'test "t"\n  expect print "keys"\n'}))
        page.wait(coloured)
        page.evaluate("document.querySelector('.cm-content').focus()")
        page.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter", windowsVirtualKeyCode=13, modifiers=2 | 8)
        page.wait(f"{events}.includes('keys')", 30)
        self.assertNotIn("\n\n\n", page.evaluate(text))
        seen = set()
        page.evaluate("document.activeElement.blur()")
        for _ in range(80):
            page.call("Input.dispatchKeyEvent", type="keyDown", key="Tab", code="Tab", windowsVirtualKeyCode=9)
            seen.add(page.evaluate("document.activeElement.id || document.activeElement.className"))
        for wanted in ("pick", "mine", "share", "flash", "tab-a.bas", "new-file", "file-more", "run", "test", "world-button", "play", "time"):
            self.assertIn(wanted, seen)
        page.evaluate(f"{by_id('tab-a.bas')}.focus()")
        page.call("Input.dispatchKeyEvent", type="keyDown", key="ArrowRight", code="ArrowRight", windowsVirtualKeyCode=39)
        self.assertEqual(page.evaluate("document.activeElement.id"), "tab-a.test")
        page.wait(f"({text}).includes('expect print')")

    def test_a_program_of_the_docs_opens(self):
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.go(self.server.url + "docs/using/structured.html")
        page.evaluate("document.querySelector('.open-it').click()")
        page.wait(ready)
        page.wait(f"({text}).includes('sub leg')")
        self.assertEqual(page.complaints, [])

    def test_every_link_of_the_docs_leads_somewhere(self):
        missing = site_server.dead_links(folder)
        self.assertEqual(missing, [])


if __name__ == "__main__":
    if not chromium.find() or not os.path.exists(os.path.join(folder, "orb.wasm")):
        print("no Chromium, or no playground is built")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
