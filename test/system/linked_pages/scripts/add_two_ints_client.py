#!/usr/bin/env python
import sys

import rospy
from beginner_tutorials.srv import AddTwoInts

rospy.wait_for_service("add_two_ints")
add = rospy.ServiceProxy("add_two_ints", AddTwoInts)
print("sum:", add(int(sys.argv[1]), int(sys.argv[2])).sum)
