"""How a master or a node answers a question."""

from enum import Enum


class Answer(Enum):
    """The result of a question to a master or a node."""

    WELL = "answers"
    MALFORMED = "is not of the form http://HOST:PORT"
    UNKNOWN_NAME = "has a name that cannot be looked up here"
    REFUSED = "is not there, nothing listens on its port"
    SILENT = "does not answer"
    STRANGE = "is something else, and not of ROS"
