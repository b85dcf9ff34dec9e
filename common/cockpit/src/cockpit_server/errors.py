"""The errors of the cockpit."""


class CockpitError(Exception):
    """What a person at a page can do something about; the text says it in one line."""


class RefusedError(CockpitError):
    """Why the cockpit does not do what a page has asked for."""
