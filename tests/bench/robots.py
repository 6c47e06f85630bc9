#!/usr/bin/env python3
"""robots.py BUILD: measures robots in Python: a round trip, a thousand robots for a minute, the import, fifty tests in
parallel. Some figures are relative to the same calls without robots."""
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

build = os.path.abspath(sys.argv[1])
sys.path.insert(0, os.path.join(build, "python"))
from orb_robot import Robot, encode  # noqa: E402


def timed(act, runs=5):
    times = []
    for _ in range(runs):
        begin = time.perf_counter()
        act()
        times.append(time.perf_counter() - begin)
    return statistics.median(times)


def round_trips(count=20_000):
    robot, ping = Robot("bolt"), encode("ping")
    robot.connect()
    for _ in range(count):
        robot.write(ping)
        robot.advance(0.0001)
        robot.read()


def thousand(journey):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    robots = [Robot("bolt", seed=seed, journey=journey) for seed in range(1, 1001)]
    for robot in robots:
        robot.connect()
        robot.write(encode("wake"))
    for second in range(60):
        packet = encode("drive-with-heading", 80, second % 4 * 90, 0)
        for robot in robots:
            robot.write(packet)
            robot.advance(1)
            robot.read()
    return (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 // len(robots)


def run(*command, cwd=None):
    environment = {**os.environ, "PYTHONPATH": os.path.join(build, "python")}
    subprocess.run([sys.executable, *command], check=True, env=environment, cwd=cwd, stdout=subprocess.DEVNULL)


print(f"write, advance, read: {timed(round_trips) / 20_000 * 1e6:.1f} us")
for journey in (False, True):
    begin = time.perf_counter()
    size = thousand(journey)
    print(f"1,000 robots x 60 s, journey={journey}: {time.perf_counter() - begin:.1f} s, {size:,} bytes a robot")
bare, with_it = timed(lambda: run("-c", "pass"), 11), timed(lambda: run("-c", "import orb_robot"), 11)
print(f"import: {1000 * (with_it - bare):.0f} ms more than python3 alone, which takes {1000 * bare:.0f}")
with tempfile.TemporaryDirectory() as folder:
    with open(os.path.join(folder, "test_it.py"), "w", encoding="utf-8") as file:
        file.write("import pytest\n@pytest.mark.parametrize('number', range(50))\n"
                   "def test_it(robot, number):\n  robot.advance(60)\n")
    print(f"50 tests with pytest -n 2: {timed(lambda: run('-m', 'pytest', '-q', '-n', '2', cwd=folder), 1):.1f} s")
