#!/usr/bin/env python3
"""The playground in a headless Chromium. usage: page_test.py ORB FOLDER [TEST...]

FOLDER is what `./dev playground` built. Exits 77 (skipped, to ctest) where no Chromium is installed or
nothing is built."""

import base64
import json
import os
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
idle = f"{by_id('stop')}.disabled"


def fragment(files, **more):
    """What the page itself would put behind `#`."""
    data = json.dumps({"files": files, "active": next(iter(files)), **more}).encode()
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(data) + packer.flush()
    return "#p=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


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
  constructor(service, name) { super(); Object.assign(this, { service, name }); }
  async writeValueWithResponse(value) {
    const bytes = new Uint8Array(value.buffer ? value.buffer.slice(value.byteOffset, value.byteOffset + value.byteLength) : value);
    if (bytes.length > 20) throw new DOMException('too long', 'InvalidModificationError');
    (window.written ??= []).push([this.name, bytes.length]);
    if (!window.greeted) return; // what opens the robot to commands
    await fetch('/wire/write', { method: 'POST', body: bytes });
  }
  async startNotifications() {
    window.greeted = true;
    (async () => { for (;;) {
      const answer = await fetch('/wire/read');
      if (answer.status !== 200) return device.gatt.disconnect();
      const bytes = await answer.arrayBuffer();
      for (let i = 0; i < bytes.byteLength; i += 20) {
        this.value = new DataView(bytes.slice(i, i + 20));
        this.dispatchEvent(new Event('characteristicvaluechanged'));
      }
    } })();
  }
}
const known = {};
const device = Object.assign(new EventTarget(), { name: 'BB-1234', gatt: {
  connected: false,
  async connect() {
    this.connected = true;
    return { getPrimaryService: async service => ({ getCharacteristic: async name => known[name] ??= new Characteristic(service, name) }) };
  },
  disconnect() { if (this.connected) { this.connected = false; device.dispatchEvent(new Event('gattserverdisconnected')); } },
} });
Object.defineProperty(navigator, 'bluetooth', { value: { requestDevice: async () => device } });
"""


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
        """A page as somebody sees it who was never here before."""
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.resize(width, height, mobile)
        if before:
            page.call("Page.addScriptToEvaluateOnNewDocument", source=before)
        page.go((server or self.server).url + where)
        page.wait(ready)
        own = (server or self.server).url
        self.addCleanup(lambda: self.assertEqual(page.complaints, []))
        self.addCleanup(lambda: self.assertEqual([url for url in page.requests if not url.startswith((own, "data:", f"blob:{own}"))], []))
        return page

    def type(self, page, words):
        """Replaces the text of the file shown by what is typed."""
        page.evaluate("document.querySelector('.cm-content').focus()")
        page.key("a", modifiers=2)
        page.call("Input.insertText", text=words)

    def instant(self, page):
        page.evaluate(click("instant"))
        page.wait(f"!{by_id('played')}.hidden && {idle}", 60)

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
        self.assertLess(took, 200)  # what is wanted is in docs/performance.md; this machine may be busy

    def test_a_huge_paste_is_left_out(self):
        page = self.open(fragment({"a.bas": "10 print 1\n"}))
        page.wait(coloured)
        page.evaluate("""document.querySelector('.cm-content').focus();
          const data = new DataTransfer(); data.setData('text/plain', '20 print 2\\n'.repeat(200000));
          document.querySelector('.cm-content').dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, bubbles: true, cancelable: true }))""")
        page.wait(f"{by_id('status')}.textContent.includes('256 KB')")
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

    def test_a_run_is_shown_while_it_goes_on(self):
        page = self.open(fragment({"a.bas": '10 goroll 0,60,1\n20 print "tick"\n30 delay 200\n40 goto 20\n'}))
        page.evaluate(click("run"))
        page.wait(f"{events}.filter(words => words === 'tick').length > 2", 30)
        self.assertFalse(page.evaluate(idle))
        y = "Number(document.querySelector('[data-now=position]').textContent.split(', ')[1].split(' ')[0])"
        first = page.evaluate(y)
        page.wait(f"{y} > {first} + 5")
        page.evaluate(click("stop"))
        page.wait(idle)
        self.assertGreater(page.evaluate(f"{by_id('map')}.querySelectorAll('.run').length"), 0)

    def test_somebody_shakes_it_and_answers_while_it_runs(self):
        page = self.open(fragment({"a.bas": '10 if dshake = 0 then goto 10\n20 print "shaken"\n30 input A\n40 print "got " A\n'}))
        page.evaluate(click("run"))
        page.wait(f"!{by_id('hands')}.hidden")
        page.wait(f"!{by_id('played')}.hidden", 30)
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
            page.evaluate(click("stop"))
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

    # -- testing --
    def test_a_test_fails_and_then_passes(self):
        page = self.open(fragment({"a.bas": '10 print "no"\n', "a.test": 'test "says yes"\n  expect print "yes"\n'}))
        page.evaluate(click("test"))
        page.wait("document.querySelector('#verdict-list [data-verdict=failed]') !== null", 30)
        self.assertIn("0 of 1 tests passed", page.evaluate(f"{by_id('verdicts-title')}.textContent"))
        page.evaluate("[...document.querySelectorAll('#verdict-list button')].find(one => one.textContent === 'Watch').click()")
        page.wait(f"!{by_id('played')}.hidden && {events}.includes('no')", 30)
        page.wait(idle)
        self.type(page, '10 print "yes"\n')
        page.evaluate(click("test"))
        page.wait("document.querySelector('#verdict-list [data-verdict=passed]') !== null", 30)
        self.assertTrue(page.evaluate(f"{by_id('verdicts')}.classList.contains('all-passed')"))

    def test_a_lesson_is_done(self):
        page = self.open("#lesson=lessons/01-traffic-light")
        page.wait(f"!{by_id('task')}.hidden && {by_id('task-text')}.textContent.includes('Your job')")
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

    def test_all_that_is_loaded_weighs_at_most_600_kb(self):
        self.assertLessEqual(sum(weight.weights(folder).values()), 600_000)

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

    def test_a_file_ends_as_a_kind_does(self):
        page = self.open()
        for name, fits in (("a.constructor", False), ("a.__proto__", False), ("a.orb", True)):
            page.evaluate(click("new-file"))
            page.evaluate(f"document.getElementById('name').value = '{name}'")
            page.evaluate("document.querySelector('#name-form [value=ok]').click()")
            self.assertEqual(page.evaluate("document.getElementById('name-dialog').open"), not fits, name)
            if not fits:
                self.assertIn("ends in", page.evaluate("document.getElementById('name-trouble').textContent"))
                page.evaluate("document.getElementById('name-dialog').close()")

    def test_damaged_addresses_are_told(self):
        bomb = zlib.compressobj(9, zlib.DEFLATED, -15)
        packed = bomb.compress(b'{"files":{"a.bas":"10 end"},"x":"' + b"x" * 50_000_000 + b'"}') + bomb.flush()
        for broken in ("#p=AAAA", "#p=%%%", "#p=" + base64.urlsafe_b64encode(packed).decode().rstrip("="), "#lesson=none"):
            page = self.open(broken)
            if broken == "#p=%%%":
                continue  # not one of ours at all
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

    # -- onto a ball --
    def flash(self, kind, mock, *options, cut=None, files=None):
        wire = site_server.Handler.wire = site_server.Wire(orb, *options, cut=cut)
        self.addCleanup(wire.close)
        files = files or {"a.bas": '10 print "on the ball"\n' + "".join(f"{n} A = A + {n}\n" for n in range(20, 500, 10))}
        page = self.open(fragment(files), before=mock)
        page.evaluate(click("flash"))
        page.wait(f"{by_id('flash-dialog')}.open")
        page.evaluate(click(f"flash-{kind}"))
        page.wait(f"{by_id('flash-cancel')}.hidden && {by_id('flash-status')}.textContent !== ''", 60)
        return page, wire

    def test_a_program_is_flashed_over_a_serial_port(self):
        page, wire = self.flash("serial", mock_serial)
        self.assertEqual(page.evaluate(f"[{by_id('flash-status')}.className, {by_id('flash-progress')}.value]"), ["", 1], page.evaluate(f"{by_id('flash-status')}.textContent"))
        self.assertIn(b"on the ball", wire.sent)
        self.assertRegex(page.evaluate(f"{by_id('flash-status')}.textContent"), r"^\d+ bytes in RAM")

    def test_a_program_is_flashed_over_bluetooth(self):
        page, wire = self.flash("bluetooth", mock_bluetooth, "--firmware", "bb-8", files={"a.macro": "rgb 0, 255, 0\ndelay 1s\n" * 9})
        self.assertEqual(page.evaluate(f"{by_id('flash-status')}.className"), "", page.evaluate(f"{by_id('flash-status')}.textContent"))
        self.assertRegex(page.evaluate(f"{by_id('flash-status')}.textContent"), r"macro")
        self.assertGreater(len(wire.sent), 60)
        self.assertLessEqual(max(size for _, size in page.evaluate("window.written")), 20)

    def test_a_robot_that_does_not_answer_is_given_up_by_hand(self):
        page = self.open(fragment({"a.macro": "rgb 0, 255, 0\n"}), before=mock_bluetooth.replace("this.connected = true;", "await new Promise(() => {});"))
        page.evaluate(click("flash"))
        page.evaluate(click("flash-bluetooth"))
        page.wait(f"!{by_id('flash-cancel')}.hidden")
        page.evaluate("new Promise(done => setTimeout(done, 300))")
        page.evaluate(click("flash-cancel"))
        page.wait(f"{by_id('flash-cancel')}.hidden", 3)
        self.assertIn("nothing was sent", page.evaluate(f"{by_id('flash-status')}.textContent"))
        self.assertFalse(page.evaluate(f"{by_id('flash-serial')}.disabled"))

    def test_a_cut_link_is_told(self):
        page, wire = self.flash("serial", mock_serial, cut=200)
        self.assertEqual(page.evaluate(f"{by_id('flash-status')}.className"), "bad")
        self.assertNotEqual(page.evaluate(f"{by_id('flash-status')}.textContent"), "")
        self.assertFalse(page.evaluate(f"{by_id('flash-serial')}.disabled"))
        page.complaints.clear()

    def test_where_no_ball_can_be_reached_there_is_the_file(self):
        page = self.open(before="delete Navigator.prototype.serial; delete Navigator.prototype.bluetooth;")
        page.evaluate(click("flash"))
        self.assertIn("can reach no ball", page.evaluate(f"{by_id('flash-lacks')}.textContent"))
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
        for wanted in ("pick", "share", "flash", "tab-a.bas", "new-file", "format", "run", "instant", "test", "world-button", "play", "time"):
            self.assertIn(wanted, seen)
        page.evaluate(f"{by_id('tab-a.bas')}.focus()")
        page.call("Input.dispatchKeyEvent", type="keyDown", key="ArrowRight", code="ArrowRight", windowsVirtualKeyCode=39)
        self.assertEqual(page.evaluate("document.activeElement.id"), "tab-a.test")
        page.wait(f"({text}).includes('expect print')")

    def test_a_program_of_the_docs_opens(self):
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.go(self.server.url + "docs/structured.html")
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
