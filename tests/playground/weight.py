"""What a visitor of the playground loads."""

import json
import os
import re
import subprocess


def brotli(path):
    return len(subprocess.run(["brotli", "-c", "-q", "11", path], stdout=subprocess.PIPE, check=True).stdout)


def weights(folder):
    """The bytes of each file that the service worker keeps, which are all that are loaded, and its own."""
    with open(os.path.join(folder, "sw.js"), encoding="utf-8") as file:
        core = json.loads(re.search(r"core = (\[.*?\])", file.read()).group(1))
    return {name: brotli(os.path.join(folder, name)) for name in core + ["sw.js"]}
