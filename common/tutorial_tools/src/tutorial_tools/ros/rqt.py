"""The commands of rqt's windows: each leads to a tab of the cockpit, or to a program of ours."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import rosgraph

from node_kit.parameters.arguments import Parser
from node_kit.ros.graph.ros_api import accepts
from tutorial_tools.ros import draw_graph
from tutorial_tools.ros.cockpit_page import address
from tutorial_tools.rqt_windows import TABS, place

PORTS = range(8080, 8100)  # for a cockpit that is started here: the first free one
LOOK_S = 0.2
PICTURE = "rosgraph.png"


def show(shown: str) -> None:
    """Open a page or a file if there is a screen."""
    if os.environ.get("DISPLAY") and shutil.which("xdg-open"):
        # Without waiting: the browser may run for hours.
        none = subprocess.DEVNULL
        command = ["xdg-open", shown]
        subprocess.Popen(command, stdin=none, stdout=none, stderr=none, start_new_session=True)


def start_cockpit(uri: str) -> str:
    """Become the cockpit; return the address of its page in a child process."""
    window = os.getpid()
    if os.fork():
        free = (port for port in PORTS if not accepts(f"http://127.0.0.1:{port}/"))
        port = next(free, PORTS[0])
        os.execvp("rosrun", ["rosrun", "cockpit", "cockpit.py", "--port", str(port)])
    while os.getppid() == window:
        page = address(uri)
        if page:
            return page
        time.sleep(LOOK_S)
    os._exit(1)  # the cockpit has reported why


def main() -> None:
    """Print the address of the matching tab, and open it if there is a screen."""
    window = Path(sys.argv[0]).name
    if window == "rqt_bag":
        from tutorial_tools.ros import rqt_bag  # noqa: PLC0415  which loads rosbag

        rqt_bag.main()
        return
    about = f"Shows {TABS[window] or 'all'} in a browser, on the cockpit's page."
    parser = Parser(prog=window, description=about)
    what = "a field to plot, such as /turtle1/pose/x:y, or a topic to show"
    parser.add_argument("name", nargs="*", help=what)
    names = parser.parse_args(rosgraph.myargv()[1:]).name
    uri = rosgraph.get_master_uri()
    page, tab = address(uri), place(window, names)
    if window == "rqt_graph" and not page:
        draw_graph.main([PICTURE])
        show(PICTURE)
        return
    page = (page or start_cockpit(uri)) + (tab and f"#{tab}")
    print(f"{window}: see {page}", flush=True)
    show(page)
