"""The address of the cockpit's page, which the cockpit puts on the parameter server."""

from __future__ import annotations

from node_kit.ros.graph.ros_api import accepts, call
from node_kit.rules.answer import Answer

PARAMETER = "/cockpit_address"  # http://HOST:PORT/, while a cockpit runs


def address(master_uri: str) -> str | None:
    """Return the address of the page that shows this master's robots, or None."""
    answer, uri = call(master_uri, "getParam", PARAMETER)
    if answer is not Answer.WELL or not isinstance(uri, str):
        return None
    return uri if accepts(uri) else None
