"""The errors of this driver; the text of each is one line for the user."""


class KobukiDriverError(Exception):
    """The base class; its text says in one line what is wrong, and what to do."""


class PortError(KobukiDriverError):
    """The serial port cannot be used."""
