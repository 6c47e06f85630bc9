"""A stand-in for the package Bleak: its robots are virtual.

It has the names that programs use of Bleak 0.12 to 1.0, and keeps the times of a real link: a robot that advertises ten
times a second, a turn of the link every 15 ms, pieces of at most 20 bytes.
"""

from ._client import BleakClient
from ._scanner import BleakScanner
from .backends.characteristic import BleakGATTCharacteristic
from .backends.descriptor import BleakGATTDescriptor
from .backends.device import BLEDevice
from .backends.scanner import AdvertisementData
from .backends.service import BleakGATTService, BleakGATTServiceCollection
from .exc import BleakError

__version__ = "0.22.3"
__all__ = [
    "AdvertisementData",
    "BLEDevice",
    "BleakClient",
    "BleakError",
    "BleakGATTCharacteristic",
    "BleakGATTDescriptor",
    "BleakGATTService",
    "BleakGATTServiceCollection",
    "BleakScanner",
    "discover",
]


def discover(*args, **kwargs):
    """`BleakScanner.discover` (for older programs)."""
    return BleakScanner.discover(*args, **kwargs)
