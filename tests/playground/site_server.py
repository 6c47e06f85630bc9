"""A plain web server for the built playground, and a check of the links in its pages."""

import functools
import html.parser
import http.server
import os
import re
import socket
import subprocess
import threading
import urllib.parse


class Handler(http.server.SimpleHTTPRequestHandler):
    wire = None  # where mocked ports of the browser lead

    def __init__(self, *arguments, without=frozenset(), asked=None, **more):
        self._without = without
        self._asked = asked
        super().__init__(*arguments, **more)

    def log_message(self, *_):
        pass

    def do_POST(self):
        data = self.rfile.read(int(self.headers["Content-Length"]))
        self.send_response(200 if Handler.wire.write(data) else 410)
        self.end_headers()

    def do_GET(self):
        if self._asked is not None:
            self._asked.add(self.path)
        if self.path.lstrip("/") in self._without:
            return self.send_error(404)
        if self.path != "/wire/read":
            return super().do_GET()
        data = Handler.wire.read()
        self.send_response(410 if data is None else 200)
        self.end_headers()
        self.wfile.write(data or b"")


class Server(http.server.ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, *_):
        pass  # a browser that hung up


class Site:
    def __init__(self, folder, without=()):
        """`without`: names of files that are not found while they are in the set. `asked`: the requested paths."""
        self.without = set(without)
        self.asked = set()
        handler = functools.partial(Handler, directory=folder, without=self.without, asked=self.asked)
        self._server = Server(("127.0.0.1", 0), handler)
        self.url = f"http://127.0.0.1:{self._server.server_port}/"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def close(self):
        self._server.shutdown()
        self._server.server_close()


class _Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.ids = [], set()

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if "id" in attributes:
            self.ids.add(attributes["id"])
        link = attributes.get("href") or attributes.get("src")
        if link:
            self.links.append(link)


def dead_links(folder):
    """Returns the broken links within `folder`, as `page: link`."""
    pages = {}
    for place, _, names in os.walk(folder):
        for name in names:
            if name.endswith(".html"):
                path = os.path.join(place, name)
                pages[path] = _Page()
                with open(path, encoding="utf-8") as file:
                    pages[path].feed(file.read())
    dead = []
    for path, page in pages.items():
        for link in page.links:
            where = urllib.parse.urlsplit(link)
            if where.scheme:
                continue
            target = os.path.normpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(where.path))) if where.path else path
            anchor = urllib.parse.unquote(where.fragment)
            known = os.path.exists(target) and (not anchor or "=" in anchor or target not in pages or anchor in pages[target].ids)
            if not known:
                dead.append(f"{os.path.relpath(path, folder)}: {link}")
    return dead


class Wire:
    """An `orb ball` behind the web server, for a mocked port of the browser: /wire/write sends to the ball, /wire/read waits
    for its output. The link breaks after `cut` bytes. state() is what the ball itself knows."""

    def __init__(self, orb, *options, cut=None):
        self._process = subprocess.Popen([orb, "ball", "--tcp", "127.0.0.1:0", "--control", *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, bufsize=1)
        line = self._process.stdout.readline()
        host, port = re.search(r"(127\.0\.0\.1):(\d+)", line).groups()
        self._socket = socket.create_connection((host, int(port)))
        self._socket.settimeout(0.2)
        self.sent = b""
        self._cut = cut

    def write(self, data):
        if self._cut is not None and len(self.sent) + len(data) > self._cut:
            return False
        self.sent += data
        self._socket.sendall(data)
        return True

    def read(self):
        """None once the link is gone."""
        if self._cut is not None and len(self.sent) >= self._cut:
            return None
        try:
            return self._socket.recv(4096)
        except TimeoutError:
            return b""
        except OSError:
            return None

    def state(self):
        """As the control line `state` has it; numbers where there are some."""
        self._process.stdin.write("state\n")
        values = (word.split("=") for word in self._process.stdout.readline().split())
        return {name: float(value) if re.fullmatch(r"-?[\d.]+", value) else value for name, value in values}

    def tell(self, stimulus):
        """Something happens to it."""
        self._process.stdin.write(f"{stimulus}\n")
        self._process.stdout.readline()

    def close(self):
        self._socket.close()
        self._process.terminate()
        self._process.wait()
        self._process.stdin.close()
        self._process.stdout.close()
