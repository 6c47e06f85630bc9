"""The stand-in for bluepy, in virtual time."""

PROGRAM = '''
import struct, threading, time
from bluepy import btle
from bluepy.btle import UUID, BTLEDisconnectError, BTLEGattError, DefaultDelegate, Peripheral, Scanner

API, WORD = "00010002-574f-4f20-5370-6865726f2121", "00020005574f4f2053706865726f2121"
PING = bytes.fromhex("8d0a10000801dcd8")

class Found(DefaultDelegate):
    def handleDiscovery(self, entry, isNewDev, isNewData):
        if isNewDev: print("found", entry.addr, entry.getValueText(9))

for entry in Scanner().withDelegate(Found()).scan(2): print(entry.addr, entry.getValue(9), entry.rssi < 0)
try: Peripheral("11:22:33:44:55:66", "random")
except BTLEDisconnectError as error: print(error)

class Heard(DefaultDelegate):
    def handleNotification(self, cHandle, data): print(hex(cHandle), len(data) <= 20, data.hex())

robot = Peripheral(entry, btle.ADDR_TYPE_RANDOM).withDelegate(Heard())
api = robot.getCharacteristics(uuid=API)[0]
print(hex(api.getHandle()), api.propertiesToString(), robot.getServiceByUUID("00010001" + API[8:]).uuid, robot.getState())
robot.getCharacteristics(uuid=WORD)[0].write(b"usetheforce...band", withResponse=True)
api.write(PING, withResponse=True)
print(robot.waitForNotifications(0.5))  # nobody listens
switch = api.getDescriptors(forUUID=0x2902)[0]
switch.write(struct.pack("<bb", 1, 0), withResponse=True)
api.write(PING, withResponse=True)
print(robot.waitForNotifications(1.0), switch.read())
threading.Timer(1, api.write, (PING, True)).start()
t = time.time()
print(robot.waitForNotifications(60), round(time.time() - t, 1))
t = time.time()
print(robot.waitForNotifications(0.25), round(time.time() - t, 2))
for again in range(3):
    api.write(PING, withResponse=True)
    print("written", again)  # each call hands over what has come, the answer to the ping before
print(robot.getCharacteristics(uuid=0x2A00)[0].read())
for wrong in (lambda: api.read(), lambda: api.write(bytes(21)), lambda: robot.getServiceByUUID(0x180A)):
    try: wrong()
    except BTLEGattError as error: print(error)
robot.disconnect()
try: api.write(PING)
except BTLEDisconnectError as error: print(robot.getState(), error)
'''


def test_bluepy(with_robots):
    done = with_robots(PROGRAM, "--fast", "--robot", "mini")
    assert done.code == 0, done.err
    assert done.out.splitlines() == [
        "found 68:86:e7:00:00:01 SM-0001",
        "68:86:e7:00:00:01 SM-0001 True",
        "Failed to connect to peripheral 11:22:33:44:55:66, addr type: random",
        "0x1c WRITE NO RESPONSE WRITE NOTIFY  00010001-574f-4f20-5370-6865726f2121 conn",
        "False",
        "0x1c True 8d091000080001ddd8",
        "True b'\\x01\\x00'",
        "0x1c True 8d091000080001ddd8",
        "True 1.0",
        "False 0.25",
        "written 0",
        "0x1c True 8d091000080001ddd8",
        "written 1",
        "0x1c True 8d091000080001ddd8",
        "written 2",
        "0x1c True 8d091000080001ddd8",
        "b'SM-0001'",
        "Bluetooth command failed: Attribute can't be read",
        "Bluetooth command failed: Request attribute is not supported",
        "Failed to find service 0000180a-0000-1000-8000-00805f9b34fb",
        "disc Device disconnected",
    ]
