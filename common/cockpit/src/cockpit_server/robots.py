"""The robots: where they are, by their odometry, and what moves them, by their joystick."""

import time
from math import hypot, isfinite

import rospy
from sensor_msgs.msg import Joy

from cockpit_server.clients import Source, encoded
from cockpit_server.lean_odometry import LeanOdometry
from cockpit_server.subscriptions import Subscriptions
from node_kit.careful_connections import sender_of

PERIOD_S = 0.05
LONGEST_STEP_M = 0.5  # within a period; what is more was carried, or reset
DIGITS = 4  # of metres: a tenth of a millimetre


def topic_of(robot, name):
    """The topic of a robot, "" is the one without a name."""
    return f"/{robot}/{name}" if robot else f"/{name}"


class Robots(Source):
    """The newest odometry of each robot, for all pages that show it."""

    def __init__(self, graph_watch):
        """graph_watch: knows the robots. Nothing is subscribed to before somebody looks."""
        self._graphs = graph_watch
        self._subscriptions = Subscriptions(self._subscribe)
        self._states = {}  # robot -> (odometry, when it came [s], distance covered [m])
        self._text = ""

    def prepare(self, clients, now):
        """Gather what is sent to all that watch."""
        watched = any(client.watch.robots for client in clients)
        known = self._graphs.graph.robots_with_odometry() if watched else ()
        self._subscriptions.want(known)
        if watched:
            robots = {
                name: shown(*state, now) for name, state in self._states.items() if name in known
            }
            self._text = encoded("robots", stamp=round(time.time(), 3), robots=robots)

    def give(self, client, _now):
        """Send the newest state."""
        if client.watch.robots:
            client.write(self._text)

    def _subscribe(self, robot):
        self._states.pop(robot, None)
        # Its callback sleeps, so that rospy reads only so often: the kernel keeps what comes
        # meanwhile, of which rospy looks at the newest. Thirty robots at 50 Hz would be too many.
        return rospy.Subscriber(
            topic_of(robot, "odom"), LeanOdometry, self._hear, callback_args=robot, queue_size=1
        )

    def _hear(self, odometry, robot):
        last, _, covered = self._states.get(robot) or (odometry, 0.0, 0.0)
        step = hypot(odometry.x - last.x, odometry.y - last.y)
        covered += step if step < LONGEST_STEP_M else 0.0
        self._states[robot] = (odometry, time.monotonic(), covered)
        time.sleep(PERIOD_S)


def shown(odometry, came, covered, now):
    """A robot's state as pages get it."""
    values = {name: getattr(odometry, name) for name in ("x", "y", "yaw", "v", "w")}
    values.update(covered=covered, age=max(0.0, now - came))
    return {name: round(value, DIGITS) for name, value in values.items() if isfinite(value)}


class Pads(Source):
    """The newest joystick message of each robot that somebody looks at or drives."""

    def __init__(self, own_name):
        """own_name: of this node. Others that send on the same topic are told by rival()."""
        self._own_name = own_name
        self._subscriptions = Subscriptions(self._subscribe)
        self._newest = {}  # robot -> (message, when it came [s])
        self.driven = None  # the robot that is driven from a page, too
        self._rivals = {}  # robot -> (name of the node, when it last spoke [s])

    def prepare(self, clients, _now):
        """Subscribe to what is looked at now."""
        looked_at = {client.watch.look for client in clients} | {self.driven}
        self._subscriptions.want(looked_at - {None})

    def give(self, client, now):
        """Send what is new of the one it looks at."""
        robot = client.watch.look
        newest = self._newest.get(robot)
        if newest and client.lacks("pad", (robot, newest[1])):
            joy, came = newest
            axes = [round(value, DIGITS) if isfinite(value) else 0.0 for value in joy.axes]
            age = round(now - came, 3)
            client.send("pad", robot=robot, axes=axes, buttons=list(joy.buttons), age=age)

    def rival(self, robot, since):
        """The name of another node that has sent on the robot's topic since a time [s], or None."""
        name, spoke = self._rivals.get(robot, ("", 0.0))
        return name if spoke >= since and name else None

    def _subscribe(self, robot):
        self._newest.pop(robot, None)
        return rospy.Subscriber(topic_of(robot, "joy"), Joy, self._hear, robot, queue_size=1)

    def _hear(self, joy, robot):
        now = time.monotonic()
        self._newest[robot] = (joy, now)
        sender = sender_of(joy)
        if sender != self._own_name:
            self._rivals[robot] = (sender, now)
