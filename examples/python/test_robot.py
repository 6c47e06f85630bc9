"""How the fixtures of conftest.py are used: `pytest-3 examples/python`."""
import pathlib
import socket

EXAMPLES = pathlib.Path(__file__).parent.parent


def command(did, cid, data=b"", seq=7):
    """A packet of the API: FF FF DID CID SEQ DLEN DATA CHK."""
    body = bytes([did, cid, seq, len(data) + 1]) + data
    return b"\xff\xff" + body + bytes([~sum(body) & 0xFF])


def test_ping_is_answered(ball):
    with socket.create_connection(ball, timeout=5) as link:
        link.sendall(command(0x00, 0x01))
        assert link.recv(64)[:4] == b"\xff\xff\x00\x07"


def test_fibonacci_prints_its_numbers(run):
    prints = [event["text"] for event in run(EXAMPLES / "numbers" / "fibonacci.orb") if event["event"] == "print"]
    assert prints[4] == "F(5) = 5\n"


def test_star_comes_back_to_where_it_began(run):
    last = [event for event in run(EXAMPLES / "drawing" / "star.bas") if event["event"] == "pose"][-1]
    assert abs(last["x"]) < 30 and abs(last["y"]) < 30
