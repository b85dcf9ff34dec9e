"""Where the cockpit's page is, for programs that send people there (pure)."""

from node_kit.names import accepts
from node_kit.questions import Answer, call

PARAMETER = "/cockpit_address"  # http://HOST:PORT/, as long as the cockpit of a master runs


def address(master_uri):
    """The address of the page on which this master's robots are seen, or None if there is none."""
    answer, found = call(master_uri, "getParam", PARAMETER)
    if answer is not Answer.WELL or not isinstance(found, str):
        return None
    return found if accepts(found) else None
