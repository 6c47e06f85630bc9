"""Robots on bytes, in virtual time: a client's bytes go in, the robot's come out, time passes when it is told so."""
from __future__ import annotations

import dataclasses
import math
import os
import typing

from . import _orb, values


class Place(typing.NamedTuple):
    """A place on the floor in centimetres: x to the right, y ahead of where robots start."""

    x: float
    y: float

    def distance(self, x: float, y: float) -> float:
        """The centimetres to another place."""
        return math.hypot(self.x - x, self.y - y)

    def near(self, x: float, y: float, by: float = 10) -> bool:
        """True if it is at most `by` centimetres from there."""
        return self.distance(x, y) <= by


class Lamp(typing.NamedTuple):
    """What a lamp shows: 0 to 255 of red, green and blue. It equals another lamp, a tuple, or the name of its colour:
    `lamp == "red"` holds for a dim red, too."""

    red: int
    green: int
    blue: int

    @property
    def names(self) -> frozenset[str]:
        """What its colour is called, however bright it is."""
        return _names_of(tuple(self))

    def __eq__(self, other: object) -> bool:
        if isinstance(other, str):
            if other not in _orb.colours():
                raise ValueError(f"there is no colour {other!r}; the colours are {', '.join(sorted(_orb.colours()))}")
            return other in self.names
        return tuple(self) == other

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = tuple.__hash__

    def __repr__(self) -> str:
        return f"<lamp {self.red},{self.green},{self.blue}: {' or '.join(sorted(self.names))}>"


_DARK = 16  # below this nobody sees that a lamp is on


def _bright(rgb: tuple[int, ...]) -> tuple[float, ...]:
    most = max(rgb)
    return (0, 0, 0) if most < _DARK else tuple(255 * part / most for part in rgb)


def _names_of(rgb: tuple[int, ...]) -> frozenset[str]:
    here = _bright(rgb)
    apart = {name: math.dist(here, _bright(there)) for name, there in _orb.colours().items()}
    least = min(apart.values())
    return frozenset(name for name, distance in apart.items() if distance == least)


class Step(typing.NamedTuple):
    """Where a robot was at one moment: seconds, centimetres, degrees clockwise, centimetres a second."""

    t: float
    x: float
    y: float
    heading: float
    speed: float

    @property
    def place(self) -> Place:
        return Place(self.x, self.y)


@dataclasses.dataclass(frozen=True)
class State:
    """How a robot is at one moment."""

    t: float  #: seconds since it was switched on
    place: Place  #: cm
    heading: float  #: degrees clockwise from ahead
    speed: float  #: cm/s
    lamp: Lamp  #: its main light
    back_led: int  #: 0 to 255
    matrix: tuple[Lamp, ...] | None  #: 64, row by row from the bottom left; None while one colour fills it, or it has none
    volts: float  #: of its battery
    charge: int  #: of its battery, percent
    way: float  #: cm that it has driven
    asleep: bool
    connected: bool
    running: bool  #: a program or a macro of its own
    driving: bool  #: something has it driving
    collisions: int  #: that it has told, or would have told
    bumps: int  #: into walls and other robots


def _state(raw: _orb.State) -> State:
    matrix = raw.matrix
    return State(raw.t, Place(raw.x, raw.y), raw.heading, raw.speed, Lamp(*raw.rgb), raw.back_led,
                 None if matrix is None else tuple(Lamp(*one) for one in matrix), raw.volts, raw.charge, raw.way, raw.asleep,
                 raw.connected, raw.running, raw.driving, raw.collisions, raw.bumps)


def _drawing(course: str | os.PathLike[str]) -> str:
    """The text of a course: a drawing itself, or the name of its file."""
    text = values.text("course", os.fspath(course) if isinstance(course, os.PathLike) else course)
    if not text or text.lstrip().startswith("<"):
        return text
    with open(text, encoding="utf-8") as file:
        return file.read()


def _begin(seed: int, place: tuple[float, float], heading: float, fault: str, firmware: str, journey: bool) -> dict:
    """How a robot begins, as its compiled half takes it."""
    x, y = values.place("place", place)
    return {"seed": values.whole("seed", seed, 0, values.MOST_SEED), "x": x, "y": y,
            "heading": values.number("heading", heading), "fault": values.text("fault", fault),
            "firmware": values.text("firmware", firmware), "journey": values.yes_or_no("journey", journey)}


class _Drawn:
    """What can be drawn: a robot, or a world of them. `_source()` is its compiled half, `_title()` what stands on a page."""

    def report(self, path: str | os.PathLike[str] = "", title: str = "") -> str:
        """A page that plays back what it did, as text; written to `path`, where one is given."""
        page = self._source().report(title or self._title())
        if path:
            with open(path, "w", encoding="utf-8") as file:
                file.write(page)
        return page

    def svg(self) -> str:
        """Where it went, as a drawing."""
        return self._source().svg()

    def _repr_svg_(self) -> str:
        return self.svg()


