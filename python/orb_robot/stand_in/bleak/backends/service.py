"""The services of a robot: groups of characteristics."""

from ..exc import BleakError
from ..uuids import normalize_uuid_str, uuidstr_to_str


def _number_or_uuid(specifier):
    if isinstance(specifier, int):
        return specifier
    try:
        return normalize_uuid_str(str(specifier))
    except ValueError:
        return str(specifier).lower()


class BleakGATTService:
    """A service and its characteristics."""

    def __init__(self, uuid, handle, device_path):
        self.obj = {"path": f"{device_path}/service{handle:04x}"}
        self.uuid = uuid
        self.handle = handle
        self.characteristics = []

    @property
    def description(self):
        """The name of its UUID."""
        return uuidstr_to_str(self.uuid)

    def get_characteristic(self, uuid):
        """Its first characteristic with a UUID; None: it has none."""
        wanted = _number_or_uuid(uuid)
        return next((each for each in self.characteristics if each.uuid == wanted), None)

    def __str__(self):
        return f"{self.uuid} (Handle: {self.handle}): {self.description}"


class BleakGATTServiceCollection:
    """All services of a robot, by handle or UUID."""

    def __init__(self):
        self.services = {}
        self.characteristics = {}
        self.descriptors = {}

    def __iter__(self):
        return iter(self.services.values())

    def __len__(self):
        return len(self.services)

    def __getitem__(self, item):
        return self.get_service(item) or self.get_characteristic(item) or self.get_descriptor(item)

    def get_service(self, specifier):
        """A service by its handle or UUID; None: there is none."""
        return self._find(self.services, specifier, "Services")

    def get_characteristic(self, specifier):
        """A characteristic by its UUID, its handle or that of its value; None: there is none."""
        found = self._find(self.characteristics, specifier, "Characteristics")
        if found is None and isinstance(specifier, int):
            found = self.characteristics.get(specifier - 1)
        return found

    def get_descriptor(self, handle):
        """A descriptor by its handle; None: there is none."""
        return self.descriptors.get(handle)

    @staticmethod
    def _find(table, specifier, what):
        wanted = _number_or_uuid(specifier)
        if isinstance(wanted, int):
            return table.get(wanted)
        found = [each for each in table.values() if each.uuid == wanted]
        if len(found) > 1:
            raise BleakError(f"Multiple {what} with this UUID, refer to your desired one by the `handle` attribute instead.")
        return found[0] if found else None
