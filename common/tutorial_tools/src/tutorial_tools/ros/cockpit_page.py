"""Where the cockpit's page is. The cockpit writes it down; what leads to the page reads it."""

from __future__ import annotations

from node_kit.ros.graph.ros_api import accepts, call
from node_kit.rules.answer import Answer

PARAMETER = "/cockpit_address"  # http://HOST:PORT/, as long as the cockpit of a master runs


def address(master_uri: str) -> str | None:
    """Return the address of the page that shows this master's robots, or None without a page."""
    answer, found = call(master_uri, "getParam", PARAMETER)
    if answer is not Answer.WELL or not isinstance(found, str):
        return None
    return found if accepts(found) else None
