"""The errors of this library; the text of each is one line for the user."""


class GamepadError(Exception):
    """The base of all errors of this library."""


class BagError(GamepadError, ValueError):
    """A bag cannot be used; the text begins with its path."""


class DeviceError(GamepadError):
    """No gamepad can be opened or read."""


class PadError(GamepadError):
    """A virtual gamepad cannot be created."""
