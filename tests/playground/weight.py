"""What a visitor of the playground loads."""

import json
import os
import re
import subprocess


def brotli(path):
    return len(subprocess.run(["brotli", "-c", "-q", "11", path], stdout=subprocess.PIPE, check=True).stdout)


def weights(folder, names="core"):
    """The bytes of each file that a first visit loads, at once or to be kept for offline use; of those that are loaded when
    somebody asks for them, where `names` is "on_demand"; of those of them that are kept soon, "soon"."""
    with open(os.path.join(folder, "sw.js"), encoding="utf-8") as file:
        listed = json.loads(re.search(rf"{names} = (\[.*?\])", file.read()).group(1))
    return {name: brotli(os.path.join(folder, name)) for name in listed + (["sw.js"] if names == "core" else [])}
