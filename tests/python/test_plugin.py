"""The pytest fixtures, used as in another project."""
import os
import re
import subprocess
import sys

TESTS = '''
import pytest
from orb_robot import encode

def test_one(robot):
    assert robot.connected and robot.kind == "bolt"

@pytest.mark.robot("mini", seed=7, fault="drop=1%")
def test_marked(robot):
    assert robot.kind == "mini" and robot.name.endswith("0007")

def test_three(robots, world):
    red, green, blue = robots(3)
    assert len({one.address for one in (red, green, blue)}) == 3
    world.advance(1)
    assert blue.now == 1 and blue.place == (80, 0)

def test_in_one_world(robot, world):
    assert world.robots == [robot]

def test_fails(robot):
    robot.write(encode("wake"))
    robot.write(encode("drive-with-heading", 80, 0, 0))
    robot.advance(1)
    assert robot.place.near(0, 0, by=1)
'''


def pytest_in(folder, *arguments):
    # Tests of other projects run with the same package, but without our options.
    environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTEST_")}
    return subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments], cwd=folder,
                          env=environment, capture_output=True, text=True, timeout=60)


def test_fixtures(tmp_path):
    (tmp_path / "test_it.py").write_text(TESTS)
    done = pytest_in(tmp_path, "--robot-reports", "pages")
    assert "1 failed, 4 passed" in done.stdout, done.stdout + done.stderr
    assert re.search(r"what it did: pages.test_fails\.html", done.stdout)
    assert "<html" in (tmp_path / "pages" / "test_fails.html").read_text(encoding="utf-8")


def test_options(tmp_path):
    (tmp_path / "test_it.py").write_text("def test_it(robot):\n  assert robot.kind == 'rvr' and robot.name == 'RV-0009'\n")
    assert pytest_in(tmp_path, "--robot", "rvr", "--robot-seed", "9").returncode == 0
    wrong = pytest_in(tmp_path, "--robot", "blot")
    assert wrong.returncode == 1 and "did you mean `bolt`" in wrong.stdout


def test_in_parallel(tmp_path):
    pytest_xdist = __import__("importlib.util").util.find_spec("xdist")
    (tmp_path / "test_it.py").write_text(
        "import pytest\n@pytest.mark.parametrize('number', range(50))\n"
        "def test_it(robot, number):\n  robot.advance(60)\n  assert robot.now == 60\n")
    done = pytest_in(tmp_path, *(["-n", "2"] if pytest_xdist else []))
    assert "50 passed" in done.stdout, done.stdout + done.stderr
