"""The windows of rqt, and where the cockpit's page has what they show (pure)."""

from __future__ import annotations

from typing import Sequence
from urllib.parse import urlencode

# Command and package -> the tab.
TABS = {
    "rqt": "", "rqt_gui": "", "rqt_console": "log", "rqt_logger_level": "log", "rqt_plot": "plot",
    "rqt_publisher": "topics", "rqt_service_caller": "topics", "rqt_topic": "topics",
}  # fmt: skip


def place(window: str, names: Sequence[str]) -> str:
    """Return what follows # in the page's address.

    names: of topics, or of fields as rqt_plot takes them, such as /turtle1/pose/x:y,/joy/axes[0]
    """
    tab = TABS[window]
    full = [f"/{one.lstrip('/')}" for text in names for one in text.split(",") if one]
    if tab == "plot" and full:
        return f"plot?{urlencode([('f', f) for one in full for f in _fields(one)], safe='/[]')}"
    return f"{tab}{full[0]}" if tab == "topics" and full else tab


def _fields(text: str) -> list[str]:
    first, *others = text.split(":")
    above = first.rpartition("/")[0]
    return [first, *(f"{above}/{other}" for other in others)]
