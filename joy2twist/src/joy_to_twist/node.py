"""The ROS node: joy (sensor_msgs/Joy) in, cmd_vel (geometry_msgs/Twist) out."""

import sys
import threading

import rosgraph
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

# A zero is on its way to every subscriber well within this time [s]; exiting at once loses it.
DELIVERY_TIME_S = 0.1


class NewJoy2Twist:
    """Publishes one velocity for every joy message, and zero when the node is stopped.

    Subscribes: joy (sensor_msgs/Joy). Publishes: cmd_vel (geometry_msgs/Twist).
    """

    def __init__(self):
        # Not anonymous: a second node of this name shuts down the first, so that only one drives.
        rospy.init_node("NewJoy2Twist", anonymous=False)
        rospy.on_shutdown(self.shutdown)
        self.cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        rospy.Subscriber("joy", Joy, self.callback)

    def callback(self, joy):
        """Publish the velocity first, because displaying takes longer; then display the axes."""
        twist = Twist()  # all zero, and so it stays when the joystick has too few axes
        if len(joy.axes) >= 2:
            twist.linear.x = joy.axes[1]  # stick forward: m/s
            twist.angular.z = joy.axes[0]  # stick left: rad/s
        self.cmd_vel.publish(twist)
        axes = ", ".join(f"{value:.2f}" for value in joy.axes)
        rospy.loginfo("%s: Get from Joy [%s]", rospy.get_name(), axes)

    def shutdown(self):
        """Leave the robot standing: zero velocity, and the time to deliver it."""
        rospy.loginfo("Stopping the node ...")
        self.cmd_vel.publish(Twist())
        # Not rospy.sleep: in simulated time without a clock it never returns.
        threading.Event().wait(DELIVERY_TIME_S)


def main():
    """Run the node until it is stopped; exit code 1 and one line if it cannot start."""
    if not rosgraph.is_master_online():
        sys.exit(f"No ROS master at {rosgraph.get_master_uri()}: start roscore first.")
    NewJoy2Twist()
    rospy.spin()
