"""Which thread runs, and what time it is."""

import _thread
import heapq
import os
import signal
import sys
import time
from collections import deque

NS = 1_000_000_000
#: What reading the clock costs, so that `while time.time() < end: pass` ends.
READ_NS = 5_000
#: A thread that only reads the clock lets the others run after this time, as CPython's own switch interval does.
SLICE_NS = 5_000_000
#: What taking a lock costs, so that a thread that looks into a queue again and again lets others run, too.
LOCK_NS = 2_000
#: After so many seconds on the processor without a wait or a look at the clock a thread runs beside the others; the
#: second value is for one that did so before.
ALONE_S = (0.5, 0.01)
#: And after so many real seconds: it waits outside Python, perhaps for somebody to type.
OUTSIDE_S = 3.0
#: A thread that others wait for looks so often, in real seconds, whether they are ready.
LOOK_S = 0.0005
#: If it is the only one, a sentence says where it is after so many.
SILENCE_S = 5.0
#: A program that goes on after the interrupt of its limit has so much virtual time to end.
GRACE_NS = 5 * NS

#: Before it is said that nothing can happen any more, a signal has so many real seconds to arrive: a busy computer is
#: late.
SIGNAL_S = 1.0

#: A signal that comes just before a thread begins to wait is handled only when it looks up again, in real seconds.
LOST_SIGNAL_S = 0.1

real_allocate = _thread.allocate_lock
real_start = _thread.start_new_thread
_real_monotonic = time.monotonic
_real_sleep = time.sleep

#: The scheduler of this process; None in real time.
active = None


