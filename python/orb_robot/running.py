"""Runs a Python program that was written for real robots, unchanged, with virtual ones: `python -m orb_robot run`."""

import argparse
import atexit
import importlib.machinery
import math
import os
import runpy
import signal
import sys
import threading
import time
import traceback
import types

from . import air, values, virtual_time

#: Robots of `--count` stand so far from each other, in cm.
APART_CM = 40.0
#: A robot that is faster than this so long after the end was left driving.
STILL_AFTER_S = 1.0
STILL_CM_PER_S = 3.0
#: What a program that was interrupted because its time is over has to end, in seconds.
GRACE_S = 5.0

_EXAMPLES = """\
examples:
  python -m orb_robot run drive.py --robot bolt
  python -m orb_robot run drive.py --robot mini --fast --report drive.html
  python -m orb_robot run swarm.py --robot bolt --count 3 -- --speed 60

The program's own arguments stand behind its name; what follows -- is always the program's.
A program that looks for a robot by its name: --name SB-1A2B.
"""


def _arguments(argv):
    parser = argparse.ArgumentParser(
        prog="python -m orb_robot",
        description="Programs in Python with virtual Sphero robots.",
        allow_abbrev=False,
    )
    run = parser.add_subparsers(dest="command", required=True, metavar="COMMAND").add_parser(
        "run",
        help="run a program that uses Bleak or bluepy, or a library over one, with virtual robots",
        description="Runs a Python program unchanged. What it imports as `bleak` or `bluepy` finds virtual robots.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    add = run.add_argument
    add("--robot", metavar="KIND", action="append", help="what it drives: bolt, mini, sprk+, … (several: repeat it)")
    add("--count", metavar="N", type=int, default=1, help="so many of each, 40 cm apart")
    add("--name", metavar="NAME", action="append", default=[], help="the name a robot advertises (in their order)")
    add("--address", metavar="ADDRESS", action="append", default=[], help="its address (in their order)")
    add("--fast", action="store_true", help="in virtual time: as fast as the computer can")
    add("--for", metavar="SECONDS", dest="limit", type=_seconds, help="press Ctrl-C for it after so long")
    add("--report", metavar="FILE", help="write a page that plays the run back")
    add("--course", metavar="FILE", help="walls and zones, an SVG")
    add("--stimulus", metavar="LINE", action="append", default=[], help='what happens to it: "at 2s push 90 120"')
    add("--fault", metavar="PLAN", default="", help="what the radio does: drop=1%%")
    add("--firmware", metavar="VERSION", default="", help="its firmware")
    add("--seed", metavar="N", type=_seed, default=1, help="another world: other names, another chance")
    add("-m", metavar="MODULE", dest="module", help="run a module instead of a file")
    ours, own = argv, []
    if "--" in argv:
        ours, own = argv[: argv.index("--")], argv[argv.index("--") + 1 :]
    options, rest = parser.parse_known_args(ours)
    if options.module is None:
        if not rest or rest[0].startswith("-"):
            run.error(f"unknown option {rest[0]}" if rest else "which program?")
        options.program, rest = rest[0], rest[1:]
    else:
        options.program = None
    options.arguments = rest + own
    options.robot = options.robot or ["bolt"]
    if options.count < 1:
        run.error("--count is at least 1")
    return run, options


def _seconds(text):
    number, unit = text, 1.0
    for ending, factor in (("ms", 0.001), ("s", 1.0), ("min", 60.0)):
        if text.endswith(ending):
            number, unit = text[: -len(ending)], factor
            break
    try:
        value = float(number) * unit
    except ValueError:
        value = math.nan
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"`{text}` is no time; write 90s or 2min")
    return value


def _seed(text):
    if not text.isdecimal() or int(text) > values.MOST_SEED:
        raise argparse.ArgumentTypeError(f"`{text}` is no whole number from 0 to {values.MOST_SEED}")
    return int(text)


def _make_world(options):
    from . import _orb

    course = ""
    if options.course:
        with open(options.course, encoding="utf-8") as file:
            course = file.read()
    world = _orb.World(course=course)
    index = 0
    for kind in options.robot:
        if kind == "sphero":
            raise ValueError("a classic Sphero has no Bluetooth LE: Bleak cannot see it")
        for _ in range(options.count):
            robot = world.add(
                kind,
                seed=options.seed + index,
                x=APART_CM * index,
                y=0.0,
                firmware=options.firmware,
                fault=options.fault,
            )
            for line in options.stimulus:
                robot.stimulus(line)
            index += 1
    if len(options.name) > index:
        raise ValueError(f"there is no robot left for --name {options.name[index]}")
    return world, _orb.gatt


class _StandIns:
    """Finds the packages of `stand_in` before those that are installed."""

    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "stand_in")

    @classmethod
    def find_spec(cls, name, path=None, target=None):
        """The place of a package that is stood in for; None for others."""
        return importlib.machinery.PathFinder.find_spec(name, [cls.folder]) if name in ("bleak", "bluepy") else None


