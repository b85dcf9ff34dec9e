"""A simulated world whose time goes on step by step: the node under test answers every step.

The test is the source of /clock, so nothing here depends on how fast the machine is: a step is
over when the odometry with its stamp has come.
"""

import rospy
from geometry_msgs.msg import Twist
from rosgraph_msgs.msg import Clock

from tutorial_testing.robot import Robot
from tutorial_testing.waiting import wait_for

PERIOD_NS = 20_000_000


class CommandedRobot(Robot):
    """What one robot is told and what it answers."""

    def begin(self):
        self.cmd_vel = rospy.Publisher(f"{self.namespace}cmd_vel", Twist, queue_size=10)
        self._stack.callback(self.cmd_vel.unregister)
        self.listen()


class World:
    """The clock, and the robots that live by it."""

    def __init__(self, robots, start_ns=PERIOD_NS):
        self._clock = rospy.Publisher("/clock", Clock, queue_size=10)
        self.robots = robots
        self.now_ns = start_ns
        wait_for(lambda: all(r.cmd_vel.get_num_connections() for r in robots), "subscriber")
        wait_for(self._begin, "odometry after the first clock")
        self.step()

    def _begin(self):
        # Nobody tells when the robots hear /clock and are heard: time goes on until they are.
        self.now_ns += PERIOD_NS
        self.tell()
        return all(robot.odometry for robot in self.robots)

    def tell(self):
        """Publish the time; nobody need answer."""
        self._clock.publish(Clock(rospy.Time(0, self.now_ns)))

    def set_clock(self, now_ns):
        """Set the clock, forwards or backwards, and wait until every robot has answered."""
        self.now_ns = now_ns
        self.tell()
        stamp = rospy.Time(0, now_ns).to_sec()
        all_answer = lambda: all(robot.now.stamp == stamp for robot in self.robots)  # noqa: E731
        wait_for(all_answer, f"odometry with the stamp {stamp:.3f}")

    def step(self, seconds=0.02):
        """Let time go on in periods of 50 Hz."""
        for _ in range(round(seconds * 1e9 / PERIOD_NS)):
            self.set_clock(self.now_ns + PERIOD_NS)

    def command(self, robot, v, w, shown=None):
        """Send a velocity and step until the odometry shows it."""
        robot.cmd_vel.publish(twist(v, w))

        def shows():
            self.step()
            error = [abs(a - b) for a, b in zip(robot.now.velocity, shown or (v, w))]
            return max(error) < 1e-9

        wait_for(shows, f"odometry with the velocity {shown or (v, w)}")


def twist(v, w):
    message = Twist()
    message.linear.x, message.angular.z = v, w
    return message
