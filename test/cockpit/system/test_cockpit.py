"""The cockpit beside clients without a browser: refusals, floods, and launch_joy_node.launch."""

import contextlib
import functools
import http.client
import re
import socket
import sys
import time
from pathlib import Path

import pytest
import rospkg

from node_kit.ros.graph.ros_api import call
from tutorial_testing import flood
from tutorial_testing.claims import claim
from tutorial_testing.cockpit.world import EarlyWorld, World
from tutorial_testing.nodes import node_path
from tutorial_testing.socket_page import DRIVE, SocketPage
from tutorial_testing.waiting import wait_for

# All of them use the same robot.
pytestmark = [pytest.mark.xdist_group("cockpit"), pytest.mark.long]
VIEWERS, FLOOD_S = 30, 8  # the whole minute, and the latency, are in test/cockpit/benchmark
MOST_MORE_KB = 20_000
# Frames of a WebSocket: pings, unrequested pongs, fragments of a message that never ends.
PINGS, PONGS, PIECES = (1000 * (code + b"\x80" + bytes(4)) for code in (b"\x89", b"\x8a", b"\0"))
MOST_BYTES = 30_000_000
# Modules whose import ends a program, opens a browser, or prints.
HOSTILE = ("cockpit/x", "unittest.__main__/x", "antigravity/x", "this/x", "../x", "*")
HALF_OPEN, MOST_PAGES = 300, 64


@contextlib.contextmanager
def page_of(world):
    with SocketPage(world.port, world.token("drive")) as page:
        page.wait_for("drives", lambda message: not message["refusal"])
        yield page


def drive(world, page):
    """Take the session, release all, then hold LB and the stick until the robot moves."""
    world.drive_by(lambda: page.sit_down(then=DRIVE))


@pytest.fixture(scope="module")
def open_world():
    """A cockpit for other machines, and its robot."""
    with World(lan=True) as world:
        yield world
        print(f"the cockpit said:\n{world.cockpit.output}")


@pytest.fixture
def resting(open_world):
    """The open world; afterwards nothing has moved, and the driver may still drive.

    No token has been printed again.
    """
    open_world.odometry.clear()
    yield open_world
    assert not [moment for moment in open_world.odometry if moment.moves]
    with page_of(open_world) as page:
        drive(open_world, page)
        page.say("stop")
        open_world.wait_for_rest()
        assert open_world.stays_at_rest()
    output = open_world.cockpit.output
    assert "Traceback" not in output
    for role in ("drive", "look"):  # printed at the start
        assert output.count(open_world.token(role)) == 1, output


