"""What the standard library gets instead of its clocks, threads and waits in real time."""

import _thread
import sys
import time
from collections import deque

from . import scheduler as scheduling
from .locks import Lock, RLock
from .scheduler import NS, impossible, nanoseconds, real_allocate, real_start

#: What `time.monotonic()` and `time.time()` begin with: always the same, so that runs are.
MONOTONIC_AT_START = 1_000 * NS
EPOCH_AT_START = 1_700_000_000 * NS  # 14 November 2023


def install():
    """Puts everything in its place; the scheduler is there."""
    _install_clock()
    _install_threads()
    _install_datetime()
    _install_asyncio()
    _install_refusals()


def _start_new_thread(function, args, kwargs=None):
    return scheduling.active.start(function, args, kwargs or {})


def _replace(old, new):
    """Puts `new` where modules that were imported already have `old` in a name of their own."""
    for module in list(sys.modules.values()):
        names = getattr(module, "__dict__", None)
        if not isinstance(names, dict) or module.__name__.startswith(__package__):
            continue
        for name, value in list(names.items()):
            if value is old:
                names[name] = new


def _install_clock():
    read = scheduling.active.read

    def monotonic():
        """Virtual seconds; the start is not defined."""
        return (MONOTONIC_AT_START + read()) / NS

    def monotonic_ns():
        """Virtual nanoseconds; the start is not defined."""
        return MONOTONIC_AT_START + read()

    def wall_clock():
        """Virtual seconds since 1970."""
        return (EPOCH_AT_START + read()) / NS

    def wall_clock_ns():
        """Virtual nanoseconds since 1970."""
        return EPOCH_AT_START + read()

    def sleep(seconds):
        """Waits so many virtual seconds."""
        if seconds < 0:
            raise ValueError("sleep length must be non-negative")
        scheduling.active.sleep(nanoseconds(seconds))

    def of_now(convert):
        return lambda seconds=None: convert(time.time() if seconds is None else seconds)

    real_strftime = time.strftime
    for old, new in (
        (time.monotonic, monotonic),
        (time.perf_counter, monotonic),
        (time.monotonic_ns, monotonic_ns),
        (time.perf_counter_ns, monotonic_ns),
        (time.time, wall_clock),
        (time.time_ns, wall_clock_ns),
        (time.sleep, sleep),
        (time.localtime, of_now(time.localtime)),
        (time.gmtime, of_now(time.gmtime)),
        (time.ctime, of_now(time.ctime)),
        (time.asctime, _with_default(time.asctime)),
        (real_strftime, lambda form, *when: real_strftime(form, *(when or (time.localtime(),)))),
    ):
        _replace(old, new)


def _with_default(convert):
    return lambda *when: convert(*(when or (time.localtime(),)))


def _install_datetime():
    import datetime as module

    class Meta(type):
        """Dates that C made count as dates."""

        def __instancecheck__(cls, value):
            return isinstance(value, cls.__mro__[1])

        def __subclasscheck__(cls, other):
            return issubclass(other, cls.__mro__[1])

    class datetime(module.datetime, metaclass=Meta):
        """`datetime.datetime` by the virtual clock."""

        @classmethod
        def now(cls, tz=None):
            return cls.fromtimestamp(time.time(), tz)

        @classmethod
        def utcnow(cls):
            return cls.fromtimestamp(time.time(), module.timezone.utc).replace(tzinfo=None)

        @classmethod
        def today(cls):
            return cls.now()

    class date(module.date, metaclass=Meta):
        """`datetime.date` by the virtual clock."""

        @classmethod
        def today(cls):
            return cls.fromtimestamp(time.time())

    for made in (datetime, date):
        made.__module__ = "datetime"
        made.__qualname__ = made.__name__
    _replace(module.datetime, datetime)
    _replace(module.date, date)