def nanoseconds(seconds):
    """Seconds as a whole number, rounded up."""
    return -int(-seconds * NS // 1)


class _Task:
    """A thread as the scheduler sees it."""

    __slots__ = ("baton", "ident", "name", "done", "ended", "queued", "beside", "times_beside")

    def __init__(self, name):
        self.baton = real_allocate()
        self.baton.acquire()
        self.ident = None
        self.name = name
        self.done = False
        self.ended = deque()  # waits of those that join it
        self.queued = False
        self.beside = False  # it runs without the baton
        self.times_beside = 0


class _Wait:
    """A wait of a task: over when it is woken or its deadline has passed."""

    __slots__ = ("task", "woken", "over")

    def __init__(self, task):
        self.task = task
        self.woken = False
        self.over = False


class Scheduler:
    """Decides which thread runs and what time it is."""

    def __init__(self, limit=None, on_fatal=None):
        self.now = 0
        self.switched_at = 0
        self.switches = 0
        self.ready = deque()
        self.sleepers = []
        self.order = 0
        self.limit = limit
        self.interrupt = False
        self.on_fatal = on_fatal
        self.beside = set()  # tasks that run without the baton
        self.letting_go = real_allocate()  # held while a task loses the baton
        self.real_at = (0.0, 0)  # a real moment and the virtual one that it was
        self.main = self.current = _Task("MainThread")
        self.main.ident = _thread.get_ident()
        self.tasks = {self.main.ident: self.main}

    # The clock.

    def read(self):
        """Nanoseconds since the start. Costs a little time, and lets others run when that was long."""
        self.spend(READ_NS)
        return self.now

    def spend(self, duration_ns):
        """Lets a short time pass, in which others may have their turn."""
        if self.beside:
            self.enter()
        self.now += duration_ns
        if self.now - self.switched_at >= SLICE_NS and _thread.get_ident() == self.current.ident:
            self.pause()

    # Waiting.

    def pause(self):
        """Lets every thread that can run go first."""
        self._limit_reached()
        if self._due() or self.ready:
            self._make_ready(self.current)
            self._switch(self.current)
        self.switched_at = self.now
        self._deliver_interrupt()

    def sleep(self, duration_ns):
        """Waits so long."""
        if duration_ns <= 0:
            self.pause()
        else:
            self.wait(deque(), duration_ns)

    def wait(self, queue, timeout_ns):
        """Waits in `queue` until woken; False if the time is over first. `None` as timeout: for ever."""
        task = self.enter()
        if task is None:
            return self._wait_outside(queue, timeout_ns)
        entry = _Wait(task)
        queue.append(entry)
        if timeout_ns is not None:
            self.order += 1
            heapq.heappush(self.sleepers, (self.now + timeout_ns, self.order, entry))
        try:
            while not entry.over:
                self._switch(task)
                self._deliver_interrupt()
        except BaseException:
            if entry.woken:  # it was given what it now leaves: let the next have it
                self.wake(queue)
            raise
        finally:
            entry.over = True
            if not entry.woken and entry in queue:  # `wake` may have passed over it
                queue.remove(entry)
        return entry.woken

    def wake(self, queue):
        """Ends the wait of the first in `queue`. Returns whether there was one."""
        if self.beside:
            self.enter()
        while queue:
            try:
                entry = queue.popleft()
            except IndexError:
                return False
            if not entry.over:
                entry.over = entry.woken = True
                self._make_ready(entry.task)
                return True
        return False

    def _wait_outside(self, queue, timeout_ns):
        """For a thread that Python did not start, such as a library's own: in real time."""
        entry = _Wait(_Task("a thread of a library"))
        queue.append(entry)
        end = None if timeout_ns is None else _real_monotonic() + timeout_ns / NS
        while not entry.over and (end is None or _real_monotonic() < end):
            _real_sleep(0.001)
        entry.over = True
        return entry.woken

    # Switching.

    def _make_ready(self, task):
        if not task.queued:
            task.queued = True
            self.ready.append(task)

    def _due(self):
        """Moves the sleepers whose time has come to those that can run."""
        moved = False
        while self.sleepers and (self.sleepers[0][2].over or self.sleepers[0][0] <= self.now):
            entry = heapq.heappop(self.sleepers)[2]
            if not entry.over:
                entry.over = True
                self._make_ready(entry.task)
                moved = True
        return moved

    def _next(self):
        """The task that runs next; the clock jumps if all wait."""
        while True:
            self._due()
            if self.ready:
                task = self.ready.popleft()
                task.queued = False
                return task
            following = self.sleepers[0][0] if self.sleepers else self.limit
            if self.limit is not None and self.now < self.limit:
                following = min(following, self.limit)
            if self.beside:
                _real_sleep(LOOK_S)
                real, virtual = self.real_at
                passed = virtual + nanoseconds(_real_monotonic() - real)
                following = passed if following is None else min(following, passed)
            elif following is None:
                if not self._signal_comes():
                    end(self._deadlock())
                continue
            self.now = max(self.now, following)
            self._limit_reached()

    def _signal_comes(self):
        until = _real_monotonic() + SIGNAL_S
        while not self.ready and _real_monotonic() < until:
            _real_sleep(LOOK_S)
        return bool(self.ready)

    def _switch(self, task):
        """Hands the baton on and waits until it comes back to `task`."""
        following = self._next()
        self.switched_at = self.now
        self.switches += 1
        if following is task:
            return
        self.current = following
        self._await_baton(task, following)

    def _pass_on(self):
        following = self._next()
        self.switched_at = self.now
        self.switches += 1
        self.current = following
        following.baton.release()

    def _await_baton(self, task, following=None):
        """Waits until the baton comes to `task`; gives it to `following` first."""
        interrupted = None
        while True:
            try:
                if following is not None:
                    following, baton = None, following.baton
                    baton.release()  # a signal's handler can run after it
                while not task.baton.acquire(True, LOST_SIGNAL_S if task is self.main else -1):
                    pass
                break
            except BaseException as error:  # a signal's handler, in the main thread
                if interrupted is not None:
                    end("interrupted twice", 130)
                interrupted = error
                if self.current is task:  # it came with the baton
                    task.baton.acquire(False)
                    break
                self._make_ready(task)
        if interrupted is not None:
            raise interrupted

    def _limit_reached(self):
        if self.limit is None or self.now < self.limit:
            return
        if self.main.beside:
            self.interrupt_outside()
            return
        self._extend_limit()
        self.interrupt = True
        self._make_ready(self.main)

    def interrupt_outside(self):
        """Presses Ctrl-C for a main thread that does not come here."""
        self._extend_limit()
        self.interrupt = None
        os.kill(os.getpid(), signal.SIGINT)

    def _extend_limit(self):
        if self.interrupt is None:  # the second time
            end("", 0)  # it went on after it was interrupted
        self.limit = self.now + GRACE_NS

    def _deliver_interrupt(self):
        """What Ctrl-C does, in the main thread: asyncio and programs have handlers of their own for it."""
        if self.interrupt and _thread.get_ident() == self.main.ident:
            self.interrupt = None
            signal.raise_signal(signal.SIGINT)

    # Beside the others.

    def enter(self):
        """Where a thread comes to the scheduler: one that ran beside the others waits for its turn. Returns its task."""
        task = self.tasks.get(_thread.get_ident())
        if task is not None and task.beside:
            with self.letting_go:
                pass
            if task.beside:
                self._make_ready(task)
                try:
                    self._await_baton(task)
                finally:
                    task.beside = False
                    self.beside.discard(task)
        return task

    def let_go(self, task):
        """Takes the baton from a task that runs and gives it to the next; not while it is in here."""
        with self.letting_go:
            self.beside.add(task)
            task.beside = True
            if self.current is not task or _is_here(sys._current_frames().get(task.ident)):
                task.beside = False
                self.beside.discard(task)
                return
            task.times_beside += 1
            if len(self.beside) == 1:
                self.real_at = _real_monotonic(), self.now
            self.current = None
        self._pass_on()

    # Threads.

    def start(self, function, args, kwargs, starter=None):
        """Starts a thread; it runs when its turn comes. `starter` starts it in the system."""
        self.enter()
        owner = getattr(function, "__self__", None)
        task = _Task(getattr(owner, "name", None) or getattr(function, "__name__", "a thread"))
        if owner is not None and hasattr(owner, "_bootstrap"):
            owner._virtual_task = task

        def body():
            task.ident = _thread.get_ident()
            self.tasks[task.ident] = task
            task.baton.acquire()
            try:
                function(*args, **kwargs)
            finally:
                self._end(task)

        started = (starter or real_start)(body, ())
        self._make_ready(task)
        return started

    def _end(self, task):
        self.enter()
        task.done = True
        while self.wake(task.ended):
            pass
        self.tasks.pop(task.ident, None)
        self._pass_on()

    def join(self, task, timeout_ns):
        """Waits for the end of a thread."""
        if not task.done:
            self.wait(task.ended, timeout_ns)

    def after_fork(self):
        """In a child of `os.fork` only the thread that forked goes on."""
        task = self.tasks.get(_thread.get_ident(), self.current)
        task.ident = _thread.get_ident()
        self.tasks = {task.ident: task}
        self.main = self.current = task
        self.ready.clear()
        self.sleepers.clear()

    # What ends it.

    def _deadlock(self):
        waits = []
        frames = sys._current_frames()
        for ident, task in list(self.tasks.items()):
            waits.append(f"{task.name} at {_place(frames.get(ident))}")
        who = waits[0] if len(waits) == 1 else ", ".join(waits[:-1]) + " and " + waits[-1]
        verb = "waits" if len(waits) == 1 else "wait"
        return f"after {self.now / NS:.3f} s of virtual time {who} {verb} for ever: nothing can happen any more"


def _is_here(frame):
    """True if a thread is in this package."""
    here = os.path.dirname(__file__)
    while frame is not None:
        if os.path.dirname(frame.f_code.co_filename) == here:
            return frame.f_code.co_name != "body"  # which every thread of a program is in
        frame = frame.f_back
    return False


def _place(frame):
    """`file:line` of the innermost frame that belongs to the program, else the innermost one."""
    own = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    library = os.path.dirname(os.path.abspath(os.__file__))
    innermost, at = None, frame
    while at is not None:
        path = os.path.abspath(at.f_code.co_filename)
        if not path.startswith(own) and not at.f_code.co_filename.startswith("<frozen"):
            innermost = innermost or at
            if not path.startswith(library) or "-packages" in path:
                return f"{os.path.relpath(path) if path.startswith(os.getcwd()) else path}:{at.f_lineno}"
        at = at.f_back
    if innermost is None:
        return "a place outside Python"
    code = innermost.f_code
    return f"{os.path.basename(code.co_filename)}:{innermost.f_lineno} ({code.co_name})"


def end(sentence, code=1, before=None):
    """Ends the process with a sentence, whatever its threads do; calls `before` first."""
    if sentence:
        sys.stdout.flush()
        print(f"orb_robot: {sentence}", file=sys.stderr, flush=True)
    if before is None and active is not None:
        before = active.on_fatal
    if before is not None:
        before()
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            pass
    os._exit(code)


def impossible(what):
    """Ends the process: `what` needs real time."""
    end(f"{what} needs real time: run the program without --fast")


def _processor_s(task):
    """How long a thread has been on the processor; real time where the system does not say."""
    try:
        return time.clock_gettime(time.pthread_getcpuclockid(task.ident))
    except (AttributeError, OSError):
        return _real_monotonic()


class Watch:
    """A thread in real time: looks for threads that run without coming to the scheduler."""

    def __init__(self, scheduler):
        self._scheduler = scheduler
        self._process = os.getpid()
        self._running = real_allocate()
        self._running.acquire()
        self._gone = None  # a lock that is free when the thread has ended
        real_start(self._run, ())

    def end(self):
        """Ends the thread: one that still runs when Python ends can crash it."""
        if os.getpid() != self._process:
            return  # a child does not have it
        until = _real_monotonic() + SIGNAL_S
        self._running.release()
        while self._gone is None and _real_monotonic() < until:
            _real_sleep(LOOK_S)
        if self._gone is not None:
            self._gone.acquire(True, SIGNAL_S)

    def _run(self):
        # Python frees this lock when nothing of the thread is left; since 3.13 it has another way, and needs no help.
        self._gone = getattr(_thread, "_set_sentinel", real_allocate)()
        _look(self._scheduler, self._running)


def _look(scheduler, running):
    seen, since, used, said = None, 0.0, 0.0, False
    while True:
        task = scheduler.current
        again = task is not None and task.times_beside > 0
        if running.acquire(True, ALONE_S[again] / 2):
            return
        state = task, scheduler.switches, scheduler.now
        if state != seen or task is None or task.done or task.ident is None:
            if task is not None and task.ident is not None and not task.done:
                seen, since, used = state, _real_monotonic(), _processor_s(task)
            continue
        silent = _real_monotonic() - since
        if len(scheduler.tasks) > 1:
            if silent > OUTSIDE_S or _processor_s(task) - used >= ALONE_S[again]:
                sys.setswitchinterval(LOOK_S)
                scheduler.let_go(task)
            continue
        if silent > SILENCE_S and not said:
            said = True
            print(
                f"orb_robot: {task.name} at {_place(sys._current_frames().get(task.ident))} neither waits nor reads the "
                "clock, so virtual time stands still",
                file=sys.stderr,
                flush=True,
            )
        # Then the limit is one of real time.
        if said and scheduler.limit is not None and nanoseconds(silent) > scheduler.limit - scheduler.now:
            since = _real_monotonic()
            scheduler.interrupt_outside()
