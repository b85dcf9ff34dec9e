"""The bridge's node in ROS 1, which program.py starts: python3 -m ros2_bridge.ros1_node FOLDER."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import rospkg
import rospy

from node_kit.start import run
from ros2_bridge.connection import end_with_parent
from ros2_bridge.ros1_side import NAME, Ros1Side
from ros2_bridge.routes import Route, read_routes

SOCKET, LIST = "socket", "topics.yaml"  # in the folder that both sides know


def load(folder: Path, given: dict[str, Any]) -> list[Route]:
    """Return the Routes; write their list for the other side. Raises ValueError with one line."""
    file = given.pop("topics", "") or f"{rospkg.RosPack().get_path(NAME)}/config/bridge.yaml"
    if given:
        raise ValueError(f"~{next(iter(given))}: is not known; known is ~topics")
    if not isinstance(file, str):
        raise ValueError(f"~topics: {file!r}: the path of a YAML list is wanted")
    try:
        text = Path(file).read_text(encoding="utf-8")
        routes = read_routes(text)
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"~topics: {file}: {getattr(error, 'strerror', error)}") from None
    except ValueError as error:
        raise ValueError(f"~topics: {file}: {error}") from None
    (folder / LIST).write_text(text, encoding="utf-8")
    return routes


def main() -> int:
    """Run the node; return its exit code."""
    end_with_parent()
    folder = Path(sys.argv.pop(1))
    return run(
        NAME,
        lambda given: load(folder, given),
        lambda routes: Ros1Side(routes, str(folder / SOCKET), rospy.logwarn).run(),
        keeps_name=True,
    )


if __name__ == "__main__":
    sys.exit(main())
