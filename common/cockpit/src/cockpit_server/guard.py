"""Lets one thing fail and the others go on (pure)."""

from __future__ import annotations

from typing import Any, Callable

MOST_TOLD = 100  # things; a page may ask for any number of topics that are none


class Guard:
    """Calls what may fail, and reports the first failure of each thing."""

    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell
        self._told: set[str] = set()

    def __call__(self, about: str, action: Callable[..., Any], *arguments: Any) -> None:
        """Do something. about: what fails, such as the name of a source."""
        try:
            action(*arguments)
        except Exception as error:  # whatever it is, it is a fault of that thing alone
            if about not in self._told and len(self._told) < MOST_TOLD:
                self._told.add(about)
                self._tell(f"cockpit: {about}: {type(error).__name__}: {error}")
