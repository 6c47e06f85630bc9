"""silent_ball.py COUNT...: a ball on a TCP port that falls silent after this many answers.

Prints the port, then serves one client per COUNT, and exits. For each client it prints when it first left a packet
unanswered.
"""

import socket
import sys

ANSWERS = {  # of what a greeting asks for
    (0x00, 0x02): "02 02 03 03 33 21 16 04 01 32",
    (0x00, 0x20): "01 02 03 0C 00 00 00 00",
}
HEADER = 6  # bytes of a packet before its data: start, start, device, command, sequence, length


def packet(seq: int, data: bytes) -> bytes:
    body = bytes([0, seq, len(data) + 1]) + data
    return b"\xff\xff" + body + bytes([~sum(body) & 0xFF])


def serve(client: socket.socket, count: int) -> None:
    heard = b""
    while True:
        try:
            read = client.recv(4096)
        except ConnectionError:
            return
        if not read:
            return
        heard += read
        while len(heard) >= HEADER and len(heard) >= HEADER + heard[5]:
            did, cid, seq, size = heard[2:HEADER]
            heard = heard[HEADER + size :]
            if count > 0:
                client.sendall(packet(seq, bytes.fromhex(ANSWERS.get((did, cid), ""))))
            elif count == 0:
                print("silent", flush=True)
            count -= 1


listener = socket.create_server(("127.0.0.1", 0))
print(listener.getsockname()[1], flush=True)
for wanted in sys.argv[1:]:
    with listener.accept()[0] as connection:
        serve(connection, int(wanted))
