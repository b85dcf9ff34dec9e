"""A robot as its odometry shows it, which every test of motion observes and drives.

As a program it prints the odometry of its master's robot, for a test on another host.
"""

import contextlib
import os
import subprocess
import threading
from math import atan2
from typing import NamedTuple

import rospy
from nav_msgs.msg import Odometry

from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Started
from tutorial_testing.waiting import DEADLINE_S, wait_for

PERIOD_S = 0.02  # odometry
RESTING = 50  # odometry messages, a second of them, in which nothing moves
TRY_S = 5.0  # until the robot moves, before all is released and held again
OBSERVER = ("/usr/bin/python3", "-m", __name__)


class Moment(NamedTuple):
    """An odometry message: its stamp [s], v [m/s], w [rad/s]; x, y [m], yaw [rad] in its frame."""

    stamp: float
    v: float
    w: float
    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0

    @classmethod
    def of(cls, message):
        twist, place = message.twist.twist, message.pose.pose.position
        turned = message.pose.pose.orientation
        yaw = 2 * atan2(turned.z, turned.w)
        stamp = message.header.stamp.to_sec()
        return cls(stamp, twist.linear.x, twist.angular.z, place.x, place.y, yaw)

    @property
    def velocity(self):
        return self.v, self.w

    @property
    def pose(self):
        return self.x, self.y, self.yaw

    @property
    def moves(self):
        return any(self.velocity)


class Robot(Started):
    """A robot, and the programs that a test starts to observe it, which end with the context."""

    odometry_topic = "odom"

    def __init__(self, namespace=""):
        """namespace: of its topics, with a slash at the end."""
        super().__init__()
        self.namespace = namespace
        self.odometry = []  # all Moments so far

    def begin(self):
        self.listen()

    def listen(self):
        """Subscribe to the odometry in this process."""
        hear = lambda message: self.odometry.append(Moment.of(message))  # noqa: E731
        topic = f"{self.namespace}{self.odometry_topic}"
        subscriber = rospy.Subscriber(topic, Odometry, hear, queue_size=1000, tcp_nodelay=True)
        self._stack.callback(subscriber.unregister)

    def observe(self, command, **environment):
        """Receive the odometry of another master or host, where a command starts OBSERVER."""
        environment = {**os.environ, **environment}
        observer = subprocess.Popen(command, stdout=subprocess.PIPE, env=environment, text=True)
        self._stack.enter_context(observer)
        self._stack.callback(observer.terminate)

        def read():
            with contextlib.suppress(ValueError):  # closed at the end
                for line in observer.stdout:
                    self.odometry.append(Moment(*map(float, line.split())))

        threading.Thread(target=read, daemon=True).start()
        wait_for(lambda: self.odometry, "odometry")

    @property
    def now(self):
        return self.odometry[-1]

    @property
    def moves(self):
        return bool(self.odometry) and self.now.moves

    def since(self, stamp):
        return [moment for moment in list(self.odometry) if moment.stamp > stamp]

    def first(self, condition, what):
        """Wait for an odometry message for which condition(Moment) holds; return the first one."""
        return wait_for(lambda: next(filter(condition, list(self.odometry)), None), what)

    def wait_for_rest(self, after=None):
        """Wait for odometry at rest after a time [s], by default that of the newest message.

        Return the stamp [s] of the first message at rest.
        """
        if after is None:
            after = self.now.stamp if self.odometry else 0.0

        def at_rest():
            moments = list(self.odometry)
            return moments and moments[-1].stamp > after and not moments[-1].moves and moments

        moments = wait_for(at_rest, "robot at rest")
        last = max((i for i, moment in enumerate(moments) if moment.moves), default=-1)
        return moments[last + 1].stamp

    def more(self, count=RESTING):
        """Wait for the next odometry messages, by default a second of them; return them."""
        begin = len(self.odometry)
        wait_for(lambda: len(self.odometry) >= begin + count, "odometry")
        return self.odometry[begin:]

    def stays_at_rest(self):
        """Return whether nothing moves in the next second of odometry."""
        return not any(moment.moves for moment in self.more())

    def drive_by(self, hold, until=None, try_s=TRY_S, deadline_s=DEADLINE_S):
        """Call hold(), which releases all first, until the robot moves, or until a condition().

        On a busy machine this may take several attempts. Return what the last hold() returned, or
        True; hold() returns False if it could not hold.
        """

        def once():
            held = hold()
            if held is False:
                return False
            with contextlib.suppress(AssertionError):
                wait_for(until or (lambda: self.moves), "effect", try_s)
                return held or True

        return wait_for(once, "robot that drives", deadline_s)


def main():
    init_node("observer", disable_rosout=True)
    show = lambda message: print(*Moment.of(message), flush=True)  # noqa: E731
    rospy.Subscriber("odom", Odometry, show, queue_size=100, tcp_nodelay=True)
    rospy.spin()


if __name__ == "__main__":
    main()