def get(world, path, **headers):
    connection = http.client.HTTPConnection("127.0.0.1", world.port, timeout=20)
    with contextlib.closing(connection):
        connection.request("GET", f"{path}?token={world.token('drive')}", headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode()


@claim(
    "Other hosts, origins, files and tokens are refused; viewers may not drive; long messages "
    "close the connection"
)
def test_foreign_hosts_and_origins_other_files_and_sockets_without_a_token_are_refused(resting):
    assert get(resting, "/")[0] == 200
    for headers in ({"Host": "evil.example"}, {"Origin": "http://evil.example"}):
        status, words = get(resting, "/page/main.js", **headers)
        assert (status, words.count("\n")) == (403, 1), words
    for path in ("/page/../package.xml", "/page/%2e%2e/package.xml", "/x"):
        assert get(resting, path)[0] in (403, 404), path
    driver, port = resting.token("drive"), resting.port
    for token, headers in (
        (None, {}),
        ("wrong", {}),
        (driver, {"Origin": f"http://127.0.0.1:{port + 1}"}),
        (driver, {"Origin": "null"}),
        (driver, {"Host": f"evil.example:{port}", "Origin": f"http://evil.example:{port}"}),
    ):
        with SocketPage(port, token=token, **headers) as page:
            assert page.refusal == 403, (token, headers)


@claim("Other hosts, origins, files ...", because="viewers and long messages")
def test_a_viewer_may_not_drive_and_long_messages_close_the_connection(resting):
    with SocketPage(resting.port, token=resting.token("look")) as page:
        page.say("bag_open", name="joy.bag")
        page.wait_for("bag")
        page.hand = DRIVE
        page.say("drive", robot="", mode="D")
        page.say("reset", robot="")
        page.say("bag_play", topics=["/joy"], rate=1.0, loop=False, robot="")
        page.say("publish", topic="/cmd_vel", type="geometry_msgs/Twist", values={}, period=0.1)
        for what in ("drive", "reset", "bag_play", "publish"):
            why = page.wait_for("refused", lambda no, what=what: no["what"] == what)["why"]
            assert "may only look" in why
        assert not [session for session in page.of("session") if session["yours"]]
    with page_of(resting) as page:
        page.say("release", why="x" * 100_000)
        page.wait_for("closed")


@pytest.fixture
def connect(open_world):
    at = "127.0.0.1", open_world.port
    with contextlib.ExitStack() as stack:
        yield lambda: stack.enter_context(socket.create_connection(at, 20))


def upgraded(world, made):
    """Open a viewer's WebSocket on a socket by hand; return the socket."""
    host, token = f"127.0.0.1:{world.port}", world.token("look")
    made.sendall(
        f"GET /ws?token={token} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n"
        "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n".encode()
    )
    assert b"101" in made.recv(4096).split(b"\r\n")[0]
    return made


def cockpit_kb(world):
    states = [Path(f"/proc/{pid}/status").read_text() for pid in world.cockpit.left_behind()]
    return max(int(re.search(r"VmRSS:\s+(\d+)", state)[1]) for state in states)


@claim("The driver goes ...", because="endless frames")
def test_a_program_that_sends_frames_without_end_costs_no_memory(open_world, connect):
    """The connection is closed, or not read."""
    for frames, begin in ((PINGS, b""), (PONGS, b""), (PIECES, b"\x01\x80" + bytes(4))):
        made, before_kb = upgraded(open_world, connect()), cockpit_kb(open_world)
        made.settimeout(5)
        with pytest.raises(OSError):
            made.sendall(begin)
            for _ in range(MOST_BYTES // len(frames)):
                made.sendall(frames)
        assert cockpit_kb(open_world) - before_kb <= MOST_MORE_KB


@claim(
    "The driver goes on beside thirty viewers that flood; endless frames are held up; all places "
    "taken make room for a driver"
)
def test_the_driver_goes_on_beside_thirty_viewers_that_flood(open_world):
    command = sys.executable, flood.__file__, str(open_world.port), open_world.token("look")
    with page_of(open_world) as page:
        drive(open_world, page)
        number = page.wait_for("hello")["id"]
        before_kb, drives = cockpit_kb(open_world), 0
        with open_world.run(*command, str(VIEWERS), str(FLOOD_S)) as program:
            wait_for(lambda: "ready" in program.output, "flood")
            while not program.ended:
                drive(open_world, page)  # takes the session again, during the flood
                drives += 1
            assert program.wait() == 0, program.output
            assert int(program.output.splitlines()[-1]) > 1000
        assert drives > 0
        # A busy machine may lose the operator for a moment, but no other page ever drives.
        assert {session["driver"] for session in page.of("session")} <= {number, None}
        assert page.of("closed") == []
        wait_for(lambda: cockpit_kb(open_world) - before_kb <= MOST_MORE_KB, "memory as before")


@claim("The driver goes ...", because="all places taken")
def test_viewers_and_connections_make_room_for_a_driver(open_world, connect):
    for _ in range(HALF_OPEN):
        connect().sendall(b"GET / HTTP/1.1\r\n")
    with contextlib.ExitStack() as stack:
        pages = []
        # One more than the limit; an earlier test may have left some open.
        while len(pages) <= MOST_PAGES and not (pages and pages[-1].refusal):
            viewer = SocketPage(open_world.port, token=open_world.token("look"))
            pages.append(stack.enter_context(viewer))
        assert pages[-1].refusal == 503
        with page_of(open_world) as page:
            drive(open_world, page)


@claim("A type that a page, a master ...", because="end to end")
def test_hostile_types_of_a_page_and_of_the_graph_leave_the_server_and_its_driver_alone(open_world):
    ask = functools.partial(call, open_world.environment["ROS_MASTER_URI"], caller="/hostile")
    _, node = ask("lookupNode", "/fake_turtlebot")
    topics = {f"/t{n}": kind for n, kind in enumerate(HOSTILE)}
    for topic, kind in topics.items():
        ask("registerPublisher", topic, kind, node)
    with page_of(open_world) as page, page_of(open_world) as other:
        for kind in HOSTILE:
            other.say("publish", topic="/fz", type=kind, values={}, period=None)
        wait_for(lambda: len(other.of("refused")) == len(HOSTILE), "refusals")
        assert all("no topic of the type" in said["why"] for said in other.of("refused"))
        drive(open_world, page)
        for topic, kind in topics.items():
            other.say("watch", field_list=True, topic=topic, rates=[*topics], fields=[f"{topic}/x"])
            other.say("describe", what="message", name=kind)
        other.wait_for("fields")
        wait_for(lambda: len(other.of("refused")) == 2 * len(HOSTILE), "refusals")
        drive(open_world, page)
        assert not page.of("closed") and not other.of("closed")
        page.say("stop")
        open_world.wait_for_rest()
    for topic in topics:
        ask("unregisterPublisher", topic, node)


@claim("A page says how a node that drives is paused or ended, and may then drive")
def test_a_recording_of_rosbag_is_paused_by_the_page_which_then_drives(open_world):
    bag = rospkg.RosPack().get_path("gamepad") + "/bag/joy.bag"
    command = "rosbag", "play", "--loop", bag, "__name:=rosbag"
    with open_world.run(*command), page_of(open_world) as page:
        page.say("watch", robots=True, look="")
        said = page.wait_for("drives", lambda drives: "pause_playback" in drives["refusal"])
        assert "/rosbag publishes the joystick topic" in said["refusal"]
        page.say("call", service="/rosbag/pause_playback", values={"data": "true"})
        page.wait_for("answer", lambda answer: "success: True" in answer["text"])
        wait_for(lambda: not page.of("drives")[-1]["refusal"], "leave to drive")
        drive(open_world, page)
        page.say("stop")


@claim("A cockpit that waits for a master says so in the browser, and then serves its page")
def test_a_cockpit_before_its_master_says_so_and_then_serves_its_page():
    answers = []
    with EarlyWorld(lambda world: answers.append(get(world, "/"))) as world:
        [(status, text)] = answers
        assert status == 503 and "start roscore" in text
        wait_for(lambda: get(world, "/")[0] == 200, "page")


class Launched(World):
    """A browser in place of the joystick: the launch file starts the cockpit."""

    launch = ("joy2twist", "launch_joy_node.launch", "joystick:=browser", "rviz:=false")

    def begin(self):
        self._arguments = (f"cockpit_port:={self.port}",)
        super().begin()

    def start_cockpit(self):
        self.cockpit = self.launched
        self.find_page()


@claim(
    "launch_joy_node.launch joystick:=browser is driven by the page; a second cockpit leads to the "
    "first; the windows of rqt lead to the page"
)
def test_the_page_of_the_launch_file_drives_and_other_cockpits_and_windows_lead_there():
    with Launched() as world, socket.create_server(("127.0.0.1", 0)) as taken:
        with page_of(world) as page:
            drive(world, page)
        world.wait_for_rest(time.time())
        with world.run("rosnode", "list") as nodes:
            assert nodes.wait() == 0 and "/joy_node" not in nodes.output
        other, ours = taken.getsockname()[1], world.port  # by another program
        for port, options, code, line in (
            (ours, (), 0, f"a cockpit is already running: open {world.address} on this machine"),
            (ours, ("--lan",), 1, f"a cockpit is already running at {world.address}; for other "
             f"machines end[^\n]* or take --port {ours + 1}"),
            (other, (), 1, f"port {other} is taken[^\n]*"),
        ):  # fmt: skip
            command = node_path("cockpit", "cockpit.py"), "--port", str(port), *options
            with world.run(*command, "__name:=another") as second:
                assert second.wait() == code
                assert re.fullmatch(f"cockpit: {line}\n", second.output), second.output
        plot = ("rqt_plot", "rqt_plot", "/odom/pose/pose/position/x:y")
        place = "plot?f=/odom/pose/pose/position/x&f=/odom/pose/pose/position/y"
        for command, at in ((("rqt_graph",) * 2, "Graph"), (plot, place)):
            with world.run("rosrun", *command) as window:
                assert window.wait() == 0
                assert window.output == f"{command[0]}: see {world.address}#{at}\n"
