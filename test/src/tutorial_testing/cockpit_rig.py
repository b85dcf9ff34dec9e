"""The cockpit as a program, and the robot that it drives as seen by /odom and /joy."""

import time
import unittest

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from cockpit_server.seat import is_neutral
from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program
from tutorial_testing.socket_page import DRIVE, REST, SocketPage
from tutorial_testing.waiting import wait_for

RESTING_S = 0.7  # for which nothing moves; a velocity that comes late would be seen
ODOM_PERIOD_S = 0.02


class CockpitRig:
    """A context manager that ends all that it started. The robot and joy2twist run already."""

    def __init__(self, *options, robot=""):
        self.port = free_port()
        self._options = options
        self.robot = robot
        self.speeds = []  # (stamp [s], speed) of every odometry
        self.joys = []  # (when it came [s], axes, buttons)
        self.program = None

    def __enter__(self):
        prefix = f"/{self.robot}" if self.robot else ""
        self._subscribers = [
            rospy.Subscriber(f"{prefix}/odom", Odometry, self._on_odometry, queue_size=1000),
            rospy.Subscriber(f"{prefix}/joy", Joy, self._on_joy, queue_size=1000),
        ]
        try:
            self.start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        print(f"the cockpit said:\n{self.program.output}")
        self.program.__exit__()
        for subscriber in self._subscribers:
            subscriber.unregister()

    def start(self):
        if self.program:
            self.program.__exit__()
        options = ("--port", str(self.port), *self._options)
        self.program = Program(node_path("cockpit", "cockpit.py"), *options)
        self.program.__enter__()
        wait_for(self.listens, "page of the cockpit")

    def listens(self):
        """Whether the page can be opened, and the cockpit knows the robot."""
        if self.program.ended:
            raise AssertionError(f"the cockpit ended: {self.program.output}")
        try:
            with SocketPage(self.port, token=self.token("drive")) as page:
                return not page.refusal and self.robot in page.wait_for("hello")["robots"]
        except OSError:
            return False

    def token(self, role):
        """The token to "look" or to "drive", as it was printed; None without --lan."""
        for line in self.program.output.splitlines():
            if f"to {role}:" in line and "token=" in line:
                return line.split("token=")[1].strip()
        return None

    def page(self, **more):
        return SocketPage(self.port, token=self.token("drive"), **more)

    def _on_odometry(self, odometry):
        twist = odometry.twist.twist
        self.speeds.append((odometry.header.stamp.to_sec(), abs(twist.linear.x)))

    def _on_joy(self, joy):
        self.joys.append((time.time(), joy.axes, joy.buttons))

    @property
    def moves(self):
        return bool(self.speeds) and self.speeds[-1][1] > 0.0

    def drive(self, page):
        """Sit down, release, hold LB and the stick until the robot moves."""

        def once():
            page.sit_down(self.robot)
            page.hand = DRIVE
            end = time.monotonic() + 3.0
            while time.monotonic() < end and not self.moves:
                time.sleep(0.01)
            return self.moves

        wait_for(once, "robot that drives")

    def rest_after(self, when):
        """How long after a time [s since 1970] the robot stood, and stands since [s]."""
        wait_for(lambda: not self.moves and self.speeds[-1][0] > when, "robot at rest")
        moved = [stamp for stamp, speed in list(self.speeds) if speed > 0.0]
        return max(moved) - when + ODOM_PERIOD_S

    def stays_at_rest(self):
        begin = self.speeds[-1][0]
        wait_for(lambda: self.speeds[-1][0] > begin + RESTING_S, "odometry")
        return not any(speed for stamp, speed in list(self.speeds) if stamp > begin)

    def drives_only_once_released(self, page):
        """Whether a held stick is not obeyed, and one that was released before is."""
        page.hand = DRIVE
        if not self.stays_at_rest():
            return False
        page.hand = REST
        wait_for(lambda: self.joys and is_neutral(*self.joys[-1][1:]), "released joystick")
        self.drive(page)
        return True


class WithCockpit(unittest.TestCase):
    options = ()  # of the cockpit

    @classmethod
    def setUpClass(cls):
        cls.rig = CockpitRig(*cls.options)
        cls.rig.__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.rig.__exit__()
