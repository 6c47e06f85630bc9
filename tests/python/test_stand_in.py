"""The stand-in for Bleak: what its robots do, and which errors it raises, in virtual time."""

import pytest
from robots import PRELUDE


@pytest.fixture
def bleak(with_robots):
    """Runs the body of a coroutine with robots, in virtual time; it must end well."""

    def run(body, *options):
        lines = "\n".join("    " + line for line in body.strip().splitlines())
        done = with_robots(f"{PRELUDE}\nasync def main():\n{lines}\nasyncio.run(main())\n", "--fast", *options)
        assert done.code == 0, done.err
        return done

    return run


def test_scanning(bleak):
    done = bleak(
        """
t = time.monotonic()
for device in await BleakScanner.discover(2.0): print(device, device.name, device.address)
print(round(time.monotonic() - t, 1))
for address, (device, data) in (await BleakScanner.discover(return_adv=True)).items():
    print(address == device.address, data.local_name, data.service_uuids, data.rssi < 0)
print((await BleakScanner.find_device_by_name("SB-0002")).name)
print((await BleakScanner.find_device_by_address("68:86:e7:00:00:03")).name)
t = time.monotonic()
print(await BleakScanner.find_device_by_name("SB-FFFF", timeout=3), round(time.monotonic() - t, 1))
print(await BleakScanner.discover(0.5, service_uuids=["180a"]))
heard = []
async with BleakScanner(lambda device, data: heard.append(device.name)) as scanner:
    await asyncio.sleep(1.05)
    print(len(scanner.discovered_devices), len(heard))
async def hear(device, data): heard.append(data)
heard = []
scanner = BleakScanner()
scanner.register_detection_callback(hear)
await scanner.start()
async for device, data in scanner.advertisement_data():
    await asyncio.sleep(0.2)
    print(device.name, type(heard[0]).__name__)
    break
await scanner.stop()
import bleak
print(len(await bleak.discover(timeout=1)))
""",
        "--count",
        "3",
    )
    assert done.out.splitlines() == [
        "68:86:E7:00:00:01: SB-0001 SB-0001 68:86:E7:00:00:01",
        "68:86:E7:00:00:02: SB-0002 SB-0002 68:86:E7:00:00:02",
        "68:86:E7:00:00:03: SB-0003 SB-0003 68:86:E7:00:00:03",
        "2.0",
        *(f"True SB-000{i} ['00010001-574f-4f20-5370-6865726f2121'] True" for i in (1, 2, 3)),
        "SB-0002",
        "SB-0003",
        "None 3.0",
        "[]",
        "3 31",
        "SB-0002 AdvertisementData",
        "3",
    ]


def test_a_name_and_an_address_of_ones_own(bleak):
    done = bleak(
        """
device = await BleakScanner.find_device_by_name("SM-1A2B")
print(device)
async with BleakClient("cc:f7:8f:11:bc:51") as client: print(await client.read_gatt_char("2A00"), client.name)
""",
        *("--robot", "mini", "--name", "SM-1A2B", "--address", "CC:F7:8F:11:BC:51"),
    )
    assert done.out == "CC:F7:8F:11:BC:51: SM-1A2B\nbytearray(b'SM-1A2B') SM-1A2B\n"


def test_connecting(bleak):
    done = bleak(
        """
client = BleakClient("68:86:E7:00:00:01", disconnected_callback=lambda c: print("gone", c is client, bool(c.is_connected)))
print(client.is_connected, await client.is_connected(), await client.connect(), client.is_connected == True)
if client.is_connected: print("it is")
for error in (client.connect(), BleakClient("11:22:33:44:55:66", timeout=1).connect()):
    try: await error
    except BleakError as caught: print(type(caught).__name__, caught)
print(await BleakScanner.discover(1))
print(client.mtu_size, client.address, client)
await client.disconnect()
print(await client.disconnect(), [d.name for d in await BleakScanner.discover(1)])
await client.connect()
""",
        "--robot",
        "bolt",
    )
    assert done.out.splitlines() == [
        "False False True True",
        "it is",
        "BleakError Client is already connected",
        "BleakDeviceNotFoundError Device with address 11:22:33:44:55:66 was not found.",
        "[]",
        "23 68:86:E7:00:00:01 BleakClient, 68:86:E7:00:00:01",
        "gone True False",
        "True ['SB-0001']",
    ]


