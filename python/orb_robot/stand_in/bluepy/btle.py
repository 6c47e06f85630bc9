"""bluepy's way to robots: calls that wait, notifications while a program waits for them."""

import collections
import struct
import threading
import time
import uuid as uuid_module

from orb_robot import air

ADDR_TYPE_PUBLIC = "public"
ADDR_TYPE_RANDOM = "random"
_SWITCH = 0x2902  # the descriptor that switches notifications
_PROPERTIES = {"read": 0x02, "write-without-response": 0x04, "write": 0x08, "notify": 0x10, "indicate": 0x20}
_NAMES = {"write-without-response": "WRITE NO RESPONSE"}


class BTLEException(Exception):
    """The base of all of bluepy's errors."""

    def __init__(self, message="", resp_dict=None):
        super().__init__(message)
        self.message = message

    def __str__(self):
        return self.message


class BTLEInternalError(BTLEException):
    """What a program cannot do at this time."""


class BTLEConnectError(BTLEException):
    """The base of errors of the connection."""


class BTLEDisconnectError(BTLEConnectError):
    """There is no connection, or none any more."""


class BTLEManagementError(BTLEException):
    """The radio of the computer fails. The virtual one does not."""


class BTLEGattError(BTLEException):
    """The robot refuses what was asked for."""


class UUID:
    """A UUID, from a number of 16 bits, or text with or without dashes."""

    def __init__(self, val, commonName=None):
        if isinstance(val, UUID):
            val = str(val)
        if isinstance(val, int):
            val = f"{val:08x}"
        val = str(val).replace("-", "")
        if len(val) <= 8:
            val = val.rjust(8, "0") + "00001000800000805f9b34fb"
        self._text = str(uuid_module.UUID(val))
        self.binVal = bytes.fromhex(self._text.replace("-", ""))
        self.commonName = commonName

    def __str__(self):
        return self._text

    def __eq__(self, other):
        return self._text == str(UUID(other))

    def __hash__(self):
        return hash(self._text)

    def getCommonName(self):
        """Its name: its text."""
        return self.commonName or self._text


def AssignedNumber(number):
    """The UUID of a number that the Bluetooth SIG has assigned."""
    return UUID(number)


class DefaultDelegate:
    """Gets notifications and advertisements; programs derive theirs."""

    def handleNotification(self, cHandle, data):
        """A notification has come from the characteristic whose value has this handle."""

    def handleDiscovery(self, scanEntry, isNewDev, isNewData):
        """An advertisement has come."""


class Descriptor:
    """What switches the notifications of a characteristic."""

    def __init__(self, peripheral, uuid, handle):
        self.peripheral = peripheral
        self.uuid = UUID(uuid)
        self.handle = handle

    def read(self):
        """Its value."""
        return self.peripheral.readCharacteristic(self.handle)

    def write(self, val, withResponse=False):
        """Switches notifications: `b"\\x01\\x00"` on, `b"\\x00\\x00"` off."""
        return self.peripheral.writeCharacteristic(self.handle, val, withResponse)

    def __str__(self):
        return f"Descriptor <{self.uuid}>"


class Characteristic:
    """A characteristic of a robot."""

    def __init__(self, peripheral, there):
        self.peripheral = peripheral
        self.uuid = UUID(there.uuid)
        self.handle = there.handle
        self.valHandle = there.handle + 1
        self.there = there
        self.properties = sum(_PROPERTIES[each] for each in there.properties)

    def getHandle(self):
        """The handle of its value."""
        return self.valHandle

    def read(self):
        """Its value."""
        return self.peripheral.readCharacteristic(self.valHandle)

    def write(self, val, withResponse=False):
        """Writes up to 20 bytes."""
        return self.peripheral.writeCharacteristic(self.valHandle, val, withResponse)

    def supportsRead(self):
        """True if it has a value to read."""
        return "read" in self.there.properties

    def propertiesToString(self):
        """What can be done with it, in words."""
        return " ".join(_NAMES.get(each, each.upper()) for each in self.there.properties) + " "

    def getDescriptors(self, forUUID=None, hndEnd=0xFFFF):
        """Its descriptors, or those with a UUID."""
        if self.there.switch is None or (forUUID is not None and UUID(forUUID) != UUID(_SWITCH)):
            return []
        return [Descriptor(self.peripheral, _SWITCH, self.there.switch)]

    def __str__(self):
        return f"Characteristic <{self.uuid}>"


class Service:
    """A service of a robot."""

    def __init__(self, peripheral, there):
        self.peripheral = peripheral
        self.uuid = UUID(there.uuid)
        self.there = there
        self.hndStart = there.handle
        self.hndEnd = max(each.switch or each.handle + 1 for each in there.characteristics)

    def getCharacteristics(self, forUUID=None):
        """Its characteristics, or those with a UUID."""
        found = [Characteristic(self.peripheral, each) for each in self.there.characteristics]
        return [each for each in found if forUUID is None or each.uuid == forUUID]

    def getDescriptors(self, forUUID=None):
        """The descriptors of all its characteristics."""
        return [each for one in self.getCharacteristics() for each in one.getDescriptors(forUUID)]

    def __str__(self):
        return f"Service <uuid={self.uuid} handleStart={self.hndStart} handleEnd={self.hndEnd}>"


