"""A client library tested on a virtual robot, in no time: `pytest-3 examples/python`, with orb_robot installed
(docs/using/python.md)."""
import pytest

orb_robot = pytest.importorskip("orb_robot", reason="orb_robot is not installed")
from orb_robot.shapes import drove_square  # noqa: E402


class Client:
    """The smallest client that can drive: it has a robot to write to, and lets time pass."""

    def __init__(self, robot):
        self.robot = robot
        self.tell("wake")
        robot.advance(1)

    def tell(self, command, *values):
        self.robot.write(orb_robot.encode(command, *values, kind=self.robot.kind))

    def roll(self, heading, speed, seconds):
        self.tell("drive-with-heading", speed, heading, 0)
        self.robot.advance(seconds)
        self.tell("drive-with-heading", 0, heading, 0)
        self.robot.advance(1.5)


@pytest.mark.robot("bolt")
def test_drives_a_square(robot):
    client = Client(robot)
    for heading in (0, 90, 180, 270):
        client.roll(heading, 60, 1.2)
    assert drove_square(robot, by=10)


@pytest.mark.robot("mini")
def test_runs_into_a_wall_and_stops(robot):
    robot.stimulus("wall y=40")
    Client(robot).roll(0, 120, 1.5)
    assert robot.state().bumps and robot.place.y < 40 and robot.speed < 1