def test_services(bleak):
    done = bleak(
        """
client = await opened()
services = client.services
print(len(list(services)), services.get_service(API) is None, services.get_service("00010001" + API[8:]).uuid[:8])
characteristic = services.get_characteristic(API)
print(characteristic.handle, services.get_characteristic(0x1C) is characteristic, services[API] is characteristic)
print(characteristic.properties, characteristic.service_handle, characteristic.descriptors[0].uuid[:8])
print((await client.get_services()) is services, services.get_characteristic("2a00").description)
import uuid
await client.write_gatt_char(uuid.UUID(API), v2(0x10, 0))
await client.write_gatt_char(characteristic, bytearray(v2(0x10, 0)), response=False)
await client.write_gatt_char(0x1B, memoryview(v2(0x10, 0)), True)
handle = characteristic.descriptors[0].handle
print(await client.read_gatt_descriptor(handle))
await client.start_notify(API, lambda sender, data: None)
print(await client.read_gatt_descriptor(handle))
"""
    )
    assert done.out.splitlines() == [
        "5 True 00010001",
        "27 True True",
        "['write-without-response', 'write', 'notify'] 26 00002902",
        "True Device Name",
        "bytearray(b'\\x00\\x00')",
        "bytearray(b'\\x01\\x00')",
    ]


def test_all_that_a_mini_has(bleak):
    done = bleak(
        """
client = await opened()
for service in client.services:
    for one in service.characteristics:
        value = (await client.read_gatt_char(one)).hex() if "read" in one.properties else "-"
        print(service.handle, one.handle, one.uuid[4:8], ",".join(one.properties), value)
""",
        *("--robot", "mini"),
    )
    assert done.out.splitlines() == [
        "1 2 2a00 read 534d2d30303031",
        "1 4 2a01 read 0000",
        "1 6 2a04 read ",
        "8 9 2a05 indicate -",
        "12 13 0003 write-without-response -",
        "12 15 0002 write,notify -",
        "12 18 0004 read 00000f000c000202",
        "12 20 0005 write-without-response,write -",
        "22 23 2a19 read,notify 46",  # 3.9 V are 70 %
        "26 27 0002 write-without-response,write,notify -",
        "26 30 0003 write-without-response,write,notify -",
    ]


def test_errors(bleak):
    done = bleak(
        """
client = await opened()
nothing = "00000000-0000-0000-0000-000000000000"
async def fails(what):
    try: await what
    except (BleakError, TypeError) as error: print(type(error).__name__, error)
await fails(client.write_gatt_char(nothing, b""))
await fails(client.read_gatt_char(nothing))
await fails(client.start_notify(nothing, print))
await fails(client.read_gatt_char(API))
await fails(client.write_gatt_char(API, bytes(21), response=True))
await fails(client.write_gatt_char("2a00", b"me"))
await fails(client.write_gatt_char(API, "text"))
await fails(client.start_notify(WORD, print))
await fails(client.stop_notify(API))
await fails(client.read_gatt_descriptor(99))
await client.disconnect()
await fails(client.write_gatt_char(API, b""))
await fails(client.read_gatt_char(API))
await fails(client.start_notify(API, print))
try: client.services
except BleakError as error: print(error)
"""
    )
    assert done.out.splitlines() == [
        "BleakCharacteristicNotFoundError Characteristic 00000000-0000-0000-0000-000000000000 was not found!",
        "BleakCharacteristicNotFoundError Characteristic 00000000-0000-0000-0000-000000000000 was not found!",
        "BleakCharacteristicNotFoundError Characteristic 00000000-0000-0000-0000-000000000000 was not found!",
        "BleakDBusError [org.bluez.Error.NotPermitted] Read not permitted",
        "BleakDBusError [org.bluez.Error.Failed] Operation failed with ATT error: 0x06 (Request Not Supported)",
        "BleakError Characteristic 00002a00-0000-1000-8000-00805f9b34fb does not support write operations!",
        "TypeError the data must be bytes, not str",
        "BleakDBusError [org.bluez.Error.NotSupported] Operation is not supported",
        "BleakDBusError [org.bluez.Error.Failed] No notify session started",
        "BleakError Descriptor with handle 99 was not found!",
        "BleakError Not connected",
        "BleakError Not connected",
        "BleakError Not connected",
        "Service Discovery has not been performed yet",
    ]


