"""Robots on bytes, as Python programs use them."""
import os
import random
import sys
import threading

import pytest
from conftest import start

import orb_robot
from orb_robot import Lamp, Place, Robot, World, decode, encode


def awake(kind="bolt", **options):
    robot = Robot(kind, **options)
    robot.connect()
    robot.write(encode("wake" if encode_ping(kind)[:1] == b"\x8d" else "ping", kind=kind))
    robot.advance(3)
    robot.read()
    return robot


def encode_ping(kind):
    return encode("ping", kind=kind)


def test_kinds():
    assert {"sphero", "sprk+", "mini", "bolt", "rvr"} <= set(orb_robot.kinds())


@pytest.mark.parametrize("kind", orb_robot.kinds())
def test_each_kind_answers_a_ping(kind):
    robot = Robot(kind)
    robot.connect()
    robot.write(encode_ping(kind))
    robot.advance(0.1)
    assert robot.read()


def test_drives_where_it_is_told():
    robot = awake()
    robot.write(encode("drive-with-heading", 80, 90, 0))
    robot.advance(1)
    state = robot.state()
    assert state.place.x > 20 and abs(state.place.y) < 5
    assert state.driving and state.speed > 10
    assert robot.path()[-1].place == robot.place
    assert state.way > 20


def test_lamps_have_names():
    assert Lamp(255, 0, 0) == "red" and Lamp(40, 0, 0) == "red" and Lamp(0, 0, 0) == "black"
    assert Lamp(0, 255, 0) == "green" and Lamp(255, 0, 0) != "green"
    assert Lamp(1, 2, 3) == (1, 2, 3)
    with pytest.raises(ValueError, match="there is no colour 'rde'"):
        assert Lamp(255, 0, 0) == "rde"


def test_places_are_near():
    assert Place(3, 4).near(0, 0, by=5) and not Place(3, 4.1).near(0, 0, by=5)


@pytest.mark.parametrize("arguments, options, sentence", [
    (["blot"], {}, "did you mean `bolt`"),
    (["bolt"], {"fault": "drop=x"}, "percent"),
    (["sphero"], {"firmware": "sphero-9"}, "there is no firmware"),
    (["bolt"], {"course": "<svg"}, "course cannot be used"),
    (["bolt"], {"place": (float("nan"), 0)}, "cannot start at nan"),
])
def test_says_what_is_wrong(arguments, options, sentence):
    with pytest.raises(ValueError, match=sentence):
        Robot(*arguments, **options)


@pytest.mark.parametrize("options, sentence", [
    ({"kind": None}, "`kind` is a text, not None"),
    ({"kind": "b\ud800lt"}, "`kind` holds what is no text"),
    ({"seed": -1}, "`seed` is a whole number from 0 to 18446744073709551615, not -1"),
    ({"seed": 1.5}, "`seed` is a whole number"),
    ({"seed": 2**64}, "`seed` is a whole number"),
    ({"place": (1,)}, "`place` is two numbers, not \\(1,\\)"),
    ({"place": "ab"}, "`place` is two numbers"),
    ({"heading": "north"}, "`heading` is a number, not 'north'"),
    ({"fault": 1}, "`fault` is a text"),
    ({"firmware": 3.51}, "`firmware` is a text"),
    ({"course": 5}, "`course` is a text"),
])
def test_says_what_a_value_is_not(options, sentence):
    for make in (Robot, lambda course="", **others: World(course).add(**others)):
        with pytest.raises((TypeError, ValueError), match=sentence):
            make(**options)


def test_refuses_what_it_cannot_take():
    robot = Robot("bolt")
    with pytest.raises(ValueError, match="no time"):
        robot.advance(float("inf"))
    with pytest.raises(TypeError, match="`seconds` is a number, not '1'"):
        robot.advance("1")
    with pytest.raises(TypeError, match="`line` is a text, not 7"):
        robot.stimulus(7)
    with pytest.raises(TypeError, match="bytes-like object is required, not 'str'"):
        robot.write("text")
    with pytest.raises(ValueError, match="`seq` is a whole number from 0 to 255, not 300"):
        encode("wake", seq=300)
    with pytest.raises(ValueError, match="did you mean `push`"):
        robot.stimulus("psuh 90 1")
    with pytest.raises(ValueError, match="did you mean `wake`"):
        encode("wkae")
    robot.advance(-1)
    assert robot.now == 0