class Robot(_Drawn):
    """A virtual robot, alone on its floor. `kind` is one of `kinds()`.

    seed:     of noise, its address and random numbers; the same seed gives the same bytes
    place:    where it starts, cm; heading: which way it faces there, degrees clockwise
    course:   walls and zones: an SVG, or the name of its file
    fault:    a bad link, such as "drop=1%,delay=50..300ms"
    firmware: of classic robots
    journey:  False remembers nothing but the present: no path, no report, for thousands of robots

    ValueError says what is wrong with one of these. No method waits: time is the robot's own.
    """

    def __init__(self, kind: str = "bolt", *, seed: int = 1, place: tuple[float, float] = (0, 0), heading: float = 0,
                 course: str | os.PathLike[str] = "", fault: str = "", firmware: str = "", journey: bool = True):
        self._raw: _orb.Robot | None = _orb.Robot(values.text("kind", kind), course=_drawing(course),
                                                  **_begin(seed, place, heading, fault, firmware, journey))

    @classmethod
    def _of(cls, raw: _orb.Robot) -> Robot:
        robot = cls.__new__(cls)
        robot._raw = raw
        return robot

    @property
    def _robot(self) -> _orb.Robot:
        if self._raw is None:
            raise ValueError("the robot is closed; make a new one")
        return self._raw

    # The client's end of the link.

    def connect(self) -> None:
        """A client connects; that wakes a classic robot."""
        self._robot.connect()

    def disconnect(self) -> None:
        """The client goes; what it has not read is lost."""
        self._robot.disconnect()

    @property
    def connected(self) -> bool:
        """Falling asleep disconnects, and so does a fault plan that cuts the link."""
        return self._robot.connected

    def write(self, data: bytes | bytearray | memoryview) -> None:
        """Bytes from the client, now, in any pieces. Without a connection they are lost."""
        self._robot.write(data)

    def read(self) -> bytes:
        """What has arrived at the client by now."""
        return self._robot.read()

    # Time.

    @property
    def now(self) -> float:
        """Seconds since it was switched on."""
        return self._robot.now

    def advance(self, seconds: float) -> None:
        """Lets that much of the robot's time pass; of all robots, in a world."""
        try:
            self._robot.advance(seconds)
        except TypeError:
            raise values.refuse("seconds", "a number", seconds) from None

    def next_event(self) -> float | None:
        """When something happens next by itself, in seconds of its time; None: never."""
        return self._robot.next_event()

    # What can be seen.

    @property
    def kind(self) -> str:
        return self._robot.kind

    @property
    def name(self) -> str:
        """As it advertises itself over Bluetooth LE, such as SB-0001."""
        return self._robot.name

    @property
    def address(self) -> str:
        return self._robot.address

    def state(self) -> State:
        return _state(self._robot.state())

    @property
    def place(self) -> Place:
        return self.state().place

    @property
    def heading(self) -> float:
        return self.state().heading

    @property
    def speed(self) -> float:
        return self.state().speed

    @property
    def lamp(self) -> Lamp:
        return self.state().lamp

    def path(self) -> list[Step]:
        """Where it was: every 50 ms while it moved; of a long life fewer."""
        return [Step(*one) for one in self._robot.path()]

    def events(self) -> list[tuple[float, str, str]]:
        """What happened to it: the time, a word (print, bump, collision, …), and a sentence."""
        return self._robot.events()

    # What the world does.

    def stimulus(self, line: str) -> None:
        """A line of a stimulus script: "push 90 120" happens now, "at 2s shake" at 2 s of its time.

        ValueError says what is wrong with the line."""
        self._robot.stimulus(values.text("line", line))

    # Its life.

    def reset(self) -> None:
        """Puts it, and its world, back to time 0; a client stays connected."""
        self._robot.reset()

    def fork(self) -> Robot:
        """A robot that has come just as far, and goes its own way from here. ValueError in a world: fork that."""
        return Robot._of(self._robot.fork())

    def close(self) -> None:
        """Ends it. Whatever is asked of it afterwards is a ValueError."""
        self._raw = None

    def __enter__(self) -> Robot:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _source(self) -> _orb.Robot:
        return self._robot

    def _title(self) -> str:
        return f"{self._robot.title} {self.name}"

    def __repr__(self) -> str:
        if self._raw is None:
            return "<a closed robot>"
        state = self.state()
        return (f"<{self._raw.title} {self.name} at {state.place.x:.0f},{state.place.y:.0f} cm, heading "
                f"{state.heading:.0f}, {state.speed:.0f} cm/s, t={state.t:.3f} s>")


class World(_Drawn):
    """Several robots on one floor, which run into each other. `course` is as of Robot."""

    def __init__(self, course: str | os.PathLike[str] = ""):
        self._world = _orb.World(_drawing(course))
        self._made: list[Robot] = []

    def add(self, kind: str = "bolt", *, name: str = "", seed: int | None = None,
            place: tuple[float, float] | None = None, heading: float = 0, fault: str = "", firmware: str = "",
            journey: bool = True) -> Robot:
        """A robot that lives from now on. Without a seed and a place it has those of its number: a seed of its own,
        and 40 cm to the right of the one before."""
        number = len(self._made)
        begin = _begin(number + 1 if seed is None else seed, (40 * number, 0) if place is None else place, heading, fault,
                       firmware, journey)
        raw = self._world.add(values.text("kind", kind), name=values.text("name", name), **begin)
        self._made.append(Robot._of(raw))
        return self._made[-1]

    @property
    def robots(self) -> list[Robot]:
        return list(self._made)

    @property
    def now(self) -> float:
        """Seconds of the world's time."""
        return self._world.now

    def advance(self, seconds: float) -> None:
        """Lets that much time pass for all."""
        try:
            self._world.advance(seconds)
        except TypeError:
            raise values.refuse("seconds", "a number", seconds) from None

    def reset(self) -> None:
        """Puts everything back to time 0; clients stay connected."""
        self._world.reset()

    def fork(self) -> World:
        """A world that has come just as far, with robots of its own."""
        fork = World.__new__(World)
        fork._world = self._world.fork()
        fork._made = [Robot._of(raw) for raw in fork._world.robots]
        return fork

    def _source(self) -> _orb.World:
        return self._world

    def _title(self) -> str:
        return "robots"
