"""The errors of the cockpit."""


class CockpitError(Exception):
    """An error for the person at a page; its text is one line."""


class RefusedError(CockpitError):
    """Why the cockpit does not do what a page has asked for."""
