"""Contains failures: where one thing fails, the others continue."""

from __future__ import annotations

from typing import Any, Callable

MOST_REPORTED = 100  # subjects; a page may ask for any number of topics that do not exist


class Guard:
    """A caller of actions that may fail, which reports the first failure of each subject."""

    def __init__(self, report: Callable[[str], None]) -> None:
        self._report = report
        self._reported: set[str] = set()

    def __call__(self, subject: str, action: Callable[..., Any], *arguments: Any) -> None:
        """Call an action. subject: what it is about, such as the name of a topic."""
        try:
            action(*arguments)
        except Exception as error:  # Any failure concerns this subject alone.
            if subject not in self._reported and len(self._reported) < MOST_REPORTED:
                self._reported.add(subject)
                self._report(f"cockpit: {subject}: {type(error).__name__}: {error}")
