"""The robots around a program and the radio between them: what the stand-in for Bleak finds.

All robots are in one world. Its time follows a clock, `time.monotonic()` or that of `virtual_time`, from the moment at
which the `Air` was made: then the robots were switched on. The world is brought up to date when somebody looks; nothing
runs in between. Times are seconds since then.

Every method can be called from any thread.
"""

import heapq
import itertools
import math
import threading
import time
from typing import NamedTuple

from . import _orb

_radio = _orb.radio()
#: A link has its turn so often.
INTERVAL_S = _radio["interval"]
#: A robot that nobody is connected to advertises so often.
ADVERTISES_EVERY_S = _radio["advertises_every"]
#: From its advertisement to the first turn of the link, in turns.
TURNS_TO_CONNECT = _radio["turns_to_connect"]
#: The bytes of a piece: what one packet of the link holds if nobody asked for more.
PIECE_BYTES = _radio["piece_bytes"]
_NEARLY = 1e-6  # of an interval: what rounding may cost

_lock = threading.RLock()  # made on import: before the threads of a program can become virtual


# What is read there is the robot's own.
BATTERY_LEVEL = "00002a19-0000-1000-8000-00805f9b34fb"
DEVICE_NAME = "00002a00-0000-1000-8000-00805f9b34fb"
SERIAL_NUMBER = "00002a25-0000-1000-8000-00805f9b34fb"


class Service(NamedTuple):
    """A service and where it is."""

    uuid: str
    handle: int
    characteristics: list


class Characteristic(NamedTuple):
    """A characteristic; its value has the handle after its own, the switch of its notifications, if any, the next."""

    uuid: str
    handle: int
    properties: tuple

    @property
    def switch(self):
        """The handle of the descriptor that switches its notifications; None: it has none."""
        return None if {"notify", "indicate"}.isdisjoint(self.properties) else self.handle + 2


def _laid_out(rows):
    """Gives characteristics their handles, in their order."""
    services = []
    handle = 1
    for service, uuid, properties, _ in rows:
        if not services or services[-1].uuid != service:
            services.append(Service(service, handle, []))
            handle += 1
        there = Characteristic(uuid, handle, properties)
        services[-1].characteristics.append(there)
        handle = (there.switch or handle + 1) + 1
    return services


class Radio:
    """A robot as the air knows it: what it advertises, who is connected, what is under way."""

    def __init__(self, air, robot, gatt, index, name, address):
        self.air = air
        self.robot = robot
        self.name = name or robot.name
        self.address = address or robot.address
        self.protocol = gatt["protocol"]
        self.commands = gatt["commands_uuid"]
        self.answers = gatt["answers_uuid"]
        self.greeting = gatt["greeting"][:1]  # the first opens it; some clients leave out the others
        self.is_deaf = gatt["is_deaf"]
        self.patience = gatt["patience"]
        self.services = _laid_out(gatt["characteristics"])
        self._values = {uuid: value for _, uuid, _, value in gatt["characteristics"]}
        self._values[DEVICE_NAME] = self.name.encode()
        self._values[SERIAL_NUMBER] = self.address.encode()
        self.advertised_services = [gatt["advertised_service"]] if gatt["advertised_service"] else []
        self.tx_power = gatt["advertised_power"]
        maker = gatt["advertised_maker"]
        self.manufacturer_data = {} if maker is None else {maker: b""}
        self.strength = -48 - 7 * (index % 5)  # dBm [?]
        self.advertises_from = ADVERTISES_EVERY_S * ((index * 37 + 20) % 100) / 100  # not all at once
        self.links = []  # the clients that are connected
        self.ever_connected = False
        self._anchor = 0.0
        self._session = 0
        self._greeted = False
        self._took_at = -1.0
        self._ends_at = None  # the turn at which the link is over because the robot is gone

    def value(self, uuid):
        """What is read from a characteristic."""
        if uuid == BATTERY_LEVEL:
            with _lock:
                self.air.catch_up()
                return bytes([self.robot.state().charge])
        return self._values[uuid]

    def next_turn(self, t):
        """When the link has its first turn after `t`."""
        turns = math.floor((t - self._anchor) / INTERVAL_S + _NEARLY) + 1
        return self._anchor + turns * INTERVAL_S

    def turn_at_or_after(self, t):
        """When the link has its first turn at `t` or after it."""
        turns = math.ceil((t - self._anchor) / INTERVAL_S - _NEARLY)
        return self._anchor + turns * INTERVAL_S

    def _collect(self):
        """Gives what has left the robot to the clients, each piece with the turn at which it arrives."""
        now = self.robot.now
        data = self.robot.read()
        if not data:
            return
        after_a_write = now - self._took_at < INTERVAL_S * _NEARLY
        at = self.next_turn(now) if after_a_write else self.turn_at_or_after(now)
        for packet in split_packets(bytes(data), self.protocol):
            for start in range(0, len(packet), PIECE_BYTES):
                for link in self.links:
                    link.inbox.append((at, self.answers, packet[start : start + PIECE_BYTES]))
        for link in self.links:
            link.arrived()

    def _take(self, uuid, data):
        """What the robot does with what was written."""
        if uuid is None:  # its patience is over
            if data == self._session and not self._greeted:
                self._drop()
        elif any(uuid == to for to, _ in self.greeting):
            self._greeted = (uuid, data) in self.greeting
        elif uuid == self.commands and (self._greeted or not self.is_deaf):
            self.robot.write(data)
            self._took_at = self.robot.now

    def _drop(self):
        """The link is over, for all who share it."""
        links, self.links = self.links, []
        self._session += 1
        self._greeted = False
        self._ends_at = None
        if self.robot.connected:
            self.robot.disconnect()
        for link in links:
            link.lost()


