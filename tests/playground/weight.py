"""Measures what a visitor of the playground loads."""

import json
import os
import re
import subprocess


def brotli(path):
    return len(subprocess.run(["brotli", "-c", "-q", "11", path], stdout=subprocess.PIPE, check=True).stdout)


def listed(folder, names="core"):
    """Returns the files of a first visit, including those kept for offline use; with `names` "on_demand" those loaded on
    demand; with "soon" those of them that are kept soon."""
    with open(os.path.join(folder, "sw.js"), encoding="utf-8") as file:
        found = json.loads(re.search(rf"{names} = (\[.*?\])", file.read()).group(1))
    return found + (["sw.js"] if names == "core" else [])


def weights(folder, names="core"):
    """Returns the size of each in bytes."""
    return {name: brotli(os.path.join(folder, name)) for name in listed(folder, names)}