class Peripheral:
    """A connection to a robot, from its address, or a `ScanEntry`."""

    def __init__(self, deviceAddr=None, addrType=ADDR_TYPE_PUBLIC, iface=None, timeout=None):
        self.delegate = DefaultDelegate()
        self.inbox = collections.deque()
        self.addr = None
        self._radio = None
        self._last = None  # the robot of the last connection
        self._changed = threading.Condition()
        self._handing_over = threading.RLock()  # a delegate may call what hands over
        self._switched_on = set()
        if deviceAddr is not None:
            self.connect(deviceAddr, addrType, iface, timeout)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.disconnect()

    # Called by the air, in any thread.

    def arrived(self):
        """There is something in the inbox."""
        with self._changed:
            self._changed.notify_all()

    def lost(self):
        """The link is over."""
        self._radio = None
        self.arrived()

    # The connection.

    def setDelegate(self, delegate_):
        """Sets what gets the notifications. Returns the peripheral."""
        return self.withDelegate(delegate_)

    def withDelegate(self, delegate_):
        """Sets what gets the notifications. Returns the peripheral."""
        self.delegate = delegate_
        return self

    def connect(self, addr, addrType=ADDR_TYPE_PUBLIC, iface=None, timeout=None):
        """Connects. Raises BTLEDisconnectError if no robot with this address advertises."""
        self.addr = getattr(addr, "addr", addr)
        here = air.current()
        radio = here.find(str(self.addr))
        since = here.now()
        end = since + (timeout or 10)
        while radio is None or not here.advertised(radio, since, here.now()):
            if here.now() > end:
                raise BTLEDisconnectError(f"Failed to connect to peripheral {self.addr}, addr type: {addrType}")
            time.sleep(air.INTERVAL_S)
        time.sleep(air.TURNS_TO_CONNECT * air.INTERVAL_S)
        here.connect(radio, self)
        self._radio = self._last = radio

    def disconnect(self):
        """Disconnects; nothing happens if it is not connected."""
        radio = self._radio
        if radio is not None:
            radio.air.disconnect(radio)

    def getState(self):
        """`conn` or `disc`."""
        return "conn" if self._radio is not None else "disc"

    def setMTU(self, mtu):
        """Nothing: pieces stay at 20 bytes."""

    def setSecurityLevel(self, level):
        """Nothing: robots of this kind are not paired."""

    def _connected(self):
        if self._radio is None:
            raise BTLEDisconnectError("Device disconnected") if self.addr else BTLEInternalError("Helper not started")
        return self._radio

    # What the robot has.

    @property
    def services(self):
        """Its services."""
        return self.getServices()

    def discoverServices(self):
        """Its services, by UUID."""
        return {service.uuid: service for service in self.getServices()}

    def getServices(self):
        """Its services."""
        return [Service(self, there) for there in self._connected().services]

    def getServiceByUUID(self, uuidVal):
        """A service. Raises BTLEGattError if there is none with this UUID."""
        for service in self.getServices():
            if service.uuid == uuidVal:
                return service
        raise BTLEGattError(f"Failed to find service {UUID(uuidVal).getCommonName()}")

    def getCharacteristics(self, startHnd=1, endHnd=0xFFFF, uuid=None):
        """Its characteristics in a range of handles, or those with a UUID."""
        found = [each for service in self.getServices() for each in service.getCharacteristics(uuid)]
        return [each for each in found if startHnd <= each.handle <= endHnd]

    def getDescriptors(self, startHnd=1, endHnd=0xFFFF):
        """Its descriptors in a range of handles."""
        found = [each for one in self.getCharacteristics() for each in one.getDescriptors()]
        return [each for each in found if startHnd <= each.handle <= endHnd]

    def _at(self, handle):
        """The characteristic to which a handle belongs, and whether the handle is its switch."""
        for service in self._connected().services:
            for each in service.characteristics:
                if handle in (each.handle + 1, each.switch):
                    return each, handle == each.switch
        raise BTLEGattError(f"Bluetooth command failed: there is no attribute {handle}")

    # Reading, writing, listening. Each gives the delegate what has come meanwhile, as bluepy does.

    def readCharacteristic(self, handle):
        """The value at a handle."""
        there, is_switch = self._at(handle)
        self._turn()
        self._hand_over()
        if is_switch:
            return struct.pack("<H", there.uuid in self._switched_on)
        if "read" not in there.properties:
            raise BTLEGattError("Bluetooth command failed: Attribute can't be read")
        return self._connected().value(there.uuid)

    def writeCharacteristic(self, handle, val, withResponse=False, timeout=None):
        """Writes up to 20 bytes at a handle; with a response it waits a turn of the link."""
        there, is_switch = self._at(handle)
        if is_switch:
            self._turn()
            self._hand_over()
            (self._switched_on.add if val[0] & 1 else self._switched_on.discard)(there.uuid)
            return {"rsp": ["wr"]}
        if not {"write", "write-without-response"} & set(there.properties):
            raise BTLEGattError("Bluetooth command failed: Attribute can't be written")
        if len(val) > air.PIECE_BYTES:  # a robot does not know long writes
            self._turn()
            raise BTLEGattError("Bluetooth command failed: Request attribute is not supported")
        radio = self._connected()
        write = radio.air.write(radio, there.uuid, bytes(val))
        self.arrived()  # another thread may wait
        if not withResponse:
            self._hand_over()
            return None
        time.sleep(max(0.0, radio.air.start + write.at - radio.air.clock()))
        self._hand_over()
        if not write.taken:
            raise BTLEDisconnectError("Device disconnected")
        return {"rsp": ["wr"]}

    def _turn(self):
        """Waits for the next turn of the link."""
        radio = self._connected()
        here = radio.air
        time.sleep(max(0.0, here.start + radio.next_turn(here.now()) - here.clock()))

    def waitForNotifications(self, timeout):
        """Waits at most `timeout` seconds for a notification, and gives what has come to the delegate.

        Returns whether one has come.
        """
        here = air.current()
        end = here.now() + timeout
        while True:
            if self._hand_over():
                return True
            radio = self._connected()
            if here.now() >= end:
                return False
            with self._changed:
                at = here.next_turn(radio)
                if self.inbox and (at is None or self.inbox[0][0] < at):
                    at = self.inbox[0][0]
                until = end if at is None else min(at, end)
                self._changed.wait(max(0.0, until - here.now()))

    def _hand_over(self):
        """Gives the delegate what has come. Returns true if there was something."""
        here = air.current()
        heard = False
        with self._handing_over:
            here.catch_up()
            now = here.now()
            while self.inbox and (self.inbox[0][0] <= now or self._radio is None):
                _, uuid, data = self.inbox.popleft()
                if uuid in self._switched_on:
                    heard = True
                    self.delegate.handleNotification(self._value_handle(self._last, uuid), data)
        return heard

    @staticmethod
    def _value_handle(radio, uuid):
        return next(each.handle + 1 for service in radio.services for each in service.characteristics if each.uuid == uuid)


