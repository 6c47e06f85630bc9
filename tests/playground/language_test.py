#!/usr/bin/env python3
"""Tests the page in other languages, in a headless Chromium. usage: language_test.py ORB FOLDER [TEST...]

FOLDER is what `./dev playground` built. In the pseudo-locale every text of the catalogue is accented, a third longer and in
brackets: a text without brackets is not translated, and a text that is cut off is too long for its place."""

import json
import os
import re
import shutil
import sys
import tempfile
import unittest

from page_test import by_id, chromium, click, folder, fragment, idle, lessons, picture_folder, played, ready, site_server, stop, wait

codes = ["de", "es", "fr"]
speaks = lambda *tags: f"Object.defineProperty(navigator, 'languages', {{ value: {json.dumps(tags)} }});"
kept = json.dumps(".cm-content, .cm-gutters, .cm-announced, pre, code, kbd, textarea, script, style, noscript, #tabs, #announce, #events .print .words, #variables th, .lane-words i, [class*=blockly], [translate=no], h1, "
                  "#library-list h3:last-of-type ~ *, #library-list ul:last-of-type")
accents = str.maketrans("aeiouyAEIOUYcnCN", "áéíóúýÁÉÍÓÚÝçñÇÑ")


def pseudo(text):
    pieces = re.split(r"(`[^`]*`|\{\w+\}|^ {4}.*|\*\*|^\d\. )", text, flags=re.MULTILINE)
    said = "".join(piece if i % 2 else piece.translate(accents) for i, piece in enumerate(pieces))
    more = "·" * (len(text) * 3 // 10)
    if text.startswith("    "):
        return text + "⟦⟧"
    bold = re.match(r"\*\*|\d\. ", text)  # Markdown stays Markdown
    return f"{bold[0]}⟦{said[len(bold[0]):]}{more}⟧" if bold else f"⟦{said}{more}⟧"


# Texts of the page that the catalogue has not said.
english = f"""(() => {{
  const texts = [], has_words = /\\p{{L}}{{2}}/u, said = /[⟦⟧áéíóúýÁÉÍÓÚÝçñÇÑ]|^[\\d.,-]+ ?(cm|m|s|ms|cm\\/s)$|^(push 90 120|accelone)$|^\\w+ \\d+, \\d{{4}}, /;
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT);
  for (let node = walker.currentNode; node; node = walker.nextNode()) {{
    const place = node.nodeType === Node.TEXT_NODE ? node.parentElement : node;
    if (place.closest({kept})) continue;
    if (node.nodeType === Node.TEXT_NODE) texts.push(node.data);
    else for (const name of ['title', 'aria-label', 'placeholder', 'alt']) if (node.hasAttribute(name)) texts.push(node.getAttribute(name));
  }}
  return [...new Set(texts.map(text => text.trim()).filter(text => has_words.test(text) && !said.test(text)))];
}})()"""
# Words that leave their place: cut off, or beyond the edge of the page.
cut = """(() => {
  const names = [];
  for (const one of document.querySelectorAll('button, summary, h2, label, legend, .pane-head, p, dt, dd, a')) {
    const { left, right, width, height } = one.getBoundingClientRect(), look = getComputedStyle(one);
    if (!width || !height || look.visibility === 'hidden' || one.closest('.unseen, .cm-editor, [aria-hidden=true]')) continue;
    const scrolls = one.parentElement.closest('.scroll, .tabs, dialog');
    const clips = look.overflowX !== 'visible' && one.scrollWidth > one.clientWidth + 1 && look.overflowX !== 'auto' && look.textOverflow !== 'ellipsis';
    if (clips || !scrolls && (right > innerWidth + 1 || left < -1)) names.push(`${one.id || one.className || one.tagName}: ${one.textContent.slice(0, 60)}`);
  }
  if (document.documentElement.scrollWidth > innerWidth + 1) names.push('the page is wider than the window');
  return names;
})()"""


class Languages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = site_server.Site(folder)
        cls.copy = tempfile.mkdtemp()
        shutil.copytree(folder, cls.copy, dirs_exist_ok=True, ignore=lambda place, names: ["docs", "sw.js"] if place == folder else [])
        path = os.path.join(cls.copy, "languages/de.json")
        with open(path, encoding="utf-8") as file:
            parts = json.load(file)
        with open(path, "w", encoding="utf-8") as file:
            json.dump({part: {key: pseudo(key) for key in texts} for part, texts in parts.items()}, file)
        cls.pseudo = site_server.Site(cls.copy)
        cls.browser = chromium.Browser(chromium.find())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.server.close()
        cls.pseudo.close()
        shutil.rmtree(cls.copy)

    def open(self, where="", tags=("de",), server=None, width=1366, height=768, mobile=False, before=""):
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.resize(width, height, mobile)
        page.call("Page.addScriptToEvaluateOnNewDocument", source=speaks(*tags) + before)
        page.go((server or self.server).url + where)
        page.wait(ready)
        return page

    # -- the pseudo-locale --
    def all_said(self, page):
        page.evaluate(wait(300))
        self.assertEqual(page.evaluate(english), [])
        self.assertEqual(page.evaluate(cut), [])

    def look_through(self, **size):
        page = self.open(server=self.pseudo, **size)
        self.all_said(page)
        page.evaluate(click("instant"))
        page.wait(f"{played} && {idle}", 60)
        page.evaluate(f"{by_id('details')}.open = true")
        self.all_said(page)
        for opens, dialog in [("mine", "mine-dialog"), ("share", "share-dialog"), ("pick", "library"), ("flash", "flash-dialog"), ("new-file", "name-dialog"), ("lesson-write", "lesson-dialog"), ("keys-button", "keys")]:
            page.evaluate(click(opens))
            page.wait(f"{by_id(dialog)}.open")
            self.all_said(page)
            page.evaluate("for (const one of document.querySelectorAll('dialog[open]')) one.close()")
        for number, lesson in enumerate(lessons()):
            page.evaluate(f"location.hash = '#lesson={lesson['id']}'")
            page.wait(f"{by_id('dots')}.children[{number}]?.getAttribute('aria-current') === 'step'")
            self.all_said(page)
        page.evaluate(click("test"))
        page.wait(f"!{by_id('verdicts')}.hidden && {idle}", 60)
        # What a test has seen is in the engine's words, and what it wanted and where in those of the files.
        self.assertEqual([text for text in page.evaluate(english) if not re.match(r"seen: |expect |[\w-]+\.\w+:\d+: ", text)], [])

    def test_nothing_is_hard_coded_and_nothing_cut(self):
        self.look_through()

    def test_nor_on_a_phone(self):
        self.look_through(width=390, height=844, mobile=True)

    def test_findings_in_the_pseudo_locale(self):
        page = self.open(fragment({"a.orb": "dealy 2s\ngoroll 0, 100, 1\nprint nowhere\n"}), server=self.pseudo)
        page.wait("document.querySelectorAll('#findings li').length > 0")
        self.all_said(page)

    def test_blocks_in_the_pseudo_locale(self):
        page = self.open(fragment({"a.orb": "if speed > 5 then\n  repeat 4\n    goroll 0, 80, 1\n  end repeat\nelse\n  print \"a\"\nend if\n"}), server=self.pseudo)
        page.evaluate(click("as-blocks"))
        words = "[...document.querySelectorAll('#blocks .blocklyBlockCanvas .blocklyText, #blocks .blocklyToolboxCategoryLabel, #blocks .blocklyTreeLabel')].map(one => one.textContent.trim())"
        page.wait(f"({words}).length > 20", 60)
        self.assertEqual([one for one in page.evaluate(words) if re.search(r"[A-Za-z]{2}", one) and not re.search("[⟦⟧áéíóú]", one) and one not in ("goroll", "speed")], [])

    # -- the languages --
    def test_the_page_is_in_the_first_language_of_the_browser_that_there_is(self):
        for tags, code, run in [(("de-AT", "en"), "de", "Start"), (("ja", "es-MX"), "es", "Iniciar"), (("fr",), "fr", "Lancer"), (("en-GB", "de"), "en", "Run"), (("ja",), "en", "Run")]:
            page = self.open("#lesson=lessons/02-one-metre", tags=tags)
            self.assertEqual(page.evaluate("document.documentElement.lang"), code)
            self.assertEqual(page.evaluate(f"{by_id('run-words')}.textContent"), run)
            self.assertEqual(page.complaints, [])

    def test_who_reads_english_loads_no_other_language(self):
        server = site_server.Site(folder)
        self.addCleanup(server.close)
        page = self.open(tags=("en-US",), server=server, before="Object.defineProperty(navigator, 'connection', { value: { saveData: true } });")
        page.evaluate(wait(500))
        self.assertEqual([path for path in server.asked if "languages" in path or "translate" in path], [])

    def test_the_language_is_chosen_in_the_menu_and_remembered(self):
        page = self.open(tags=("en",))
        self.choose(page, "fr")
        page.go(self.server.url)
        page.wait(ready)
        self.assertEqual(page.evaluate("document.documentElement.lang"), "fr")
        self.assertEqual(page.evaluate(f"{by_id('language')}.value"), "fr")

    def choose(self, page, code):
        page.evaluate(f"{by_id('language')}.value = '{code}'; {by_id('language')}.dispatchEvent(new Event('change'))")
        page.wait(f"document.documentElement.lang === '{code}'")

    def test_another_language_loses_nothing(self):
        blocked = "for (const name of ['localStorage', 'sessionStorage', 'indexedDB']) Object.defineProperty(window, name, { get() { throw new DOMException('denied', 'SecurityError'); } });"
        for before in ("", blocked):
            page = self.browser.page(fresh=True)
            self.addCleanup(page.close)
            page.resize(1366, 768)
            page.call("Page.addScriptToEvaluateOnNewDocument", source=speaks("en") + before)
            page.go(self.server.url + "#lesson=lessons/02-one-metre")
            page.wait(ready)
            page.evaluate("document.querySelector('.cm-content').focus(); document.execCommand('insertText', false, 'dealy 1s\\n')")
            page.wait("document.querySelector('#findings .fix') !== null")
            words = "[document.getElementById('run-words').textContent, document.getElementById('task-title').textContent.replace(/^\\S+ /, ''), document.querySelector('#findings .error')?.textContent ?? '']"
            first = page.evaluate(words)
            for code, said in (("de", "ist weder ein Befehl"), ("fr", "n'est ni une instruction")):
                self.choose(page, code)
                page.wait(f"({words})[2].includes({json.dumps(said)})")
                self.assertNotEqual(page.evaluate(words)[0], first[0])
                self.assertIn("dealy", page.evaluate("document.querySelector('.cm-content').textContent"))
            self.choose(page, "en")
            page.wait(f"JSON.stringify({words}) === {json.dumps(json.dumps(first, separators=(',', ':'), ensure_ascii=False))}")
            page.evaluate("document.querySelector('.cm-content').focus()")
            page.call("Input.dispatchKeyEvent", type="rawKeyDown", key="z", code="KeyZ", windowsVirtualKeyCode=90, modifiers=2)
            page.wait("!document.querySelector('.cm-content').textContent.includes('dealy')")

    def test_the_last_choice_wins(self):
        slow = "const own = fetch; window.fetch = async (url, ...more) => { if (`${url}`.includes('de.json')) await new Promise(done => setTimeout(done, 800)); return own(url, ...more); };"
        page = self.browser.page(fresh=True)
        self.addCleanup(page.close)
        page.call("Page.addScriptToEvaluateOnNewDocument", source=speaks("en") + slow)
        page.go(self.server.url)
        page.wait(ready)
        page.evaluate(f"for (const code of ['de', 'fr']) {{ {by_id('language')}.value = code; {by_id('language')}.dispatchEvent(new Event('change')); }}")
        page.wait("document.documentElement.lang === 'fr'")
        page.evaluate(wait(1200))
        self.assertEqual(page.evaluate("document.documentElement.lang"), "fr")
        self.assertFalse(page.evaluate(f"{by_id('task')}.hidden"))  # the first steps

    def test_whose_a_result_is_in_the_language(self):
        page = self.open(fragment({"a.orb": "print 1\n"}, name="Ada Lovelace", task="# Hello"))
        self.assertIn("Abgegeben von „Ada Lovelace“.", page.evaluate(f"{by_id('came')}.textContent"))

    def test_a_run_goes_on_in_another_language(self):
        page = self.open(fragment({"a.bas": '10 goroll 0, 60, 1\n20 print "tick"\n30 delay 200\n40 goto 20\n'}), tags=("en",))
        page.evaluate(click("run"))
        ticks = "document.querySelectorAll('#events .print').length"
        page.wait(f"{ticks} > 1", 30)
        self.choose(page, "de")
        page.wait(f"{ticks} > 5", 30)
        self.assertEqual(page.evaluate(f"{by_id('run-words')}.textContent"), "Stopp")
        page.evaluate(stop)

    def test_blocks_change_their_language(self):
        page = self.open(fragment({"a.orb": "repeat 4\n  goroll 0, 80, 1\nend repeat\n"}), tags=("en",))
        page.evaluate(click("as-blocks"))
        words = "[...document.querySelectorAll('#blocks .blocklyBlockCanvas .blocklyText')].map(one => one.textContent.trim()).join(' ')"
        page.wait(f"({words}).includes('repeat')", 60)
        self.choose(page, "de")
        page.wait(f"({words}).includes('wiederhole')", 60)

    def test_a_language_that_cannot_be_loaded_leaves_english(self):
        server = site_server.Site(folder, without=["languages/es.json"])
        self.addCleanup(server.close)
        page = self.open(tags=("es",), server=server)
        self.assertEqual(page.evaluate(f"{by_id('run-words')}.textContent"), "Run")
        self.assertIn("Español could not be loaded", page.evaluate(f"{by_id('status')}.textContent"))

    def test_what_somebody_wrote_is_nobodys_to_translate(self):
        page = self.open(fragment({"Run.orb": "print \"Run\"\nprint \"Close\"\n"}))
        page.evaluate(click("instant"))
        page.wait(f"{played} && {idle}", 60)
        self.assertEqual(page.evaluate("[...document.querySelectorAll('#events .print .words')].map(one => one.textContent)"), ["Run", "Close"])
        self.assertIn('print "Run"', page.evaluate("document.querySelector('.cm-content').textContent"))

    def test_findings_are_said_in_the_language(self):
        for code, said in [("de", "ist weder ein Befehl noch ein sub"), ("es", "no es ni una instrucción ni un sub"), ("fr", "n'est ni une instruction ni un sub")]:
            page = self.open(fragment({"a.orb": "dealy 2s\n"}), tags=(code,))
            page.wait("document.querySelectorAll('#findings li').length > 0")
            self.assertIn(said, page.evaluate(f"{by_id('findings')}.textContent"))

    if picture_folder:
        def test_pictures(self):
            for code in codes:
                for name, width, height, mobile in [("wide", 1366, 768, False), ("phone", 390, 844, True)]:
                    page = self.open("#lesson=lessons/02-one-metre", tags=(code,), width=width, height=height, mobile=mobile)
                    page.evaluate(wait(500))
                    page.picture(os.path.join(picture_folder, f"{code}-{name}.png"))


if __name__ == "__main__":
    if not chromium.find() or not os.path.exists(os.path.join(folder, "orb.wasm")):
        print("skipped: no Chromium, or nothing built: ./dev playground")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:], verbosity=2)
