"""Paths and what they look like."""
import math

import pytest

from orb_robot import Robot, encode
from orb_robot.shapes import corners, drove_polygon, drove_square


def along(*places, step=2.0):
    """A path with a place every two centimetres."""
    out = []
    for (x, y), (to_x, to_y) in zip(places, places[1:]):
        count = max(1, round(math.hypot(to_x - x, to_y - y) / step))
        out += [(x + (to_x - x) * i / count, y + (to_y - y) * i / count) for i in range(count)]
    return out + [places[-1]]


SQUARE = [(0, 0), (0, 50), (50, 50), (50, 0), (0, 0)]


def test_finds_corners():
    assert corners(along(*SQUARE)) == SQUARE
    assert corners([]) == [] and corners([(1, 1)]) == [(1, 1)]


@pytest.mark.parametrize("path, sentence", [
    (SQUARE[:-1], "3 straight sides, not 4"),
    (SQUARE[:-1] + [(0, 30)], "ends 30 cm from where it began"),
    ([(0, 0), (0, 90), (50, 90), (50, 0), (0, 0)], "side 1 is 90 cm long, not 50"),
    ([(0, 0), (25, 43), (75, 43), (50, 0), (0, 0)], "turn 1 is 60 degrees, not 90"),
    ([], "0 straight sides"),
])
def test_says_why_it_is_no_square(path, sentence):
    match = drove_square(along(*path) if path else [], side=50, by=8)
    assert not match and sentence in repr(match)


def test_knows_squares_and_others():
    assert drove_square(along(*SQUARE), side=50)
    assert drove_square(along(*reversed(SQUARE)))
    hexagon = [(60 * math.sin(math.radians(60 * i)), 60 * math.cos(math.radians(60 * i))) for i in range(7)]
    assert drove_polygon(along(*hexagon), 6, side=60) and not drove_square(along(*hexagon))


def test_a_robot_drives_a_square():
    robot = Robot("bolt")
    robot.connect()
    robot.write(encode("wake"))
    robot.advance(1)
    for heading in (0, 90, 180, 270):
        robot.write(encode("drive-with-heading", 60, heading, 0))
        robot.advance(1.2)
        robot.write(encode("drive-with-heading", 0, heading, 0))
        robot.advance(1.5)
    assert drove_square(robot, by=8)
