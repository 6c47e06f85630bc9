"""Drives a real BOLT or Mini in a square, over Bluetooth LE: `python3 square.py`. Without one:
`python3 -m orb_robot run square.py --robot bolt --fast --report square.html`.
"""
import asyncio

from bleak import BleakClient, BleakScanner

GREETING = "00020005-574f-4f20-5370-6865726f2121"
PACKETS = "00010002-574f-4f20-5370-6865726f2121"
ESCAPED = {0x8D: b"\xab\x05", 0xD8: b"\xab\x50", 0xAB: b"\xab\x23"}


def packet(did, cid, *data, seq=0):
    """A command: device and command id, and its data; it asks for an answer."""
    inner = bytes([0x0A, did, cid, seq, *data])
    inner += bytes([~sum(inner) & 0xFF])
    return b"\x8d" + b"".join(ESCAPED.get(byte, bytes([byte])) for byte in inner) + b"\xd8"


def drive(speed, heading):
    return packet(0x16, 0x07, speed, heading >> 8, heading & 0xFF, 0)


async def main():
    robot = await BleakScanner.find_device_by_filter(lambda device, _: (device.name or "").startswith(("SB-", "SM-")))
    if robot is None:
        raise SystemExit("no BOLT or Mini is near; wake it up")
    async with BleakClient(robot) as client:
        await client.start_notify(PACKETS, lambda _, data: None)
        await client.write_gatt_char(GREETING, b"usetheforce...band", response=True)
        await client.write_gatt_char(PACKETS, packet(0x13, 0x0D))
        await asyncio.sleep(1)
        try:
            for heading in (0, 90, 180, 270):
                await client.write_gatt_char(PACKETS, drive(100, heading))  # a Mini moves from 84 on
                await asyncio.sleep(1)
                await client.write_gatt_char(PACKETS, drive(0, heading))
                await asyncio.sleep(1)
        finally:
            await client.write_gatt_char(PACKETS, drive(0, 0))
    print("back at", robot.name)


asyncio.run(main())
