#!/usr/bin/env python3
"""Give turtlesim another background: R G B."""

import sys

import rospy
from std_srvs.srv import Empty

rospy.init_node("background")
rospy.wait_for_service("clear")
for color, word in zip("rgb", rospy.myargv()[1:]):
    rospy.set_param("/turtlesim/background_" + color, int(word))
rospy.ServiceProxy("clear", Empty)()
print("the background is", *sys.argv[1:])
