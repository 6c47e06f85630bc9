"""Runs the code in docs/using/python.md and the examples."""
import os
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).parents[2]
PAGE = (ROOT / "docs/using/python.md").read_text(encoding="utf-8")
# Parts that a reader must supply are missing here.
BLOCKS = [block for block in re.findall(r"```python\n(.*?)```", PAGE, re.S) if "MyClient" not in block]


@pytest.mark.parametrize("block", BLOCKS, ids=range(len(BLOCKS)))
def test_examples_of_the_page(block):
    exec(compile(block, "docs/using/python.md", "exec"), {})


def test_the_picture_is_what_a_notebook_shows():
    cell = {}
    exec(next(block for block in BLOCKS if block.rstrip().endswith("# the last line of a cell")), cell)
    assert cell["robot"]._repr_svg_() == (ROOT / "docs/using/python.svg").read_text(encoding="utf-8")


def test_the_page_has_examples():
    assert len(BLOCKS) >= 2


def test_the_example_of_a_client():
    done = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test_square.py"],
                          cwd=ROOT / "examples/python", env=os.environ, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and "2 passed" in done.stdout, done.stdout + done.stderr


@pytest.mark.parametrize("kind", ["bolt", "mini"])
def test_the_example_for_a_real_robot(kind, tmp_path):
    command = [sys.executable, "-m", "orb_robot", "run", "square.py", "--robot", kind, "--fast", "--report", tmp_path / "r.html"]
    done = subprocess.run(command, cwd=ROOT / "examples/python", capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and "back at S" in done.stdout, done.stdout + done.stderr
    assert (tmp_path / "r.html").exists()
