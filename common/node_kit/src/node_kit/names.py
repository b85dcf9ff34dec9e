"""Who holds a name on the graph: a robot that runs is not displaced by a second one of its name."""

import socket
from urllib.parse import urlsplit

from node_kit.questions import Answer, call

PATIENCE_S = 3.0  # a node that hangs or waits for a busy processor still holds its name


def holder(master_uri, name):
    """Where the node of a name runs, as (uri, words), or None if nobody holds the name.

    A name whose node is dead (its port refuses or is another node's by now, or its host is gone) is
    free; one whose node takes the connection but does not answer is not, since a stopped robot may
    go on.
    """
    answer, uri = call(master_uri, "lookupNode", name)
    if answer is not Answer.WELL:
        return None
    answer, pid = call(uri, "getPid", timeout_s=PATIENCE_S)
    if answer is Answer.WELL:
        answer, own = call(uri, "getName", timeout_s=PATIENCE_S)  # rospy's nodes know it
        if answer is Answer.WELL and own != name:
            return None
        return uri, f"at {uri}, process {pid}"
    if answer is Answer.SILENT and accepts(uri):
        return uri, f"at {uri}, but does not answer"
    return None


def accepts(uri):
    """Whether something takes a connection at a URI; a process that is stopped does so, too."""
    try:
        parts = urlsplit(uri)
        with socket.create_connection((parts.hostname, parts.port), PATIENCE_S):
            return True
    except (OSError, ValueError):
        return False
