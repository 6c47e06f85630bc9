"""What a client library of others writes for whole programs, played to robots without the library."""
import pathlib

import pytest

from orb_robot import Robot, decode

FOLDER = pathlib.Path(__file__).parent / "sequences"


def lines(kind):
    for line in (FOLDER / f"{kind}.txt").read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            t, packet = line.split()
            yield float(t), bytes.fromhex(packet)


def play(kind, size=20):
    """The robot at the end, what it said, and the lamp at each packet. Pieces have so many bytes."""
    robot, said, lamps = Robot(kind), b"", []
    robot.connect()
    for t, packet in lines(kind):
        robot.advance(t - robot.now)
        for at in range(0, len(packet), size):
            robot.write(packet[at:at + size])
        said += robot.read()
        lamps.append(robot.lamp)
    robot.advance(0.5)
    return robot, said + robot.read(), lamps


@pytest.mark.parametrize("kind", ["bolt", "mini", "sprk+"])
def test_every_command_is_obeyed(kind):
    _, said, lamps = play(kind)
    answers = [one for one in decode(said, direction="from-robot") if one.startswith("response")]
    assert len(answers) == len(lamps)
    assert [one for one in answers if "err 00" not in one and "mrsp 00" not in one] == []


@pytest.mark.parametrize("kind", ["bolt", "mini", "sprk+"])
def test_it_drives_a_square_and_on(kind):
    robot, _, lamps = play(kind)
    assert robot.place.x < -30 and abs(robot.place.y) < 15 and lamps[-2] == "blue"
    assert max(one.y for one in robot.path()) > 30 and max(one.x for one in robot.path()) > 30


@pytest.mark.parametrize("kind", ["bolt", "sprk+"])
def test_pieces_of_any_size_are_the_same(kind):
    whole, pieces = play(kind, 100), play(kind, 3)
    assert whole[1] == pieces[1] and whole[0].place == pieces[0].place
