"""Virtual time: what takes how long, in which order, and how it ends."""

import time


def test_sleeping_takes_virtual_time_only(virtually):
    began = time.monotonic()
    done = virtually(
        """
import time
t = time.time()
time.sleep(3600)
print(round(time.time() - t, 3), time.monotonic_ns() - time.perf_counter_ns() < 0)
"""
    )
    assert done.out == "3600.0 True\n", done.err
    assert time.monotonic() - began < 60


def test_threads_run_in_the_order_of_their_deadlines(virtually):
    done = virtually(
        """
import threading, time
said = []
def work(name, period):
    for _ in range(3):
        time.sleep(period)
        said.append(name)
threads = [threading.Thread(target=work, args=each) for each in (("a", 0.3), ("b", 0.5))]
for each in threads: each.start()
for each in threads: each.join()
print("".join(said), round(time.monotonic() % 1000, 2))
"""
    )
    assert done.out == "abaabb 1.5\n", done.err


def test_every_way_to_wait(virtually):
    done = virtually(
        """
import concurrent.futures, queue, sched, threading, time
start = time.monotonic()
def now(): return round(time.monotonic() - start, 2)
q = queue.SimpleQueue()
threading.Timer(2, q.put, ("q",)).start()
print(q.get(), now())
try: queue.Queue().get(timeout=1.5)
except queue.Empty: print("empty", now())
print(threading.Event().wait(1), threading.Lock().acquire(timeout=1), now())
semaphore = threading.Semaphore(0)
print(semaphore.acquire(timeout=0.5), now())
barrier = threading.Barrier(2)
threading.Thread(target=lambda: (time.sleep(1), barrier.wait())).start()
barrier.wait()
print(now())
condition = threading.Condition()
with condition: print(condition.wait_for(lambda: now() > 5.5, timeout=10) , now())
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    print(list(pool.map(lambda each: (time.sleep(1), each)[1], range(4))), now())
    try: pool.submit(time.sleep, 9).result(1)
    except concurrent.futures.TimeoutError: print("late", now())
print(now())
s = sched.scheduler()
s.enter(1, 1, print, ("scheduled",))
s.run()
print(now())
thread = threading.Thread(target=time.sleep, args=(1,))
thread.start()
thread.join(0.25)
print(thread.is_alive(), now())
thread.join()
print(thread.is_alive(), now())
"""
    )
    assert done.out.splitlines() == [
        "q 2.0",
        "empty 3.5",
        "False True 4.5",
        "False 5.0",
        "6.0",
        "True 6.0",
        "[0, 1, 2, 3] 8.0",
        "late 9.0",
        "17.0",
        "scheduled",
        "18.0",
        "True 18.25",
        "False 19.0",
    ], done.err


def test_event_loops_in_threads(virtually):
    done = virtually(
        """
import asyncio, threading, time
start = time.monotonic()
def now(): return round(time.monotonic() - start, 2)
async def nap(duration):
    await asyncio.sleep(duration)
    return now()
loop = asyncio.new_event_loop()
thread = threading.Thread(target=loop.run_forever)
thread.start()
print(asyncio.run_coroutine_threadsafe(nap(1), loop).result(10))
async def both():
    there = asyncio.wrap_future(asyncio.run_coroutine_threadsafe(nap(2), loop))
    return await asyncio.gather(there, nap(1), asyncio.get_running_loop().run_in_executor(None, time.sleep, 3))
print(asyncio.run(both()), now())
print(asyncio.run(nap(1)))
try: asyncio.run(asyncio.wait_for(nap(5), 2))
except asyncio.TimeoutError: print("timeout", now())
loop.call_soon_threadsafe(loop.stop)
thread.join()
"""
    )
    assert done.out.splitlines() == ["1.0", "[3.0, 2.0, None] 4.0", "5.0", "timeout 7.0"], done.err


