"""Finds the package: on PYTHONPATH, otherwise in the folder of the build."""

import importlib.util
import os
import subprocess
import sys

import pytest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def _package_folder():
    found = importlib.util.find_spec("orb_robot")
    if found is not None:
        return os.path.dirname(list(found.submodule_search_locations)[0])
    return os.path.join(ROOT, "build", "dev", "python")


PACKAGE = _package_folder()
if PACKAGE not in sys.path:
    sys.path.insert(0, PACKAGE)


class Outcome:
    """The result of a program: exit code and output."""

    def __init__(self, done):
        self.code = done.returncode
        self.out = done.stdout
        self.err = done.stderr


def start(arguments, folder, **more):
    """Runs Python with the package on its path."""
    environment = dict(os.environ, PYTHONPATH=PACKAGE, PYTHONDONTWRITEBYTECODE="1")
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=120,
        **more,
    )


@pytest.fixture
def virtually(tmp_path):
    """Runs a program in virtual time, without robots."""

    def run(program, begin="from orb_robot import virtual_time; virtual_time.install()\n"):
        file = tmp_path / "program.py"
        file.write_text(begin + program)
        return Outcome(start([str(file)], tmp_path))

    return run


@pytest.fixture
def with_robots(tmp_path):
    """Runs a program with `orb_robot run` and options."""

    def run(program, *options, **more):
        file = tmp_path / "program.py"
        file.write_text(program)
        return Outcome(start(["-m", "orb_robot", "run", *options, str(file)], tmp_path, **more))

    return run
