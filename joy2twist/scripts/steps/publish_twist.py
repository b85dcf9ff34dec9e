#!/usr/bin/python3
"""Step 2: turn every joy message into a velocity, published from the callback.

Axis 1 (stick forward) drives linear.x [m/s], axis 0 (stick left) drives angular.z [rad/s].
"""

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy


def callback(joy, publisher):
    """Publish the velocity first, because displaying takes longer; then display the axes."""
    twist = Twist()  # all zero, and so it stays when the joystick has too few axes
    if len(joy.axes) >= 2:
        twist.linear.x = joy.axes[1]
        twist.angular.z = joy.axes[0]
    publisher.publish(twist)

    axes = ", ".join(f"{value:.2f}" for value in joy.axes)
    rospy.loginfo("%s: Get from Joy [%s]", rospy.get_name(), axes)


def converter():
    """Hand every joy message to callback() until the node is stopped."""
    rospy.init_node("converter", anonymous=True)
    # The publisher comes first: a joy message may arrive as soon as there is a subscriber.
    publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
    rospy.Subscriber("joy", Joy, callback, callback_args=publisher)
    rospy.spin()


if __name__ == "__main__":
    converter()
