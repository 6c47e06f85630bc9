"""Scanning: which robots are there."""

import asyncio
import inspect

from orb_robot import air

from .backends.device import BLEDevice
from .backends.scanner import AdvertisementData
from .uuids import normalize_uuid_str

_tasks = set()


def device_path(radio):
    """Where BlueZ has a robot, as programs for Linux expect it in the details of a device."""
    return "/org/bluez/hci0/dev_" + radio.address.upper().replace(":", "_")


def run_callback(callback, *args):
    """Calls a program's callback, a function or a coroutine function. What it raises is told to the event loop."""
    try:
        result = callback(*args)
        if inspect.isawaitable(result):
            task = asyncio.ensure_future(result)
            _tasks.add(task)
            task.add_done_callback(_tasks.discard)
    except Exception as error:
        asyncio.get_running_loop().call_exception_handler(
            {"message": f"Exception in callback {callback!r}", "exception": error}
        )


class BleakScanner:
    """Listens for the robots that advertise: those that nobody is connected to.

    detection_callback: called with a `BLEDevice` and its `AdvertisementData` at each advertisement.
    service_uuids: only robots that advertise one of them.
    """

    def __init__(self, detection_callback=None, service_uuids=None, scanning_mode="active", **_):
        self._callback = None
        self.register_detection_callback(detection_callback)
        self._wanted = None if service_uuids is None else {normalize_uuid_str(str(uuid)) for uuid in service_uuids}
        self._seen = {}
        self._timer = None
        self._queues = []

    async def __aenter__(self):
        await self.start()
        return self

    async def __aexit__(self, *_):
        await self.stop()

    def register_detection_callback(self, callback):
        """Sets the callback; None: none (for older programs)."""
        if callback is not None:
            if not callable(callback) or len(inspect.signature(callback).parameters) != 2:
                raise TypeError("callback must be callable with 2 parameters")
        self._callback = callback

    def set_scanning_filter(self, **_):
        """For older programs; filters nothing."""

    async def start(self):
        """Begins to listen."""
        self._seen = {}
        self._air = air.current()
        self._since = self._air.now()
        self._loop = asyncio.get_running_loop()
        self._timer = self._loop.call_soon(self._listen)

    async def stop(self):
        """Stops listening."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _listen(self):
        self._air.catch_up()
        until = self._air.now()
        for radio in self._air.radios:
            if self._air.advertised(radio, self._since, until):
                self._hear(radio)
        self._since = until
        if self._timer is not None:  # a callback may have stopped it
            self._timer = self._loop.call_later(air.ADVERTISES_EVERY_S / 4, self._listen)

    def _hear(self, radio):
        services = radio.advertised_services
        if self._wanted is not None and self._wanted.isdisjoint(services):
            return
        path = device_path(radio)
        properties = {"Address": radio.address, "Name": radio.name, "Alias": radio.name, "RSSI": radio.strength}
        data = AdvertisementData(
            radio.name,
            dict(radio.manufacturer_data),
            {},
            list(services),
            radio.tx_power,
            radio.strength,
            (path, properties),
        )
        if radio.address not in self._seen:
            device = BLEDevice(
                radio.address,
                radio.name,
                {"path": path, "props": properties},
                radio.strength,
                uuids=list(services),
                manufacturer_data=dict(radio.manufacturer_data),
            )
        else:
            device = self._seen[radio.address][0]
        self._seen[radio.address] = device, data
        for queue in self._queues:
            queue.put_nowait((device, data))
        if self._callback is not None:
            run_callback(self._callback, device, data)

    async def advertisement_data(self):
        """Yields a device and its data at each advertisement."""
        queue = asyncio.Queue()
        self._queues.append(queue)
        try:
            while True:
                yield await queue.get()
        finally:
            self._queues.remove(queue)

    @property
    def discovered_devices(self):
        """The devices that it has found."""
        return [device for device, _ in self._seen.values()]

    @property
    def discovered_devices_and_advertisement_data(self):
        """The devices that it has found, with what they advertised last, by address."""
        return self._seen

    async def get_discovered_devices(self):
        """`discovered_devices` (for older programs)."""
        return self.discovered_devices

    @classmethod
    async def discover(cls, timeout=5.0, *, return_adv=False, **kwargs):
        """Listens for `timeout` seconds. Returns a list of devices, or with `return_adv` a dictionary by address."""
        async with cls(**kwargs) as scanner:
            await asyncio.sleep(timeout)
        return scanner.discovered_devices_and_advertisement_data if return_adv else scanner.discovered_devices

    @classmethod
    async def find_device_by_address(cls, device_identifier, timeout=10.0, **kwargs):
        """The device with an address; None after `timeout` seconds without it."""
        wanted = device_identifier.lower()
        return await cls.find_device_by_filter(lambda device, _: device.address.lower() == wanted, timeout, **kwargs)

    @classmethod
    async def find_device_by_name(cls, name, timeout=10.0, **kwargs):
        """The device that advertises a name; None after `timeout` seconds without it."""
        return await cls.find_device_by_filter(lambda _, data: data.local_name == name, timeout, **kwargs)

    @classmethod
    async def find_device_by_filter(cls, filterfunc, timeout=10.0, **kwargs):
        """The first device for which `filterfunc(device, data)` is true; None after `timeout` seconds without it."""
        found = asyncio.get_running_loop().create_future()

        def look(device, data):
            if not found.done() and filterfunc(device, data):
                found.set_result(device)

        async with cls(detection_callback=look, **kwargs):
            try:
                return await asyncio.wait_for(found, timeout)
            except asyncio.TimeoutError:
                return None
