"""The command: checks its options, waits for a master, and prints the address of the page."""

from __future__ import annotations

import argparse
import errno
import os
import secrets
import shutil
import socket
import subprocess
import sys
from typing import Any, NoReturn
from urllib.parse import urlsplit

import rosgraph
import rospy

from cockpit_server.access import Access, gateways
from cockpit_server.io.waiting_page import answer_for
from node_kit.parameters.arguments import Parser
from node_kit.ros.graph.ros_api import call, way_out
from node_kit.ros.lifecycle.start import run
from node_kit.rules.answer import Answer
from tutorial_tools.ros.cockpit_page import PARAMETER, address

NODE_NAME = "cockpit"
DEFAULT_PORT = 8080
LOOK_S = 1.0
TOKEN_BYTES = 16
ELSEWHERE = "192.0.2.1"  # RFC 5737 has it for documentation
TOKENS = "COCKPIT_TOKENS"  # environment variable, which only this user can read
# In a container: the host's port at which the page is published, and the addresses of other peers.
PUBLISHED, PEERS = "COCKPIT_PUBLISHED", "COCKPIT_PEERS"


def port(text: str) -> int:
    """Return the TCP port of --port."""
    if not text.isdigit() or not 1 <= int(text) <= 65535:
        raise argparse.ArgumentTypeError(f"{text}: not a port, a number from 1 to 65535")
    return int(text)


def parse(argv: list[str]) -> argparse.Namespace:
    parser = Parser(
        prog="cockpit", description="Shows the robots in a browser, and lets one page drive."
    )
    parser.add_argument("--port", type=port, default=DEFAULT_PORT, help="of the page's address")
    lan = "other machines may open the page, too, with a token that is printed"
    parser.add_argument("--lan", action="store_true", help=lan)
    return parser.parse_args(argv)


def fail(line: str) -> NoReturn:
    sys.exit(f"cockpit: {line}")


def report(line: str) -> None:
    print(f"cockpit: {line}", flush=True)


def listening(port: int, lan: bool) -> list[socket.socket]:
    """Return the listening sockets, or exit with a line if the port is taken."""
    try:
        listener = socket.create_server(("" if lan else "127.0.0.1", port), backlog=128)
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            leave_to_other(port, lan)
        why = os.strerror(error.errno or 0)
        fail(f"cannot listen on port {port}: {why}; take another: --port 8080")
    listener.setblocking(False)
    return [listener]


def leave_to_other(port: int, lan: bool) -> NoReturn:
    """Exit, with 0 if the port is that of a cockpit of the same master that needs no change."""
    page = address(rosgraph.get_master_uri())
    if not page or urlsplit(page).port != port:
        fail(f"port {port} is taken, maybe by another cockpit: end it, or take --port {port + 1}")
    if lan:
        fail(
            f"a cockpit is already running at {page}; for other machines end it first (a launch "
            f"file starts none with cockpit:=false), or take --port {port + 1}"
        )
    report(f"a cockpit is already running: {where(page)}")
    sys.exit()


def wait_for_master(listener: socket.socket) -> None:
    uri = rosgraph.get_master_uri()
    if call(uri, "getPid")[0] is Answer.REFUSED:
        report(f"waiting for a ROS master at {uri}: start roscore, or a launch file")
    while call(uri, "getPid")[0] is Answer.REFUSED:
        answer_for(listener, LOOK_S)


def main() -> int:
    options = parse(rosgraph.myargv()[1:])
    try:
        from cockpit_server.ros.cockpit_node import Cockpit  # noqa: PLC0415  tornado may be missing
    except ModuleNotFoundError as error:
        if error.name != "tornado":
            raise
        fail("python3-tornado is missing: ./tutorial setup, or apt install python3-tornado")
    published = PUBLISHED in os.environ and not options.lan
    sockets = listening(options.port, options.lan or published)
    here = Access(peers=peers() if published else None, origins=codespace(options.port))
    access = new_access() if options.lan else here
    wait_for_master(sockets[0])

    def spin(_parameters: Any) -> None:
        print_address(options.port, access)
        uri, page = rosgraph.get_master_uri(), f"http://127.0.0.1:{options.port}/"
        rospy.set_param(PARAMETER, page)
        cockpit = Cockpit(sockets, access)
        try:
            cockpit.run()
        finally:
            # Another cockpit, under another name, may have set its own address.
            if call(uri, "getParam", PARAMETER) == (Answer.WELL, page):
                call(uri, "deleteParam", PARAMETER)
        if cockpit.has_lost_master:
            restart(access)

    return run(NODE_NAME, no_parameters, spin, keeps_name=True)


def restart(access: Access) -> NoReturn:
    """Replace this process, with the same tokens, as rospy cannot change its master."""
    report("the ROS master has exited")
    if access.driver_token:
        os.environ[TOKENS] = f"{access.driver_token} {access.viewer_token}"
    os.execv(sys.executable, [sys.executable, *sys.argv])


def new_access() -> Access:
    """Return an Access for other machines, with new tokens or those from restart()."""
    host = socket.gethostname().lower()
    kept = os.environ.pop(TOKENS, "").split()
    driver, viewer = kept or [secrets.token_urlsafe(TOKEN_BYTES) for _ in range(2)]
    return Access(("localhost", host, f"{host}.local"), driver, viewer)


def peers() -> tuple[str, ...]:
    """Return the addresses from which requests through a container's published port come."""
    with open("/proc/net/route", encoding="ascii") as routes:
        return (*gateways(routes.read()), *os.environ.get(PEERS, "").split())


def codespace(port: int) -> tuple[str, ...]:
    """Return the origin under which GitHub forwards a port of a Codespace; () elsewhere."""
    # docs.github.com: "Default environment variables for your codespace"
    name, domain = map(
        os.environ.get, ("CODESPACE_NAME", "GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN")
    )
    return (f"https://{name}-{port}.{domain}",) if name and domain else ()


def no_parameters(given: dict[str, Any]) -> None:
    for name in given:
        raise ValueError(f"~{name}: no such parameter; the port is --port, other machines --lan")


def where(page: str) -> str:
    """Return where to open a page that only this machine can reach."""
    if PUBLISHED in os.environ:
        return f"open http://localhost:{os.environ[PUBLISHED]}/ on the container's host"
    return f"open {page} on this machine"


def print_address(port: int, access: Access) -> None:
    """Print the address of the page, the only place where a token is shown."""
    if access.driver_token is None:
        report(where(f"http://127.0.0.1:{port}/"))
        return
    own = way_out(ELSEWHERE) or socket.gethostname()
    page = f"http://{own}:{port}/?token="
    print(f"cockpit: to look:  {page}{access.viewer_token}")
    report(f"to drive: {page}{access.driver_token}")
    show_code(f"{page}{access.driver_token}")


def show_code(text: str) -> None:
    """Print a text as a QR code; it is not passed as an argument, which all users can see."""
    if not shutil.which("qrencode"):
        report("(for a QR code: apt install qrencode)")
        return
    done = subprocess.run(
        ["qrencode", "-t", "UTF8", "-m", "1"], input=text.encode(), capture_output=True, check=False
    )
    print(done.stdout.decode(errors="replace"), end="", flush=True)