def test_a_classic_robot_is_deaf_without_a_word(bleak):
    done = bleak(
        """
device = await BleakScanner.find_device_by_filter(lambda d, ad: True)
heard = []
async with BleakClient(device) as client:
    await client.start_notify(ANSWERS, lambda sender, data: heard.append(bytes(data)))
    for word in (None, b"open sesame", b"011i3"):
        if word: await client.write_gatt_char(ANTI_DOS, word)
        await client.write_gatt_char(COMMANDS, v1(0, 1))
        await asyncio.sleep(0.2)
        print(len(heard))
async with BleakClient(device) as client:  # another link, another word
    await client.start_notify(ANSWERS, lambda sender, data: heard.append(bytes(data)))
    await client.write_gatt_char(COMMANDS, v1(0, 1))
    await asyncio.sleep(0.2)
    print(len(heard))
""",
        *("--robot", "sprk+"),
    )
    assert done.out.split() == ["0", "0", "1", "1"]


@pytest.mark.parametrize("kind, ends", [("mini", "10.0"), ("r2d2", "10.0"), ("bolt", "no")])
def test_a_newer_robot_obeys_without_a_word_but_may_end_the_link(bleak, kind, ends):
    done = bleak(
        """
device = await BleakScanner.find_device_by_filter(lambda d, ad: True)
async def wait(word):
    over, heard = asyncio.Event(), []
    client = BleakClient(device, disconnected_callback=lambda c: over.set())
    begin = time.monotonic()
    await client.connect()
    await client.start_notify(API, lambda sender, data: heard.append(bytes(data)))
    if word: await client.write_gatt_char(WORD, word)
    await client.write_gatt_char(API, v2(0x10, 0, 7))
    await asyncio.sleep(0.2)
    print(len(heard))
    try:
        await asyncio.wait_for(over.wait(), 60)
        print(round((time.monotonic() - begin) / 0.5) * 0.5)
    except asyncio.TimeoutError:
        print("no")
        await client.disconnect()
for word in (None, b"open sesame", b"usetheforce...band"): await wait(word)
""",
        *("--robot", kind),
    )
    assert done.out.split() == ["1", ends, "1", ends, "1", "no"]


