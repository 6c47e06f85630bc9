"""What of a robot can be written to, read, or listened to."""

import enum
from uuid import UUID

from ..uuids import uuidstr_to_str


class GattCharacteristicsFlags(enum.Enum):
    """What can be done with a characteristic."""

    broadcast = 0x0001
    read = 0x0002
    write_without_response = 0x0004
    write = 0x0008
    notify = 0x0010
    indicate = 0x0020
    authenticated_signed_writes = 0x0040
    extended_properties = 0x0080
    reliable_write = 0x0100
    writable_auxiliaries = 0x0200


class BleakGATTCharacteristic:
    """A characteristic.

    Programs for older versions of Bleak take the sender of a notification for the number of its handle or the text of
    its UUID: it equals both, and is printed as a number where a format asks for one.
    """

    def __init__(self, uuid, handle, properties, service, most):
        self.obj = {"path": f"{service.obj['path']}/char{handle:04x}"}
        self.uuid = uuid
        self.handle = handle
        self.properties = list(properties)
        self.descriptors = []
        self.service_uuid = service.uuid
        self.service_handle = service.handle
        self.max_write_without_response_size = most

    @property
    def description(self):
        """The name of its UUID."""
        return uuidstr_to_str(self.uuid)

    def get_descriptor(self, specifier):
        """A descriptor by its handle or UUID; None: it has none such."""
        wanted = specifier if isinstance(specifier, int) else str(specifier).lower()
        return next((each for each in self.descriptors if wanted in (each.handle, each.uuid)), None)

    def __str__(self):
        return f"{self.uuid} (Handle: {self.handle}): {self.description}"

    def __repr__(self):
        return f"<BleakGATTCharacteristic {self}>"

    def __eq__(self, other):
        if isinstance(other, BleakGATTCharacteristic):
            return (self.handle, self.obj) == (other.handle, other.obj)
        if isinstance(other, (str, UUID)):
            return self.uuid == str(other).lower()
        return self.handle == other if isinstance(other, int) else NotImplemented

    def __hash__(self):
        return hash(self.handle)

    def __index__(self):
        return self.handle

    __int__ = __index__

    def __format__(self, form):
        return format(self.handle if form[-1:] in tuple("bcdoxXn") else str(self), form)
