#!/usr/bin/python3
"""Step 3: the same as a class, which leaves the robot standing when it is stopped."""

import time

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy


class NewJoy2Twist:
    """Turns every joy message into a velocity: axis 1 into linear.x, axis 0 into angular.z."""

    def __init__(self):
        # Not anonymous: a second one ends the first, so that only one drives.
        rospy.init_node("NewJoy2Twist")
        self.stopping = False
        self.cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        self.joy = rospy.Subscriber("joy", Joy, self.callback)
        rospy.on_shutdown(self.shutdown)  # last: shutdown() uses what is made above

    def callback(self, joy):
        if self.stopping:
            return
        twist = Twist()
        if len(joy.axes) >= 2:
            twist.linear.x = joy.axes[1]
            twist.angular.z = joy.axes[0]
        self.cmd_vel.publish(twist)
        rospy.loginfo("%s: Get from Joy %s", rospy.get_name(), [round(v, 2) for v in joy.axes])

    def shutdown(self):
        rospy.loginfo("Stopping the node ...")
        # Unsubscribe first. The handout sends its zero and then sleeps while the subscriber still
        # lives: each Joy of that second becomes one more velocity, and the robot drives again.
        self.stopping = True  # so does what rospy has read and not yet handed out
        self.joy.unregister()
        for _ in range(3):  # a callback that has started already may send after the first zero
            self.cmd_vel.publish(Twist())
            time.sleep(0.1)  # not rospy.sleep(): simulated time may stand still


if __name__ == "__main__":
    NewJoy2Twist()
    rospy.spin()