def _install_threads():
    import queue
    import threading

    _replace(threading.Lock, Lock)  # a type of its own from Python 3.13
    _replace(real_allocate, Lock)
    _replace(threading.RLock, RLock)
    _replace(_thread.RLock, RLock)
    _replace(real_start, _start_new_thread)
    if hasattr(queue, "_PySimpleQueue"):
        _replace(queue.SimpleQueue, queue._PySimpleQueue)
    if hasattr(threading, "_start_joinable_thread"):  # from Python 3.13
        real_joinable = threading._start_joinable_thread

        def start_joinable(function, handle=None, daemon=True):
            return scheduling.active.start(
                function, (), {}, lambda body, args: real_joinable(body, handle=handle, daemon=daemon)
            )

        threading._start_joinable_thread = start_joinable

    def join(self, timeout=None):
        """Waits until the thread has ended, at most `timeout` virtual seconds."""
        if not self._initialized:
            raise RuntimeError("Thread.__init__() not called")
        if not self._started.is_set():
            raise RuntimeError("cannot join thread before it is started")
        if self is threading.current_thread():
            raise RuntimeError("cannot join current thread")
        task = task_of(self)
        if task is not None:
            scheduling.active.join(task, None if timeout is None else max(0, nanoseconds(timeout)))

    def is_alive(self):
        """True if the thread has begun and not ended."""
        task = task_of(self)
        return self._started.is_set() and task is not None and not task.done

    threading.Thread.join, threading.Thread.is_alive = join, is_alive
    futures = sys.modules.get("concurrent.futures.thread")
    if futures is not None and hasattr(futures, "_global_shutdown_lock"):
        futures._global_shutdown_lock = Lock()


def task_of(thread):
    """What the scheduler knows of a thread; None: nothing."""
    import threading

    return scheduling.active.main if thread is threading.main_thread() else getattr(thread, "_virtual_task", None)


def _install_asyncio():
    import selectors

    class VirtualSelector(selectors.DefaultSelector):
        """Waits in virtual time. Only an event loop's own pipe can be in it."""

        def __init__(self):
            super().__init__()
            self.waits = deque()
            self.woken = False

        def register(self, fileobj, events, data=None):
            if self.get_map():
                impossible(f"waiting for {_named(fileobj)}")
            return super().register(fileobj, events, data)

        def select(self, timeout=None):
            found = super().select(0)
            if not found and not self.woken:
                if timeout is None or timeout > 0:
                    scheduling.active.wait(self.waits, None if timeout is None else nanoseconds(timeout))
                    found = super().select(0)
                else:
                    scheduling.active.pause()
            self.woken = False
            return found

        def wake(self):
            """Ends the wait, now or the next."""
            self.woken = True
            scheduling.active.wake(self.waits)

    _replace(selectors.DefaultSelector, VirtualSelector)

    import asyncio.selector_events as events

    real_write = events.BaseSelectorEventLoop._write_to_self

    def write_to_self(self):
        if isinstance(self._selector, VirtualSelector):
            if self._csock is not None:
                self._selector.wake()
        else:
            real_write(self)

    events.BaseSelectorEventLoop._write_to_self = write_to_self
    if sys.platform == "win32":
        import asyncio

        asyncio.set_event_loop_policy(asyncio.WindowsSelectorEventLoopPolicy())


def _named(fileobj):
    if fileobj is sys.stdin or fileobj == 0:
        return "the keyboard"
    return "a socket or a pipe"


#: Modules that wait in a loop of their own, outside Python.
_WINDOWS = frozenset(
    "tkinter turtle pygame pyglet kivy wx gi PyQt5 PyQt6 PySide2 PySide6 curses cv2 uvloop gevent eventlet trio "
    "rospy rclpy".split()
)
_EVENTS = {
    "socket.connect": "a connection over a socket",
    "socket.bind": "a socket that waits for others",
    "socket.sendto": "a socket",
    "socket.getaddrinfo": "the network",
}
_PROCESSES = ("subprocess.Popen", "os.system", "os.posix_spawn")


def _install_refusals():
    import select

    said = []

    def audit(event, args):
        if event in _EVENTS:
            impossible(_EVENTS[event])
        if event in _PROCESSES and not said:
            said.append(event)
            print("orb_robot: another process takes no virtual time", file=sys.stderr, flush=True)
        if event == "import" and args[0] in _WINDOWS and "." not in args[0]:
            if _can_be_found(args[0]):
                impossible(f"`import {args[0]}`")
        if event == "import" and args[0].startswith("multiprocessing.popen_"):
            impossible("`multiprocessing`")

    sys.addaudithook(audit)
    real_select = select.select

    def virtual_select(reading, writing, failing, timeout=None):
        if not (reading or writing or failing) and timeout is not None:
            time.sleep(timeout)
            return [], [], []
        if timeout == 0:
            return real_select(reading, writing, failing, 0)
        impossible("`select`")

    select.select = virtual_select
    if hasattr(select, "poll"):
        select.poll = lambda: impossible("`select.poll`")


def _can_be_found(name):
    """True if the module is installed: a program may well do without it."""
    import importlib.machinery

    return importlib.machinery.PathFinder.find_spec(name) is not None