def test_a_busy_loop_ends_and_lets_others_run(virtually):
    done = virtually(
        """
import datetime, threading, time
said = []
threading.Timer(1, said.append, ("timer",)).start()
end = time.time() + 2
while time.time() < end: pass
print(said, round(time.time() - end, 3))
began = datetime.datetime.now()
while datetime.datetime.now() - began < datetime.timedelta(seconds=1): pass
print(type(began + datetime.timedelta(1)).__name__, isinstance(began, datetime.datetime))
"""
    )
    assert done.out == "['timer'] 0.0\ndatetime True\n", done.err


def test_the_same_run_twice_is_the_same(virtually):
    program = """
import asyncio, datetime, threading, time
async def work(name):
    for _ in range(20):
        await asyncio.sleep(0.01)
        print(name, time.time(), datetime.datetime.now())
threads = [threading.Thread(target=lambda n=n: asyncio.run(work(n))) for n in range(3)]
for each in threads: each.start()
for each in threads: each.join()
"""
    first, second = virtually(program), virtually(program)
    assert first.out == second.out and first.out.count("\n") == 60, first.err


def test_names_that_were_imported_before(virtually):
    done = virtually(
        """
sleep(100); print(round(monotonic() - 1000), time.strftime("%H:%M"), time.gmtime().tm_year)
""",
        begin="import time, os; os.environ['TZ'] = 'UTC'\nfrom time import sleep, monotonic\n"
        "import asyncio, concurrent.futures.thread\n"
        "from orb_robot import virtual_time; virtual_time.install()\n",
    )
    assert done.out == "100 22:15 2023\n", done.err


def test_who_waits_for_ever_is_said(virtually):
    done = virtually(
        """
import threading, time
def worker():
    time.sleep(2.5)
    threading.Event().wait()
threading.Thread(target=worker, name="worker").start()
lock = threading.Lock()
lock.acquire()
lock.acquire()
"""
    )
    assert done.code == 1
    assert "after 2.50" in done.err
    assert "MainThread at program.py:10 and worker at program.py:6 wait for ever" in done.err


def test_an_idle_event_loop_waits_for_ever(virtually):
    done = virtually("import asyncio\nasyncio.run(asyncio.Event().wait())\n")
    assert done.code == 1
    assert "MainThread at program.py:3 waits for ever" in done.err


def test_ctrl_c(virtually):
    done = virtually(
        """
import os, signal, threading, time
def press(): os.kill(os.getpid(), signal.SIGINT)
threading.Timer(5, press).start()
try:
    while True: time.sleep(1)
except KeyboardInterrupt:
    print("stopped", round(time.monotonic() - 1000))
lock = threading.Lock()
lock.acquire()
threading.Timer(1, press).start()
try: lock.acquire()
except KeyboardInterrupt: print("stopped")
lock.release()
print(lock.acquire(False))
"""
    )
    assert done.out == "stopped 5\nstopped\nTrue\n", done.err


def test_what_watches_has_ended_when_python_does(virtually):
    begin = (
        "import atexit, _thread\natexit.register(lambda: print(_thread._count(), 'threads'))\n"
        "from orb_robot import virtual_time; virtual_time.install()\n"
    )
    assert virtually("", begin).out == "0 threads\n"


def test_a_signal_may_come_late(virtually):
    done = virtually(
        """
import signal, threading
signal.signal(signal.SIGALRM, signal.default_int_handler)
signal.setitimer(signal.ITIMER_REAL, 0.4)
try: threading.Event().wait()
except KeyboardInterrupt: print("stopped")
"""
    )
    assert done.out == "stopped\n", done.err


def test_a_signal_may_come_just_before_a_wait(virtually):
    done = virtually(
        """
import os, signal, threading
def press(): os.kill(os.getpid(), signal.SIGINT)
lock = threading.Lock()
lock.acquire()
for _ in range(200):
    later = threading.Timer(0.001, press)
    later.start()
    try: lock.acquire()
    except KeyboardInterrupt: pass
    later.join()
print("stopped")
"""
    )
    assert done.out == "stopped\n", done.err