def test_notifications(bleak):
    done = bleak(
        """
client = await opened()
pieces = []
def hear(sender, data):
    assert isinstance(data, bytearray) and len(data) <= 20
    pieces.append((sender, bytes(data)))
await client.start_notify(API, hear)
await send(client, v2(0x10, 0, *range(8)))
await asyncio.sleep(0.1)
sender, data = pieces[0]
print(sender == API, sender == 27, {27: "by handle"}[sender], f"{sender:d} {sender:04x} {sender:s}"[:16], sender.uuid == API)
await send(client, v2(0x13, 0x0D))
await asyncio.sleep(0.1)
pieces.clear()
await send(client, v2(0x18, 0, 0, 100, 0, 0, 0x07, 0xE0, 0x78))
await asyncio.sleep(1)
print([len(data) for _, data in pieces[2:6]])
await client.stop_notify(API)
count = len(pieces)
await asyncio.sleep(1)
print(len(pieces) == count)
async def hear_later(sender, data):
    await asyncio.sleep(0.01)
    raise ValueError
async def fail(sender, data): raise ValueError("a mistake")
await client.start_notify(API, lambda sender, data: 1 / 0)  # is told, and goes on
await asyncio.sleep(0.2)
print("goes on", bool(client.is_connected))
""",
        "--robot",
        "mini",
    )
    lines = done.out.splitlines()
    assert lines[0] == "True True by handle 27 001b 00010002 True"
    assert all(int(each) <= 20 for each in lines[1].strip("[]").split(","))
    assert lines[2:] == ["True", "goes on True"]
    assert "ZeroDivisionError" in done.err


def test_the_turns_of_the_link(bleak):
    done = bleak(
        """
client = await opened()
times = []
await client.start_notify(API, lambda sender, data: times.append(time.monotonic()))
t = time.monotonic()
for _ in range(10): await send(client, v2(0x10, 0, 1))
print(round((time.monotonic() - t) / 10, 4))
await asyncio.sleep(0.1)
sent = time.monotonic()
times.clear()
await client.write_gatt_char(API, v2(0x10, 0, 1), response=False)
print(time.monotonic() - sent < 0.001)
await asyncio.sleep(0.1)
print(0.015 <= times[0] - sent <= 0.0301)
"""
    )
    assert done.out.split() == ["0.015", "True", "True"]


def test_a_robot_that_falls_asleep_ends_the_link(bleak):
    done = bleak(
        """
over = asyncio.Event()
client = await opened(disconnected_callback=lambda c: over.set())
await client.start_notify(ANSWERS, lambda sender, data: print(data.hex(), bool(client.is_connected)))
await send(client, v1(0, 0x22, 0, 0, 0, 0, 0))
await asyncio.wait_for(over.wait(), 5)
print(client.is_connected)
try: await send(client, v1(0, 1))
except BleakError as error: print(error)
""",
        "--robot",
        "sprk+",
    )
    assert done.out == "ffff000101fd True\nFalse\nService Discovery has not been performed yet\n"


def test_a_newer_robot_that_was_put_to_sleep_ends_the_link_later(bleak):
    done = bleak(
        """
over = asyncio.Event()
client = await opened(disconnected_callback=lambda c: over.set())
await send(client, v2(0x13, 1))
begin = time.monotonic()
await asyncio.wait_for(over.wait(), 60)
print(round(time.monotonic() - begin), client.is_connected)
""",
        *("--robot", "mini"),
    )
    assert done.out == "30 False\n"


def test_two_clients_share_a_robot(bleak):
    done = bleak(
        """
first = await opened(disconnected_callback=lambda c: print("first is gone"))
device = (await BleakScanner.discover(0.5)) or first._device
second = BleakClient(device)
await second.connect()
heard = []
await second.start_notify(API, lambda sender, data: heard.append(data))
await send(first, v2(0x10, 0))
await asyncio.sleep(0.1)
print(len(heard))
await second.disconnect()
await asyncio.sleep(0.1)
print(first.is_connected)
"""
    )
    assert done.out == "1\nfirst is gone\nFalse\n"


def test_event_loops_one_after_the_other(with_robots):
    done = with_robots(
        PRELUDE
        + """
async def drive():
    client = await opened()
    await send(client, v2(0x10, 0))
    print("sent")
for _ in range(2): asyncio.run(drive())  # the end of a loop ends its links
loop = asyncio.new_event_loop()
loop.run_until_complete(drive())
loop.close()
async def look(): print(len(await BleakScanner.discover(1)))
asyncio.run(look())
""",
        "--fast",
    )
    assert (done.code, done.out) == (0, "sent\nsent\nsent\n1\n"), done.err
