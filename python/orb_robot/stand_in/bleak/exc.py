"""The errors of Bleak, raised where Bleak raises them."""


class BleakError(Exception):
    """The base of all of them."""


class BleakCharacteristicNotFoundError(BleakError):
    """The robot has no such characteristic; `char_specifier` is what was asked for."""

    def __init__(self, char_specifier, *args):
        super().__init__(*(args or (f"Characteristic {char_specifier} was not found!",)))
        self.char_specifier = char_specifier


class BleakDeviceNotFoundError(BleakError):
    """No robot with this address advertises; `identifier` is the address."""

    def __init__(self, identifier, *args):
        super().__init__(*args)
        self.identifier = identifier


class BleakBluetoothNotAvailableError(BleakError):
    """There is no radio. The virtual one is always on."""


class BleakDBusError(BleakError):
    """What BlueZ answers to what cannot be done."""

    def __init__(self, dbus_error, error_body):
        super().__init__(dbus_error, *error_body)

    @property
    def dbus_error(self):
        """Its name, as `org.bluez.Error.NotPermitted`."""
        return self.args[0]

    @property
    def dbus_error_details(self):
        """Its sentence; None without one."""
        return self.args[1] if len(self.args) > 1 else None

    def __str__(self):
        details = self.dbus_error_details
        return f"[{self.dbus_error}]" + (f" {details}" if details else "")


class BleakGATTProtocolError(BleakError):
    """An answer of the robot's attribute server that is an error."""

    def __init__(self, code, *args):
        super().__init__(code, *args)
        self.code = code


def bluez_error(name, sentence):
    """An error of BlueZ, from the end of its name."""
    return BleakDBusError(f"org.bluez.Error.{name}", [sentence])
