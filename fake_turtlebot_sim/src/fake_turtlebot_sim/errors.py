"""The errors of this package; the text of each is one line for the user."""


class FakeTurtlebotError(Exception):
    """The base class; its text says in one line what is wrong, and what to do."""


class ReplayError(FakeTurtlebotError):
    """A bag or a file cannot be replayed."""


class WorldError(FakeTurtlebotError, ValueError):
    """A file is not a world; the text names the line and what is allowed, but not the path."""