def split_packets(data, protocol):
    """Cuts bytes that hold whole packets into packets; what is none stays together."""
    packets, at = [], 0
    while at < len(data):
        if protocol == "v2":
            end = data.find(0xD8, at) + 1 or len(data)
        else:
            end = len(data)
            if len(data) - at >= 5 and data[at] == 0xFF:
                size = data[at + 4] + (data[at + 3] << 8 if data[at + 1] == 0xFE else 0)
                end = min(end, at + 5 + size)
        packets.append(data[at:end])
        at = end
    return packets


class Write:
    """Bytes on their way to a robot."""

    def __init__(self, radio, uuid, data, at):
        self.radio = radio
        self.uuid = uuid
        self.data = data
        self.at = at  # a turn of the link
        self.taken = False


class Air:
    """The robots, their world and its clock.

    world: an `_orb.World`; gatt: `_orb.gatt`; clock: seconds, monotonic; names, addresses: what the robots advertise
    instead of their own, in their order.
    """

    def __init__(self, world, gatt, clock=time.monotonic, names=(), addresses=()):
        self.world = world
        self.clock = clock
        self.start = clock()
        robots = itertools.zip_longest(world.robots, names, addresses)
        self.radios = [
            Radio(self, robot, gatt(robot.kind), index, name, address)
            for index, (robot, name, address) in enumerate(robots)
        ]
        self._written = []
        self._order = 0

    def now(self):
        """Seconds since the robots were switched on."""
        return self.clock() - self.start

    def find(self, address):
        """The robot with an address, in any case; None: there is none."""
        return next((radio for radio in self.radios if radio.address.lower() == address.lower()), None)

    def advertised(self, radio, since, until):
        """True if a robot has advertised between `since` and `until`."""
        if radio.links:
            return False
        first = math.ceil((since - radio.advertises_from) / ADVERTISES_EVERY_S - _NEARLY)
        return first * ADVERTISES_EVERY_S + radio.advertises_from <= until

    def catch_up(self):
        """Brings the world to the present, and what was written to the robots."""
        with _lock:
            now = self.now()
            while self._written and self._written[0][0] <= now + INTERVAL_S * _NEARLY:
                write = heapq.heappop(self._written)[-1]
                self._advance(write.at)
                if write.radio.links:
                    write.taken = True
                    write.radio._take(write.uuid, write.data)
            for turn in sorted(radio.next_turn(now) - INTERVAL_S for radio in self.radios if radio.links):
                self._advance(turn)
            self._advance(now)

    def _advance(self, t):
        if t > self.world.now:
            self.world.advance(t - self.world.now)
        for radio in self.radios:
            if not radio.links:
                radio.robot.read()  # nobody hears what a robot says that has just fallen asleep
                continue
            radio._collect()
            if radio.robot.connected:
                radio._ends_at = None
            elif radio._ends_at is None:  # what it said last is still under way
                radio._ends_at = radio.next_turn(self.world.now)
            elif self.world.now >= radio._ends_at - INTERVAL_S * _NEARLY:
                radio._drop()

    def connect(self, radio, link):
        """Connects a client: an object with `inbox`, a deque, `arrived()` and `lost()`, called in any thread."""
        with _lock:
            self.catch_up()
            if not radio.links:
                radio._anchor = self.now()
                radio.robot.connect()
                radio.ever_connected = True
                if radio.patience is not None:
                    self._send(radio, None, radio._session, radio.turn_at_or_after(self.now() + radio.patience))
            radio.links.append(link)

    def disconnect(self, radio):
        """Ends a link, for all clients of the robot."""
        with _lock:
            self.catch_up()
            radio._drop()

    def write(self, radio, uuid, data):
        """Sends bytes to a characteristic, where they are at the next turn of the link. Returns a `Write`."""
        with _lock:
            self.catch_up()
            return self._send(radio, uuid, data, radio.next_turn(self.now()))

    def _send(self, radio, uuid, data, at):
        write = Write(radio, uuid, data, at)
        self._order += 1
        heapq.heappush(self._written, (at, self._order, write))
        return write

    def next_turn(self, radio):
        """When a client has to look again, at a turn of its link; None: not before something is written."""
        with _lock:
            times = [at + INTERVAL_S for at, _, _ in self._written]
            for other in self.radios:
                event = other.robot.next_event()
                if event is not None:
                    times.append(event)
            if radio._ends_at is not None:
                times.append(radio._ends_at)
            if radio.links and radio.robot.now - radio._took_at < INTERVAL_S:
                times.append(radio.robot.now)
            if not times:
                return None
            return max(radio.turn_at_or_after(min(times)), radio.next_turn(self.now()))


_air = None


def use(air):
    """Makes an `Air` the one that programs of this process are in."""
    global _air
    _air = air


def current():
    """The `Air` of this process. Raises RuntimeError without one."""
    if _air is None:
        raise RuntimeError("there are no robots here: start the program with `python -m orb_robot run`")
    return _air
