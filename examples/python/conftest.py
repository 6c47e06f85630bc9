"""Two fixtures for pytest: a virtual ball to talk to, and what a program does on one.

`orb` is found on the PATH; the variable ORB names another.
"""
import json
import os
import subprocess

import pytest

ORB = os.environ.get("ORB", "orb")


@pytest.fixture
def ball():
    """The address (host, port) of a virtual ball of this test's own."""
    with subprocess.Popen([ORB, "ball", "--tcp", "127.0.0.1:0"], stdout=subprocess.PIPE, text=True) as process:
        host, port = process.stdout.readline().split()[-1].rsplit(":", 1)
        yield host, int(port)
        process.terminate()


@pytest.fixture
def run():
    """run("square.orb", "--seed", "2") gives the events of a run, a dictionary each (docs/reference/traces.md)."""

    def run(*arguments):
        command = [ORB, "run", *arguments, "--trace", "json"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode in (0, 1), done.stderr  # 1: a fault of the program, an event like others
        return [json.loads(line) for line in done.stdout.splitlines()]

    return run
