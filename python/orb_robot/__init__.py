"""Virtual Sphero robots for programs, tests and notebooks.

    >>> from orb_robot import Robot
    >>> robot = Robot("bolt")
    >>> robot.connect()
    >>> robot.write(packet)          # what a client library would send
    >>> robot.advance(1.5)           # seconds of the robot's time, which costs none of yours
    >>> answer = robot.read()
    >>> robot.place.near(0, 60, by=10)
    True

A program that drives real robots runs unchanged: `python3 -m orb_robot run program.py --robot bolt`.
"""
from ._orb import __version__, kinds
from .robot import Lamp, Place, Robot, State, Step, World
from .toolchain import (Findings, Finding, Macro, OrbError, Run, assemble, build, check, decode, encode, format, lift,
                        run, test)

__all__ = ["Finding", "Findings", "Lamp", "Macro", "OrbError", "Place", "Robot", "Run", "State", "Step", "World",
           "__version__", "assemble", "build", "check", "decode", "encode", "format", "kinds", "lift", "run", "test"]
