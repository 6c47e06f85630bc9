#!/usr/bin/env python3
"""Takes the pictures in docs/using/playground/ again. usage: pictures.py FOLDER [NAME...]

FOLDER is what `./dev playground` built. NAME `icons` draws the icons of the installed page from icon.svg. Needs Chromium,
and pngquant, which gives each picture a palette."""

import json
import os
import subprocess
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, "..", "report"))
import browser as chromium
import site_server

out = os.path.join(here, "../../docs/using/playground")
by_id = lambda name: f"document.getElementById('{name}')"
click = lambda name: f"{by_id(name)}.click()"
pause = lambda ms: f"new Promise(done => setTimeout(done, {ms}))"
idle = f"!{by_id('run')}.classList.contains('stop')"
played = f"!{by_id('played')}.classList.contains('idle')"


def first(page):
    page.wait("document.querySelector('.cm-line [class^=tok-]') !== null")


def instant(page):
    page.evaluate(click("instant"))
    page.wait(f"{played} && {idle}", 60)
    page.evaluate(f"{by_id('time')}.value = {by_id('time')}.max; {by_id('time')}.dispatchEvent(new Event('input'))")
    page.evaluate(pause(500))


def play(page):
    page.evaluate("document.querySelector('[data-view=play]').click()")


def lesson_done(page):
    page.wait(f"!{by_id('task')}.hidden")
    page.evaluate(click("solution"))
    page.evaluate(click("test"))
    page.wait(f"{by_id('verdicts')}.classList.contains('all-passed')", 60)
    page.evaluate("document.querySelector('#verdict-list button').click()")
    page.wait(f"{played} && {idle}", 30)
    page.evaluate(pause(4500))


def cards(page):
    page.evaluate(click("pick"))
    page.wait("document.querySelectorAll('.cards > li').length > 20")
    page.evaluate("document.activeElement.blur()")


def shared(page):
    page.evaluate(click("share"))
    page.wait("document.querySelector('#share-code svg') !== null")


def sheet(page):
    page.wait(f"!{by_id('task')}.hidden")
    page.evaluate(click("solution"))
    instant(page)
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.call("Emulation.setEmulatedMedia", media="print")
    page.evaluate(pause(300))


def blocks(page):
    page.evaluate(click("as-blocks"))
    page.wait("document.querySelectorAll('#blocks .blocklySvg .blocklyBlockCanvas .blocklyText').length > 10", 60)
    page.evaluate(pause(600))


def on_phone(page):
    instant(page)
    play(page)
    page.evaluate(pause(400))


# name: page, width, height, colours, actions
pictures = {
    "first": ("", 1366, 768, "light", first),
    "run": ("#example=flower.orb", 1366, 768, "light", instant),
    "lesson": ("#lesson=lessons/03-square", 1366, 768, "light", lesson_done),
    "cards": ("", 1366, 768, "light", cards),
    "dark": ("#example=hall.orb", 1366, 768, "dark", instant),
    "phone": ("#lesson=lessons/03-square", 390, 844, "light", lambda page: page.wait(f"!{by_id('task')}.hidden")),
    "phone-dark": ("#example=star.orb", 390, 844, "dark", on_phone),
    "blocks": ("#example=dance.orb", 1366, 768, "light", blocks),
    "share": ("#example=spiral.orb", 1366, 768, "light", shared),
    "sheet": ("#lesson=lessons/03-square", 794, 1123, "light", sheet),
}


def squeeze(path):
    subprocess.run(["pngquant", "--nofs", "--strip", "--force", "--ext", ".png", "64", path], check=True)
    print(f"{os.path.basename(path)}: {os.path.getsize(path)} bytes")


# name: size in pixels, share that the ball fills, background
icons = {"icon-192": (192, 1, "transparent"), "icon-512": (512, 1, "transparent"), "icon-maskable": (512, .7, "#efedf9")}


def draw_icons(browser):
    with open(os.path.join(here, "../../playground/icon.svg"), encoding="utf-8") as file:
        drawing = file.read()
    for name, (size, share, ground) in icons.items():
        page = browser.page(fresh=True)
        page.resize(size, size)
        page.call("Emulation.setDefaultBackgroundColorOverride", color={"r": 0, "g": 0, "b": 0, "a": 0})
        page.evaluate(f"document.body.style = 'margin: 0; height: {size}px; display: grid; place-items: center; background: {ground}'")
        page.evaluate(f"document.body.innerHTML = {json.dumps(drawing)}; document.body.firstChild.style.width = '{share * size}px'")
        path = os.path.join(here, f"../../playground/{name}.png")
        page.picture(path)
        page.close()
        squeeze(path)


def take(browser, url, name):
    where, width, height, colours, deed = pictures[name]
    page = browser.page(fresh=True)
    page.resize(width, height, width < 500)
    page.prefer(colours)
    page.go(url + where)
    page.wait("document.documentElement.dataset.ready")
    page.evaluate(pause(600))
    deed(page)
    path = os.path.join(out, f"{name}.png")
    page.picture(path)
    page.close()
    squeeze(path)


def main():
    server, browser = site_server.Site(sys.argv[1]), chromium.Browser(chromium.find())
    os.makedirs(out, exist_ok=True)
    try:
        for name in sys.argv[2:] or pictures:
            draw_icons(browser) if name == "icons" else take(browser, server.url, name)
    finally:
        browser.close()
        server.close()


if __name__ == "__main__":
    main()
