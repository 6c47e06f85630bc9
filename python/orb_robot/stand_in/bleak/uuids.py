"""UUIDs and their names."""

from uuid import UUID

_BASE = "-0000-1000-8000-00805f9b34fb"
#: The names of numbers of 16 bits that programs look up, as the Bluetooth SIG assigned them.
uuid16_dict = {
    0x1800: "Generic Access Profile",
    0x1801: "Generic Attribute Profile",
    0x180A: "Device Information",
    0x180F: "Battery Service",
    0x2902: "Client Characteristic Configuration",
    0x2A00: "Device Name",
    0x2A01: "Appearance",
    0x2A04: "Peripheral Preferred Connection Parameters",
    0x2A05: "Service Changed",
    0x2A19: "Battery Level",
    0x2A23: "System ID",
    0x2A24: "Model Number String",
    0x2A25: "Serial Number String",
    0x2A26: "Firmware Revision String",
    0x2A27: "Hardware Revision String",
    0x2A28: "Software Revision String",
    0x2A29: "Manufacturer Name String",
    0x2A50: "PnP ID",
}
uuid128_dict = {}
_registered = {}


def normalize_uuid_16(uuid):
    """The 128 bits of a number of 16 bits, as text."""
    return normalize_uuid_str(f"{uuid:04x}")


def normalize_uuid_32(uuid):
    """The 128 bits of a number of 32 bits, as text."""
    return normalize_uuid_str(f"{uuid:08x}")


def normalize_uuid_str(uuid):
    """Lower case, and all 128 bits of a short one. Raises ValueError if it is no UUID."""
    if len(uuid) == 4:
        uuid = "0000" + uuid + _BASE
    elif len(uuid) == 8:
        uuid += _BASE
    return str(UUID(uuid.lower()))


def register_uuids(uuids_to_descriptions):
    """Gives UUIDs names of the program's own."""
    _registered.update({normalize_uuid_str(uuid): text for uuid, text in uuids_to_descriptions.items()})


def uuidstr_to_str(uuid_):
    """The name of a UUID."""
    uuid = normalize_uuid_str(uuid_)
    known = uuid16_dict.get(int(uuid[:8], 16)) if uuid.endswith(_BASE) else None
    return _registered.get(uuid) or known or ("Vendor specific" if uuid.endswith(_BASE) else "Unknown")
