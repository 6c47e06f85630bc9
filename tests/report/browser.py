"""A headless Chromium, driven over a pipe by its DevTools protocol; the standard library only."""

import base64
import itertools
import json
import os
import select
import shutil
import subprocess
import tempfile
import time


def environment(home):
    """For a browser whose font cache, settings and crash reports lie in `home`, not in the user's."""
    return {**{name: value for name, value in os.environ.items() if not name.startswith("XDG_")}, "HOME": home, "TMPDIR": home}


def find():
    """The path of an installed Chromium, or None."""
    for name in ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable"):
        if path := shutil.which(name):
            return path
    return None


class OnItsWay(AssertionError):
    """The page was asked while another one took its place."""


class Page:
    def __init__(self, browser, session):
        self._browser = browser
        self._session = session
        self.complaints = []
        self.requests = []
        for domain in ("Page", "Runtime", "Network"):
            self.call(f"{domain}.enable")

    def call(self, method, **params):
        return self._browser.call(method, params, self._session)

    def on_event(self, method, params):
        if method == "Runtime.exceptionThrown":
            details = params["exceptionDetails"]
            self.complaints.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning"):
            self.complaints.append(str(params["args"]))
        elif method == "Network.requestWillBeSent":
            self.requests.append(params["request"]["url"])

    def open(self, path):
        self.go("file://" + path)

    def go(self, url):
        self.call("Page.navigate", url=url)
        self.wait("document.readyState === 'complete'")

    def close(self):
        self.call("Page.close")

    def picture(self, path):
        """What is seen now, as a PNG."""
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))

    def evaluate(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in answer:
            raise AssertionError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def wait(self, expression, seconds=20):
        """Until the page says so; a page that never does is a failure."""
        limit = time.monotonic() + seconds
        while not self._is_true(expression):
            if time.monotonic() > limit:
                raise AssertionError(f"never became true: {expression}")
            self._browser.listen(0.02)

    def _is_true(self, expression):
        try:
            return self.evaluate(expression)
        except OnItsWay:
            return False

    def key(self, key, modifiers=0):
        text = {"text": key} if len(key) == 1 else {}
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, modifiers=modifiers, **text)
            text = {}

    def resize(self, width, height, mobile=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=mobile)

    def prefer(self, scheme):
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": scheme}])


class Browser:
    def __init__(self, path):
        self._home = tempfile.TemporaryDirectory(prefix="orb-report.", ignore_cleanup_errors=True)
        to_read, self._write = os.pipe()
        self._read, to_write = os.pipe()

        def hand_over():
            # Chromium reads commands from 3 and writes answers to 4.
            spare_in, spare_out = os.dup(to_read), os.dup(to_write)
            os.dup2(spare_in, 3)
            os.dup2(spare_out, 4)

        self._process = subprocess.Popen(
            [path, "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run",
             "--disable-dev-shm-usage", "--hide-scrollbars", "--remote-debugging-pipe",
             f"--user-data-dir={self._home.name}", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, close_fds=False,
            env=environment(self._home.name),
            preexec_fn=hand_over)
        os.close(to_read)
        os.close(to_write)
        self._numbers = itertools.count(1)
        self._answers = {}
        self._pages = {}
        self._rest = b""
        self._traced, self._traces = [], False

    def longest_tasks(self, seconds):
        """The processor time, in ms, of the tasks of the pages' main threads within `seconds`, the longest first.
        Unlike the time that passes it does not depend on what else this machine has to do."""
        self._traced, self._traces = [], True
        self.call("Tracing.start", {"traceConfig": {"includedCategories": ["toplevel"], "excludedCategories": ["*"]}})
        limit = time.monotonic() + seconds
        while time.monotonic() < limit:
            self.listen(0.1)
        self.call("Tracing.end", {})
        while self._traces:
            self.listen(0.1)
        main = {(one["pid"], one["tid"]) for one in self._traced if one["name"] == "thread_name" and one["args"]["name"] == "CrRendererMain"}
        tasks = [one.get("tdur", 0) / 1000 for one in self._traced if one["name"].endswith("RunTask") and (one["pid"], one["tid"]) in main]
        return sorted(tasks, reverse=True)

    def close(self):
        try:
            self.call("Browser.close", {})
        except AssertionError:
            pass
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._home.cleanup()

    def page(self, fresh=False):
        """A new page; a `fresh` one knows nothing of what other pages kept."""
        where = {"browserContextId": self.call("Target.createBrowserContext", {})["browserContextId"]} if fresh else {}
        target = self.call("Target.createTarget", {"url": "about:blank", **where})["targetId"]
        session = self.call("Target.attachToTarget", {"targetId": target, "flatten": True})["sessionId"]
        page = Page.__new__(Page)
        self._pages[session] = page
        page.__init__(self, session)
        return page

    def listen(self, seconds):
        """Takes in what Chromium says within `seconds`; returns early after the first piece."""
        ready, _, _ = select.select([self._read], [], [], seconds)
        if not ready:
            return
        piece = os.read(self._read, 1 << 16)
        if not piece:
            raise AssertionError("chromium went away")
        *messages, self._rest = (self._rest + piece).split(b"\0")
        for message in map(json.loads, messages):
            if "id" in message:
                self._answers[message["id"]] = message
            elif message.get("method") == "Tracing.dataCollected":
                self._traced += message["params"]["value"]
            elif message.get("method") == "Tracing.tracingComplete":
                self._traces = False
            elif message.get("sessionId") in self._pages:
                self._pages[message["sessionId"]].on_event(message["method"], message["params"])

    def call(self, method, params, session=None, seconds=30):
        number = next(self._numbers)
        message = {"id": number, "method": method, "params": params}
        if session:
            message["sessionId"] = session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        limit = time.monotonic() + seconds
        while number not in self._answers:
            if time.monotonic() > limit:
                raise AssertionError(f"no answer to {method}")
            self.listen(0.1)
        answer = self._answers.pop(number)
        if "error" in answer:
            kind = OnItsWay if "navigated" in answer["error"]["message"] else AssertionError
            raise kind(f"{method}: {answer['error']}")
        return answer["result"]
