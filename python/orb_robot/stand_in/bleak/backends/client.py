"""The base of the clients of platforms."""


class BaseBleakClient:
    """The base of the clients of platforms. Nothing here derives from it."""