def test_after_close_everything_is_an_error():
    with Robot("bolt") as robot:
        robot.connect()
    for act in (robot.connect, robot.read, robot.state, robot.path, lambda: robot.write(b""), lambda: robot.advance(1),
                robot.fork, robot.report, lambda: robot.place):
        with pytest.raises(ValueError, match="closed"):
            act()
    assert repr(robot) == "<a closed robot>"


def test_a_fork_goes_its_own_way():
    robot = awake()
    robot.write(encode("drive-with-heading", 80, 0, 0))
    robot.advance(0.5)
    fork = robot.fork()
    robot.advance(1)
    fork.advance(1)
    assert fork.place == robot.place
    robot.reset()
    assert robot.place == (0, 0) and fork.place.y > 10


def test_a_world_outlives_its_variable():
    robot = World().add("bolt")
    robot.advance(1)
    assert robot.now == 1
    with pytest.raises(ValueError, match="fork the world"):
        robot.fork()


def test_robots_run_into_each_other():
    world = World()
    red, blue = world.add("bolt", name="red"), world.add("mini", name="blue", place=(0, 50))
    red.connect()
    red.write(encode("wake"))
    red.advance(0.1)
    red.write(encode("drive-with-heading", 120, 0, 0))
    world.advance(2)
    assert red.state().bumps and blue.state().bumps and blue.place.y > 50
    assert [one.place for one in world.fork().robots] == [red.place, blue.place]
    with pytest.raises(ValueError, match="would stand in `red`"):
        world.add("bolt", place=(red.place.x + 1, red.place.y))


def test_draws_what_it_did(tmp_path):
    robot = awake()
    robot.write(encode("drive-with-heading", 80, 0, 0))
    robot.advance(1)
    page = tmp_path / "r.html"
    assert robot.report(page) == page.read_text(encoding="utf-8")
    assert robot._repr_svg_().startswith("<svg") and "<html" in page.read_text(encoding="utf-8")


def test_many_threads_may_use_one_robot():
    robot = awake()

    def use():
        for _ in range(200):
            robot.write(encode_ping("bolt"))
            robot.advance(0.001)
            robot.read()
            robot.state()

    threads = [threading.Thread(target=use) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert robot.now == pytest.approx(3.8)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_after_a_fork_of_the_process_both_have_a_robot():
    robot = awake()
    child = os.fork()
    if child == 0:
        robot.advance(1)
        os._exit(0 if robot.now == 4 else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert robot.now == 3


def framed(kind, draw):
    """A packet with any command and any data, as the robot takes it."""
    data = draw.randbytes(draw.choice((0, 0, 1, 2, 4, draw.randrange(60))))
    if encode_ping(kind)[:1] == b"\xff":  # packets v1
        body = bytes([draw.randrange(3), draw.randrange(256), draw.randrange(256), len(data) + 1]) + data
        return b"\xff" + bytes([0xFC | draw.randrange(4)]) + body + bytes([~sum(body) & 0xFF])
    target = draw.choice((b"", b"\x11\x01", b"\x12\x01"))
    command = bytes([draw.randrange(0x10, 0x1C), draw.randrange(0x60), draw.randrange(255)])
    body = bytes([0x3A if target else 0x0A]) + target + command + data
    out = b""
    for each in body + bytes([~sum(body) & 0xFF]):
        out += {0xAB: b"\xab\x23", 0x8D: b"\xab\x05", 0xD8: b"\xab\x50"}.get(each, bytes([each]))
    return b"\x8d" + out + b"\xd8"


@pytest.mark.parametrize("make", [lambda kind, draw: draw.randbytes(draw.randrange(60)), framed], ids=["any", "framed"])
@pytest.mark.parametrize("kind", orb_robot.kinds())
def test_takes_any_bytes(kind, make):
    draw = random.Random(kind)
    robot = awake(kind, fault="drop=5%,flip=1%")
    for number in range(300):
        robot.write(make(kind, draw))
        robot.advance(draw.random() / 5)
        robot.read()
        robot.state()
        if number % 100 == 0:
            robot = robot.fork()
            robot.connect()
    robot.report()
    decode(make(kind, draw), direction="from-robot")


def test_needs_no_d_bus(tmp_path):
    if not sys.platform.startswith("linux"):
        pytest.skip("only Linux tells what is loaded")
    code = "import orb_robot; orb_robot.check('end'); print('sdbus' in open('/proc/self/maps').read())"
    assert start(["-c", code], tmp_path).stdout == "False\n"
