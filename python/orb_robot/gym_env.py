"""A robot as an environment of Gymnasium: `gymnasium.make("orb_robot.gym_env:orb/Ball-v0", kind="bolt", goal=(100, 100))`.
What imports this module makes `orb/Ball-v0` known.

action       [heading in degrees, speed 0 to 255], kept until the next step
observation  [x, y in cm, heading in degrees, speed in cm/s, 1 after a bump in this step, x and y to the goal]
reward       the centimetres by which the step came nearer to the goal; 100 for reaching it, -1 for each bump
"""
from __future__ import annotations

import os
import typing

import gymnasium
import numpy
from gymnasium.envs import registration

from . import _orb
from .robot import Robot, _drawing
from .toolchain import encode

_FAR = 10_000.0  # cm: farther than anything drives in an episode


class BallEnv(gymnasium.Env):
    """kind:    which robot
    goal:    a place in cm, or the id of a zone of the course
    radius:  how near to a place is there, cm
    course:  walls and zones: an SVG, or the name of its file
    step_s:  seconds from one action to the next
    latency: (least, most) milliseconds from an action to the robot
    loss:    the part of actions that are lost, 0 to 1
    noise:   the standard deviation of observed places, cm
    steps:   of an episode at most
    """

    metadata = {"render_modes": ["svg"], "render_fps": 10}

    def __init__(self, kind: str = "bolt", goal: tuple[float, float] | str = (0, 100), radius: float = 10,
                 course: str | os.PathLike[str] = "", step_s: float = 0.1, latency: tuple[float, float] = (0, 0),
                 loss: float = 0, noise: float = 0, steps: int = 300, render_mode: str | None = None):
        if not 0 < step_s <= 10:
            raise ValueError(f"step_s is {step_s}; a step takes more than 0 and at most 10 seconds")
        self.render_mode = render_mode
        self._kind, self._radius, self._step_s, self._noise, self._steps = kind, radius, step_s, noise, steps
        self._is_v2 = _orb.gatt(kind)["protocol"] == "v2"
        self._text = _drawing(course)
        self._course = _orb.Course(self._text)
        if isinstance(goal, str):
            if goal not in self._course.zones:
                raise ValueError(f"the course has no zone {goal!r}; it has {', '.join(self._course.zones) or 'none'}")
            self._zone: str | None = goal
            low_x, low_y, high_x, high_y = self._course.zones[goal]
            self._goal = ((low_x + high_x) / 2, (low_y + high_y) / 2)
        else:
            self._zone, self._goal = None, (float(goal[0]), float(goal[1]))
        least, most = latency
        self._fault = ",".join(([f"delay={least:g}..{most:g}ms"] if most else []) +
                               ([f"drop={100 * loss:g}%"] if loss else []))
        box = gymnasium.spaces.Box
        self.action_space = box(numpy.array([0, 0], numpy.float32), numpy.array([360, 255], numpy.float32))
        most_seen = numpy.array([_FAR, _FAR, 360, 1000, 1, _FAR, _FAR], numpy.float32)
        self.observation_space = box(-most_seen, most_seen)
        self.robot: Robot | None = None

    def reset(self, *, seed: int | None = None, options: dict | None = None):
        """A new robot at 0,0, awake; the same seed gives the same episode."""
        super().reset(seed=seed)
        number = int(self.np_random.integers(1, 2**31))
        fault = f"{self._fault},seed={number}" if self._fault else ""
        self.robot = Robot(self._kind, seed=number, course=self._text, fault=fault)
        self.robot.connect()
        if self._is_v2:
            for _ in range(2):  # a bad link may lose the first
                self.robot.write(encode("wake", kind=self._kind))
                self.robot.advance(2.5)
                if self.robot.read():
                    break
        self._count = 0
        self._bumps = self.robot.state().bumps
        self._distance = self._to_goal()
        return self._observe(0), {}

    def step(self, action: typing.Sequence[float]):
        """Drives one step: observation, reward, whether it is there, whether the time is up, and what is to know."""
        if self.robot is None:
            raise RuntimeError("there is no episode yet; call reset() first")
        heading, speed = int(round(float(action[0]))) % 360, max(0, min(255, int(round(float(action[1])))))
        if self._is_v2:
            packet = encode("drive-with-heading", speed, heading, 0, kind=self._kind)
        else:
            packet = encode("roll", speed, heading, 1, kind=self._kind)
        self.robot.write(packet)
        self.robot.advance(self._step_s)
        self.robot.read()
        self._count += 1
        bumps = self.robot.state().bumps
        bumped, self._bumps = bumps > self._bumps, bumps
        before, self._distance = self._distance, self._to_goal()
        reached = self._distance == 0
        reward = before - self._distance + (100 if reached else 0) - (1 if bumped else 0)
        return self._observe(bumped), reward, reached, self._count >= self._steps, {"place": self.robot.place}

    def _to_goal(self) -> float:
        """The centimetres that are left; 0: it is there."""
        place = self.robot.place
        if self._zone is not None:
            return self._course.distance(self._zone, place.x, place.y)
        return max(0.0, place.distance(*self._goal) - self._radius)

    def _observe(self, bumped: float):
        state = self.robot.state()
        x, y = (float(value + self._noise * self.np_random.standard_normal()) if self._noise else value
                for value in state.place)
        seen = [x, y, state.heading, state.speed, float(bumped), self._goal[0] - x, self._goal[1] - y]
        return numpy.array(seen, numpy.float32)

    def render(self) -> str | None:
        """The path so far as an SVG, in render mode "svg"."""
        return self.robot.svg() if self.render_mode == "svg" and self.robot is not None else None

    def close(self) -> None:
        if self.robot is not None:
            self.robot.close()
            self.robot = None


def register() -> None:
    """Makes `orb/Ball-v0` known, once. Gymnasium before 1.0 calls it while it is loaded itself: it is the entry point of the
    package."""
    if "orb/Ball-v0" not in registration.registry:
        registration.register(id="orb/Ball-v0", entry_point="orb_robot.gym_env:BallEnv")


register()
