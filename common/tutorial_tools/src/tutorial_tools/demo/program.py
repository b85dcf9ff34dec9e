"""The command demo: checks, then starts launch_bag.launch, and reports what was driven.

The checks find what roslaunch reports badly or not at all: unknown arguments, a bag that cannot be
played, a port taken by another program, and nodes that run already.
"""

import math
import os
import re
import signal
import socket
import sys
import time

import rosbag
import rosgraph
import rospkg

from node_kit.questions import Answer, address, call, holder
from tutorial_tools.command.words import parser_of
from tutorial_tools.demo.in_the_way import in_the_way, refusal
from tutorial_tools.demo.launch import ENDING, TOPICS, DemoError, Launch
from tutorial_tools.launch_arguments import launch_arguments

# What launch_bag.launch starts. Not by loading that file here: it looks itself for what runs.
NODES = ("/fake_turtlebot", "/myjoystick2twist", "/robot_state_publisher", "/rosbag")
RVIZ_NODE = "/my_rviz"
PAGE_TIMEOUT_S = 5.0  # tornado and rospy load on a slow and busy machine, too
CONNECT_TIMEOUT_S = 3.0  # a master on this machine answers within milliseconds
RVIZ = re.compile("rviz:=")  # given by the user, so no hint is needed
WITHOUT_SCREEN = "there is no screen (DISPLAY is not set), so RViz is left out; to see it drive, "
IN_TERMINAL = "in another terminal: ./tutorial run rostopic echo /odom/pose/pose/position"
IN_BROWSER = "open {page} in a browser; from another machine: ssh -L {port}:127.0.0.1:{port} {host}"


def check_bag(path):
    """Raise DemoError unless the file is a bag that can be played and holds joystick messages."""
    try:
        with rosbag.Bag(str(path)) as bag:
            count = bag.get_message_count("/joy")
    except OSError as error:
        raise DemoError(f"{path}: cannot be read: {error.strerror}") from error
    except rosbag.ROSBagUnindexedException as error:
        raise DemoError(f"{path}: cut short; mend it with: rosbag reindex {path}") from error
    except Exception as error:  # rosbag lets struct.error and more through from a damaged file
        raise DemoError(f"{path}: not a bag that can be played: {error}") from error
    if not count:
        raise DemoError(f"{path}: holds no message on /joy")


def check_master():
    """Raise DemoError if another program answers where the ROS master is expected."""
    uri = rosgraph.get_master_uri()
    try:
        host, port = rosgraph.network.parse_http_host_and_port(uri)
    except ValueError as error:
        raise DemoError(f"ROS_MASTER_URI={uri}: not of the form http://HOST:PORT") from error
    try:
        with socket.create_connection((host, port), CONNECT_TIMEOUT_S):
            pass
    except OSError:
        return  # nothing there: roslaunch starts a master, or says that the host is not this one
    if call(uri, "getPid")[0] is not Answer.WELL:
        raise DemoError(
            f"port {port} of {host} is taken by a program that is not a ROS master; "
            f"end it, or choose another port: export ROS_MASTER_URI={free_uri(port)}"
        )


def check_nodes(nodes):
    """Raise DemoError if nodes run that the launch would end, or that send on its topics.

    Those that have died are no hindrance, although the master still knows them.
    """
    uri = rosgraph.get_master_uri()
    _, state = call(uri, "getSystemState")
    names = in_the_way(state, nodes, TOPICS) if state else []  # nothing: there is no master yet
    names = [name for name in names if holder(uri, name)]
    if names:
        _, port = rosgraph.network.parse_http_host_and_port(uri)
        raise DemoError(refusal(uri, names, free_uri(port)))


def free_uri(taken):
    """A ROS_MASTER_URI of this machine at the next port after one that is taken."""
    for port in range(taken + 1, 65536):
        try:
            with socket.create_server(("localhost", port)):
                return f"http://localhost:{port}"
        except OSError:
            continue
    return "http://localhost:PORT"


def claim_master():
    """A socket that no other demonstration of this machine and this master has while it is open.

    Two that start at once see nothing of each other's nodes yet. The kernel forgets the name, which
    is of no file, with the process. Raises DemoError.
    """
    claim = socket.socket(socket.AF_UNIX)
    uri = rosgraph.get_master_uri()
    try:
        claim.bind(f"\0ros1_tutorial demo {uri}"[:100])
    except OSError as error:
        _, port = rosgraph.network.parse_http_host_and_port(uri)
        raise DemoError(refusal(uri, ["another demo"], free_uri(port))) from error
    return claim


def where_to_look(values):
    """Where a robot is seen without a screen. values: of the arguments of launch_bag.launch."""
    if not wait_for_page(values):
        return IN_TERMINAL
    port, published = values["cockpit_port"], os.environ.get("COCKPIT_PUBLISHED")
    if published:  # the port at which a container's page is found
        return f"open http://localhost:{published}/ in a browser on the container's host"
    return IN_BROWSER.format(page=f"http://127.0.0.1:{port}/", port=port, host=socket.gethostname())


def wait_for_page(values):
    """Whether the cockpit serves its page, which takes a moment where it is wanted."""
    if values["cockpit"].lower() in ("false", "0"):
        return False
    end = time.monotonic() + PAGE_TIMEOUT_S
    while time.monotonic() < end:
        if address(rosgraph.get_master_uri()):
            return True
        time.sleep(0.1)
    return False


def age_of_this_process():
    """How long ago [s] the user's command began; ./tutorial becomes this process by exec."""
    with open("/proc/self/stat") as stat, open("/proc/uptime") as uptime:
        started = int(stat.read().rsplit(")", 1)[1].split()[19])  # proc(5): starttime [ticks]
        return float(uptime.read().split()[0]) - started / os.sysconf("SC_CLK_TCK")


def main():
    """Check, then launch; exit code 0 if it ran and, with --for, if the robot moved."""
    for number in ENDING:
        signal.signal(number, signal.default_int_handler)
    options = parser_of("demo").parse_args()
    launch, interrupted = None, False
    try:
        launch_file = f"{rospkg.RosPack().get_path('joy2twist')}/launch/launch_bag.launch"
        values = launch_arguments(launch_file, options.arguments)
        check_bag(values["bag"])
        arguments = [*options.arguments, f"bag:={values['bag']}"]
        with_rviz = values["rviz"].lower() in ("true", "1")
        nodes = [*NODES, RVIZ_NODE] if with_rviz else NODES
        check_master()
        check_nodes(nodes)
        command = ["roslaunch", launch_file, *arguments]
        with claim_master(), Launch(command, nodes) as launch:
            launch.wait_for_odometry()
            print(f"demo: first /odom after {age_of_this_process():.1f} s", flush=True)
            if not with_rviz and not any(map(RVIZ.match, options.arguments)):
                print(f"demo: {WITHOUT_SCREEN}{where_to_look(values)}", flush=True)
            launch.watch(math.inf if options.duration_s is None else options.duration_s)
    except (DemoError, ValueError) as error:
        sys.exit(f"demo: {error}")
    except KeyboardInterrupt:
        interrupted = True
    if launch and launch.summary:
        print(f"demo: {launch.summary}")
    if interrupted:
        sys.exit(130 if options.duration_s else 0)  # without a time, this is how it ends
    sys.exit(not launch.report.moved)
