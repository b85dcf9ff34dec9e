"""The errors of this library; the text of each is one line for the user."""


class NodeKitError(Exception):
    """The base of all errors of this library."""


class ServiceError(NodeKitError):
    """A service cannot be called."""


class StartError(NodeKitError):
    """A node cannot start."""