class ScanEntry:
    """A robot that a scan has found."""

    SHORT_LOCAL_NAME = 8
    COMPLETE_LOCAL_NAME = 9
    TX_POWER = 0x0A
    MANUFACTURER = 0xFF

    def __init__(self, addr, radio):
        self.addr = addr.lower()
        self.addrType = ADDR_TYPE_RANDOM
        self.iface = 0
        self.rssi = radio.strength
        self.connectable = True
        self.updateCount = 0
        self.rawData = None
        self.scanData = {self.COMPLETE_LOCAL_NAME: radio.name}

    def getValue(self, sdid):
        """What it advertises under a number; None: nothing."""
        return self.scanData.get(sdid)

    def getValueText(self, sdid):
        """The same, as text."""
        return self.getValue(sdid)

    @staticmethod
    def getDescription(sdid):
        """The name of a number."""
        return "Complete Local Name" if sdid == ScanEntry.COMPLETE_LOCAL_NAME else hex(sdid)

    def getScanData(self):
        """All that it advertises, with numbers and names."""
        return [(sdid, self.getDescription(sdid), value) for sdid, value in self.scanData.items()]


class Scanner:
    """Listens for robots that advertise: those that nobody is connected to."""

    def __init__(self, iface=0):
        self.delegate = DefaultDelegate()
        self.scanned = {}

    def withDelegate(self, delegate):
        """Sets what gets the advertisements. Returns the scanner."""
        self.delegate = delegate
        return self

    def clear(self):
        """Forgets what it has found."""
        self.scanned = {}

    def start(self, passive=False):
        """Begins to listen."""
        self._since = air.current().now()

    def stop(self):
        """Stops listening."""

    def process(self, timeout=10.0):
        """Listens for so many seconds."""
        here = air.current()
        end = here.now() + timeout
        while True:
            here.catch_up()
            now = here.now()
            for radio in here.radios:
                if here.advertised(radio, self._since, now):
                    self._hear(radio)
            self._since = now
            if now >= end:
                return
            time.sleep(min(air.ADVERTISES_EVERY_S / 4, max(0.0, end - now)))

    def _hear(self, radio):
        is_new = radio.address not in self.scanned
        if is_new:
            self.scanned[radio.address] = ScanEntry(radio.address, radio)
        entry = self.scanned[radio.address]
        entry.updateCount += 1
        self.delegate.handleDiscovery(entry, is_new, is_new)

    def getDevices(self):
        """What it has found."""
        return list(self.scanned.values())

    def scan(self, timeout=10, passive=False):
        """Listens for so many seconds. Returns what it has found."""
        self.clear()
        self.start(passive)
        self.process(timeout)
        self.stop()
        return self.getDevices()
