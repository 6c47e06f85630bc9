"""What a scan gives, and the types of its callbacks."""

from typing import Any, Awaitable, Callable, Dict, List, NamedTuple, Optional, Tuple

from .device import BLEDevice


class AdvertisementData(NamedTuple):
    """What a robot says of itself to everybody."""

    local_name: Optional[str]
    manufacturer_data: Dict[int, bytes]
    service_data: Dict[str, bytes]
    service_uuids: List[str]
    tx_power: Optional[int]
    rssi: int
    platform_data: Tuple[Any, ...]


AdvertisementDataCallback = Callable[[BLEDevice, AdvertisementData], Optional[Awaitable[None]]]
AdvertisementDataFilter = Callable[[BLEDevice, AdvertisementData], bool]


class BaseBleakScanner:
    """The base of the scanners of platforms. Nothing here derives from it."""
