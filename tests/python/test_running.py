"""Running programs as Python does, with a report at the end, whatever the program does."""

import json
import math
import os
import signal
import subprocess
import sys

from conftest import PACKAGE, Outcome, start
from robots import PRELUDE


def test_a_program_finds_what_it_finds_with_python(with_robots, tmp_path):
    program = (
        "import sys, os\nprint(sys.argv, __name__, __file__, os.path.samefile(sys.path[0], '.'), __spec__)\n"
        "print(sys.modules['__main__'].__dict__ is globals())\n"
    )
    (tmp_path / "program.py").write_text(program)
    plain = Outcome(start(["program.py", "a", "--b", "--robot"], tmp_path))
    done = Outcome(start(["-m", "orb_robot", "run", "program.py", "a", "--b", "--fast", "--", "--robot"], tmp_path))
    assert done.out == plain.out
    assert done.err == "SB-0001 (Sphero BOLT): at 0, 0 cm, faces 0°, drove 0 cm in 0.0 s; nobody connected to it\n"


def test_exit_codes_and_tracebacks(with_robots, tmp_path):
    assert with_robots("import sys\nsys.exit(7)").code == 7
    done = with_robots("import sys\nsys.exit('no robot')", "--fast")
    assert done.code == 1 and "no robot\n" in done.err
    done = with_robots("def f(): 1 / 0\nf()\n", "--fast")
    assert done.code == 1
    assert done.err.startswith("Traceback (most recent call last):\n  File ")
    assert "orb_robot" not in done.err and "ZeroDivisionError" in done.err
    assert with_robots("raise KeyboardInterrupt", "--fast").code == 130
    (tmp_path / "tool.py").write_text("import sys; print(sys.argv[1:], __name__)")
    done = Outcome(start(["-m", "orb_robot", "run", "-m", "tool", "--fast", "--", "x"], tmp_path))
    assert done.out == "['x'] __main__\n", done.err


def test_mistakes_in_the_arguments(with_robots, tmp_path):
    done = with_robots("", "--robot", "blot")
    assert done.code == 2 and "there is no robot `blot`; did you mean `bolt`?" in done.err
    assert with_robots("", "--robot", "sphero").code == 2
    assert with_robots("", "--count", "0").code == 2
    done = with_robots("", "--for", "soon")
    assert done.code == 2 and "argument --for: `soon` is no time; write 90s or 2min" in done.err
    for wrong in ("-1", "x", str(2**64)):
        done = with_robots("", "--seed", wrong)
        assert done.code == 2 and f"argument --seed: `{wrong}` is no whole number from 0 to 18446744073709551615" in done.err
    assert with_robots("", "--stimulus", "push").code == 2
    assert with_robots("", "--name", "a", "--name", "b").code == 2
    assert Outcome(start(["-m", "orb_robot", "run", "nowhere.py"], tmp_path)).code == 2


def test_what_is_said_at_the_end(with_robots):
    done = with_robots(
        PRELUDE
        + """
async def main():
    client = await opened()
    await send(client, v2(0x13, 0x0D))
    await send(client, v2(0x16, 7, 100, 0, 0, 0))
    await asyncio.sleep(1)
asyncio.run(main())
""",
        "--fast",
        "--count",
        "2",
    )
    first, second = done.err.splitlines()
    assert first.startswith("SB-0001 (Sphero BOLT): at 0, ") and "; it was left driving, at " in first
    assert second.endswith("nobody connected to it")


def test_the_report_is_written_whatever_happens(with_robots, tmp_path):
    for program in (
        "",
        "1 / 0",
        "import sys; sys.exit(3)",
        "raise KeyboardInterrupt",
        "import os, signal; os.kill(os.getpid(), signal.SIGTERM)",
        "import threading; threading.Event().wait()",
    ):
        page = tmp_path / "page.html"
        done = with_robots(program, "--fast", "--report", str(page), "--stimulus", "at 2s push 90 120")
        assert "<html" in page.read_text(), (program, done.err)
        page.unlink()
    done = with_robots("import threading; threading.Event().wait()", "--for", "1s", "--report", str(page))
    assert done.code == 0 and page.exists(), done.err


