"""The windows of rqt: the cockpit's page at the tab that shows the same, or a program of ours."""

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

PORTS = range(8080, 8100)  # of a cockpit that is started here: the first that is free
LOOK_S = 0.2
PICTURE = "rosgraph.png"


def show(shown: str) -> None:
    """Open a page or a file where there is a screen."""
    if os.environ.get("DISPLAY") and shutil.which("xdg-open"):
        # Without waiting: a browser that this opens runs for as long as it is used.
        none = subprocess.DEVNULL
        command = ["xdg-open", shown]
        subprocess.Popen(command, stdin=none, stdout=none, stderr=none, start_new_session=True)


def start_cockpit(uri: str) -> str:
    """Let this process be a cockpit, as a window would go on; return its page in a second one."""
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
    os._exit(1)  # the cockpit has said why


def main() -> None:
    """Print the address of what the window would show, and open it where there is a screen."""
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
