"""A robot that a scan has found."""


class BLEDevice:
    """What a scan has found: its address and the name that it says."""

    __slots__ = ("address", "name", "details", "_rssi", "_metadata")

    def __init__(self, address, name, details=None, rssi=None, **metadata):
        self.address = address
        self.name = name
        self.details = details
        self._rssi = rssi
        self._metadata = metadata

    @property
    def rssi(self):
        """The strength of its radio here, in dBm (for older programs)."""
        return self._rssi

    @property
    def metadata(self):
        """What else it advertises, as `{"uuids": […], "manufacturer_data": {…}}` (for older programs)."""
        return self._metadata

    def __str__(self):
        return f"{self.address}: {self.name}"

    def __repr__(self):
        return f"BLEDevice({self.address}, {self.name})"
