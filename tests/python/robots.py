"""The beginning of the programs in these tests: packets v1 and v2, and a connected robot."""

PRELUDE = '''
import asyncio, sys, time
from bleak import BleakClient, BleakError, BleakScanner
from bleak.exc import BleakDBusError, BleakDeviceNotFoundError

API, WORD = "00010002-574f-4f20-5370-6865726f2121", "00020005-574f-4f20-5370-6865726f2121"
COMMANDS, ANSWERS = "22bb746f-2ba1-7554-2d6f-726568705327", "22bb746f-2ba6-7554-2d6f-726568705327"
ANTI_DOS = "22bb746f-2bbd-7554-2d6f-726568705327"
count = 0

def v2(did, cid, *data):
    global count
    count = (count + 1) % 255
    body = [0x0A, did, cid, count, *data]
    body.append(~sum(body) & 0xFF)
    out = b""
    for each in body:
        out += {0xAB: b"\\xab\\x23", 0x8D: b"\\xab\\x05", 0xD8: b"\\xab\\x50"}.get(each, bytes([each]))
    return b"\\x8d" + out + b"\\xd8"

def v1(did, cid, *data):
    global count
    count = (count + 1) % 256
    body = [did, cid, count, len(data) + 1, *data]
    return bytes([0xFF, 0xFF, *body, ~sum(body) & 0xFF])

async def opened(**more):
    device = await BleakScanner.find_device_by_filter(lambda d, ad: True)
    client = BleakClient(device, **more)
    await client.connect()
    if client.services.get_characteristic(WORD):
        await client.write_gatt_char(WORD, b"usetheforce...band", response=True)
    if client.services.get_characteristic(ANTI_DOS):
        await client.write_gatt_char(ANTI_DOS, b"011i3", response=True)
    return client

async def send(client, packet):
    to = API if client.services.get_characteristic(API) else COMMANDS
    await client.write_gatt_char(to, packet, response=True)
'''
