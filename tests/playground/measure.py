#!/usr/bin/env python3
"""Measures size and load times of the playground for the table in docs/inside/performance.md. usage: measure.py FOLDER"""

import os
import statistics
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "report"))
import browser as chromium
import site_server
import weight

folder = os.path.abspath(sys.argv[1])
rounds = 7
settle = 3 # seconds: a browser compiles on when a page can run already; the next visitor has a processor of his own


def load(browser, server):
    page = browser.page(fresh=True)
    page.resize(1280, 860)
    page.go(server.url)
    page.wait("document.documentElement?.dataset.ready")
    page.wait("performance.getEntriesByName('first-contentful-paint').length")
    paint = page.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime")
    return page, paint, float(page.evaluate("document.documentElement.dataset.ready"))


def newcomer(browser, server):
    """Measures from the first paint until the ball moves, with Run pressed at once."""
    page = browser.page(fresh=True)
    page.go(server.url)
    page.wait("document.readyState === 'complete'")
    page.evaluate("document.getElementById('run').click()")
    page.wait("document.querySelectorAll('#map .run').length > 0")
    took = page.evaluate("performance.now() - performance.getEntriesByName('first-contentful-paint')[0].startTime")
    page.close()
    time.sleep(settle)
    return took


keystroke = """new Promise(done => {
  const list = document.getElementById('findings'), began = performance.now(), there = list.children.length;
  const watch = new MutationObserver(() => { if (list.children.length !== there) { watch.disconnect(); done(performance.now() - began); } });
  watch.observe(list, { childList: true });
  document.execCommand(...(there ? ['delete'] : ['insertText', false, '@']));
})"""


def row(name, values, unit, digits=0):
    print(f"{name:46}{min(values):8.{digits}f}{statistics.median(values):8.{digits}f}{max(values):8.{digits}f} {unit}")


for words, names in (("a first visit", "core"), ("on demand", "on_demand")):
    sizes = weight.weights(folder, names)
    print(f"brotli, KB, {words}: " + ", ".join(f"{name} {size / 1000:.0f}" for name, size in sorted(sizes.items(), key=lambda one: -one[1]) if size > 1000)
          + f"; all {sum(sizes.values()) / 1000:.0f}")
server, browser = site_server.Site(folder), chromium.Browser(chromium.find())
try:
    loads = []
    for _ in range(rounds):
        if loads:
            loads[-1][0].close()
        time.sleep(settle)
        loads.append(load(browser, server))
    print(f"{'':46}{'least':>8}{'median':>8}{'most':>8}")
    row("first paint", [paint for _, paint, _ in loads], "ms")
    row("from first paint to a program that can run", [max(0, ready - paint) for _, paint, ready in loads], "ms")
    row("from first paint to a ball that moves", [newcomer(browser, server) for _ in range(rounds)], "ms")
    page = loads[-1][0]
    time.sleep(settle)
    page.wait("document.querySelector('.tok-keyword') !== null")
    page.evaluate("document.querySelector('.cm-content').focus()")
    page.key("End", modifiers=2)
    row("from a keystroke to its finding", [page.evaluate(keystroke) for _ in range(40)][4:], "ms", 1)
finally:
    browser.close()
    server.close()
