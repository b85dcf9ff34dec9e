#!/usr/bin/env python
import rospy
from beginner_tutorials.srv import AddTwoInts


def add(request):
    rospy.loginfo("%d and %d are asked for", request.a, request.b)
    return request.a + request.b


if __name__ == "__main__":
    rospy.init_node("add_two_ints_server")
    rospy.Service("add_two_ints", AddTwoInts, add)
    rospy.loginfo("adds")
    rospy.spin()
