"""Drives a robot over Bluetooth LE as Python libraries do, with Bleak: finds it by name, writes the
greeting, subscribes, then sends packets in pieces and waits for answers.

bleak_client.py NAME: exits with 0 if the robot did all of it."""

import asyncio
import sys

from bleak import BleakClient, BleakScanner


def uuid(short):
    return f"22bb746f-{short}-7554-2d6f-726568705327"


ANTI_DOS, TX_POWER, WAKE = uuid("2bbd"), uuid("2bb2"), uuid("2bbf")
COMMANDS, ANSWERS = uuid("2ba1"), uuid("2ba6")
MOST = 20  # bytes of a piece


class Robot:
    def __init__(self, client):
        self.client = client
        self.seq = 0
        self.bytes = bytearray()
        self.arrived = asyncio.Event()

    def on_notification(self, _, data):
        assert len(data) <= MOST, data
        self.bytes += data
        self.arrived.set()

    async def open(self):
        await self.client.write_gatt_char(ANTI_DOS, b"011i3", response=True)
        await self.client.write_gatt_char(TX_POWER, b"\x07", response=True)
        await self.client.write_gatt_char(WAKE, b"\x01", response=True)
        await self.client.start_notify(ANSWERS, self.on_notification)

    def answer(self):
        """Returns the data of the answer to the last command, once it is complete."""
        at = 0
        while len(self.bytes) - at >= 5:
            kind, length = self.bytes[at + 1], self.bytes[at + 4]
            if kind == 0xFE:
                length += self.bytes[at + 3] << 8
            end = at + 5 + length
            if len(self.bytes) < end:
                return None
            if kind == 0xFF and self.bytes[at + 3] == self.seq:
                code, data = self.bytes[at + 2], bytes(self.bytes[at + 5 : end - 1])
                assert code == 0, f"the robot refused: {code:02X}h"
                return data
            at = end
        return None

    async def ask(self, did, cid, *data):
        self.seq = (self.seq + 1) % 256
        body = bytes([did, cid, self.seq, len(data) + 1, *data])
        packet = b"\xff\xff" + body + bytes([~sum(body) & 0xFF])
        self.bytes.clear()
        for at in range(0, len(packet), MOST):
            await self.client.write_gatt_char(COMMANDS, packet[at : at + MOST], response=True)
        while (found := self.answer()) is None:
            self.arrived.clear()
            await asyncio.wait_for(self.arrived.wait(), 10)
        return found


async def main(name):
    device = await BleakScanner.find_device_by_filter(lambda d, _: d.name == name, timeout=10)
    assert device, f"{name} was not found"
    async with BleakClient(device) as client:
        assert {c.uuid for s in client.services for c in s.characteristics} >= {COMMANDS, ANSWERS}
        robot = Robot(client)
        await robot.open()
        await robot.ask(0x00, 0x01)  # ping
        versions = await robot.ask(0x00, 0x02)
        assert versions[0] == 2, versions
        await robot.ask(0x02, 0x20, 10, 20, 30, 1)  # colour, as the user has chosen it
        assert await robot.ask(0x02, 0x22) == bytes([10, 20, 30])
        await robot.ask(0x02, 0x30, 120, 0, 90, 1)  # roll, east
        await asyncio.sleep(1)
        await robot.ask(0x02, 0x30, 0, 0, 90, 0)
        place = await robot.ask(0x02, 0x15)  # locator
        x = int.from_bytes(place[0:2], "big", signed=True)
        assert x >= 5, f"x is {x} cm"
        # A program in one fragment of several pieces, and a run of it.
        program = b'10 print "' + b"x" * 30 + b'"\n\0'
        await robot.ask(0x02, 0x60, 0)
        await robot.ask(0x02, 0x61, 0, *program)
        await robot.ask(0x02, 0x62, 0, 0, 10)
        await asyncio.sleep(0.3)
        assert b"x" * 30 in bytes(robot.bytes), bytes(robot.bytes)
        await client.stop_notify(ANSWERS)
    assert not client.is_connected
    print(f"bleak: {name} was found, opened, driven to x = {x} cm, and ran a program")


asyncio.run(main(sys.argv[1]))
