"""Virtual robots for pytest: the fixtures `robot`, `robots` and `world`.

    def test_drives(robot):
        MyClient(robot).forward(50)
        assert robot.place.near(0, 50, by=5)

A mark says which robot it is: @pytest.mark.robot("mini", fault="drop=1%"). Where a test fails, the path of a page that
plays back what its robots did is printed.
"""
from __future__ import annotations

import pathlib
import re

import pytest

from .robot import Robot, World


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("orb", "virtual Sphero robots")
    group.addoption("--robot", default="bolt", metavar="KIND", help="the kind of robot (bolt)")
    group.addoption("--robot-seed", type=int, default=1, metavar="N", help="seeds noise and addresses (1)")
    group.addoption("--robot-fault", default="", metavar="PLAN", help="a bad link, such as drop=1%%,delay=50..300ms")
    group.addoption("--robot-course", default="", metavar="FILE", help="an SVG with walls")
    group.addoption("--robot-reports", default="", metavar="FOLDER",
                    help="where pages of failed tests go (a temporary folder)")


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "robot(kind, seed=, fault=, course=, firmware=, place=, heading=): which virtual "
                                       "robot a test drives")


class _Options(dict):
    """What the command line says of robots, and then the mark of a test."""

    def __init__(self, request: pytest.FixtureRequest):
        option = request.config.getoption
        super().__init__(kind=option("--robot"), seed=option("--robot-seed"), fault=option("--robot-fault"),
                         course=option("--robot-course"))
        for mark in reversed(list(request.node.iter_markers("robot"))):
            if mark.args:
                self["kind"] = mark.args[0]
            self.update(mark.kwargs)

    def of_world(self) -> dict:
        """Without the course, which is the world's."""
        return {key: value for key, value in self.items() if key != "course"}


_seen = pytest.StashKey[list]()


def _watch(request: pytest.FixtureRequest, seen: Robot | World) -> None:
    request.node.stash.setdefault(_seen, []).append(seen)


@pytest.fixture
def world(request: pytest.FixtureRequest) -> World:
    """A floor for several robots, with the walls of --robot-course or the mark."""
    made = World(_Options(request)["course"])
    _watch(request, made)
    return made


@pytest.fixture
def robot(request: pytest.FixtureRequest) -> Robot:
    """A robot, connected; in `world`, where the test has that fixture, too."""
    options = _Options(request)
    if "world" in request.fixturenames:
        made = request.getfixturevalue("world").add(**options.of_world())
    else:
        made = Robot(**options)
        _watch(request, made)
    made.connect()
    return made


@pytest.fixture
def robots(request: pytest.FixtureRequest, world: World):
    """robots(3) gives three connected robots on one floor, 40 cm apart, each with a seed of its own."""
    options = _Options(request).of_world()
    first = options.pop("seed")

    def make(count: int, **others: object) -> list[Robot]:
        made = [world.add(**{**options, "seed": first + len(world.robots), **others}) for _ in range(count)]
        for one in made:
            one.connect()
        return made

    return make


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo):
    outcome = yield
    report = outcome.get_result()
    if report.when != "call" or not report.failed:
        return
    for number, seen in enumerate(item.stash.get(_seen, []), 1):
        report.sections.append(("robot", f"what it did: {_page(item, seen, number)}"))


def _page(item: pytest.Item, seen: Robot | World, number: int) -> str:
    """Writes the page of a failed test, and says where it is."""
    name = re.sub(r"[^\w.-]+", "-", item.name).strip("-") + ("" if number == 1 else f"-{number}")
    folder = item.config.getoption("--robot-reports")
    place = pathlib.Path(folder) if folder else item.config._tmp_path_factory.mktemp("orb")
    try:
        place.mkdir(parents=True, exist_ok=True)
        path = place / f"{name}.html"
        seen.report(path, title=item.nodeid)
    except (OSError, ValueError) as why:
        return f"no page could be written: {why}"
    return str(path)
