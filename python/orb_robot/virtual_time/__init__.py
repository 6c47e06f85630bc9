"""Time that passes as fast as the computer can: `orb_robot run --fast`.

`install()` gives this process a clock of its own. After it, `time`, `datetime`, `threading`, `queue`,
`concurrent.futures` and `asyncio` measure virtual time. One thread runs at a time and keeps running until it
blocks, or has read the clock or taken locks for some milliseconds; threads that can go on do so in the order in which
they became able to. When every thread waits, the clock jumps to the earliest deadline, so a run is the same every time
and takes no longer than its computing.

A thread that does neither for a while, because it computes or looks at a variable again and again, runs beside the
others from then on until it does; as long as it does, virtual time passes as fast as real time.

Call `install()` before the program, and before anything that makes locks of its own, is imported.
"""

import atexit
import os

from . import patches
from . import scheduler as scheduling
from .patches import MONOTONIC_AT_START
from .scheduler import NS, Scheduler, Watch, end, nanoseconds

__all__ = ["end", "finish_threads", "install", "limit_over", "seconds"]


def install(limit=None, on_fatal=None):
    """Makes the time of this process virtual.

    limit: seconds after which the main thread gets a KeyboardInterrupt, as from Ctrl-C.
    on_fatal: called before the process ends because nothing can go on.
    Raises RuntimeError if it was done before.
    """
    if scheduling.active is not None:
        raise RuntimeError("the time of this process is virtual already")
    scheduling.active = Scheduler(None if limit is None else nanoseconds(limit), on_fatal)
    patches.install()
    os.register_at_fork(after_in_child=scheduling.active.after_fork)
    atexit.register(Watch(scheduling.active).end)
    return scheduling.active


def seconds():
    """The virtual `time.monotonic()`, read without cost."""
    return (MONOTONIC_AT_START + scheduling.active.now) / NS


def limit_over():
    """True if the program was interrupted because its time was over."""
    return scheduling.active is not None and scheduling.active.interrupt is None


def finish_threads():
    """What Python does when a program has ended: waits for its threads, here in virtual time."""
    import threading

    exits = getattr(threading, "_threading_atexits", [])
    while exits:
        exits.pop()()
    while True:
        others = [t for t in threading.enumerate() if t is not threading.current_thread() and not t.daemon]
        others = [t for t in others if patches.task_of(t) is not None and t.is_alive()]
        if not others:
            return
        others[0].join()
