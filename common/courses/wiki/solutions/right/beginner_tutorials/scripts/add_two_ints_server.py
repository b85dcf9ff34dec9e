#!/usr/bin/env python3
"""Add two numbers."""

import rospy
from beginner_tutorials.srv import AddTwoInts, AddTwoIntsResponse


def add(request):
    total = request.a + request.b
    print(f"{request.a} and {request.b} make {total}")
    return AddTwoIntsResponse(total)


if __name__ == "__main__":
    rospy.init_node("add_two_ints_server")
    rospy.Service("add_two_ints", AddTwoInts, add)
    print("ready to add")
    rospy.spin()
