"""The errors of this library; the text of each is one line for the user.

Imports nothing: ./tutorial setup system needs it while the rest may be missing (docker/Dockerfile).
"""


class TutorialError(Exception):
    """The base of all errors of this library."""


class SetUpError(TutorialError):
    """Something cannot be installed or built."""


class JoinError(TutorialError):
    """A classroom or its robot cannot be joined."""


class DemoError(TutorialError):
    """The demonstration cannot run."""
