"""A connection to a robot."""

import asyncio
import math
from collections import deque

from orb_robot import air

from ._scanner import BleakScanner, device_path, run_callback
from .backends.characteristic import BleakGATTCharacteristic
from .backends.descriptor import BleakGATTDescriptor
from .backends.device import BLEDevice
from .backends.service import BleakGATTService, BleakGATTServiceCollection
from .exc import BleakCharacteristicNotFoundError, BleakDeviceNotFoundError, BleakError, bluez_error
from .uuids import normalize_uuid_16

_CCCD = normalize_uuid_16(0x2902)
_ATT_HEADER = 3  # bytes of a packet of the link that are not data


class _Connected(int):
    """True if a client is connected. Older programs call it or wait for it."""

    async def _answer(self):
        return bool(self)

    def __call__(self):
        return self._answer()

    def __await__(self):
        return self._answer().__await__()

    def __repr__(self):
        return str(bool(self))

    __str__ = __repr__


class _Link:
    """A client's end of a link: what has arrived, and the timer that looks for more."""

    def __init__(self, client, radio, loop):
        self.client = client
        self.radio = radio
        self.loop = loop
        self.inbox = deque()
        self.callbacks = {}
        self.alive = True
        self.timer = None
        self.looking = False
        _watch_end_of(loop)

    def arrived(self):
        """Called by the air, in any thread: there is something in the inbox."""
        if not self.looking and not self.loop.is_closed():
            self.loop.call_soon_threadsafe(self.plan)

    def lost(self):
        """Called by the air, in any thread."""
        self.alive = False
        if not self.loop.is_closed():
            self.loop.call_soon_threadsafe(self._fade)

    def _fade(self):
        """What the robot sent last still arrives."""
        self._stop_looking()
        here = self.radio.air
        self.timer = self.loop.call_at(here.start + max([here.now()] + [at for at, *_ in self.inbox]), self._fade_out)

    def _fade_out(self):
        try:
            self._deliver(math.inf)
        finally:
            self.ended()

    def ended(self):
        """Tells the client, once."""
        self._stop_looking()
        self.callbacks.clear()
        self.client._lost(self)

    def _stop_looking(self):
        if self.timer is not None:
            self.timer.cancel()
            self.timer = None

    def plan(self):
        """Sets the timer to the next turn at which something may arrive."""
        if not self.alive or self.loop.is_closed():
            return
        if asyncio._get_running_loop() is not self.loop:
            self.loop.call_soon_threadsafe(self.plan)
            return
        at = self.radio.air.next_turn(self.radio)
        if self.inbox and (at is None or self.inbox[0][0] < at):
            at = self.inbox[0][0]
        self._stop_looking()
        if at is not None:
            self.timer = self.loop.call_at(self.radio.air.start + at, self._turn)

    def _turn(self):
        self.timer = None
        here = self.radio.air
        try:
            self.looking = True
            here.catch_up()
            self.looking = False
            self._deliver(here.now())
        finally:
            self.looking = False
            self.plan()

    def _deliver(self, until):
        while self.inbox and self.inbox[0][0] <= until:
            _, uuid, data = self.inbox.popleft()
            if uuid in self.callbacks:
                characteristic, callback = self.callbacks[uuid]
                run_callback(callback, characteristic, bytearray(data))


def _watch_end_of(loop):
    """A loop that is closed takes its connections with it."""
    real = loop.close
    if getattr(real, "ends_links", False):
        return

    def close():
        """Closes the event loop and its connections to robots."""
        real()
        here = air.current()
        for radio in here.radios:
            if any(link.loop is loop for link in radio.links):
                here.disconnect(radio)

    close.ends_links = True
    try:
        loop.close = close
    except AttributeError:  # a loop written in C: the end of the program ends the links
        pass