class _Run:
    """A run: how it begins, what is said at its end."""

    def __init__(self, options, world, here):
        self.options = options
        self.world = world
        self.here = here
        self.process = os.getpid()
        self.finished = False
        self.limit_over = False

    def finish(self):
        """Says where each robot is, and writes the report. Once, and not in a child of the program."""
        if self.finished or os.getpid() != self.process:
            return
        self.finished = True
        self.here.catch_up()
        for radio in self.here.radios:
            if radio.links:
                self.here.disconnect(radio)
        later = self.world.fork()
        later.advance(STILL_AFTER_S)
        try:
            sys.stdout.flush()
        except (OSError, ValueError):
            pass
        for radio, after in zip(self.here.radios, later.robots):
            print(_where(radio, after), file=sys.stderr)
        if self.options.report:
            title = os.path.basename(self.options.program or self.options.module)
            try:
                with open(self.options.report, "w", encoding="utf-8") as file:
                    file.write(self.world.report(title))
            except OSError as error:
                print(f"orb_robot: {self.options.report}: {error.strerror}", file=sys.stderr)

    def on_signal(self, number, _):
        """A signal that would end the program at once does, after the report."""
        self.finish()
        signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)

    def end_after(self, seconds):
        """In real time: presses Ctrl-C, and ends what goes on after that."""

        def wait():
            time.sleep(seconds)
            self.limit_over = True
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(GRACE_S)
            virtual_time.end("", 0, self.finish)

        threading.Thread(target=wait, daemon=True).start()


def _where(radio, after):
    robot = radio.robot
    state = robot.state()
    text = f"{radio.name} ({robot.title}): at {state.x:.0f}, {state.y:.0f} cm, faces {state.heading:.0f}°"
    text += f", drove {state.way:.0f} cm in {state.t:.1f} s"
    if not radio.ever_connected:
        return text + "; nobody connected to it"
    if after.state().speed > STILL_CM_PER_S:
        text += f"; it was left driving, at {state.speed:.0f} cm/s"
    return text


def main(argv=None):
    """Runs the command of an argument list. Ends with the program's exit code."""
    parser, options = _arguments(sys.argv[1:] if argv is None else argv)
    try:
        world, gatt = _make_world(options)
    except (ValueError, OSError) as error:
        parser.exit(2, f"orb_robot: {error}\n")
    run = None
    if options.fast:
        virtual_time.install(options.limit, lambda: run.finish())
    clock = virtual_time.seconds if options.fast else time.monotonic
    here = air.Air(world, gatt, clock, options.name, options.address)
    air.use(here)
    run = _Run(options, world, here)
    atexit.register(run.finish)
    for name in ("SIGTERM", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), run.on_signal)
    sys.meta_path.insert(0, _StandIns)
    if options.limit is not None and not options.fast:
        run.end_after(options.limit)
    sys.exit(_execute(options, run))


def _execute(options, run):
    """Runs the program as `python` does, with the threads that it leaves. Returns its exit code."""
    code = _guarded(lambda: _run_program(options), run)
    if options.fast:
        _guarded(virtual_time.finish_threads, run)  # in real time Python itself waits for them
    return code


def _guarded(call, run):
    try:
        call()
    except SystemExit as error:
        return error.code
    except KeyboardInterrupt as error:
        if run.limit_over or virtual_time.limit_over():
            return 0
        _show(error)
        return 128 + signal.SIGINT
    except BaseException as error:
        _show(error)
        return 1
    return 0


def _run_program(options):
    if options.module is not None:
        sys.argv = [options.module, *options.arguments]
        sys.path[0] = os.getcwd()
        runpy.run_module(options.module, run_name="__main__", alter_sys=True)
        return
    path = options.program
    sys.argv = [path, *options.arguments]
    if os.path.isdir(path) or path.endswith((".zip", ".pyz")):
        runpy.run_path(path, run_name="__main__")
        return
    sys.path[0] = os.path.dirname(os.path.realpath(path))
    path = os.path.abspath(path)
    loader = importlib.machinery.SourceFileLoader("__main__", path)
    try:
        text = loader.get_data(path)
    except OSError as error:
        print(f"orb_robot: can't open {options.program}: {error.strerror}", file=sys.stderr)
        sys.exit(2)
    code = loader.source_to_code(text, path)
    module = types.ModuleType("__main__")
    module.__file__, module.__loader__, module.__builtins__ = path, loader, __builtins__
    module.__dict__["__cached__"] = None
    sys.modules["__main__"] = module
    exec(code, module.__dict__)


def _show(error):
    """Prints what the program raised, without what lies around it here."""
    trace = error.__traceback__
    while trace is not None and trace.tb_frame.f_code.co_filename == __file__:
        trace = trace.tb_next
    if sys.excepthook is sys.__excepthook__:
        traceback.print_exception(type(error), error, trace)
    else:
        sys.excepthook(type(error), error, trace)
