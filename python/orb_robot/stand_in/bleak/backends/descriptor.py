"""What describes a characteristic."""

from ..uuids import uuidstr_to_str


class BleakGATTDescriptor:
    """A descriptor: whether a characteristic notifies, for each that does."""

    def __init__(self, uuid, handle, characteristic):
        self.obj = {"path": f"{characteristic.obj['path']}/desc{handle:04x}"}
        self.uuid = uuid
        self.handle = handle
        self.characteristic_uuid = characteristic.uuid
        self.characteristic_handle = characteristic.handle

    @property
    def description(self):
        """The name of its UUID."""
        return uuidstr_to_str(self.uuid)

    def __str__(self):
        return f"{self.uuid} (Handle: {self.handle}): {self.description}"
