"""What a path looks like: assertions that say why they fail.

    assert drove_square(robot, side=50, by=8)
"""
from __future__ import annotations

import dataclasses
import math
import typing

from .robot import Place, Robot, Step


@dataclasses.dataclass(frozen=True)
class Match:
    """The result of a comparison, true for a match; its text says why not."""

    holds: bool
    why: str

    def __bool__(self) -> bool:
        return self.holds

    def __repr__(self) -> str:
        return self.why


def _places(path: Robot | typing.Iterable[Step | Place | tuple[float, float]]) -> list[Place]:
    steps = path.path() if isinstance(path, Robot) else path
    places = [Place(one.x, one.y) if isinstance(one, Step) else Place(*one) for one in steps]
    return [one for i, one in enumerate(places) if i == 0 or one != places[i - 1]]


def _off(place: Place, start: Place, end: Place) -> float:
    length = start.distance(*end)
    if length == 0:
        return place.distance(*start)
    return abs((place.x - start.x) * (end.y - start.y) - (place.y - start.y) * (end.x - start.x)) / length


def corners(path: Robot | typing.Iterable[Step], by: float = 5) -> list[Place]:
    """The places between which a path is straight, its ends among them: no place of it lies more than `by` cm off
    these lines (Ramer, Douglas and Peucker)."""
    places = _places(path)
    if len(places) < 3:
        return places
    kept = {0, len(places) - 1}
    stretches = [(0, len(places) - 1)]
    while stretches:
        first, last = stretches.pop()
        far, at = max(((_off(places[i], places[first], places[last]), i) for i in range(first + 1, last)),
                      default=(0, first))
        # A path that comes back to where it began has no line: the farthest place is a corner.
        if far > by:
            kept.add(at)
            stretches += [(first, at), (at, last)]
    return _without_straight([places[i] for i in sorted(kept)], by)


def _without_straight(found: list[Place], by: float) -> list[Place]:
    """Without places at which the path goes straight on: a path that comes back was divided there only because it had to
    be somewhere."""
    at = 1
    while at < len(found) - 1:
        if _off(found[at], found[at - 1], found[at + 1]) <= by and not _turns_back(*found[at - 1:at + 2]):
            del found[at]
        else:
            at += 1
    return found


def _turns_back(before: Place, here: Place, after: Place) -> bool:
    return abs(_turn(before, here, after)) > 90


def drove_polygon(path: Robot | typing.Iterable[Step], sides: int, side: float | None = None,
                  by: float = 10) -> Match:
    """Matches a path that is a regular polygon: so many sides of equal length (`side` cm, where that is given), equal turns,
    and back where it began, each within `by` cm."""
    found = corners(path, by)
    if len(found) - 1 != sides:
        return Match(False, f"the path has {max(len(found) - 1, 0)} straight sides, not {sides}: {_words(found)}")
    if not found[-1].near(*found[0], by=by):
        return Match(False, f"the path ends {found[-1].distance(*found[0]):.0f} cm from where it began")
    lengths = [one.distance(*other) for one, other in zip(found, found[1:])]
    wanted = side if side is not None else sum(lengths) / sides
    for number, length in enumerate(lengths, 1):
        if abs(length - wanted) > by:
            return Match(False, f"side {number} is {length:.0f} cm long, not {wanted:.0f}: {_words(found)}")
    turns = [_turn(*three) for three in zip(found, found[1:], found[2:])]
    # What `by` at the end of a side is as an angle.
    loose = math.degrees(math.atan2(by, max(wanted, 1)))
    for number, turn in enumerate(turns, 1):
        if abs(abs(turn) - 360 / sides) > loose or turn * turns[0] < 0:
            return Match(False, f"turn {number} is {turn:.0f} degrees, not {360 / sides:.0f}: {_words(found)}")
    return Match(True, f"a polygon of {sides} sides, {wanted:.0f} cm each")


def drove_square(path: Robot | typing.Iterable[Step], side: float | None = None, by: float = 10) -> Match:
    """Matches a path that is a square with sides of `side` cm, back where it began."""
    return drove_polygon(path, 4, side, by)


def _turn(before: Place, here: Place, after: Place) -> float:
    way = math.atan2(here.x - before.x, here.y - before.y)
    next_way = math.atan2(after.x - here.x, after.y - here.y)
    return math.degrees(math.remainder(next_way - way, math.tau))


def _words(places: list[Place]) -> str:
    return " → ".join(f"{one.x:.0f},{one.y:.0f}" for one in places)