def test_a_limit_ends_what_never_waits(virtually):
    begin = (
        "from orb_robot import virtual_time\nfrom orb_robot.virtual_time import scheduler\n"
        "scheduler.SILENCE_S, scheduler.GRACE_NS = 0.1, 10**8\nvirtual_time.install(limit=1)\n"
    )
    done = virtually("while True: pass\n", begin)
    assert done.code == -2 and "neither waits nor reads the clock" in done.err and "KeyboardInterrupt" in done.err
    done = virtually("while True:\n  try:\n    while True:\n      n = 0\n  except KeyboardInterrupt: print('no')\n", begin)
    assert done.code == 0 and done.out == "no\n", done.err


def test_a_limit_is_ctrl_c_after_a_time(virtually):
    begin = "from orb_robot import virtual_time; virtual_time.install(limit=20)\n"
    done = virtually(
        """
import threading, time
try: threading.Event().wait()
except KeyboardInterrupt: print(round(time.monotonic() - 1000))
""",
        begin,
    )
    assert done.out == "20\n", done.err
    done = virtually(
        """
import asyncio, time
async def main():
    try: await asyncio.sleep(1000)
    except asyncio.CancelledError: print("cancelled", round(time.monotonic() - 1000)); raise
try: asyncio.run(main())
except KeyboardInterrupt: print("stopped")
""",
        begin,
    )
    assert done.out.endswith("stopped\n"), done.err
    done = virtually(
        """
import time
while True:
    try: time.sleep(1)
    except KeyboardInterrupt: print("no", flush=True)
""",
        begin,
    )
    assert (done.code, done.out) == (0, "no\n"), done.err


def test_what_needs_real_time_is_said(virtually):
    for program, what in (
        ("import socket\nsocket.create_connection(('127.0.0.1', 9))", "the network"),
        ("import socket\nsocket.socket().connect(('127.0.0.1', 9))", "a connection over a socket"),
        ("import multiprocessing\nmultiprocessing.Process(target=print).start()", "`multiprocessing`"),
        ("import select, sys\nselect.select([sys.stdin], [], [], 1)", "`select`"),
        ("import curses", "`import curses`"),
        ("import asyncio\nasyncio.new_event_loop().add_reader(0, print)", "waiting for the keyboard"),
    ):
        done = virtually(program)
        assert done.code == 1, program
        assert done.err == f"orb_robot: {what} needs real time: run the program without --fast\n"


def test_a_child_goes_on_alone(virtually):
    done = virtually(
        """
import os, threading, time
threading.Thread(target=time.sleep, args=(2,)).start()
time.sleep(1)
child = os.fork()
if not child:
    time.sleep(5)
    print("child", round(time.monotonic() - 1000), flush=True)
    os._exit(0)
os.waitpid(child, 0)
print("parent", round(time.monotonic() - 1000))
virtual_time.finish_threads()
"""
    )
    assert done.out == "child 6\nparent 1\n", done.err


def test_a_thread_that_only_looks_at_a_variable(virtually):
    began = time.monotonic()
    done = virtually(
        """
import threading, time
ready, seen = False, False
def work():
    global seen
    while not ready: pass
    seen = True
    time.sleep(100)
    print("work", round(time.monotonic() - 1000) // 100)
thread = threading.Thread(target=work)
thread.start()
time.sleep(0.5)
ready = True
while not seen: pass
t = time.monotonic()
print(0.5 <= t - 1000 < 3)
thread.join()
"""
    )
    assert done.out == "True\nwork 1\n", done.err
    assert time.monotonic() - began < 60


def test_a_thread_that_looks_into_a_queue(virtually):
    done = virtually(
        """
import queue, threading, time
q = queue.Queue()
def work():
    while True:
        if not q.empty():
            print(q.get(), round(time.monotonic() - 1000, 1))
            break
thread = threading.Thread(target=work)
thread.start()
time.sleep(2)
q.put("now")
thread.join()
"""
    )
    assert done.out == "now 2.0\n", done.err


def test_another_process_takes_no_virtual_time(virtually):
    done = virtually(
        """
import subprocess, sys, time
for _ in range(2): subprocess.run([sys.executable, "-c", "print('there', flush=True)"])
print("here", round(time.monotonic() - 1000, 1), flush=True)
"""
    )
    assert (done.code, done.out) == (0, "there\nthere\nhere 0.0\n"), done.err
    assert done.err == "orb_robot: another process takes no virtual time\n"