class BleakClient:
    """A connection to a robot, from its address or the device that a scan has found.

    disconnected_callback: called with the client when the connection has ended, whoever ended it.
    timeout: seconds to look for the robot.
    """

    def __init__(self, address_or_ble_device, disconnected_callback=None, services=None, *, timeout=10.0, **_):
        if isinstance(address_or_ble_device, BLEDevice):
            self._device = address_or_ble_device
            self.address = address_or_ble_device.address
        else:
            self._device = None
            self.address = address_or_ble_device
        self._disconnected_callback = disconnected_callback
        self._timeout = timeout
        self._link = None
        self._services = None

    def __str__(self):
        return f"{type(self).__name__}, {self.address}"

    def __repr__(self):
        return f"<{type(self).__name__}, {self.address}>"

    async def __aenter__(self):
        await self.connect()
        return self

    async def __aexit__(self, *_):
        await self.disconnect()

    # The connection.

    @property
    def name(self):
        """The name that the robot advertises, or its address."""
        radio = air.current().find(str(self.address))
        return radio.name if radio is not None else str(self.address)

    @property
    def is_connected(self):
        """True if it is connected."""
        return _Connected(self._link is not None)

    @property
    def mtu_size(self):
        """The bytes of a packet of the link."""
        return air.PIECE_BYTES + _ATT_HEADER

    def set_disconnected_callback(self, callback, **_):
        """Sets the callback; None: none (for older programs)."""
        self._disconnected_callback = callback

    async def connect(self, **kwargs):
        """Connects. Returns True.

        Raises BleakError if it is connected, BleakDeviceNotFoundError if no robot with this address advertises within
        the timeout, asyncio.TimeoutError if a known robot does not.
        """
        if self._link is not None:
            raise BleakError("Client is already connected")
        here = air.current()
        timeout = kwargs.get("timeout", self._timeout)
        if self._device is None:
            self._device = await BleakScanner.find_device_by_address(str(self.address), timeout)
            if self._device is None:
                raise BleakDeviceNotFoundError(self.address, f"Device with address {self.address} was not found.")
        radio = here.find(self._device.address)
        if radio is None:
            raise asyncio.TimeoutError()
        if not radio.links:
            since = here.now()
            while not here.advertised(radio, since, here.now()) and not radio.links:
                await asyncio.sleep(air.INTERVAL_S)
            await asyncio.sleep(air.TURNS_TO_CONNECT * air.INTERVAL_S)
        link = _Link(self, radio, asyncio.get_running_loop())
        here.connect(radio, link)
        try:
            services = _services_of(radio)
            rounds = len(services.services) + len(services.characteristics) + len(services.descriptors)
            await asyncio.sleep(rounds * air.INTERVAL_S)  # each is asked for
        except BaseException:
            here.disconnect(radio)
            raise
        if not link.alive:
            raise BleakError("failed to discover services, device disconnected")
        self._link, self._services = link, services
        link.plan()
        return True

    async def disconnect(self, **_):
        """Disconnects; nothing happens if it is not connected. Returns True."""
        link = self._link
        if link is not None:
            await self._turn(link)
            if link.alive:
                link.radio.air.disconnect(link.radio)
            link.ended()
        return True

    def _lost(self, link):
        if self._link is link:
            self._link = self._services = None
            if self._disconnected_callback is not None:
                run_callback(self._disconnected_callback, self)

    async def pair(self, *_, **__):
        """Robots of this kind are not paired: nothing happens. Returns True."""
        self._connected()
        return True

    async def unpair(self):
        """Forgets the robot, which ends the connection. Returns True."""
        await self.disconnect()
        self._device = None
        return True

    # What the robot has.

    @property
    def services(self):
        """The services of the robot. Raises BleakError while it is not connected."""
        if self._services is None:
            raise BleakError("Service Discovery has not been performed yet")
        return self._services

    async def get_services(self, **_):
        """`services` (for older programs)."""
        self._connected()
        return self._services

    def _connected(self):
        if self._link is None:
            raise BleakError("Not connected")
        return self._link

    def _find(self, specifier):
        if isinstance(specifier, BleakGATTCharacteristic):
            return specifier
        found = self._services.get_characteristic(specifier)
        if found is None:
            raise BleakCharacteristicNotFoundError(specifier)
        return found

    # Reading, writing, listening.

    async def _turn(self, link):
        """Waits for the next turn of the link."""
        here = link.radio.air
        at = here.start + link.radio.next_turn(here.now())
        await asyncio.sleep(max(0.0, at - here.clock()))

    async def read_gatt_char(self, char_specifier, **_):
        """The value of a characteristic, as a bytearray."""
        link = self._connected()
        characteristic = self._find(char_specifier)
        await self._turn(link)
        self._connected()
        if "read" not in characteristic.properties:
            raise bluez_error("NotPermitted", "Read not permitted")
        return bytearray(link.radio.value(characteristic.uuid))

    async def write_gatt_char(self, char_specifier, data, response=None):
        """Writes up to 20 bytes to a characteristic.

        response: whether to wait for the robot's receipt, which takes a turn of the link; None: where it can give one.
        """
        link = self._connected()
        characteristic = self._find(char_specifier)
        if isinstance(data, (int, str)):
            raise TypeError(f"the data must be bytes, not {type(data).__name__}")
        data = bytes(data)
        can = [each for each in ("write", "write-without-response") if each in characteristic.properties]
        if not can:
            raise BleakError(f"Characteristic {characteristic.uuid} does not support write operations!")
        if response is None:
            response = "write" in can
        wants_receipt = "write" in can if response else "write-without-response" not in can
        if len(data) > air.PIECE_BYTES:  # a robot does not know long writes
            if wants_receipt:
                await self._turn(link)
            raise bluez_error("Failed", "Operation failed with ATT error: 0x06 (Request Not Supported)")
        write = link.radio.air.write(link.radio, characteristic.uuid, data)
        link.plan()
        if wants_receipt:
            here = link.radio.air
            await asyncio.sleep(max(0.0, here.start + write.at - here.clock()))
            here.catch_up()
            if not write.taken:
                raise bluez_error("Failed", "Not connected")

    async def start_notify(self, char_specifier, callback, **_):
        """Calls a function or coroutine function with the characteristic and a bytearray at each notification."""
        link = self._connected()
        characteristic = self._find(char_specifier)
        if {"notify", "indicate"}.isdisjoint(characteristic.properties):
            raise bluez_error("NotSupported", "Operation is not supported")
        await self._turn(link)
        self._connected()
        link.callbacks[characteristic.uuid] = characteristic, callback
        link.plan()

    async def stop_notify(self, char_specifier):
        """Ends that."""
        link = self._connected()
        characteristic = self._find(char_specifier)
        if characteristic.uuid not in link.callbacks:
            raise bluez_error("Failed", "No notify session started")
        await self._turn(link)
        link.callbacks.pop(characteristic.uuid, None)

    async def read_gatt_descriptor(self, handle, **_):
        """The value of a descriptor: whether its characteristic notifies."""
        link = self._connected()
        descriptor = self._descriptor(handle)
        await self._turn(link)
        return bytearray([int(descriptor.characteristic_uuid in link.callbacks), 0])

    async def write_gatt_descriptor(self, handle, data):
        """Not permitted: notifications are switched with `start_notify`."""
        link = self._connected()
        self._descriptor(handle)
        await self._turn(link)
        raise bluez_error("NotPermitted", "Write not permitted")

    def _descriptor(self, handle):
        found = self._services.get_descriptor(int(getattr(handle, "handle", handle)))
        if found is None:
            raise BleakError(f"Descriptor with handle {handle} was not found!")
        return found


def _services_of(radio):
    collection = BleakGATTServiceCollection()
    for there in radio.services:
        service = BleakGATTService(there.uuid, there.handle, device_path(radio))
        collection.services[service.handle] = service
        for each in there.characteristics:
            characteristic = BleakGATTCharacteristic(each.uuid, each.handle, each.properties, service, air.PIECE_BYTES)
            collection.characteristics[characteristic.handle] = characteristic
            service.characteristics.append(characteristic)
            if each.switch is not None:
                descriptor = BleakGATTDescriptor(_CCCD, each.switch, characteristic)
                characteristic.descriptors.append(descriptor)
                collection.descriptors[descriptor.handle] = descriptor
    return collection
