"""The locks of `_thread`, with waits that take virtual time."""

import _thread
from collections import deque

from . import scheduler
from .scheduler import LOCK_NS, nanoseconds


class Lock:
    """A lock whose waits take virtual time. Given to those that wait in the order in which they came."""

    __slots__ = ("_held", "_waits", "__weakref__")

    def __init__(self):
        self._held = False
        self._waits = deque()

    def acquire(self, blocking=True, timeout=-1):
        """Takes the lock; waits at most `timeout` seconds (-1: for ever). Returns whether it was taken."""
        _check_timeout(blocking, timeout)
        scheduler.active.spend(LOCK_NS)
        if not self._held:
            self._held = True
            return True
        if not blocking or timeout == 0:
            return False
        return scheduler.active.wait(self._waits, None if timeout < 0 else nanoseconds(timeout))

    def release(self):
        """Gives the lock to the first that waits for it."""
        if not self._held:
            raise RuntimeError("release unlocked lock")
        if scheduler.active.beside:
            scheduler.active.enter()
        if not scheduler.active.wake(self._waits):
            self._held = False

    def locked(self):
        """True if a thread holds it."""
        return self._held

    def _at_fork_reinit(self):
        self._held = False
        self._waits = deque()

    acquire_lock, release_lock, locked_lock = acquire, release, locked

    def __enter__(self):
        return self.acquire()

    def __exit__(self, *_):
        self.release()

    def __repr__(self):
        return f"<{'locked' if self._held else 'unlocked'} virtual lock at {id(self):#x}>"


class RLock:
    """A lock that its owner can take again."""

    __slots__ = ("_lock", "_owner", "_count", "__weakref__")

    def __init__(self):
        self._lock = Lock()
        self._owner = None
        self._count = 0

    def acquire(self, blocking=True, timeout=-1):
        """As `Lock.acquire`; at once for the thread that has it."""
        me = _thread.get_ident()
        if self._owner == me:
            _check_timeout(blocking, timeout)
            self._count += 1
            return True
        if not self._lock.acquire(blocking, timeout):
            return False
        self._owner, self._count = me, 1
        return True

    def release(self):
        """Undoes one `acquire`."""
        if self._owner != _thread.get_ident():
            raise RuntimeError("cannot release un-acquired lock")
        self._count -= 1
        if self._count == 0:
            self._owner = None
            self._lock.release()

    def locked(self):
        """True if a thread holds it."""
        return self._owner is not None

    def _is_owned(self):
        return self._owner == _thread.get_ident()

    def _release_save(self):
        saved = self._count, self._owner
        self._count, self._owner = 0, None
        self._lock.release()
        return saved

    def _acquire_restore(self, saved):
        self._lock.acquire()
        self._count, self._owner = saved

    def _recursion_count(self):
        return self._count if self._is_owned() else 0

    def _at_fork_reinit(self):
        self._lock._at_fork_reinit()
        self._owner, self._count = None, 0

    def __enter__(self):
        return self.acquire()

    def __exit__(self, *_):
        self.release()

    def __repr__(self):
        return f"<virtual RLock owner={self._owner} count={self._count} at {id(self):#x}>"


def _check_timeout(blocking, timeout):
    if not blocking and timeout != -1:
        raise ValueError("can't specify a timeout for a non-blocking call")
    if timeout < 0 and timeout != -1:
        raise ValueError("timeout value must be a non-negative number")
