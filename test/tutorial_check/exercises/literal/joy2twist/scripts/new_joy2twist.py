#!/usr/bin/env python
import roslib; roslib.load_manifest('joy2twist')
import rospy
from sensor_msgs.msg import Joy
from geometry_msgs.msg import Twist


class NewJoy2Twist():
    def __init__(self):
        rospy.init_node('NewJoy2Twist', anonymous=False)
        rospy.on_shutdown(self.shutdown)
        self.cmd_vel = rospy.Publisher('/cmd_vel', Twist)
        rospy.Subscriber("/joy", Joy, self.callback)
        rospy.spin()

    def callback(self, data):
        rospy.loginfo(rospy.get_name() + ": axes [%.2f, %.2f, %.2f, %.2f, %.2f, %.2f]" % data.axes)
        msg = Twist()
        msg.linear.x = data.axes[1]
        msg.angular.z = data.axes[0]
        self.cmd_vel.publish(msg)

    def shutdown(self):
        rospy.loginfo("The robot is being stopped")
        self.cmd_vel.publish(Twist())
        rospy.sleep(1)


if __name__ == '__main__':
    try:
        NewJoy2Twist()
    except:
        rospy.loginfo("The node has ended.")
