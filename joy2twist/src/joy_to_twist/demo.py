"""Starts launch_bag.launch after a look at what it is given; on demand for a while only.

The look finds what roslaunch would report badly or not at all: an argument that does not exist, a
bag that cannot be played, a port taken by another program.
"""

import argparse
import math
import os
import signal
import subprocess
import sys
import time
import xmlrpc.client
from pathlib import Path

import rosbag
import rosgraph
import roslaunch
import roslaunch.arg_dump
import rospkg
import rospy
from nav_msgs.msg import Odometry
from rospy import AnyMsg

from joy_to_twist.drive_report import DriveReport

MASTER_TIMEOUT_S = 3.0  # a master on this machine answers within milliseconds
START_TIMEOUT_S = 60.0  # until the first odometry, on a slow and busy machine
END_TIMEOUT_S = 20.0  # roslaunch itself ends stubborn nodes after 15 s


class DemoError(Exception):
    """What keeps the demonstration from starting or from driving, in one line for the user."""


def duration(text):
    """A time in seconds; the type of --for. Raises what argparse tells the user."""
    try:
        seconds = float(text)
    except ValueError:
        seconds = math.nan
    if not 0 < seconds < math.inf:
        raise argparse.ArgumentTypeError(f"{text}: not a time in seconds above 0, such as 20")
    return seconds


def parse(argv):
    """The command line: how long to drive (None: until stopped) and NAME:=VALUE arguments."""
    parser = argparse.ArgumentParser(
        prog="demo", description="Drives the simulated TurtleBot with the recorded joystick."
    )
    parser.add_argument(
        "--for", dest="duration_s", type=duration, metavar="SECONDS",
        help="end by itself, with one line that tells the drive; exit code 0 if the robot moved",
    )  # fmt: skip
    parser.add_argument("arguments", nargs="*", metavar="NAME:=VALUE", help="for launch_bag.launch")
    return parser.parse_args(argv)


def check_arguments(launch_file, arguments):
    """Return the launch arguments as a dict, the defaults included.

    Raises DemoError for one that is not NAME:=VALUE, is unknown, or has a value that does not do.
    """
    known = roslaunch.arg_dump.get_args([launch_file])
    values = {name: default for name, (_, default) in known.items()}
    for argument in arguments:
        name, assigned, value = argument.partition(":=")
        if not assigned or name not in known:
            names = ", ".join(f"{name}:=" for name in sorted(known))
            raise DemoError(f"{argument}: not an argument of launch_bag.launch, which has {names}")
        values[name] = value
    try:
        roslaunch.config.load_config_default([(launch_file, arguments)], None, verbose=False)
    except (roslaunch.RLException, rospkg.ResourceNotFound, ValueError) as error:
        raise DemoError(f"{' '.join(arguments)}: {str(error).splitlines()[0]}") from error
    return values


def check_bag(path):
    """Raises DemoError unless the file is a bag that can be played and holds joystick messages."""
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
    """Raises DemoError if another program answers where the ROS master is expected."""
    uri = rosgraph.get_master_uri()
    try:
        host, port = rosgraph.network.parse_http_host_and_port(uri)
    except ValueError as error:
        raise DemoError(f"ROS_MASTER_URI={uri}: not of the form http://HOST:PORT") from error
    try:
        with rosgraph.network.socket.create_connection((host, port), MASTER_TIMEOUT_S):
            pass
    except OSError:
        return  # nothing there: roslaunch starts a master, or says that the host is not this one
    if not master_answers(uri):
        raise DemoError(
            f"port {port} of {host} is taken by a program that is not a ROS master; "
            f"end it, or choose another port: export ROS_MASTER_URI=http://{host}:{port + 1}"
        )


def master_answers(uri):
    """Whether a ROS master answers at a URI, within MASTER_TIMEOUT_S."""

    class Transport(xmlrpc.client.Transport):
        def make_connection(self, host):
            connection = super().make_connection(host)
            connection.timeout = MASTER_TIMEOUT_S
            return connection

    try:
        code, _, _ = xmlrpc.client.ServerProxy(uri, transport=Transport()).getPid("/demo")
    except Exception:  # whatever it answered, a master does not answer so
        return False
    return code == 1


def wait(launch, until, happened=lambda: False):
    """Wait for something to happen, or until a time [s] of the monotonic clock.

    Raises DemoError if the launch ends meanwhile.
    """
    while time.monotonic() < until and not happened():
        if launch.poll() is not None:
            raise DemoError("the launch ended by itself; its messages above say why")
        time.sleep(0.02)


def drive(command, duration_s):
    """Run a launch command for a time; return its DriveReport.

    Raises DemoError if it ends by itself, or shows no odometry within START_TIMEOUT_S.
    """
    report = DriveReport(("/joy", "/cmd_vel", "/odom"))

    def on_odometry(message):
        pose = message.pose.pose
        report.count("/odom")
        report.add_pose(pose.position.x, pose.position.y, pose.orientation.z, pose.orientation.w)

    launch = subprocess.Popen(command)
    try:
        deadline = time.monotonic() + START_TIMEOUT_S
        wait(launch, deadline, rosgraph.is_master_online)
        rospy.init_node("demo", anonymous=True, disable_signals=True, log_level=rospy.ERROR)
        rospy.Subscriber("/odom", Odometry, on_odometry)
        for topic in ("/joy", "/cmd_vel"):
            rospy.Subscriber(topic, AnyMsg, lambda _, topic=topic: report.count(topic))
        wait(launch, deadline, lambda: report.pose is not None)
        if report.pose is None:
            raise DemoError(f"no /odom within {START_TIMEOUT_S:.0f} s")
        print(f"demo: first /odom after {age_of_this_process():.1f} s", flush=True)
        wait(launch, time.monotonic() + duration_s)
    finally:
        stop(launch)
        rospy.signal_shutdown("the demonstration is over")
    return report


def age_of_this_process():
    """How long ago [s] the user's command began; ./tutorial becomes this process by exec."""
    with open("/proc/self/stat") as stat, open("/proc/uptime") as uptime:
        started = int(stat.read().rsplit(")", 1)[1].split()[19])  # proc(5): starttime [ticks]
        return float(uptime.read().split()[0]) - started / os.sysconf("SC_CLK_TCK")


def stop(launch):
    """End a launch as Ctrl-C does, and wait until it is gone."""
    if launch.poll() is None:
        launch.send_signal(signal.SIGINT)
    try:
        launch.wait(END_TIMEOUT_S)
    except subprocess.TimeoutExpired:
        launch.kill()
        launch.wait()


def main():
    """Check, then launch; exit code 0 if it ran and, with --for, if the robot moved."""
    for number in (signal.SIGINT, signal.SIGTERM):  # either ends the launch with this process
        signal.signal(number, signal.default_int_handler)
    options = parse(sys.argv[1:])
    try:
        launch_file = f"{rospkg.RosPack().get_path('joy2twist')}/launch/launch_bag.launch"
        values = check_arguments(launch_file, options.arguments)
        # rosbag plays in a folder of its own, so a relative path would not be found there.
        bag = Path(values["bag"]).expanduser().absolute()
        check_bag(bag)
        check_master()
        command = ["roslaunch", launch_file, *options.arguments, f"bag:={bag}"]
        if options.duration_s is None:
            os.execvp(command[0], command)
        report = drive(command, options.duration_s)
    except DemoError as error:
        sys.exit(f"demo: {error}")
    except KeyboardInterrupt:
        sys.exit(130)
    print(f"demo: {report.line(options.duration_s)}")
    sys.exit(not report.moved)
