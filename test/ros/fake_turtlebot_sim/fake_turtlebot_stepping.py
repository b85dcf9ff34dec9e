"""A simulated robot whose time goes on step by step: the node under test answers every step.

The test is the source of /clock, so nothing here depends on how fast the machine is: a step is
over when the odometry with its stamp has come.
"""

import rospy
from geometry_msgs.msg import Twist, Vector3
from rosgraph_msgs.msg import Clock

from tutorial_testing.robot import Robot
from tutorial_testing.waiting import wait_for

PERIOD_NS = 20_000_000


class SteppedRobot(Robot):
    """What the robot is told, velocities and the time, and what it answers."""

    now_ns = 100 * 10**9

    def begin(self):
        self.cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=10)
        self._stack.callback(self.cmd_vel.unregister)
        self._clock = rospy.Publisher("/clock", Clock, queue_size=10)
        self.listen()
        wait_for(self.cmd_vel.get_num_connections, "subscriber")
        # Nobody tells when the robot hears /clock and is heard: time goes on until then.
        wait_for(lambda: self.tell(self.now_ns + PERIOD_NS) or self.odometry, "first odometry")
        self.step()

    def tell(self, now_ns):
        """Publish the time; nobody need answer."""
        self.now_ns = now_ns
        self._clock.publish(Clock(rospy.Time(0, now_ns)))

    def set_clock(self, now_ns):
        """Set the clock, forwards or backwards, and wait until the robot has answered."""
        self.tell(now_ns)
        stamp = rospy.Time(0, now_ns).to_sec()
        wait_for(lambda: self.now.stamp == stamp, f"odometry with the stamp {stamp:.3f}")

    def step(self, seconds=0.02):
        """Let time go on in periods of 50 Hz."""
        for _ in range(round(seconds * 1e9 / PERIOD_NS)):
            self.set_clock(self.now_ns + PERIOD_NS)

    def command(self, v, w, shown=None):
        """Send a velocity and step until the odometry shows it."""
        self.cmd_vel.publish(Twist(Vector3(x=v), Vector3(z=w)))

        def shows():
            self.step()
            error = [abs(a - b) for a, b in zip(self.now.velocity, shown or (v, w))]
            return max(error) < 1e-9

        wait_for(shows, f"odometry with the velocity {shown or (v, w)}")