HOSTILE = {
    "never awaits": ("async def main():\n    client = BleakClient('68:86:E7:00:00:01')\n    client.connect()\n", 0),
    "exits in a callback": (
        """
async def main():
    client = await opened()
    await client.start_notify(API, lambda sender, data: sys.exit(5))
    await send(client, v2(0x10, 0))
    await asyncio.sleep(100)
""",
        5,
    ),
    "forks": (
        """
import os
import signal
async def main():
    client = await opened()
    if os.fork(): os.wait()
    else: sys.exit(0)
    await send(client, v2(0x10, 0))
""",
        0,
    ),
    "leaves a thread that waits for ever": (
        """
import threading
async def main():
    await opened()
    threading.Thread(target=threading.Event().wait).start()
""",
        1,
    ),
    "writes from another thread": (
        """
async def main():
    client = await opened()
    await asyncio.to_thread(lambda: asyncio.run(send(client, v2(0x10, 0))))
""",
        0,
    ),
}


def test_hostile_programs(with_robots):
    for name, (program, code) in HOSTILE.items():
        done = with_robots(f"{PRELUDE}{program}\nasyncio.run(main())\n", "--fast")
        assert done.code == code, (name, done.err)
        assert done.err.count("SB-0001 (Sphero BOLT): at ") == 1, (name, done.err)


DRIVES = {
    "bolt": "v2(0x16, 7, 90, heading >> 8, heading & 255, 0)",
    "mini": "v2(0x16, 7, 150, heading >> 8, heading & 255, 0)",
    "sprk+": "v1(2, 0x30, 90, heading >> 8, heading & 255, 1)",
}
DRIVE = """
async def main():
    client = await opened()
    wake = v2(0x13, 0x0D) if client.services.get_characteristic(API) else v1(0, 1)
    await send(client, wake)
    began = time.monotonic()
    for heading in (0, 90, 180, 270):
        await send(client, {packet})
        await asyncio.sleep(0.5)
    await send(client, {stop})
    took = time.monotonic() - began
    await asyncio.sleep(0.5)
    return took
took = asyncio.run(main())
from orb_robot import air
import json
print(json.dumps([took, air.current().world.robots[0].path()]))
"""
#: A command can come a turn of the link later, besides what the computer is late.
TURN_S = 0.015


def test_the_path_is_the_same_in_both_times(tmp_path):
    runs = {}
    for kind, packet in DRIVES.items():
        stop = "v1(2, 0x30, 0, 0, 0, 0)" if kind == "sprk+" else "v2(0x16, 7, 0, 0, 0, 0)"
        file = tmp_path / f"{kind}.py"
        file.write_text(PRELUDE + DRIVE.format(packet=packet, stop=stop))
        for fast in ((), ("--fast",)):
            runs[kind, bool(fast)] = subprocess.Popen(
                [sys.executable, "-m", "orb_robot", "run", str(file), "--robot", kind, *fast],
                env=dict(os.environ, PYTHONPATH=PACKAGE),
                stdout=subprocess.PIPE,
                text=True,
            )
    drives = {key: json.loads(run.communicate(timeout=60)[0].splitlines()[-1]) for key, run in runs.items()}
    for kind in DRIVES:
        (took, real), (would_take, virtual) = drives[kind, False], drives[kind, True]
        fastest = max(place[4] for place in virtual)
        near = fastest * (abs(took - would_take) + 4 * TURN_S)
        ends = real[-1][1:3], virtual[-1][1:3]
        assert math.dist(*ends) < near, (kind, ends, near)
        assert max(math.dist((0, 0), place[1:3]) for place in virtual) > 20, kind
        for place in virtual[:: max(1, len(virtual) // 20)]:
            nearest = min(math.dist(place[1:3], other[1:3]) for other in real)
            assert nearest < near, (kind, place, nearest, near)


def test_ctrl_c_in_real_time(tmp_path):
    file = tmp_path / "program.py"
    file.write_text("import time\nprint('ready', flush=True)\nwhile True: time.sleep(1)\n")
    page = tmp_path / "page.html"
    run = subprocess.Popen(
        [sys.executable, "-m", "orb_robot", "run", str(file), "--report", str(page)],
        env=dict(os.environ, PYTHONPATH=PACKAGE),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert run.stdout.readline() == "ready\n"
    run.send_signal(signal.SIGINT)
    _, said = run.communicate(timeout=60)
    assert run.returncode == 130 and page.exists(), said
    assert "KeyboardInterrupt" in said and "orb_robot" not in said and "SB-0001 (Sphero BOLT): at " in said
