"""Lets one thing fail and the others go on (pure)."""

from __future__ import annotations

from typing import Any, Callable

MOST_REPORTED = 100  # things; a page may ask for any number of topics that do not exist


class Guard:
    """Calls what may fail, and reports the first failure of each thing."""

    def __init__(self, report: Callable[[str], None]) -> None:
        self._report = report
        self._reported: set[str] = set()

    def __call__(self, about: str, action: Callable[..., Any], *arguments: Any) -> None:
        """Do something. about: what fails, such as the name of a source."""
        try:
            action(*arguments)
        except Exception as error:  # whatever it is, it is a fault of that thing alone
            if about not in self._reported and len(self._reported) < MOST_REPORTED:
                self._reported.add(about)
                self._report(f"cockpit: {about}: {type(error).__name__}: {error}")
